"""The boards that `make bitstream` knows, by their descriptions, and the way from top to bitstream file."""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path

from cocotb_tests.harness import project
from cocotb_tests.harness.header import parameters as parameters_of
from cocotb_tests.harness.project import ProjectError
from openppmc import parts as table
from scripts.boards.description import HOSTS, Carried, Description, Device, load_all

from . import board_route
from .synthesis import run_yosys
from .yosys_job import BEST

SEEDS = 5  # tried one after the other until the clock rate is met
VENDOR_CELLS = project.ROOT / "lint" / "vendor_cells.sv"
CONSTRAINTS = project.ROOT / "constraints"


@dataclass(frozen=True)
class Board:
    """One board: its FPGA, its clock, and per host ("uart", "bus") the top module and its constraint file.

    `clk_hz` is the frequency of `clk` that the top gives to the part, `goal_mhz` the least that the project
    wants of this board, `oscillator` the clock input with its frequency in MHz, `loader` its name in
    openFPGALoader, `part` what it carries.
    """

    name: str
    title: str
    device: str
    family: str
    top: dict[str, str]
    constraints: dict[str, str]
    oscillator: tuple[str, float]
    clk_hz: int
    goal_mhz: float
    suffix: str
    loader: str
    route: tuple[str, ...]  # nextpnr's choice of the device
    part: str = "ppmc104"
    chip: str = ""  # Gowin's family, as nextpnr and the packer call it
    seeds: int = 5  # `make report` places it with at most so many; one takes minutes on some
    recipe: str = ""  # of yosys_job; none: the family's best

    def folder(self, host: str) -> Path:
        """build/boards/<board> for the UART host, build/boards/<board>-bus for the other."""
        return project.BUILD / "boards" / self.stem(host)

    def stem(self, host: str) -> str:
        """The board's name with its part and host, as folder and file are called."""
        part = "" if self.part == "ppmc104" else f"-{self.part}"
        return self.name + part + ("" if host == "uart" else f"-{host}")

    def file(self, host: str) -> Path:
        """The bitstream file, there or not."""
        return self.folder(host) / f"{self.stem(host)}{self.suffix}"


def _board(of: Description, device: Device, same: list[Carried]) -> Board:
    """A part on a board with one of its FPGAs; `same` has one entry, or one for each of its hosts."""
    on = same[0]
    return Board(
        name=device.name,
        title=device.title,
        device=device.device,
        family=of.family,
        top={host: of.top(one) for one in same for host in one.hosts},
        constraints={host: of.constraints(one) for one in same for host in one.hosts},
        oscillator=(of.clock["port"], of.clock["mhz"]),
        clk_hz=round(on.mhz * 1e6),
        goal_mhz=on.goal,
        suffix=of.suffix,
        loader=of.loader,
        route=tuple(map(str, device.route)),
        part=on.part,
        chip=device.chip,
        seeds=on.seeds,
        recipe=on.recipe,
    )


def by_part(descriptions: tuple[Description, ...]) -> dict[str, dict[str, Board]]:
    """Part -> name -> board, for what the tools of `make setup` build; the parts as in their table."""
    found: dict[str, dict[str, Board]] = {}
    for part in table.PARTS:
        for of in descriptions:
            same = [on for on in of.parts if on.part == part]
            for device in of.devices if same else ():
                found.setdefault(part, {})[device.name] = _board(of, device, same)
    return found


try:
    DESCRIPTIONS = load_all()
except ProjectError as error:  # one line, whichever script asks
    raise SystemExit(project.fail(str(error))) from None
BY_PART = by_part(DESCRIPTIONS)
BOARDS = BY_PART["ppmc104"]
PART_OF = {of.top(on): on.part for of in DESCRIPTIONS for on in of.parts}
"""Top -> what it carries."""


def board(name: str, part: str = "ppmc104") -> Board:
    """The board called `name` with a part; ProjectError says which boards or parts there are otherwise."""
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
    """The host itself; ProjectError if this board does not have it."""
    if host not in HOSTS:
        raise ProjectError(f"HOST={host}: expected uart or bus")
    if host not in on.top:
        raise ProjectError(f"HOST={host}: {on.name} with {on.part} has only {', '.join(on.top)}")
    return host


def part_of(module: str) -> str:
    """The part of a top, or of a carrier."""
    return PART_OF.get(module) or module.removesuffix("_carrier")


def sources(top: str) -> list[Path]:
    """The sources of a board top in compile order, the declarations of the vendors' cells first."""
    own = project.files(f"{table.part(part_of(top)).rtl}_carrier", "panel")
    on_board = project.listed()["boards"].files
    text = "".join(path.read_text(encoding="utf-8") for path in on_board if path.stem == top)
    files = [path for path in on_board if re.search(rf"^(?:module| ) {path.stem} ", text, re.M)]
    return [VENDOR_CELLS, *own, *files]


def parameters(top: str) -> set[str]:
    """Names of the parameters of a board top."""
    return set(parameters_of(next(path for path in project.files("boards") if path.stem == top)))


def check_parameters(on: Board, host: str, names: Iterable[str]) -> None:
    """ProjectError if the top of a board has not all parameters of these names."""
    known = parameters(on.top[host]) - {"HOST"}
    for name in names:
        if name not in known:
            raise ProjectError(
                f"{name}: {on.name} with {on.part} has no such parameter (it has {', '.join(sorted(known))})"
            )


def synthesize_board(on: Board, host: str, params: dict[str, int | str] | None = None) -> Path:
    """Mapped netlist of a board's top with `params` as its parameters; ProjectError with yosys' errors."""
    top = on.top[host]
    given = dict(params or {})
    if "HOST" in parameters(top):
        given["HOST"] = host.upper()
    job = {
        "top": top,
        "include": [project.relative(path) for path in project.include_dirs()],
        "sources": [project.relative(path) for path in sources(top)],
        "params": given,
        "family": on.family,
        "recipe": on.recipe or BEST[on.family],
        "keep": False,
    }
    return run_yosys(on.folder(host), job)


def route_board(on: Board, host: str, netlist: Path, seed: int) -> dict:
    """Place and route with one seed: the figures of `build_board` without `file`. Timing may be missed."""
    constraints = [CONSTRAINTS / on.constraints[host]]
    used = board_route.route(on, netlist, on.folder(host), constraints, seed)
    clk = min(used.clocks.values(), default=0.0)
    return {
        "board": on.name,
        "title": on.title,
        "host": host,
        "part": on.part,
        "device": on.device,
        "lut": used.lut[0],
        "lut_total": used.lut[1],
        "lut_name": board_route.LUT_NAME[on.family],
        "ff": board_route.flip_flops(netlist, on.top[host]),
        "ram": used.ram[0],
        "ram_total": used.ram[1],
        "fmax": clk,
        "clocks": used.clocks,
        "clk_hz": on.clk_hz,
        "goal_mhz": on.goal_mhz,
        "seed": seed,
    }


def met(figures: dict) -> bool:
    """Whether a run reached the clock that the top runs with (which is not below the goal)."""
    return figures["fmax"] >= figures["clk_hz"] / 1e6


def build_board(
    name: str,
    host: str,
    seed: int | None = None,
    params: dict[str, int | str] | None = None,
    notify: Callable[[str], None] = lambda text: None,
    part: str = "ppmc104",
) -> dict:
    """Bitstream and report.json of a board in build/boards/; returns the report.

    With `seed` None the seeds 1 to SEEDS are tried until timing is met. ProjectError when it is not, or when
    a tool fails. `notify` is told what is being done.
    """
    on = board(name, part)
    check_host(on, host)
    check_parameters(on, host, params or {})
    folder = on.folder(host)
    folder.mkdir(parents=True, exist_ok=True)
    on.file(host).unlink(missing_ok=True)
    (folder / "report.json").unlink(missing_ok=True)
    notify("synthesis")
    netlist = synthesize_board(on, host, params)
    seen = []
    for number in range(1, SEEDS + 1) if seed is None else [seed]:
        notify(f"place and route, seed {number}")
        figures = route_board(on, host, netlist, number)
        if met(figures):
            break
        seen.append(f"{figures['fmax']:.1f} MHz with seed {number}")
    else:
        raise ProjectError(
            f"{name}: timing missed, {on.clk_hz / 1e6:g} MHz needed: {', '.join(seen)}. "
            f"Try another seed, such as SEED={(seed or SEEDS) + 1}"
        )
    notify("bitstream")
    board_route.pack(on, folder, on.file(host))
    figures |= {
        "file": project.relative(on.file(host)),
        "bytes": on.file(host).stat().st_size,
        "params": params or {},
    }
    (folder / "report.json").write_text(json.dumps(figures, indent=1) + "\n")
    return figures
