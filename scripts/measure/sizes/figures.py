"""docs/sizes.json: size and clock rate of every design, with the digest of the RTL that was measured.

The file maps the key of a design to {"lut", "ff", "ram", "comb" (ECP5), "mhz" (rated designs), "of"}. LUT, FF
and block RAM are counted after synthesis; COMB is the number of logic cells that nextpnr packs. "mhz" has a
value for each of TURNS perturbations of the synthesis × SEEDS seeds; it is empty before the measurement.
"""

from __future__ import annotations

import json
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from cocotb_tests.harness.project import DOCS, ProjectError, relative
from scripts.measure.sizes.designs import SEEDS, TURNS, Design, all_designs

Figures = dict[str, dict[str, Any]]

FILE = DOCS / "sizes.json"
COUNTS = {"lut": "LUT", "ff": "FF", "ram": "block RAM"}
LIMIT = 5
"""Largest growth of a count, in per cent, that `make size` accepts."""
RUNS = TURNS * SEEDS
PEER = "peer "
"""Beginning of the keys of designs whose sources are not in this tree."""


@dataclass
class Comparison:
    """Result of a comparison. A line in `wrong` makes the check fail, a line in `smaller` does not."""

    wrong: list[str] = field(default_factory=list)
    smaller: list[str] = field(default_factory=list)


def _is_valid(entry: object) -> bool:
    if not isinstance(entry, dict) or not isinstance(entry.get("of"), str):
        return False
    counts = [entry.get(name, 0 if name == "comb" else None) for name in (*COUNTS, "comb")]
    rates = entry.get("mhz", [])
    return all(type(n) is int and n >= 0 for n in counts) and (
        isinstance(rates, list) and all(type(rate) in (int, float) for rate in rates)
    )


def read(path: Path = FILE) -> Figures:
    """Return the committed figures; raise ProjectError if the file is missing or has another form."""
    where = relative(path)
    try:
        data = json.loads(path.read_text(encoding="utf-8"))
    except FileNotFoundError:
        raise ProjectError(f"{where}: file is missing; run `make report`") from None
    except ValueError as error:
        raise ProjectError(f"{where}: not JSON ({error}); restore it or run `make report`") from None
    if not isinstance(data, dict) or not all(map(_is_valid, data.values())):
        raise ProjectError(
            f"{where}: not a table of {', '.join(COUNTS)}, comb, mhz, of; restore it or run `make report`"
        )
    return data


def write(figures: Figures, path: Path = FILE) -> None:
    """Write the file, sorted, one design a line."""
    rows = [f"  {json.dumps(key)}: {json.dumps(figures[key], sort_keys=True)}" for key in sorted(figures)]
    path.write_text("{\n" + ",\n".join(rows) + "\n}\n", encoding="utf-8")


def compare(committed: Figures, now: Figures, limit: int = LIMIT) -> Comparison:
    """Compare counts. A growth above `limit` per cent is wrong, and so is a design without figures."""
    found = Comparison()
    for key, new in sorted(now.items()):
        old = committed.get(key)
        if old is None:
            found.wrong.append(f"{key}: no committed figures")
            continue
        for name, title in COUNTS.items():
            change = f"{key}: {title} {old[name]} -> {new[name]}"
            if old[name]:
                change += f" ({100 * (new[name] - old[name]) / old[name]:+.1f} %)"
            # Use integer arithmetic, so that a growth of exactly the limit passes.
            if 100 * new[name] > (100 + limit) * old[name]:
                found.wrong.append(f"{change}, more than {limit} % larger")
            elif 100 * new[name] < (100 - limit) * old[name]:
                found.smaller.append(f"{change}, more than {limit} % smaller")
    return found


def stale(figures: Figures, designs: Iterable[Design] | None = None) -> list[str]:
    """Return a line for each design that has no figures, has figures of other RTL, or no longer exists."""
    where, remedy = relative(FILE), "run `make report` and `make docs`"
    lines, keys = [], set()
    for design in all_designs() if designs is None else designs:
        keys.add(design.key)
        entry = figures.get(design.key)
        if entry is None:
            lines.append(f"{where}: {design.key} has no figures; {remedy}")
        elif entry["of"] != design.digest():
            lines.append(f"{where}: {design.key} was measured with other RTL; {remedy}")
    gone = sorted(key for key in figures if key not in keys and not key.startswith(PEER))
    return lines + [f"{where}: {key} does not exist any more; {remedy}" for key in gone]


def rate(entry: dict[str, Any] | None) -> tuple[float, float] | None:
    """Return median and lowest clock rate in MHz, or None if not every run was made."""
    rates = sorted(entry.get("mhz", ())) if entry else []
    return (rates[len(rates) // 2], rates[0]) if len(rates) >= RUNS else None


def rate_text(entry: dict[str, Any] | None) -> str:
    """Return the clock rate as "median (lowest)", or a dash if it was not measured."""
    found = rate(entry)
    return f"{found[0]:.0f} ({found[1]:.0f})" if found else "–"
