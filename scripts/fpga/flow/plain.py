"""Plain Verilog-2005 of a part or bridge: one readable file for tools that read no SystemVerilog (D-82).

yosys' `read_slang` elaborates the sources under given parameters and writes its modules as Verilog;
`plain_text` makes that readable; this module puts a header before it.
"""

from __future__ import annotations

import json
import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from cocotb_tests.harness import project
from cocotb_tests.harness.header import Parameter, parameters
from cocotb_tests.harness.project import ProjectError
from openppmc import __version__, parts
from scripts.fpga.flow.plain_text import readable

FAMILY = "plain"
"""What stands in place of an FPGA family in jobs of yosys."""
# As the sources waive it: a reset that data logic reads, too. Packed structs as one vector, whose parts feed
# one another; what a build leaves unused; choices by one-hot words.
RULES = ("SYNCASYNCNET", "UNOPTFLAT", "UNUSEDSIGNAL", "UNDRIVEN", "PINCONNECTEMPTY", "CASEOVERLAP")
WAIVED = tuple((rule, "*") for rule in RULES)

BRIDGES = {
    "ppmc_wishbone": "Wishbone B4 to the bus of a part",
    "ppmc_axil": "AXI4-Lite to the bus of a part",
    "ppmc_spi": "SPI to the bus of a part",
    "ppmc_isa": "ISA bus to the bus of a part",
    "ppmc_uart_bridge": "UART to the bus of a part",
}
"""Top module of the group `host` -> what it is."""

Value = int | str


def tops() -> dict[str, tuple[str, str]]:
    """Top module -> its group in rtl/files.yml, and what it is; parts, then bridges."""
    listed = project.listed()
    of_parts = {row.top: (row.rtl, listed[row.rtl].about) for row in parts.tops()}
    return of_parts | {name: ("host", about) for name, about in BRIDGES.items()}


def declared(top: str, sources: Sequence[Path]) -> dict[str, Parameter]:
    """Parameters in the head of a top module."""
    return parameters(next(path for path in sources if path.stem == top))


def given(top: str, sources: Sequence[Path], params: Mapping[str, Value]) -> dict[str, Value]:
    """These parameters of a top module; ProjectError for one that it has not, or that is of another type."""
    known = declared(top, sources)
    for name, value in params.items():
        if name not in known:
            raise ProjectError(f"{name}: {top} has no such parameter (it has {', '.join(known)})")
        if known[name].is_text != isinstance(value, str):
            kind = "a text" if known[name].is_text else "a whole number"
            raise ProjectError(f"{name}={value}: expected {kind}")
    return dict(params)


def header(top: str, about: str, sources: Sequence[Path], params: Mapping[str, Value]) -> str:
    """The first comment of a file: version, licence, what it is, its parameters as they are built in."""
    rows = [
        "SPDX-License-Identifier: Apache-2.0",
        f"{top}: {about}." if about else f"{top}.",
        f"OpenPPMC {__version__}, plain Verilog-2005, one file, nothing else needed. Do not change it here:",
        "`make verilog` writes it from the SystemVerilog sources.",
        "Comments are those of the sources. Ports: in the head of the first module.",
    ]
    known = declared(top, sources)
    if known:
        rows += ["", "Parameters, built in. For others: make verilog TOP=" + top + " PARAMS=NAME=VALUE,…"]
        wide = max(map(len, known))
        for name, one in known.items():
            value = params.get(name, one.value.strip('"').replace("_", ""))
            rows.append(f"  {name:{wide}} = {value!s:9}" + (f"  {one.about}" if one.about else ""))
    return "\n".join(f"// {row}".rstrip() for row in rows) + "\n"


def vendor_attributes(modules: Mapping[str, Any]) -> dict[str, dict[str, str]]:
    """Type of a vendor's cell -> its attributes, which are part of what it does; of yosys' JSON netlist.

    ProjectError if two cells of a type differ in them.
    """
    found: dict[str, dict[str, str]] = {}
    cells = [cell for module in modules.values() for cell in module["cells"].values()]
    for cell in cells:
        # Theirs are in capitals, yosys' own are not. A text that looks like bits has a space behind it.
        own = {
            name: re.sub(r"^([01xz]*) ", r"\1", value)
            for name, value in cell["attributes"].items()
            if name.isupper()
        }
        if found.setdefault(cell["type"], own) != own:
            raise ProjectError(f"{cell['type']}: two of them with different attributes")
    return {kind: own for kind, own in found.items() if own}


def with_attributes(text: str, attributes: Mapping[str, Mapping[str, str]]) -> str:
    """Verilog with these attributes before the instances of those types."""
    for kind, own in attributes.items():
        rows = ", ".join(f'{name} = "{value}"' for name, value in own.items())
        text = re.sub(rf"^(?=  {kind} )", lambda _, rows=rows: f"  (* {rows} *)\n", text, flags=re.M)
    return text


def finish(path: Path, netlist: Path, top: str, sources: Sequence[Path], params: Mapping[str, Value]) -> None:
    """Make yosys' file of a top readable, with its header, in place; netlist: the same as yosys' JSON."""
    texts = {source.stem: source.read_text(encoding="utf-8") for source in sources}
    about = {name: what for name, (_, what) in tops().items()}.get(top, "")
    attributes = vendor_attributes(json.loads(netlist.read_text())["modules"])
    text = with_attributes(readable(path.read_text(encoding="utf-8"), top, texts), attributes)
    path.write_text(
        f"{header(top, about, sources, params)}\n`default_nettype none\n\n{text}\n`default_nettype wire\n"
    )
