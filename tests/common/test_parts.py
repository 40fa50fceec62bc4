"""The table of devices agrees with the tree: each module that it names can be loaded, each folder has a row,
and each row has its folders.
"""

from __future__ import annotations

import ast
import re
import shutil
import subprocess
import sys
from dataclasses import fields
from pathlib import Path

import pytest

from cocotb_tests.harness import project
from cocotb_tests.harness.collect import manual_rules, part_of_rule
from cocotb_tests.harness.paths import ROOT
from openppmc import parts
from openppmc.parts import LAYER_OF, PARTS, Row, UnknownPartError, folders, tops

# Shared folders: the only folders of a layer that belong to no single device.
SHARED = {
    "openppmc/model": {"motion", "single", "carrier"},
    "openppmc/host": {"selftest"},
    "openppmc/cli": {"common"},
    "openppmc/sim": {"common"},
    "openppmc/capture": {"common"},
    "cocotb_tests": {"harness", "common", "motion", "single", "host", "board", "gates"},
    "scripts": {"fpga", "demo", "site", "release", "measure", "pages"},
    "scripts/pages": {"pictures", "wiring"},
    "tests": {"common"},
    "docs": {"img", "boards", "decisions"},
    "rtl": {"common", "motion", "single", "host", "boards"},
    "tb": {"arduino", "board", "cdriver", "formal", "fuzz", "jitter", "line", "litex"},
}
PLACES = [(row.name, column) for row in PARTS.values() for column in LAYER_OF if getattr(row, column)]
own = pytest.mark.parametrize("row", folders(), ids=lambda row: row.name)
every = pytest.mark.parametrize("row", PARTS.values(), ids=lambda row: row.name)


def subfolders(layer: str) -> set[str]:
    """Return the folders of a layer that contain files of this project."""
    found = (path for path in (ROOT / layer).iterdir() if path.is_dir() and path.name != "__pycache__")
    return {path.name for path in found if any(file.suffix != ".pyc" for file in path.rglob("*.*"))}


def modules(layer: str) -> set[str]:
    """Return the Python modules of a layer."""
    return {path.stem for path in (ROOT / layer).glob("*.py")}


@pytest.mark.parametrize(("name", "column"), PLACES)
def test_every_place_loads(name, column):
    """Each module that the table names can be loaded."""
    assert parts.part(name).load(column) is not None


@pytest.mark.parametrize("layer", SHARED)
def test_every_folder_has_a_row(layer):
    """Each folder of a layer is a shared folder or belongs to a device in the table."""
    assert subfolders(layer) - SHARED[layer] <= {row.name for row in folders()}


@own
def test_every_row_has_its_folders(row):
    """Each device has RTL, a manual, a golden model, and a folder or module for each of its columns."""
    wanted = {
        "rtl",
        "docs",
        *(LAYER_OF[column].replace(".", "/") for column in LAYER_OF if getattr(row, column)),
    }
    assert {layer for layer in wanted if row.name in subfolders(layer) | modules(layer)} == wanted


@every
def test_rtl_and_carrier(row):
    """The top of a device is in its group of rtl/files.yml; a carrier exists if and only if the table has
    one.
    """
    assert project.top_file(row).stem == row.top
    assert row.families and set(row.families) <= {"ecp5", "ice40"}
    carrier = (f"{row.rtl}_carrier" in project.listed()) and not row.of
    assert carrier == row.carrier == bool(project.board_files(row.name))


@own
def test_docs(row):
    """The manual of a device consists of the pages in the table of parts, and the indexes link to them."""
    pages = {"README.md", *row.docs}
    there = {path.name for path in (ROOT / "docs" / row.name).glob("*.md")} - {"traceability.md"}
    assert there == pages
    readme, index = ((ROOT / name).read_text(encoding="utf-8") for name in ("README.md", "docs/README.md"))
    assert row.title in readme and f"docs/{row.name}/README.md" in readme
    assert [page for page in sorted(pages) if f"]({row.name}/{page})" not in index] == []


@own
def test_rules(row):
    """The rules in the manual of a device have its prefixes, and all prefixes are used."""
    rules = {rule for rule in manual_rules(row.name) if not rule.startswith("AC-")}
    assert {part_of_rule(rule) for rule in rules} <= {row.name}
    assert {rule.split("-")[0] for rule in rules} == (set(row.rules) if rules else set())


def test_names_and_numbers_are_unique():
    """Names and numbers are unique, and `of` names a device with folders."""
    assert len(PARTS) == len(parts.ROWS)
    numbers = [row.number for row in PARTS.values() if row.number]
    assert len(set(numbers)) == len(numbers)
    assert {row.of for row in PARTS.values()} - {""} <= {row.name for row in folders()}
    for row in folders():
        assert not row.number or parts.by_number(row.number) is row
    assert parts.by_number(1) is None


def asked(*words: str, root: Path = ROOT) -> subprocess.CompletedProcess[str]:
    """Run the table as make does: with a Python that does not find the project's modules."""
    command = [sys.executable, "-I", "-S", str(root / "openppmc/parts.py"), *words]
    return subprocess.run(command, capture_output=True, text=True, cwd="/", check=False)


def test_command_line():
    """The command prints names, or reports a mistake in one line."""
    assert asked("names").stdout.split() == list(PARTS)
    assert asked("names", "--tops").stdout.split() == [row.name for row in tops()]
    assert asked("names", "--folders").stdout.split() == [row.name for row in folders()]
    assert asked("names", "--with", "demo", "line").stdout.split() == ["ppmc312-serial", "pmc006"]
    lines = asked("names", "--any", "carrier", "line").stdout.split()
    assert lines == [row.name for row in PARTS.values() if row.carrier or row.line]
    shown = asked("show", "isa_4axis").stdout.splitlines()
    assert len(shown) == len(fields(Row)) and "of: ppmc2104" in shown and "families: ecp5 ice40" in shown
    for wrong in (["names", "--with", "colour"], ["names", "--with"], ["show", "ppmc105"], []):
        done = asked(*wrong)
        assert done.returncode == 2 and len(done.stderr.splitlines()) == 1 and not done.stdout
    with pytest.raises(UnknownPartError, match="part ppmc104 has no script_commands"):
        parts.part("ppmc104").load("script_commands")


def test_an_old_python_reads_it():
    """The file can be parsed by Python 3.7 and imports only the standard library."""
    tree = ast.parse((ROOT / "openppmc/parts.py").read_text(encoding="utf-8"), feature_version=(3, 7))
    found = {node.module or "" for node in ast.walk(tree) if isinstance(node, ast.ImportFrom)}
    found |= {name.name for node in ast.walk(tree) if isinstance(node, ast.Import) for name in node.names}
    assert found == {"__future__", "importlib", "sys", "dataclasses", "typing"}


NEW = {
    "rtl/tiny/tiny.sv": """`default_nettype none

module tiny #(
    parameter int unsigned CLK_HZ = 16_000_000  // frequency of clk in Hz, 8e6 .. 200e6
) (
    input  wire logic clk,
    output logic      q
);
  ppmc_sync u_sync (
      .clk_i (clk),
      .rst_ni(1'b1),
      .d_i   (1'b0),
      .q1_o  (),
      .q2_o  (q)
  );
endmodule

`default_nettype wire
""",
    "openppmc/model/tiny.py": '"""A part."""\n\n\nclass Tiny:\n    """It."""\n',
    "docs/tiny/README.md": "# Tiny\n\n| Rule | |\n|---|---|\n| TINY-CMD-01 | none |\n",
}
ROW = """    Row(
        name="tiny",
        title="Tiny 1",
        rules=("TINY",),
        families=("ecp5",),
        model=":Tiny",
    ),
"""
GROUP = "tiny:\n  about: Tiny 1, nothing\n  needs: [common]\n  files:\n    - tiny/tiny.sv\n"


def append(path: Path, before: str, text: str) -> None:
    """Insert text before the first occurrence of `before`; at the end of the file if `before` is empty."""
    lines = path.read_text(encoding="utf-8")
    place = lines.index(before) if before else len(lines)
    path.write_text(lines[:place] + text + lines[place:], encoding="utf-8")


def test_a_part_of_three_files_and_a_row(tmp_path):
    """In a copy of the tree, a new device needs only three files, a row in the table and a group in
    rtl/files.yml; all users of the table know it.
    """
    left = shutil.ignore_patterns(".git", ".venv", "build", "__pycache__", "*.png", ".*_cache", ".hypothesis")
    root = tmp_path / "copy"
    shutil.copytree(ROOT, root, ignore=left)
    for name, text in NEW.items():
        (root / name).parent.mkdir(exist_ok=True)
        (root / name).write_text(text, encoding="utf-8")

    def run(*words: str) -> str:
        done = subprocess.run(
            [sys.executable, *words],
            cwd=root,
            text=True,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            check=False,
        )
        return done.stdout

    table = (*"-m pytest -q -p no:cacheprovider tests/common/test_parts.py -k".split(), "not three_files")
    lint = ("-c", "from scripts.measure import lint; print([lint.file_list(), lint.group_dependencies()])")
    assert re.search(r"FAILED .*test_every_folder_has_a_row\[rtl\]", run(*table))
    assert "rtl/files.yml does not list rtl/tiny/tiny.sv" in run(*lint)

    append(root / "openppmc/parts.py", ")\nOWN =", ROW)
    append(root / "rtl/files.yml", "bridged:\n", GROUP)
    append(root / "README.md", "", "\n[Tiny 1](docs/tiny/README.md)\n")
    append(root / "docs/README.md", "", "\n[Tiny 1](tiny/README.md)\n")
    assert "tiny" in asked("names", "--tops", root=root).stdout.split()
    assert run(*lint).strip() == "['', '']"
    told = run(*table)
    assert "failed" not in told and re.search(r"\d+ passed", told), told
    assert "openppmc_tiny.core" in run("-m", "scripts.fpga.packages")
    assert "CLK_HZ" in (root / "rtl/tiny/openppmc_tiny.core").read_text(encoding="utf-8")
    listed = (
        "from scripts.measure.sizes import designs; print({'tiny'} & {d.part for d in designs.of_parts()})"
    )
    told = run("-c", listed)
    assert told.strip() == "{'tiny'}"
