"""`make test MODEL=1`: tests of each part run on the golden model; those for the RTL alone say why not."""

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
    "ppmc2104": ("p2104_bus_10", "the model counts in clk"),
    "stmc": ("stmc_bad_13_short_strobes", "the model counts in clk"),
}


def on_the_model(part: str, *words: str) -> str:
    """What pytest prints of the tests of a part with these words in their names."""
    chosen = ("-k", " or ".join(words), "-rs", "-p", "no:cacheprovider")
    command = [sys.executable, "-m", "pytest", "-q", "--model", *chosen, f"cocotb_tests/{part}/test_part.py"]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


@pytest.mark.parametrize("part", SAMPLES)
def test_a_sample_of_each_part_runs_on_the_model(part: str) -> None:
    """Given directed tests of a part, when they are run with --model, then they pass and none is left out."""
    told = on_the_model(part, *SAMPLES[part])
    assert " passed" in told and "skipped" not in told


@pytest.mark.parametrize("part", RTL_ONLY)
def test_what_the_model_cannot_run_is_skipped_with_its_reason(part: str) -> None:
    """Given a test of strobes or glitches between clk edges, then --model skips it and says why."""
    name, why = RTL_ONLY[part]
    told = on_the_model(part, name)
    assert "skipped" in told and "passed" not in told and "RTL only: " in told and why in told
