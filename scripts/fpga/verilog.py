"""`make verilog [TOP=…] [PARAMS=…]`: parts, bridges and boards as plain Verilog-2005, in build/verilog/.

yosys' `read_verilog` and Verilator read each file before it is stored. Without TOP, the boards are written
into a separate folder with a FuseSoC core that builds them (D-89). TOP=<part>_axil writes an IP-XACT package
of a part with an AXI4-Lite bridge into ip/ (D-126).
"""

from __future__ import annotations

import argparse
import sys

from cocotb_tests.harness import project
from cocotb_tests.harness.project import ProjectError, console
from scripts.fpga.flow import plain
from scripts.fpga.flow.plain_file import FOLDER, write
from scripts.fpga.packages import ip
from scripts.fpga.packages.plain_boards import write_library


def parameters(text: str) -> dict[str, plain.Value]:
    """Return the values in a text NAME=VALUE,…; raise ProjectError if the text has another form."""
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
    """Run the command line."""
    parser = argparse.ArgumentParser(
        prog="python -m scripts.fpga.verilog", description=(__doc__ or "").split("\n")[0]
    )
    parser.add_argument("--top", help="one top module (default: all parts, bridges and boards)")
    parser.add_argument("--params", default="", help="its parameters: NAME=VALUE, separated by commas")
    args = parser.parse_args()
    params = parameters(args.params)
    if params and not args.top:
        raise ProjectError("PARAMS needs TOP, the module with these parameters")
    for top in [args.top] if args.top else (*plain.tops(), *ip.NAMES):
        path = ip.write_package(top, given=params) if top in ip.NAMES else write(top, FOLDER, params)
        lines = len(path.read_text(encoding="utf-8").splitlines())
        console.print(f"[green]ok[/]   {project.relative(path)}, {lines} lines")
    if not args.top:
        console.print(f"[green]ok[/]   {project.relative(write_library())} and its boards")
    return 0


if __name__ == "__main__":
    sys.exit(project.run(main))
