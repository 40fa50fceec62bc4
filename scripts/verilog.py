"""`make verilog [TOP=…] [PARAMS=…]`: parts and bridges as plain Verilog-2005, in build/verilog/.

Each file is read by yosys' `read_verilog` and by Verilator before it is there.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Mapping
from pathlib import Path

from cocotb_tests.harness import project
from cocotb_tests.harness.project import ProjectError, console
from scripts.flow import gates, plain
from scripts.flow.plain_check import check

FOLDER = project.BUILD / "verilog"


def write(top: str, folder: Path, params: Mapping[str, plain.Value] | None = None) -> Path:
    """The file of a top module, into a folder; ProjectError if there is no such top or a tool refuses it."""
    known = plain.tops()
    if top not in known:
        raise ProjectError(f"TOP={top}: no such part or bridge (known: {', '.join(known)})")
    sources = project.files(known[top][0])
    values = plain.given(top, sources, params or {})
    made = gates.netlist(plain.FAMILY, top, sources, values) / "netlist.v"
    folder.mkdir(parents=True, exist_ok=True)
    path, new = folder / f"{top}.v", folder / f".{top}.v"
    new.write_bytes(made.read_bytes())
    try:
        check(new, top)
        new.replace(path)
    finally:
        new.unlink(missing_ok=True)
    return path


def parameters(text: str) -> dict[str, plain.Value]:
    """Values from NAME=VALUE with commas between; ProjectError when one has another form."""
    found: dict[str, plain.Value] = {}
    for word in filter(None, text.split(",")):
        name, equals, value = word.partition("=")
        if not equals or not name.isidentifier() or not value.isalnum():
            raise ProjectError(
                f"PARAMS={text}: expected NAME=VALUE, such as CLK_HZ=50000000,TIMING=DATASHEET"
            )
        found[name] = int(value) if value.isdigit() else value
    return found


def main() -> int:
    """Entry point."""
    parser = argparse.ArgumentParser(
        prog="python -m scripts.verilog", description=(__doc__ or "").split("\n")[0]
    )
    parser.add_argument("--top", help="one top module; without it all parts and bridges")
    parser.add_argument("--params", default="", help="NAME=VALUE of its parameters, with commas between")
    args = parser.parse_args()
    params = parameters(args.params)
    if params and not args.top:
        raise ProjectError("PARAMS needs TOP, the module whose parameters these are")
    for top in [args.top] if args.top else plain.tops():
        path = write(top, FOLDER, params)
        lines = len(path.read_text(encoding="utf-8").splitlines())
        console.print(f"[green]ok[/]   {project.relative(path)}, {lines} lines")
    return 0


if __name__ == "__main__":
    sys.exit(project.run(main))
