"""The pictures of docs/: lines recorded from a model, and labels that their arrows do not strike through."""

from __future__ import annotations

import re

from scripts.pictures import waves
from scripts.pictures.recorded import Row, beside_gaps, record, wave, write_cycle
from scripts.ppmc312 import tables
from scripts.ppmc312 import waves as waves_312
from scripts.ppmc312.bench import marked
from scripts.stmc import waves as waves_stmc
from scripts.stmc.bench import Bench

SINGLE_STEP = 0x42


def test_a_line_has_one_brick_a_column():
    """Given levels with a gap and one that does not matter, then the line shows changes only."""
    levels = [{"a": 0}, {"a": 0}, None, {"a": 1}, {"a": 1}, {"a": 2}]
    assert wave(Row("a", "a"), levels[:5])["wave"] == "0.|1."
    assert wave(Row("a", "a", str), levels) == {"name": "a", "wave": "3.|4.5", "data": ["0", "1", "2"]}
    hidden = Row("a", lambda found: found["a"] or None, host=True, nodes={3: "A"})
    assert wave(hidden, levels[:5]) == {"name": "a", "wave": "x.|1..", "phase": 0.5, "node": "...A."}


def test_text_steps_aside_for_a_gap():
    """Given boxes of which one has a gap in its middle, then only its text moves."""
    assert beside_gaps("3.|..4..|", ["a", "b"]) == ["a" + " " * 16, "b"]


def test_record_follows_the_model():
    """Given a write that is sampled for 3 clk, then IBF and pins change on the edges of the manual."""
    bench = Bench()
    bench.init(0x0A, 20, 5, 8)
    end = bench.t + 3
    cycle = write_cycle(bench.t, 1, SINGLE_STEP)
    seen = record(bench.chip, bench.chip.inputs, cycle, range(end - 1, end + 7))
    assert [levels["wr_n"] for levels in seen] == [0, 1, 1, 1, 1, 1, 1, 1]
    assert [levels["ibf"] for levels in seen] == [0, 0, 0, 1, 1, 0, 0, 0]
    assert [levels["busy"] for levels in seen] == [0, 0, 0, 0, 0, 1, 1, 1]
    assert [levels["hold"] for levels in seen] == [1, 1, 1, 1, 1, 1, 0, 0]


def test_diagrams_are_drawn_with_wide_labels():
    """Given a diagram with a labelled arrow, then the sheet below the label is as wide as its text is."""
    svg = waves.draw(waves_stmc.DIAGRAMS["end"](), "stmc_end").decode()
    (width,) = re.findall(r'<rect[^>]*fill:#FFF;[^>]*width="([\d.]+)"[^>]*/><text[^>]*><tspan>34 ms', svg)
    assert float(width) > 5 * 6


def test_letters_stand_where_a_line_changes():
    """Given a line with three changes, one of them in a gap, then letters go to the changes in turn."""
    samples = [{"a": 0}, {"a": 1}, {"a": 1}, None, {"a": 0}, {"a": 1}]
    assert marked(Row("a", "a"), samples, "A.B").nodes == {1: "A", 5: "B"}
    assert marked(Row("a", "a"), samples, "").nodes == {}


def test_a_block_of_the_312_is_drawn_byte_by_byte():
    """Given the version read, then its accesses are those of the manual, and the flags change with them."""
    access, mwef, mref, irq = waves_312.DIAGRAMS["block"]()["signal"]
    there = [word.strip() for word in access["data"]]
    assert there[:5] == ["WCR 20", "WAR 1D", "DWR 40", "DWR 01", "DWR 03"]
    assert there[5:] == ["RAR 3C", "DRR 12", "DRR 40", "DRR 02", "DRR 03"]
    assert mwef["wave"] == "0.....1|0......"
    assert mref["wave"] == irq["wave"] == "1......|0.....1"


def test_worked_moves_of_the_312():
    """Given the table of moves, then shapes, pulses and times are those of the rules' worked examples."""
    rows = tables.moves_table().splitlines()
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
