"""Place and route a netlist without a board, with nextpnr: cells after packing, and Fmax of `clk`."""

from __future__ import annotations

import json
import re
import shutil
from dataclasses import dataclass
from pathlib import Path

from scripts.fpga.flow.board_route import NEXTPNR, run

CLOCK = "clk"


@dataclass(frozen=True)
class Device:
    """One FPGA.

    Attributes:
        arguments: options of nextpnr that select the device.
    """

    name: str
    family: str
    arguments: tuple[str, ...]


ECP5 = Device(
    "ECP5-25F", "ecp5", ("--25k", "--package", "CABGA381", "--speed", "6", "--lpf-allow-unconstrained")
)
HX8K = Device("iCE40 HX8K", "ice40", ("--hx8k", "--package", "ct256", "--pcf-allow-unconstrained"))
ASK_MHZ = 120
"""Clock constraint for nextpnr in MHz. A lower clock rate is not an error."""


def _nextpnr(netlist: Path, folder: Path, stem: str, *options: str) -> None:
    """Run nextpnr for the ECP5 with its log in <stem>.log; raise ProjectError with its error lines.

    The WebAssembly build can only read the working folder, so all paths are relative to it.
    """
    folder.mkdir(parents=True, exist_ok=True)
    local = folder / f"{stem}-netlist.json"
    shutil.copyfile(netlist, local)
    command = [NEXTPNR[ECP5.family], "--quiet", "--log", f"{stem}.log", "--json", local.name]
    run([*command, *options, *ECP5.arguments], folder, ECP5.name)


def packed(netlist: Path, folder: Path) -> dict[str, int]:
    """Return the numbers of cells by type after packing. The netlist may have more pins than the device."""
    _nextpnr(netlist, folder, "pack", "--pack-only")
    used = re.findall(r"^Info:\s+(\w+):\s+(\d+)/", (folder / "pack.log").read_text(), re.MULTILINE)
    return {kind: int(number) for kind, number in used}


def place_and_route(netlist: Path, folder: Path, seed: int) -> float:
    """Return Fmax of `clk` in MHz with one seed; raise ProjectError if nextpnr fails."""
    report = folder / f"s{seed}.json"
    report.unlink(missing_ok=True)
    options = ("--seed", str(seed), "--freq", str(ASK_MHZ), "--timing-allow-fail", "--report", report.name)
    _nextpnr(netlist, folder, f"s{seed}", *options)
    clocks = {name: entry["achieved"] for name, entry in json.loads(report.read_text())["fmax"].items()}
    return round(float(min([mhz for name, mhz in clocks.items() if CLOCK in name] or clocks.values())), 2)
