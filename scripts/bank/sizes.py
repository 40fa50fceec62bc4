"""What an axis of a bank costs, by the number of axes: `python -m scripts.bank.sizes`.

Writes docs/bank/sizes.json, from which `make docs` fills the tables of the manual, and the block "bank" of
docs/benchmarks.md. Every figure is kept as soon as it is there, so that a run that was broken off goes on;
`--anew` measures all of them again.
"""

from __future__ import annotations

import argparse
import json
import shutil
import sys
from pathlib import Path
from typing import Any

from cocotb_tests.harness import project
from cocotb_tests.harness.project import ProjectError, console
from openppmc import parts
from scripts.bank import cost
from scripts.flow import pnr
from scripts.flow.netlist import flat_counts
from scripts.flow.synthesis import SEEDS, run_yosys, wrapped_netlist

FOLDER = project.BUILD / "bank-sizes"
ECP5, _, UP5K = pnr.DEVICES
MANY_SEEDS = 32
"""The number of axes that is placed with all seeds; the others with one."""
ICE40 = {"AXES": 8, "CLK_HZ": 24_000_000}


def job(family: str, recipe: str, params: dict[str, int]) -> dict[str, Any]:
    """A yosys job of the bank with these parameters."""
    row = parts.part("bank")
    return {
        "top": row.top,
        "include": [project.relative(path) for path in project.include_dirs()],
        "sources": [project.relative(path) for path in project.sources(row)],
        "params": params,
        "family": family,
        "recipe": recipe,
        "keep": False,
    }


def size(axes: int, recipe: str) -> dict[str, Any]:
    """COMB as nextpnr packs it, FF and block RAM on ECP5."""
    folder = FOLDER / f"{axes}-{recipe}"
    work = job("ecp5", recipe, {"AXES": axes, "CLK_HZ": cost.CLK_HZ})
    netlist = run_yosys(folder, work)
    total = flat_counts(netlist, work["top"], set())[0]
    comb = pnr.packed(ECP5, netlist, folder)["TRELLIS_COMB"]
    return {"comb": comb, "ff": total.ff, "ram": total.ram, "mhz": []}


def rate(axes: int, recipe: str, seed: int) -> float:
    """Fmax in MHz with one seed, the pins behind shift registers."""
    folder = FOLDER / f"{axes}-{recipe}"
    work = job("ecp5", recipe, {"AXES": axes, "CLK_HZ": cost.CLK_HZ})
    wrapped = folder / "wrapped" / f"ecp5-{recipe}.json"
    if not wrapped.is_file():
        wrapped = wrapped_netlist(folder, work, folder / f"ecp5-{recipe}.json", recipe, "ecp5")
    return pnr.place_and_route(ECP5, wrapped, folder / "pnr", seed).fmax


def ice40() -> dict[str, Any]:
    """LUT, FF, RAM and Fmax of a small bank on an UP5K, or what the tool says why it does not go in."""
    folder, recipe = FOLDER / "ice40", cost.RECIPES["tuned"]["ice40"]
    work = job("ice40", recipe, ICE40)
    netlist = run_yosys(folder, work)
    total = flat_counts(netlist, work["top"], set())[0]
    found: dict[str, Any] = {**ICE40, "lut": total.lut, "ff": total.ff, "ram": total.ram}
    wrapped = wrapped_netlist(folder, work, netlist, recipe, "ice40")
    try:
        return found | {"mhz": pnr.place_and_route(UP5K, wrapped, folder / "pnr", 1).fmax}
    except ProjectError as error:
        return found | {"says": str(error).splitlines()[-1]}


def measure(figures: dict[str, Any], keep: Path) -> None:
    """All that is missing, sizes first; kept after each."""

    def done(text: str) -> None:
        keep.parent.mkdir(parents=True, exist_ok=True)
        keep.write_text(json.dumps(figures, indent=1) + "\n")
        console.print(text)

    todo = [(axes, name) for axes in cost.AXES for name in cost.RECIPES]
    for axes, name in sorted(todo, key=lambda one: one[0] != MANY_SEEDS):
        key = f"{axes} {name}"
        if key not in figures:
            figures[key] = size(axes, cost.RECIPES[name]["ecp5"])
            done(f"{key}: {figures[key]}")
    if "ice40" not in figures:
        figures["ice40"] = ice40()
        done(f"ice40: {figures['ice40']}")
    for name in cost.RECIPES:
        for seed in range(1, SEEDS + 1):
            for axes in cost.AXES if seed == 1 else (MANY_SEEDS,):
                rates = figures[f"{axes} {name}"]["mhz"]
                if len(rates) < seed:
                    rates.append(rate(axes, cost.RECIPES[name]["ecp5"], seed))
                    done(f"{axes} {name}, seed {seed}: {rates[-1]} MHz")


def main() -> int:
    """Measure, write."""
    parser = argparse.ArgumentParser(prog="python -m scripts.bank.sizes", description=__doc__)
    parser.add_argument("--anew", action="store_true", help="forget what an earlier run has measured")
    keep = FOLDER / "figures.json"
    if parser.parse_args().anew:
        shutil.rmtree(FOLDER, ignore_errors=True)
    figures = json.loads(keep.read_text()) if keep.is_file() else {}
    measure(figures, keep)
    cost.FILE.write_text(json.dumps(figures, indent=1) + "\n", encoding="utf-8")
    project.update_benchmarks("bank", cost.markdown())
    console.print(f"written: {project.relative(cost.FILE)}, docs/benchmarks.md; `make docs` does the manual")
    return 0


if __name__ == "__main__":
    sys.exit(project.run(main))
