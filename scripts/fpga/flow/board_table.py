"""The boards of `make bitstream`, from their descriptions."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from cocotb_tests.harness import project
from cocotb_tests.harness.project import ProjectError
from openppmc import parts as table
from scripts.fpga.boards.description import HOSTS, Carried, Description, Device, load_all


@dataclass(frozen=True)
class Board:
    """One board: its FPGA, its clock, and for each host (HOSTS) the top module with its constraint file.

    Attributes:
        clk_hz: frequency of the part's `clk`.
        goal_mhz: minimum frequency of `clk` in MHz that the project requires on this board.
        oscillator: clock input with its frequency in MHz.
        loader: name of the board in openFPGALoader.
        part: the part on the board.
        revisions: board revisions that have these pins.
    """

    name: str
    title: str
    revisions: str
    device: str
    family: str
    top: dict[str, str]
    constraints: dict[str, str]
    oscillator: tuple[str, float]
    clk_hz: int
    goal_mhz: float
    suffix: str
    loader: str
    route: tuple[str, ...]  # nextpnr options that select the device
    part: str = "ppmc104"
    code: str = ""  # four letters in the build ID of its bitstreams
    chip: str = ""  # Gowin family name for nextpnr and the packer
    recipe: str = ""  # recipe of yosys_job; "" selects the best recipe of the family

    def folder(self, host: str) -> Path:
        """Return build/boards/<board> for the UART host, build/boards/<board>-<host> for another host."""
        return project.BUILD / "boards" / self.stem(host)

    def stem(self, host: str) -> str:
        """Return the name of the board's folder and of its file: the board with its part and its host."""
        part = "" if self.part == "ppmc104" else f"-{self.part}"
        return self.name + part + ("" if host == "uart" else f"-{host}")

    def file(self, host: str) -> Path:
        """Return the path of the bitstream file, which may not exist."""
        return self.folder(host) / f"{self.stem(host)}{self.suffix}"


def _board(of: Description, device: Device, same: list[Carried]) -> Board:
    """Return a part on a board with one of its FPGAs.

    Args:
        same: entries for this part in the description: one for all hosts, or one for each host.
    """
    on = same[0]
    return Board(
        name=device.name,
        title=device.title,
        revisions=of.revisions,
        device=device.device,
        family=of.family,
        top={host: of.top(one) for one in same for host in one.hosts},
        constraints={host: of.constraints(one) for one in same for host in one.hosts},
        oscillator=(of.clock["port"], of.clock["mhz"]),
        clk_hz=round(on.mhz * 1e6),
        goal_mhz=on.goal,
        suffix=of.suffix,
        loader=of.loader,
        code=of.code,
        route=tuple(map(str, device.route)),
        part=on.part,
        chip=device.chip,
        recipe=on.recipe,
    )


def by_part(descriptions: tuple[Description, ...]) -> dict[str, dict[str, Board]]:
    """Return the boards that the tools of `make setup` build, by part and by name, in order of parts."""
    found: dict[str, dict[str, Board]] = {}
    for part in table.PARTS:
        for of in descriptions:
            same = [on for on in of.parts if on.part == part]
            for device in of.devices if same else ():
                found.setdefault(part, {})[device.name] = _board(of, device, same)
    return found


try:
    DESCRIPTIONS = load_all()
except ProjectError as error:
    # A script that imports this module then ends with a one-line message, not with a traceback.
    raise SystemExit(project.fail(str(error))) from None
BY_PART = by_part(DESCRIPTIONS)
BOARDS = BY_PART["ppmc104"]
PART_OF = {of.top(on): on.part for of in DESCRIPTIONS for on in of.parts}
"""Part of each top module."""
CARRIED = {f"{row.rtl}_carrier": row.name for row in table.having("carrier")}
"""Part of each carrier module."""
HOSTS_OF = {of.top(on): on.hosts for of in DESCRIPTIONS for on in of.parts}
"""Hosts that each top module supports."""


def board(name: str, part: str = "ppmc104") -> Board:
    """Return the board `name` with a part, or raise ProjectError, which lists the boards or parts."""
    if part not in BY_PART:
        raise ProjectError(f"PART={part}: no board carries it (known: {', '.join(BY_PART)})")
    known = BY_PART[part]
    if name in known:
        return known[name]
    carries = [other for other, boards in BY_PART.items() if name in boards]
    if carries:
        raise ProjectError(f"BOARD={name}: not with {part}, give PART={' or '.join(carries)}")
    where = "" if part == "ppmc104" else f" with {part}"
    raise ProjectError(f"BOARD={name}: no such board{where} (known: {', '.join(known)})")


def check_host(on: Board, host: str) -> str:
    """Return the host unchanged; raise ProjectError if this board does not have it."""
    if host not in HOSTS:
        raise ProjectError(f"HOST={host}: expected {', '.join(HOSTS)}")
    if host not in on.top:
        raise ProjectError(f"HOST={host}: {on.name} with {on.part} has only {', '.join(on.top)}")
    return host


def part_of(module: str) -> str:
    """Return the part of a top or of a carrier."""
    return PART_OF.get(module) or CARRIED[module]
