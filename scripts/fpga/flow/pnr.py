"""Place and route of a mapped netlist with nextpnr for each seed: Fmax and cells after packing."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
from dataclasses import dataclass
from pathlib import Path

from cocotb_tests.harness.project import ROOT, ProjectError, relative, tool

CLOCK = "clk"


@dataclass(frozen=True)
class Device:
    """One FPGA.

    Attributes:
        ask_mhz: clock constraint for nextpnr in MHz.
        goal_mhz: required clock rate in MHz.
        pins: number of I/O pins.
    """

    name: str
    family: str
    arguments: tuple[str, ...]
    ask_mhz: float
    goal_mhz: float
    pins: int
    wrapped: bool = False  # True: too few pins for a part, so its signals pass through shift registers


DEVICES = (
    Device(
        "ECP5-25F",
        "ecp5",
        ("--25k", "--package", "CABGA381", "--speed", "6", "--lpf-allow-unconstrained"),
        120,
        100,
        197,
    ),
    Device("iCE40 HX8K", "ice40", ("--hx8k", "--package", "ct256", "--pcf-allow-unconstrained"), 60, 48, 206),
    Device(
        "iCE40 UP5K",
        "ice40",
        ("--up5k", "--package", "sg48", "--pcf-allow-unconstrained"),
        30,
        24,
        39,
        wrapped=True,
    ),
)


@dataclass(frozen=True)
class Run:
    """Result of one run: seed, Fmax of `clk` in MHz, cells of each type, slowest path as text."""

    seed: int
    fmax: float
    used: dict[str, int]
    path: str


def slowest_path(report: dict) -> str:
    """Return the slowest register-to-register path of `clk`, with its ends and its delays."""
    paths = [p["path"] for p in report["critical_paths"] if "posedge" in p["from"] and "posedge" in p["to"]]
    if not paths:
        return ""
    steps = max(paths, key=lambda path: sum(step["delay"] for step in path))
    first, last = (
        re.split(r"\\|_(?:LUT4|SB_|TRELLIS|CCU2C|PFUMX)", step[side]["cell"])[0]
        for step, side in ((steps[0], "from"), (steps[-1], "to"))
    )
    spent = {
        kind: sum(step["delay"] for step in steps if step["type"] == kind)
        for kind in ("clk-to-q", "logic", "routing")
    }
    levels = sum(step["type"] == "logic" for step in steps)
    return (
        f"{first} → {last}: {sum(step['delay'] for step in steps):.1f} ns ({spent['clk-to-q']:.1f} clk-to-q, "
        f"{levels} cells {spent['logic']:.1f}, routing {spent['routing']:.1f})"
    )


def run(device: Device, folder: Path, log: Path, options: tuple[str, ...]) -> None:
    """Run nextpnr in `folder` with output to `log`; raise ProjectError with its error lines if it fails."""
    program = f"yowasp-nextpnr-{device.family}"
    command = [tool(program), "--quiet", "--log", log.name, *options, *device.arguments]
    try:
        done = subprocess.run(
            command, cwd=folder, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False
        )
    except FileNotFoundError:
        raise ProjectError(f"{program} is not installed: run `make setup`") from None
    if done.returncode:
        text = done.stderr + done.stdout
        lines = [line for line in text.splitlines() if "ERROR" in line][:4] or text.splitlines()[-4:]
        raise ProjectError(
            "\n".join([f"{program} failed for {device.name} ({relative(log)} below {ROOT.name})", *lines])
        )


def packed(device: Device, netlist: Path, folder: Path) -> dict[str, int]:
    """Return the cells of each type after packing, even if the netlist has more pins than the device."""
    local = folder / "pack-netlist.json"
    shutil.copyfile(netlist, local)
    log = folder / "pack.log"
    run(device, folder, log, ("--json", local.name, "--pack-only"))
    return {
        kind: int(used)
        for kind, used in re.findall(r"^Info:\s+(\w+):\s+(\d+)/", log.read_text(), re.MULTILINE)
    }


def place_and_route(device: Device, netlist: Path, folder: Path, seed: int) -> Run:
    """Run nextpnr with one seed; raise ProjectError with its error lines if it fails.

    The WebAssembly build can only read the working folder, so all paths are relative to it.
    """
    stem = f"{device.name.replace(' ', '-').lower()}-s{seed}"
    folder.mkdir(parents=True, exist_ok=True)
    local = folder / f"{stem}-netlist.json"
    shutil.copyfile(netlist, local)
    report, log = folder / f"{stem}.json", folder / f"{stem}.log"
    report.unlink(missing_ok=True)
    options = (
        "--seed",
        str(seed),
        "--freq",
        str(device.ask_mhz),
        "--timing-allow-fail",
        "--report",
        report.name,
    )
    run(device, folder, log, ("--json", local.name, *options))
    if not report.is_file():
        raise ProjectError(f"nextpnr wrote no report for {device.name} ({relative(log)} below {ROOT.name})")
    data = json.loads(report.read_text())
    clocks = {name: entry["achieved"] for name, entry in data["fmax"].items()}
    ours = [mhz for name, mhz in clocks.items() if CLOCK in name] or list(clocks.values())
    used = {kind: entry["used"] for kind, entry in data["utilization"].items() if entry["used"]}
    return Run(seed, round(min(ours), 2), used, slowest_path(data))
