"""The pictures of docs/: lines recorded from a model, and labels that their arrows do not strike through."""

from __future__ import annotations

import re

from scripts.pictures import waves, waves_stmc
from scripts.pictures.recorded import Row, beside_gaps, record, wave, write_cycle
from scripts.pictures.stmc_bench import Bench

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
    svg = waves.draw(waves_stmc.DIAGRAMS["stmc_end"](), "stmc_end").decode()
    (width,) = re.findall(r'<rect[^>]*fill:#FFF;[^>]*width="([\d.]+)"[^>]*/><text[^>]*><tspan>34 ms', svg)
    assert float(width) > 5 * 6
