"""A virtual line of PMC006B4 on one pseudo-terminal: several controllers, pyserial, the command line."""

from __future__ import annotations

import re
import signal
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import pytest
import serial

from openppmc.host import BACKWARD, FORWARD, Disconnected, LimitReached, Pmc006, Pmc006Bus, PortError
from openppmc.host.line import StationNotResponding
from openppmc.host.pmc006.wire import command, reply
from openppmc.model.pmc006.program import assemble
from openppmc.sim import SimError, SimLine, SpecError, start_line

from ...common.board.fixtures import ROOT, CommandLine, Wait, one_line
from ...common.board.foreground import foreground

PART = ("--part", "pmc006")
PATIENCE = 1.0
"""Time limit in s, because RTL on a busy computer is much slower than real time."""
SHUTTLE = """\
; to EXT1, off it, then to and fro between two places, without a host
        EXTEN    on
        DIR      backward
        VSET     fixed, 2000
        ROT      0x7FFFFFFF
        WAIT     ext1, 1
        CLR1
shuttle:
        DIR      forward
        ROT      80
        WAIT     busy, 0
        OUT      gpo1, 1
        WAIT     gpi3, 0
        DIR      backward
        ROT      60
        WAIT     busy, 0
        OUT      gpo1, 0
        JMP      shuttle
"""


@pytest.fixture
def line() -> Iterator[SimLine]:
    """Provide three controllers at full speed, at 115 200 bit/s."""
    with start_line("part=pmc006,address=1..3,speed=max,baud=115200,low=3900,high=4300") as made:
        yield made


def test_three_controllers(line: SimLine) -> None:
    """All controllers are found and moved together, and the motors reach their positions."""
    with Pmc006Bus.open(line.port, 115_200, patience=PATIENCE) as bus:
        assert [one.address for one in bus.scan(range(1, 6))] == [1, 2, 3]
        for axis in bus.axes:
            axis.max_speed = axis.start_speed = axis.stop_speed = 2000
            axis.enable_stops()
        ends = bus.wait([axis.start_move(10 * axis.number) for axis in bus.axes])
        assert [end.position for end in ends] == [10, 20, 30]
        assert [axis.counters.faults for axis in bus.axes] == [0] * 3
        stations = line.status().stations
        assert [(one.number, one.position, one.state) for one in stations] == [
            (1, 4010, "idle"),
            (2, 4020, "idle"),
            (3, 4030, "idle"),
        ]
        with pytest.raises(LimitReached, match="controller 2: EXT2 ended the motion at position 300"):
            bus.axis(2).move(900)
        assert line.status().stations[1].state == "locked"
        assert bus.axis(3).home(1, BACKWARD, 2000, 1000, 50).position == 0
        bus.axis(1).outputs = 0b10010
        line.set_inputs(1, "01101")
        assert bus.axis(1).ports().inputs == 0b01101
        assert line.status().stations[0].outputs == "10010"


@pytest.fixture
def slow_line() -> Iterator[SimLine]:
    """Provide two controllers in real time."""
    with start_line("part=pmc006,address=1..2,baud=115200,low=3900") as made:
        yield made


def test_one_program_after_the_other(slow_line: SimLine, openppmc: CommandLine) -> None:
    """A command continues with the state that the previous one left: settings, a running motor, a locked
    motor.
    """
    run = (*PART, "--baud", "115200")

    def said(*words: str) -> str:
        code, out, err = openppmc.run(slow_line.port, *run, *words)
        assert (code, err) == (0, "")
        return out

    said("set", "start_speed=500", "stop_speed=500", "stops=3", "-a", "2")
    assert said("speed", "400", "-a", "2") == "runs at 400 steps/s\n"
    assert "running" in said("status", "-a", "2")
    assert re.fullmatch(r"position \d+: stop command\n", said("stop", "-a", "2"))
    said("set", "max_speed=2000", "-a", "2")
    code, out, err = openppmc.run(slow_line.port, *run, "move", "--to", "-300", "-a", "2")
    assert code == 1 and one_line(err) and "EXT1 ended the motion at position -100" in err
    code, out, err = openppmc.run(slow_line.port, *run, "move", "5", "-a", "2")
    assert code == 1 and one_line(err) and "EXT1 has stopped the motor: clear the flag" in err
    assert said("reset-flags", "-a", "2") == "flags cleared\n"
    assert said("move", "--to", "0", "-a", "2").endswith("complete\n")


def test_a_program_without_a_host(tmp_path: Path, until: Wait) -> None:
    """The program starts at power-up, homes to its switch, and moves to and fro according to GPI3."""
    text = tmp_path / "shuttle.asm"
    text.write_text(SHUTTLE)
    with start_line(f"part=pmc006,address=7,low=3900,speed=max,program={text}") as line:
        place = lambda: line.status().stations[0].position  # noqa: E731
        until(lambda: line.status().stations[0].outputs == "00001", "the first trip")
        assert place() == 3980
        line.set_inputs(7, "11011")
        until(lambda: line.status().stations[0].outputs == "00000", "the way back")
        with Pmc006.open(line.port, 7, patience=PATIENCE) as motor:
            assert motor.read_program() == assemble(SHUTTLE) and motor.offline == 1
            motor.halt_program()
            motor.process_reports(0.2)
            assert not motor.program_runs() and not motor.flags().busy


def test_what_is_saved_lasts(tmp_path: Path) -> None:
    """The EEPROM is stored in a file: address, settings and program are restored at the next power-up."""
    spec = f"part=pmc006,speed=max,baud=115200,eeprom={tmp_path / 'ee.bin'}"
    program = assemble("OUT gpo3, 1")
    with start_line(spec) as line, Pmc006.open(line.port, baud=115_200, patience=PATIENCE) as motor:
        assert motor.address == 255
        motor.load_program(program)
        motor.burn_program()
        motor.set_address(9)
        motor.microsteps, motor.offline = 64, 1
        motor.save()
    with start_line(spec) as line, Pmc006.open(line.port, 9, baud=115_200, patience=PATIENCE) as motor:
        assert (motor.microsteps, motor.outputs, motor.read_program()) == (64, 0b00100, program)


def test_a_foreign_program_with_plain_pyserial(line: SimLine) -> None:
    """Frames that plain pyserial sends as in the manual are answered; partial frames and noise have no
    effect.
    """
    with serial.Serial(line.port, 115_200, timeout=10) as port:
        port.write(b"\x00\x5a\xff" + command(2, ord("j")))
        assert port.read(8) == reply(2, 8)
        port.write(command(1, ord("e"), 1500)[:5])
        time.sleep(0.3)
        port.write(command(1, ord("n")))
        assert port.read(8) == reply(1, 800)
        port.write(command(9, ord("j")) + reply(9, 8) + command(3, ord("c")))
        assert port.read(8) == reply(3, 0)


def test_real_time_and_pace() -> None:
    """A line with speed=1 does not run faster than real time."""
    with start_line("part=pmc006,address=1") as line, Pmc006.open(line.port, 1, patience=PATIENCE) as motor:
        begin = time.monotonic()
        motor.move(60)
        assert time.monotonic() - begin > 0.1
        assert line.status().seconds > 0.1


def test_port_sim_in_one_go(openppmc: CommandLine) -> None:
    """`--port sim` starts a line for one command."""
    # The line is built here, so that the command below prints nothing about a build.
    start_line("part=pmc006,address=4+5,speed=max").close()
    code, out, err = openppmc.run("sim:address=4+5,speed=max", *PART, "move", "20", "-a", "4,5")
    assert (code, err) == (0, "") and out == (
        "controller 4: position 20, 20 steps forward: complete\n"
        "controller 5: position 20, 20 steps forward: complete\n"
    )
    code, out, err = openppmc.run("sim:address=0", *PART, "scan")
    assert code == 1 and one_line(err) and "controllers have addresses 1 to 120, or 255" in err


def test_line_in_the_foreground(tmp_path: Path, until: Wait) -> None:
    """`make board PART=pmc006` creates a name for the port and ends with Ctrl-C."""
    link = tmp_path / "line"
    command_line = [sys.executable, "-m", "openppmc.sim", "part=pmc006", f"address=1..2,link={link}"]
    with foreground(command_line, cwd=ROOT) as process:
        until(link.is_symlink, "a link to the port")
        with Pmc006Bus.open(str(link), patience=PATIENCE) as bus:
            assert bus.axis(2).version() == "V0.1.35"
            with pytest.raises(StationNotResponding):
                bus.axis(3).version()
        process.send_signal(signal.SIGINT)
        assert process.wait(10) == 0 and not link.exists()
        assert process.stdout is not None
        assert "openppmc --part pmc006 --port" in process.stdout.read()


def test_wrong_rate_and_echo(line: SimLine) -> None:
    """At another baud rate the line receives only invalid frames; a line with echo needs no option."""
    with (
        Pmc006.open(line.port, 1, baud=9600) as motor,
        pytest.raises(StationNotResponding, match="baud rate"),
    ):
        motor.version()
    with start_line("part=pmc006,address=1,echo=on") as echoing:
        with Pmc006.open(echoing.port, 1, patience=PATIENCE) as motor:
            assert motor.version() == "V0.1.35" and motor.counters.faults == 0


def test_taken_and_unplugged_ports(line: SimLine) -> None:
    with Pmc006.open(line.port, 1, 115_200, patience=PATIENCE) as motor:
        with pytest.raises(PortError, match="close it first"):
            Pmc006Bus.open(line.port, 115_200)
        motion = motor.jog(FORWARD)
        line.close()
        with pytest.raises(Disconnected, match="the port went away"):
            motion.wait()
    with pytest.raises(SimError, match="has ended"):
        line.status()


def test_bad_texts(tmp_path: Path) -> None:
    with pytest.raises(SpecError, match="unknown word 'stations'"):
        start_line("part=pmc006,stations=3")
    text = tmp_path / "bad.asm"
    text.write_text("ROT 0\n")
    with pytest.raises(SimError, match=r"bad.asm:1: ROT 0: steps"):
        start_line(f"part=pmc006,program={text}")


def test_ctrl_c_decelerates_all(openppmc: CommandLine, until: Wait) -> None:
    with start_line("part=pmc006,address=1..2") as line:
        words = (*PART, "--line", f"patience={PATIENCE}")
        process = openppmc.begin(line.port, *words, "jog", "forward", "-a", "1,2")
        until(lambda: all(one.position > 4010 for one in line.status().stations), "both motors run")
        process.send_signal(signal.SIGINT)
        out, err = process.communicate(timeout=30)
        assert process.returncode == 130, out + err
        said = r"interrupted: stopped, controller 1: position \d+, controller 2: position \d+\n"
        assert re.fullmatch(said, err), err
        assert {one.state for one in line.status().stations} == {"idle"}
