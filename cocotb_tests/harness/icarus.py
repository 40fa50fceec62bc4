"""Makes the program of a simulation with Icarus Verilog, in four states: plain Verilog alone, see `plain`.

What has no level (X) at an output that a bench watches is an error there (`Stock`).
"""

from __future__ import annotations

import shutil
import subprocess
from collections.abc import Iterable
from pathlib import Path

INSTALL = "Icarus Verilog is not installed (Debian: apt-get install iverilog)"


def installed() -> bool:
    """Whether there is an Icarus Verilog."""
    return shutil.which("iverilog") is not None and shutil.which("vvp") is not None


def compile_verilog(top: str, sources: Iterable[Path], folder: Path, log: Path) -> None:
    """Make `folder`/sim.vvp, where cocotb's runner looks for it; all that the compiler says goes to `log`.

    Raises subprocess.CalledProcessError. Control files of Verilator among the sources are left out.
    """
    folder.mkdir(parents=True, exist_ok=True)
    steps = folder / "steps.f"
    steps.write_text("+timescale+1ps/1ps\n", encoding="ascii")
    files = [str(path) for path in sources if path.suffix == ".v"]
    with open(log, "w", encoding="utf-8") as out:
        subprocess.run(
            [
                "iverilog",
                "-g2005",
                "-Wall",
                "-Wno-timescale",
                "-o",
                "sim.vvp",
                "-s",
                top,
                "-f",
                "steps.f",
                *files,
            ],
            cwd=folder,
            stdin=subprocess.DEVNULL,
            stdout=out,
            stderr=subprocess.STDOUT,
            check=True,
        )
