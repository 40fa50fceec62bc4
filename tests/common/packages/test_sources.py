"""rtl/files.yml: its format, and the checks of the dependencies between its groups."""

from __future__ import annotations

from pathlib import Path

import pytest
import yaml

from cocotb_tests.harness.paths import ROOT
from openppmc.sources import SourcesError, files, groups, needed, walls

LISTED = groups(ROOT)


def checkout(folder: Path, text: str, **modules: str) -> Path:
    """Create a folder with this list and these modules: name -> text."""
    (folder / "rtl").mkdir()
    (folder / "rtl" / "files.yml").write_text(text)
    for name, body in modules.items():
        (folder / "rtl" / f"{name}.sv").write_text(f"module {name};\n{body}\nendmodule\n")
    return folder


TWO = "low:\n  needs: []\n  files:\n    - a.sv\nhigh:\n  needs: [{}]\n  files:\n    - b.sv\n"


def test_read_as_yaml():
    """A YAML package reads the same content from the list as our own reader."""
    wanted = yaml.safe_load((ROOT / "rtl" / "files.yml").read_text(encoding="utf-8"))
    assert list(LISTED) == list(wanted)
    for name, group in LISTED.items():
        assert group.about == wanted[name]["about"] and list(group.needs) == wanted[name]["needs"]
        assert [path.relative_to(ROOT / "rtl").as_posix() for path in group.files] == wanted[name]["files"]


def test_walls_hold():
    """No file of the RTL uses a group that its own group does not list in `needs`."""
    assert walls(LISTED) == []


def test_a_wall_stops_an_instance(tmp_path):
    """If a file instantiates a module of a group that is not in `needs`, one line reports it."""
    root = checkout(tmp_path, TWO.format(""), a="", b="  a u_a ();")
    assert walls(groups(root)) == ["rtl/b.sv: a is in low, which high does not need"]


@pytest.mark.parametrize("body", ["", "// a u_a ();", '  initial $display("a");', "/* a\n a */"])
def test_a_need_for_nothing(tmp_path, body):
    """If a file only mentions a needed group in comments or texts, one line reports that the need is not
    used.
    """
    root = checkout(tmp_path, TWO.format("low"), a="", b=body)
    assert walls(groups(root)) == ["rtl/files.yml: high names nothing of low, which it needs"]


def test_needed_in_compile_order(tmp_path):
    """All direct and indirect needs of a group precede it in the compile order, each once."""
    chain = {"a": "", "b": "a", "c": "b, a"}
    text = "".join(f"{name}:\n  needs: [{of}]\n  files:\n    - {name}.sv\n" for name, of in chain.items())
    listed = groups(checkout(tmp_path, text, a="", b=""))
    assert needed(listed, "c") == ["a", "b", "c"]
    with pytest.raises(SourcesError, match=r"files that do not exist: c\.sv"):
        files(listed, "c")
    with pytest.raises(SourcesError, match="no group d"):
        needed(listed, "d")


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("a:\n  - a.sv\n", r"files\.yml:2: not in the form"),
        ("a:\n  needs: [b]\n  files:\n    - a.sv\n", "a needs b, which is no group"),
        ("  files:\n", r"files\.yml:1: not in the form"),
    ],
)
def test_refused(tmp_path, text, said):
    """If the list has another format, or a need is not a group, one line reports it."""
    with pytest.raises(SourcesError, match=said):
        groups(checkout(tmp_path, text))


def test_missing(tmp_path):
    """A missing list is reported in one line."""
    with pytest.raises(SourcesError, match="is missing"):
        groups(tmp_path)
