"""What `make report` measures: the part, the board top that holds part and bridge, the boards' bitstreams."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

from cocotb_tests.harness import project
from cocotb_tests.harness.config import F16
from cocotb_tests.harness.part import PARTS
from openppmc import parts

from . import board_route, boards, gates, pnr, scan_wrapper
from .netlist import Count, flat_counts
from .synthesis import run_yosys, wrapped_netlist
from .yosys_job import BEST

FOLDER = project.BUILD / "report"
CARRIERS = {row.name: f"{row.rtl}_carrier" for row in parts.having("carrier")}
"""Part -> its carrier, which is measured, too."""
HOST = "uart"
SIMULATED = {row.name for row in parts.folders() if row.gates and row.load("gates").netlists}
"""Parts whose netlist with default parameters `make test-gates` simulates, too: it is kept for that."""


@dataclass(frozen=True)
class Target:
    """One netlist to measure: of a board's bitstream, or of `base`, a yosys job without its family."""

    design: str
    family: str
    base: dict | None = None
    board: boards.Board | None = None

    @property
    def folder(self) -> Path:
        """Where its files go."""
        return FOLDER / self.design.replace(" ", "-")

    @property
    def job(self) -> tuple[str, str]:
        """The same for targets with the same netlist: boards that differ in their FPGA's size only."""
        return (self.board.top[HOST] if self.board else self.design, self.family)

    def synthesize(self) -> tuple[Count, Path]:
        """Size and mapped netlist."""
        if self.board:
            netlist = boards.synthesize_board(self.board, HOST)
            top = self.board.top[HOST]
        elif self.design in SIMULATED:
            top, sources = self.design, project.sources(project.part(self.design))
            folder = gates.netlist(self.family, top, sources, PARTS[top].params(F16))
            netlist = gates.mapped(self.family, folder)
        else:
            job = {**self.base, "family": self.family, "recipe": BEST[self.family], "keep": False}
            netlist, top = run_yosys(self.folder, job), self.base["top"]
        return flat_counts(netlist, top, set())[0], netlist


def base_job(part: str, board_top: bool) -> dict:
    """Top, sources and parameters of the part with its defaults, or of its board top with the UART host."""
    sources = project.sources(project.part(part))
    top = project.part(part).top
    if board_top:
        top = CARRIERS[part]
        sources = [*sources, *project.board_files(part)]
    return {
        "top": top,
        "include": [project.relative(path) for path in project.include_dirs()],
        "sources": [project.relative(path) for path in sources],
        "params": {"HOST": "UART"} if board_top and "HOST" in boards.parameters(top) else {},
    }


def targets(part: str) -> list[Target]:
    """Everything to measure for a part."""
    families = project.part(part).families
    found = [Target(part, family, base_job(part, False)) for family in families]
    if part in CARRIERS:
        found += [Target(CARRIERS[part], family, base_job(part, True)) for family in families]
        found += [
            Target(f"{on.stem(HOST)} bitstream", on.family, board=on) for on in boards.BY_PART[part].values()
        ]
    return found


def synthesize_all(wanted: list[Target], done: Callable[[Target], None]) -> list[tuple[Count, Path]]:
    """Size and netlist of each, two at a time, the same netlist once; `done` hears of each."""

    def one(target: Target) -> tuple[Count, Path]:
        result = target.synthesize()
        for like in wanted:
            if like.job == target.job:
                done(like)
        return result

    jobs = {target.job: target for target in wanted}
    with ThreadPoolExecutor(2) as pool:
        results = dict(zip(jobs, pool.map(one, jobs.values()), strict=True))
    return [results[target.job] for target in wanted]


def devices(target: Target) -> list[pnr.Device]:
    """Devices on which a part or board top is placed; the board top's UP5K is the iCEBreaker's bitstream."""
    own = [device for device in pnr.DEVICES if device.family == target.family]
    return [device for device in own if not device.wrapped] if target.design in CARRIERS.values() else own


def crowded(target: Target, device: pnr.Device, netlist: Path) -> bool:
    """Whether a part or board top has more pins than the device."""
    inputs, outputs = scan_wrapper.ports(netlist, target.base["top"])
    return sum(high - low + 1 for high, low in (*inputs.values(), *outputs.values())) > device.pins


def device_netlist(target: Target, device: pnr.Device, netlist: Path) -> Path:
    """The netlist to place: in the pin-saving wrapper where the device has too few pins."""
    if not device.wrapped and not crowded(target, device, netlist):
        return netlist
    return wrapped_netlist(target.folder, target.base, netlist, BEST[target.family], target.family)


def route_board(target: Target, netlist: Path, seed: int) -> dict[str, float | int]:
    """Place and route a board's netlist with its constraints and one seed: Fmax in MHz, LUTs, RAMs, totals.

    The files are kept away from those of `make bitstream`.
    """
    on = target.board
    folder = target.folder / f"seed-{seed}"
    folder.mkdir(parents=True, exist_ok=True)
    used = board_route.route(on, netlist, folder, [boards.CONSTRAINTS / on.constraints[HOST]], seed)
    return {
        "fmax": min(used.clocks.values()),
        "lut": used.lut[0],
        "lut_total": used.lut[1],
        "ram": used.ram[0],
        "ram_total": used.ram[1],
    }
