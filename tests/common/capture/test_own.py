"""VCDs of our own cores, which contain the name of the device and its parameters, and advice for files
without them.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from openppmc.capture.common.compare import clock_ratio, compare
from openppmc.capture.common.decoding import decode
from openppmc.capture.common.errors import CaptureError
from openppmc.capture.common.files import read_capture
from openppmc.capture.common.pinmap import PinMap
from openppmc.capture.common.signals import US
from openppmc.capture.common.vcd_file import core_comment
from openppmc.capture.stmc.mnemonics import StmcDecoder

from ..cli.command_line import Run
from .analyser import Seen, probe, write_vcd
from .sessions import CLK_HZ
from .test_compare import PARTS, session

PORT = ""
"""Port for the command line, which opens no board here."""
CORE = {"CLK_HZ": CLK_HZ, "XTAL_HZ": 16_000_000, "TIMING": "FAST"}


def test_nothing_has_to_be_named(run: Run, tmp_path: Path) -> None:
    """For a VCD that names device and parameters, the command line needs neither."""
    path = write_vcd(probe(session("pmc006"), rate=1e12), tmp_path / "own.vcd", core_comment("pmc006", CORE))
    out = run("decode", str(path), "--compare", "--tolerance", "0.2").out
    assert "a PMC006B4" in out and "(FAST), 0 differences" in out


@pytest.mark.parametrize("part", PARTS)
def test_the_file_tells_the_clock(part: str, tmp_path: Path) -> None:
    """If the VCD states the correct device and clock frequency, no edge differs; with a wrong clock frequency
    of a PMC006B4, edges differ.
    """
    seen = probe(session(part), rate=1e12)
    path = write_vcd(seen, tmp_path / "own.vcd", core_comment(part, CORE))
    result = compare(decode(read_capture(path), PinMap()), US)
    assert not result.differences and result.compared > 100 and result.worst <= US // 10
    if part == "pmc006":
        path = write_vcd(seen, tmp_path / "own.vcd", core_comment(part, CORE | {"CLK_HZ": 8_000_000}))
        assert compare(decode(read_capture(path), PinMap()), US).differences


def test_options_go_before_the_file(tmp_path: Path) -> None:
    """A TIMING in the map and a device on the command line have precedence over those in the file."""
    path = write_vcd(probe(session("stmc")), tmp_path / "own.vcd", core_comment("stmc", CORE))
    assert decode(read_capture(path), PinMap(timing="DATASHEET")).timing == "DATASHEET"
    other = decode(read_capture(path), PinMap(), "ppmc104")
    assert other.timing == "DATASHEET" and "CLK_HZ" not in other.wires.params


@pytest.mark.parametrize(
    "comment",
    [
        "openppmc {",
        "openppmc []",
        'openppmc {"part": "ppmc104"}',
        'openppmc {"part": "ppmc104", "parameters": 1}',
        'openppmc {"part": "ppmc104", "parameters": {"XTAL_HZ": "x"}}',
        'openppmc {"part": "ppmc104", "parameters": {"TIMING": "SLOW"}}',
    ],
)
def test_damaged_comments(comment: str, tmp_path: Path) -> None:
    """If the comment with device and parameters cannot be read, one line states this with advice."""
    path = write_vcd(probe(session("ppmc104")), tmp_path / "own.vcd", comment)
    with pytest.raises(CaptureError, match="own.vcd: its comment .* is damaged: take it out"):
        read_capture(path)


@pytest.mark.parametrize(
    ("part", "named", "says"),
    [
        ("stmc", "j105_stmc", "--part ppmc104 or --part stmc"),
        ("ppmc2104", "ppmc104", "--part ppmc2104"),
        ("pmc006", "ppmc104", "--part ppmc312-serial or --part pmc006"),
    ],
)
def test_pins_of_another_part(part: str, named: str, says: str, run: Run, tmp_path: Path) -> None:
    """If the file is from another device, the error names the devices whose pins it has."""
    path = write_vcd(probe(session(part)), tmp_path / "other.vcd")
    outcome = run("decode", str(path), "--part", named)
    assert outcome.code == 1
    assert outcome.err.splitlines()[-1].endswith(f"; it has the pins of another part: {says}")


@pytest.mark.parametrize("part", ["ppmc104", "ppmc2104"])
def test_the_other_timing(part: str, run: Run, tmp_path: Path) -> None:
    """If a FAST core is compared with the DATASHEET model, one line names the TIMING that matches. If no
    TIMING matches, there is no such line.
    """
    comment = core_comment(part, CORE | {"TIMING": "DATASHEET"})
    path = write_vcd(probe(session(part)), tmp_path / "own.vcd", comment)
    outcome = run("decode", str(path), "--compare")
    assert outcome.code == 1 and "with --timing FAST: 0 differences" in outcome.err + outcome.out
    outcome = run("decode", str(path), "--compare", "--timing", "FAST")
    assert outcome.code == 0 and "with --timing" not in outcome.err + outcome.out


def test_stations_in_scopes(run: Run, tmp_path: Path) -> None:
    """If a file has two stations, the first is read, or the station that --scope names.

    If the scope does not exist, the error lists the existing scopes.
    """
    seen = probe(session("ppmc312-serial"), rate=1e12)
    idle = {f"station0.{name}": (level, []) for name, (level, _) in seen.wires.items() if name != "rxd"}
    idle["station0.rxd"] = seen.wires["rxd"]
    mine = {f"station3.{name}": wire for name, wire in seen.wires.items()}
    both = Seen({**idle, **mine}, seen.end, seen.step)
    path = write_vcd(both, tmp_path / "line.vcd", core_comment("ppmc312-serial", CORE))
    assert not decode(read_capture(path), PinMap()).moves
    out = run("decode", str(path), "--scope", "station3", "--compare").out
    assert "(FAST), 0 differences" in out
    outcome = run("decode", str(path), "--scope", "station9")
    assert outcome.code == 1
    assert "line.vcd: no scope station9 in it (there are station0, station3)" in outcome.err


def test_what_a_switch_ended_tells_no_crystal() -> None:
    """The estimate of the crystal frequency ignores a move that a switch ended 50 µs late.

    If all other moves are 60 ppm longer than expected, the estimated deviation is 60 ppm.
    """
    long, slack = 300_000 * US, US // 4
    assert clock_ratio([(long, long)] * 3 + [(long, long + 50 * US)], slack) == 1.0
    fast = [(length, round(length * (1 + 60e-6))) for length in (long, long // 2, long // 3)]
    assert abs(clock_ratio([*fast, (long, long + 90 * US)], slack) - 1 - 60e-6) < 1e-7
    assert clock_ratio([], slack) == 1.0


@pytest.mark.parametrize("read_map", ["FAMILY", "SHEET"])
def test_words_of_an_stmc_follow_its_read_map(read_map: str) -> None:
    """The decoder names the reads of an STMC according to its READ_MAP (R-01)."""
    words = StmcDecoder(read_map)
    names = [words.command(code, ()) for code in (0x80, 0x81, 0x82, 0x83, 0x84)]
    reads = ["read finish status", "read inputs", "read outputs", "read remaining steps"]
    assert names == ([*reads, "command 84"] if read_map == "FAMILY" else [reads[0], "command 81", *reads[1:]])
    assert words.answer(0x83, [4, 3, 2] if read_map == "FAMILY" else [0xC4], False) == (
        "131844 steps not made" if read_map == "FAMILY" else "S1 S2 high, HOLD high, CW"
    )
