"""The clock frequency that the PPMC-312 needs for the write strobes of 65 ns in its data sheet (R-07)."""

from __future__ import annotations

import math
from fractions import Fraction

import pytest

from cocotb_tests.harness import project
from openppmc.model.ppmc312.part import Ppmc312

STROBE, SET_UP = 65, 35
"""Length of the write strobe, and time for which data is valid before the end of the strobe, in ns."""
LEAST = math.ceil(Fraction(2 * 10**9, SET_UP))
"""Lowest clock frequency in Hz at which two samples fit between the change of the data and the end of the
strobe.
"""
CSR, ENABLES = 0, 0x70


def written(clk_hz: int, phase: Fraction) -> int:
    """Write ENABLES to CSR with the shortest strobe of the data sheet; return the content of CSR afterwards.

    Args:
        phase: time in ns from a clock edge to the change of the data. This change is sampled one cycle late,
            as by a synchroniser.
    """
    period = Fraction(10**9, clk_hz)
    model = Ppmc312(clk_hz)
    start = model.timebase.clk_hz // 100
    data = start * period + phase

    def edge(t: Fraction) -> int:
        return math.ceil(t / period)

    begin, end = edge(data + SET_UP - STROBE), edge(data + SET_UP)
    model.pins(start - 100, rst_n=1)
    changes = {begin: {"cs_n": 0, "we_n": 0, "rs": CSR, "d_i": 0}, end: {"cs_n": 1, "we_n": 1}}
    changes.setdefault(edge(data) + 1, {})["d_i"] = ENABLES
    for t in sorted(changes):
        model.pins(t, **changes[t])
    # After the strobe, other data follow immediately.
    model.pins(end, d_i=0)
    model.pins(end + 10, cs_n=0, oe_n=0, rs=CSR)
    model.run_until(end + 20)
    return int(model.outputs["d_o"]) & ENABLES


def phases(clk_hz: int) -> list[Fraction]:
    """Return times from a clock edge to the data change; the second one is the worst case."""
    period = Fraction(10**9, clk_hz)
    return [Fraction(0), Fraction(1, 10**9), *(period * n / 8 for n in range(1, 8))]


@pytest.mark.parametrize(("offset", "taken"), [(-1, False), (0, True), (1, True)])
def test_least_clock(offset: int, taken: bool) -> None:
    """With a clock of LEAST Hz, the written byte is correct at each phase of the clock; with 1 Hz less it is
    not.
    """
    clk_hz = LEAST + offset
    found = [written(clk_hz, phase) for phase in phases(clk_hz)]
    assert (set(found) == {ENABLES}) == taken, found


def test_the_figure_is_printed() -> None:
    """The ruling and the guide for replacement contain this bound."""
    figure = f"{math.ceil(LEAST / 10**5) / 10:.1f} MHz"
    for name in ("rulings.md", "replace.md"):
        text = (project.ROOT / "docs" / "ppmc312" / name).read_text(encoding="utf-8")
        assert f"max(3 / {STROBE} ns, 2 / {SET_UP} ns)" in text and figure in text
