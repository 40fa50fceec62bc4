"""The C driver of the bank on the Verilated bank, with accesses to the bank's register window."""

from __future__ import annotations

import pytest

from cocotb_tests.bank.bench import B8
from cocotb_tests.harness.build import part_design
from openppmc.model.single.codes import Error
from openppmc.model.single.predict import predict_move
from tests.common.packages.c_programs import BENCH, DRIVER, Lines, ending, pulses, result, simulate

pytestmark = pytest.mark.xdist_group("cdriver_bank")  # one worker builds and runs the programs

INIT = bytes([59, 39, 6, 0])
NO_PART = 17


@pytest.fixture(scope="module")
def lines() -> Lines:
    """Output of tb/cdriver/bank_test.c: first word(s) -> its lines, each as name -> value."""
    sources = [DRIVER / "ppmc104.c", DRIVER / "ppmc_bank.c", BENCH / "bank_test.c", BENCH / "window_bus.cpp"]
    params = ("-GAXES=8", "-GCLK_HZ=16000000")
    return simulate("cdriver_bank_rtl", "ppmc_bank", part_design("bank", B8), sources, params)


def test_opening(lines: Lines) -> None:
    """During the reset the driver finds no bank. After the reset it finds all axes and empties MASK."""
    assert result(lines, "absent")[0] == NO_PART
    assert result(lines, "open") == (0, "ok")
    assert (lines["found"][0]["axes"], lines["found"][0]["mask"]) == ("8", "0")
    assert [line["result"] for line in lines["axis"]] == ["0"] * 8
    assert [line["result"] for line in lines["init"]] == ["0"] * 7


@pytest.mark.parametrize(
    ("name", "cw", "ccw", "rate", "raw", "position"),
    [
        ("move", 30, 0, None, 0x83, 30),
        ("constant", 0, 12, 24, 0x84, -12),
        ("first", 20, 0, None, 0x83, 20),
        ("second", 0, 5, 30, 0x84, -13),
        ("third", 0, 3, None, 0x83, 27),
        ("alone", 5, 0, None, 0x83, 25),
        ("other", 40, 0, None, 0x83, 40),
    ],
)
def test_motion(
    lines: Lines, name: str, cw: int, ccw: int, rate: int | None, raw: int, position: int
) -> None:
    """For a motion by the driver, count, direction, position and every interval are the predicted ones."""
    assert pulses(lines, name) == (cw, ccw, predict_move(INIT, cw + ccw, rate).intervals)
    end = ending(lines, name)
    assert (end["raw"], end["left"], end["where"], end["position"]) == (raw, 0, 0, position)


def test_interrupts(lines: Lines) -> None:
    """The driver reports busy and pending axes of two motions, and the interrupt pin is active while one of
    these ends is pending.
    """
    both = 1 << 7 | 1 << 3
    assert (lines["both"][0]["busy"], lines["both"][0]["irq"]) == (str(both), "0")
    assert (lines["ended"][0]["pending"], lines["ended"][0]["irq"]) == (str(both), "1")
    assert (lines["read"][0]["pending"], lines["read"][0]["irq"]) == ("0", "0")


def test_base_clock_of_an_axis(lines: Lines) -> None:
    """With the slow base clock on one axis, the intervals of this axis are four times as long; other axes do
    not change.
    """
    assert [line["result"] for line in lines["config"]] == ["0", "0"]
    assert pulses(lines, "slow") == (4, 0, [1280] * 3)


def test_positions(lines: Lines) -> None:
    """A read of all positions returns the pulses of each axis; an axis without a ramp rejects a step."""
    assert [int(line["pulses"]) for line in lines["position"]] == [0, 0, 0, -8, 0, 0, 0, 30]
    assert result(lines, "step")[0] == Error.NOT_INITIALISED + 1


def test_group(lines: Lines) -> None:
    """Three loaded motions do not move before GO, and begin in the same cycle."""
    assert pulses(lines, "held")[:2] == (0, 0)
    assert result(lines, "go") == (0, "ok") and lines["started"][0]["refused"] == "0"
    begins = [next(line for line in lines[name] if "cw" in line) for name in ("first", "second", "third")]
    assert len({line["at"].split()[0] for line in begins}) == 1


def test_who_was_not_ready(lines: Lines) -> None:
    """GO returns the axes that could not start; a cancelled group outputs no pulse."""
    assert result(lines, "go alone")[0] == Error.NOT_INITIALISED + 1
    assert lines["alone"][0]["refused"] == str(1 << 1)
    end = ending(lines, "dropped")
    assert (end["raw"], end["left"], end["position"]) == (0xC3, 5, 25)
    assert pulses(lines, "dropped")[:2] == (0, 0)


@pytest.mark.parametrize(("name", "total", "raw"), [("limit", 100, 0x93), ("stopped", 1000, 0xC3)])
def test_ends(lines: Lines, name: str, total: int, raw: int) -> None:
    """After a limit, or a stop of all axes, pulses, remaining count, position and intervals agree with each
    other.
    """
    cw, ccw, got = pulses(lines, name)
    end = ending(lines, name)
    assert (end["raw"], cw + ccw + end["left"], end["position"]) == (raw, total, cw - ccw)
    assert got == predict_move(INIT, total).intervals[: len(got)] and len(got) >= 4


def test_jog_is_stopped_with_the_others(lines: Lines) -> None:
    """If the driver stops all axes during a jog, the jog ends after the pulse that was already counted."""
    cw, ccw, got = pulses(lines, "jog")
    assert (ending(lines, "jog")["raw"], ccw, cw) == (0xC5, 0, ending(lines, "jog")["position"])
    assert cw in (9, 10) and got == predict_move(INIT, cw, 30).intervals


@pytest.mark.parametrize("name", ["reset", "reset left"])
def test_reset_in_a_motion(lines: Lines, name: str) -> None:
    """If the bank is reset during a motion, the end of the motion is unconfirmed, not "complete"
    (P104-END-04).
    """
    assert result(lines, name) == (19, "the part does not confirm the end of the motion")
