"""Convert wrapper and RTL to two and-inverter graphs: of the assertions (as bad states), of the covers.

The module is started as ``python -m scripts.measure.prove.model JOB.json`` in a separate process, because
yosys calls exit() on an error and writes its log to stdout. The job names the sources, the include folders,
the top, the folder of the results, and the labels that count (empty: all). The results are:
    prove.aig, cover.aig  the graphs, each with the names of inputs and registers (.aim)
    *.il                  the design, for a trace
    labels.json           the labels of the outputs of each graph, in order
"""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

ANY = ("proc", "setundef -anyseq t:$buf")
"""An undriven signal (an output of a stub) becomes one free input for all readers of the signal.

If the signal stayed X, each reader would replace it by the simplest value.
"""
LOWER = ("async2sync", "chformal -lower")
SHAPE = ("opt_clean", "memory_map -formal", "formalff -clk2ff -ff2anyinit -hierarchy")
GATES = ("setundef -undriven -anyseq", "opt -full", "techmap", "opt -full", "dffunmap", "aigmap", "opt_clean")


def read(job: dict[str, Any], kind: str) -> str:
    """Return the command that reads the sources. For covers, SYNTHESIS hides the assertions of the RTL."""
    words = ["read_slang", "--threads", "1", "--top", job["top"], *(f"-I{path}" for path in job["includes"])]
    words += ["--no-synthesis-define"] if kind == "prove" else ["-D", "FV_COVERS=1"]
    return " ".join([*words, *job["sources"]])


def labels(design: Any) -> list[str]:
    """Return the labels of the assertions in the order of the outputs of write_aiger."""
    cells = design.top_module().cells_
    return [str(name.str()).lstrip("\\") for name in cells if cells[name].type.str() == "$assert"]


def narrow(design: Any, only: list[str]) -> list[str]:
    """Return commands that delete each assertion whose label begins with none of the words in `only`."""
    return [f"delete c:{label}" for label in labels(design) if only and not label.startswith(tuple(only))]


def main() -> int:
    """Run the job file named on the command line."""
    import pyosys.libyosys as ys

    def run(design: Any, command: str) -> None:
        print(f"\n>>> {command}", flush=True)
        ys.run_pass(command, design)

    job = json.loads(Path(sys.argv[1]).read_text(encoding="utf-8"))
    found = {}
    for kind in ("prove", "cover"):
        base = f"{job['folder']}/{kind}"
        design = ys.Design()
        begin = [read(job, kind), *ANY, f"prep -flatten -top {job['top']}", *LOWER]
        rest = [*SHAPE, f"write_rtlil {base}.il", *GATES]
        for command in begin:
            run(design, command)
        for command in [*narrow(design, job["only"]), *rest]:
            run(design, command)
        found[kind] = labels(design)
        run(design, f"write_aiger -I -B -zinit -no-startoffset -map {base}.aim {base}.aig")
    Path(job["folder"], "labels.json").write_text(json.dumps(found), encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
