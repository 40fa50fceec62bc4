"""The command line on the modelled board: its output, its errors, Ctrl-C."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from openppmc.cli import main
from openppmc.cli.common.options import SetupValues
from openppmc.cli.common.script import ScriptError, read_program
from openppmc.cli.common.session import Guard, load_setup, state_folder, store_setup
from openppmc.host import Ppmc104, PpmcError
from tests.common.cli.command_line import Run

FAST = PORT = "model:speed=max"


# ---------------------------------------------------------------------- commands


def test_help_and_version(run: Run) -> None:
    assert run("--version").out.startswith("openppmc ")
    for words in (["--help"], ["move", "--help"]):
        outcome = run(*words)
        assert outcome.code == 0
        assert "Usage: openppmc" in outcome.out


def test_info(run: Run) -> None:
    values = json.loads(run("info", "--json").out)
    assert values["part"] == "PPMC-104"
    assert (values["baud"], values["best_baud"], values["crystal_hz"]) == (1_000_000, 3_000_000, 16_000_000)
    assert "PPMC-104" in run("info").out
    assert json.loads(run("--baud", "115200", "info", "--json").out)["baud"] == 115_200


def test_init(run: Run) -> None:
    values = json.loads(run("init", "--start", "50000", "--high", "100000", "--ramp", "4", "--json").out)
    assert values["bytes"] == [0x0A, 9, 4, 4, 0]
    outcome = run("init", "--start", "3333", "--high", "8000")
    assert "3333.33 pps (rate 149), requested 3333 pps" in outcome.out
    assert "the set-up is not stored" in outcome.err


@pytest.mark.parametrize(
    ("words", "line"),
    [
        (["move", "1000"], "position 1000, 1000 pulses CW: complete"),
        (["move", "-200"], "position -200, 200 pulses CCW: complete"),
        (["move", "--to", "-5"], "position -5, 5 pulses CCW: complete"),
        (["move", "0"], "position 0, 0 pulses CW: complete"),
        (["move", "7", "--speed", "700"], "position 7, 7 pulses CW: complete"),
        (["move", "7", "--pulse-only"], "position 7, 7 pulses CW: complete"),
        (
            ["move", "7", "--start", "600", "--phases", "5", "--half-step", "--logic", "negative"],
            "position 7",
        ),
        (["home"], "position 0: origin found"),
        (["home", "--fast", "--search", "700"], "position 0: origin found"),
        (["home", "--to-limit"], "position 0: origin found"),
        (["jog", "cw", "--seconds", "0.2"], "pulses CW: stop command"),
        (["jog", "ccw", "--ramped", "--seconds", "0.2"], "pulses CCW: stop command"),
        (["jog", "ccw"], "position -4400, 4400 pulses CCW: limit switch"),
    ],
)
def test_motions(run: Run, words: list[str], line: str) -> None:
    outcome = run(*words)
    assert (outcome.code, outcome.err) == (0, "")
    assert line in outcome.out


def test_status_and_monitor(run: Run) -> None:
    values = json.loads(run("--port", FAST + ",start=0", "status", "--json").out)
    assert values["inputs"]["origin"] and values["inputs"]["slow_ccw"] and not values["inputs"]["limit_ccw"]
    assert (values["position"], values["moving"], values["error"]) == (0, False, None)
    assert "at rest" in run("status").out
    assert run("monitor", "--count", "3", "--every", "0.1").out.count("position 0") == 3


def test_plan_and_plot(run: Run, tmp_path: Path) -> None:
    """`plan` states that 14 pulses of the ramp of P104-EX-01 take 170 µs; no board is needed."""
    options = ["--start", "50000", "--high", "100000", "--ramp", "4"]
    values = json.loads(run("plan", "14", *options, "--json").out)
    assert values["move"]["seconds"] == pytest.approx(170e-6)
    assert values["move"]["plateau_intervals"] == 5
    assert run("--port", "/dev/nope", "plan", "14", *options).code == 0, "needs no board"
    file = tmp_path / "move.png"
    assert run("plan", "14", *options, "--plot", str(file)).code == 0
    assert file.read_bytes().startswith(b"\x89PNG")


def test_ports(run: Run) -> None:
    assert run("ports").code == 0
    assert isinstance(json.loads(run("ports", "--json").out), list)


# ---------------------------------------------------------------------- errors


@pytest.mark.parametrize(
    ("words", "code", "text"),
    [
        (["move"], 2, "Missing argument"),
        (["move", "ten"], 2, "pulses"),
        (["move", "--bogus"], 2, "pulses"),
        (["bogus"], 2, "No such command"),
        (["--bogus", "info"], 2, "No such option"),
        (["jog", "up"], 2, "'up'"),
        (["jog", "cw", "--ramped", "--speed", "1000"], 2, "exclude each other"),
        (["jog", "cw", "--seconds", "-1"], 2, "--seconds"),
        (["move", "5", "--speed", "1000", "--pulse-only"], 2, "omit --speed"),
        (["monitor", "--count", "0"], 2, "--count"),
        (["init", "--start", "7"], 1, "start speed 7 pps is outside 488.281 to 125000 pps"),
        (["init", "--ramp", "3"], 1, "ramp of 3 pulses is outside 4 to 11220 pulses"),
        (["init", "--start", "nan"], 1, "not a number"),
        (["init", "--phases", "2"], 1, "3, 4 or 5"),
        (["init", "--base-clock", "9"], 1, "500000 and 125000 Hz"),
        (["move", "16777217"], 1, "a move has 1 to 16777216 pulses either way"),
        (["move", "5", "--speed", "1"], 1, "outside 488.281 to 500000 pps"),
        (["move", "50000"], 1, "slow-down limit ended the motion"),
        (["plan", "0"], 1, "a move has 1 to"),
        (["plan", "2000000", "--plot", "x.png"], 1, "up to 1000000 pulses"),
        (["plan", "20", "--plot", "x.bmp"], 1, "unsupported suffix of a plot; use .png"),
        (["plan", "20", "--plot", "/nowhere/x.png"], 1, "cannot be written"),
        (["stop"], 1, "nothing to stop"),
        (["--port", "", "info"], 1, "--port or OPENPPMC_PORT"),
        (["--port", "/dev/ttyNOPE", "info"], 1, "no such port"),
        (["--port", "model:foo=1", "info"], 1, "unknown word 'foo'"),
        (["--port", FAST + ",unplug=0.3", "move", "20000"], 1, "the port went away"),
        (["--port", FAST + ",alarm=4100..4200", "move", "1000"], 1, "alarm input ended the motion"),
        (["--baud", "9600", "info"], 1, "9600 baud is not a rate"),
        (["script", "/nowhere.txt"], 1, "nowhere.txt: cannot be read"),
        (["selftest", "--yes"], 1, "use the port of a board, or sim:"),
    ],
)
def test_refusals_are_one_line(run: Run, words: list[str], code: int, text: str) -> None:
    outcome = run(*words)
    assert outcome.code == code
    assert outcome.err.startswith("error: ")
    assert outcome.err.count("\n") == 1
    assert text in outcome.err


def test_a_fault_of_the_program_is_one_line_too(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    def broken(*_: object) -> None:
        raise ZeroDivisionError("oops")

    monkeypatch.setattr("openppmc.cli.common.boards.serial_ports", broken)
    outcome = run("ports")
    assert outcome.code == 1
    assert outcome.err == (
        "error: fault of this program (ZeroDivisionError: oops); set OPENPPMC_DEBUG=1 to see where\n"
    )
    monkeypatch.setenv("OPENPPMC_DEBUG", "1")
    with pytest.raises(ZeroDivisionError):
        main(["ports"])


# ---------------------------------------------------------------------- stored values


def test_the_setup_of_a_port_is_remembered(run: Run) -> None:
    values = SetupValues().merged({"start": 2000.0, "phases": 5})
    store_setup("/dev/ttyUSB7", values.table())
    assert SetupValues().merged(load_setup("/dev/ttyUSB7")) == values
    assert load_setup("/dev/ttyUSB8") == {}
    out = json.loads(run("--port", "/dev/ttyUSB7", "plan", "5", "--high", "9000", "--json").out)
    assert out["setup"]["start_pps"] == 2000
    assert out["setup"]["bytes"][0] == 0x0B
    store_setup(FAST, values.table())
    assert load_setup(FAST) == {}


@pytest.mark.parametrize("text", ["", "{", "[]", '{"setup": 5}', '{"setup": {"bogus": 1}}'])
def test_a_damaged_memory_is_told(run: Run, text: str) -> None:
    store_setup("/dev/ttyUSB7", {})
    (file,) = state_folder().iterdir()
    file.write_text(text)
    outcome = run("--port", "/dev/ttyUSB7", "plan", "5")
    assert outcome.code == 1
    assert outcome.err.startswith("error: ")


# ---------------------------------------------------------------------- script files


def script(tmp_path: Path, text: str) -> str:
    file = tmp_path / "demo.txt"
    file.write_text(text)
    return str(file)


def test_a_script(run: Run, tmp_path: Path) -> None:
    name = script(
        tmp_path,
        """
        # find the way
        init start=1000 high=8000 ramp=100 half-step=yes logic=positive
        HOME ccw fast speed=900
        move 2000
        repeat 3
            move 100
            repeat 2   # nested
                move -20 speed=700
            end
            wait 0.05
        end
        position
        jog cw ramped for 0.1
        stop
        goto 1000
        step cw
        aux on
        auxo 5
        zero
        move 0
        off
        """,
    )
    outcome = run("script", name)
    assert (outcome.code, outcome.err) == (0, "")
    assert outcome.out == f"{name}:13: position 2180\ndone, position 0\n"


@pytest.mark.parametrize(
    ("text", "line", "message"),
    [
        ("move 1\nhup", 2, "unknown command 'hup' (there are at, aux, auxo"),
        ("move", 1, "number of pulses is missing"),
        ("move x", 1, "pulses 'x' is not a whole number"),
        ("move 99999999", 1, "outside -16777216 to 16777216"),
        ("move 1 2 3", 1, "'3' does not belong here"),
        ("move 1 speed=x", 1, "speed 'x' is not a number"),
        ("move 1 speed=nan", 1, "speed nan is outside"),
        ("\n\nmove 1 speed=5", 3, "speed 5 pps is outside 488.281 to 500000 pps"),
        ("init start", 1, "'start' is not of the form name=value"),
        ("init speed=5", 1, "unknown set-up value 'speed'"),
        ("init half-step=maybe", 1, "neither yes nor no"),
        ("init logic=odd", 1, "neither positive nor negative"),
        ("move 1\ninit start=1", 2, "start speed 1 pps is outside"),
        ("repeat 2\ninit ramp=1\nend", 2, "ramp of 1 pulses is outside"),
        ("jog cw", 1, "for SECONDS is missing"),
        ("jog cw fast 2", 1, "jog needs: jog cw|ccw"),
        ("jog up for 2", 1, "neither cw nor ccw"),
        ("jog cw for -2", 1, "outside 0 to 86400"),
        ("repeat\nend", 1, "number of repetitions is missing"),
        ("repeat 0\nmove 1\nend", 1, "outside 1 to"),
        ("repeat 2\nmove 1", 1, "repeat without end"),
        ("repeat 2\nend", 2, "nothing to repeat"),
        ("end", 1, "end without repeat"),
        ("aux maybe", 1, "neither on nor off"),
        ("auxo 16", 1, "outside 0 to 15"),
        ("wait soon", 1, "not a number"),
        ("step", 1, "direction (cw or ccw) is missing"),
        ("home fast 5", 1, "'5' does not belong here"),
        ("", 1, "no command in this file"),
        ("move 10\nmove 50000", 2, "slow-down limit ended the motion"),
        ("off\nmove 1", 2, "not initialised"),
    ],
)
def test_bad_lines_are_told_with_file_and_line(
    run: Run, tmp_path: Path, text: str, line: int, message: str
) -> None:
    name = script(tmp_path, text)
    outcome = run("script", name)
    assert outcome.code == 1
    assert outcome.err.startswith(f"error: {name}:{line}: ")
    assert message in outcome.err
    assert outcome.err.count("\n") == 1


def test_nothing_moves_before_the_whole_file_is_good(run: Run, tmp_path: Path) -> None:
    for bad in ("hup", "init start=1", "repeat 2\nmove 1 speed=5\nend"):
        outcome = run("script", script(tmp_path, f"position\n{bad}"))
        assert (outcome.code, outcome.out) == (1, "")


def test_not_a_text_file(run: Run, tmp_path: Path) -> None:
    file = tmp_path / "x.bin"
    file.write_bytes(b"\xff\xfe\x00move")
    assert "not a text file" in run("script", str(file)).err


def test_program_nesting_is_bounded() -> None:
    with pytest.raises(ScriptError, match="deeper"):
        read_program("repeat 2\n" * 30 + "move 1\n" + "end\n" * 30, "x")
    with pytest.raises(PpmcError):
        SetupValues().merged({"bogus": 1})


# ---------------------------------------------------------------------- Ctrl-C, real time, real processes


def interrupted(name: str, signals: int, cwd: Path) -> subprocess.CompletedProcess[str]:
    """Run a script in a separate process, and send Ctrl-C half a second after its first line of output.

    A second Ctrl-C follows if `signals` is 2.
    """
    env = dict(os.environ, PYTHONPATH=str(Path(__file__).parents[3]), PYTHONUNBUFFERED="1")
    process = subprocess.Popen(
        [sys.executable, "-m", "openppmc.cli", "--port", "model:", "script", name],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env=env,
        cwd=cwd,
    )
    assert process.stdout is not None
    assert process.stdout.readline().endswith("position 0\n")
    time.sleep(0.5)  # the motion that follows runs in real time
    process.send_signal(signal.SIGINT)
    if signals == 2:
        time.sleep(0.4)
        process.send_signal(signal.SIGINT)
    out, err = process.communicate(timeout=30)
    return subprocess.CompletedProcess(name, process.returncode, out, err)


@pytest.mark.parametrize(("again", "least", "most"), [(False, 1900, 2300), (True, 0, 500)])
def test_the_second_ctrl_c_is_not_patient(
    monkeypatch: pytest.MonkeyPatch, again: bool, least: int, most: int
) -> None:
    """After the second Ctrl-C the motor stops immediately instead of completing the deceleration ramp.

    The first Ctrl-C occurs two seconds after the start of a ramp of 11 000 pulses, so the deceleration would
    take about two more seconds.
    """
    with Ppmc104.open(FAST) as axis:
        axis.initialise(start_pps=1000, high_pps=1200, ramp_pulses=11_000)
        axis.start_move(30_000)
        axis.link.pause(2)
        before = axis.position
        guard = Guard()
        guard.count = 1
        stop = axis.stop

        def stop_and_ctrl_c(wait: bool) -> None:
            stop(wait=wait)
            guard.count += again

        monkeypatch.setattr(axis, "stop", stop_and_ctrl_c)
        text = guard.stop_motors(axis)
        assert ("stopped immediately" in text) == again
        assert text.endswith(f"position {axis.position}")
        assert least <= axis.position - before <= most
        assert not axis.status().busy


@pytest.mark.skipif(os.name == "nt", reason="Windows sends no SIGINT to another process")
@pytest.mark.parametrize(
    ("body", "signals", "word"),
    [
        ("move 30000", 1, "stopped"),
        ("init start=1000 high=1200 ramp=11000\nposition\nmove 30000", 2, "stopped immediately"),
        ("jog cw for 30", 1, "stopped"),
        ("wait 30", 1, "nothing was moving"),
        ("repeat 1000\nmove 3\nmove -3\nend", 1, "interrupted"),
    ],
)
def test_ctrl_c(tmp_path: Path, body: str, signals: int, word: str) -> None:
    name = script(tmp_path, body if "position" in body else "position\n" + body)
    done = interrupted(name, signals, tmp_path)
    assert done.returncode == 130
    assert done.stderr.startswith("interrupted: ")
    assert word in done.stderr
    assert done.stderr.count("\n") == 1
    assert "position " in done.stderr
    if word.startswith("stopped"):
        position = int(done.stderr.rsplit(" ", 1)[1])
        assert 300 < position < 8000
    if signals == 2:
        assert "stopped immediately" in done.stderr
