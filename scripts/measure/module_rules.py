"""What `make lint` asks of inner modules: few ports, each with its meaning beside it, a file one can read.

Tops and carriers are left out: their ports are the pins of a part, which its manual explains.
"""

from __future__ import annotations

import re
from pathlib import Path

from cocotb_tests.harness import project
from openppmc.parts import tops

MOST_PORTS, MOST_LINES = 30, 350
PORT = re.compile(r"^ +(?:input|output|inout)\b(?P<rest>.*)")
PLAIN = re.compile(r"\b(?:clk_i|rst_ni)\b")
"""Ports that mean the same everywhere."""


def findings(name: str, text: str) -> list[str]:
    """What is wrong with the file of a module; packages have no ports."""
    found = (
        [f"{name}: {count} lines, at most {MOST_LINES}"] if (count := text.count("\n")) > MOST_LINES else []
    )
    _, module, rest = text.partition("\nmodule ")
    ports = [match["rest"] for line in rest.partition("\n);")[0].split("\n") if (match := PORT.match(line))]
    if module and len(ports) > MOST_PORTS:
        found.append(f"{name}: {len(ports)} ports, at most {MOST_PORTS}: bundle what travels together")
    bare = [port.split("//")[0].strip(" ,") for port in ports if "//" not in port and not PLAIN.search(port)]
    return [*found, *(f"{name}: {port}: its meaning is not beside it" for port in bare)]


def inner_modules() -> list[Path]:
    """Files below rtl/ but those of tops, carriers and FPGA boards."""
    outer = {row.top for row in tops()}
    return [
        path
        for path in sorted(project.RTL.rglob("*.sv"))
        if path.stem not in outer
        and not path.stem.endswith("_carrier")
        and project.RTL / "boards" not in path.parents
    ]


def all_findings() -> str:
    """Findings of all inner modules, a line each."""
    return "\n".join(
        line
        for path in inner_modules()
        for line in findings(project.relative(path), path.read_text(encoding="utf-8"))
    )
