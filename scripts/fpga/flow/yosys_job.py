"""One yosys run in a separate process.

It converts SystemVerilog to a mapped netlist in JSON, and optionally to Verilog. Started as ``python -m
scripts.fpga.flow.yosys_job JOB.json``; the job names sources, top, parameters, family, recipe and output.
Because of the separate process, each run has its own log file, and runs for two families can be parallel.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path

from cocotb_tests.harness.project import run

FLOW2 = "scratchpad -copy abc9.script.flow2 abc9.script"

# Each recipe adds a command before the synthesis pass of the family, and options to that pass. flow2 is an
# abc9 script that repeats mapping and restructuring. -cmp2softlogic compares with constants without carry
# chains; on ECP5, each end of a chain costs a cell. few-ce limits the number of different clock enables: all
# flip-flops of an iCE40 tile share one, so the cells of an almost full device could not be placed otherwise.
RECIPES: dict[str, dict[str, tuple[str, str]]] = {
    "ecp5": {"default": ("", ""), "flow2-soft": (FLOW2, "-nowidelut -cmp2softlogic")},
    "ice40": {"default": ("", ""), "flow2": (FLOW2, ""), "few-ce": (FLOW2, "-dffe_min_ce_use 5")},
    "gowin": {"default": ("", ""), "flow2": (FLOW2, "")},
    "plain": {"default": ("", "")},  # not an FPGA family: readable Verilog (`plain`)
}
# These commands convert processes to readable expressions and registers, without technology mapping.
PLAIN = "chformal -remove; proc; opt_expr; opt_muxtree; opt_reduce; opt_clean; opt_dff; bwmuxmap"
PLAIN += "; opt_clean; memory_collect"
# This command names registers after the signals that they drive. It runs before abc9, which removes signals.
RENAME = "rename -wire"
# These commands rename cells, which only changes the order in which abc9 and nextpnr process the cells. The
# results show the random part of a clock rate. The first entry is the unchanged recipe.
PERTURB = ((), ("rename -scramble-name -seed 1",), ("rename -enumerate",))
# Of the recipes that were tried and do not reduce the clock rate, the one with the smallest netlist (D-11).
BEST = {"ecp5": "flow2-soft", "ice40": "flow2", "gowin": "flow2", "plain": "default"}


def recipe_text(family: str, recipe: str) -> str:
    """Return the yosys commands of a recipe as one line."""
    pre, options = RECIPES[family][recipe]
    synth = f"synth_{family} {options}".strip()
    passes = [pre, f"{synth} -run begin:map_luts", RENAME, f"{synth} -run map_luts:"]
    return "; ".join(filter(None, passes))


def commands(job: dict) -> list[str]:
    """Return the yosys commands of a job, in order."""
    read = ["read_slang", "--top", job["top"], *(f"-I{path}" for path in job["include"])]
    read += [f"-D{define}" for define in job.get("defines", ())]
    for name, value in job["params"].items():
        read += ["-G", f'{name}="{value}"' if isinstance(value, str) else f"{name}={value}"]
    pre, args = RECIPES[job["family"]][job["recipe"]]
    synth = f"synth_{job['family']} -top {job['top']} {args}".strip()
    if job["keep"]:
        read += ["--keep-hierarchy", *job["sources"]]
        passes = PLAIN.split("; ") if job["family"] == "plain" else [f"{synth} -noflatten"]
    else:
        read += job["sources"]
        passes = [
            f"{synth} -run begin:map_luts",
            RENAME,
            *PERTURB[job.get("turn", 0)],
            f"{synth} -run map_luts:",
        ]
    if "verilog" in job:
        passes += [f"write_verilog -noattr {job['verilog']}"]
    return [*filter(None, [" ".join(read), pre]), *passes, f"write_json {job['json']}"]


def main() -> int:
    """Run the job file named on the command line."""
    job = json.loads(Path(sys.argv[1]).read_text())
    import pyosys.libyosys as ys

    design = ys.Design()
    for command in commands(job):
        print(f"\n>>> {command}", flush=True)
        ys.run_pass(command, design)
    return 0


if __name__ == "__main__":
    sys.exit(run(main, "JOB"))
