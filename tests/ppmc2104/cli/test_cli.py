"""The command line with a PPMC-2104 on the modelled board."""

from __future__ import annotations

import json
import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from openppmc.cli.common.session import Guard, load_setup, store_setup
from openppmc.host import CW, Ppmc2104
from tests.common.cli.command_line import Run

TWO = PORT = "model:speed=max,part=ppmc2104"


def test_the_part_is_named_in_four_ways(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    assert json.loads(run("info", "--json").out)["part"] == "PPMC-2104"
    for port in ("model:", "model:speed=max", "model:speed=max,part=ppmc104"):
        values = json.loads(run("--port", port, "--part", "ppmc2104", "info", "--json").out)
        assert (values["part"], values["axes"]) == ("PPMC-2104", 2)
    monkeypatch.setenv("OPENPPMC_PART", "ppmc2104")
    assert "PPMC-2104" in run("--port", "model:speed=max", "info").out
    monkeypatch.delenv("OPENPPMC_PART")
    assert json.loads(run("--port", "model:speed=max", "info", "--json").out)["part"] == "PPMC-104"


def test_moves(run: Run) -> None:
    assert run("move", "20").out == "axis 1: position 20, 20 pulses CW: complete\n"
    assert run("move", "-20", "--axis", "2").out == "axis 2: position -20, 20 pulses CCW: complete\n"
    both = "axis 1: position 300, 300 pulses CW: complete\naxis 2: position -40, 40 pulses CCW: complete\n"
    assert run("move", "300", "-40").out == both
    assert run("move", "--to", "300", "-40", "--speed", "900").out == both
    assert "0 pulses" in run("move", "0", "7").out
    assert run("jog", "cw", "--axis", "2", "--seconds", "0.2").out.startswith("axis 2: position ")
    assert run("home", "--axis", "2", "--fast").out == "axis 2: position 0: origin found\n"


def test_init_an_axis(run: Run) -> None:
    words = ("--start", "5000", "--high", "25000", "--ramp", "10", "--chop", "--json")
    assert json.loads(run("init", *words).out)["bytes"] == [0x12, 99, 19, 10, 0]
    assert json.loads(run("init", "--axis", "2", *words).out)["bytes"] == [0x32, 99, 19, 10, 0]


def test_set_ups_are_remembered_for_each_axis(run: Run) -> None:
    store_setup("/dev/ttyUSB7", {"start": 2000.0})
    store_setup("/dev/ttyUSB7", {"start": 3000.0, "logic": None}, 2)
    assert (load_setup("/dev/ttyUSB7")["start"], load_setup("/dev/ttyUSB7", 2)["start"]) == (2000, 3000)


def test_status_of_both_and_of_one(run: Run) -> None:
    values = json.loads(run("status", "--json").out)
    assert sorted(values) == ["axis1", "axis2"]
    one = json.loads(run("status", "--axis", "2", "--json").out)
    assert one == values["axis2"]
    assert (one["position"], one["moving"], one["error"], one["inputs"]["alarm"]) == (0, False, None, False)
    assert "axis 2 motor      at rest" in run("status").out
    assert run("monitor", "--count", "2", "--every", "0.05").out.count("axis 1 position 0") == 2


def test_plan(run: Run) -> None:
    values = json.loads(
        run("plan", "500", "--start", "5000", "--high", "25000", "--ramp", "10", "--json").out
    )
    assert values["setup"]["bytes"] == [2, 99, 19, 10, 0]
    assert values["move"]["plateau_intervals"] == 479
    values = json.loads(run("plan", "500", "--speed", "250000", "--json").out)
    assert values["move"]["top_pps"] == 250_000
    assert "outside 1953.12 to 250000" in run("plan", "5", "--start", "3000", "--high", "300000").err


@pytest.mark.parametrize(
    ("words", "line", "code"),
    [
        (("move", "1", "2", "3"), "axis 3: a PPMC-2104 has axes 1 to 2", 1),
        (("move", "1", "2", "--axis", "1"), "--axis 1: only for one value and without --axes", 2),
        (("move", "1", "--axis", "3"), "axis 3: a PPMC-2104 has axes 1 to 2", 1),
        (("move", "1", "--axis", "65"), "Invalid value for '--axis'", 2),
        (("move", "1", "--axis", "1", "--axes", "1"), "--axis 1: only for one value and without --axes", 2),
        (("move", "1", "2", "--axes", "1"), "--axes 1: 1 axes for 2 values", 2),
        (("move", "1", "2", "--axes", "1,1"), "--axes 1,1: an axis occurs twice", 2),
        (("move", "1", "2", "--axes", "1,b"), "--axes 1,b: not a list of axes; write 1,2,5", 2),
        (("--part", "ppmc999", "info"), "'ppmc999' is not one of 'ppmc104', 'ppmc2104', 'stmc'", 2),
        (("--port", "model:speed=max", "move", "1", "2"), "axis 2: a PPMC-104 has one axis", 1),
        (("--port", "model:speed=max", "jog", "cw", "--axis", "2"), "axis 2: a PPMC-104 has one axis", 1),
        (("--port", "model:speed=max", "status", "--axis", "2"), "axis 2: a PPMC-104 has one axis", 1),
        (("--port", "model:part=x", "info"), "part=x: there are ppmc104, ppmc2104, stmc", 1),
        (("--port", "model:cw2=1", "info"), "cw2=1: a ppmc104 has one axis", 1),
        (("move", "5", "--logic", "positive"), "positive logic: a PPMC-2104 does not have that", 1),
        (("move", "5", "--long-intervals"), "long intervals: a PPMC-2104 does not have that", 1),
        (("move", "5", "--start", "1000", "--high", "1000"), "too close together", 1),
        (("move", "5", "6", "--speed", "300000"), "speed 300000 pps is outside 488.281 to 250000", 1),
        (("move", "50000", "10"), "axis 1: slow-down limit ended the motion at position", 1),
        (("stop",), "nothing to stop", 1),
        (("stop", "--axis", "2", "--now"), "axis 2: nothing to stop", 1),
    ],
)
def test_mistakes(run: Run, words: tuple[str, ...], line: str, code: int) -> None:
    outcome = run(*words)
    assert outcome.code == code
    assert outcome.err.startswith("error: ") and outcome.err.count("\n") == 1
    assert line in outcome.err


# ---------------------------------------------------------------------- script files


def script(tmp_path: Path, text: str) -> str:
    file = tmp_path / "demo.txt"
    file.write_text(text)
    return str(file)


def test_a_script(run: Run, tmp_path: Path) -> None:
    name = script(
        tmp_path,
        """
        init start=2000 high=20000 ramp=100
        init start=2000 high=9000 ramp=50 chop=yes axis=2
        home fast
        home fast axis=2
        move 2000 3000
        repeat 2
            move 100 -50
            move -20 speed=700 axis=2
            wait 0.05
        end
        position
        position axis=2
        jog cw ramped for 0.1 axis=2
        stop
        goto 1000 1500
        goto 1200 axis=2
        step cw axis=2
        auxo 3
        zero axis=2
        off axis=2
        """,
    )
    outcome = run("script", name)
    assert (outcome.code, outcome.err) == (0, "")
    assert outcome.out.splitlines() == [
        f"{name}:12: positions 2200 and 2860",
        f"{name}:13: position 2860",
        "done, positions 1000 and 0",
    ]


def test_a_script_for_one_axis_leaves_the_other_off(run: Run, tmp_path: Path) -> None:
    name = script(tmp_path, "move 10 axis=2\nposition\nmove 5")
    assert run("script", name).out.endswith("done, positions 5 and 10\n")
    assert run("script", script(tmp_path, "move 10 axis=2\nposition")).out.endswith(
        "position 10\ndone, position 10\n"
    )


@pytest.mark.parametrize(
    ("port", "text", "line", "message"),
    [
        (TWO, "move 1\naux on", 2, "a PPMC-2104 has no output AUX"),
        (TWO, "move 1\nauxo 4", 2, "outputs 4 is outside 0 to 3"),
        (TWO, "move 1 axis=3", 1, "axis 3: a PPMC-2104 has axes 1 to 2"),
        (TWO, "move 1 axis=65", 1, "axis 65 is outside 1 to 64"),
        (TWO, "move 1 2 axis=2", 1, "two numbers move both axes; omit axis="),
        (TWO, "wait 1 axis=2", 1, "'axis=2' does not belong here"),
        (TWO, "init logic=positive axis=2", 1, "positive logic: a PPMC-2104"),
        (TWO, "repeat 2\ninit start=5000 high=5000\nend", 2, "too close together"),
        (TWO, "move 1 2 speed=300000", 1, "outside 488.281 to 250000"),
        (TWO, "move 10\noff axis=2\nmove 1 axis=2", 3, "axis 2: it is not initialised"),
        ("model:speed=max", "move 1\nmove 1 axis=2", 2, "axis 2: a PPMC-104 has one axis"),
        ("model:speed=max", "repeat 2\ngoto 1 2\nend", 2, "axis 2: a PPMC-104 has one axis"),
    ],
)
def test_bad_lines(run: Run, tmp_path: Path, port: str, text: str, line: int, message: str) -> None:
    name = script(tmp_path, text)
    outcome = run("--port", port, "script", name)
    assert outcome.code == 1
    assert outcome.err.startswith(f"error: {name}:{line}: ")
    assert message in outcome.err and outcome.err.count("\n") == 1


# ---------------------------------------------------------------------- Ctrl-C


@pytest.mark.parametrize("again", [False, True])
def test_ctrl_c_brings_both_to_rest(monkeypatch: pytest.MonkeyPatch, again: bool) -> None:
    """The first Ctrl-C stops both axes with their ramps; a second one during the deceleration stops both
    immediately.
    """
    with Ppmc2104.open(TWO) as part:
        for axis in (part.x, part.y):
            axis.initialise(start_pps=1000, high_pps=1200, ramp_pulses=11_000)
        part.start_moves(30_000, 30_000)
        part.link.pause(2)
        before = [part.x.position, part.y.position]
        guard = Guard()
        guard.count = 1
        stop = part.x.stop

        def stop_and_ctrl_c(wait: bool) -> None:
            stop(wait=wait)
            guard.count += again

        monkeypatch.setattr(part.x, "stop", stop_and_ctrl_c)
        text = guard.stop_motors(part)
        assert ("stopped immediately" in text) == again
        after = [part.x.position, part.y.position]
        assert text.endswith(f", axis 1: position {after[0]}, axis 2: position {after[1]}")
        low, high = (0, 500) if again else (1900, 2300)
        assert all(low <= b - a <= high for a, b in zip(before, after, strict=True))
        # Both immediate stops are sent one directly after the other.
        assert again or abs(after[0] - after[1]) < 5
        assert not any(part.status().busy)


@pytest.mark.skipif(os.name == "nt", reason="Windows sends no SIGINT to another process")
def test_ctrl_c_in_a_real_process(tmp_path: Path) -> None:
    """An interrupted `openppmc move X Y` prints one line and exits with status 130."""
    env = {**os.environ, "OPENPPMC_STATE": str(tmp_path)}
    words = [sys.executable, "-m", "openppmc.cli", "--port", "model:part=ppmc2104"]
    process = subprocess.Popen(
        [*words, "script", script(tmp_path, "position\nmove 30000 30000")],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env=env,
    )
    assert process.stdout is not None
    assert process.stdout.readline().endswith("positions 0 and 0\n")
    time.sleep(0.5)  # the next motion runs in real time
    process.send_signal(signal.SIGINT)
    _, err = process.communicate(timeout=30)
    assert process.returncode == 130
    told = re.fullmatch(r"interrupted: stopped, axis 1: position (-?\d+), axis 2: position (-?\d+)\n", err)
    assert told is not None, err
    x, y = map(int, told.groups())
    # Each axis needs a separate stop command; the time between them depends on the load of the computer.
    assert 0 <= x < 8000 and 0 <= y < 8000


def test_stop_what_another_program_left(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    """`stop` stops every moving axis with its ramp; an axis at constant speed requires --now."""
    with Ppmc2104.open(TWO) as part:
        for axis in (part.x, part.y):
            axis.initialise()
        part.x.jog(CW, high=True)
        part.y.jog(CW, 1000)
        again = Ppmc2104.on(part.link)
        monkeypatch.setattr("openppmc.cli.common.session.open_part", lambda *words: again)
        monkeypatch.setattr(again.link, "close", lambda: None)
        outcome = run("stop")
        assert (
            outcome.code == 1 and "axis 2: the motor is already decelerating, runs at constant" in outcome.err
        )
        assert part.status().busy == (False, True)
        assert run("stop", "--now").out.startswith("axis 2: position ")
        assert part.status().busy == (False, False)
