"""The command line with a bank on the modelled board."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.common.cli.command_line import Run

PORT = "model:speed=max,part=bank,axes=4"


def test_info(run: Run) -> None:
    values = json.loads(run("info", "--json").out)
    assert (values["part"], values["axes"], values["timing"]) == ("PPMC bank", 4, "FAST")
    values = json.loads(run("--port", "model:", "--part", "bank", "info", "--json").out)
    assert values["axes"] == 8


def test_moves(run: Run) -> None:
    assert run("move", "20").out == "axis 1: position 20, 20 pulses CW: complete\n"
    assert run("move", "-20", "--axis", "4").out == "axis 4: position -20, 20 pulses CCW: complete\n"
    three = [
        "axis 1: position 300, 300 pulses CW: complete",
        "axis 2: position -40, 40 pulses CCW: complete",
        "axis 3: position 7, 7 pulses CW: complete",
    ]
    assert run("move", "300", "-40", "7").out.splitlines() == three
    assert run("move", "--to", "300", "-40", "7", "--speed", "900").out.splitlines() == three
    assert run("move", "5", "0", "--axes", "4,2").out.splitlines() == [
        "axis 2: position 0, 0 pulses CW: complete",
        "axis 4: position 5, 5 pulses CW: complete",
    ]
    assert run("move", "9", "--axes", "3").out == "axis 3: position 9, 9 pulses CW: complete\n"
    assert run("jog", "cw", "--axis", "3", "--seconds", "0.2").out.startswith("axis 3: position ")
    assert run("home", "--axis", "2", "--fast").out == "axis 2: position 0: origin found\n"


def test_status_is_a_table_with_a_row_an_axis(run: Run) -> None:
    rows = run("--port", PORT + ",start3=50000", "status").out.splitlines()
    assert rows[0].split("  ")[-1].strip() == "last byte" and rows[0].split()[:2] == ["position", "motor"]
    assert [row.split()[:5] for row in rows[1:]] == [
        ["axis", str(number), "0", "at", "rest"] for number in (1, 2, 3, 4)
    ]
    assert ["limit cw, slow cw" in row for row in rows[1:]] == [False, False, True, False]
    values = json.loads(run("status", "--json").out)
    assert sorted(values) == ["axis1", "axis2", "axis3", "axis4"]
    one = json.loads(run("status", "--axis", "2", "--json").out)
    assert one == values["axis2"]
    assert (one["position"], one["moving"], one["error"], one["inputs"]["alarm"]) == (0, False, None, False)
    assert run("status", "--axis", "2").out.split()[:2] == ["position", "0"]
    assert run("monitor", "--count", "2", "--every", "0.05").out.count("axis 4 position 0") == 2


def test_a_script(run: Run, tmp_path: Path) -> None:
    file = tmp_path / "demo.txt"
    file.write_text("move 100 -50\nmove 30 axis=3\nposition\nposition axis=3\n")
    lines = run("script", str(file)).out.splitlines()
    assert lines == [
        f"{file}:3: positions 100 and -50 and 30",
        f"{file}:4: position 30",
        "done, positions 100 and -50 and 30",
    ]


@pytest.mark.parametrize(
    ("words", "line", "code"),
    [
        (("move", "1", "--axis", "5"), "axis 5: a PPMC bank has axes 1 to 4", 1),
        (("move", "1", "2", "3", "4", "5"), "axis 5: a PPMC bank has axes 1 to 4", 1),
        (("move", "1", "2", "--axes", "1,9"), "axis 9: a PPMC bank has axes 1 to 4", 1),
        (("status", "--axis", "0"), "Invalid value for '--axis'", 2),
        (("move", "5", "--external-clock", "100000"), "external clock: a PPMC bank does not have that", 1),
        (("move", "9", "50000", "10"), "axis 2: slow-down limit ended the motion at position", 1),
        (("stop",), "nothing to stop", 1),
        (("stop", "--now"), "nothing to stop: no axis is moving", 1),
        (("stop", "--axis", "2", "--now"), "axis 2: nothing to stop", 1),
        (("--port", PORT + ",timing=DATASHEET", "info"), "timing=DATASHEET: a bank is always FAST", 1),
        (("--port", PORT + ",clk=9000000", "info"), "clk=9000000: 4 * clk must be a multiple of xtal", 1),
        (
            ("--port", "model:part=bank,axes=32", "info"),
            "32 axes at xtal=16000000 need clk=32000000 at least",
            1,
        ),
        (("--port", "model:part=bank,axes=5", "info"), "axes=5: neither 8 nor 4 nor 16 nor 32 nor 64", 1),
        (("--port", PORT + ",cw5=1", "info"), "cw5=1: a bank has 4 axes", 1),
        (("--port", "model:axes=4", "info"), "axes=4: only a bank has it", 1),
        (("--port", "model:part=ppmc2104,cw3=4", "info"), "cw3=4: a ppmc2104 has 2 axes", 1),
        (("--port", "sim:part=bank,axes=16", "info"), "16 axes at xtal=16000000 need clk=16000000", 1),
    ],
)
def test_mistakes(run: Run, words: tuple[str, ...], line: str, code: int) -> None:
    outcome = run(*words)
    assert outcome.code == code
    assert outcome.err.startswith("error: ") and outcome.err.count("\n") == 1
    assert line in outcome.err
