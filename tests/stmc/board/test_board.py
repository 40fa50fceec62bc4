"""The virtual board with an STMC: the motor follows the phases, and the board counts their steps."""

from __future__ import annotations

from itertools import product
from pathlib import Path

import pytest

from openppmc import sim
from openppmc.host import CCW, CW, AlarmStop, Cause, LimitReached, OriginNotFound, Stmc
from openppmc.model import Timebase, predict_move

from ...common.board.fixtures import CommandLine, StartBoard

FAST = {"start_pps": 2000, "high_pps": 9000, "ramp_pulses": 100}
TICK = 8_000_000 / 48_675
"""Period of the board's step clock in cycles."""


def test_every_motor(start_board: StartBoard) -> None:
    """For each motor type, step mode and logic, the plant, the step counter of the RTL and the driver
    agree.
    """
    board = start_board(part="stmc", speed="max")
    with Stmc.open(board.port) as axis:
        for phases, half, positive in product((3, 4, 5), (False, True), (True, False)):
            axis.reset()
            axis.initialise(**FAST, phases=phases, half_step=half, positive_logic=positive, chop=True)
            axis.zero()
            before = board.status()
            axis.move(23)
            axis.move(-37)
            axis.step(CW)
            assert axis.position == -13, (phases, half, positive)
            after = board.status()
            assert after.position - before.position == -13, (phases, half, positive)
            assert after.pulses - before.pulses == 61, (phases, half, positive)


def test_edges_exact(start_board: StartBoard, tmp_path: Path) -> None:
    """With the internal clock, every gap between steps is exact; with the clock of the board, the steps do
    not drift.
    """
    log = tmp_path / "steps.txt"
    board = start_board(part="stmc", speed="max", log=log)
    with Stmc.open(board.port) as axis:
        internal = axis.initialise(start_pps=625, high_pps=2500, ramp_pulses=8, base_clock=12_500)
        axis.move(40)
        external = axis.initialise(**FAST)
        axis.move(-300)
    board.close()
    rows = [[int(word) for word in line.split()] for line in log.read_text().splitlines()[1:]]
    there, back = [[0, 4001 + n] for n in range(40)], [[1, 4039 - n] for n in range(300)]
    assert [row[1:] for row in rows] == there + back
    first, second = [row[0] for row in rows[:40]], [row[0] for row in rows[40:]]
    move = predict_move(internal.data, 40, timebase=Timebase(8_000_000, 16_000_000), part="stmc")
    assert [clk - first[0] for clk in first] == list(move.clk)
    ticks = 0
    for clk, divisor in zip(second[1:], predict_move(external.data, 300, part="stmc").rates, strict=True):
        ticks += divisor
        assert abs(clk - second[0] - ticks * TICK) <= 2


def test_switches(start_board: StartBoard) -> None:
    """The reference point, the limits and MON take effect, and the bridge reports its identity."""
    board = start_board(part="stmc", speed="max", start=500, ccw=-400, alarm="700..800")
    with Stmc.open(board.port) as axis:
        assert (axis.link.identity.part, axis.link.identity.counter, axis.read_map) == (105, True, "FAMILY")
        axis.initialise(**FAST)
        for how in ({}, {"fast": True}, {"to_limit": True}):
            assert axis.home(CCW, **how).cause is Cause.ORIGIN
            assert board.status().position == axis.position == 0
            axis.move(300)
        with pytest.raises(AlarmStop, match="MON input ended the motion at position 700"):
            axis.move(1000)
        assert board.status().alm and axis.inputs().motor_off
    board = start_board(part="stmc", speed="max", start=1000, cw=1500, slow_cw=1200)
    with Stmc.open(board.port) as axis:
        axis.initialise(**FAST)
        with pytest.raises(LimitReached) as caught:
            axis.move(1000)
        assert caught.value.result.cause is Cause.SLOW_LIMIT and board.status().position == 1301
        with pytest.raises(OriginNotFound):
            axis.search(CW).wait()
            axis.home(CW)
        assert board.status().position == 1301, "a search does not start in a deceleration limit"
        axis.jog(CW, 3000).wait()
        now = board.status()
        assert now.position == 1500 and now.l1 and now.l3 and not now.l2


def test_sim_port(openppmc: CommandLine) -> None:
    """`--part stmc --port sim:` starts a board with that part."""
    words = ("--part", "stmc", "home", "--start", "345", "--high", "825")
    code, out, err = openppmc.run("sim:speed=max,start=30", *words)
    assert (code, out) == (0, "position 0: origin found\n"), err


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("part=stmc,read_map=other", "read_map=other: neither FAMILY nor SHEET"),
        ("read_map=FAMILY", "read_map=FAMILY: only an stmc has it"),
        ("part=stmc,xtal=20000001", "xtal=20000001: expected 1e\\+06 to 2e\\+07 Hz"),
    ],
)
def test_bad_text(text: str, expected: str) -> None:
    with pytest.raises(sim.SpecError, match=expected):
        sim.parse_spec(text)


def test_parameters() -> None:
    """The options of the text become parameters of the top module."""
    spec = sim.parse_spec("part=stmc,read_map=family,xtal=20000000,timing=datasheet")
    assert spec.parameters == {
        "CLK_HZ": 8_000_000,
        "XTAL_HZ": 20_000_000,
        "TIMING": "DATASHEET",
        "READ_MAP": "FAMILY",
    }
    assert (spec.plants[0].ccw, spec.plants[0].slow_ccw) == (-1000, -200)
