"""FuseSoC library of the boards in plain Verilog, built by edalize's own flows (D-89).

`make verilog` and a release write the library. `make test WITH=fusesoc BOARD=…` starts this module: it writes
one board again and builds its bitstream with the tools of this environment.
"""

from __future__ import annotations

import argparse
import json
import os
import re
import shutil
import sys
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path

from cocotb_tests.harness import project
from cocotb_tests.harness.project import BUILD, ROOT, ProjectError, console, relative
from scripts.fpga.flow.board_table import BOARDS, Board
from scripts.fpga.flow.boards import CONSTRAINTS
from scripts.fpga.flow.plain_file import FOLDER, write
from scripts.fpga.packages.cores import vlnv

NAME = "openppmc_boards_verilog"
CORE = vlnv("verilog", "boards")
LIBRARY = FOLDER / "boards"
WORK = BUILD / "edalize"
HOST = "uart"  # parameter values that are the defaults of the tops
HEAD = f"""CAPI=2:
# Written by `make verilog` together with the plain Verilog: boards for edalize's open flows.
# fusesoc run --setup --build --target=icebreaker {CORE}
name: {CORE}
description: OpenPPMC, boards with a PPMC-104 in plain Verilog
"""
TYPES = {".pcf": "PCF", ".lpf": "LPF", ".cst": "CST", ".sdc": "SDC"}
# The launcher is required only if the tools of edalize's flows are not installed as programs.
LAUNCHER = ROOT / "scripts" / "fpga" / "flow" / "launcher.py"
_FMAX = re.compile(r"Max frequency for clock .*: ([\d.]+) MHz \((PASS|FAIL) at ([\d.]+) MHz\)")


@dataclass(frozen=True)
class Built:
    """A bitstream, its clock rate in MHz, and the required clock rate in MHz."""

    path: Path
    mhz: float
    required_mhz: float


def constraints(on: Board) -> list[Path]:
    """Return the constraint files: the pins, and the clocks if they are in a separate file."""
    pins = CONSTRAINTS / on.constraints[HOST]
    clocks = pins.with_name("clocks.sdc")
    return [pins, *([clocks] if clocks.is_file() else [])]


def flow(name: str, **options: Iterable[str] | str) -> str:
    """Return an edalize flow with its options as YAML."""
    rows = {key: value if isinstance(value, str) else list(value) for key, value in options.items()}
    text = "".join(f"      {key}: {json.dumps(value)}\n" for key, value in rows.items())
    return f"    flow: {name}\n    flow_options:\n{text}"


def options(on: Board) -> str:
    """Return flow and options of `make bitstream`, except yosys' recipe and further seeds."""
    if on.family == "ice40":
        return flow("icestorm", nextpnr_options=on.route)
    if on.family == "ecp5":
        return flow("trellis", nextpnr_options=on.route, ecppack_options=("--compress",))
    # `on.route` is not passed to nextpnr: edalize itself adds --device and the family, from `named`.
    device = on.route[on.route.index("--device") + 1]
    more = ("--vopt", "sspi_as_gpio", "--freq", f"{on.clk_hz / 1e6:g}")
    packing = ("--sspi_as_gpio",)
    named = {"device": device, "device_family": "C", "board": on.loader}
    return flow("apicula", nextpnr_options=more, gowin_pack_options=packing, **named)


def core(boards: Mapping[str, Board]) -> str:
    """Return the core file with one target for each board."""
    files, targets = "\nfilesets:\n", "\ntargets:\n"
    for name, on in boards.items():
        top, fileset = on.top[HOST], name.replace("-", "_")
        files += f"  {fileset}:\n    files:\n      - {top}.v: {{file_type: verilogSource-2005}}\n"
        for path in constraints(on):
            files += f"      - {path.relative_to(CONSTRAINTS)}: {{file_type: {TYPES[path.suffix]}}}\n"
        targets += f"  # {on.title}, {on.device}, clk {on.clk_hz / 1e6:g} MHz\n"
        targets += f"  {name}:\n    filesets: [{fileset}]\n    toplevel: {top}\n{options(on)}"
    return HEAD + files + targets


def write_library(names: Iterable[str] = (), folder: Path = LIBRARY) -> Path:
    """Write the library of these boards (default: all) into a folder; return the path of its core file."""
    for name in names:
        if name not in BOARDS:
            raise ProjectError(f"BOARD={name}: no FuseSoC target (there are {', '.join(BOARDS)})")
    chosen = {name: BOARDS[name] for name in names or BOARDS}
    shutil.rmtree(folder, ignore_errors=True)
    for top in dict.fromkeys(on.top[HOST] for on in chosen.values()):
        write(top, folder)
    for on in chosen.values():
        for path in constraints(on):
            copy = folder / path.relative_to(CONSTRAINTS)
            copy.parent.mkdir(parents=True, exist_ok=True)
            copy.write_bytes(path.read_bytes())
    made = folder / f"{NAME}.core"
    made.write_text(core(chosen), encoding="utf-8")
    return made


def built_result(name: str, folder: Path) -> Built:
    """Return the result of a board from FuseSoC's folder.

    Raises ProjectError if there is no bitstream, or if the bitstream was made for another clock.
    """
    on = BOARDS[name]
    found = [path for path in folder.glob(f"*{on.suffix}") if path.stat().st_size]
    log = folder / "next.log"
    rates = _FMAX.findall(log.read_text(encoding="utf-8")) if log.is_file() else []
    if not found or not rates:
        raise ProjectError(f"{name}: no bitstream in {relative(folder)}")
    # The last figure in the log is the clock rate after routing.
    reached, result, required_mhz = rates[-1]
    # nextpnr calculates in whole picoseconds.
    if result != "PASS" or abs(float(required_mhz) - on.clk_hz / 1e6) > 0.01:
        raise ProjectError(
            f"{name}: {reached} MHz, {result} at {required_mhz} MHz; clk is {on.clk_hz / 1e6:g} MHz"
        )
    return Built(found[0], float(reached), float(required_mhz))


def build(name: str, library: Path, work: Path = WORK) -> Built:
    """Build a board's bitstream with FuseSoC; raise ProjectError with FuseSoC's last lines if it fails."""
    folder = work / name
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    # The paths are relative, because a space in a path would end a word in the shell of edalize's makefile.
    launcher = [os.path.relpath(path, folder) for path in (sys.executable, LAUNCHER)]
    words = [sys.executable, "-c", "from fusesoc.main import main; main()", "--config", os.devnull]
    words += ["--cores-root", relative(library), "run", "--setup", "--build", f"--target={name}"]
    env = os.environ | {"EDALIZE_LAUNCHER": " ".join(launcher), "MAKEFLAGS": ""}
    code, text = project.ran([*words, f"--work-root={relative(folder)}", CORE], env)
    log = folder / "fusesoc.log"
    log.write_text(text, encoding="utf-8")
    if code:
        lines = [line for line in text.splitlines() if "error" in line.lower()]
        messages = lines[:4] or text.splitlines()[-4:]
        raise ProjectError("\n".join([f"fusesoc --target={name} failed ({relative(log)})", *messages]))
    return built_result(name, folder)


def main() -> int:
    """Run the command line."""
    parser = argparse.ArgumentParser(prog="python -m scripts.fpga.packages.plain_boards", description=__doc__)
    parser.add_argument("board", help=", ".join(BOARDS))
    name = parser.parse_args().board
    library = WORK / "library"
    write_library([name], library)
    built = build(name, library)
    console.print(
        f"[green]ok[/]   {relative(built.path)}, {built.path.stat().st_size} bytes, "
        f"{built.mhz:g} MHz reached, {built.required_mhz:g} MHz required"
    )
    return 0


if __name__ == "__main__":
    sys.exit(project.run(main))
