"""docs/sizes.json and the size check: what fails it, what it lets pass, what it says of a bad file."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from cocotb_tests.harness.project import ProjectError
from scripts import report
from scripts.flow import size_page, sizes
from scripts.flow.netlist import Breakdown, Count

OLD = {"part": {"ecp5": {"lut": 1000, "ff": 600, "ram": 2}}}


def changed(**figures: int) -> sizes.Sizes:
    """OLD with other figures."""
    return {"part": {"ecp5": {**OLD["part"]["ecp5"], **figures}}}


@pytest.mark.parametrize("figures", [{}, {"lut": 1050}, {"ff": 630}, {"lut": 950, "ff": 570}, {"lut": 1001}])
def test_up_to_five_per_cent_pass(figures: dict[str, int]) -> None:
    verdict = sizes.compare(OLD, changed(**figures))
    assert verdict.wrong == [] and verdict.smaller == []


@pytest.mark.parametrize(
    ("figures", "words"),
    [
        ({"lut": 1051}, "LUT 1000 -> 1051 (+5.1 %), more than 5 % larger"),
        ({"ff": 631}, "FF 600 -> 631 (+5.2 %), more than 5 % larger"),
        ({"ram": 3}, "block RAM 2 -> 3 (+50.0 %), more than 5 % larger"),
    ],
)
def test_more_growth_fails_with_one_line_a_figure(figures: dict[str, int], words: str) -> None:
    assert sizes.compare(OLD, changed(**figures)).wrong == [f"part on ecp5: {words}"]


def test_growth_from_nothing_fails() -> None:
    old = {"part": {"ecp5": {"lut": 1000, "ff": 600, "ram": 0}}}
    assert sizes.compare(old, OLD).wrong == [
        "part on ecp5: block RAM 0 -> 2, more than 5 % larger",
    ]


def test_a_shrink_is_told_and_passes() -> None:
    verdict = sizes.compare(OLD, changed(lut=949))
    assert verdict.wrong == []
    assert verdict.smaller == ["part on ecp5: LUT 1000 -> 949 (-5.1 %), more than 5 % smaller"]


def test_entries_on_one_side_only_fail() -> None:
    more = {**OLD, "board": {"ice40": {"lut": 1, "ff": 1, "ram": 0}}}
    assert sizes.compare(OLD, more).wrong == ["board on ice40: no committed sizes"]
    assert sizes.compare(more, OLD).wrong == [
        "board on ice40: has committed sizes but is not built any more",
    ]


def test_the_file_is_read_as_it_was_written(tmp_path: Path) -> None:
    path = tmp_path / "sizes.json"
    table = {"b": {"ice40": {"lut": 1, "ff": 2, "ram": 3}, "ecp5": {"lut": 4, "ff": 5, "ram": 6}}, **OLD}
    sizes.write(table, path)
    assert sizes.read(path) == table
    rows = [line.strip() for line in path.read_text().splitlines() if '"lut"' in line]
    assert rows == [
        '"ecp5": {"ff": 5, "lut": 4, "ram": 6},',
        '"ice40": {"ff": 2, "lut": 1, "ram": 3}',
        '"ecp5": {"ff": 600, "lut": 1000, "ram": 2}',
    ]


def test_a_missing_file_names_the_remedy(tmp_path: Path) -> None:
    with pytest.raises(ProjectError, match="is missing: `make report` writes it"):
        sizes.read(tmp_path / "sizes.json")


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("{ not json", "is not JSON"),
        ("\x00\xff", "is not JSON"),
        ("[]", "is not a table"),
        ('{"part": 5}', "is not a table"),
        ('{"part": {"ecp5": [1]}}', "is not a table"),
        ('{"part": {"ecp5": {"lut": 1, "ff": 2}}}', "is not a table"),
        ('{"part": {"ecp5": {"lut": "1", "ff": 2, "ram": 0}}}', "is not a table"),
        ('{"part": {"ecp5": {"lut": -1, "ff": 2, "ram": 0}}}', "is not a table"),
    ],
)
def test_a_garbled_file_is_one_clear_error(tmp_path: Path, text: str, words: str) -> None:
    path = tmp_path / "sizes.json"
    path.write_bytes(text.encode("latin-1"))
    with pytest.raises(ProjectError, match=words):
        sizes.read(path)


@pytest.mark.parametrize(("lut", "code"), [(1050, 0), (1051, 1), (500, 0)])
def test_the_check_ends_with_the_right_code(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    lut: int,
    code: int,
) -> None:
    path = tmp_path / "sizes.json"
    path.write_text(json.dumps(OLD))
    committed = sizes.read(path)
    monkeypatch.setattr(sizes, "read", lambda: committed)
    monkeypatch.setattr(report, "measured", lambda wanted, tell: (changed(lut=lut), []))
    assert report.check([], [], lambda text: None) == code
    assert ("`make report` accepts" in capsys.readouterr().err) == bool(code)


def test_the_breakdown_adds_up_to_the_total() -> None:
    bridge = f"{size_page.BRIDGE}.u_bridge"
    split = Breakdown(
        total=Count(lut=100, ff=50, ram=3),
        flat={
            "": Count(4, 1),
            "u_part": Count(10, 5, 1),
            "u_part.u_axis": Count(50, 20, 1),
            bridge: Count(30, 20, 1),
            f"{bridge}.u_rx": Count(6, 4),
        },
        kept={"": Count(), "u_part": Count(), bridge: Count(), f"{bridge}.u_rx": Count()},
        module={bridge: "bridge", f"{bridge}.u_rx": "rx"},
    )
    assert size_page.instance_rows("ppmc104", {"ecp5": split}) == [
        ["u_part", "ppmc104, all of it", "60", "25", "2"],
        ["u_bridge", "bridge", "30", "20", "1"],
        ["&nbsp;&nbsp;u_rx", "rx", "6", "4", ""],
        ["(top itself)", "ppmc104_carrier", "4", "1", ""],
        ["total", "", "100", "50", "3"],
    ]
    del split.kept[bridge], split.kept[f"{bridge}.u_rx"], split.flat[bridge], split.flat[f"{bridge}.u_rx"]
    split.kept["u_part.u_axis"], split.module["u_part.u_axis"] = Count(), "axis"
    assert size_page.instance_rows("pmc006", {"ecp5": split}) == [
        ["u_part", "pmc006", "10", "5", "1"],
        ["&nbsp;&nbsp;u_axis", "axis", "50", "20", "1"],
        ["(top itself)", "pmc006_carrier", "40", "25", "1"],
        ["total", "", "100", "50", "3"],
    ]


def test_the_median_is_the_middle_seed() -> None:
    row = size_page.Row("d", "x", Count(1, 2, 0), [1.0, 2.0, 9.0], {"lut": 1, "lut_total": 3}, 24.0)
    assert row.cells() == ["d", "x", "1", "2", "0", "33 %", "2.0", "1.0 … 9.0", "24 MHz"]
