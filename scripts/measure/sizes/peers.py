"""Other open designs with step outputs, for comparison.

The module contains their addresses, and reads the designs of a source folder that are measured. This project
contains no part of these designs and does not describe how to build them. The user stores their sources in a
separate folder, with a file peers.json that describes the designs to measure, a list of objects:

    {"title": "…", "what": "…", "url": "https://…", "top": "module", "sources": ["below/the/folder.v", …],
     "params": {"NAME": 1}, "reset": "name of the active-low reset", "pins": "regular expression"}

`params`, `reset` and `pins` are optional. The name of the clock is `clk`. `pins` matches the beginning of the
names of the ports that one axis uses; all other ports are idle.
"""

from __future__ import annotations

import json
from dataclasses import dataclass, field, fields
from pathlib import Path

from cocotb_tests.harness.project import ProjectError

WHERE = {
    "fsref step_motor": "https://github.com/walkthetalk/fsref",
    "riocore stepdir": "https://github.com/multigcs/riocore",
    "hostmot2 stepgen (LinuxCNC)": "https://github.com/LinuxCNC/hostmot2-firmware",
    "LiteX-CNC stepgen": "https://github.com/Peter-van-Tol/LiteX-CNC",
    "RAPcores, one axis": "https://github.com/RAPcores/rapcores",
}
"""Addresses of the designs in docs/benchmarks.md."""

OLDER = (
    ("hostmot2 stepgen (LinuxCNC)", "velocity DDS; the host makes the ramp", 271, 212, 0),
    ("LiteX-CNC stepgen", "velocity with an acceleration limit", 887, 213, 0),
    ("scurvegen", "7-phase S-curve; the host computes the phases", 661, 229, 0),
    ("RAPcores, one axis", "DDA, H-bridges, SPI", 2279, 1410, 1),
)
"""Sizes that were measured earlier with plain `synth_ecp5`: title, description, COMB, FF, block RAM."""


@dataclass(frozen=True)
class Peer:
    """One design that peers.json describes."""

    title: str
    what: str
    url: str
    top: str
    sources: tuple[str, ...]
    params: dict[str, int | str] = field(default_factory=dict)
    reset: str = ""
    pins: str = ""

    def files(self, folder: Path) -> list[str]:
        """Return the source files; if one is missing, raise ProjectError with the address of the design."""
        files = [folder / source for source in self.sources]
        for file in files:
            if not file.is_file():
                raise ProjectError(f"{file} is not there; {self.title} is at {self.url}")
        return [str(file.resolve()) for file in files]


def read(folder: Path) -> list[Peer]:
    """Return the designs in peers.json of a folder; raise ProjectError if the file cannot be read."""
    file = folder / "peers.json"
    known = ", ".join(WHERE.values())
    if not file.is_file():
        raise ProjectError(
            f"{file} is not there: PEERS is a folder with open designs ({known}) and a peers.json that "
            "describes them as scripts/measure/sizes/peers.py says"
        )
    names = {item.name for item in fields(Peer)}
    try:
        described = json.loads(file.read_text())
        return [Peer(**{**entry, "sources": tuple(entry["sources"])}) for entry in described]
    except (ValueError, KeyError, TypeError) as error:
        raise ProjectError(
            f"{file}: expected a list of objects with {', '.join(sorted(names))}: {error}"
        ) from None
