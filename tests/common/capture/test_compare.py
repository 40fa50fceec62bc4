"""Captures of all devices are compared with the golden model: complete, jittery, partial, late and wrong
captures.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from pathlib import Path

import pytest

from openppmc.capture.common.compare import Result, compare
from openppmc.capture.common.decoding import Decoded, decode
from openppmc.capture.common.errors import CaptureError
from openppmc.capture.common.files import read_capture
from openppmc.capture.common.pinmap import PinMap
from openppmc.capture.common.signals import US

from .analyser import Seen, probe, write_saleae, write_sigrok_csv, write_sr, write_vcd
from .sessions import CLK_HZ, SESSIONS, PinLog

PARTS = tuple(SESSIONS)
WRITERS: dict[str, Callable[[Seen, Path], Path]] = {
    "x.vcd": write_vcd,
    "saleae.csv": write_saleae,
    "sigrok.csv": write_sigrok_csv,
    "x.sr": write_sr,
}
CORE = {"CLK_HZ": CLK_HZ}
SHORT = ("mon_step",)
"""Outputs whose pulses are shorter than a sample period; only our core has them, not the original chip."""


@cache
def session(part: str) -> PinLog:
    """Return the session of a device, which is recorded once for all tests."""
    return SESSIONS[part]()


def decoded(part: str, seen: Seen, path: Path, **parameters: object) -> Decoded:
    """Write the record of an analyser to a VCD, and decode this file."""
    chosen = PinMap(timing="FAST", parameters=CORE | parameters)
    return decode(read_capture(write_vcd(seen, path / "capture.vcd")), chosen, part)


def compared(part: str, seen: Seen, path: Path, tolerance: float = 1.0) -> Result:
    """Compare the record with the golden model.

    Args:
        tolerance: largest distance of two edges in µs.
    """
    return compare(decoded(part, seen, path), round(tolerance * US))


@pytest.mark.parametrize("part", PARTS)
def test_whole_captures(part: str, tmp_path: Path) -> None:
    """If each edge is captured at its exact time in ps, no edge differs and no deviation exceeds 0.1 µs."""
    result = compared(part, probe(session(part), rate=1e12), tmp_path)
    assert not result.differences and result.compared > 100
    assert result.worst <= US / 10 and not result.skipped


@pytest.mark.parametrize("part", PARTS)
def test_jitter_and_other_clocks(part: str, tmp_path: Path) -> None:
    """At 24 MS/s, with jitter of 40 ns per edge and an analyser that is 60 ppm slow, no edge differs."""
    seen = probe(session(part), rate=24e6, jitter=40_000, ppm=60, without=SHORT)
    # The crystal frequency of a PMC006B4 cannot be determined from frames alone.
    result = compared(part, seen, tmp_path, 10.0 if part == "pmc006" else 2.0)
    assert not result.differences and result.compared > 100


@pytest.mark.parametrize("part", PARTS)
def test_missing_pins(part: str, tmp_path: Path) -> None:
    """If switches, interrupt and half of the outputs are not connected, the other pins are still compared."""
    gone = ("int_n", "irq_n", "hold", "auxo", "auxo_n", "alm_n", "fl_n", "gpo", "cd_n", "l1_n", "snd", *SHORT)
    seen = probe(session(part), without=gone)
    found = decoded(part, seen, tmp_path)
    assert {pin for pin in gone if pin in found.missing}
    result = compare(found, 2 * US)
    assert not result.differences and result.compared > 50
    assert not {pin.partition("[")[0] for pin in result.pins} & set(gone)


@pytest.mark.parametrize("part", [part for part in PARTS if part != "pmc006"])
def test_captures_that_begin_in_the_middle(part: str, tmp_path: Path) -> None:
    """In a capture that misses the reset, edges are compared from the initialisation on.

    A capture that also misses the initialisation is rejected in one line.
    """
    seen = probe(session(part), begin=42e-6, without=("rst_n",))
    result = compared(part, seen, tmp_path, 10)
    assert not result.differences and result.compared > 100
    late = {"ppmc2104": 0.0061, "ppmc312": 0.0060, "ppmc312-serial": 0.012}.get(part, 0.003)
    with pytest.raises(CaptureError, match="neither a reset nor an initialisation"):
        compared(part, probe(session(part), begin=late, without=("rst_n",)), tmp_path)


def test_frames_from_the_middle(tmp_path: Path) -> None:
    """If the capture of a PMC006B4 line begins in the middle, the frames after that are decoded."""
    found = decoded("pmc006", probe(session("pmc006"), begin=0.1, without=SHORT), tmp_path)
    assert "to controller 255: 8 microsteps" in [line.text for line in found.lines]


@pytest.mark.parametrize("part", PARTS)
def test_a_glitch(part: str, tmp_path: Path) -> None:
    """A spike of 10 ns on a strobe or an output is ignored and counted."""
    seen = probe(session(part), rate=100e6, without=SHORT)
    names = ("wr_n", "ds_wrs_n", "we_n", "rxd", "pout_n", "pout_n[1]", "pout", "s[2]", "txd")
    spoiled = [name for name in names if name in seen.wires and len(seen.wires[name][1]) > 1]
    for name in spoiled:
        _, changes = seen.wires[name]
        gap = max(range(len(changes) - 1), key=lambda n: changes[n + 1][0] - changes[n][0])
        t, level = (changes[gap][0] + changes[gap + 1][0]) // 2, changes[gap][1]
        changes[gap + 1 : gap + 1] = [(t, 1 - level), (t + 10_000, level)]
    found = decoded(part, seen, tmp_path)
    assert sum(found.glitches.values()) == len(spoiled) >= 2
    assert not compare(found, 2 * US).differences


@pytest.mark.parametrize(
    ("part", "pin"),
    [
        ("ppmc104", "pout_n"),
        ("ppmc2104", "pout_n[2]"),
        ("stmc", "s[3]"),
        ("ppmc312", "pout"),
        ("ppmc312-serial", "txd"),
    ],
)
def test_a_chip_that_differs(part: str, pin: str, tmp_path: Path) -> None:
    """A missing pulse and an edge that is 20 µs late are reported, and no other difference is."""
    seen = probe(session(part), without=SHORT)
    level, changes = seen.wires[pin]
    at = len(changes) // 2
    missing = changes[at : at + 2]
    last = changes[-1]
    seen.wires[pin] = (level, [*changes[:at], *changes[at + 2 : -1], (last[0] + 20 * US, last[1])])
    result = compared(part, seen, tmp_path, 2.0)
    assert [(one.pin, one.chip) for one in result.differences] == [(pin, False)] * 3 + [(pin, True)]
    assert abs(result.differences[0].t - missing[0][0]) < US


@pytest.mark.parametrize("name", WRITERS)
def test_files_of_all_analysers(name: str, tmp_path: Path) -> None:
    """If the same samples are stored in four formats, they are decoded to the same session."""
    seen = probe(session("ppmc104"), rate=8e6, jitter=30_000, until=0.045)
    chosen = PinMap(timing="FAST", parameters=CORE)
    found = decode(read_capture(WRITERS[name](seen, tmp_path / name)), chosen, "ppmc104")
    assert [line.text for line in found.lines][1] == "accelerate/decelerate, CW, 200 pulses → BUSY"
    assert [(one.pulses, one.way) for one in found.moves] == [(200, 1), (30, -1)]
    result = compare(found, 2 * US)
    assert not result.differences and result.compared > 400


def test_another_crystal(tmp_path: Path) -> None:
    """If the crystal of the chip deviates by 60 ppm from the analyser's clock, the result states this within
    5 ppm.
    """
    result = compared("ppmc312", probe(session("ppmc312"), ppm=60), tmp_path, 2.0)
    assert abs(result.ppm - 60) < 5
