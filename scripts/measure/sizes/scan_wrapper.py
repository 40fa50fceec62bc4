"""Temporary top for devices with fewer pins than the part: shift registers connect inputs and outputs.

Only the clock rate is measured with the wrapper; the cells are counted without it. All paths into and out of
the part start and end at a flip-flop, so the wrapper hides no path of the part and adds no slower path.
"""

from __future__ import annotations

import json
import re
from pathlib import Path

NAME = "scan_wrapper"


def ports(netlist: Path, top: str) -> tuple[dict[str, list[int]], dict[str, list[int]]]:
    """Return the input ports and the output ports of a mapped netlist with their bit ranges [msb, lsb]."""
    module = json.loads(netlist.read_text())["modules"][top]
    inputs: dict[str, list[int]] = {}
    outputs: dict[str, list[int]] = {}
    for name, port in module["ports"].items():
        low = int(port.get("offset", 0))
        (inputs if port["direction"] == "input" else outputs)[name] = [low + len(port["bits"]) - 1, low]
    return inputs, outputs


def source(
    netlist: Path, top: str, params: dict[str, int | str], reset: str = "rst_n", pins_like: str = ""
) -> str:
    """Return the wrapper of `top` with these parameters as SystemVerilog; its clock is `clk`.

    `reset` is the name of its active-low reset, "" without a reset. `pins_like` is a regular expression.
    Inputs whose name does not begin with a match are tied to 0; outputs with such a name are open.
    """
    given = ", ".join(
        f'.{name}("{value}")' if isinstance(value, str) else f".{name}({value})"
        for name, value in params.items()
    )
    inputs, outputs = ports(netlist, top)
    used = re.compile(pins_like)
    pins = {name: rng for name, rng in inputs.items() if name not in ("clk", reset) and used.match(name)}
    idle = [name for name in inputs if name not in {"clk", reset, *pins}]
    outputs = {name: rng for name, rng in outputs.items() if used.match(name)}
    count_in = sum(high - low + 1 for high, low in pins.values())
    count_out = sum(high - low + 1 for high, low in outputs.values())
    lines = [
        f"module {NAME} (",
        "  input wire clk, input wire rst_n, input wire scan_i, input wire take_i, output logic scan_o",
        ");",
        f"  logic [{count_in - 1}:0] in_q;",
        f"  logic [{count_out - 1}:0] out_q;",
        f"  wire [{count_out - 1}:0] out;",
        "  always_ff @(posedge clk) begin",
        "    in_q <= {in_q, scan_i};",
        "    out_q <= take_i ? out : {out_q, 1'b0};",
        "  end",
        "  assign scan_o = out_q[$bits(out_q)-1];",
        f"  {top} #({given}) u_part (" if given else f"  {top} u_part (",
        "    .clk(clk),",
        *([f"    .{reset}(rst_n),"] if reset else []),
        *(f"    .{name}('0)," for name in idle),
    ]
    for bus, group in (("in_q", pins), ("out", outputs)):
        at = 0
        for name, (high, low) in group.items():
            width = high - low + 1
            lines.append(f"    .{name}({bus}[{at + width - 1}:{at}]),")
            at += width
    lines[-1] = lines[-1].rstrip(",")
    return "\n".join([*lines, "  );", "endmodule", ""])
