"""Hypothesis as in tests/model (new examples with OPENPPMC_EXPLORE=1); the command line in this process."""

from __future__ import annotations

import os
from pathlib import Path

import pytest
from command_line import Outcome, Run
from hypothesis import HealthCheck, settings

from openppmc.cli import main

_COMMON = {"deadline": None, "suppress_health_check": [HealthCheck.too_slow, HealthCheck.data_too_large]}
settings.register_profile("host-fixed", derandomize=True, database=None, max_examples=100, **_COMMON)
settings.register_profile("host-explore", print_blob=True, max_examples=1000, **_COMMON)
settings.load_profile("host-explore" if os.environ.get("OPENPPMC_EXPLORE") else "host-fixed")


@pytest.fixture
def run(
    request: pytest.FixtureRequest,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
    tmp_path: Path,
) -> Run:
    """Call the command line in this process; the port is PORT of the module unless --port says otherwise."""
    monkeypatch.setenv("OPENPPMC_STATE", str(tmp_path / "state"))
    monkeypatch.setenv("OPENPPMC_PORT", request.module.PORT)
    monkeypatch.delenv("OPENPPMC_PART", raising=False)
    monkeypatch.setenv("COLUMNS", "120")

    def call(*words: str) -> Outcome:
        code = main(list(words))
        captured = capsys.readouterr()
        assert "Traceback" not in captured.out + captured.err
        return Outcome(code, captured.out, captured.err)

    return call
