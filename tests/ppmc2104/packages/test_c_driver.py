"""The C driver of the PPMC-2104 on the Verilated part, with accesses to its bus."""

from __future__ import annotations

import pytest

from cocotb_tests.harness import F16
from cocotb_tests.harness.build import part_design
from openppmc.model.single.predict import predict_move
from tests.common.packages.c_programs import (
    BENCH,
    DRIVER,
    TIMINGS,
    Lines,
    ending,
    pulses,
    result,
    simulate,
    timed,
)

pytestmark = pytest.mark.xdist_group("cdriver_2104")  # one worker builds and runs the programs

INIT = bytes([99, 49, 10, 0])
OK, BAD_ARGUMENT, UNCONFIRMED, UNKNOWN_POSITION, ERROR = 0, 18, 19, 20, 32
"""ERROR: offset of a result that contains an error number of the part."""


@pytest.fixture(scope="module", params=TIMINGS)
def lines(request) -> Lines:
    """Output of tb/cdriver/axes_test.c: first word(s) -> its lines, each as name -> value."""
    sources = [DRIVER / "ppmc104.c", DRIVER / "ppmc2104.c", BENCH / "axes_test.c", BENCH / "axes_bus.cpp"]
    design = part_design("ppmc2104", F16)
    return simulate(
        f"cdriver_2104_{request.param.lower()}", "ppmc2104", design, sources, (timed(request.param),)
    )


def position(lines: Lines, name: str) -> tuple[int, int]:
    """Return (result, position) of a line."""
    return int(lines[name][0]["result"]), int(lines[name][0]["position"])


@pytest.mark.parametrize(
    ("name", "cw", "ccw", "rate", "raw"),
    [
        ("move", 30, 0, None, 0x83),
        ("constant", 0, 300, 60, 0x84),
        ("to", 0, 40, None, 0x83),
        ("step", 0, 1, 1, 0x82),
        ("first", 25, 0, None, 0x83),
        ("second", 0, 9, 70, 0x84),
        ("one after", 4, 0, None, 0x83),
    ],
)
def test_motion_makes_the_pulses_of_the_model(lines, name, cw, ccw, rate, raw):
    """The count, the direction and every interval of a motion equal those of the model (P2104-RMP-01)."""
    want = predict_move(INIT, cw + ccw, rate, part="ppmc2104").intervals
    assert pulses(lines, name) == (cw, ccw, want)
    assert (ending(lines, name)["raw"], ending(lines, name)["left"]) == (raw, 0)


def test_positions(lines):
    """A position is unknown until it is set; after that, each confirmed motion is counted once."""
    assert position(lines, "unknown")[0] == result(lines, "unknown move")[0] == UNKNOWN_POSITION
    assert position(lines, "moving")[0] == ERROR + 5
    assert position(lines, "after move") == (OK, 30)
    assert position(lines, "after constant") == (OK, 700)
    assert position(lines, "after step") == position(lines, "still") == (OK, -11)
    assert result(lines, "there")[0] == BAD_ARGUMENT


def test_interrupt(lines):
    """int_n falls at the end of a motion and rises when the finish status is read (P2104-INT-01)."""
    assert [lines["irq"][n][key] for n, key in enumerate(("running", "ended", "read"))] == ["0", "1", "0"]


def test_both_axes_start_on_one_edge(lines):
    """Two motions that wait for RUN output their first pulses on the same clock edge (P2104-OPR-02)."""
    assert result(lines, "both")[0] == OK
    begins = [next(line for line in lines[name] if "cw" in line) for name in ("first", "second")]
    assert len({line["at"].split()[0] for line in begins}) == 1


def test_no_axis_starts_if_one_is_rejected(lines):
    """If the second motion is rejected, the first one ends without a pulse (P2104-LIM-06)."""
    assert result(lines, "both busy")[0] == ERROR + 5
    assert result(lines, "both refused")[0] == ERROR + 7
    assert pulses(lines, "none")[:2] == (0, 0)
    assert position(lines, "not moved") == (OK, 14)


@pytest.mark.parametrize(
    ("name", "bit", "inputs"),
    [("fl", 0x10, 0xC7), ("bl", 0x10, 0xCD), ("alm", 0x20, 0x8F), ("fhl", 0x08, 0xCB)],
)
def test_switch_ends_the_move(lines, name, bit, inputs):
    """If a switch ends a move of 100 pulses, cause, remaining count and pulses agree with each other.

    P2104-LIM-03, P2104-LIM-04, P2104-LIM-05.
    """
    end, (cw, ccw, _) = ending(lines, name), pulses(lines, name)
    assert end["raw"] == 0x83 | bit and cw + ccw + end["left"] == 100 and cw + ccw >= 20
    assert next(line["inputs"] for line in lines[name] if "inputs" in line) == f"{inputs:02x}"


def test_origin_and_stops(lines):
    """The origin ends a search, and a stop ends jog and run motions; a decelerating stop of a motion without
    a ramp returns error 8.
    """
    raws = [ending(lines, name)["raw"] for name in ("home", "jog", "run")]
    assert raws == [0x87, 0xC5, 0xC6]
    assert result(lines, "at home")[0] == ERROR + 7
    assert result(lines, "jog slowly")[0] == ERROR + 8
    assert pulses(lines, "jog")[0] in (9, 10)
    assert result(lines, "run slowly")[0] == OK


@pytest.mark.parametrize(
    ("name", "number"),
    [
        ("unknown", 1),
        ("cut by", 3),
        ("uninitialised", 4),
        ("busy", 5),
        ("busy move", 5),
        ("busy off", 5),
        ("standstill", 6),
        ("start", 7),
        ("ramp", 9),
        ("long", 10),
        ("switching", 11),
    ],
)
def test_error_number(lines, name, number):
    """If the part rejects an instruction, the driver returns the error number of the axis and the matching
    text (P2104-ERR-01).
    """
    value, text = result(lines, f"E {name}")
    assert value == ERROR + number and text.startswith(f"error {number}: ")


def test_stop_with_an_unfinished_instruction(lines):
    """A stop takes effect even if it drops an unfinished instruction (P2104-STP-07)."""
    assert result(lines, "E half stop")[0] == OK
    assert ending(lines, "E half")["raw"] == 0xC3


def test_bad_arguments(lines):
    """For a value out of range, the driver returns an error, and no motor moves."""
    named = [name for name in lines if name.startswith("A ") and "result" in lines[name][0]]
    assert len(named) == 12
    assert {result(lines, name)[0] for name in named} == {BAD_ARGUMENT}
    assert pulses(lines, "A after")[:2] == (0, 0)


def test_pins_and_reads(lines):
    """Instructions without a motion are accepted, and the reads return the levels of the pins."""
    for name in ("switching", "hold", "aux", "aux in", "outputs", "off"):
        assert result(lines, f"P {name}") == (OK, "ok"), name
    assert lines["pins"][0]["aux"] == "02"
    assert position(lines, "P off where")[0] == UNKNOWN_POSITION


def test_reset_in_a_motion(lines):
    """If the part is reset in a motion, the end is unconfirmed and the position is unknown (P2104-BAD-23)."""
    assert result(lines, "U reset")[0] == result(lines, "U reset left")[0] == UNCONFIRMED
    assert position(lines, "U where")[0] == UNKNOWN_POSITION
    assert result(lines, "U routine")[0] == result(lines, "U after it")[0] == OK
    assert position(lines, "U six") == (OK, 6)


def test_time_out(lines):
    """A wait ends if the part is missing, and if the motion takes longer than the wait. The results
    distinguish both cases.
    """
    assert result(lines, "dead ones")[0] == 17
    assert result(lines, "dead zeros")[0] == 16
    assert result(lines, "dead held")[0] == 17
    assert result(lines, "dead short")[0] == 16
    for name in ("again", "init", "jog", "stop", "end"):
        assert result(lines, f"dead {name}")[0] == OK, name
