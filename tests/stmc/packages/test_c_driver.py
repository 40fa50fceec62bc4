"""The C driver of the STMC with its port functions, on a simulated ISA bus with a J105 board."""

from __future__ import annotations

from fractions import Fraction

import pytest

from cocotb_tests.harness import F16
from cocotb_tests.harness.build import part_design
from openppmc.model.single.codes import Error
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

pytestmark = pytest.mark.xdist_group("cdriver_stmc")  # one worker builds and runs the programs

INIT = bytes([20, 5, 8, 0])
TICK = 16  # period of the external clock here, in cycles


def gaps(steps: int, divisor: int | None = None, init: bytes = INIT) -> list[int]:
    """Return the expected intervals in cycles of a move with the external clock."""
    return [TICK * rate for rate in predict_move(init, steps, divisor, part="stmc").rates]


@pytest.fixture(scope="module", params=TIMINGS)
def lines(request) -> Lines:
    """Output of tb/cdriver/stmc_test.c: first word(s) -> its lines, each as name -> value."""
    sources = [DRIVER / "ppmc104.c", DRIVER / "stmc.c", BENCH / "stmc_test.c", BENCH / "isa_bus.cpp"]
    # The "external" clock is fast, because every cycle has to be simulated.
    design = part_design("j105_stmc", F16)
    params = ("-GEXT_HZ=1000000", timed(request.param))
    return simulate(f"cdriver_stmc_{request.param.lower()}", "j105_stmc", design, sources, params)


@pytest.mark.parametrize(
    ("name", "count", "divisor", "ccw", "op"),
    [("move", 20, None, 0, 3), ("constant", 5, 7, 1, 4), ("step", 1, 1, 1, 2), ("internal", 4, None, 0, 3)],
)
def test_motion_makes_the_steps_of_the_model(lines, name, count, divisor, ccw, op):
    """The count, the direction and every gap of a motion by the driver equal the predicted values."""
    assert result(lines, name) == (0, "ok")
    want = gaps(count, divisor)
    if name == "internal":
        want = predict_move(INIT, count, part="stmc").intervals
        assert want == [20 * 1280, 12 * 1280, 20 * 1280]
    assert pulses(lines, name) == (0 if ccw else count, count if ccw else 0, want)
    end = ending(lines, name)
    assert (end["raw"], end["op"], end["left"]) == (0x80 | op, op, 0)
    assert not any(end[cause] for cause in ("stopped", "alarm", "limit", "slow"))


def test_both_bytes_of_the_ramp(lines):
    """With a ramp of 259 steps, a short move has the acceleration of this long ramp."""
    assert pulses(lines, "long") == (60, 0, gaps(60, init=bytes([20, 5, 3, 1])))


def test_ports(lines):
    """With the port functions at 3B0h and 3B1h, the part responds, and its registers read as documented."""
    assert result(lines, "probe") == result(lines, "outputs") == result(lines, "inputs") == (0, "ok")
    # Phases 1 and 2 are on, standstill, CW. No switch is active, and the motor is on.
    assert (lines["levels"][0]["out"], lines["levels"][0]["in"]) == ("c4", "cf")


def test_read_codes_are_found_out(lines):
    """The probe detects the read codes of the default map and those of READ_MAP = "SHEET" (R-01)."""
    assert lines["default"][0]["map"] == "1"
    assert result(lines, "sheet probe") == (0, "ok")
    found = lines["sheet"][3]
    assert [line.get("result", "0") for line in lines["sheet"]] == ["0"] * 4
    assert [found[key] for key in ("map", "inputs", "outputs", "left")] == ["0", "02", "03", "40405"]
    assert result(lines, "sheet busy")[0] == Error.NOT_WHILE_BUSY + 1
    assert lines["sheet busy"][1]["map"] == "0"


def test_interrupt(lines):
    """The last step of a move with interrupt asserts IRQ; the last step of a quiet move does not. A read of
    the finish status deasserts IRQ.
    """
    assert lines["irq"][0]["quiet"] == "0" and pulses(lines, "quiet")[0] == 3
    values = lines["irq"][1]
    assert (values["running"], values["steps"], values["raw"], values["lifted"]) == ("0", "12", "83", "1")
    assert result(lines, "service") == (0, "ok")


def test_interrupt_served_after_the_restart(lines):
    """If an interrupt routine runs only during the next motion, its read is rejected; a read after this
    motion deasserts IRQ.
    """
    assert result(lines, "late") == result(lines, "late again") == (0, "ok")
    assert result(lines, "late service")[0] == Error.NOT_WHILE_BUSY + 1
    assert result(lines, "late wait") == (0, "ok")
    values = lines["irq"][2]
    assert (values["late"], values["raw"], values["lifted"]) == ("1", "83", "1")
    assert pulses(lines, "late")[:2] == (6, 4)


@pytest.mark.parametrize(
    ("name", "cause", "bit", "ccw", "inputs"),
    [
        ("l1", "limit", 0x10, 0, 0xC7),
        ("l2", "limit", 0x10, 1, 0xCB),
        ("mon", "alarm", 0x20, 0, 0x8F),
        ("l3", "slow", 0x08, 0, 0xCD),
        ("l4", "slow", 0x08, 1, 0xCE),
    ],
)
def test_switch_ends_the_move(lines, name, cause, bit, ccw, inputs):
    """If a switch becomes active after 30 of 100 steps, cause, remaining count and steps agree with each
    other and with the model.
    """
    end, (cw, back, got) = ending(lines, name), pulses(lines, name)
    # The motion stops immediately, or after the current gap and the eight gaps of the ramp (STMC-DEC-04).
    count = 30 + (9 if cause == "slow" else 0)
    assert (cw, back) == ((0, count) if ccw else (count, 0))
    assert end["raw"] == 0x83 | bit and end[cause] == 1 and end["left"] == 100 - count
    assert sum(end[other] for other in ("stopped", "alarm", "limit", "slow")) == 1
    want = gaps(100)
    assert got == (want[:30] + want[-8:] if cause == "slow" else want[:29])
    assert next(line["inputs"] for line in lines[name] if "inputs" in line) == f"{inputs:02x}"


def test_reference_point_and_stops(lines):
    """A homing motion ends at the reference point; jog and run motions end after a stop. The driver returns
    the cause.
    """
    ends = {name: ending(lines, name) for name in ("home", "there", "jog", "run")}
    assert [end["raw"] for end in ends.values()] == [0x87, 0x87, 0xC5, 0xC6]
    assert pulses(lines, "home") == (0, 7, gaps(7, 10))
    assert pulses(lines, "there") == (0, 0, [])
    assert pulses(lines, "jog") == (9, 0, gaps(9, 10))
    cw, back, got = pulses(lines, "run")
    assert (cw, got) == (0, gaps(100)[: len(got) - 8] + gaps(100)[-8:]) and 34 <= back <= 36
    for name, end in ends.items():
        assert end["left"] + sum(pulses(lines, name)[:2]) == 1 << 24, name


@pytest.mark.parametrize(
    ("name", "number"),
    [
        ("E unknown", Error.UNDEFINED),
        ("E nothing to stop", Error.UNDEFINED),
        ("E busy", Error.NOT_WHILE_BUSY),
        ("E busy probe", Error.NOT_WHILE_BUSY),
        ("E uninitialised", Error.NOT_INITIALISED),
        ("E data", Error.UNASKED_DATA),
        ("E swapped", Error.BAD_RAMP),
        ("E zero", Error.BAD_RAMP),
        ("E data busy", Error.UNASKED_DATA_BUSY),
        ("E decelerating", Error.ALREADY_DECELERATING),
    ],
)
def test_error_number(lines, name, number):
    """If the part rejects a byte, the driver returns the error number plus one, and the matching text."""
    value, text = result(lines, name)
    assert value == number + 1 and text.startswith(f"error {int(number)}: ")
    assert ("divisor" in text) == (number == Error.BAD_RAMP)


def test_errors_disturb_nothing(lines):
    """Bytes that are rejected during a move do not change it; it continues up to its decelerating stop."""
    for name in ("E init", "E start", "E stop slowly"):
        assert result(lines, name) == (0, "ok")
    end, (cw, ccw, got) = ending(lines, "E"), pulses(lines, "E")
    assert end["raw"] == 0xC3 and (cw + end["left"], ccw) == (60, 0)
    assert got == gaps(60)[: len(got) - 8] + gaps(60)[-8:]


@pytest.mark.parametrize("name", ["reset", "reset left"])
def test_reset_in_a_motion(lines, name):
    """If the part is reset in a motion, the end is unconfirmed, not "complete" (STMC-FIN-01)."""
    assert result(lines, f"U {name}") == (19, "the part does not confirm the end of the motion")


def test_bad_arguments(lines):
    """For a value out of range, the driver returns an error and sends no byte."""
    named = [name for name in lines if name.startswith("A ") and "result" in lines[name][0]]
    assert len(named) == 11
    assert {result(lines, name) for name in named} == {(18, "argument out of range")}
    assert pulses(lines, "A")[:2] == (0, 0)


def test_time_out(lines):
    """A wait ends if no device responds, and if a motion takes longer than the wait. The results distinguish
    both cases.
    """
    assert result(lines, "dead ports")[0] == result(lines, "dead init")[0] == 17
    assert result(lines, "short wait")[0] == 16
    assert [line.get("result", "0") for line in lines["again"]] == ["0"] * 5


def test_speeds(lines):
    """For each speed, the driver returns the nearest divisor and the resulting speed, as exact arithmetic
    does.
    """
    good = 0
    for line in lines["speed"]:
        clock, speed = int(line["clock"]), int(line["speed"])
        nearest = int(Fraction(clock, speed) + Fraction(1, 2)) if speed else 0
        legal = 1 <= clock <= 1_000_000 and 5 <= nearest <= 255
        assert int(line["result"]) == (0 if legal else 18), line
        if legal:
            good += 1
            assert int(line["divisor"]) == nearest, line
            assert int(line["milli"]) == 1000 * clock // nearest, line
    assert good > 15
    sheet = {line["speed"]: line["divisor"] for line in lines["speed"] if line["clock"] == "48675"}
    assert (sheet["345"], sheet["825"]) == ("141", "59")
