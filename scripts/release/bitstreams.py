"""Bitstreams and reports of all boards and parts, in one archive."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from cocotb_tests.harness.project import ProjectError
from scripts.fpga.flow.board_table import BY_PART, Board
from scripts.fpga.flow.boards import build_board
from scripts.release.archive import zipped
from scripts.release.state import Release


def selected(only: tuple[str, ...]) -> dict[str, tuple[Board, str]]:
    """Return board and host of each bitstream, by the name of the bitstream.

    Raises ProjectError for an unknown name.

    Args:
        only: names of the bitstreams to return; all bitstreams if it is empty.
    """
    every = {
        on.stem(host): (on, host) for boards in BY_PART.values() for on in boards.values() for host in on.top
    }
    for name in only:
        if name not in every:
            raise ProjectError(f"ONLY={name}: no such bitstream (there are {', '.join(every)})")
    return {name: every[name] for name in only or every}


def make(release: Release, out: Path, scratch: Path, say: Callable[[str], None]) -> None:
    """Write the archive to `out`; `say` is called with the bitstream that is being built."""
    files: dict[str, Path | bytes] = {}
    chosen = selected(release.only)
    for number, (name, (on, host)) in enumerate(chosen.items(), 1):
        count = f"{number} of {len(chosen)}"
        build_board(
            on.name, host, notify=lambda text, n=name, c=count: say(f"{n}, {c}: {text}"), part=on.part
        )
        files[f"{name}/{on.file(host).name}"] = on.file(host).read_bytes()
        files[f"{name}/report.json"] = (on.folder(host) / "report.json").read_bytes()
    zipped(out / release.name("bitstreams", ".zip"), files, release.epoch)
    if release.only:
        release.missing.append(f"Only these bitstreams are included: {', '.join(chosen)} (ONLY).")
