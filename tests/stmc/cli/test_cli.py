"""The command line with an STMC on the modelled board."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.common.cli.command_line import Run

PORT = "model:speed=max,part=stmc"


def test_the_part_is_named_in_three_ways(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    assert json.loads(run("info", "--json").out)["part"] == "J105 STMC"
    assert "J105 STMC" in run("--port", "model:speed=max", "--part", "stmc", "info").out
    monkeypatch.setenv("OPENPPMC_PART", "stmc")
    assert "J105 STMC" in run("--port", "model:speed=max", "info").out
    assert "the part is a PPMC-104, not" not in run("--port", "model:", "plan", "5").err


def test_motions(run: Run) -> None:
    assert run("move", "20").out == "position 20, 20 pulses CW: complete\n"
    assert run("move", "--speed", "300", "-7").out == "position -7, 7 pulses CCW: complete\n"
    assert run("home", "--fast").out == "position 0: origin found\n"
    assert run("jog", "ccw", "--ramped", "--seconds", "0.1").out.endswith("CCW: stop command\n")
    values = json.loads(run("status", "--json").out)
    assert (values["position"], values["moving"], values["error"]) == (0, False, None)
    assert values["inputs"]["motor_off"] is False and "alarm" not in values["inputs"]


def test_init_and_plan(run: Run, tmp_path: Path) -> None:
    words = ("--start", "345", "--high", "825", "--ramp", "400")
    assert json.loads(run("init", *words, "--json").out)["bytes"] == [0x1A, 141, 59, 0x90, 1]
    out = run("plan", "801", *words).out
    assert "345.213 pps (divisor 141), requested 345 pps" in out and "48675 Hz (external)" in out
    plot = tmp_path / "x.svg"
    values = json.loads(run("plan", "801", *words, "--json", "--plot", str(plot)).out)
    # Worked move W9 (docs/stmc/README.md, 8.4) lasts 66 634 ticks.
    assert values["move"]["seconds"] == pytest.approx(66_634 / 48_675)
    assert plot.stat().st_size > 1000
    flat = ("plan", "5", *words[:4], "--ramp", "0")
    assert "none: high speed immediately" in run(*flat).out
    assert json.loads(run(*flat, "--json").out)["move"]["seconds"] == pytest.approx(4 * 59 / 48_675)
    assert json.loads(run("plan", "5", "--speed", "345", "--json").out)["move"]["seconds"] == pytest.approx(
        4 * 141 / 48_675
    )


def test_a_script(run: Run, tmp_path: Path) -> None:
    file = tmp_path / "demo.txt"
    file.write_text(
        "init start=345 high=2000 ramp=50 phases=5\nhome fast\nmove 300 speed=400\nstep ccw\ngoto 100\n"
    )
    outcome = run("script", str(file))
    assert (outcome.out, outcome.err) == ("done, position 100\n", "")


@pytest.mark.parametrize(
    ("text", "line", "message"),
    [
        ("move 1\noff", 2, "a J105 STMC cannot switch its coils off"),
        ("move 1\naux on", 2, "a J105 STMC has no output AUX"),
        ("auxo 0", 1, "a J105 STMC has no auxiliary outputs"),
        ("move 1 axis=2", 1, "axis 2: a J105 STMC has one axis"),
        ("init long_intervals=yes", 1, "long intervals: a J105 STMC"),
        ("move 1\nmove 5 speed=9800", 2, "speed 9800 pps is outside 190.882 to 9735 pps"),
        ("init start=100 high=2000\nmove 5 speed=3000", 2, "speed 3000 pps is outside 49.0196 to 2500 pps"),
    ],
)
def test_bad_lines_are_found_before_anything_moves(
    run: Run, tmp_path: Path, text: str, line: int, message: str
) -> None:
    file = tmp_path / "demo.txt"
    file.write_text(text)
    assert f"{file}:{line}: {message}" in run("script", str(file)).only_line


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("move", "10", "--pulse-only"), "pulse only: a J105 STMC does not have that"),
        (("move", "10", "--start", "40"), "start speed 40 pps is outside 49.0196 to 2500 pps"),
        (("move", "10", "--ramp", "65536"), "outside 0 to 65535 pulses"),
        (("plan", "10", "--base-clock", "125000"), "this board has 12500 and 48675 Hz"),
        (
            ("--port", PORT + ",slow_cw=4100", "move", "900"),
            "slow-down limit ended the motion at position 200 after 200 of 900",
        ),
        (
            ("--port", PORT + ",alarm=4100..4200", "move", "1000"),
            "MON input ended the motion at position 100",
        ),
        (("--port", PORT + ",read_map=X", "info"), "read_map=X: neither FAMILY nor SHEET"),
        (("--port", "model:read_map=SHEET", "info"), "read_map=SHEET: only an stmc has it"),
        (("--port", PORT + ",xtal=21000000", "info"), "xtal_hz 21000000"),
        (("--port", PORT + ",cw2=5", "info"), "cw2=5: an stmc has one axis"),
    ],
)
def test_refusals_are_one_line(run: Run, words: tuple[str, ...], message: str) -> None:
    assert message in run(*words).only_line
