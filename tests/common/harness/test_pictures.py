"""The pictures of docs/: lines recorded from a model, rows that fit the page, and break marks that cover no
text.
"""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET
from pathlib import Path

import pytest

from cocotb_tests.harness.paths import ROOT
from cocotb_tests.harness.project import ProjectError
from scripts.pages import figures
from scripts.pages.pictures import waves
from scripts.pages.pictures.diagram_width import MOST, fitted, lanes, text_width, wrapped
from scripts.pages.pictures.kinds import made
from scripts.pages.pictures.recorded import Row, columns_of, labels, lettered, numbered, record, thinned, wave
from scripts.pages.stmc import ready

SINGLE_STEP = 0x42


def test_a_line_has_one_brick_a_column():
    """A line of a diagram has one character per column: a dot for no change, | for a gap, x for a level that
    does not matter.
    """
    levels = [{"a": 0}, {"a": 0}, None, {"a": 1}, {"a": 1}, {"a": 2}]
    assert wave(Row("a", "a"), levels[:5])["wave"] == "0.|1."
    assert wave(Row("a", "a", str), levels) == {"name": "a", "wave": "3.|4.5", "data": ["0", "1", "2"]}
    hidden = Row("a", lambda found: found["a"] or None, host=True, nodes={3: "A"})
    assert wave(hidden, levels[:5]) == {"name": "a", "wave": "x.|1..", "phase": 0.5, "node": "...A."}


def test_columns_without_a_change_are_left_out():
    """Columns without a change are replaced by a gap; the columns next to a change or to a gap remain."""
    samples = [{"a": level} for level in (0, 0, 0, 0, 1, 1, 1, 0, 0, 0, 0)]
    assert thinned(range(11), samples, [Row("a", "a")]) == [0, None, 3, 4, 5, 6, 7, 8]
    gap = [*samples[:2], None, *samples[4:6]]
    assert thinned([0, 1, None, 8, 9], gap, [Row("a", "a")]) == [0, 1, None, 8, 9]


def test_long_numbers_have_letters():
    """Long edge numbers get a letter, which is explained once below the diagram."""
    words, foot = numbered([-1, 0, None, 1_601_599, 1_601_600, 1_601_601, None, 25_600])
    assert words == ["-1", "0", None, "n-1", "n", "n+1", None, "m"]
    assert foot == "n = 1601600, m = 25600"
    assert labels("edge", ["", "a", "", None, "", "b"]) == {
        "name": "edge", "wave": "22.|22", "data": ["", "a", "", "b"],
    }  # fmt: skip


LONG = {
    "signal": [
        {"name": "edge", "wave": "2222|" * 5, "data": [str(n) for n in range(20)]},
        ["host", {"name": "a", "wave": "10..|" * 5 + ".", "phase": 0.5, "node": ".A" + "." * 19 + "B"}],
    ],
    "config": {"hscale": 2},
}


def test_a_long_diagram_gets_rows():
    """A diagram of 25 columns is split into rows that fit the page; each row begins with the current
    levels.
    """
    found = fitted(LONG)
    edges = [lane for lane in lanes(found["signal"]) if lane.get("name") == "edge"]
    assert "".join(lane["wave"] for lane in edges) == LONG["signal"][0]["wave"]
    assert [text for lane in edges for text in lane["data"]] == LONG["signal"][0]["data"]
    first, second = (lane for lane in lanes(wrapped(LONG, [5])["signal"]) if lane.get("name") == "a")
    assert (first["wave"], second["wave"]) == ("10..|.", "10..|" * 4 + ".")
    with pytest.raises(ValueError, match=f"wider than {MOST} px"):
        waves.draw({"signal": [{"name": "a", "wave": "10" * 20, "data": [], "phase": 0}]}, "a")


def test_no_arrow_is_torn():
    """A diagram is never split between the two ends of an arrow."""
    torn = {**LONG, "edge": ["A~>B"]}
    assert wrapped(torn, [5]) is None and wrapped(torn, [10]) is None
    with pytest.raises(ValueError, match="cannot be cut"):
        fitted(torn)


PICTURES = sorted((ROOT / "docs").glob("**/img/*.svg"))
DIAGRAMS = [path for path in PICTURES if 'class="WaveDrom"' in path.read_text(encoding="utf-8")[:600]]


def _ids(paths: list[Path]) -> list[str]:
    return [f"{path.parent.parent.name}/{path.stem}" for path in paths]


@pytest.mark.parametrize("path", DIAGRAMS, ids=_ids(DIAGRAMS))
def test_no_diagram_is_wider_than_a_page(path):
    """No diagram of the manuals is wider than a page, so its smallest text has at least 10 px on the site."""
    root = ET.parse(path).getroot()
    assert float(root.get("width")) <= MOST


def _moved(node: ET.Element) -> tuple[float, float]:
    found = [float(n) for n in re.findall(r"-?[\d.]+", node.get("transform", "0,0"))]
    return found[0], found[1] if len(found) > 1 else 0.0


def _struck(root: ET.Element) -> list[str]:
    """Return the texts that a break mark covers."""
    marks, texts = [], []

    def walk(node: ET.Element, x: float, y: float) -> None:
        if "rotate" in node.get("transform", ""):
            return  # the name of a group is to the left of all lines, so no break mark covers it
        dx, dy = _moved(node)
        x, y = x + dx, y + dy
        if node.tag.endswith("use") and any(value == "#gap" for value in node.attrib.values()):
            marks.append((x - 7, x + 7, y - 2, y + 22))
        if node.tag.endswith("text") and (text := "".join(node.itertext()).strip()):
            small = 11 / 13 if "11px" in node.get("style", "") else 1
            middle, half = x + float(node.get("x", "0")), text_width(text) * small / 2
            if node.get("text-anchor") == "middle":
                base = y + float(node.get("y", "0"))
                texts.append((text, middle - half, middle + half, base - 9, base))
        for child in node:
            walk(child, x, y)

    walk(root, 0, 0)
    return [
        text
        for text, left, right, top, base in texts
        for a, b, above, below in marks
        if left < b and a < right and top < below and above < base
    ]


@pytest.mark.parametrize("path", DIAGRAMS, ids=_ids(DIAGRAMS))
def test_no_break_mark_strikes_through_a_text(path):
    """No break mark in a diagram of the manuals covers a text."""
    assert not _struck(ET.parse(path).getroot())


def test_record_follows_the_model():
    """After a write with a strobe of 3 samples, IBF, BUSY and HOLD change on the edges of the manual."""
    start = ready()
    cycle = start.action(0, "write", 1, SINGLE_STEP)
    seen = record(start.model, start.inputs, cycle, range(start.base + 2, start.base + 10))
    assert [levels["wr_n"] for levels in seen] == [0, 1, 1, 1, 1, 1, 1, 1]
    assert [levels["ibf"] for levels in seen] == [0, 0, 0, 1, 1, 0, 0, 0]
    assert [levels["busy"] for levels in seen] == [0, 0, 0, 0, 0, 1, 1, 1]
    assert [levels["hold"] for levels in seen] == [1, 1, 1, 1, 1, 1, 0, 0]


def test_diagrams_are_drawn_with_wide_labels():
    """The background of an arrow's label is as wide as its text."""
    svg = figures.drawn(figures.entries("stmc")["pictures"]["end"], "end").decode()
    (width,) = re.findall(r'<rect[^>]*fill:#FFF;[^>]*width="([\d.]+)"[^>]*/><text[^>]*><tspan>34 ms', svg)
    assert float(width) > 5 * 6


def test_columns_are_edges_ranges_and_gaps():
    """The text of the columns may contain edges, ranges with both ends included, and gaps."""
    assert columns_of("-1..1 4 | 100") == [-1, 0, 1, 4, None, 100]


def test_no_gap_hides_a_change():
    """A diagram in which a line changes within a gap is rejected."""
    entry = figures.entries("stmc")["pictures"]["start"]
    assert made(entry)["head"]["text"] == entry["title"]
    with pytest.raises(ValueError, match="s changes in the gap before edge 84"):
        made({**entry, "columns": "-3..2 | 84 85"})


def test_a_mistake_in_an_entry_is_one_line(tmp_path, monkeypatch):
    """For a wrong kind, a wrong argument or invalid YAML, the error names file and entry."""
    monkeypatch.setattr(figures, "DOCS", tmp_path)
    for text, message in (
        ("pictures: {a: {kind: pictures.blocks.draws}}", "figures.yml: a: .*draws"),
        ("pictures: {a: {kind: pictures.blocks.drawing, colour: 1}}", "figures.yml: a: .*colour"),
        ("pictures: {a: {}}", "figures.yml: a: 'kind'"),
        ("pictures: [", "figures.yml: file: while parsing"),
    ):
        (tmp_path / "figures.yml").write_text(text)
        with pytest.raises(ProjectError, match=message) as caught:
            figures.pages(".")
        assert "\n" not in str(caught.value)


def test_letters_mark_where_a_line_changes():
    """Letters are assigned to the changes of a line in order; a dot skips a change."""
    samples = [{"a": 0}, {"a": 1}, {"a": 1}, None, {"a": 0}, {"a": 1}]
    assert lettered(Row("a", "a"), samples, "A.B").nodes == {1: "A", 5: "B"}
    assert lettered(Row("a", "a"), samples, "").nodes == {}


def test_a_block_of_the_312_is_drawn_byte_by_byte():
    """The diagram of the version read has the accesses of the manual, and its flags change at them."""
    access, mwef, mref, irq = made(figures.entries("ppmc312")["pictures"]["block"])["signal"]
    there = [word.strip() for word in access["data"]]
    assert there[:5] == ["WCR 20", "WAR 1D", "DWR 40", "DWR 01", "DWR 03"]
    assert there[5:] == ["RAR 3C", "DRR 12", "DRR 40", "DRR 02", "DRR 03"]
    assert mwef["wave"] == "0.....1|0......"
    assert mref["wave"] == irq["wave"] == "1......|0.....1"


def test_worked_moves_of_the_312():
    """Profiles, pulses and times in the generated table of moves are those of the worked moves in the
    manual.
    """
    rows = made(figures.entries("ppmc312")["tables"]["moves-table"]).splitlines()
    assert "| TF, 82, N = 30 | 00 | 12, 6, 12 | 400×3 200×4 100×16 200×4 400×3 | 5600 |" in rows
    assert "| TF, 82, N = 24 | 00 | 12, 0, 12 | 400×3 200×4 100×10 200×4 400×3 | 5000 |" in rows
    assert "| TG, N = 3 | 40 | 3, 0, 0 | 400×3 | 1200 |" in rows
    for text, kind, parts, ticks in (
        ("T1, N = 5000", "00", "2000, 1000, 2000", 1_532_294),
        ("T3, N = 3000", "10", "1730, 0, 1270", 992_384),
        ("T4, N = 700", "10", "211, 0, 489", 362_582),
    ):
        (row,) = [row for row in rows if row.startswith(f"| {text} |")]
        assert row.startswith(f"| {text} | {kind} | {parts} |") and row.endswith(f" {ticks} |")
