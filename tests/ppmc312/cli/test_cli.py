"""The command line with a PPMC-312 on the modelled board."""

from __future__ import annotations

import json
import signal
import threading
from pathlib import Path

import pytest

from openppmc.cli.common.session import load_setup
from tests.common.cli.command_line import Run

PORT = "model:speed=max,part=ppmc312"
SHORT = "2500,3\n5000,4\n10000,5\n"


@pytest.fixture
def curve(tmp_path: Path) -> str:
    """Provide a file with a short free curve."""
    path = tmp_path / "curve.csv"
    path.write_text(SHORT)
    return str(path)


def test_the_part_is_named_in_three_ways(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    assert json.loads(run("info", "--json").out)["part"] == "PPMC-312"
    assert "PPMC-312" in run("--port", "model:speed=max", "--part", "ppmc312", "info").out
    monkeypatch.setenv("OPENPPMC_PART", "ppmc312")
    assert "PPMC-312" in run("--port", "model:speed=max", "info").out


def test_motions(run: Run, curve: str) -> None:
    words = ("--curve", curve)
    assert run("move", "20", *words).out == "position 20, 20 pulses CW: complete\n"
    assert run("move", "--speed", "3000", "-7", *words).out == "position -7, 7 pulses CCW: complete\n"
    assert run("move", "--to", "-50", *words).out == "position -50, 50 pulses CCW: complete\n"
    assert run("home", "--fast", *words).out == "position 0: origin found\n"
    assert run("home", "--index", *words).out == "position 0: origin found\n"
    assert run("jog", "ccw", "--ramped", "--seconds", "0.1", *words).out.endswith("CCW: stop command\n")


def test_status(run: Run) -> None:
    values = json.loads(run("status", "--json").out)
    assert (values["position"], values["encoder"], values["moving"]) == (0, 0, False)
    assert (values["state"], values["error"], values["overrides"]) == ("INI", None, 0)
    assert values["inputs"]["run"] is True and values["inputs"]["alarm"] is False
    out = run("status").out
    assert "encoder    0" in out and "state      INI" in out and "last byte" not in out
    assert run("monitor", "--count", "2", "--every", "0.05").out.count("state INI") == 2


def test_init_and_plan(run: Run, tmp_path: Path, curve: str) -> None:
    words = ("--base-clock", "1e6", "--stop", "2000", "--down", "1500")
    values = json.loads(run("init", *words, "--json").out)
    assert bytes(values["blocks"][0]).hex(" ") == "03 0e 00 11 03 e8 01 f4 00 c8 00 07 d0 00 05 dc"
    out = run("init", *words, "--sigmoid").out
    assert "sigmoid, 2000 pulses" in out and "stop speed" in out and "ramp down" in out
    plot = tmp_path / "x.svg"
    values = json.loads(run("plan", "5000", "--base-clock", "1e6", "--json", "--plot", str(plot)).out)
    # Worked move E13 (P312-CHK-17) has 1 532 294 ticks, including 1000 of the last interval.
    assert values["move"]["seconds"] == pytest.approx((1_532_294 - 1000) / 1e6)
    assert (values["move"]["ramp_pulses"], values["move"]["plateau_intervals"]) == (2000, 1000)
    assert plot.stat().st_size > 1000
    small = json.loads(run("plan", "23", "--curve", curve, "--json").out)["move"]
    # Worked move E3 (P312-CHK-15) has 11 pulses while accelerating and 12 while decelerating.
    assert small["profile"] == "triangle" and (small["ramp_pulses"], small["down_pulses"]) == (11, 12)
    assert small["seconds"] == pytest.approx(0.0045)
    flat = json.loads(run("plan", "5", "--curve", curve, "--speed", "5000", "--json").out)["move"]
    assert flat["seconds"] == pytest.approx(4 / 5000) and flat["profile"] == "constant speed"


def test_the_table_comes_back_as_a_curve(run: Run, tmp_path: Path, curve: str) -> None:
    assert run("table", "--curve", curve).out == "pps,up\n2500,3\n5000,4\n10000,5\n"
    out = tmp_path / "linear.csv"
    assert run("table", "--stop", "800", "--out", str(out)).out == f"127 stages: {out}\n"
    lines = out.read_text().splitlines()
    assert len(lines) == 128 and lines[0] == "pps,up,down" and lines[1].startswith("800,,")
    same = json.loads(run("plan", "3000", "--curve", str(out), "--json").out)["move"]
    linear = json.loads(run("plan", "3000", "--stop", "800", "--json").out)["move"]
    assert same["seconds"] == pytest.approx(linear["seconds"], abs=1e-9)


def test_init_is_remembered(run: Run, monkeypatch: pytest.MonkeyPatch, tmp_path: Path, curve: str) -> None:
    monkeypatch.setattr("openppmc.cli.common.session.stores_setup", lambda port: bool(port))
    monkeypatch.chdir(tmp_path)
    run("init", "--curve", "curve.csv")
    assert load_setup(PORT)["curve"] == curve
    monkeypatch.chdir("/")
    assert json.loads(run("init", "--json").out)["shape"] == "free curve"


def test_overrides_and_the_encoder(run: Run, curve: str) -> None:
    words = ("move", "900", "--curve", curve)
    outcome = run(*words, "--at", "200:5000", "--at", "400:stop")
    assert outcome.code == 1 and "ended the motion at position 407 after 407 of 900" in outcome.err
    assert run(*words, "--at", "200:5000").out == (
        "position 900, 900 pulses CW: complete\noverride: speed changed with a ramp\n"
    )
    outcome = run(*words, "--at", "5:5000")
    assert outcome.out == "position 900, 900 pulses CW: complete\n"
    assert "error: an override was not executed (the state did not allow it)" in outcome.only_line
    blocked = ("--port", PORT + ",block=4100", *words, "--encoder", "20")
    assert run(*blocked).out == "position 900, 900 pulses CW: complete\nencoder: outside its range\n"


def test_a_script(run: Run, tmp_path: Path, curve: str) -> None:
    file = tmp_path / "demo.txt"
    file.write_text(
        f"""
        init curve={curve}
        watch 20
        at 300 5000      # another speed on the way
        at 600 stop
        jog cw ramped for 1
        position
        event 1 move -7
        event 1 outputs 9
        event 2 step cw
        pulse 1
        wait 0.1
        pulse 2
        wait 0.1
        position
        pulse 1
        event 1 delete
        watch off
        home fast
        off
        auxo 63
        """
    )
    outcome = run("script", str(file))
    assert outcome.err == ""
    assert outcome.out.splitlines() == [
        "override: speed changed with a ramp",
        "override: stopped with a ramp",
        f"{file}:7: position 607",
        "event: instruction 82 executed",
        "stopped at position 600: normal",
        "event: instruction 84 executed",
        "stopped at position 601: normal",
        f"{file}:15: position 601",
        "event: instruction 26 executed",
        "done, position 0",
    ]


@pytest.mark.parametrize(
    ("text", "line", "message"),
    [
        ("at 5", 1, "at needs: at POSITION stop"),
        ("at 5 fast", 1, "'5:fast' is not POSITION:stop"),
        ("event 3 stop", 1, "there are events 1 and 2"),
        ("event 1 hop", 1, "'hop': no action of an event; use move"),
        ("event 1", 1, "event needs"),
        ("event 1 step up", 1, "'up' is neither cw nor ccw"),
        ("event 1 move far", 1, "'far' is not a whole number"),
        ("event 1 stop now", 1, "0 words expected here, not 1"),
        ("pulse", 1, "1 word expected here, not 0"),
        ("watch 0", 1, "outside 1 to 65535"),
        ("auxo 64", 1, "outputs 64 is outside 0 to 63"),
        ("aux on", 1, "a PPMC-312 has no output AUX; use auxo"),
        ("move 5\nmove 1 axis=2", 2, "axis 2: a PPMC-312 has one axis"),
        ("move 5\ninit ramp=9", 2, "the ramp is too short"),
        ("move 5\nmove 5 speed=50", 2, "speed 50 pps is outside 122.072"),
    ],
)
def test_bad_lines_are_found_before_anything_moves(
    run: Run, tmp_path: Path, text: str, line: int, message: str
) -> None:
    file = tmp_path / "demo.txt"
    file.write_text(text)
    assert f"{file}:{line}: " in (told := run("script", str(file)).only_line) and message in told


@pytest.mark.parametrize("line", ["at 5 stop", "event 1 stop", "pulse 1", "watch 5"])
def test_words_that_other_parts_do_not_know(run: Run, tmp_path: Path, line: str) -> None:
    file = tmp_path / "demo.txt"
    file.write_text(line)
    outcome = run("--port", "model:speed=max", "script", str(file))
    assert f"{file}:1: a PPMC-104 has neither overrides nor events" in outcome.only_line


@pytest.mark.parametrize(
    ("words", "message", "code"),
    [
        (("move", "10", "--pulse-only"), "pulse only: a PPMC-312 does not have that", 1),
        (("move", "10", "--phases", "5"), "phase outputs: a PPMC-312 does not have that", 1),
        (("move", "10", "--ramp", "300"), "each of its stages needs 2 pulses: 762 or more", 1),
        (("move", "10", "--speed", "20000"), "outside 1000 to 5000 pps, the speeds of the table", 1),
        (("move", "10", "--at", "5"), "--at '5' is not POSITION:stop", 2),
        (("move", "10", "--at", "5:-4"), "--at '5:-4' is not POSITION:stop", 2),
        (("move", "10", *(9 * ("--at", "5:stop"))), "9 overrides: too many; a PPMC-312 stores 8", 1),
        (("move", "10", "--at", "5:9000"), "speed 9000 pps is outside 1000 to 5000 pps", 1),
        (("move", "10", "--encoder", "0"), "'--encoder': ", 2),
        (("plan", "0"), "0 pulses: a move has 1 to 4294967295", 1),
        (("init", "--curve", "no.csv"), "no.csv: cannot be read", 1),
        (("table", "--out", "/no/where.csv"), "where.csv: cannot be written", 1),
        (("stop",), "the part has no table", 1),
        (("--port", PORT + ",cw=4200", "move", "900"), "limit switch ended the motion at position 200", 1),
        (("--port", PORT + ",alarm=4100..4200", "move", "900"), "alarm input ended the motion", 1),
        (
            ("--port", PORT + ",index=-1", "info"),
            "index=-1: must not be negative; use the pulses of a turn",
            1,
        ),
        (("--port", PORT + ",cw2=5", "info"), "cw2=5: a ppmc312 has one axis", 1),
        (("--port", "model:index=400", "info"), "index=400: only a ppmc312 has an encoder", 1),
        (("--port", "model:", "move", "9", "--at", "5:stop"), "overrides: a PPMC-104 does not have that", 1),
        (("--port", "model:", "move", "9", "--encoder", "5"), "encoder: a PPMC-104 does not have that", 1),
        (("--port", "model:", "home", "--index"), "index: a PPMC-104 does not have that", 1),
        (("--port", "model:", "table"), "table: a PPMC-104 does not have that", 1),
        (("--port", "model:", "init", "--sigmoid"), "ramps of other shapes: a PPMC-104", 1),
        (("--port", "model:", "init", "--stop", "500"), "a separate deceleration: a PPMC-104", 1),
    ],
)
def test_refusals_are_one_line(run: Run, words: tuple[str, ...], message: str, code: int) -> None:
    outcome = run(*words)
    assert message in outcome.only_line and outcome.code == code


def test_ctrl_c_decelerates(run: Run, tmp_path: Path) -> None:
    curve = tmp_path / "slow.csv"  # so slow that the test also works on a busy computer
    curve.write_text("250,3\n500,4\n1000,5\n")
    timer = threading.Timer(0.5, lambda: signal.raise_signal(signal.SIGINT))
    timer.start()
    port = "model:speed=1,part=ppmc312,cw=400000,slow_cw=390000"
    outcome = run("--port", port, "jog", "cw", "--ramped", "--curve", str(curve))
    timer.cancel()
    assert outcome.code == 130 and outcome.err.startswith("interrupted: stopped, position ")
