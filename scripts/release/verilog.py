"""Plain Verilog of `make verilog`, including boards and IP-XACT packages, in one archive."""

from __future__ import annotations

from pathlib import Path

from cocotb_tests.harness.project import ROOT
from scripts.fpga.flow import plain
from scripts.fpga.flow.plain_file import write
from scripts.fpga.packages import ip
from scripts.fpga.packages.plain_boards import write_library
from scripts.release.archive import files_below, zipped
from scripts.release.state import Release


def make(release: Release, out: Path, scratch: Path) -> None:
    """Write the archive to `out`."""
    files = {f"{top}.v": write(top, scratch / "verilog") for top in plain.tops()}
    boards = write_library(folder=scratch / "boards").parent
    files |= {f"boards/{name}": path for name, path in files_below(boards).items()}
    for name in ip.NAMES:
        ip.write_package(name, scratch / "ip")
    files |= {f"ip/{name}": path for name, path in files_below(scratch / "ip").items()}
    zipped(out / release.name("verilog", ".zip"), {**files, "LICENSE": ROOT / "LICENSE"}, release.epoch)
