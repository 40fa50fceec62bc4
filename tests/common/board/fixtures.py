"""Virtual boards for the tests, driven from outside as a user would drive them."""

from __future__ import annotations

import os
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from cocotb_tests.harness.paths import ROOT
from openppmc import sim

StartBoard = Callable[..., sim.SimBoard]
Wait = Callable[..., None]

PATIENCE = 30.0
"""Wall-clock seconds after which a test times out; on a busy computer the board is slower than real time."""

SETUP = {"start_pps": 2000, "high_pps": 20000, "ramp_pulses": 400}
"""A set-up that covers the plant's 40 000 pulses in about 2 s of board time."""


@pytest.fixture
def start_board() -> Iterator[StartBoard]:
    """Start virtual boards and close them after the test."""
    boards: list[sim.SimBoard] = []

    def start(text: str = "", **options: object) -> sim.SimBoard:
        boards.append(sim.start(text, **options))
        return boards[-1]

    yield start
    for board in boards:
        board.close()


@pytest.fixture
def board(start_board: StartBoard) -> sim.SimBoard:
    """Start a board with the default plant."""
    return start_board()


@pytest.fixture
def until() -> Wait:
    """Return a function that waits for an event in another process; if it times out, it fails with `what`."""

    def wait(condition: Callable[[], object], what: str, seconds: float = PATIENCE) -> None:
        end = time.monotonic() + seconds
        while not condition():
            assert time.monotonic() < end, f"after {seconds:g} s still not: {what}"
            time.sleep(0.01)

    return wait


class CommandLine:
    """The program `openppmc` in a separate process."""

    def __init__(self, state: Path) -> None:
        self._env = {**os.environ, "OPENPPMC_STATE": str(state), "PYTHONPATH": str(ROOT), "COLUMNS": "200"}

    def begin(self, port: str, *words: str) -> subprocess.Popen[str]:
        """Start the program with this port; do not wait for its end."""
        command = [sys.executable, "-m", "openppmc.cli", "--port", port, *words]
        return subprocess.Popen(
            command, env=self._env, text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE
        )

    def run(self, port: str, *words: str) -> tuple[int, str, str]:
        """Run the program to its end; return exit status, standard output and standard error."""
        process = self.begin(port, *words)
        out, err = process.communicate(timeout=2 * PATIENCE)
        return process.returncode, out, err


@pytest.fixture
def openppmc(tmp_path: Path) -> CommandLine:
    """Provide the command line with a separate state folder."""
    return CommandLine(tmp_path / "state")


def one_line(text: str) -> bool:
    """Return whether a text is a single line and contains no traceback."""
    return len(text.strip().splitlines()) == 1 and text.startswith("error: ") and "Traceback" not in text
