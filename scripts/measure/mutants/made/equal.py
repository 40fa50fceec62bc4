"""Proofs that a mutant behaves like the RTL in every part, so that no test can kill it.

The RTL and the mutant are compared as whole parts: they have the same inputs, begin in the same state, and
are reset for RESET cycles. If all outputs and writes to RAMs are equal in every later cycle, the mutant is
equal to the RTL. This is proved for all parts that contain the file, with the parameters that lint checks,
and for every state at power-up. A mutant that no part contains is not equal.

Nearly all registers have the same value in the RTL and in the mutant. A model therefore has one copy of the
registers, and a second copy only of those in which a search found a difference. ABC proves that no other
register differs. The first proof contains only the registers of the block; all others are free inputs, so the
model does all that the part does, and more. If this proof fails, the next one also contains the blocks around
it. If all fail, the registers that differed in them get a second copy, too. RAMs are outside the model: after
a different address, the mutant reads arbitrary data.

The module is started as ``python -m scripts.measure.mutants.made.equal JOB.json`` in a separate process,
because yosys calls exit() on an error. It writes part.aag to the job's folder.
"""

from __future__ import annotations

import hashlib
import json
import re
import shutil
import sys
import time
from collections.abc import Iterable, Mapping
from pathlib import Path

from cocotb_tests.harness.project import BUILD, ROOT, include_dirs, relative, run, sources
from openppmc import parts
from openppmc.parts import Row
from scripts.measure.campaign.jobs import Result
from scripts.measure.lint import settings
from scripts.measure.mutants.made.faults import faults
from scripts.measure.mutants.made.graph import Graph, read
from scripts.measure.mutants.made.schema import CHOSEN, instrumented
from scripts.measure.mutants.made.work import Bulk
from scripts.measure.prove import engine
from scripts.measure.prove.check import yosys

RESET = 4
LIMIT, LONGEST = 2, 20
"""Time limit in s of one run of ABC, and time after which no further run begins for a mutant."""
FRAMES = 12
"""Number of cycles of a search for a difference."""
MOST = 200
"""Maximum number of registers that may differ."""
OUTPUT = "output"
"""Name of all outputs and writes to RAMs, among the names of registers."""
RESETS = "u_reset."
"""Part of the names of registers that each model contains."""
COMPARED = re.compile(rf"connect \\A \\{CHOSEN}\n *connect \\B (\d+)\n")
"""In the text of a design, a mutant that it contains."""
RAM_PORT = re.compile(r"([^:]+)\.(rdata_o|raddr_i|waddr_i|wdata_i|we_i)(\[\d+\])?")

FLAT = ("hierarchy -top {top}", "flatten", "expose -evert t:ppmc_ram*", "opt_clean", "memory_map -formal")
SHAPE = ("chformal -remove", "opt_clean", "formalff -clk2ff", "setundef -undriven -zero", "opt -full")
GATES = ("techmap", "opt -full", "dffunmap", "aigmap", "opt_clean")


def equal(work: Bulk) -> Result:
    """Return those of the mutants of a file that are proved equal to the RTL in every part."""
    file, left = work.mutants[0][0], {number for _, number in work.mutants}
    proofs: dict[int, tuple[frozenset[str], str]] = {}
    rows = [row for row in parts.tops() if ROOT / file in sources(row)]
    for row, params in [(top, params) for top in rows for _, params in settings(top)]:
        part = Part(row, params, file, left)
        if part.trouble:
            return Result(True, {"found": {}})
        for number in sorted(left & part.contained):
            proof = part.equal(number, *proofs.get(number, (frozenset(), "")))
            if proof:
                proofs[number] = proof
            else:
                left.remove(number)
        shutil.rmtree(part.folder)
    return Result(True, {"found": {f"{file} {number}": "" for number in sorted(left & proofs.keys())}})


class Part:
    """The graph of a part with mutants of a file.

    Attributes:
        registers: literals of output and input, all names, and the name of the vector to which it belongs.
        selections: literals of the bits that select a mutant -> number of the bit.
        trouble: reason why yosys cannot read the part, or "".
        contained: mutants that the part contains with these parameters.
        rams: literals of the ports of each RAM.
        scopes: begin of the names in the block, in the block that contains it, and so on.
    """

    def __init__(self, row: Row, params: Mapping[str, object], file: str, numbers: set[int]) -> None:
        self.folder = (
            BUILD / "equal" / hashlib.sha256(f"{row.name} {params} {file}".encode()).hexdigest()[:12]
        )
        shutil.rmtree(self.folder, ignore_errors=True)
        self.folder.mkdir(parents=True)
        # A reset that depends on the mutant must be synchronous.
        text = re.sub(r" or negedge \w+", "", (ROOT / file).read_text(encoding="utf-8"))
        chosen = [fault for fault in faults(text) if fault.number in numbers]
        copy = self.folder / Path(file).name
        copy.write_text(instrumented(text, chosen, f" wire [31:0] {CHOSEN};"), encoding="utf-8")
        files = [copy if path == ROOT / file else path for path in sources(row)]
        job = {
            "top": row.top,
            "params": params,
            "folder": relative(self.folder),
            "sources": [relative(path) for path in files],
        }
        (self.folder / "job.json").write_text(json.dumps(job), encoding="utf-8")
        self.selections: dict[int, int] = {}
        words = "-m", "scripts.measure.mutants.made.equal", relative(self.folder / "job.json")
        self.trouble = yosys(self.folder, *words)
        if self.trouble:
            return
        self.contained = {int(number) for number in COMPARED.findall((self.folder / "part.il").read_text())}
        self.graph, self.inputs, self.outputs, names = read(self.folder / "part.aag")
        vectors = [every[-1].partition("[")[0] if every else "" for every in names]
        self.registers = list(zip(self.graph.registers, names, vectors, strict=True))
        self.rams: dict[str, dict[str, list[int]]] = {}
        self.scopes = [""]
        for name, literal in (*self.inputs.items(), *self.outputs.items()):
            if port := RAM_PORT.fullmatch(name):
                self.rams.setdefault(port[1], {}).setdefault(port[2], []).append(literal)
            elif bit := re.fullmatch(rf"(.*){CHOSEN}\[(\d+)\]", name):
                self.selections[literal] = int(bit[2])
                self.scopes = [bit[1][: dot.end()] for dot in re.finditer(r"\.", bit[1])][::-1] + [""]

    def equal(self, number: int, differing: frozenset[str], scope: str) -> tuple[frozenset[str], str] | None:
        """Return the registers that differ and the scope of the proof that no others do, or None.

        Args:
            differing: names of the registers that differ with other parameters, with which the search begins.
            scope: scope of a proof with other parameters, "" without one.
        """
        end = time.monotonic() + LONGEST
        while time.monotonic() < end:
            found = self.difference(number, differing)
            if not found:
                for one in self.scopes[self.scopes.index(scope) if scope else 0 :]:
                    proved, maybe = self.proved(number, differing, one)
                    if proved:
                        return differing, one
                    found |= maybe - {OUTPUT}
            differing |= found
            count = sum(vector in differing for _, _, vector in self.registers)
            if not found or OUTPUT in found or count > MOST:
                break
        return None

    def difference(self, number: int, differing: frozenset[str]) -> set[str]:
        """Return the name of the first other register that differs in the first cycles, if any."""
        model, found = self.model(number, differing)
        model.write(self.folder / "search.aig", list(found.values()))
        hits = engine.hits(engine.ask(self.folder, "search", f"bmc3 -F {FRAMES} -T {LIMIT}"))
        return {list(found)[output] for output in hits}

    def proved(self, number: int, differing: frozenset[str], scope: str) -> tuple[bool, set[str]]:
        """Prove that no other register differs; return the success, and a register that may differ."""
        model, found = self.model(number, differing, scope)
        if not found:
            return True, set()
        model.write(self.folder / "prove.aig", list(found.values()))
        said = engine.ask(self.folder, "prove", f"dc2; pdr -T {LIMIT}")
        if "in frame 1." in said:  # dc2 has left nothing to prove
            said = engine.ask(self.folder, "prove", f"pdr -T {LIMIT}")
        return "Property proved." in said, {list(found)[output] for output in engine.hits(said)}

    def model(self, number: int, differing: frozenset[str], scope: str = "") -> tuple[Graph, dict[str, int]]:
        """Return the model and the literals that are true if a register, RAM or output differs, by its name.

        Args:
            differing: names of registers and RAMs that may differ.
            scope: begin of the names of registers in the model; the others are free inputs.
        """
        model, found = Graph(), dict[str, list[int]]()
        rtl = {literal: model.input() for literal in self.graph.inputs if literal not in self.selections}
        after = [model.new() for _ in range(RESET)]
        model.registers += zip(after, [1, *after], strict=False)
        rtl[self.inputs["rst_n"]] = model.both(rtl[self.inputs["rst_n"]], after[-1])
        inside = {
            out: enter
            for (out, enter), names, vector in self.registers
            if not names
            or vector in differing
            or any(name.startswith(scope) or RESETS in name for name in names)
        }
        rtl |= {out: model.new() if out in inside else model.input() for out, _ in self.graph.registers}
        mutant = rtl | {out: model.new() for (out, _), _, vector in self.registers if vector in differing}
        late = {name: (model.new(), model.new()) for name in self.rams if name in differing}
        for name, (_, now) in late.items():
            for literal in self.rams[name]["rdata_o"]:
                mutant[literal] = model.chosen(now, model.input(), rtl[literal])
        of_rtl = model.copy(self.graph, rtl | dict.fromkeys(self.selections, 0))
        of_mutant = model.copy(
            self.graph, mutant | {bit: number >> n & 1 for bit, n in self.selections.items()}
        )

        def differ(literals: Iterable[int]) -> int:
            return model.any(model.differ(of_rtl(one), of_mutant(one)) for one in literals)

        model.registers += [(rtl[out], of_rtl(enter)) for out, enter in inside.items()]
        for (out, enter), _, vector in self.registers:
            if vector in differing:
                model.registers.append((mutant[out], of_mutant(enter)))
            else:
                found.setdefault(vector, []).append(differ([enter]))
        ends = [literal for name, literal in self.outputs.items() if not RAM_PORT.fullmatch(name)]
        outputs = [model.both(after[-1], differ(ends))]
        for name, ports in self.rams.items():
            read, write = differ(ports["raddr_i"]), differ(ports["waddr_i"] + ports["wdata_i"])
            enabled = of_rtl(ports["we_i"][0])
            outputs.append(
                model.both(after[0], model.either(differ(ports["we_i"]), model.both(enabled, write)))
            )
            if name in differing:
                model.registers += [(late[name][0], read), (late[name][1], late[name][0])]
            else:
                found[name] = [read]
        found[OUTPUT] = outputs
        differences = {name: model.any(literals) for name, literals in found.items()}
        return model, {name: literal for name, literal in differences.items() if literal}


def main() -> int:
    """Run the job file named on the command line."""
    import pyosys.libyosys as ys

    job = json.loads(Path(sys.argv[1]).read_text(encoding="utf-8"))
    design = ys.Design()

    def passes(*commands: str) -> None:
        for command in commands:
            ys.run_pass(command, design)

    chosen = " ".join(f"-G {name}={json.dumps(value)}" for name, value in job["params"].items())
    files = " ".join([*(f"-I{path}" for path in include_dirs()), *job["sources"]])
    passes(f"read_slang --threads 1 --keep-hierarchy --top {job['top']} {chosen} {files}")
    names = [str(name.str())[1:] for name in design.modules_]
    passes(*(f"blackbox {name}" for name in names if name.startswith("ppmc_ram$")))
    top = next(name for name in names if name.partition("$")[0] == job["top"])
    passes("proc", f"write_rtlil {job['folder']}/part.il", *(command.format(top=top) for command in FLAT))
    module = design.top_module()
    for name in module.wires_:
        if str(name.str()).endswith(CHOSEN):
            module.wires_[name].port_input = True
    module.fixup_ports()
    passes("async2sync")
    # The registers behind an asynchronous reset get the names of the signals that they drive.
    for name in list(module.cells_):
        cell = module.cells_[name]
        if str(cell.type.str()) == "$mux":
            driven = cell.getPort(ys.IdString("\\Y"))
            bits = [str(driven[n].wire.name.str()) for n in range(driven.size()) if driven[n].wire]
            public = next((bit for bit in bits if bit.startswith("\\")), "")
            for port in ("\\A", "\\B"):
                signal = cell.getPort(ys.IdString(port))
                if public and signal.is_wire() and "async2sync" in str(signal.as_wire().name.str()):
                    module.rename(signal.as_wire(), module.uniquify(ys.IdString(public + "_register")))
    passes(*SHAPE, *GATES, f"write_aiger -ascii -symbols -zinit {job['folder']}/part.aag")
    return 0


if __name__ == "__main__":
    sys.exit(run(main, "JOB.json"))
