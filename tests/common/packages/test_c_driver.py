"""The C driver compiles without warnings and behaves on the simulated bus as the golden model predicts."""

from __future__ import annotations

import re
from dataclasses import replace
from fractions import Fraction

import pytest

from cocotb_tests.harness import F16
from cocotb_tests.harness.build import part_design
from cocotb_tests.harness.paths import ROOT, relative
from openppmc.model.single.codes import Error
from openppmc.model.single.predict import predict_move
from tests.common.packages.c_programs import (
    BENCH,
    C99,
    DRIVER,
    TIMINGS,
    WARNINGS,
    Lines,
    compilations,
    ending,
    pulses,
    result,
    run,
    simulate,
    timed,
)

pytestmark = pytest.mark.xdist_group("cdriver")  # one worker builds and runs the programs

TOP = "ppmc104_example_wishbone"
INIT = bytes([59, 39, 6, 0])


@pytest.mark.parametrize(("compiler", "source"), compilations())
def test_compiles_without_a_warning(compiler, source, tmp_path):
    """With all warnings as errors, driver and examples compile without any output."""
    assert run(*compiler, *WARNINGS, "-c", relative(source), "-o", tmp_path / "out.o") == ""


def test_example_of_the_manual_compiles(tmp_path):
    """The C program in docs/integration.md compiles and links with the driver."""
    found = re.findall(r"^```c\n(.*?)^```$", (ROOT / "docs" / "integration.md").read_text(), re.S | re.M)
    assert len(found) == 1
    source = tmp_path / "example.c"
    source.write_text(found[0])
    driver = DRIVER / "ppmc104.c"
    assert run(*C99, "-Wall", "-Werror", f"-I{DRIVER}", source, driver, "-o", tmp_path / "example") == ""


@pytest.fixture(scope="module", params=TIMINGS)
def lines(request) -> Lines:
    """Return the output of tb/cdriver/driver_test.c: first word(s) -> its lines, each as name -> value."""
    design = part_design("ppmc104", F16)
    design = replace(design, sources=[*design.sources, ROOT / "packages" / "templates" / f"{TOP}.sv"])
    sources = [DRIVER / "ppmc104.c", BENCH / "driver_test.c", BENCH / "sim_bus.cpp"]
    return simulate(f"cdriver_{request.param.lower()}", TOP, design, sources, (timed(request.param),))


@pytest.mark.parametrize(
    ("name", "count", "rate", "ccw", "op"),
    [("move", 30, None, 0, 3), ("constant", 300, 24, 1, 4), ("quiet", 12, None, 0, 3), ("step", 1, 0, 1, 2)],
)
def test_operation_gives_the_pulses_of_the_model(lines, name, count, rate, ccw, op):
    """For each operation of the driver, count, direction and every interval of the pulses are the predicted
    ones.
    """
    assert result(lines, name) == (0, "ok")
    assert pulses(lines, name) == (
        0 if ccw else count,
        count if ccw else 0,
        predict_move(INIT, count, rate).intervals,
    )
    end = ending(lines, name)
    assert end["raw"] == 0x80 | op and end["op"] == op and end["ended"] and end["left"] == 0
    assert not any(end[cause] for cause in ("stopped", "alarm", "limit", "slow"))


def test_interrupt(lines):
    """The bridge register reports the interrupt of a move only from its end to the read of the finish
    status.
    """
    assert [lines["irq"][0][key] for key in ("running", "ended", "pin")] == ["0", "1", "1"]
    assert [lines["irq"][1][key] for key in ("read", "pin")] == ["0", "0"]
    assert lines["quiet"][1]["irq"] == "0"


@pytest.mark.parametrize(
    ("name", "cause", "bit", "ccw", "inputs"),
    [
        ("l1", "limit", 0x10, 0, 0xC7),
        ("l2", "limit", 0x10, 1, 0xCB),
        ("alm", "alarm", 0x20, 0, 0x8F),
        ("l3", "slow", 0x08, 0, 0xCD),
        ("l4", "slow", 0x08, 1, 0xCE),
    ],
)
def test_switch_ends_the_move(lines, name, cause, bit, ccw, inputs):
    """If a switch ends a move of 100 pulses, cause, remaining count and pulses agree with each other and with
    the model.
    """
    end, (cw, ccw_count, got) = ending(lines, name), pulses(lines, name)
    count = ccw_count if ccw else cw
    assert end["raw"] == 0x83 | bit and end[cause] == 1
    assert sum(end[other] for other in ("stopped", "alarm", "limit", "slow")) == 1
    assert count + end["left"] == 100 and (cw == 0 or ccw_count == 0)
    want = predict_move(INIT, 100).intervals
    if cause == "slow":
        # After the switch, the current interval ends; then there is one interval for each step of the ramp.
        assert 20 + 6 <= count <= 20 + 7
        assert got == want[: len(got) - 6] + want[-6:]
    else:
        assert 20 <= count <= 21
        assert got == want[: len(got)]
    assert next(line["inputs"] for line in lines[name] if "inputs" in line) == f"{inputs:02x}"


def test_one_pulse_left(lines):
    """After a limit just before the last pulse, the driver returns that one pulse remains, not 0."""
    end = ending(lines, "late")
    assert (end["raw"], end["left"], pulses(lines, "late")[0]) == (0x93, 1, 24)


def test_origin_and_stops(lines):
    """A homing motion ends at the origin; jog and run motions end after a stop command. In each case the
    driver returns the cause.
    """
    home, jog, fast = (ending(lines, name) for name in ("home", "jog", "run"))
    assert (home["raw"], jog["raw"], fast["raw"]) == (0x87, 0xC5, 0xC6)
    assert jog["stopped"] and fast["stopped"] and not home["stopped"]
    for name, end, rate, count, ccw in (("home", home, 49, 7, 1), ("jog", jog, 24, 9, 0)):
        cw, back, got = pulses(lines, name)
        assert (back if ccw else cw) == count and cw * back == 0
        assert end["left"] + count == 1 << 24
        assert got == predict_move(INIT, count, rate).intervals
    assert result(lines, "jog stop")[0] == result(lines, "run stop")[0] == 0
    _, back, got = pulses(lines, "run")
    assert fast["left"] + back == 1 << 24
    want = predict_move(INIT, 100).intervals
    assert got == want[: len(got) - 6] + want[-6:] and 31 <= back <= 32


@pytest.mark.parametrize(
    ("name", "number"),
    [
        ("E unknown", Error.UNDEFINED),
        ("E late", Error.UNDEFINED),
        ("E nothing to stop", Error.UNDEFINED),
        ("E busy", Error.NOT_WHILE_BUSY),
        ("E busy off", Error.NOT_WHILE_BUSY),
        ("E uninitialised", Error.NOT_INITIALISED),
        ("off move", Error.NOT_INITIALISED),
        ("E data", Error.UNASKED_DATA),
        ("E long ramp", Error.PA_TOO_LARGE),
        ("E bad ramp", Error.BAD_RAMP),
        ("E data busy", Error.UNASKED_DATA_BUSY),
        ("E decelerating", Error.ALREADY_DECELERATING),
    ],
)
def test_error_number(lines, name, number):
    """If the device rejects a byte, the driver returns its error number plus one, and the matching text."""
    value, text = result(lines, name)
    assert value == number + 1 and text.startswith(f"error {int(number)}: ")


def test_errors_disturb_nothing(lines):
    """A move during which bytes are rejected continues up to its deceleration stop."""
    for name in ("E init", "E start", "E stop slowly"):
        assert result(lines, name) == (0, "ok")
    end, (cw, ccw, got) = ending(lines, "E"), pulses(lines, "E")
    want = predict_move(INIT, 60).intervals
    assert end["raw"] == 0xC3 and (cw + end["left"], ccw) == (60, 0)
    assert got == want[: len(got) - 6] + want[-6:]


@pytest.mark.parametrize("name", ["flags", "none", "too many", "motor", "ramp", "rates"])
def test_bad_argument(lines, name):
    """For a value out of range, the driver returns an error and sends no byte."""
    assert result(lines, f"E {name}") == (18, "argument out of range")


@pytest.mark.parametrize(
    "name",
    ["reset", "reset left", "reset again", "replaced", "count", "operation", "idle", "not ended"]
    + ["too many left"],
)
def test_an_end_that_the_part_does_not_confirm(lines, name):
    """An end that the finish status or the count does not confirm is an error, not "complete".

    Rules: P104-END-04, P104-END-06.
    """
    assert result(lines, f"U {name}") == (19, "the part does not confirm the end of the motion")


@pytest.mark.parametrize("name", ["routine", "after it", "complete", "stopped"])
def test_a_confirmed_end(lines, name):
    """A confirmed end is ok, even if an interrupt routine has already read the finish status."""
    assert result(lines, f"U {name}") == (0, "ok")
    assert lines["U after it"][1]["raw"] == "83"


def test_pins_and_reads(lines):
    """All commands without a motion are accepted, and the reads return the levels of the pins."""
    for name in ("aux on", "aux bits", "aux off", "switching", "aux in", "outputs", "off"):
        assert result(lines, name) == (0, "ok"), name
    outputs = int(lines["pins"][0]["outputs"], 16)
    assert lines["pins"][0]["aux"] == "00"
    assert outputs & 1 == 0 and outputs >> 1 & 1 == 1, "the last operation was CCW"
    assert bin(outputs >> 3).count("1") == 2, "four-phase full step, positive: two coils on"


# First four rows of the manual's table of patterns (chapter 10.1): phases that are on.
ROWS = {
    (3, 0): ("12", "23", "31", "12"),
    (3, 1): ("12", "2", "23", "3"),
    (4, 0): ("12", "23", "34", "41"),
    (4, 1): ("12", "2", "23", "3"),
    (5, 0): ("12", "23", "34", "45"),
    (5, 1): ("12", "123", "23", "234"),
}


def test_every_initialisation(lines):
    """For each motor type, step mode, polarity and chopper setting, the phases are those of the manual."""
    assert len(lines["motor"]) == 24
    for line in lines["motor"]:
        assert line["init"] == "0"
        high = int(line["high"])
        want = []
        for row in ROWS[int(line["phases"]), int(line["half"])]:
            on = sum(1 << 5 - int(phase) for phase in row)
            want.append(f"{on if high else on ^ 0x1F:02x}")
        assert line["rows"] == ",".join(want) + ",", line
        assert line["chopped"] == line["chop"], line


def test_external_clock(lines):
    """If the clock pin has no edges, an initialisation for it is accepted, and a move waits for the clock."""
    assert [line.get("result", "0") for line in lines["external"]] == ["0"] * 4
    assert (lines["external"][2]["busy"], lines["external"][2]["pulses"]) == ("1", "0")


def test_busy_right_behind_the_last_byte(lines):
    """Right after a move command the driver reports busy, although BUSY rises only after 112 µs
    (P104-DS-03).
    """
    look = next(line for line in lines["G look"] if "busy" in line)
    assert (look["busy"], look["again"]) == ("1", "1")
    assert next(line["rest"] for line in lines["G look"] if "rest" in line) == "0"
    assert (ending(lines, "G look")["raw"], pulses(lines, "G look")[0]) == (0x83, 12)
    assert (ending(lines, "G wait")["raw"], pulses(lines, "G wait")[0]) == (0x82, 1)


def test_the_gap_before_busy_is_met(lines, request):
    """In the test above, the driver reads the status before BUSY rises with DATASHEET timing, and after it
    with FAST.
    """
    gap = request.node.callspec.params["lines"] == "DATASHEET"
    assert next(line["bare"] for line in lines["G look"] if "bare" in line) == str(int(not gap))


def test_excitation_off_right_behind_the_last_byte(lines):
    """Right after a move command, excitation off is rejected and not executed as AUX ON; at standstill it
    works.
    """
    assert result(lines, "G off refused")[0] == Error.NOT_WHILE_BUSY + 1
    assert (ending(lines, "G off")["raw"], pulses(lines, "G off")[0]) == (0x83, 12)
    assert result(lines, "G now") == (0, "ok")


def test_stop_of_a_motion_that_lets_no_byte_in(lines, request):
    """In a motion that accepts only stops (P104-DS-12), a stop replaces a read that is waiting."""
    deaf = request.node.callspec.params["lines"] == "DATASHEET"
    assert result(lines, "G fast refused")[0] == Error.NOT_WHILE_BUSY + 1
    assert result(lines, "G fast read")[0] == (16 if deaf else Error.NOT_WHILE_BUSY + 1)
    assert result(lines, "G fast stop") == (0, "ok")
    assert ending(lines, "G fast")["raw"] == 0xC5


def test_time_out(lines):
    """A wait ends if no device responds, and if a device is not ready in time. The results distinguish
    both cases.
    """
    assert result(lines, "probe") == result(lines, "alive") == (0, "ok")
    assert result(lines, "dead probe")[0] == result(lines, "dead init")[0] == 17
    assert lines["dead"][0]["answered"] == "0"
    assert result(lines, "full probe")[0] == result(lines, "zero probe")[0] == 16
    assert lines["full"][0]["calls"] == "3"
    assert result(lines, "short wait")[0] == 16


def test_rates(lines):
    """For each speed, the driver returns the same nearest rate and resulting speed as exact arithmetic."""
    good = 0
    for line in lines["rate"]:
        xtal, base, extra, pps = (int(line[key]) for key in ("xtal", "base", "extra", "pps"))
        legal = 1_000_000 <= xtal <= 16_000_000 and 1 <= pps <= 500_000
        legal &= not (base == 2 and extra)
        if legal:
            period = Fraction(1, 40_000) if base == 2 else Fraction(32 * 4**base, xtal)
            legal &= base != 2 or 40_000 <= xtal // 16
            count = (1 / Fraction(pps) - (Fraction(120, xtal) if extra else 0)) / period
            nearest = int(count + Fraction(1, 2))
            legal &= 1 <= nearest <= 256 and count > 0
        assert int(line["result"]) == (0 if legal else 18), line
        if legal:
            good += 1
            assert int(line["rate"]) == nearest - 1, line
            speed = 1000 / (nearest * period + (Fraction(120, xtal) if extra else 0))
            assert int(line["mpps"]) == int(speed), line
    assert good > 60
