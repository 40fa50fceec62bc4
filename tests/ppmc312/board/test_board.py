"""The virtual board with a PPMC-312: its block registers through the bridge, a motor with an encoder."""

from __future__ import annotations

from pathlib import Path

import pytest

from openppmc.host import CCW, CW, Cause, LimitReached, Ppmc312, StoppedByCommand
from openppmc.host.ppmc312 import blocks
from openppmc.host.ppmc312.answers import EncoderChange, Executed, InPositionChange
from openppmc.model.clock import Timebase
from openppmc.model.ppmc312.carrier import predict_table
from openppmc.model.ppmc312.codes import Code, Source

from ...common.board.fixtures import CommandLine, StartBoard

QUICK = [(5000, 20), (10_000, 30), (20_000, 40), (40_000, 60)]
"""A free curve whose ramps are 150 pulses long."""


def test_pulses_and_registers(start_board: StartBoard, tmp_path: Path) -> None:
    """Every pulse of three moves is output in its exact cycle.

    No message needs a repeat, and the table that the driver reads back is the one that it sent.
    """
    log = tmp_path / "pulses.txt"
    board = start_board(part="ppmc312", speed="max", log=log)
    with Ppmc312.open(board.port) as part:
        assert (part.link.identity.part, part.version()) == (312, 0x12)
        sigmoid = part.initialise(5000, 50_000, 9000, 4000, 8000, sigmoid=True)
        part.move(700)
        curve = part.load_curve(QUICK)
        part.move(-400)
        part.move_constant(30, 8000)
        read = part.read_table()
        assert read.rates == curve.table.rates[:-5:-1] and read.up == (60, 40, 30, 20)
        assert part.position == part.encoder == 330 and board.status().position == 4330
        assert part.link.repeats == 0
    board.close()
    rows = [[int(word) for word in line.split()] for line in log.read_text().splitlines()[1:]]
    timebase = Timebase(8_000_000, 16_000_000)
    moves = (
        (0, predict_table(sigmoid.table, 700, timebase=timebase)),
        (1, predict_table(curve.table, 400, timebase=timebase)),
        (0, predict_table(curve.table, 30, curve.rate_of(8000), True, timebase)),
    )
    for ccw, move in moves:
        mine, rows = rows[: len(move.clk)], rows[len(move.clk) :]
        assert [row[0] - mine[0][0] for row in mine] == list(move.clk)
        assert {row[1] for row in mine} == {ccw}
    assert not rows


def test_switches_and_encoder(start_board: StartBoard) -> None:
    """Origin, index, limits and encoder work on the part, and an obstacle stops the shaft but not the
    pulses.
    """
    board = start_board(
        part="ppmc312", speed="max", start=600, ccw=-900, slow_ccw=-700, block=1500, alarm="-500..-450"
    )
    with Ppmc312.open(board.port) as part:
        part.load_curve(QUICK)
        for how, place in (({}, 0), ({"fast": True}, 0), ({"index": True}, -20)):
            assert part.home(CCW, **how).cause is Cause.ORIGIN
            assert board.status().position == place
            part.move(200)
        part.watch_encoder(20)
        part.watch_position(20)
        part.move(1500)
        assert board.status().position == 1500
        assert part.position - part.encoder == 180
        assert {part.next_report(1), part.next_report(1)} == {EncoderChange(True), InPositionChange(True)}
        assert part.jog(CCW, high=True).wait().cause is Cause.ALARM and board.status().alm
    board = start_board(part="ppmc312", speed="max", start=600, cw=2000, slow_cw=900)
    with Ppmc312.open(board.port) as part:
        part.load_curve(QUICK)
        with pytest.raises(LimitReached, match="slow-down limit ended the motion at position 450"):
            part.move(1000)


def test_overrides_and_events(start_board: StartBoard) -> None:
    """Overrides change the speed and stop a motion at their positions.

    The straps of the board work as event inputs and as RUN.
    """
    board = start_board(part="ppmc312", speed="max")
    with Ppmc312.open(board.port) as part:
        part.load_curve(QUICK)
        part.override_speed(20_000, at=4000)
        part.override_stop(at=8000, slow=False)
        with pytest.raises(StoppedByCommand):
            part.move(20_000)
        assert part.position == 8000 and board.status().position == 12_000
        done = [part.next_report(), part.next_report()]
        assert done == [Executed(Source.OVERRIDE, code) for code in (Code.RAMP_CHANGE, Code.STOP)]
        part.event_add(2, blocks.single_step(CW))
        part.pulse_event(2)
        assert part.next_report(1) == Executed(Source.EVENT, Code.STEP)
        part.allow_run(False)
        motion = part.start_move(-50)
        assert motion.waited_for_run
        part.allow_run(True)
        assert motion.wait(10).complete and part.position == 7951
        part.reset()
        assert part.position == 0 and not board.status().interrupt


def test_command_line(start_board: StartBoard, openppmc: CommandLine, tmp_path: Path) -> None:
    curve = tmp_path / "curve.csv"
    curve.write_text("\n".join(f"{pps},{pulses}" for pps, pulses in QUICK))
    board = start_board(part="ppmc312", speed="max")
    assert openppmc.run(board.port, "init", "--curve", str(curve))[0] == 0
    code, out, err = openppmc.run(board.port, "move", "500", "--at", "300:10000")
    assert (code, out, err) == (
        0,
        "position 500, 500 pulses CW: complete\noverride: speed changed with a ramp\n",
        "",
    )
    assert "PPMC-312" in openppmc.run(board.port, "info")[1]
