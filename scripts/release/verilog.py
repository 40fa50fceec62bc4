"""Plain Verilog of each part and bridge, as `make verilog` writes it, in one archive."""

from __future__ import annotations

from pathlib import Path

from cocotb_tests.harness.project import ROOT
from scripts.flow import plain
from scripts.verilog import write

from .archive import zipped
from .state import Release


def make(release: Release, out: Path, scratch: Path) -> None:
    """The archive into `out`."""
    files = {f"{top}.v": write(top, scratch / "verilog") for top in plain.tops()}
    zipped(out / release.name("verilog", ".zip"), {**files, "LICENSE": ROOT / "LICENSE"}, release.epoch)
