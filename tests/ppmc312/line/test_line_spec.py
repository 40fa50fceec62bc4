"""The options of a virtual line, and how several stations on it affect each other."""

from __future__ import annotations

import doctest

import pytest

from openppmc.host.ppmc312.line import line as errors
from openppmc.host.ppmc312.line import station_link
from openppmc.host.ppmc312.line import wire as ascii
from openppmc.host.ppmc312.line.wire import frame
from openppmc.sim import part_of
from openppmc.sim.common import lines
from openppmc.sim.ppmc312 import line as spec
from openppmc.sim.ppmc312.line import PART, StationLine, parse_line


def test_words() -> None:
    spec = parse_line("stations=2..4,start=50,cw=900,cw3=800,block4=70,sum=chars,speed=max,baud=38400")
    assert list(spec.plants) == [2, 3, 4] and {plant.start for plant in spec.plants.values()} == {50}
    assert [plant.cw for plant in spec.plants.values()] == [900, 800, 900]
    assert spec.plants[4].block == 70 and spec.plants[2].block is None
    assert (spec.sum_mode, spec.speed, spec.baud, spec.twin) == ("CHARS", None, 38_400, None)
    assert len(parse_line("").plants) == 16 and len(parse_line("stations=3").plants) == 3
    twin = parse_line("stations=3,twin=1,start1=7").twin
    assert twin is not None and twin[0] == 1 and twin[1].start == 4000
    assert part_of("start=3, part=ppmc312-serial") == PART and part_of("") is None


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("x=1", "unknown word 'x'"),
        ("start", "not of the form"),
        ("stations=0", "a number from 1 to 16"),
        ("stations=4..2", "a number from 1 to 16"),
        ("stations=2..16", "a number from 1 to 16"),
        ("stations=two", "a number from 1 to 16"),
        ("stations=3,start7=5", "there is no station 7"),
        ("start16=5", "numbers from 0 to 15"),
        ("cw=1,ccw=5", "must lie above"),
        ("cw3=none", "not a whole number"),
        ("alarm=5", "alarm=100..200"),
        ("baud=9600", "there are 19200, 38400, 83333"),
        ("sum=odd", "there are BINARY, CHARS"),
        ("echo=1", "there are on, off"),
        ("timing=slow", "there are FAST, DATASHEET"),
        ("speed=-1", "a positive number"),
        ("unplug=soon", "a positive number"),
        ("clk=5", "expected 8000000 to"),
        ("noise=-4", "expected 0 to"),
        ("twin=9,stations=3", "no station 9 to share"),
        ("part=ppmc104", "a line has part=ppmc312-serial"),
    ],
)
def test_bad_words(text: str, says: str) -> None:
    with pytest.raises(ValueError, match=says):
        parse_line(text)


def heard(text: str, *frames: str) -> bytes:
    """Return the reply to these frames; after each frame the line is idle for 10 ms."""
    line = StationLine(parse_line("baud=83333," + text))
    line.run(1000)
    for wire in frames:
        line.write(bytes.fromhex(wire))
        line.run(160_000)
    return line.read()


def test_stations_answer_only_their_own_frames() -> None:
    assert heard("stations=3", "91 34 31 2D").hex(" ").upper() == "A1 31 32 4C"
    assert heard("stations=3", "93 34 31 2B") == b""
    # A control code for another station makes the station discard a partial frame.
    assert heard("stations=3", "91 34 82 7D 31 2D").hex(" ").upper() == "92 6D"


def test_replies_of_two_stations_collide() -> None:
    """If two stations reply at the same time, equal replies are received; different ones are garbled."""
    text = "stations=2,start1=-10,twin=1"
    assert heard(text, "91 34 31 2D").hex(" ").upper() == "A1 31 32 4C"
    one, other = (heard(f"stations=2,start1={start}", "91 32 37 47") for start in (-10, 4000))
    both = heard(text, "91 32 37 47")
    assert one != other and both == bytes(a & b for a, b in zip(one, other, strict=True))


def test_stations_run_while_others_are_asked() -> None:
    """A read of a station's state first runs the station up to the time of the line, even if it receives no
    frames.
    """
    line = StationLine(parse_line("stations=2,clk=16000000"))
    line.run(1000)
    for data in ("0001" + "03e8" + "00c8" + "0007d0", "85" + "03e8"):
        line.write(frame(0x90, bytes.fromhex(data)))
        line.run(320_000)
    line.write(frame(0x91, b"\x42"))
    line.run(16_000_000)
    assert line.stations[0].position < 4100 and 5010 < line.station(0).position < 5030


def test_the_master_hears_itself_if_asked_for() -> None:
    assert heard("stations=1,echo=on", "80 7F").hex(" ").upper() == "80 7F 90 6F"


@pytest.mark.parametrize("module", [ascii, errors, station_link, lines, spec])
def test_examples_in_the_code(module: object) -> None:
    failed, attempted = doctest.testmod(module)  # type: ignore[arg-type]
    assert attempted and not failed
