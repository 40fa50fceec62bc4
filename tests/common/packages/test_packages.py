"""The generated packages: fresh, complete, in compile order, and readable by their tools' rules."""

from __future__ import annotations

import re

import pytest
import yaml

from cocotb_tests.harness.paths import ROOT
from scripts.packages.cores import core_files
from scripts.packages.lists import list_files

LISTED = yaml.safe_load((ROOT / "rtl" / "files.yml").read_text(encoding="utf-8"))
RTL = [f"rtl/{name}" for group, names in LISTED.items() if group != "boards" for name in names]
# The board modules, and the blocks that they share.
PARTS_OF = {
    "ppmc104": ["ppmc_board_host", "ppmc104_carrier"],
    "ppmc2104": ["ppmc_board_host", "ppmc2104_carrier"],
    "stmc": ["ppmc_board_host", "ppmc_board_steps", "stmc_carrier"],
    "ppmc312": ["ppmc_board_host", "ppmc312_carrier"],
    "pmc006": ["ppmc_board_reset", "ppmc_board_lamp", "ppmc_board_panel", "pmc006_carrier"],
}
IN_USE = {name for names in PARTS_OF.values() for name in names}
BOARDS = [f"rtl/{name}" for name in LISTED["boards"] if name.rsplit("/")[-1][:-3] in IN_USE]
# What each part needs besides the blocks that all use.
NEEDS = {
    "ppmc104": ["host", "single"],
    "ppmc2104": ["host"],
    "isa_4axis": ["host", "ppmc2104"],
    "stmc": ["host", "single"],
    "j105_stmc": ["host", "single", "stmc"],
    "ppmc312": ["host", "stage"],
    "pmc006": [],
}


@pytest.mark.parametrize("path", {**core_files(), **list_files()}, ids=lambda path: path.name)
def test_fresh(path):
    """Given a generated file, then it is what `make packages` would write, and names nobody's machine."""
    wanted = {**core_files(), **list_files()}[path]
    assert path.read_text(encoding="utf-8") == wanted, "run `make packages`"
    assert not re.search(r"(?<![\w$.*])/(?:home|work|tmp|usr)/", wanted)


def listed(name: str) -> list[str]:
    """RTL files that a list names, which must name the include folder as well."""
    text = (ROOT / "packages" / name).read_text(encoding="utf-8")
    assert "rtl/common\n" in text, "no include folder"
    assert name.endswith(".f") or "Not run by this project" in text
    return re.findall(r"(?:\.\.|\$root)/(rtl/\S+\.sv)\b", text)


@pytest.mark.parametrize("name", ["vivado.tcl", "quartus.qsf", "gowin.tcl"])
def test_list_is_complete_and_in_order(name):
    """Given a vendor's list, then it names every RTL file once, in compile order, and the board modules."""
    assert listed(name) == [*RTL, *BOARDS]


@pytest.mark.parametrize("part", NEEDS)
def test_list_of_a_part(part):
    """Given a part's list, then it names the shared blocks, the part and its board module."""
    groups = ["common", "motion", *NEEDS[part], part]
    own = [f"rtl/{name}" for group in groups for name in LISTED[group]]
    wanted = {f"{name}.sv" for name in PARTS_OF.get(part, [])}
    boards = [name for name in BOARDS if name.rsplit("/")[-1] in wanted]
    assert listed(f"{part}.f") == [*own, *boards]


def test_bender():
    """Given Bender.yml, then its groups are those of rtl/files.yml, the boards only with their target."""
    sources = yaml.safe_load((ROOT / "Bender.yml").read_text(encoding="utf-8"))["sources"]
    plain = [file for group in sources if "target" not in group for file in group["files"]]
    assert plain == RTL
    assert [group["files"] for group in sources if "target" in group] == [BOARDS]


def test_cores():
    """Given the FuseSoC cores, then every RTL file is in one of them, and each dependency is there."""
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
                assert file.is_file(), f"{path.name}: {file.name}"
                found.append(file.relative_to(ROOT).as_posix())
        for target in core["targets"].values():
            assert set(target["filesets"]) <= set(core["filesets"]), path.name
    assert [name for name in found if name in RTL] == RTL
