"""The boards that `make bitstream` knows, and the way from their tops to a bitstream file."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from pathlib import Path

from cocotb_tests.harness import project
from cocotb_tests.harness.header import parameters as parameters_of
from cocotb_tests.harness.project import ProjectError

from . import board_route
from .synthesis import run_yosys
from .yosys_job import BEST

SEEDS = 5  # tried one after the other until the clock rate is met
HOSTS = ("uart", "bus")
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


def both(text: str) -> dict[str, str]:
    """The same for both hosts."""
    return dict.fromkeys(HOSTS, text)


def ulx3s(size: str) -> Board:
    """A ULX3S with an LFE5U of `size` thousand LUTs."""
    return Board(
        name=f"ulx3s-{size}f",
        title=f"ULX3S-{size}F",
        device=f"LFE5U-{size}F-6CABGA381",
        family="ecp5",
        top=both("board_ulx3s"),
        constraints=both("ulx3s.lpf"),
        oscillator=("clk_25m", 25),
        clk_hz=100_000_000,
        goal_mhz=100,
        suffix=".bit",
        loader="ulx3s",
        route=(f"--{size}k", "--package", "CABGA381", "--speed", "6"),
    )


BOARDS = {
    board.name: board
    for board in (
        Board(
            name="icebreaker",
            title="iCEBreaker",
            device="iCE40UP5K-SG48",
            family="ice40",
            top={"uart": "board_icebreaker", "bus": "board_icebreaker_bus"},
            constraints={"uart": "icebreaker.pcf", "bus": "icebreaker-bus.pcf"},
            oscillator=("clk_12m", 12),
            clk_hz=24_000_000,
            goal_mhz=24,
            suffix=".bin",
            loader="ice40_generic",
            route=("--up5k", "--package", "sg48"),
        ),
        ulx3s("25"),
        ulx3s("85"),
        Board(
            name="tangnano9k",
            title="Tang Nano 9K",
            device="GW1NR-LV9QN88PC6/I5",
            family="gowin",
            top=both("board_tangnano9k"),
            constraints=both("tangnano9k.cst"),
            oscillator=("clk_27m", 27),
            clk_hz=54_000_000,
            goal_mhz=50,
            suffix=".fs",
            loader="tangnano9k",
            route=("--device", "GW1NR-LV9QN88PC6/I5", "--vopt", "family=GW1N-9C"),
            chip="GW1N-9C",
        ),
    )
}


def carrying(part: str, on: str, hosts: tuple[str, ...] = HOSTS) -> Board:
    """The board of this name with another part than a PPMC-104, for these hosts."""
    ppmc104 = BOARDS[on]
    family = on.split("-")[0]
    suffix = Path(ppmc104.constraints["uart"]).suffix
    return replace(
        ppmc104,
        top=dict.fromkeys(hosts, f"board_{family}_{part.replace('-', '_')}"),
        constraints=dict.fromkeys(hosts, f"{family}-{part}{suffix}"),
        part=part,
    )


def with_part(part: str) -> dict[str, Board]:
    """The boards that carry this part besides the PPMC-104."""
    boards = (
        carrying(part, "icebreaker", ("uart",)),
        carrying(part, "ulx3s-25f"),
        carrying(part, "ulx3s-85f"),
    )
    return {board.name: board for board in boards}


TANGNANO20K = Board(
    name="tangnano20k",
    title="Tang Nano 20K",
    device="GW2AR-LV18QN88C8/I7",
    family="gowin",
    top={"uart": "board_tangnano20k_ppmc312"},
    constraints={"uart": "tangnano20k-ppmc312.cst"},
    oscillator=("clk_27m", 27),
    clk_hz=54_000_000,
    goal_mhz=50,
    suffix=".fs",
    loader="tangnano20k",
    route=("--device", "GW2AR-LV18QN88C8/I7", "--vopt", "family=GW2A-18C"),
    part="ppmc312",
    chip="GW2A-18C",
    seeds=1,
)


def with_ppmc312() -> dict[str, Board]:
    """The boards that carry a PPMC-312: it is too large for an iCE40 and a Tang Nano 9K."""
    boards = (
        replace(carrying("ppmc312", name), clk_hz=50_000_000, goal_mhz=50, seeds=3)
        for name in ("ulx3s-25f", "ulx3s-85f")
    )
    return {board.name: board for board in (*boards, TANGNANO20K)}


def with_ppmc312_serial() -> dict[str, Board]:
    """The boards that carry a PPMC-312 in serial mode. Its host is a serial line: there is no bus."""
    part, hosts = "ppmc312-serial", ("uart",)
    larger = (
        replace(carrying(part, on.name, hosts), clk_hz=on.clk_hz, goal_mhz=on.goal_mhz, seeds=on.seeds)
        for on in with_ppmc312().values()
        if on.name in BOARDS
    )
    nano = replace(
        TANGNANO20K,
        top={"uart": "board_tangnano20k_ppmc312_serial"},
        constraints={"uart": "tangnano20k-ppmc312-serial.cst"},
        part=part,
        recipe="default",  # abc9 fails with flow2: "Boxes are not in a topological order"
    )
    return {board.name: board for board in (*larger, nano)}


def with_pmc006() -> dict[str, Board]:
    """The boards that carry a PMC006B4. Its host is a serial line: there is no bus."""
    larger = (
        replace(carrying("pmc006", name, ("uart",)), clk_hz=50_000_000, goal_mhz=50)
        for name in ("ulx3s-25f", "ulx3s-85f")
    )
    # The UP5K reaches 22 to 26 MHz with it.
    small = replace(carrying("pmc006", "icebreaker", ("uart",)), clk_hz=18_000_000, goal_mhz=18)
    boards = (small, *larger)
    return {board.name: board for board in boards}


BY_PART = {
    "ppmc104": BOARDS,
    "ppmc2104": with_part("ppmc2104"),
    "stmc": with_part("stmc"),
    "ppmc312": with_ppmc312(),
    "ppmc312-serial": with_ppmc312_serial(),
    "pmc006": with_pmc006(),
}


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


def part_of(top: str) -> str:
    """The part of a top in rtl/boards: the longest one that its name has, else ppmc104."""
    return max((part for part in BY_PART if part.replace("-", "_") in top), key=len, default="ppmc104")


def sources(top: str) -> list[Path]:
    """The sources of a board top in compile order, the declarations of the vendors' cells first."""
    part = part_of(top).split("-")[0]  # its RTL; what follows is a mode of it
    other = tuple(f"{name}_" for name in BY_PART if name != part)
    own = project.files(f"{part}_carrier", "panel")
    on_board = project.listed()["boards"].files
    files = [path for path in on_board if not path.stem.startswith(("board_", *other)) or path.stem == top]
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
