"""SystemVerilog with FuseSoC cores, Bender manifest and lists for vendor tools, as one archive."""

from __future__ import annotations

from pathlib import Path

from cocotb_tests.harness.project import ROOT
from scripts import generated
from scripts.fpga.packages.cores import core_files
from scripts.fpga.packages.lists import list_files
from scripts.fpga.packages.vendors import vendor_files
from scripts.release.archive import tar_gz
from scripts.release.state import Release, tracked

BELOW = (
    "rtl",
    "packages",
    "tb",
    "constraints",
    "drivers",
    "Bender.yml",
    "*.core",
    "LICENSE",
    "CHANGELOG.md",
)


def make(release: Release, out: Path, scratch: Path) -> None:
    """Write the archive to `out`; raise ProjectError if a core or a list is outdated."""
    generated.current("packages", {**core_files(), **list_files(), **vendor_files()})
    folder = f"openppmc-{release.version}"
    files = {f"{folder}/{path.as_posix()}": ROOT / path for path in tracked(*BELOW)}
    tar_gz(out / release.name("rtl", ".tar.gz"), files, release.epoch)
