"""Rules of `make lint` for inner modules: few ports, each with a comment, and a file of limited length.

The rules do not apply to tops and carriers: their ports are the pins of a part, described in its manual.
"""

from __future__ import annotations

import re
from pathlib import Path

from cocotb_tests.harness import project
from openppmc.parts import tops

MOST_PORTS, MOST_LINES = 30, 350
PORT = re.compile(r"^ +(?:input|output|inout)\b(?P<rest>.*)")
PLAIN = re.compile(r"\b(?:clk_i|rst_ni)\b")
"""Ports that have the same meaning everywhere."""


def findings(name: str, text: str) -> list[str]:
    """Return the findings in the file of a module; packages have no ports."""
    found = (
        [f"{name}: {count} lines, at most {MOST_LINES}"] if (count := text.count("\n")) > MOST_LINES else []
    )
    _, module, rest = text.partition("\nmodule ")
    ports = [match["rest"] for line in rest.partition("\n);")[0].split("\n") if (match := PORT.match(line))]
    if module and len(ports) > MOST_PORTS:
        found.append(f"{name}: {len(ports)} ports, at most {MOST_PORTS}: combine related ports in a struct")
    bare = [port.split("//")[0].strip(" ,") for port in ports if "//" not in port and not PLAIN.search(port)]
    return [*found, *(f"{name}: {port}: comment is missing" for port in bare)]


def inner_modules() -> list[Path]:
    """Return the files below rtl/, except tops, carriers and FPGA boards."""
    outer = {row.top for row in tops()}
    return [
        path
        for path in sorted(project.RTL.rglob("*.sv"))
        if path.stem not in outer
        and not path.stem.endswith("_carrier")
        and project.RTL / "boards" not in path.parents
    ]


def all_findings() -> str:
    """Return the findings of all inner modules, one on each line."""
    return "\n".join(
        line
        for path in inner_modules()
        for line in findings(project.relative(path), path.read_text(encoding="utf-8"))
    )
