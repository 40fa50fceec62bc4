"""Rules of `make lint` for the RTL: size of the inner modules, and names.

Inner modules have few ports, each with a comment, and files of limited length. These rules do not apply to
tops and carriers: their ports are the pins of a part, described in its manual. The rules for names apply to
all files.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from pathlib import Path

from cocotb_tests.harness import project
from openppmc.parts import tops

MOST_PORTS, MOST_LINES = 30, 350
PORT = re.compile(r"^ +(?:input|output|inout)\b(?P<rest>.*)")
PLAIN = re.compile(r"\b(?:clk_i|rst_ni)\b")
"""Ports that have the same meaning everywhere."""
RESET_PORT = re.compile(r"\.\w*rst_n[io]?\s*\(\s*(\w+)")
RESET_EDGE = re.compile(r"\bnegedge\s+(\w+)")
RESET = re.compile(r"rst|reset")
ACTIVE_LOW = re.compile(r"_n(?:[ioq]|_q)?$")
CLK_SUFFIX = re.compile(r"\b(?:parameter|localparam)\b[^;=]*?\b(\w+Clk)\s*=")
PACKAGE = re.compile(r"^package (\w+);(.*?)^endpackage", re.MULTILINE | re.DOTALL)
TYPE = re.compile(r"(?:\btypedef\b[^{;]*|\}\s*)\b(\w+_[te])\s*;")
PARALLEL = {"ppmc2104_pkg", "ppmc_code_pkg"}
"""Packages that may define types with the same names, because no file imports both."""
VAGUE = re.compile(r"(?:it|the same|this one|what|when|where)[.;]?$|and\b", re.IGNORECASE)


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


def name_findings(name: str, text: str) -> list[str]:
    """Return the findings in the names and port comments of a file."""
    code = re.sub(r"//.*", "", text)
    resets = dict.fromkeys([*RESET_PORT.findall(code), *RESET_EDGE.findall(code)])
    found = [
        f"{name}: {net}: the name of an active-low reset must end in _n"
        for net in resets
        if RESET.search(net) and not ACTIVE_LOW.search(net)
    ]
    found += [f"{name}: {one}: use the suffix Cycles, not Clk" for one in CLK_SUFFIX.findall(code)]
    for line in text.split("\n"):
        port, _, comment = line.partition("//")
        if PORT.match(port) and VAGUE.match(comment.strip()):
            found.append(f"{name}: {port.split()[-1].strip(',')}: comment without a noun: {comment.strip()}")
    return found


def type_findings(texts: Iterable[str]) -> list[str]:
    """Return the types that more than one package defines."""
    places: dict[str, list[str]] = {}
    for text in texts:
        for package, body in PACKAGE.findall(text):
            for kind in TYPE.findall(re.sub(r"//.*", "", body)):
                places.setdefault(kind, []).append(package)
    return [
        f"{kind}: defined in {' and '.join(sorted(packages))}; use two names"
        for kind, packages in sorted(places.items())
        if len(packages) > 1 and not set(packages) <= PARALLEL
    ]


def all_findings() -> str:
    """Return the findings of all RTL files, one on each line."""
    texts = {path: path.read_text(encoding="utf-8") for path in sorted(project.RTL.rglob("*.sv"))}
    names = [line for path, text in texts.items() for line in name_findings(project.relative(path), text)]
    sizes = [line for path in inner_modules() for line in findings(project.relative(path), texts[path])]
    return "\n".join([*sizes, *names, *type_findings(texts.values())])
