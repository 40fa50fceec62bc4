"""The command `openppmc` on the virtual board, as a user types it."""

from __future__ import annotations

import json
import os
import signal
from pathlib import Path

import pytest

from openppmc.host import Ppmc104
from openppmc.sim import SimBoard

from .fixtures import PATIENCE, CommandLine, StartBoard, Wait, one_line

# Options of the set-up. Each motion command applies them.
SLOW = ("--start", "1000", "--high", "4000", "--ramp", "300")


def test_info(board: SimBoard, openppmc: CommandLine) -> None:
    """`info --json` reports the clocks of the board."""
    code, out, err = openppmc.run(board.port, "info", "--json")
    assert code == 0, err
    values = json.loads(out)
    assert 8_000_000 in values.values() and 16_000_000 in values.values()


def test_init_move_home(board: SimBoard, openppmc: CommandLine) -> None:
    """A session of single commands works; the set-up is stored for the port."""
    for words in (("init", *SLOW), ("move", "500"), ("move", "--", "-200"), ("home",)):
        code, _, err = openppmc.run(board.port, *words)
        assert code == 0, f"{words}: {err}"
    now = board.status()
    assert now.position == 0 and now.cnp


def test_limit_is_one_line(start_board: StartBoard, openppmc: CommandLine) -> None:
    """A move into the limit switch ends with status 1 and prints one line."""
    board = start_board(start=39_500)
    code, _, err = openppmc.run(board.port, "move", "2000", *SLOW)
    assert code == 1 and one_line(err), err


@pytest.mark.parametrize("words", [("move", "30000"), ("jog", "cw", "--ramped")], ids=["move", "jog"])
def test_ctrl_c_decelerates(
    board: SimBoard, openppmc: CommandLine, until: Wait, words: tuple[str, ...]
) -> None:
    """Ctrl-C stops the motor with its deceleration ramp; the next program that connects finds the motor at
    standstill.
    """
    process = openppmc.begin(board.port, *words, *SLOW)
    try:
        until(lambda: board.status().pulses > 1000, "motor at high speed")
        before = board.status().pulses
        process.send_signal(signal.SIGINT)
        _, err = process.communicate(timeout=PATIENCE)
    finally:
        process.kill()
    assert process.returncode == 130 and "interrupted" in err and "Traceback" not in err
    after = board.status()
    assert after.pulses >= before + 300, "stopped without its ramp of 300 pulses"
    until(lambda: board.status().hold, "motor at rest")
    assert board.status().pulses == after.pulses
    with Ppmc104.open(board.port) as axis:
        assert not axis.status().busy
        assert axis.position == after.position - 4000


def test_sim_port(openppmc: CommandLine, tmp_path: Path) -> None:
    """`--port sim:…` starts a separate board for one command; the log of this board contains every pulse."""
    log = tmp_path / "pulses.txt"
    code, _, err = openppmc.run(f"sim:start=300,log={log}", "home", *SLOW)
    assert code == 0, err
    assert log.read_text().splitlines()[-1].split()[1:] == ["1", "0"]


def test_ctrl_c_on_sim_port(openppmc: CommandLine, tmp_path: Path, until: Wait) -> None:
    """If Ctrl-C reaches the command and its virtual board, the board continues until the deceleration ramp is
    complete.
    """
    log = tmp_path / "pulses.txt"
    process = openppmc.begin(f"sim:log={log}", "move", "30000", *SLOW)
    children = Path(f"/proc/{process.pid}/task/{process.pid}/children")
    try:
        # The log is written in blocks of about 200 lines.
        until(lambda: log.exists() and log.read_text().count("\n") > 600, "motor turning")
        for pid in [*children.read_text().split(), str(process.pid)]:
            os.kill(int(pid), signal.SIGINT)
        _, err = process.communicate(timeout=PATIENCE)
    finally:
        process.kill()
    assert process.returncode == 130 and "position" in err, err
    position = int(err.split("position")[1].split()[0])
    assert int(log.read_text().split()[-1]) == 4000 + position < 34_000


@pytest.mark.parametrize(
    ("port", "expected"),
    [
        ("sim:speeed=max", "speed"),
        ("sim:cw=soon", "whole number"),
        ("sim:cw=5,ccw=10", "CW limit"),
        ("sim:clk=4000000", "8e+06"),
    ],
)
def test_bad_text(openppmc: CommandLine, port: str, expected: str) -> None:
    """A mistake in the text after `sim:` produces one line that states the expected value."""
    code, _, err = openppmc.run(port, "info")
    assert code == 1 and one_line(err) and expected in err, err
