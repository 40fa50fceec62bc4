"""What `make synth`, `make report` and `make test-gates` share: yosys jobs and place-and-route seeds."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from cocotb_tests.harness import project
from cocotb_tests.harness.project import ProjectError

from . import pnr, scan_wrapper
from .netlist import Breakdown, Count, flat_counts, kept_counts

FAMILIES = ("ecp5", "ice40")
SEEDS = 5


def run_yosys(folder: Path, job: dict) -> Path:
    """Run one synthesis job in its own process; ProjectError with the last lines of its log when it fails."""
    folder.mkdir(parents=True, exist_ok=True)
    stem = f"{job['family']}-{job['recipe']}{'-kept' if job['keep'] else ''}"
    # Relative to the root, where yosys runs: its commands end a name at a space.
    job = {**job, "json": project.relative(folder / f"{stem}.json")}
    job_file, log = folder / f"{stem}.job", folder / f"{stem}.log"
    job_file.write_text(json.dumps(job, indent=1))
    with log.open("w") as sink:
        done = subprocess.run(
            [sys.executable, "-m", "scripts.flow.yosys_job", str(job_file)],
            cwd=project.ROOT,
            stdout=sink,
            stderr=subprocess.STDOUT,
            stdin=subprocess.DEVNULL,
            check=False,
        )
    if done.returncode:
        lines = [line for line in log.read_text().splitlines() if line.strip()]
        errors = [line for line in lines if "error" in line.lower()][:12] or lines[-8:]
        raise ProjectError("\n".join([f"yosys failed ({project.relative(log)})", *errors]))
    return folder / f"{stem}.json"


def synthesize(folder: Path, base: dict, family: str, recipe: str) -> tuple[Breakdown, Path]:
    """Synthesize flattened and with the hierarchy kept; the figures and the flattened netlist's path."""
    job = {**base, "family": family, "recipe": recipe}
    kept = run_yosys(folder, {**job, "keep": True})
    flat = run_yosys(folder, {**job, "keep": False})
    result = Breakdown()
    result.kept, result.module = kept_counts(kept, base["top"])
    result.total, result.flat = flat_counts(flat, base["top"], set(result.kept))
    return result, flat


def synthesize_all(
    folder: Path, base: dict, recipes: dict[str, str]
) -> tuple[dict[str, Breakdown], dict[str, Path]]:
    """Synthesize for all families, two at a time; figures and netlists."""
    with ThreadPoolExecutor(2) as pool:
        jobs = {f: pool.submit(synthesize, folder, base, f, recipes[f]) for f in FAMILIES}
        done = {family: job.result() for family, job in jobs.items()}
    return {f: pair[0] for f, pair in done.items()}, {f: pair[1] for f, pair in done.items()}


def wrapped_netlist(
    folder: Path, base: dict, netlist: Path, recipe: str, family: str = "ice40", **pins: str
) -> Path:
    """Netlist of the part inside the pin-saving wrapper; `pins` as scan_wrapper.source takes them."""
    wrapper = folder / "wrapped" / f"{scan_wrapper.NAME}.sv"
    wrapper.parent.mkdir(parents=True, exist_ok=True)
    wrapper.write_text(scan_wrapper.source(netlist, base["top"], base["params"], **pins))
    job = {
        **base,
        "top": scan_wrapper.NAME,
        "sources": [*base["sources"], project.relative(wrapper)],
        "params": {},
    }
    return run_yosys(wrapper.parent, {**job, "family": family, "recipe": recipe, "keep": False})


def all_seeds(
    device: pnr.Device, netlist: Path, folder: Path, seeds: int, done: Callable[[pnr.Run], None]
) -> list[pnr.Run]:
    """Place and route with seeds 1 … `seeds`, two at a time; `done` hears of each."""

    def one(seed: int) -> pnr.Run:
        result = pnr.place_and_route(device, netlist, folder, seed)
        done(result)
        return result

    # The first start of a WebAssembly tool compiles it; two at once would do that twice.
    first = one(1)
    with ThreadPoolExecutor(2) as pool:
        return [first, *pool.map(one, range(2, seeds + 1))]


def device_entry(device: pnr.Device, total: Count, runs: list[pnr.Run]) -> dict:
    """One device's figures for the report."""
    return {
        "device": device.name,
        "family": device.family,
        "goal_mhz": device.goal_mhz,
        "lut": total.lut if device.family == "ice40" else runs[0].used["TRELLIS_COMB"],
        "ff": total.ff,
        "ram": total.ram,
        "fmax": round(pnr.median_run(runs).fmax, 1),
        "path": pnr.median_run(runs).path,
        "seeds": [run.fmax for run in runs],
        "packer": runs[0].used,
        "wrapped": device.wrapped,
    }
