"""Check of asynchronous inputs: which registers sample a pin or a register of another clock (docs/cdc.md).

``python -m scripts.measure.cdc`` elaborates the tops of parts and boards. For each flip-flop and memory, it
collects the pins and the registers of other clocks that drive an input, directly or through logic. The first
stage of a `ppmc_sync` may sample one pin; every other case needs a line with its reason in lint/cdc.txt.
`--write` writes the tables of docs/cdc.md; without it (`make lint`), outdated tables are a finding, too.
"""

from __future__ import annotations

import argparse
import json
import re
import subprocess
import sys
from collections import defaultdict
from collections.abc import Iterable, Iterator, Sequence
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

from cocotb_tests.harness import project
from cocotb_tests.harness.project import ProjectError, console, relative
from openppmc.parts import tops
from scripts.fpga.flow import boards

REASONS = project.ROOT / "lint" / "cdc.txt"
PAGE = project.DOCS / "cdc.md"
PASSES = "chformal -remove; proc; opt_expr; opt_clean; memory_dff; memory_collect; simplemap; opt_clean"
SYNC, STAGE = "ppmc_sync", "q1_o"
RESETS = {"R", "S", "L", "AD", "ARST", "CLR", "SET", "ALOAD"}
CONSTANTS = {"0", "1", "x", "z"}


class Origin(NamedTuple):
    """Source of an asynchronous level; `kind` is pin, clock (a register of another clock) or stage."""

    kind: str
    name: str


class Sample(NamedTuple):
    """A register bit or a memory that samples asynchronous levels.

    Attributes:
        name: name of the register in `module`; `path` is its name in the top.
        reset: True if the levels reach only the asynchronous reset of the register.
        direct: True if the register samples one level without logic.
    """

    path: str
    module: str
    name: str
    reset: bool
    direct: bool
    origins: frozenset[Origin]

    @property
    def is_stage(self) -> bool:
        """True if the register is the first stage of a synchroniser."""
        return self.module == SYNC and self.name == STAGE and not self.reset

    @property
    def block(self) -> str:
        """Instance that contains the register, and the parent of this instance, without indices."""
        return re.sub(r"\[\d+\]", "", ".".join(self.path.split(".")[-3:-1]))

    @property
    def case(self) -> str:
        """Case in lint/cdc.txt that needs a reason; "" for the stages of a synchroniser of one pin."""
        stages = {origin.name for origin in self.origins if origin.kind == "stage"}
        if self.is_stage:
            return "" if self.direct and not stages else f"logic before {self.block}"
        if self.module == SYNC and stages == {self.path.replace(".q2_o", f".{STAGE}")}:
            return ""
        return ("reset of " if self.reset else "") + f"{self.module}.{self.name}"


class Netlist:
    """Elaborated top without hierarchy, from the JSON text of yosys."""

    def __init__(self, data: dict[str, Any], top: str) -> None:
        module = data["modules"][top]
        self.cells: dict[str, Any] = module["cells"]
        self.vendor = {name for name, body in data["modules"].items() if body["attributes"].get("blackbox")}
        self.driver: dict[Any, tuple[str, str]] = {}
        self.readers: dict[Any, list[tuple[str, str]]] = defaultdict(list)
        for name, cell in self.cells.items():
            for port, bits in cell["connections"].items():
                if cell["port_directions"].get(port) == "output":
                    self.driver |= dict.fromkeys(bits, (name, port))
                else:
                    for bit in bits:
                        self.readers[bit].append((name, port))
        self.names: dict[Any, list[tuple[str, str]]] = defaultdict(list)
        for name, net in module["netnames"].items():
            stem = Path(net["attributes"].get("src", "").split(":")[0]).stem
            for bit, text in self._bits(name, net):
                self.names[bit].append((stem, text))
        ports = [(name, port) for name, port in module["ports"].items() if port["direction"] != "output"]
        self.pins = {bit: text for name, port in ports for bit, text in self._bits(name, port)}

    @staticmethod
    def _bits(name: str, net: dict[str, Any]) -> Iterator[tuple[Any, str]]:
        bits, low = net["bits"], net.get("offset", 0)
        yield from ((bit, f"{name}[{n}]" if len(bits) > 1 else name) for n, bit in enumerate(bits, low))

    def path(self, bit: Any, module: str) -> str:
        """Return the shortest name of a net. Names that `module` drives are preferred."""
        own = [name for stem, name in self.names[bit] if stem == module]
        found = [name for name in own if not re.search(r"_n?i(\[\d+\])?$", name)]
        found = [name for name in found or [name for _, name in self.names[bit]] if "$" not in name]
        return min(found or ["?"], key=lambda name: (name.count("."), len(name), name))

    @staticmethod
    def is_memory(cell: dict[str, Any]) -> bool:
        """Return whether a cell is a memory."""
        return bool(cell["type"].startswith("$mem"))

    def clock(self, name: str) -> Any:
        """Return the net at the clock input of a register or memory; None for cells without a clock."""
        cell = self.cells[name]
        if "DFF" not in cell["type"].upper() and not self.is_memory(cell):
            return None
        nets = (cell["connections"].get(port) or ["x"] for port in ("C", "CLK", "WR_CLK", "RD_CLK"))
        return next((bits[0] for bits in nets if bits[0] not in CONSTANTS), None)

    def module_of(self, name: str) -> str:
        """Return the module whose source has made a cell."""
        return Path(self.cells[name]["attributes"].get("src", "?").split(":")[0]).stem

    def origins(self) -> Iterator[tuple[Any, Any, Origin]]:
        """Yield each net that carries an asynchronous level, with the clock of its driving register."""
        clocks = {self.clock(name) for name in self.cells} - {None}
        yield from ((bit, None, Origin("pin", name)) for bit, name in self.pins.items() if bit not in clocks)
        for bit, (name, port) in self.driver.items():
            if (kind := self.cells[name]["type"]) in self.vendor:
                yield bit, None, Origin("pin", f"{kind}.{port}")
            elif clock := self.clock(name):
                path = self.path(bit, self.module_of(name))
                if self.module_of(name) == SYNC and f".{STAGE}" in path:
                    yield bit, None, Origin("stage", path)
                elif len(clocks) > 1:
                    yield bit, clock, Origin("clock", path)

    def reached(self, origin: Any) -> Iterator[tuple[str, str, bool]]:
        """Yield each register input that a net reaches: (cell, port, True if no logic is in between)."""
        seen, todo = {origin}, [origin]
        while todo:
            bit = todo.pop()
            for name, port in self.readers[bit]:
                cell = self.cells[name]
                if clock := self.clock(name):
                    if bit != clock:
                        yield name, port, bit == origin
                    if port != "RD_ADDR" or "0" not in cell["parameters"]["RD_CLK_ENABLE"]:
                        continue
                for output, bits in cell["connections"].items():
                    if cell["port_directions"].get(output) == "output" and cell["type"] not in self.vendor:
                        todo += [bit for bit in bits if bit not in seen]
                        seen.update(bits)

    def samples(self) -> list[Sample]:
        """Return every register bit and memory that samples asynchronous levels."""
        found = defaultdict[tuple[str, bool], set[Origin]](set)
        logic = set[tuple[str, bool]]()
        for origin_bit, own, origin in self.origins():
            for name, port, direct in self.reached(origin_bit):
                if own is None or own != self.clock(name):
                    key = name, port in RESETS
                    found[key].add(origin)
                    logic |= set() if direct else {key}
        rows = []
        for (name, reset), origins in found.items():
            cell, module = self.cells[name], self.module_of(name)
            memory = self.is_memory(cell) and cell["parameters"]["MEMID"].strip("\\")
            path = memory or self.path(cell["connections"]["Q"][0], module)
            local = re.sub(r"\[\d+\]$", "", path).rpartition(".")[2]
            direct = (name, reset) not in logic and len(origins) == 1
            rows.append(Sample(path, module, local, reset, direct, frozenset(origins)))
        return sorted(rows, key=lambda row: row[:4])


def elaborate(top: str, sources: Sequence[Path], params: dict[str, Any], folder: Path) -> Netlist:
    """Return the netlist of a top; raise ProjectError with the messages of yosys."""
    folder.mkdir(parents=True, exist_ok=True)
    out = folder / f"{top}.json"
    job = {
        "includes": [relative(path) for path in project.include_dirs()],
        "sources": [relative(path) for path in sources],
        "top": top,
        "params": params,
        "passes": [*PASSES.split("; "), f"write_json {relative(out)}"],
    }
    command = [sys.executable, "-m", "scripts.fpga.flow.elaborate", json.dumps(job)]
    done = subprocess.run(command, cwd=project.ROOT, text=True, capture_output=True, check=False)
    if done.returncode:
        raise ProjectError("\n".join([f"{top}: yosys failed", *done.stdout.splitlines()[-4:], done.stderr]))
    return Netlist(json.loads(out.read_text(encoding="utf-8")), top)


def designs() -> Iterator[tuple[str, list[Path], dict[str, Any]]]:
    """Yield top, sources and parameters of each part, and of each board with each of its hosts."""
    for part in tops():
        yield part.top, project.sources(part), {}
    for path in project.listed()["boards"].files:
        if path.stem.startswith("board_"):
            known = boards.parameters(path.stem)
            for host in boards.HOSTS_OF.get(path.stem, ("uart", "bus")) if "HOST" in known else ("",):
                yield path.stem, boards.sources(path.stem), {"HOST": host.upper()} if host else {}


def cases(samples: Iterable[Sample]) -> dict[str, list[Sample]]:
    """Return the samples of a design that need a reason, by case."""
    found, stages = defaultdict[str, list[Sample]](list), defaultdict[str, list[Sample]](list)
    for sample in samples:
        if sample.case:
            found[sample.case].append(sample)
        for origin in sample.origins if sample.is_stage else ():
            stages[origin.name].append(sample)
    for sampling in stages.values():
        if len(sampling) > 1:
            names = sorted({sample.block for sample in sampling})
            found[f"several synchronisers of a pin: {', '.join(names)}"] += sampling
    return found


@cache
def reasons() -> dict[str, str]:
    """Return the reasons in lint/cdc.txt, by case."""
    rows = [line for line in REASONS.read_text(encoding="utf-8").splitlines() if line and line[0] != "#"]
    return {case.strip(): reason.strip() for case, _, reason in (row.partition("|") for row in rows)}


def measure() -> tuple[list[str], str]:
    """Return the findings, one text each, and the tables of the page."""
    problems, rows, used = list[str](), list[str](), defaultdict[str, dict[str, int]](dict)
    for top, sources, params in designs():
        samples = elaborate(top, sources, params, project.BUILD / "cdc").samples()
        for case, found in cases(samples).items():
            used[case][top] = max(len(found), used[case].get(top, 0))
            if not reasons().get(case):
                pins = ", ".join(sorted(origin.name for origin in found[0].origins)[:4])
                problems.append(
                    f"{top}: {found[0].path} samples {pins}: add a reason for `{case}` to lint/cdc.txt"
                )
        stages = sum(sample.is_stage and not sample.case for sample in samples)
        others = sum(bool(sample.case) for sample in samples)
        rows.append(f"| {' '.join([f'`{top}`', *params.values()])} | {stages} | {others} |")
    problems += [
        f"lint/cdc.txt: no design has the case `{case}`; remove it" for case in reasons() if case not in used
    ]
    rows = [
        "| design | first stages that sample one pin | registers with a reason |",
        "|---|---|---|",
        *rows,
        "",
    ]
    rows += ["| case | registers | designs | reason |", "|---|---|---|---|"]
    for case, counts in sorted(used.items()):
        on_boards = sum(top.startswith("board_") for top in counts)
        names = [f"`{top}`" for top in counts if not top.startswith("board_")]
        names += [f"{on_boards} boards"] if on_boards else []
        rows.append(f"| {case} | {max(counts.values())} | {', '.join(names)} | {reasons().get(case, '')} |")
    return problems, "\n".join(rows)


def findings(write: bool = False) -> str:
    """Return all findings as a text; with `write`, write the tables of docs/cdc.md."""
    problems, tables = measure()
    text = PAGE.read_text(encoding="utf-8")
    fresh = project.replace_between(text, "cdc", tables)
    if write:
        PAGE.write_text(fresh, encoding="utf-8")
    elif fresh != text:
        problems.append("docs/cdc.md is outdated; run `python -m scripts.measure.cdc --write`")
    return "\n".join(problems)


def main() -> int:
    """Run the command line; return 1 if there are findings."""
    parser = argparse.ArgumentParser(prog="python -m scripts.measure.cdc")
    parser.add_argument("--write", action="store_true", help="write the tables of docs/cdc.md")
    text = findings(parser.parse_args().write)
    console.print(
        text or "cdc: every register that samples a pin has a synchroniser or a reason", markup=False
    )
    return 1 if text else 0


if __name__ == "__main__":
    sys.exit(project.run(main))
