"""Malformed captures and maps are rejected in one short line, without a traceback or an endless loop."""

from __future__ import annotations

import signal
import zipfile
from collections.abc import Iterator
from pathlib import Path

import pytest

from openppmc.capture.common.decoding import decode
from openppmc.capture.common.errors import CaptureError
from openppmc.capture.common.files import read_capture
from openppmc.capture.common.pinmap import PinMap, read_map

from .analyser import Seen, probe, write_vcd
from .sessions import PinLog
from .test_compare import session

LONGEST_S = 20
MANY = "9" * 5000
"""A number with more digits than Python converts in one call."""
HUGE = "1e999999999"
VCD = """$timescale 1 ns $end
$var wire 1 ! a $end
$enddefinitions $end
#0
0!
#5
1!
"""
SR = "[device 1]\ncapturefile=logic-1\nsamplerate={}\nprobe1=A\nunitsize=1\n"
CSV = "; Samplerate: {} Hz\nA\n0\n1\n"


@pytest.fixture(autouse=True)
def _limit() -> Iterator[None]:
    """Fail a test that does not end in time."""

    def stop(*_: object) -> None:
        raise TimeoutError

    before = signal.signal(signal.SIGALRM, stop)
    signal.alarm(LONGEST_S)
    yield
    signal.alarm(0)
    signal.signal(signal.SIGALRM, before)


def sigrok(path: Path, metadata: str) -> Path:
    """Write a .sr file with these metadata."""
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("metadata", metadata)
        archive.writestr("logic-1-1", b"\0\1" * 50)
    return path


@pytest.mark.parametrize(
    ("name", "text", "says"),
    [
        ("a.csv", CSV.format(HUGE), "neither a column of times nor a sample rate"),
        ("a.csv", CSV.format("1e-999999999"), "neither a column of times nor a sample rate"),
        ("a.csv", CSV.format(MANY), "neither a column of times nor a sample rate"),
        ("a.csv", CSV.format("1e30"), "neither a column of times nor a sample rate"),
        ("a.csv", "Time [s],A\n0," + "1" * 200_000 + "\n1,0\n", "line 2: .* is cut off or no row"),
        ("a.csv", 'Time [s],A\n0,1\n1,"' + "0" * 200_000 + "\n", "line 3: .* is cut off or no row"),
        ("a.csv", "T" * 200_000 + ",A\n0,1\n1,0\n", "neither a column of times"),
        (
            "a.csv",
            f"Time,A\n2026-03-03 10:00:00.1,1\n2026-03-03 10:00:01.{MANY},0\n",
            "line 3: .* is no time",
        ),
        ("a.csv", f"Time,A\n0:00:00.1,1\n{MANY}:00:01,0\n", "line 3: .* is no time"),
        ("a.csv", "Time [ms],A\n0,1\n9999999999999999,0\n", "longer than 50 days"),
        ("a.csv", "Time [s],A\n0,1\n1us,0\n", "line 3: times with and without a unit"),
        ("a.vcd", VCD.replace("1 ns", f"{HUGE} ns"), "line 1: .timescale"),
        ("a.vcd", VCD.replace("1 ns", "1e-999999999 ns"), "line 1: .timescale"),
        ("a.vcd", VCD.replace("1 ns", f"{MANY} ns"), "line 1: .timescale"),
        ("a.vcd", f"{VCD}#{MANY}\n0!\n", "line 8: #9* is no time"),
        ("a.vcd", f"{VCD}#1.{MANY}\n0!\n", r"line 8: #1\.9* is no time"),
        ("a.vcd", VCD.replace("wire 1", f"wire {MANY}"), "line 2: .* is damaged"),
        ("a.vcd", f"$comment openppmc {'[' * 100_000} $end {VCD}", "its comment .* is damaged"),
        ("a.sr", SR.format(HUGE), "no sigrok capture of logic channels"),
        ("a.sr", SR.format("1e-999999999"), "no sigrok capture of logic channels"),
        ("a.sr", SR.format(MANY), "no sigrok capture of logic channels"),
        ("a.sr", SR.format("1 MHz") + f"probe{MANY}=B\n", "no sigrok capture of logic channels"),
    ],
)
def test_malformed_files(name: str, text: str, says: str, tmp_path: Path) -> None:
    """A number that is too long or too large is rejected in one short line."""
    path = tmp_path / name
    if path.suffix == ".sr":
        sigrok(path, text)
    else:
        path.write_text(text)
    with pytest.raises(CaptureError, match=says) as error:
        read_capture(path)
    assert "\n" not in str(error.value) and len(str(error.value)) < 300


def test_a_range_with_many_digits(tmp_path: Path) -> None:
    """A range that is not a number is read as part of the name."""
    (tmp_path / "a.vcd").write_text(VCD.replace("a $end", f"a [{MANY}:0] $end"))
    assert list(read_capture(tmp_path / "a.vcd").channels) == [f"a [{MANY}:0]"]


def test_empty_text(tmp_path: Path) -> None:
    """A text variable may be empty; the levels after it are still read."""
    text = VCD.replace("$enddef", "$var string 1 $ note $end\n$enddef") + "s $\n#9\nshi $\n0!\n#11\ns $ 1!\n"
    (tmp_path / "a.vcd").write_text(text)
    found = read_capture(tmp_path / "a.vcd")
    assert list(found.channels) == ["a"]
    assert found.channels["a"].changes == [(5000, 1), (9000, 0), (11_000, 1)]


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("parameters: 5", "parameters: 5: expected a name and a value for each"),
        ("parameters: [CLK_HZ]", "parameters: .*: expected a name and a value for each"),
        ("parameters: {CLK_HZ: fast}", "CLK_HZ: fast: expected a whole number"),
        ("parameters: {XTAL_HZ: 16 MHz}", "XTAL_HZ: 16 MHz: expected a whole number"),
        ("parameters: {BAUD: -1}", "BAUD: -1: expected a whole number"),
        ("part: [ppmc104]", r"part: \['ppmc104'\]: expected a name"),
        ("part: 5", "part: 5: expected a name"),
    ],
)
def test_malformed_maps(text: str, says: str, tmp_path: Path) -> None:
    """A value of a wrong form is rejected in one line that names it."""
    (tmp_path / "map.yml").write_text(f"pins: {{a0: A0}}\n{text}\n")
    with pytest.raises(CaptureError, match=says):
        read_map(tmp_path / "map.yml")


def host_of_312(*accesses: tuple[str, int, int]) -> Seen:
    """Return accesses to a PPMC-312 as (strobe, rs, byte), 1 µs apart."""
    seen = Seen(step=10_000)
    names = [f"d[{bit}]" for bit in range(8)] + [f"rs[{bit}]" for bit in range(3)]
    seen.wires = {name: (0, []) for name in names} | {name: (1, []) for name in ("cs_n", "we_n", "oe_n")}
    levels = {name: first for name, (first, _) in seen.wires.items()}

    def put(t: int, **changes: int) -> None:
        for name, level in changes.items():
            if levels[name] != level:
                seen.wires[name][1].append((t, level))
                levels[name] = level

    t = 0
    for strobe, register, byte in accesses:
        t += 1_000_000
        values = {f"d[{bit}]": byte >> bit & 1 for bit in range(8)}
        put(t, cs_n=0, **values, **{f"rs[{bit}]": register >> bit & 1 for bit in range(3)}, **{strobe: 0})
        put(t + 399_999, cs_n=1, **{strobe: 1})
    seen.end = t + 1_000_000
    return seen


def test_short_blocks_of_a_312(tmp_path: Path) -> None:
    """A block that is too short for its instruction is decoded to a line that is marked as invalid."""
    words = [("we_n", 3, 0x1F), ("we_n", 5, 0x42), ("we_n", 3, 0x1E), ("we_n", 5, 9), ("we_n", 5, 7)]
    path = write_vcd(host_of_312(*words), tmp_path / "a.vcd")
    found = decode(read_capture(path), PinMap(), "ppmc312")
    assert [line.invalid for line in found.lines] == [True, True]


def test_many_reports_of_a_312(tmp_path: Path) -> None:
    """The decoding time increases linearly with the number of accesses, not with its square."""
    words = [("oe_n", 7, 0)] * 20_000 + [("we_n", 3, 0x1D), *[("we_n", 5, 9)] * 3, ("oe_n", 3, 0x3D)] * 2000
    path = write_vcd(host_of_312(*words), tmp_path / "a.vcd")
    assert len(decode(read_capture(path), PinMap(), "ppmc312").lines) == 2000


def test_a_long_serial_line(tmp_path: Path) -> None:
    """The time to find the baud rate of a line increases linearly with the number of characters."""
    log: PinLog = session("pmc006")
    seen = probe(log, rate=1e7, without=("txd",))
    level, changes = seen.wires["rxd"]
    seen.wires = {"rxd": (level, [(t + n * seen.end, one) for n in range(60) for t, one in changes])}
    seen.end *= 60
    found = decode(read_capture(write_vcd(seen, tmp_path / "a.vcd")), PinMap(), "pmc006")
    assert len(found.lines) == 60 * 8
