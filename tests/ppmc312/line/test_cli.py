"""The command line with a modelled line of PPMC-312 in serial mode."""

from __future__ import annotations

import json
import os
import re
import signal
import threading
from pathlib import Path

import pytest

from openppmc.cli.common.session import load_setup, stores_setup
from openppmc.cli.ppmc312.line.session import line_options, parse_stations
from openppmc.host.ppmc312.line.wire import SumMode
from tests.common.cli.command_line import Run

PORT = "model:speed=max,stations=3"
PART = ("--part", "ppmc312-serial")
QUICK = ("--start", "4000", "--high", "8000", "--ramp", "600")


def test_scan(run: Run) -> None:
    lines = run(*PART, "scan").out.splitlines()
    assert lines[0].split() == "station version state position framing overrun checksum line faults".split()
    assert [line.split() for line in lines[1:]] == [[str(n), "12", "INI", *"00000"] for n in range(3)]
    found = json.loads(run(*PART, "scan", "--json").out)
    assert [one["station"] for one in found] == [0, 1, 2]
    assert found[0]["errors"] == {"framing": 0, "overrun": 0, "checksum": 0} and not found[0]["trouble"]
    assert run(*PART, "--port", "model:speed=max,baud=83333", "scan").only_line.startswith(
        "error: model:speed=max,baud=83333: no station replies; check power"
    )


def test_scan_finds_two_stations_with_one_address(run: Run) -> None:
    out = run(*PART, "--port", "model:speed=max,stations=2,start1=-10,twin=1", "scan").out
    assert "station 1: only garbled replies: noise, another speed or checksum rule, or two stations" in out
    error = run(*PART, "--port", "model:speed=max,stations=2,start1=-10,twin=1", "move", "5", "--axis", "0,1")
    assert "station 1: only garbled replies" in error.only_line


def test_motions(run: Run) -> None:
    out = run(*PART, "--baud", "38400", "move", "30", "--axis", "0,2", *QUICK).out
    assert out == (
        "station 0: position 30, 30 pulses CW: complete\nstation 2: position 30, 30 pulses CW: complete\n"
    )
    assert run(*PART, "move", "-7", "--axis", "1", "--speed", "5000", *QUICK).out == (
        "station 1: position -7, 7 pulses CCW: complete\n"
    )
    assert run(*PART, "move", "--to", "-5", "--axis", "1", *QUICK).out == (
        "station 1: position -5, 5 pulses CCW: complete\n"
    )
    assert run(*PART, "move", "--to", "0", "--axis", "1", *QUICK).out == (
        "station 1: position 0, 0 pulses CW: complete\n"
    )
    out = run(*PART, "jog", "ccw", "--axis", "0-1", "--seconds", "0.05", *QUICK).out
    assert [line.endswith("CCW: stop command") for line in out.splitlines()] == [True, True]
    port = ("--port", "model:speed=max,stations=2,start=80")
    assert run(*PART, *port, "home", "--axis", "1,0", *QUICK).out == (
        "station 1: position 0: origin found\nstation 0: position 0: origin found\n"
    )


def test_what_ends_early_is_an_error(run: Run) -> None:
    port = ("--port", "model:speed=max,stations=2,cw0=4010,alarm1=4020..4030")
    outcome = run(*PART, *port, "move", "50", "--axis", "0", *QUICK)
    assert outcome.only_line.startswith(
        "error: station 0: limit switch ended the motion at position 10 after"
    )
    assert outcome.out == "station 0: position 10, 10 pulses CW: limit switch\n"
    outcome = run(*PART, *port, "move", "50", "--axis", "1", *QUICK)
    assert "the alarm input is active" in outcome.out and "alarm" in outcome.only_line
    assert "has no table" in run(*PART, *port, "move", "50", "--axis", "0", "--keep").only_line


def test_looks(run: Run) -> None:
    values = json.loads(run(*PART, "status", "--json").out)
    assert sorted(values) == ["0", "1", "2"] and values["1"]["state"] == "INI"
    assert values["1"]["line"]["silent"] == 0 and values["1"]["inputs"]["end"] is True
    out = run(*PART, "status", "--axis", "2").out
    assert "end, run" in out and "INI" in out
    assert run(*PART, "poll", "--count", "2", "--every", "0", "--axis", "0,1").out == (
        "station 0: ready\nstation 1: ready\n"
    )
    assert "station 2: ready" in run(*PART, "poll", "--count", "1").out


def test_reports_of_polls(run: Run) -> None:
    out = run(*PART, "--port", "model:speed=max,stations=1,alarm=0..9000", "poll", "--count", "1").out
    assert out == (
        "station 0: the alarm input is active: clear the drive's alarm, then clear the part's\n"
        "station 0: ready\n"
    )


def test_init_stop_reset(run: Run, tmp_path: Path) -> None:
    out = run(*PART, "init", "--axis", "0-2", *QUICK).out
    assert "03 09 00 00 07 D0 03 E8 00 02 58" in out and "initialised: stations 0, 1, 2" in out
    values = json.loads(run(*PART, "init", "--axis", "1", "--sigmoid", "--json").out)
    assert values["1"]["shape"] == "sigmoid"
    assert run(*PART, "stop").out == "nothing was moving\n"
    assert run(*PART, "reset", "--axis", "2").out == "station 2: reset\n"
    assert "2000 pulses" in run(*PART, "plan", "5000").out
    assert (
        load_setup(PORT) == {}
        and not stores_setup("sim")
        and not stores_setup("model:x")
        and not stores_setup("char:sim:bridge=0")
        and stores_setup("char:/dev/ttyUSB1")
        and stores_setup("simple")
    )


@pytest.mark.parametrize(
    ("words", "text"),
    [
        (("move", "5", "--axis", "7"), "no station 7: is it powered"),
        (("move", "5", "--axis", "16"), "stations have numbers from 0 to 15"),
        (("move", "5", "--axis", "a"), "--axis 'a': not a list of stations; write 3, 0,2,5 or 0-7"),
        (("move", "5", "--axis", "3-1"), "stations have numbers"),
        (("move", "5"), "Missing option '--axis'"),
        (("table",), "table: not with --part ppmc312-serial"),
        (("table",), "table: not with --part ppmc312-serial"),
        (("jog", "cw", "--axis", "0", "--ramped", "--speed", "100"), "exclude each other"),
        (("jog", "cw", "--axis", "0", "--seconds", "-1"), "not a valid time; use 0 or more"),
        (("init", "--axis", "0", "--curve", "x.csv"), "free curves: a PPMC-312 in serial mode"),
        (("init", "--axis", "0", "--stop", "500"), "a separate deceleration: a PPMC-312 in serial mode"),
        (("--baud", "9600", "scan"), "9600 bit/s is no speed of a line"),
        (("--line", "sum=odd", "scan"), "--line 'sum=odd': there are echo, rs485"),
        (("--line", "patience=x", "scan"), "--line patience=x: not a number"),
        (("--line", "patience=100", "scan"), "patience 100 s is outside"),
        (("--line", "echo", "scan"), "does not receive its own bytes"),
        (("--port", "/dev/none", "scan"), "no such port"),
        (("--port", "model:stations=0", "scan"), "a number from 1 to 16"),
        (("--port", "", "scan"), "no port given"),
        (("--port", "model:echo=on,speed=max", "scan"), "receives its own bytes: set --line echo"),
        (("--port", "model:unplug=0.01,speed=max", "scan"), "the port went away"),
    ],
)
def test_bad_input(run: Run, words: tuple[str, ...], text: str) -> None:
    assert text in run(*PART, *words).only_line


def test_commands_of_a_line_belong_to_it(run: Run) -> None:
    outcome = run("--part", "ppmc312", "--port", "model:speed=max", "scan")
    assert "scan: only with --part ppmc312-serial" in outcome.only_line and outcome.code == 2
    assert "scan" in run("--help").out and "No such command 'walk'" in run(*PART, "walk").err


def test_ctrl_c_stops_all_motors(run: Run) -> None:
    """The first Ctrl-C decelerates all motors."""
    timer = threading.Timer(1.0, os.kill, (os.getpid(), signal.SIGINT))
    timer.start()
    outcome = run(*PART, "--port", "model:stations=2", "jog", "cw", "--axis", "0,1", "--start", "1000")
    timer.join()
    assert outcome.code == 130
    at = r"station 0: position \d+, station 1: position \d+"
    assert re.fullmatch(rf"interrupted: stopped, {at}\n", outcome.err)


def test_stations_and_line_options() -> None:
    assert parse_stations("3") == [3] and parse_stations("0-2, 7,1") == [0, 1, 2, 7]
    options = line_options("echo, sum=chars,patience=0.5,xtal=8e6,rts=low")
    assert options["echo"] and options["sum_mode"] is SumMode.CHARS and options["patience"] == 0.5
    assert options["xtal_hz"] == 8_000_000 and options["rs485"].rts_level_for_tx is False
    assert line_options("rs485")["rs485"].rts_level_for_tx is True and line_options("") == {}


SCRIPT = """\
init start=4000 high=8000 ramp=600 axis=0
repeat 2
  move 30 axis=0
  move -10 axis=2   # another station
end
position
goto 0 axis=0
stop
"""


def test_script_monitor_and_info(run: Run, tmp_path: Path) -> None:
    """On a line, scripts, `monitor` and `info` work as with a single part."""
    file = tmp_path / "run.txt"
    file.write_text(SCRIPT)
    out = run(*PART, "script", str(file)).out
    assert out == f"{file}:6: positions 60 and -20\ndone, positions 0 and -20\n"
    out = run(*PART, "monitor", "--axis", "1,2", "--count", "2", "--every", "0.05").out
    assert out.count("station 1  state INI  position 0") == out.count("station 2  state INI") == 2
    assert "0 (version 12), 1 (version 12), 2 (version 12)" in run(*PART, "info").out
    values = json.loads(run(*PART, "info", "--json").out)
    assert values["stations"] == {"0": 18, "1": 18, "2": 18} and values["baud"] == 19_200


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("move 4", ":1: move: no station; add axis=N"),
        ("move 4 5", ":1: move: no station; add axis=N"),
        ("move 4 axis=16", ":1: station 16: a line has stations 0 to 15"),
        ("position\nauxo 3", ":2: auxo: not supported on a line"),
        ("move 4 axis=7", "no station 7"),
    ],
)
def test_scripts_that_a_line_cannot_do(text: str, says: str, run: Run, tmp_path: Path) -> None:
    file = tmp_path / "bad.txt"
    file.write_text(text)
    assert says in run(*PART, "script", str(file)).only_line
