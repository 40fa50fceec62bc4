"""The command line with a modelled line of PMC006B4."""

from __future__ import annotations

import json
import re
import signal
from pathlib import Path

import pytest

from openppmc.host.pmc006.motion import Motion
from openppmc.model.pmc006.program import Program, assemble
from tests.common.cli.command_line import Run

PORT = "model:speed=max,address=1..2,low=3900,high=4300"
PART = ("--part", "pmc006")
ONE = ("--address", "1")
QUICK = ("start_speed=2000", "stop_speed=2000", "max_speed=2000")
SHUTTLE = """\
; three times there, then an output
        DIR     forward
        VSET    0, 3200
        CNTC
go:     ROT     200
        WAIT    busy, 0
        CNTI
        CMP     counter, 3
        JNE     go
        OUT     gpo1, 1
"""


@pytest.fixture
def shuttle(tmp_path: Path) -> str:
    path = tmp_path / "shuttle.asm"
    path.write_text(SHUTTLE)
    return str(path)


def test_scan(run: Run) -> None:
    lines = run(*PART, "scan").out.splitlines()
    assert [line.split() for line in lines] == [
        ["address", "version", "state", "position", "line", "faults"],
        ["1", "V0.1.35", "at", "rest", "0", "0"],
        ["2", "V0.1.35", "at", "rest", "0", "0"],
    ]
    found = json.loads(run(*PART, "scan", "--json").out)
    assert [one["address"] for one in found] == [1, 2] and found[0]["line"]["silent"] == 0
    out = run(*PART, "--port", "model:speed=max,address=3,twin=3", "scan").out
    assert "at rest" in out  # equal replies of several controllers overlap and are read as one
    assert "no controller replies; check power" in run(
        *PART, "--port", "model:speed=max,baud=19200", "scan"
    ).only_line.replace("\n", "")


def test_looks(run: Run) -> None:
    values = json.loads(run(*PART, "info", *ONE, "--json").out)
    assert values["version"] == "V0.1.35" and values["settings"]["current"] == 800
    out = run(*PART, "info", *ONE).out
    assert out.startswith("PMC006B4 at address 1, firmware V0.1.35\n")
    assert re.search(
        r"^current +800 +mA +\* +400 to 4000 +peak phase current: drives 850 mA", out, re.MULTILINE
    )
    assert "current at standstill 50 % of the peak" in out and "1700 steps/s² on average" in out
    values = json.loads(run(*PART, "status", "--address", "2", "--json").out)
    assert (values["position"], values["state"], values["inputs"]) == (0, "at rest", 31)
    assert len(json.loads(run(*PART, "status", "--address", "1,2", "--json").out)) == 2
    # status of the first controller that answers
    assert "EXT1 off, level 1; EXT2 off, level 1" in run(*PART, "status").out
    pins = json.loads(run(*PART, "io", *ONE, "--json").out)
    assert pins["gpi5"] == 1 and pins["gpo1"] == 0 and pins["ext2"] == 1
    assert "GPO1 1  GPO2 0  GPO3 1" in run(*PART, "io", "gpo1=1", "GPO3=1", *ONE).out


def test_motions(run: Run) -> None:
    assert run(*PART, "move", "30", "--address", "1-2").out == (
        "controller 1: position 30, 30 steps forward: complete\n"
        "controller 2: position 30, 30 steps forward: complete\n"
    )
    assert run(*PART, "move", "--to", "-20", *ONE, "--speed", "1200").out == (
        "position -20, 20 steps backward: complete\n"
    )
    assert run(*PART, "move", "--to", "0", *ONE).out == "position 0, 0 steps forward: complete\n"
    out = run(*PART, "jog", "backward", *ONE, "--seconds", "0.1", "--speed", "600").out
    assert re.fullmatch(r"position -\d+, \d+ steps backward: stop command\n", out)
    assert run(*PART, "speed", "800", *ONE).out == "runs at 800 steps/s\n"
    assert run(*PART, "speed", "0", *ONE).out == "position 0: stopped\n"
    assert run(*PART, "stop", *ONE).out == "nothing was moving\n"
    assert run(*PART, "home", *ONE, "--speed", "3000", "--slow", "1000", "--off", "50").out == (
        "position 0: 50 steps from the edge of EXT1\n"
    )


def test_a_running_motor_takes_other_speeds(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    """A running motor accepts another speed and direction; here all commands share one line, as on real
    hardware.
    """
    from openppmc.host import Pmc006Bus, line_port
    from openppmc.host.pmc006.station_link import Line

    port = line_port.ModelLine("speed=max,address=1", 9600, "pmc006")
    port.close = lambda: None  # type: ignore[method-assign]
    monkeypatch.setattr(Pmc006Bus, "open", lambda spec, **options: Pmc006Bus(Line(port)))
    part = port.line.stations[0].part
    for pps, forward in ((700, 1), (900, 1), (-650, 0)):
        assert run(*PART, "speed", str(pps), *ONE).out == f"runs at {pps} steps/s\n"
        port.read(0.3)
        assert part.outputs["mon_dir"] == forward and part.motion.engine.speed == abs(pps)
    assert run(*PART, "move", "5", *ONE).only_line == (
        "error: the motor is moving: wait for its end or stop it first\n"
    )
    assert "running" in run(*PART, "status", *ONE).out
    out = run(*PART, "stop", *ONE).out
    assert re.fullmatch(r"position -?\d+: stop command\n", out) and not part.outputs["mon_busy"]
    run(*PART, "speed", "650", *ONE)
    assert "stop command" in run(*PART, "stop", "--now", *ONE).out
    run(*PART, "set", "free=1", *ONE)
    assert "off-line" in run(*PART, "move", "5", *ONE).only_line


def test_stops_and_flags(run: Run, tmp_path: Path) -> None:
    settings = ("set", "stops=3", *QUICK, *ONE)
    assert run(*PART, *settings).code == 0
    # Each command starts a fresh board. Therefore, the board's program enables the stops at power-up.
    text = tmp_path / "stops.asm"
    text.write_text("EXTEN on\n")
    port = ("--port", f"{PORT},program={text}")
    outcome = run(*PART, *port, "move", "500", *ONE)
    assert outcome.out == "position 300, 300 steps forward: EXT2\n"
    assert "EXT2 ended the motion at position 300 after 300 of 500 steps: clear the flag" in outcome.only_line
    assert run(*PART, *port, "reset-flags", "--address", "1,2").out == (
        "controller 1: flags cleared\ncontroller 2: flags cleared\n"
    )


def test_settings_address_save(run: Run, tmp_path: Path) -> None:
    out = run(*PART, "set", "current=1500", "microsteps=0x20", "stops", *ONE).out.splitlines()
    assert [line.split()[:2] for line in out[1:4]] == [
        ["current", "1500"],
        ["microsteps", "32"],
        ["stops", "0"],
    ]
    out = run(*PART, "set", "current", "--address", "1,2").out
    assert out.splitlines()[0] == "controller 1" and "controller 2" in out
    assert len(run(*PART, "set", *ONE).out.splitlines()) == 20
    port = ("--port", f"model:speed=max,eeprom={tmp_path / 'ee.bin'}")
    assert run(*PART, *port, "address", "44").out == "controller 255 has address 44 now\n"
    assert run(*PART, *port, "save").out == "saved\n"
    none = ("--port", "model:speed=max,eeprom=none")
    assert "the EEPROM did not respond" in run(*PART, *none, "save").only_line
    assert run(*PART, *port, "scan").out.splitlines()[1].split()[0] == "255"  # the address was not saved
    assert "address 2 is taken" in run(*PART, "address", "2", *ONE).only_line


def test_programs_without_a_controller(run: Run, shuttle: str, tmp_path: Path) -> None:
    out = run(*PART, "--port", "", "program", "assemble", shuttle)
    assert out.out.splitlines()[3] == "  3  00000001 000000C8  ROT" and out.err == "10 instructions\n"
    image = tmp_path / "shuttle.bin"
    assert run(*PART, "program", "assemble", shuttle, "-o", str(image)).code == 0
    assert Program.from_image(image.read_bytes()) == assemble(SHUTTLE)
    out = run(*PART, "program", "disassemble", str(image))
    assert "L3:     ROT      200                    ; 3\n" in out.out
    again = tmp_path / "again.asm"
    run(*PART, "program", "disassemble", str(image), "--out", str(again))
    assert assemble(again.read_text()) == assemble(SHUTTLE)


def test_programs(run: Run, shuttle: str, tmp_path: Path) -> None:
    out = run(*PART, "program", "load", shuttle, *ONE, "--run").out
    assert out == "10 instructions loaded and checked\nrunning\n"
    out = run(*PART, "program", "load", shuttle, *ONE, "--burn").out
    assert out == "10 instructions loaded and checked\nburned\n"
    port = ("--port", f"{PORT},program1={shuttle}")
    assert run(*PART, *port, "program", "state", "--address", "1,2").out == (
        "controller 1: a program runs\ncontroller 2: no program runs\n"
    )
    assert "a user program runs: halt it first" in run(*PART, *port, "program", "run", *ONE).only_line
    assert run(*PART, *port, "program", "halt", *ONE).out == "halted\n"
    assert "go" not in run(*PART, *port, "program", "read", *ONE).out
    image = tmp_path / "read.bin"
    assert run(*PART, *port, "program", "read", *ONE, "-o", str(image)).out == ""
    assert Program.from_image(image.read_bytes()) == assemble(SHUTTLE)
    assert run(*PART, "program", "try", "--at", "5", *ONE).out == "instruction 5 executed\n"
    assert run(*PART, "program", "run", "--at", "5", *ONE).out == "running\n"
    port = ("--port", "model:speed=max")
    assert run(*PART, *port, "program", "burn", "--address", "255").out == "burned\n"


@pytest.mark.parametrize(
    ("words", "text"),
    [
        (("move", "5", *ONE[:1], "7"), "controller 7: no reply to 5 frames: is it there"),
        (("move", "5", "--address", "0"), "addresses are 1 to 120, factory-new controllers have 255"),
        (("move", "5", "--address", "121-123"), "addresses are 1 to 120"),
        (("move", "5", "--address", "x"), "--address 'x': not a list of addresses; write 3, 0,2,5 or 1-4"),
        (("move",), "Missing argument"),
        (("move", "5", "--speed", "20000", *ONE), "max_speed 20000: there are 1 to 16000 steps/s"),
        (
            ("move", "5", "--speed", "100", *ONE),
            "maximum speed of 100 steps/s is below the start speed (600)",
        ),
        (("move", "3000000000", *ONE), "a move has 1 to 2147483647 steps"),
        (("jog", "cw", *ONE), "is not one of"),
        (("jog", "forward", "--seconds", "-1", *ONE), "not a valid time; use 0 or more"),
        (("speed", "17000", *ONE), "max_speed 17000: there are 1 to 16000 steps/s"),
        (("home", "--switch", "3", *ONE), "Invalid value for '--switch'"),
        (("home", "--speed", "30", *ONE), "speed 30 is outside 65 to 3000 steps/s"),
        (("home", "--direction", "forward", "--switch", "1", *ONE), "EXT2 ended the search for EXT1"),
        (("set", "speed=5", *ONE), "no setting 'speed': there are microsteps, current"),
        (("set", "current=much", *ONE), "current=much: not a whole number"),
        (("set", "current=399", *ONE), "current 399: there are 400 to 4000 mA"),
        (("set", "microsteps=3", *ONE), "microsteps 3: there are 1, 2, 4, 8"),
        (("io", "gpo6=1", *ONE), "not an output level; write gpo1=0"),
        (("address", "121", *ONE), "address 121 is outside 1 to 120"),
        (("address", "5", "--address", "1,2"), "the command is for one controller"),
        (("program", "load", "none.asm", *ONE), "none.asm: No such file"),
        (("program", "run", "--at", "100", *ONE), "instruction 100: there are 0 to 99"),
        (("program", "walk"), "No such command 'walk'"),
        (("plan", "5"), "plan: not with --part pmc006"),
        (("init",), "init: not with --part pmc006"),
        (("--baud", "300", "scan"), "300 bit/s is outside 1200 to 115200"),
        (("--line", "echo", "scan"), "--line 'echo': there are rs485, rts=high"),
        (("--line", "patience=x", "scan"), "--line patience=x: not a number"),
        (("--port", "model:address=0", "scan"), "controllers have addresses 1 to 120, or 255"),
        (("--port", "model:speed=max,unplug=0.01", "scan"), "the port went away"),
        (("--port", "", "scan"), "no port given"),
    ],
)
def test_bad_input(run: Run, words: tuple[str, ...], text: str) -> None:
    assert text in run(*PART, *words).only_line


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("ROT 0", "2: ROT 0: steps: 1 to 2147483647"),
        ("JUMP 3", "2: JUMP: there are END, ROT"),
    ],
)
def test_mistakes_in_programs(run: Run, tmp_path: Path, text: str, says: str) -> None:
    path = tmp_path / "bad.asm"
    path.write_text(f"; a comment\n{text}\n")
    assert f"error: {path}:{says}" in run(*PART, "program", "assemble", str(path)).only_line
    image = tmp_path / "bad.bin"
    image.write_bytes(bytes(803))
    assert "its end mark is 00, not 5A" in run(*PART, "program", "disassemble", str(image)).only_line
    path.write_bytes(b"\xff\xfe")
    assert "not a text; images end in .bin" in run(*PART, "program", "load", str(path)).only_line


def test_commands_of_a_line_belong_to_it(run: Run) -> None:
    for part in ((), ("--part", "ppmc104"), ("--part", "ppmc312-serial")):
        outcome = run(*part, "--port", "model:speed=max", "program")
        assert "program: " in outcome.only_line and "with --part" in outcome.err and outcome.code == 2
    assert "scan: only with --part ppmc312-serial or pmc006" in run("scan").only_line
    assert "reset-flags" in run("--help").out
    assert "load" in run(*PART, "program", "--help").out


@pytest.mark.parametrize("words", [("jog", "forward"), ("move", "-3000")])
def test_ctrl_c_stops_all_motors(run: Run, monkeypatch: pytest.MonkeyPatch, words: tuple[str, ...]) -> None:
    """The first Ctrl-C decelerates all motors."""
    look, looks = Motion._update, iter(range(1000))

    def interrupt(motion: Motion) -> None:
        if next(looks) == 10:
            signal.raise_signal(signal.SIGINT)
        look(motion)

    monkeypatch.setattr(Motion, "_update", interrupt)
    outcome = run(*PART, *words, "--address", "1,2")
    assert outcome.code == 130
    at = r"controller 1: position -?\d+, controller 2: position -?\d+"
    assert re.fullmatch(rf"interrupted: stopped, {at}\n", outcome.err)


SCRIPT = """\
set max_speed=2000 start_speed=500 stop_speed=500 address=2
move 40 address=2
repeat 2
  move -5 speed=800 address=1
end
jog forward speed=500 for 0.01 address=1
out gpo1=1 address=1
position address=2
goto 0 address=2
"""


def test_script_and_monitor(run: Run, tmp_path: Path) -> None:
    """A script for two controllers is executed; `monitor` prints the state of both."""
    file = tmp_path / "run.txt"
    file.write_text(SCRIPT)
    port = ("--port", "model:speed=max,address=1..2")
    out = run(*PART, *port, "script", str(file)).out
    assert out.startswith(f"{file}:8: controller 2: position 40\ndone, controller 1: position ")
    assert out.endswith(", controller 2: position 0\n")
    out = run(*PART, *port, "monitor", "-a", "1,2", "--count", "2", "--every", "0.05").out
    assert out.count("address 1  position 0  motor at rest") == 2 and out.count("address 2") == 2


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("move", ":1: number of steps is missing"),
        ("jog cw for 1", ":1: 'cw' is neither forward nor backward"),
        ("set colour=5", ":1: no setting 'colour'"),
        ("out gpo9=1", ":1: 'gpo9=1': not an output level; write gpo1=0"),
        ("home forward switch=3", ":1: switch 3 is outside 1 to 2"),
        ("init start=5", ":1: unknown command 'init'"),
        ("move 3 address=9", "controller 9: no reply"),
    ],
)
def test_scripts_that_are_wrong(text: str, says: str, run: Run, tmp_path: Path) -> None:
    file = tmp_path / "bad.txt"
    file.write_text(text)
    assert says in run(*PART, "--port", "model:speed=max,address=1", "script", str(file)).only_line
