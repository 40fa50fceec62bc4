"""Makes the program of a simulation with Verilator and make: the custom flow that cocotb's manual describes.

It has one of two main programs: `own` (`verilated_sim.cpp`, with clock and recorder in C++) or `cocotb`, the
one that comes with cocotb, unchanged. SIM_MAIN in the environment chooses; results do not depend on it.
SIM_MAIN=icarus asks for another simulator (`icarus`).
"""

from __future__ import annotations

import os
import subprocess
from collections.abc import Iterable, Sequence
from pathlib import Path

import cocotb_tools.config

from openppmc.sim.common import verilator

HERE = Path(__file__).parent
MAINS = {
    "own": (HERE / "verilated_sim.cpp", HERE / "top.cpp"),
    "cocotb": (Path(cocotb_tools.config.share_dir) / "lib" / "verilator" / "verilator.cpp",),
}
ICARUS = "icarus"
"""In place of one: another simulator."""


def sim_main() -> str:
    """The main program that SIM_MAIN asks for; ValueError if there is none such."""
    name = os.environ.get("SIM_MAIN") or "own"
    if name not in (*MAINS, ICARUS):
        raise ValueError(f"SIM_MAIN={name}: there are {', '.join(MAINS)} and {ICARUS}")
    return name


def verilate(
    top: str, main: str, sources: Iterable[Path], args: Sequence[str], waves: bool, folder: Path, log: Path
) -> None:
    """Make `folder`/`top`; all that the tools say goes to `log`. Raises subprocess.CalledProcessError.

    args: of Verilator. Sources and folders among them are absolute paths; no letter in them matters.
    """
    # cocotb's libraries are found from where the program lies (twice $ for the makefile), and the program is
    # asked for the functions of our main program by their names (`native`).
    libs = verilator.seen_from(folder, cocotb_tools.config.libs_dir)
    words = ["--cc", "--exe", "--vpi", "--prefix", "Vtop", "--top-module", top, "-o", top, "--Mdir", "."]
    words += ["-LDFLAGS", f"-Wl,-rpath,'$$ORIGIN/{libs}' -L{libs} -lcocotbvpi_verilator -rdynamic"]
    words += ["--timescale", "1ps/1ps", *(["--trace"] if waves else []), *args]
    words += map(str, (*MAINS[main], *sources))
    jobs = str(min(4, os.cpu_count() or 1))
    with open(log, "w", encoding="utf-8") as out:
        for command in (verilator.command(words, folder), ["make", "-j", jobs, "-f", "Vtop.mk"]):
            subprocess.run(
                command,
                cwd=folder,
                env=verilator.environment(folder),
                stdin=subprocess.DEVNULL,
                stdout=out,
                stderr=subprocess.STDOUT,
                check=True,
            )
