"""What an axis of a bank costs, by the number of axes: `python -m scripts.bank.sizes`.

Writes docs/bank/sizes.json, from which `make docs` fills the tables of the manual, and the block "bank" of
docs/benchmarks.md. A run that was broken off goes on, what has not changed is not measured again; `--sizes`
leaves out place and route, which takes hours.
"""

from __future__ import annotations

import argparse
import json
import sys
from typing import Any

from cocotb_tests.harness import project
from cocotb_tests.harness.project import ProjectError, console
from openppmc import parts
from scripts.bank import cost
from scripts.flow import pnr
from scripts.flow.netlist import flat_counts
from scripts.flow.synthesis import SEEDS, run_yosys, wrapped_netlist
from scripts.flow.yardstick import Design, measure
from scripts.flow.yosys_job import BEST

FOLDER = project.BUILD / "bank-sizes"
UP5K = pnr.DEVICES[2]
MANY_SEEDS = 32
"""The number of axes that is placed with all seeds; the others with one."""
ICE40 = {"AXES": 8, "CLK_HZ": 24_000_000}


def design(axes: int) -> Design:
    """The bank of so many axes, without a bridge."""
    return Design.of_part(parts.part("bank"), {"AXES": axes, "CLK_HZ": cost.CLK_HZ})


def ice40(small: Design, route: bool) -> dict[str, Any]:
    """LUT, FF, RAM and, with `route`, Fmax of a small bank on an UP5K, or why the tool finds no place."""
    folder, recipe = FOLDER / "ice40", BEST["ice40"]
    work = {**small.job, "family": "ice40", "recipe": recipe, "keep": False}
    netlist = run_yosys(folder, work)
    total = flat_counts(netlist, work["top"], set())[0]
    found: dict[str, Any] = {**ICE40, "lut": total.lut, "ff": total.ff, "ram": total.ram}
    if not route:
        return found
    wrapped = wrapped_netlist(folder, work, netlist, recipe, "ice40")
    try:
        return found | {"mhz": pnr.place_and_route(UP5K, wrapped, folder / "pnr", 1).fmax}
    except ProjectError as error:
        return found | {"says": str(error).splitlines()[-1]}


def main() -> int:
    """Measure, write."""
    parser = argparse.ArgumentParser(prog="python -m scripts.bank.sizes", description=__doc__)
    parser.add_argument("--sizes", action="store_true", help="no place and route")
    route = not parser.parse_args().sizes
    designs = {str(axes): design(axes) for axes in cost.AXES}
    seeds = {name: route * (SEEDS if int(name) == MANY_SEEDS else 1) for name in designs}
    figures = measure(designs, seeds, cost.FILE, FOLDER)
    small, known = Design.of_part(parts.part("bank"), ICE40), figures.get("ice40", {})
    if known.get("of") != small.digest("tuned") or (route and not {"mhz", "says"} & set(known)):
        figures["ice40"] = {**ice40(small, route), "of": small.digest("tuned")}
        console.print(f"ice40: {figures['ice40']}", markup=False)
        cost.FILE.write_text(json.dumps(figures, indent=1, sort_keys=True) + "\n", encoding="utf-8")
    project.update_benchmarks("bank", cost.markdown())
    console.print(f"written: {project.relative(cost.FILE)}, docs/benchmarks.md; `make docs` does the manual")
    return 0


if __name__ == "__main__":
    sys.exit(project.run(main))
