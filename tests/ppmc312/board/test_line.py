"""A virtual line of PPMC-312 on one pseudo-terminal: sixteen stations, pyserial, the command line."""

from __future__ import annotations

import os
import re
import signal
import sys
import time
import tty
from collections.abc import Iterator
from pathlib import Path

import pytest

from openppmc.host import CCW, Cause, Disconnected, LimitReached, PortError, Ppmc312Bus
from openppmc.host.line import LineEcho, StationNotResponding
from openppmc.sim import SimError, SimLine, SpecError, start_line

from ...common.board.fixtures import ROOT, CommandLine, Wait, one_line
from ...common.board.foreground import foreground

QUICK = (4000, 8000, 600)
PART = ("--part", "ppmc312-serial")
PATIENCE = 5.0
"""Time limit in s, because RTL of many stations is much slower than real time."""


@pytest.fixture
def line() -> Iterator[SimLine]:
    """Provide a line of all sixteen stations at full speed, which is 0.02 of real time while all of them
    move.
    """
    with start_line("speed=max,baud=83333,start=100,cw=600,slow_cw=500") as made:
        yield made


def test_sixteen_stations(line: SimLine) -> None:
    """All stations are found, initialised and moved together, and the motors reach their positions."""
    with Ppmc312Bus.open(line.port, 83_333, patience=PATIENCE) as bus:
        assert [(one.station, one.version, one.problem) for one in bus.scan()] == [
            (number, 0x12, "") for number in range(16)
        ]
        for axis in bus.axes:
            axis.initialise(*QUICK)
        ends = bus.wait([axis.start_move(10 + axis.number) for axis in bus.axes])
        assert [end.position for end in ends] == [10 + number for number in range(16)]
        assert [axis.counters.faults for axis in bus.axes] == [0] * 16
        stations = line.status().stations
        assert [one.position for one in stations] == [110 + number for number in range(16)]
        assert {one.state for one in stations} == {"NOR"}
        assert bus.axis(9).home(CCW).cause is Cause.ORIGIN
        with pytest.raises(LimitReached, match="station 3: limit switch"):
            bus.axis(3).move(800)


def test_one_program_after_the_other(line: SimLine, openppmc: CommandLine) -> None:
    """A command continues with the state that the previous one left; the set-up of each station is stored."""
    run = (*PART, "--baud", "83333")
    setup = ("--start", "4000", "--high", "8000", "--ramp", "600")
    assert openppmc.run(line.port, *run, "init", "--axis", "2,5", *setup)[0] == 0
    code, out, err = openppmc.run(line.port, *run, "move", "-60", "--axis", "2,5")
    assert (code, err) == (0, "")
    assert out == "station 2: position -60, 60 pulses CCW: complete\n" + (
        "station 5: position -60, 60 pulses CCW: complete\n"
    )
    assert openppmc.run(line.port, *run, "move", "--to", "0", "--axis", "5", "--keep")[0] == 0
    assert [one.position for one in line.status().stations if one.number in (2, 5)] == [40, 100]
    code, out, err = openppmc.run(line.port, *run, "status", "--axis", "2")
    assert "NOR" in out and "-60" in out
    code, out, err = openppmc.run(line.port, *run, "move", "900", "--axis", "5")
    assert code == 1 and one_line(err) and "station 5: limit switch ended the motion at position 500" in err


def test_real_time_and_pace() -> None:
    """A line with speed=1 does not run faster than real time."""
    with start_line("stations=1") as line, Ppmc312Bus.open(line.port, patience=PATIENCE) as bus:
        axis = bus.axis(0)
        axis.initialise(*QUICK)
        begin = time.monotonic()
        axis.move_constant(400, 1000 * 4)
        assert time.monotonic() - begin > 0.09
        assert line.status().seconds > 0.1


def test_port_sim_in_one_go(openppmc: CommandLine) -> None:
    """`--port sim` starts a line for one command."""
    # The line is built here, so that the command below prints nothing about a build.
    start_line("stations=2").close()
    code, out, err = openppmc.run("sim:stations=2,speed=max", *PART, "poll", "--axis", "0,1", "--count", "1")
    assert (code, out, err) == (0, "station 0: ready\nstation 1: ready\n", "")
    code, out, err = openppmc.run("sim:stations=20", *PART, "scan")
    assert code == 1 and one_line(err) and "a number from 1 to 16" in err


def test_line_in_the_foreground(tmp_path: Path, until: Wait) -> None:
    """`make board PART=ppmc312-serial` creates a name for the port and ends with Ctrl-C."""
    link = tmp_path / "line"
    command = [sys.executable, "-m", "openppmc.sim", "part=ppmc312-serial", f"stations=3,link={link}"]
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    with foreground(command, env=environment) as process:
        until(link.is_symlink, "a link to the port")
        with Ppmc312Bus.open(str(link), patience=PATIENCE) as bus:
            assert bus.axis(2).version() == 0x12
            with pytest.raises(StationNotResponding):
                bus.axis(3).version()
        process.send_signal(signal.SIGINT)
        assert process.wait(10) == 0 and not link.exists()
        assert process.stdout is not None
        assert "openppmc --part ppmc312-serial --port" in process.stdout.read()


def test_wrong_speed_and_echo(line: SimLine) -> None:
    """At another baud rate the line receives only invalid frames; an echo is distinguished from a reply."""
    with Ppmc312Bus.open(line.port, 19_200) as bus, pytest.raises(StationNotResponding, match="speed"):
        bus.axis(0).version()
    with start_line("stations=1,echo=on") as echoing:
        with Ppmc312Bus.open(echoing.port, patience=PATIENCE) as bus, pytest.raises(LineEcho):
            bus.axis(0).version()
        with Ppmc312Bus.open(echoing.port, echo=True, patience=PATIENCE) as bus:
            assert bus.axis(0).version() == 0x12


def test_taken_unplugged_and_strange_ports(line: SimLine, until: Wait) -> None:
    """Only one master can open a port at a time.

    If the port disappears, Disconnected is raised; on a terminal without stations, a scan finds no station.
    """
    with Ppmc312Bus.open(line.port, 83_333, patience=PATIENCE) as bus:
        with pytest.raises(PortError, match="close it first"):
            Ppmc312Bus.open(line.port, 83_333)
        bus.axis(4).initialise(*QUICK)
        motion = bus.axis(4).jog(CCW)
        line.close()
        with pytest.raises(Disconnected, match="the port went away"):
            motion.wait()
    with pytest.raises(SimError, match="has ended"):
        line.status()
    master, slave = os.openpty()
    tty.setraw(slave)
    with Ppmc312Bus.open(os.ttyname(slave)) as bus:
        assert bus.scan(range(2)) == []
    os.close(master)
    os.close(slave)


def test_bad_texts() -> None:
    with pytest.raises(SpecError, match="unknown word 'speeed'"):
        start_line("speeed=3")


def test_ctrl_c_decelerates_all(openppmc: CommandLine, until: Wait) -> None:
    with start_line("stations=2") as line:
        process = openppmc.begin(line.port, *PART, "jog", "cw", "--axis", "0,1", "--start", "1000")
        until(lambda: all(one.position > 4010 for one in line.status().stations), "both motors run")
        process.send_signal(signal.SIGINT)
        out, err = process.communicate(timeout=30)
        assert process.returncode == 130
        said = r"interrupted: stopped, station 0: position \d+, station 1: position \d+\n"
        assert re.fullmatch(said, err), err
        assert {one.state for one in line.status().stations} == {"NOR"}
