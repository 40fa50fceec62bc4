"""Cell counts of a mapped netlist: LUTs, flip-flops and block RAMs, for each instance of the RTL."""

from __future__ import annotations

import json
import re
from collections import Counter, defaultdict
from dataclasses import asdict, dataclass, field
from pathlib import Path

# LUTs of iCE40, ECP5 and Gowin; on Gowin, an adder bit (ALU) occupies a LUT.
LUT_CELLS = {
    **{"SB_LUT4": 1, "LUT4": 1, "CCU2C": 2, "TRELLIS_DPR16X4": 6},
    **{"LUT1": 1, "LUT2": 1, "LUT3": 1, "ALU": 1, "RAM16SDP4": 4},
}
RAM_CELLS = {"SB_RAM40_4K", "DP16KD", "PDPW16KD", "SP", "SDPB", "DPB", "SPX9", "SDPX9B", "DPX9B"}
FF_CELLS = ("SB_DFF", "TRELLIS_FF", "DFF")  # prefixes of the names of flip-flops
OUTPUT_PORTS = {"O", "CO", "Z", "S0", "S1", "COUT", "Q"}


@dataclass
class Count:
    """Cells of a netlist or of one instance; `lut` counts a CCU2C as two, as the ECP5 packer does."""

    lut: int = 0
    ff: int = 0
    ram: int = 0
    carry: int = 0

    def add(self, kind: str) -> None:
        """Count one more cell of type `kind`."""
        self.lut += LUT_CELLS.get(kind, 0)
        self.ff += kind.startswith(FF_CELLS)
        self.ram += kind in RAM_CELLS
        self.carry += kind in ("SB_CARRY", "CCU2C")


@dataclass
class Breakdown:
    """Figures of one family: total, and figures for each instance path ('' is the top)."""

    total: Count = field(default_factory=Count)
    # From the flattened netlist; a LUT counts for the instance that it feeds.
    flat: dict[str, Count] = field(default_factory=dict)
    kept: dict[str, Count] = field(default_factory=dict)  # each module is mapped separately
    module: dict[str, str] = field(default_factory=dict)  # instance path -> module name

    def as_dict(self) -> dict:
        """Return plain data for the JSON report."""
        return asdict(self)


def kept_counts(path: Path, top: str) -> tuple[dict[str, Count], dict[str, str]]:
    """Return the counts and the module name for each instance path of a netlist with hierarchy."""
    modules = json.loads(path.read_text())["modules"]
    counts: dict[str, Count] = {}
    names: dict[str, str] = {}

    def walk(module: str, where: str) -> None:
        counts[where], names[where] = Count(), module.split("$")[0]
        for name, cell in modules[module]["cells"].items():
            kind = cell["type"]
            if kind in modules and "blackbox" not in modules[kind].get("attributes", {}):
                walk(kind, f"{where}.{name}" if where else name)
            else:
                counts[where].add(kind)

    walk(top, "")
    return counts, names


def owner(name: str, instances: set[str]) -> str | None:
    """Return the deepest instance whose path begins a cell or net name; None for generated names."""
    if name.startswith("$") or re.search(r"_(LUT4|SB_LUT4|CCU2C|SB_CARRY|PFUMX|L6MUX21)_", name):
        return None
    path = re.sub(r"(\[\d+\])+$", "", name.split("\\")[0])
    while "." in path:
        path = path.rsplit(".", 1)[0]
        if path in instances:
            return path
    return ""


def flat_counts(path: Path, top: str, instances: set[str]) -> tuple[Count, dict[str, Count]]:
    """Return the total of a flattened netlist and the counts for each instance.

    Flip-flops and RAMs belong to the instance in their name. abc9 drops the names of LUTs, so a LUT belongs
    to the instance with most of its sinks; this is found by following the nets back from flip-flops and
    outputs.
    """
    module = json.loads(path.read_text())["modules"][top]
    total, split = Count(), defaultdict(Count)
    cells: dict[str, dict] = module["cells"]
    owners: dict[str, str] = {}
    sinks: dict[int, list[str]] = defaultdict(list)
    for name, cell in cells.items():
        kind = cell["type"]
        total.add(kind)
        if kind.startswith(FF_CELLS) or kind in RAM_CELLS:
            owners[name] = owner(name, instances) or ""
        for port, bits in cell["connections"].items():
            if port not in OUTPUT_PORTS:
                for bit in bits:
                    sinks[bit].append(name)
    waiting = [name for name in cells if name not in owners]
    while waiting:
        rest = []
        for name in waiting:
            fed = {
                sink
                for port, bits in cells[name]["connections"].items()
                if port in OUTPUT_PORTS
                for bit in bits
                for sink in sinks[bit]
            }
            if any(sink not in owners for sink in fed):
                rest.append(name)
            else:
                votes = Counter(owners[sink] for sink in fed)
                owners[name] = max(sorted(votes), key=lambda inst: votes[inst]) if votes else ""
        if len(rest) == len(waiting):  # a loop through generated cells; the top module owns them
            owners.update(dict.fromkeys(rest, ""))
            break
        waiting = rest
    for name, cell in cells.items():
        split[owners[name]].add(cell["type"])
    return total, dict(split)
