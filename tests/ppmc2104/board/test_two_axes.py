"""The virtual board with a PPMC-2104: both axes together, coordinated starts, Ctrl-C, unplugged cables."""

from __future__ import annotations

import json
import signal
from pathlib import Path

import pytest

from openppmc.host import (
    CCW,
    CW,
    Axis,
    AxisBusy,
    Cause,
    LimitReached,
    NotInitialised,
    Ppmc104,
    Ppmc2104,
    WrongDevice,
)
from openppmc.host.script import Script
from openppmc.model import Timebase, predict_move
from openppmc.sim import SimBoard

from ...common.board.fixtures import PATIENCE, SETUP, CommandLine, StartBoard, Wait, one_line

SLOW = ("--start", "1000", "--high", "4000", "--ramp", "300")
TIMEBASE = Timebase(8_000_000, 16_000_000)


@pytest.fixture
def board(start_board: StartBoard) -> SimBoard:
    """A board with a PPMC-2104 and the default plants."""
    return start_board(part="ppmc2104")


def initialise(part: Ppmc2104, **changes: int) -> None:
    """Initialise both axes."""
    for axis in (part.x, part.y):
        axis.initialise(**{**SETUP, **changes})


def positions(board: SimBoard) -> tuple[int, int]:
    """Return the positions of both motors."""
    now = board.status()
    assert now.second is not None
    return now.position, now.second.position


def edges(log: Path, axis: int) -> list[tuple[int, int]]:
    """Return (cycle, position) of each pulse of an axis."""
    rows = [line.split() for line in log.read_text().splitlines()[1:]]
    return [(int(clk), int(at)) for clk, _, at, of in rows if int(of) == axis]


def test_info_and_wrong_driver(board: SimBoard) -> None:
    """The bridge reports the part, so the driver of another part raises WrongDevice; a move before the
    initialisation is rejected.
    """
    with pytest.raises(WrongDevice, match="PPMC-2104, not a PPMC-104"):
        Ppmc104.open(board.port)
    with Ppmc2104.open(board.port) as part:
        identity = part.link.identity
        assert (identity.part, identity.axes, identity.clk_hz) == (2104, 2, 8_000_000)
        assert part.link.baud == 1_000_000
        for axis in (part.x, part.y):
            with pytest.raises(NotInitialised, match=f"axis {axis.number}"):
                axis.move(10)
    assert board.status().pulses == 0


def test_both_at_once(board: SimBoard) -> None:
    """Moves of both axes can overlap; each axis outputs its own pulses and ends separately."""
    with Ppmc2104.open(board.port) as part:
        initialise(part)
        long = part.y.start_move(4000)
        assert [part.x.move(pulses).position for pulses in (700, -200, 50)] == [700, 500, 550]
        assert part.y.inputs().active == [] and part.x.inputs().active == []
        assert long.wait().check(4000).pulses == 4000
        assert part.x.outputs().phases != (1, 1, 1, 1, 1)
    assert positions(board) == (4550, 8000)


@pytest.mark.parametrize("timing", ["FAST", "DATASHEET"])
def test_coordinated_start(start_board: StartBoard, tmp_path: Path, timing: str) -> None:
    """In a coordinated start, both axes begin in the same cycle, and every interval has the predicted number
    of cycles.
    """
    log = tmp_path / "pulses.txt"
    board = start_board(part="ppmc2104", log=log, timing=timing)
    with Ppmc2104.open(board.port) as part:
        assert part.link.identity.datasheet == (timing == "DATASHEET")
        setups = (
            part.x.initialise(start_pps=3000, high_pps=13_000, ramp_pulses=150),
            part.y.initialise(start_pps=1000, high_pps=9000, ramp_pulses=40),
        )
        assert [setup.clock.csel for setup in setups] == [1, 0]
        part.move_together(1000, -700)
    board.close()
    begins = []
    for axis, setup, pulses in ((1, setups[0], 1000), (2, setups[1], 700)):
        seen = edges(log, axis)
        move = predict_move(
            bytes(setup.data), pulses, csel=setup.clock.csel, timebase=TIMEBASE, part="ppmc2104"
        )
        assert [clk - seen[0][0] for clk, _ in seen] == list(move.clk)
        side = 1 if axis == 1 else -1
        assert [at for _, at in seen] == [4000 + side * (n + 1) for n in range(pulses)]
        begins.append(seen[0][0])
    assert begins[0] == begins[1]


def test_fast_pulses_of_both(start_board: StartBoard, tmp_path: Path) -> None:
    """At 250 000 pulses/s on both axes, the pulse counters of the bridge count every pulse."""
    log = tmp_path / "pulses.txt"
    board = start_board(part="ppmc2104", log=log, cw=99_000, slow_cw=99_000, cw2=99_000, slow_cw2=99_000)
    with Ppmc2104.open(board.port) as part:
        initialise(part)
        ends = part.move_together(20_000, 20_001, 250_000, 250_000)
        assert [end.position for end in ends] == [20_000, 20_001]
    board.close()
    for axis in (1, 2):
        seen = edges(log, axis)
        assert {b[0] - a[0] for a, b in zip(seen, seen[1:], strict=False)} == {32}


def test_a_limit_stops_both(start_board: StartBoard) -> None:
    """If one axis of a coordinated move reaches its limit, the other axis is also stopped, with its ramp."""
    board = start_board(part="ppmc2104", slow_cw2=6000)
    with Ppmc2104.open(board.port) as part:
        initialise(part)
        with pytest.raises(LimitReached, match="axis 2: slow-down limit"):
            part.move_together(20_000, 20_000)
        assert not any(part.status().busy)
        assert part.x.motion is not None and part.x.motion.result is not None
        assert part.x.motion.result.cause is Cause.STOP
    x, y = positions(board)
    assert 6000 < y <= 6401 and y <= x < 15_000


def test_home_and_refused_starts(start_board: StartBoard) -> None:
    """Homing of axis 2 works if it starts on the switch; a start of axis 1 into its limit is rejected."""
    board = start_board(part="ppmc2104", start2=-150, start=40_000)
    with Ppmc2104.open(board.port) as part:
        initialise(part)
        assert part.y.home(CCW).cause is Cause.ORIGIN
        assert positions(board) == (40_000, 0)
        with pytest.raises(LimitReached, match="axis 1: limit switch .* after 0 of 1 pulses"):
            part.x.step(CW)
        part.x.step(CCW)
    assert positions(board) == (39_999, 0)


def test_refused_while_moving_disturbs_nothing(board: SimBoard) -> None:
    """Errors of one axis during motions of both axes change neither motion."""
    with Ppmc2104.open(board.port) as part:
        initialise(part)
        motions = part.start_moves(3000, 3500)
        for _ in range(4):
            for axis in (part.x, part.y):
                with pytest.raises(AxisBusy, match=f"axis {axis.number}"):
                    axis.remaining()
        assert [motion.wait().pulses for motion in motions] == [3000, 3500]
    assert positions(board) == (7000, 7500)


def yank(part: Ppmc2104) -> None:
    """Close the port without notice, as a crash of the host or an unplugged cable does."""
    part.link.port._serial.close()


def test_unplugged_in_a_coordinated_move(board: SimBoard, until: Wait) -> None:
    """Without a host, both motors make all their pulses; the next host reads the right positions."""
    part = Ppmc2104.open(board.port)
    initialise(part)
    part.start_moves(8000, -3000)
    until(lambda: board.status().pulses > 1000, "motors turning")
    yank(part)
    with Ppmc2104.open(board.port) as again:
        until(lambda: not any(again.status().busy), "end of the moves")
        assert [again.x.position, again.y.position] == [8000, -3000]
        initialise(again)
        assert again.move_together(-100, 100)[1].position == -2900


def test_host_dies_between_the_commands(board: SimBoard, until: Wait) -> None:
    """If a host ends while an axis waits for RUN, this axis does not move when the next host opens
    the board.
    """
    part = Ppmc2104.open(board.port)
    initialise(part)
    part.link.execute(Script().straps(0xF3).call(0x43, 0xE7, 3, 0))
    yank(part)
    with Ppmc2104.open(board.port) as again:
        assert again.status().busy == (True, False)
        again.y.initialise(**SETUP)
        again.y.move(300)
        assert positions(board) == (4000, 4300)
        end = again.x.halt()
        assert end is not None and end.cause is Cause.STOP
        again.x.initialise(**SETUP)
        assert again.x.move(5).position == 5


def axes_at_rest(port: str) -> list[int]:
    """Return the positions of both axes; fail unless both are at standstill."""
    with Ppmc2104.open(port) as part:
        assert not any(part.status().busy)
        axes: tuple[Axis, ...] = part.axes
        return [axis.position for axis in axes]


@pytest.mark.parametrize("words", [("move", "30000", "25000"), ("jog", "cw", "--ramped", "--axis", "2")])
def test_ctrl_c_stops_with_ramps(
    board: SimBoard, openppmc: CommandLine, until: Wait, words: tuple[str, ...]
) -> None:
    """Ctrl-C stops all motions that the command has started, each with its ramp."""
    process = openppmc.begin(board.port, *words, *SLOW)

    def pulses() -> list[int]:
        """Return the pulse counts of the moving axes."""
        now = board.status()
        assert now.second is not None
        return [now.pulses, now.second.pulses] if words[0] == "move" else [now.second.pulses]

    try:
        until(lambda: min(pulses()) > 1000, "motors at high speed")
        before = pulses()
        process.send_signal(signal.SIGINT)
        _, err = process.communicate(timeout=PATIENCE)
    finally:
        process.kill()
    assert process.returncode == 130 and "interrupted: stopped" in err and "Traceback" not in err
    after = pulses()
    assert all(b >= a + 300 for a, b in zip(before, after, strict=True)), "stopped without a ramp"
    x, y = positions(board)
    assert f"axis 1: position {x - 4000}, axis 2: position {y - 4000}" in err
    assert axes_at_rest(board.port) == [x - 4000, y - 4000]


def test_commands(board: SimBoard, openppmc: CommandLine, tmp_path: Path) -> None:
    """Single commands detect the part by IDENT and store the set-up of each axis."""
    for words in (
        ("init", *SLOW),
        ("init", "--axis", "2", "--start", "2000", "--high", "9000"),
        ("move", "500", "700"),
        ("move", "--axis", "2", "--", "-300"),
        ("home", "--axis", "1", "--fast"),
    ):
        code, _, err = openppmc.run(board.port, *words)
        assert code == 0, f"{words}: {err}"
    assert positions(board) == (0, 4400)
    code, out, err = openppmc.run(board.port, "status", "--json")
    values = json.loads(out)
    assert (values["axis1"]["position"], values["axis2"]["position"]) == (0, 400)


def test_another_part_was_named(board: SimBoard, openppmc: CommandLine) -> None:
    """If `--part` does not name the part of the board, the command fails with one line."""
    code, _, err = openppmc.run(board.port, "--part", "ppmc104", "info")
    assert code == 1 and one_line(err) and "PPMC-2104, not a PPMC-104" in err
    code, out, err = openppmc.run(board.port, "--part", "ppmc2104", "info")
    assert code == 0 and "PPMC-2104" in out, err


def test_sim_port(openppmc: CommandLine, tmp_path: Path) -> None:
    """`--part ppmc2104 --port sim:` starts a board with that part, on which a script moves both axes."""
    log, script = tmp_path / "pulses.txt", tmp_path / "demo.txt"
    script.write_text("move 300 400\nmove -50 axis=2\nposition\n")
    code, out, err = openppmc.run(f"sim:part=ppmc2104,log={log}", "script", str(script), *SLOW)
    assert code == 0, err
    assert out.splitlines()[-1] == "done, positions 300 and 350"
    assert [seen[-1][1] for seen in (edges(log, 1), edges(log, 2))] == [4300, 4350]


@pytest.mark.parametrize(
    ("port", "expected"),
    [
        ("sim:part=ppmc999", "there are ppmc104, ppmc2104"),
        ("sim:cw2=500", "a ppmc104 has one axis"),
        ("sim:part=ppmc2104,cw2=5,ccw2=10", "cw2=5,ccw2=10: the CW limit"),
    ],
)
def test_bad_text(openppmc: CommandLine, port: str, expected: str) -> None:
    """A mistake in the text after `sim:` is reported in one line with the valid words."""
    code, _, err = openppmc.run(port, "info")
    assert code == 1 and one_line(err) and expected in err, err


def test_straps_and_pins(start_board: StartBoard) -> None:
    """The straps set ERRINT, CSEL and RUN of each axis, and select the axis whose pins PINS returns."""
    board = start_board(part="ppmc2104", start2=-450)
    with Ppmc2104.open(board.port) as part:
        initialise(part)
        link = part.link
        shown = [link.execute(Script().straps(levels).pins()).byte(0) for levels in (0xFF, 0x7F)]
        assert shown == [0xFF, 0xFF & ~(0x08 | 0x20 | 0x40)], "limit CCW, slow-down CCW and origin of axis 2"
        for levels, interrupt in ((0xFF, False), (0xEF, True)):
            link.execute(Script().straps(levels).post(1, b"\xa7").wait(1, 0x80, 0x80))
            assert board.status().interrupt is interrupt
            link.execute(Script().post(1, b"\xa6").wait(1, 0x80, 0).get(1))
            assert not board.status().interrupt
        for levels, waits in ((0xFF, ()), (0xFB, (1,)), (0xF7, (2,)), (0xF3, (1, 2))):
            script = Script().straps(levels).call(0x42).call(0x62)
            busy = Script().timeout(50).wait(1, 0x0C, sum(4 * n for n in waits))
            assert link.execute(script.extend(busy).straps(0xFF).wait(1, 0x0C, 0)).values
        assert [part.x.position, part.y.position] == [4, 4]
