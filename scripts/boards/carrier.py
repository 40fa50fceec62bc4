"""Ports and parameters of <part>_carrier, read from its header: the one place where they stand."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

from cocotb_tests.harness import project
from cocotb_tests.harness.header import Parameter, parameters
from cocotb_tests.harness.project import ProjectError

PORT = re.compile(
    r"^ +(?P<way>input|output) +(?:wire )?logic *(?:\[ *(?P<high>\d+): *(?P<low>\d+)\])? +(?P<name>\w+),?"
    r" *(?://(?P<text>.*))?$"
)


@dataclass(frozen=True)
class Port:
    """A port; `group` is the comment line above it and its neighbours, `text` the comment behind it."""

    name: str
    output: bool
    bits: range | None  # None: not a vector
    group: str
    text: str

    @property
    def width(self) -> int:
        """Number of bits."""
        return len(self.bits) if self.bits else 1

    def bit_names(self) -> list[str]:
        """`s[1]` and so on, from the lowest; the name itself if it is no vector."""
        return [f"{self.name}[{bit}]" for bit in self.bits] if self.bits else [self.name]


@dataclass(frozen=True)
class Carrier:
    """The header of a module."""

    name: str
    parameters: dict[str, Parameter]
    ports: dict[str, Port]

    def two_way(self) -> dict[str, str]:
        """Pins that are driven and read: name -> port that drives it, "" if it is only pulled low."""
        return {
            name[:-2]: f"{name[:-2]}_o" if f"{name[:-2]}_o" in self.ports else ""
            for name in self.ports
            if name.endswith("_i") and f"{name[:-2]}_oe" in self.ports
        }


def path_of(part_folder: str) -> Path:
    """Where the carrier of a part is."""
    return project.RTL / part_folder / f"{part_folder}_carrier.sv"


def read(path: Path) -> Carrier:
    """The header of the carrier in this file."""
    if not path.is_file():
        raise ProjectError(f"{project.relative(path)} is not there: a board cannot carry the part")
    ports, group = dict[str, Port](), ""
    for line in path.read_text(encoding="utf-8").split(");\n", 1)[0].splitlines():
        if found := PORT.match(line):
            bits = range(int(found["low"]), int(found["high"]) + 1) if found["high"] else None
            text = (found["text"] or "").strip()
            ports[found["name"]] = Port(found["name"], found["way"] == "output", bits, group, text)
        elif line.startswith("    // "):
            group = line.strip()[3:]
    return Carrier(path.stem, parameters(path), ports)
