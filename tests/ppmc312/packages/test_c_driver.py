"""The C driver of the PPMC-312 on the Verilated part: on its parallel bus, and as a station of a line."""

from __future__ import annotations

import pytest

from cocotb_tests.harness import F8
from cocotb_tests.harness.build import part_design
from tests.common.packages.c_programs import BENCH, DRIVER, TIMINGS, Lines, pulses, result, simulate, timed

pytestmark = pytest.mark.xdist_group("cdriver_312")  # one worker builds and runs the programs

OK, BAD_ARGUMENT, UNCONFIRMED, UNKNOWN_POSITION, BAD_REPLY = 0, 18, 19, 20, 21
PARAMETER, STATE, LIMIT, FULL, BUS_ONLY = 64, 65, 66, 70, 71
NORMAL, ORIGIN, SLOWLY, STOP, SWITCH, ALARM = 0x40, 0x20, 0x08, 0x04, 0x01, 0x80
TICK = 1
"""Cycles of a tick at a clock of 8 MHz."""


@pytest.fixture(scope="module", params=TIMINGS)
def lines(request) -> Lines:
    """Return the lines of tb/cdriver/block_test.c: first words -> its lines, each as name -> value."""
    sources = [DRIVER / "ppmc104.c", DRIVER / "ppmc312.c", BENCH / "block_test.c", BENCH / "block_bus.cpp"]
    design = part_design("ppmc312", F8)
    params = ("-GCLK_HZ=8000000", timed(request.param))
    return simulate(f"cdriver_312_{request.param.lower()}", "ppmc312", design, sources, params)


both = pytest.mark.parametrize("way", ["bus", "line"])


def end(lines: Lines, name: str) -> tuple[int, int, int, int]:
    """Return (result, cause, complete, position) of a wait."""
    line = next(line for line in lines[name] if "wait" in line)
    return int(line["wait"]), int(line["cause"], 16), int(line["complete"]), int(line["position"])


def position(lines: Lines, name: str) -> tuple[int, int]:
    """Return (result, position) of a line."""
    return int(lines[name][0]["result"]), int(lines[name][0]["position"])


def reports(lines: Lines, name: str) -> list[tuple[int, int, int]]:
    """Return (source, code, first data byte) of the reports of a line."""
    return [
        (int(line["source"], 16), int(line["code"], 16), int(line["data"], 16))
        for line in lines.get(name, [])
        if "source" in line
    ]


@both
def test_open(lines, way):
    """If the part responds, its version is returned (P312-CMD-40)."""
    assert result(lines, f"{way} open") == (OK, "ok")
    assert lines[f"{way} version"][0]["byte"] == "12"


@both
@pytest.mark.parametrize(
    ("name", "cw", "ccw", "at"),
    [("move", 3000, 0, 3100), ("constant", 0, 40, 3060), ("to", 0, 2060, 1000), ("step", 1, 0, 1001)],
)
def test_motion(lines, way, name, cw, ccw, at):
    """A motion makes the commanded pulses in the commanded direction, and its end is confirmed
    (P312-CMD-82).
    """
    assert result(lines, f"{way} {name}")[0] == OK
    assert pulses(lines, f"{way} {name}")[:2] == (cw, ccw)
    assert end(lines, f"{way} {name}") == (OK, NORMAL, 1, at)


@both
def test_rates(lines, way):
    """The intervals are those of the table: the start rate at both ends, the high rate in the middle
    (P312-TBL-01).
    """
    got = pulses(lines, f"{way} move")[2]
    assert (got[0], min(got), max(got)) == (250 * TICK, 50 * TICK, 250 * TICK)
    assert pulses(lines, f"{way} constant")[2] == [200 * TICK] * 39


@both
def test_positions(lines, way):
    """A position is unknown until it is set while a table is active (P312-CMD-43)."""
    assert position(lines, f"{way} unknown")[0] == result(lines, f"{way} unknown to")[0] == UNKNOWN_POSITION
    assert result(lines, f"{way} early zero")[0] == STATE
    assert position(lines, f"{way} after move") == (OK, 3100)
    assert position(lines, f"{way} after step") == (OK, 1001)
    assert result(lines, f"{way} there")[0] == BAD_ARGUMENT


@both
def test_tables(lines, way):
    """The part rejects a ramp with too few pulses; it accepts sigmoid and linear ramps."""
    assert result(lines, f"{way} short ramp")[0] == PARAMETER
    assert result(lines, f"{way} sigmoid")[0] == result(lines, f"{way} table")[0] == OK


@both
def test_changes_and_stops(lines, way):
    """In a motion, the rate can be changed, and a stop can be immediate or at a position (P312-CMD-80,
    P312-CMD-87).
    """
    for name in ("run", "change", "faster", "stop there", "run to", "jog"):
        assert result(lines, f"{way} {name}")[0] == OK, name
    assert end(lines, f"{way} slowly")[:3] == (OK, SLOWLY, 0)
    got = pulses(lines, f"{way} slowly")[2]
    assert {200 * TICK, 100 * TICK, 60 * TICK} <= set(got)
    assert end(lines, f"{way} run to") == (OK, STOP, 0, 8000)
    assert end(lines, f"{way} stop")[:3] == (OK, STOP, 0)
    executed = 0x80 if way == "bus" else 0xE8
    assert (0x1B, executed) in [row[:2] for row in reports(lines, f"{way} override")]


@both
def test_events(lines, way):
    """An edge of an event pin executes the registered instruction, and a report confirms this
    (P312-EVT-01).
    """
    assert result(lines, f"{way} event")[0] == result(lines, f"{way} event move")[0] == OK
    assert [row[:2] for row in reports(lines, f"{way} event 0")] == [(0x0B, 0x26 if way == "bus" else 0xE8)]
    assert lines[f"{way} outputs"][0]["pins"] == "3e"
    assert pulses(lines, f"{way} event 1")[:2] == (12, 0)
    codes = [row[:2] for row in reports(lines, f"{way} event 1")]
    assert sorted(codes) == [(0x0B, 0x83 if way == "bus" else 0xE8), (0x23, 0xE0)]
    assert [line["result"] for line in lines[f"{way} delete"]] == ["0", "0"]
    assert result(lines, f"{way} nothing to delete")[0] == FULL


@both
@pytest.mark.parametrize(("name", "cause"), [("fl", SWITCH), ("search", ORIGIN), ("alarm", ALARM)])
def test_switches(lines, way, name, cause):
    """If a switch or the alarm ends a motion, the cause is reported, and the position agrees
    (P312-INP-12).
    """
    value, got, complete, _ = end(lines, f"{way} {name}")
    assert (value, got, complete) == (OK, cause, int(cause == ORIGIN))


@both
def test_limit_alarm_and_run(lines, way):
    """A limit rejects a start, the alarm state must be cleared, and a low RUN holds a motion before its
    start.

    P312-INP-11, P312-INP-20, P312-INP-33.
    """
    assert result(lines, f"{way} fl ahead")[0] == LIMIT
    assert result(lines, f"{way} in alarm")[0] == STATE
    assert (0x23, 0xF4, 0) in reports(lines, f"{way} alarm report")
    assert end(lines, f"{way} after clear")[:3] == (OK, NORMAL, 1)
    assert pulses(lines, f"{way} held before")[:2] == (0, 0)
    assert end(lines, f"{way} held")[:3] == (OK, NORMAL, 1)


@both
def test_other_instructions(lines, way):
    """Instructions without a motion are accepted, and the reads return the levels of the pins."""
    named = [name for name in lines if name.startswith(f"{way} O ")]
    assert len(named) == 13
    assert {result(lines, name)[0] for name in named} == {OK}
    levels = lines[f"{way} levels"][0]
    assert (levels["inputs"], levels["state"]) == ("3c", "02")
    assert position(lines, f"{way} encoder") == (OK, -5)


@both
def test_bad_arguments(lines, way):
    """For a value out of range, the driver returns an error and sends nothing."""
    named = [name for name in lines if name.startswith(f"{way} A ")]
    assert len(named) == 21
    assert {result(lines, name)[0] for name in named} == {BAD_ARGUMENT}
    assert pulses(lines, f"{way} A")[:2] == (0, 0)


def test_only_on_the_bus(lines):
    """Separate decelerations, free curves and motions that wait for an event exist only on the bus."""
    for name in ("separate", "curve", "move", "event move"):
        assert result(lines, f"bus B {name}")[0] == OK, name
    assert end(lines, "bus B move")[:3] == (OK, NORMAL, 1)
    got = pulses(lines, "bus B move")[2]
    assert got[:11] == [400 * TICK] * 10 + [200 * TICK]
    assert pulses(lines, "bus B event")[:2] == (8, 0)
    assert result(lines, "line L curve")[0] == BUS_ONLY


@both
def test_reset_in_a_motion(lines, way):
    """If the part is reset in a motion, the end is unconfirmed and the position is unknown (P312-CMD-42)."""
    assert end(lines, f"{way} U move")[0] == UNCONFIRMED
    assert position(lines, f"{way} U where")[0] == UNKNOWN_POSITION
    assert position(lines, f"{way} U rest")[0] == UNKNOWN_POSITION
    assert end(lines, f"{way} U again") == (OK, NORMAL, 1, 550)
    assert position(lines, f"{way} U again where") == (OK, 550)
    assert result(lines, f"{way} U nothing")[0] == STATE


def test_no_part(lines):
    """Without a part, each wait ends with "no part" or a bad reply."""
    assert result(lines, "bus dead")[0] == result(lines, "bus ones")[0] == 17
    assert result(lines, "bus zeros")[0] == BAD_REPLY


def test_damaged_replies(lines):
    """A damaged reply is never accepted as a value, even if its checksum is valid (P312-SER-13)."""
    for name in ("digit", "blind"):
        assert result(lines, f"line L {name}")[0] == OK
        assert lines[f"line L {name}"][1]["position"] == "1234"
    assert result(lines, "line L address")[0] == BAD_REPLY
    assert result(lines, "line L errors")[0] == OK
    assert result(lines, "line L station")[0] == BAD_ARGUMENT
    assert lines["line L absent"][0]["result"] == "16"
