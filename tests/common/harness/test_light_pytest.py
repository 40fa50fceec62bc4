"""The stand-in for pytest in simulations: enough for cocotb, and the real one for whoever wants more."""

from __future__ import annotations

import os
import subprocess
import sys

import pytest

from cocotb_tests.harness.build import LIGHT


def said(program: str) -> str:
    """Output of a Python whose first folder is the stand-in's."""
    env = {**os.environ, "PYTHONPATH": str(LIGHT)}
    command = [sys.executable, "-c", program]
    done = subprocess.run(command, env=env, capture_output=True, text=True, check=True)
    return done.stdout.strip()


def test_cocotb_does_with_it() -> None:
    """cocotb imports all that it needs of pytest, and pytest itself is not loaded."""
    program = "import sys, cocotb.regression, pytest; print(pytest.__file__, '_pytest.python' in sys.modules)"
    assert said(program) == f"{LIGHT / 'pytest.py'} False"


def test_the_real_one_is_there() -> None:
    """A script that uses marks and raises() gets them from pytest."""
    program = "import pytest; print(pytest.mark.parametrize, pytest.approx(1) == 1)"
    program += "; import pytest; print(pytest.__file__)"
    first, second = said(program).splitlines()
    assert "parametrize" in first and first.endswith("True")
    assert second == pytest.__file__
