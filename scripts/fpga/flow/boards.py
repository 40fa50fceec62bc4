"""The steps that build the bitstream file of a board from its top."""

from __future__ import annotations

import hashlib
import json
import re
import subprocess
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import Any

from cocotb_tests.harness import project
from cocotb_tests.harness.header import parameters as parameters_of
from cocotb_tests.harness.project import ProjectError
from openppmc import __version__
from openppmc import parts as table
from openppmc import sources as sources_of
from scripts.fpga.flow import board_route
from scripts.fpga.flow.board_table import (
    BOARDS,
    BY_PART,
    HOSTS,
    HOSTS_OF,
    PART_OF,
    Board,
    board,
    check_host,
    part_of,
)
from scripts.fpga.flow.netlist import counts
from scripts.fpga.flow.synthesis import run_yosys
from scripts.fpga.flow.yosys_job import BEST

SEEDS = 8  # number of seeds that are tried until the clock rate is reached
VENDOR_CELLS = project.ROOT / "lint" / "vendor_cells.sv"
CONSTRAINTS = project.ROOT / "constraints"

__all__ = ["BOARDS", "BY_PART", "HOSTS", "HOSTS_OF", "PART_OF", "Board", "board", "build_board"]
__all__ += ["check_host", "part_of"]


def sources(top: str) -> list[Path]:
    """Return the sources of a board top in compile order; declarations of vendor cells are first."""
    own = project.files(f"{table.part(part_of(top)).rtl}_carrier", "leds")
    on_board = project.listed()["boards"].files
    text = "".join(path.read_text(encoding="utf-8") for path in on_board if path.stem == top)
    files = [path for path in on_board if re.search(rf"^(?:module| ) {path.stem} ", text, re.M)]
    return [VENDOR_CELLS, *own, *files]


def parameters(top: str) -> set[str]:
    """Return the names of the parameters of a board top."""
    return set(parameters_of(next(path for path in project.files("boards") if path.stem == top)))


def check_parameters(on: Board, host: str, names: Iterable[str]) -> None:
    """Raise ProjectError if the board top does not have a parameter with each of these names."""
    known = parameters(on.top[host]) - {"HOST"}
    for name in names:
        if name not in known:
            raise ProjectError(
                f"{name}: {on.name} with {on.part} has no such parameter (it has {', '.join(sorted(known))})"
            )


def build_id(on: Board) -> bytes:
    """Return the build ID that the bitstream reports (UB-VER-01)."""
    source = sources_of.digest(project.ROOT, f"{table.part(on.part).rtl}_carrier")
    commit, changed = git_state()
    return sources_of.build_id(__version__, source, commit, changed, on.code)


def git_state() -> tuple[bytes, bool]:
    """Return the commit of the checkout (b"" without git), and whether there are uncommitted changes."""
    words = {"commit": ["rev-parse", "HEAD"], "changes": ["status", "--porcelain"]}
    fields = {}
    for name, arguments in words.items():
        try:
            done = subprocess.run(
                ["git", *arguments], cwd=project.ROOT, capture_output=True, text=True, check=False
            )
        except FileNotFoundError:
            return b"", False
        if done.returncode:
            return b"", False
        fields[name] = done.stdout.strip()
    return bytes.fromhex(fields["commit"]), bool(fields["changes"])


def board_job(on: Board, host: str, params: Mapping[str, int | str] | None = None) -> dict[str, Any]:
    """Return the yosys job of a board's top with `params`, without family and recipe."""
    top = on.top[host]
    given = dict(params or {})
    if "HOST" in parameters(top):
        given["HOST"] = host.upper()
    return {
        "top": top,
        "include": [project.relative(path) for path in project.include_dirs()],
        "sources": [project.relative(path) for path in sources(top)],
        "params": given,
    }


def inputs_digest(on: Board, host: str, params: Mapping[str, int | str] | None = None) -> str:
    """Return the digest of sources, constraints and parameters of a bitstream, without its build ID."""
    job = board_job(on, host, params)
    files = [*(project.ROOT / name for name in job["sources"]), CONSTRAINTS / on.constraints[host]]
    files += [path for folder in job["include"] for path in sorted((project.ROOT / folder).glob("*.svh"))]
    sha = hashlib.sha256(repr((sorted(job["params"].items()), on.recipe or BEST[on.family])).encode())
    for path in files:
        sha.update(path.read_bytes())
    return sha.hexdigest()[:16]


def synthesize_board(
    on: Board, host: str, params: dict[str, int | str] | None = None, known: bool = False
) -> Path:
    """Return the mapped netlist of a board's top with `params`; raise ProjectError with yosys' errors.

    Args:
        known: True if the bitstream returns its build ID (UB-VER-01). Sizes are measured without it.
    """
    job = board_job(on, host, params)
    job["defines"] = [sources_of.build_define(build_id(on))] if known else []
    job |= {"family": on.family, "recipe": on.recipe or BEST[on.family], "keep": False}
    return run_yosys(on.folder(host), job)


def route_board(on: Board, host: str, netlist: Path, seed: int) -> dict:
    """Place and route with one seed; return the report without `file`. Missed timing is not an error."""
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
        "ff": counts(netlist, on.top[host])["ff"],
        "ram": used.ram[0],
        "ram_total": used.ram[1],
        "fmax": clk,
        "clocks": used.clocks,
        "clk_hz": on.clk_hz,
        "goal_mhz": on.goal_mhz,
        "seed": seed,
    }


def met(figures: dict) -> bool:
    """Return whether a run has reached the clock rate of the top, which is never below the goal."""
    return figures["fmax"] >= figures["clk_hz"] / 1e6


def build_board(
    name: str,
    host: str,
    seed: int | None = None,
    params: dict[str, int | str] | None = None,
    notify: Callable[[str], None] = lambda text: None,
    part: str = "ppmc104",
) -> dict:
    """Build the bitstream and report.json of a board in build/boards/; return the report.

    If `seed` is None, the seeds 1 to SEEDS are tried until timing is met. ProjectError is raised if timing is
    not met or a tool fails. `notify` is called with the current step.
    """
    return build_on(board(name, part), host, seed, params, notify)


def build_on(
    on: Board,
    host: str,
    seed: int | None = None,
    params: dict[str, int | str] | None = None,
    notify: Callable[[str], None] = lambda text: None,
) -> dict:
    """Build the bitstream of a row of the table of boards as `build_board` does; return the report."""
    check_host(on, host)
    check_parameters(on, host, params or {})
    folder = on.folder(host)
    folder.mkdir(parents=True, exist_ok=True)
    on.file(host).unlink(missing_ok=True)
    (folder / "report.json").unlink(missing_ok=True)
    notify("synthesis")
    netlist = synthesize_board(on, host, params, known=True)
    seen = []
    for number in range(1, SEEDS + 1) if seed is None else [seed]:
        notify(f"place and route, seed {number}")
        figures = route_board(on, host, netlist, number)
        if met(figures):
            break
        seen.append(f"{figures['fmax']:.1f} MHz with seed {number}")
    else:
        raise ProjectError(
            f"{on.name}: timing missed, {on.clk_hz / 1e6:g} MHz needed: {', '.join(seen)}. "
            f"Try another seed, such as SEED={(seed or SEEDS) + 1}"
        )
    notify("bitstream")
    board_route.pack(on, folder, on.file(host))
    figures |= {
        "file": project.relative(on.file(host)),
        "bytes": on.file(host).stat().st_size,
        "params": params or {},
        "inputs": inputs_digest(on, host, params),
    }
    (folder / "report.json").write_text(json.dumps(figures, indent=1) + "\n")
    return figures
