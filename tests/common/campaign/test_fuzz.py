"""`make fuzz`: streams of characters, agreement of RTL and golden models, detection of differences."""

from __future__ import annotations

import random
import re
from array import array
from collections import Counter
from dataclasses import replace

import pytest

from cocotb_tests.harness.paths import ROOT
from scripts.measure.fuzz import bench
from scripts.measure.fuzz.lines import LINES, Events, Line
from scripts.measure.fuzz.words import BROKEN, SILENCE, stream

SIZE = 30_000
OUTCOMES = {
    "bridge": {(1, None), *((2, nak) for nak in (1, 2, 3, 4, 5, 6, 8))},
    "pmc006": {(1, None)},
    "ppmc312": {(1, None), (2, None), (3, None), (4, None)},
    "ppmc312-chars": {(1, None), (2, None), (3, None), (4, None)},
}
"""Line -> kinds of events that its streams must produce; each NAK number of the bridge is a separate kind."""
BROKEN_RTL = {
    "bridge": (
        "rtl/host/ppmc_bridge_rx.sv",
        "if (escaped_q) fault = NakAbort;",
        "if (1'b0) fault = NakAbort;",
    ),
    "pmc006": ("rtl/pmc006/front/pmc006_frame.sv", "else if (error_i) index_q <= '0;", ""),
    "ppmc312": (
        "rtl/ppmc312/front/ppmc312_serial_rx.sv",
        "if (error_i) state_q <= StSkip;",
        "if (1'b0) state_q <= StSkip;",
    ),
}
each = pytest.mark.parametrize("name", LINES)


def words_of(name: str, seed: int = 1) -> array[int]:
    line = LINES[name]
    return stream(random.Random(f"{name} {seed}"), SIZE, line.good, line.special)


@each
def test_streams_are_rich(name: str) -> None:
    """A stream produces every kind of event often, and contains pauses and damaged characters."""
    words = words_of(name)
    kinds = Counter(
        (what >> 56, what & 0xFF if name == "bridge" and what >> 56 == 2 else None)
        for _, what in LINES[name].expected(words)
    )
    assert set(kinds) == OUTCOMES[name] and min(kinds.values()) >= 10, kinds
    for mark in (BROKEN, SILENCE):
        assert sum(1 for word in words if word & mark) > SIZE // 1000


@each
def test_as_the_golden_model(name: str) -> None:
    """For the same stream, RTL and golden model produce the same events at the same characters."""
    assert bench.difference(name, LINES[name], words_of(name)) is None


def test_what_differs_is_told_in_few_words() -> None:
    """If the model omits one instruction, this is detected, and a few characters are enough to
    reproduce it.
    """
    line = LINES["pmc006"]

    def forgetful(words: array[int]) -> Events:
        return (event for event in line.expected(words) if event[1] >> 48 & 0xFF != 0x42)

    bent: Line = replace(line, expected=forgetful)
    words = words_of("pmc006")
    assert bench.difference("pmc006", bent, words) is not None
    told = bench.shrink_report("pmc006", bent, words)
    characters = re.fullmatch(r"pmc006: ([0-9a-f ]+): expected .*, the RTL has 0142[0-9a-f]{12} at \d+", told)
    assert characters and len(characters[1].split()) == 8, told


@pytest.mark.parametrize("name", BROKEN_RTL)
def test_a_fault_of_the_rtl_is_found(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """If one line of a deframer is changed, its events differ from those of the golden model."""
    file, good, bad = BROKEN_RTL[name]
    text = (ROOT / file).read_text(encoding="utf-8")
    assert text.count(good) == 1
    wrong = bench.SIM_BUILDS / f"fuzz-wrong-{name}.sv"
    wrong.parent.mkdir(parents=True, exist_ok=True)
    wrong.write_text(text.replace(good, bad), encoding="utf-8")
    every = bench.files(LINES[name].group)
    monkeypatch.setattr(bench, "files", lambda group: [wrong if p == ROOT / file else p for p in every])
    bench.program.cache_clear()
    try:
        assert bench.difference(name, LINES[name], words_of(name)) is not None
    finally:
        bench.program.cache_clear()
