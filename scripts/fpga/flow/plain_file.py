"""Write files of plain Verilog for parts, bridges and board tops, and check them with other tools."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from cocotb_tests.harness import project
from cocotb_tests.harness.project import ProjectError
from scripts.fpga.flow import boards, gates, plain
from scripts.fpga.flow.plain_check import check

FOLDER = project.BUILD / "verilog"


def write(top: str, folder: Path, params: Mapping[str, plain.Value] | None = None) -> Path:
    """Write the file of a top module into a folder; raise ProjectError for an unknown top or a tool error."""
    known = plain.tops()
    if top in boards.PART_OF:
        sources, cells = boards.sources(top), boards.VENDOR_CELLS
    elif top in known:
        sources, cells = project.files(known[top][0]), None
    else:
        tops = (*known, *boards.PART_OF)
        raise ProjectError(f"TOP={top}: no such part, bridge or board (known: {', '.join(tops)})")
    values = plain.check_params(top, sources, params or {})
    made = gates.netlist(plain.FAMILY, top, sources, values) / "netlist.v"
    folder.mkdir(parents=True, exist_ok=True)
    path, new = folder / f"{top}.v", folder / f".{top}.v"
    new.write_bytes(made.read_bytes())
    try:
        check(new, top, cells)
        new.replace(path)
    finally:
        new.unlink(missing_ok=True)
    return path
