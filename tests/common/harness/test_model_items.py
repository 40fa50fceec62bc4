"""`make test MODEL=1` runs the tests of each device on the golden model; RTL-only tests state the reason."""

from __future__ import annotations

import subprocess
import sys

import pytest

from cocotb_tests.harness.paths import ROOT

SAMPLES = {
    "ppmc104": ("p104_ac_01", "p104_tim_05_brisk_threshold", "p104_int_03_long_threshold"),
    "ppmc2104": ("p2104_lim_09_two", "p2104_bad_23_reset", "p2104_port_03_reset"),
    "stmc": ("stmc_bad_16_reset", "stmc_clk_05"),
    "ppmc312": ("p312_external_clock_that_stops",),
    "pmc006": ("p006_keys_in_every_clk",),
}
RTL_ONLY = {
    "ppmc104": ("p104_port_02_registers_only", "glitches between two clk edges"),
    "ppmc2104": ("p2104_bus_10", "the model counts in cycles"),
    "stmc": ("stmc_bad_13_short_strobes", "the model counts in cycles"),
}


def on_the_model(part: str, *words: str) -> str:
    """Return pytest's output for the tests of a device whose names contain these words."""
    chosen = ("-k", " or ".join(words), "-rs", "-p", "no:cacheprovider")
    command = [sys.executable, "-m", "pytest", "-q", "--model", *chosen, f"cocotb_tests/{part}/test_part.py"]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


@pytest.mark.parametrize("part", SAMPLES)
def test_a_sample_of_each_part_runs_on_the_model(part: str) -> None:
    """With --model, directed tests of a device pass, and no test is skipped."""
    told = on_the_model(part, *SAMPLES[part])
    assert " passed" in told and "skipped" not in told


@pytest.mark.parametrize("part", RTL_ONLY)
def test_what_the_model_cannot_run_is_skipped_with_its_reason(part: str) -> None:
    """With --model, a test of strobes or glitches between edges of `clk` is skipped, and the reason is
    stated.
    """
    name, why = RTL_ONLY[part]
    told = on_the_model(part, name)
    assert "skipped" in told and "passed" not in told and "RTL only: " in told and why in told
