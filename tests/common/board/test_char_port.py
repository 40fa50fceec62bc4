"""A virtual board with the character host, opened with `char:`."""

from __future__ import annotations

import pytest

from openppmc.host import CW, AxisBusy, NoAnswer, NotInitialised, Ppmc104, ProtocolError

from .fixtures import SETUP, CommandLine, StartBoard

TEXT = "bridge=0,speed=max,start=100"


def test_moves_and_events(start_board: StartBoard) -> None:
    """The driver works as with the bridge: moves, the event at their end, a rejected command, a stop."""
    with Ppmc104.open("char:" + start_board(TEXT).port) as axis:
        identity = axis.link.identity
        assert (identity.part, identity.clk_hz, identity.xtal_hz) == (104, 8_000_000, 16_000_000)
        assert (identity.counter, identity.datasheet) == (False, False)
        with pytest.raises(NotInitialised):
            axis.move(10)
        axis.initialise(**SETUP)
        axis.start_move(1500)
        pins = axis.link.wait_event(20)
        assert pins is not None and not pins & 1, "no event within 20 s"
        assert axis.motion is not None and axis.motion.wait().complete
        end = axis.move(-600)
        assert (end.pulses, end.position) == (-600, None)
        axis.jog(CW)
        with pytest.raises(AxisBusy):
            axis.move(10)
        stopped = axis.stop()
        assert stopped is not None and not stopped.complete
        with pytest.raises(ProtocolError, match="no pulse counter"):
            _ = axis.position


def test_pins_straps_reset(start_board: StartBoard) -> None:
    """The levels of the switches, the strap outputs (a slower base clock) and the reset work."""
    board = start_board(TEXT)
    with Ppmc104.open("char:" + board.port) as axis:
        assert axis.inputs().slow_ccw and not axis.inputs().limit_ccw
        setup = axis.initialise(start_pps=500, high_pps=900, ramp_pulses=20, base_clock=125_000)
        assert setup.clock.csel == 0
        axis.move(20)
        before = board.status()
        axis.move(900)
        took = board.status().seconds - before.seconds
        assert 900 / 900 <= took < 900 / 500 + 1
        axis.reset()
        with pytest.raises(NotInitialised):
            axis.move(10)
        axis.initialise(**SETUP)
        axis.move(10)
    assert board.status().position == 100 + 20 + 900 + 10


def test_home(start_board: StartBoard) -> None:
    """Homing finds the edge of the switch, although the position is unknown."""
    board = start_board("bridge=0,speed=max,start=3000")
    with Ppmc104.open("char:" + board.port) as axis:
        axis.initialise(**SETUP)
        assert axis.home().position is None
    assert board.status().position == 0


def test_wrong_host(start_board: StartBoard) -> None:
    """A board with the bridge is rejected with `char:`, and a board with the character host without it."""
    with pytest.raises(NoAnswer, match="no answer of a character host"):
        Ppmc104.open("char:" + start_board().port)
    with pytest.raises(NoAnswer, match="is the board powered"):
        Ppmc104.open(start_board(TEXT).port)


def test_command_line(openppmc: CommandLine, start_board: StartBoard) -> None:
    """The command line accepts a port `char:…`; `info` states that there is no pulse counter."""
    port = "char:" + start_board(TEXT).port
    code, out, err = openppmc.run(port, "info")
    assert (code, err) == (0, "") and "pulse counter" in out and "False" in out
    assert openppmc.run(port, "init")[0] == 0
    code, out, err = openppmc.run(port, "move", "500")
    assert (code, err) == (0, "") and "500 pulses CW: complete" in out
