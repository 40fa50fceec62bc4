"""The command line in this process."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from openppmc.cli import main
from tests.common.cli.command_line import Outcome, Run


@pytest.fixture
def run(
    request: pytest.FixtureRequest,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
    tmp_path: Path,
) -> Run:
    """Call the command line in this process; without --port, the port is PORT of the test module."""
    monkeypatch.setenv("OPENPPMC_STATE", str(tmp_path / "state"))
    monkeypatch.setenv("OPENPPMC_PORT", request.module.PORT)
    monkeypatch.delenv("OPENPPMC_PART", raising=False)
    monkeypatch.setenv("COLUMNS", "120")

    def call(*words: str) -> Outcome:
        code = main(list(words))
        out, err = (text.replace(os.linesep, "\n") for text in capsys.readouterr())
        assert "Traceback" not in out + err
        return Outcome(code, out, err)

    return call
