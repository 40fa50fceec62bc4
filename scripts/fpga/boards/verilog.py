"""Functions that return pieces of SystemVerilog, and format them."""

from __future__ import annotations

import subprocess
from typing import Any

from cocotb_tests.harness import project
from cocotb_tests.harness.project import ProjectError

LAYOUT = (
    "--flagfile=.verible-format.flags",
    *(f"--{what}_alignment=align" for what in ("port_declarations", "formal_parameters")),
    *(f"--{what}_alignment=align" for what in ("named_port", "named_parameter", "assignment_statement")),
    "-",
)


def literal(value: Any, kind: str = "") -> str:
    """Return a value of board.yml as SystemVerilog, for a parameter of type `kind`."""
    if kind == "bit":
        return f"1'b{value}"
    return str(value) if isinstance(value, int) else f'"{value}"'


def declaration(way: str, bits: list[str], text: str) -> str:
    """Return the declaration of one port of the top."""
    name = bits[0].split("[")[0]
    numbers = [int(bit[len(name) + 1 : -1]) for bit in bits if "[" in bit]
    span = f"[{max(numbers)}:{min(numbers)}] " if numbers else ""
    kind = {"in": "input wire logic", "out": "output logic", "inout": "inout wire logic"}[way]
    return f"    {kind} {span}{name},{f'  // {text}' if text else ''}"


def instance(module: str, params: dict[str, str], name: str, ports: dict[str, str | None]) -> list[str]:
    """Return an instance; a port with None is connected to the signal with the same name."""
    chosen = [f"      .{key}({value})," for key, value in params.items()]
    lines = [f"      .{key}," if value is None else f"      .{key}({value})," for key, value in ports.items()]
    start = (
        [f"  {module} #(", *without_last_comma(chosen), f"  ) {name} ("]
        if chosen
        else [f"  {module} {name} ("]
    )
    return [*start, *without_last_comma(lines), "  );", ""]


def without_last_comma(lines: list[str]) -> list[str]:
    """Return the lines without the comma of the last line."""
    return [*lines[:-1], lines[-1].removesuffix(",")]


def without_comma(line: str) -> str:
    """Return the line of a port without the comma before its comment."""
    code, mark, text = line.partition("  //")
    return code.rstrip().removesuffix(",") + mark + text


def part_select(whole: str, bits: list[str]) -> str:
    """Return the part select of neighbouring bits of a vector."""
    first, last = (bit.rpartition("[")[2].rstrip("]") for bit in (bits[0], bits[-1]))
    return f"{whole}[{last}:{first}]" if len(bits) > 1 else f"{whole}[{first}]"


def laid_out(text: str) -> str:
    """Return the text formatted by verible-verilog-format, as `make lint` requires for all RTL."""
    program = project.tool("verible-verilog-format")
    try:
        done = subprocess.run(
            [program, *LAYOUT], input=text, cwd=project.ROOT, text=True, capture_output=True, check=False
        )
    except FileNotFoundError:
        raise ProjectError("verible-verilog-format is not installed: run `make setup`") from None
    if done.returncode:
        raise ProjectError(f"verible-verilog-format: {done.stderr.strip().splitlines()[0]}")
    return done.stdout
