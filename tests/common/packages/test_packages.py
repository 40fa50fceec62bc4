"""The generated packages: up to date, complete, in compile order, in the formats of their tools."""

from __future__ import annotations

import re
import subprocess
import sys

import pytest
import yaml

from cocotb_tests.harness.paths import ROOT
from openppmc.parts import tops
from scripts.fpga.packages.cores import core_files
from scripts.fpga.packages.lists import list_files

LISTED = yaml.safe_load((ROOT / "rtl" / "files.yml").read_text(encoding="utf-8"))


def needed(group: str) -> set[str]:
    """Return a group of rtl/files.yml and all groups that it needs."""
    return {group}.union(*(needed(other) for other in LISTED[group]["needs"]))


# The lists of parts omit carriers and their shared groups, which have a separate target in Bender; tops of
# boards are in no list.
IN_PARTS = set[str]().union(*(needed(row.rtl) for row in tops()))
CARRIERS = [group for group in LISTED if group not in IN_PARTS and group != "boards"]
RTL = [f"rtl/{name}" for group in LISTED if group in IN_PARTS for name in LISTED[group]["files"]]
BOARDS = [[f"rtl/{name}" for name in LISTED[group]["files"]] for group in CARRIERS]


@pytest.mark.parametrize("path", {**core_files(), **list_files()}, ids=lambda path: path.name)
def test_fresh(path):
    """A generated file equals the output of `make packages`, and contains no path of a computer."""
    wanted = {**core_files(), **list_files()}[path]
    assert path.read_text(encoding="utf-8") == wanted, "run `make packages`"
    assert not re.search(r"(?<![\w$.*])/(?:home|work|tmp|usr)/", wanted)


def listed(name: str) -> list[str]:
    """Return the RTL files of a list, which must also contain the include folder."""
    text = (ROOT / "packages" / name).read_text(encoding="utf-8")
    assert "rtl/common\n" in text, "no include folder"
    return re.findall(r"(?:\.\.|\$root)/(rtl/\S+\.sv)\b", text)


@pytest.mark.parametrize("part", tops(), ids=lambda row: row.name)
def test_list_of_a_part(part):
    """The list of a device contains the device, its carrier and their dependencies, in compile order."""
    groups = needed(f"{part.rtl}_carrier" if part.carrier else part.rtl)
    assert groups > {part.rtl, "common"}
    assert listed(f"{part.rtl}.f") == [
        f"rtl/{name}" for group in LISTED if group in groups for name in LISTED[group]["files"]
    ]


def test_bender():
    """Bender.yml has the groups of rtl/files.yml; carriers are only in their own target."""
    sources = yaml.safe_load((ROOT / "Bender.yml").read_text(encoding="utf-8"))["sources"]
    plain = [file for group in sources if "target" not in group for file in group["files"]]
    assert plain == RTL
    assert [group["files"] for group in sources if "target" in group] == BOARDS


def test_cores():
    """Every RTL file is in a FuseSoC core, and each dependency exists."""
    cores = [path for path in core_files() if path.suffix == ".core"]
    texts = {path: path.read_text(encoding="utf-8") for path in cores}
    assert all(text.startswith("CAPI=2:\n") for text in texts.values())
    parsed = {path: yaml.safe_load(text) for path, text in texts.items()}
    names = {core["name"] for core in parsed.values()}
    found = []
    for path, core in parsed.items():
        for fileset in core["filesets"].values():
            assert set(fileset.get("depend", [])) <= names, path.name
            for entry in fileset.get("files", []):
                file = path.parent / (entry if isinstance(entry, str) else next(iter(entry)))
                if file.is_relative_to(ROOT / "build"):
                    continue  # `make verilog` writes this file, so it may be missing
                assert file.is_file(), f"{path.name}: {file.name}"
                found.append(file.relative_to(ROOT).as_posix())
        for target in core["targets"].values():
            assert set(target["filesets"]) <= set(core["filesets"]), path.name
    assert [name for name in found if name in RTL] == RTL


@pytest.mark.parametrize(
    ("program", "told"), (("/no/such", "there is no such program"), ("true", "not a Verilator"))
)
def test_other_verilator_must_be_one(program, told):
    """If VERILATOR is not a Verilator, one line reports it before any check."""
    words = [sys.executable, "-m", "scripts.fpga.packages", "--try", "--verilator", program]
    done = subprocess.run(words, cwd=ROOT, text=True, capture_output=True, check=False, timeout=120)
    assert done.returncode == 1 and told in done.stdout + done.stderr
    assert len((done.stdout + done.stderr).strip().splitlines()) == 1
