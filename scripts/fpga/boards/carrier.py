"""Ports and parameters of <part>_carrier, read from its module header, which is their only definition."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from cocotb_tests.harness import project
from cocotb_tests.harness.header import Parameter, parameters
from cocotb_tests.harness.project import ProjectError
from openppmc.parts import Row

PORT = re.compile(
    r"^ +(?P<way>input|output) +(?:wire )?logic *(?:\[ *(?P<high>[^:]+): *(?P<low>\d+)\])? +(?P<name>\w+),?"
    r" *(?://(?P<text>.*))?$"
)


BY_PARAMETER = re.compile(r"(?:(?P<times>\d+)\*)?(?P<name>[A-Z]\w*)-1")
"""Text form of the highest bit of a vector whose width depends on a parameter."""


@dataclass(frozen=True)
class Port:
    """A port.

    Attributes:
        group: comment line above the group of ports to which the port belongs.
        text: comment after the port.
    """

    name: str
    output: bool
    bits: range | None  # None if the port is not a vector
    group: str
    text: str

    @property
    def width(self) -> int:
        """Number of bits."""
        return len(self.bits) if self.bits else 1

    def bit_names(self) -> list[str]:
        """Return the names of the bits (`s[1]`, …), lowest first; the port name if it is not a vector."""
        return [f"{self.name}[{bit}]" for bit in self.bits] if self.bits else [self.name]


@dataclass(frozen=True)
class Carrier:
    """The header of a carrier module."""

    name: str
    parameters: dict[str, Parameter]
    ports: dict[str, Port]

    def two_way(self) -> dict[str, str]:
        """Return each pin that is not always driven, with the port that drives it ("": only pulled low)."""
        names = [name.removesuffix("_oe") for name in self.ports if name.endswith("_oe")]
        return {
            name: f"{name}_o" if f"{name}_o" in self.ports else ""
            for name in names
            if f"{name}_i" in self.ports or f"{name}_o" in self.ports
        }

    def side(self, name: str) -> Port:
        """Return a port of a pin that is not always driven: the input or, if it is missing, the output."""
        return self.ports.get(f"{name}_i") or self.ports[f"{name}_o"]


def path_of(row: Row) -> Path:
    """Return the path of the carrier of a part."""
    return project.RTL / row.folder / f"{row.rtl}_carrier.sv"


def _highest(text: str, values: Mapping[str, Any]) -> int:
    """Return the highest bit of a vector; raise ProjectError unless it is a number or [n *] PARAMETER - 1."""
    if text.isdecimal():
        return int(text)
    found = BY_PARAMETER.fullmatch(text.replace(" ", ""))
    if not found or not isinstance(values.get(found["name"]), int):
        raise ProjectError(f"[{text}:0]: expected a number or [n*]PARAMETER-1")
    return int(found["times"] or 1) * int(values[found["name"]]) - 1


def read(path: Path, given: Mapping[str, Any] | None = None) -> Carrier:
    """Return the header of the carrier in a file. A parameter not in `given` has its default value."""
    if not path.is_file():
        raise ProjectError(f"{project.relative(path)} is missing; a board needs the carrier of the part")
    ports, group = dict[str, Port](), ""
    chosen = parameters(path)
    values = {**{name: one.default for name, one in chosen.items()}, **(given or {})}
    for line in path.read_text(encoding="utf-8").split(");\n", 1)[0].splitlines():
        if found := PORT.match(line):
            high = found["high"]
            bits = range(int(found["low"]), _highest(high, values) + 1) if high else None
            text = (found["text"] or "").strip()
            ports[found["name"]] = Port(found["name"], found["way"] == "output", bits, group, text)
        elif line.startswith("    // "):
            group = line.strip()[3:]
    return Carrier(path.stem, chosen, ports)
