"""Proofs that a mutant behaves like the RTL, so that no test can kill it.

The block of the RTL and that of the mutant have the same inputs. They begin in the same state and are reset
for RESET cycles. If all their outputs are equal in every later cycle, the mutant is equal to the RTL. The
proof is made for all instances of the block in all parts, with the parameters that lint also checks, and for
three states at power-up: all zeros, all ones, and random values. Inner RAMs belong to the environment: their
outputs are free, their inputs must be equal. A mutant that no instance contains is not equal.

The module is started as ``python -m scripts.measure.mutants.made.equal JOB.json`` in a separate process,
because yosys calls exit() on an error. It writes the result to the job's folder.
"""

from __future__ import annotations

import hashlib
import json
import re
import shutil
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from cocotb_tests.harness.project import BUILD, ROOT, include_dirs, relative, run, sources
from openppmc import parts
from scripts.measure.campaign.jobs import Result
from scripts.measure.lint import settings
from scripts.measure.mutants.made.faults import faults
from scripts.measure.mutants.made.schema import CHOSEN, instrumented
from scripts.measure.mutants.made.work import Bulk
from scripts.measure.prove import engine
from scripts.measure.prove.check import yosys

RESET = 4
LIMIT = 5
"""Time limit of one of the methods of a proof in s."""
COMPARED = re.compile(rf"connect \\A \\{CHOSEN}\n *connect \\B (\d+)\n")
"""In the text of a design, a mutant that it contains."""
FRAMES = 20
"""Number of cycles of the search for a difference, which precedes a proof because it is faster."""
STATES = ("-zero", "-one", "-random 7")
RAM = "ppmc_ram$"
CLOCK, RESET_N = ("clk_i", "clk"), ("rst_ni", "rst_n")

READ = ("proc", "hierarchy -top {top}", "flatten", "rename -top base", "expose -evert t:ppmc_ram*")
SHAPE = ("opt_clean", "memory_map -formal", "async2sync", "opt_clean", "design -save base")
MITER = ("prep -flatten -top pair", "async2sync", "chformal -lower", "opt_clean", "formalff -clk2ff")
GATES = ("setundef -undriven -zero", "opt -full", "techmap", "opt -full", "dffunmap", "aigmap", "opt_clean")


def equal(work: Bulk) -> Result:
    """Return those of the mutants of a file that are proved equal to the RTL in every part."""
    file, left = work.mutants[0][0], {number for _, number in work.mutants}
    contained: set[int] = set()
    for row in parts.tops():
        if ROOT / file not in sources(row):
            continue
        folder = BUILD / "equal" / hashlib.sha256(f"{row.name} {file}".encode()).hexdigest()[:12]
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        # A reset that depends on the mutant must be synchronous.
        text = (ROOT / file).read_text(encoding="utf-8").replace(" or negedge rst_ni", "")
        chosen = [fault for fault in faults(text) if fault.number in left]
        copy = instrumented(text, chosen, f" wire [31:0] {CHOSEN};")
        (folder / Path(file).name).write_text(copy, encoding="utf-8")
        files = [folder / path.name if path == ROOT / file else path for path in sources(row)]
        job = {
            "top": row.top,
            "block": Path(file).stem,
            "folder": relative(folder),
            "sources": [relative(path) for path in files],
            "settings": [params for _, params in settings(row)],
        }
        (folder / "job.json").write_text(json.dumps(job), encoding="utf-8")
        if yosys(folder, "-m", "scripts.measure.mutants.made.equal", relative(folder / "job.json")):
            return Result(True, {"found": {}})
        result = json.loads((folder / "equal.json").read_text(encoding="utf-8"))
        left -= set(result["unequal"])
        contained |= set(result["contained"])
    return Result(True, {"found": {f"{file} {number}": "" for number in sorted(left & contained)}})


def pair(ports: Sequence[tuple[str, int, bool]]) -> Iterator[str]:
    """Yield the lines of the module that compares both blocks.

    Args:
        ports: name and width of each port of the block, and whether it is an input.
    """
    inputs = [(name, width) for name, width, is_input in ports if is_input]
    outputs = [(name, width) for name, width, is_input in ports if not is_input]
    clocks = [name for name, _ in inputs if name in CLOCK]
    yield "module pair(" + ", ".join(rf"input [{width - 1}:0] \{name} " for name, width in inputs) + ");"
    yield f"reg [7:0] left = {RESET};"
    yield from (f"always @(posedge {name}) if (left != 0) left <= left - 1;" for name in clocks)
    yield from (rf"wire [{width - 1}:0] \rtl.{name} , \mutant.{name} ;" for name, width in outputs)
    for block in ("rtl", "mutant"):
        places = [rf".\{name} (\{name} {'&& left == 0' * (name in RESET_N)})" for name, _ in inputs]
        places += [rf".\{name} (\{block}.{name} )" for name, _ in outputs]
        yield f"{block} {block}({', '.join(places)});"
    ready = "left == 0" if clocks else "1"
    yield from (rf"always @* if ({ready}) assert (\rtl.{name} == \mutant.{name} );" for name, _ in outputs)
    yield "endmodule"


def main() -> int:
    """Run the job file named on the command line."""
    import pyosys.libyosys as ys

    job = json.loads(Path(sys.argv[1]).read_text(encoding="utf-8"))
    folder, design = Path(job["folder"]), ys.Design()

    def passes(*commands: str) -> None:
        for command in commands:
            ys.run_pass(command, design)

    def same(number: int, state: str) -> bool:
        passes("design -load base", f"setundef -init {state}")
        for block, value in (("rtl", 0), ("mutant", number)):
            passes("design -push-copy", *(f"connect -set {name} 32'd{value}" for name in selections))
            passes("opt -full", f"rename base {block}", f"design -stash {block}", "design -pop")
        copies = [f"design -copy-from {block} -as {block} {block}" for block in ("rtl", "mutant")]
        passes("design -reset", *copies, f"read_verilog -formal {folder}/pair.sv", *MITER, *GATES)
        passes(f"write_aiger -I -B -zinit -no-startoffset {folder}/prove.aig")
        if engine.hits(engine.ask(folder, "prove", f"bmc3 -F {FRAMES} -T {LIMIT}")):
            return False
        return "Networks are equivalent." in engine.ask(folder, "prove", f"orpos; dprove -j -T {LIMIT}")

    unequal: set[int] = set()
    contained: set[int] = set()
    known: set[str] = set()
    includes = " ".join(f"-I{path}" for path in include_dirs())
    files = " ".join(job["sources"])
    for params in job["settings"]:
        chosen = " ".join(f"-G {name}={json.dumps(value)}" for name, value in params.items())
        read = f"read_slang --threads 1 --keep-hierarchy --top {job['top']} {chosen} {includes} {files}"
        passes("design -reset", read)
        names = [str(name.str())[1:] for name in design.modules_]
        passes(*(f"blackbox {name}" for name in names if name.startswith(RAM)), "design -save part")
        for instance in [name for name in names if name.partition("$")[0] == job["block"]]:
            begin = ["design -load part", *(command.format(top=instance) for command in READ)]
            passes(*begin, f"write_rtlil {folder}/base.il", *SHAPE)
            text = (folder / "base.il").read_text(encoding="utf-8")
            text = re.sub(r"\$\d+|(attribute|autoidx) .*", "", text)
            if text in known:
                continue
            known.add(text)
            module = design.top_module()
            wires: dict[str, Any] = {str(key.str())[1:]: module.wires_[key] for key in module.wires_}
            selections = [name for name in wires if name.endswith(CHOSEN)]
            ports = [(name, wire.width, wire.port_input) for name, wire in wires.items() if wire.port_id]
            (folder / "pair.sv").write_text("\n".join(pair(ports)) + "\n", encoding="ascii")
            mine = {int(number) for number in COMPARED.findall(text)}
            contained |= mine
            unequal |= {n for n in mine - unequal if not all(same(n, state) for state in STATES)}
    result = {"unequal": sorted(unequal), "contained": sorted(contained)}
    (folder / "equal.json").write_text(json.dumps(result), encoding="ascii")
    return 0


if __name__ == "__main__":
    sys.exit(run(main, "JOB.json"))
