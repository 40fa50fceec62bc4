"""The designs in docs/sizes.json: parts, banks, carriers, bridges, bitstreams, other open designs.

The size of a design is counted in the netlist that its recipe makes. The clock rate of a part is measured
with every pin connected to a shift register that is not counted. The clock rate of a bitstream is not
measured: `make bitstream` fails if it is lower than the clock rate of the board.
"""

from __future__ import annotations

import hashlib
import json
import re
import shutil
import threading
from collections import defaultdict
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from cocotb_tests.harness import project
from openppmc import parts
from scripts.fpga.flow import boards, pnr
from scripts.fpga.flow.netlist import counts
from scripts.fpga.flow.synthesis import FAMILIES, run_yosys
from scripts.fpga.flow.yosys_job import BEST, recipe_text
from scripts.measure.sizes import scan_wrapper
from scripts.measure.sizes.peers import Peer

RECIPES = ("plain", "tuned")
"""Recipes for parts on an ECP5: `synth_ecp5` without options, and the recipe of the bitstreams."""
TURNS, SEEDS = 3, 5
"""Numbers of perturbations of the synthesis, and of seeds of place and route, for each clock rate."""
AXES = {"ppmc2104": 2, "isa_4axis": 4}
"""Number of axes of parts with more than one axis. For a bank, the number is in the name of the design."""
BANKS = (4, 8, 16, 32, 64)
BANK_CLK_HZ = 100_000_000
BRIDGES: tuple[tuple[str, str, dict[str, int], tuple[str, ...]], ...] = (
    ("ppmc_wishbone", "Wishbone B4 with its strobe master", {}, FAMILIES),
    ("ppmc_axil", "AXI4-Lite with its strobe master", {}, FAMILIES),
    ("ppmc_uart_bridge", "UART with receiver, transmitter and strobe master", {}, FAMILIES),
    ("ppmc_char_host", "character host: UART without scripts", {}, FAMILIES),
    ("ppmc_recorder", "recorder of a PPMC-104, RECORD=9", {"Width": 49, "AddrBits": 9}, FAMILIES),
    ("ppmc_recorder", "recorder of a PPMC-104, RECORD=12", {"Width": 49, "AddrBits": 12}, ("ecp5",)),
    ("ppmc_recorder", "RECORD=14 in the 4 SPRAM of a UP5K", {"Width": 49, "AddrBits": 14}, ("ice40",)),
    (
        "ppmc_recorder",
        "recorder of a PPMC-2104 or PPMC-312, RECORD=11",
        {"Width": 63, "AddrBits": 11},
        ("ecp5",),
    ),
)
"""Module, description, parameters and FPGA families of a design."""
HOST = "uart"
"""Host interface of the bitstreams that are measured."""
FOLDER = project.BUILD / "sizes"
# The seeds of one perturbation share its netlist, and two seeds may run at the same time.
_LOCKS: dict[tuple[str, int], threading.Lock] = defaultdict(threading.Lock)


@dataclass(frozen=True)
class Design:
    """A design that is measured with one family and one recipe.

    Attributes:
        name: name in docs/sizes.json.
        part: part that the design contains, "" for a bridge or a peer.
        job: the yosys job without family and recipe.
        wiring: how `scan_wrapper.source` connects the pins.
        rated: True if the clock rate of the design is measured.
    """

    name: str
    family: str
    recipe: str
    part: str = ""
    job: Mapping[str, Any] = field(default_factory=dict)
    wiring: Mapping[str, str] = field(default_factory=dict)
    board: boards.Board | None = None
    rated: bool = False
    axes: int = 1
    title: str = ""

    @property
    def key(self) -> str:
        """Key in docs/sizes.json."""
        return f"{self.name} {self.family} {self.recipe}"

    @property
    def folder(self) -> Path:
        """Folder of the design's netlists."""
        return FOLDER / re.sub(r"[^\w.-]+", "-", self.key)

    def _job(self, turn: int) -> dict[str, Any]:
        recipe = "default" if self.recipe == "plain" else BEST[self.family]
        if self.board and self.board.recipe:
            recipe = self.board.recipe
        return {**self.job, "family": self.family, "recipe": recipe, "keep": False, "turn": turn}

    def digest(self) -> str:
        """Return the digest of code, parameters, constraints and recipe; comments do not change it."""
        job = self._job(0)
        words = {name: job[name] for name in ("top", "params")} | {
            "recipe": recipe_text(job["family"], job["recipe"])
        }
        seen = hashlib.sha256(json.dumps([words, dict(self.wiring)], sort_keys=True).encode())
        files = [project.ROOT / source for source in job["sources"]]
        files += sorted(path for name in job["include"] for path in (project.ROOT / name).glob("*.svh"))
        if self.board:
            files.append(boards.CONSTRAINTS / self.board.constraints[HOST])
        for path in files:
            seen.update(code(path).encode())
        return seen.hexdigest()[:16]

    def netlist(self, turn: int = 0) -> Path:
        """Synthesise the design with a perturbation (0: the unchanged recipe); return the netlist."""
        return run_yosys(self.folder / f"turn-{turn}", self._job(turn))

    def size(self) -> dict[str, int]:
        """Return LUT, FF and block RAM after synthesis; on an ECP5 also COMB after packing by nextpnr."""
        netlist = self.netlist()
        found = counts(netlist, self.job["top"])
        if self.family == "ecp5":
            found["comb"] = pnr.packed(netlist, netlist.parent)["TRELLIS_COMB"]
        return found

    def rate(self, turn: int, seed: int) -> float:
        """Return Fmax of `clk` in MHz with a perturbation of the synthesis and a seed of place and route."""
        folder = self.folder / f"turn-{turn}" / f"seed-{seed}"
        folder.mkdir(parents=True, exist_ok=True)
        return pnr.place_and_route(self._kept(turn), folder, seed)

    def _wrapped(self) -> dict[str, Any]:
        """Return the job of the design with all pins connected to shift registers."""
        wrapper = self.folder / f"{scan_wrapper.NAME}.sv"
        with _LOCKS[self.key, -1]:
            text = scan_wrapper.source(self._ports(), self.job["top"], self.job["params"], **self.wiring)
            wrapper.write_text(text, encoding="utf-8")
        sources = [*self.job["sources"], project.relative(wrapper)]
        return {**self.job, "top": scan_wrapper.NAME, "sources": sources, "params": {}}

    def _ports(self) -> Path:
        """Return a netlist that has the ports of the design."""
        made = self.folder / "turn-0" / f"{self.family}-{self._job(0)['recipe']}.json"
        return made if made.is_file() else self.netlist()

    def _kept(self, turn: int) -> Path:
        """Return the stored netlist of a perturbation, which all its seeds use."""
        folder = self.folder / f"turn-{turn}" / "routed"
        work = self._job(turn) | self._wrapped()
        file = folder / f"{work['family']}-{work['recipe']}.json"
        mark = folder / self.digest()
        with _LOCKS[self.key, turn]:
            if not mark.is_file():
                shutil.rmtree(folder, ignore_errors=True)
                run_yosys(folder, work)
                mark.touch()
        return file


def code(path: Path) -> str:
    """Return a source without comments and with single spaces. In constraints, comments begin with #."""
    comment = r"/\*.*?\*/|//[^\n]*" if path.suffix in (".sv", ".svh", ".v") else r"(#|//)[^\n]*"
    text = re.sub(comment, " ", path.read_text(encoding="utf-8", errors="replace"), flags=re.DOTALL)
    return " ".join(text.split())


def _job(top: str, sources: list[Path], params: Mapping[str, int | str]) -> dict[str, Any]:
    include = [project.relative(path) for path in project.include_dirs()]
    return {
        "top": top,
        "include": include,
        "sources": [project.relative(path) for path in sources],
        "params": dict(params),
    }


def of_parts() -> list[Design]:
    """Return each part with its default parameters, and the banks by their number of axes."""
    found = []
    for row in parts.tops():
        if row.name == "bank":
            continue
        job = _job(row.top, project.sources(row), {})
        axes = AXES.get(row.name, 1)
        found += [Design(row.name, "ecp5", r, row.name, job, rated=True, axes=axes) for r in RECIPES]
        found += [Design(row.name, f, "tuned", row.name, job, axes=axes) for f in row.families if f != "ecp5"]
    bank = parts.part("bank")
    for axes in BANKS:
        job = _job(bank.top, project.sources(bank), {"AXES": axes, "CLK_HZ": BANK_CLK_HZ})
        # The clock rate of a bank is not measured: for one bank, this takes an hour.
        found += [
            Design(f"bank {axes}", "ecp5", r, "bank", job, rated=axes == 32, axes=axes) for r in RECIPES
        ]
    return found


def of_carriers() -> list[Design]:
    """Return each part with its host bridge, without an FPGA board."""
    found = []
    for row in parts.having("carrier"):
        top = f"{row.rtl}_carrier"
        params = {"HOST": HOST.upper()} if "HOST" in boards.parameters(top) else {}
        sources = [*project.sources(parts.part(row.name)), *project.board_files(row.name)]
        families = project.part(row.name).families
        found += [Design(top, family, "tuned", row.name, _job(top, sources, params)) for family in families]
    return found


def of_bridges() -> list[Design]:
    """Return the designs in BRIDGES, for each of their FPGA families."""
    found = []
    for top, title, params, families in BRIDGES:
        job = _job(top, list(project.files("char_host" if top == "ppmc_char_host" else "host")), params)
        name = " ".join([top, *map(str, params.values())])
        found += [Design(name, family, "tuned", job=job, title=title) for family in families]
    return found


def of_boards() -> list[Design]:
    """Return the bitstream of each board with each part and the UART host."""
    found = []
    for part, known in boards.BY_PART.items():
        for on in known.values():
            job = boards.board_job(on, HOST)
            name = f"{on.stem(HOST)} bitstream"
            found.append(Design(name, on.family, "tuned", part, job, board=on, title=on.device))
    return found


def of_peers(folder: Path, peers: list[Peer]) -> list[Design]:
    """Return the designs in a folder that contains peers.json."""
    found = []
    for peer in peers:
        job = {"top": peer.top, "include": [], "sources": peer.files(folder), "params": peer.params}
        wiring = {"reset": peer.reset, "pins_like": peer.pins}
        found += [Design(f"peer {peer.title}", "ecp5", r, "", job, wiring, rated=True) for r in RECIPES]
    return found


def all_designs() -> list[Design]:
    """Return every design whose RTL is in this tree."""
    return [*of_parts(), *of_carriers(), *of_bridges(), *of_boards()]
