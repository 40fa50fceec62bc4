"""One design with one recipe on an ECP5-25F: cells as nextpnr packs them, and the clock rate of each seed.

The same measure for whatever stands side by side: all pins of a design go behind shift registers, which are
not counted.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from cocotb_tests.harness import project
from cocotb_tests.harness.project import console
from openppmc.parts import Row

from . import pnr
from .netlist import flat_counts
from .synthesis import SEEDS, run_yosys, wrapped_netlist
from .yosys_job import BEST

ECP5 = pnr.DEVICES[0]
RECIPES = {"plain": "default", "tuned": BEST["ecp5"]}
"""Name in tables -> recipe: `synth_ecp5` as it is, and the one that this project tuned."""


@dataclass(frozen=True)
class Design:
    """What is measured. job: for yosys, without family and recipe; wiring: how the wrapper connects it."""

    job: Mapping[str, Any]
    wiring: Mapping[str, str] = field(default_factory=dict)

    @classmethod
    def of_part(cls, row: Row, params: Mapping[str, int | str] | None = None) -> Design:
        """A part of the table."""
        include = [project.relative(path) for path in project.include_dirs()]
        sources = [project.relative(path) for path in project.sources(row)]
        return cls({"top": row.top, "include": include, "sources": sources, "params": dict(params or {})})

    def digest(self, recipe: str) -> str:
        """Changes with the sources, the parameters and the recipe."""
        seen = hashlib.sha256(json.dumps([self.job, self.wiring, recipe], sort_keys=True).encode())
        for source in self.job["sources"]:
            seen.update((project.ROOT / source).read_bytes())
        return seen.hexdigest()[:16]

    def _job(self, recipe: str) -> dict[str, Any]:
        return {**self.job, "family": "ecp5", "recipe": RECIPES[recipe], "keep": False}

    def size(self, recipe: str, folder: Path) -> dict[str, int]:
        """COMB as nextpnr packs it, FF, block RAM."""
        netlist = run_yosys(folder, self._job(recipe))
        total = flat_counts(netlist, self.job["top"], set())[0]
        return {
            "comb": pnr.packed(ECP5, netlist, folder)["TRELLIS_COMB"],
            "ff": total.ff,
            "ram": total.ram,
        }

    def rate(self, recipe: str, seed: int, folder: Path) -> float:
        """Fmax of `clk` in MHz with a seed; `size` has been called with this folder."""
        wrapped = folder / "wrapped" / f"ecp5-{RECIPES[recipe]}.json"
        netlist = folder / wrapped.name
        if not wrapped.is_file() or wrapped.stat().st_mtime < netlist.stat().st_mtime:
            wrapped_netlist(folder, self._job(recipe), netlist, RECIPES[recipe], "ecp5", **self.wiring)
        return pnr.place_and_route(ECP5, wrapped, folder / "pnr", seed).fmax


def middle(rates: list[float]) -> float:
    """Median, the lower one of two in the middle."""
    return sorted(rates)[(len(rates) - 1) // 2]


def in_words(rates: list[float]) -> str:
    """The median, with the number of seeds in brackets if it is not SEEDS."""
    if not rates:
        return "–"
    return f"{middle(rates):.0f}" + ("" if len(rates) == SEEDS else f" ({len(rates)})")


def measure(
    designs: Mapping[str, Design], seeds: Mapping[str, int], file: Path, folder: Path
) -> dict[str, Any]:
    """The figures of each design with both recipes, sizes first, then as many seeds as it asks for, in turn.

    They are kept in `file` ("name recipe" -> figures), each as soon as it is there, so that a run that was
    broken off goes on, and measured again only if the sources of the design have changed. What else is in
    `file` stays.
    """
    found: dict[str, Any] = json.loads(file.read_text(encoding="utf-8")) if file.is_file() else {}
    todo = [(name, recipe) for name in designs for recipe in RECIPES]

    def keep(line: str) -> None:
        file.write_text(json.dumps(found, indent=1, sort_keys=True) + "\n", encoding="utf-8")
        console.print(line, markup=False)

    for name, recipe in todo:
        key, digest, place = f"{name} {recipe}", designs[name].digest(recipe), folder / f"{name}-{recipe}"
        same = found.get(key, {}).get("of") == digest
        # Without its netlist no further seed can be placed.
        if not same or (len(found[key]["mhz"]) < seeds[name] and not place.is_dir()):
            size = designs[name].size(recipe, place)
            found[key] = {**size, "mhz": found[key]["mhz"] if same else [], "of": digest}
            keep(f"{key}: {size['comb']} COMB, {size['ff']} FF, {size['ram']} RAM")
    for seed in range(1, max(seeds.values(), default=0) + 1):
        for name, recipe in todo:
            key = f"{name} {recipe}"
            if len(found[key]["mhz"]) < seed <= seeds[name]:
                found[key]["mhz"].append(designs[name].rate(recipe, seed, folder / f"{name}-{recipe}"))
                keep(f"{key}, seed {seed}: {found[key]['mhz'][-1]:.1f} MHz")
    return found
