"""docs/sizes.json: the committed sizes, and what a comparison with new ones says.

The file maps design -> family -> {"ff", "lut", "ram"}, all as synthesized (before place and route).
"""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from pathlib import Path

from cocotb_tests.harness.project import DOCS, ProjectError, relative

Sizes = dict[str, dict[str, dict[str, int]]]

FILE = DOCS / "sizes.json"
FIGURES = {"lut": "LUT", "ff": "FF", "ram": "block RAM"}
LIMIT = 5  # per cent
ACCEPT = "`make report` accepts the new sizes (it writes docs/sizes.json, which is committed)"


@dataclass
class Verdict:
    """Lines about figures: `wrong` fail the check, `smaller` do not."""

    wrong: list[str] = field(default_factory=list)
    smaller: list[str] = field(default_factory=list)


def read(path: Path = FILE) -> Sizes:
    """The committed sizes; ProjectError if the file is missing or is not of its form."""
    where = relative(path)
    try:
        data = json.loads(path.read_text(encoding="utf-8"))
    except FileNotFoundError:
        raise ProjectError(f"{where} is missing: `make report` writes it") from None
    except ValueError as error:
        raise ProjectError(f"{where} is not JSON ({error}): restore it, or `make report`") from None
    try:
        good = all(
            sorted(figures) == sorted(FIGURES) and all(type(n) is int and n >= 0 for n in figures.values())
            for families in data.values()
            for figures in families.values()
        )
    except (AttributeError, TypeError):
        good = False
    if not good:
        raise ProjectError(
            f"{where} is not a table of design, family, {', '.join(FIGURES)}: restore it, or `make report`"
        )
    return data


def write(sizes: Sizes, path: Path = FILE) -> None:
    """Write the file, sorted, one family a line."""
    blocks = []
    for design in sorted(sizes):
        rows = [
            f"    {json.dumps(family)}: {json.dumps(sizes[design][family], sort_keys=True)}"
            for family in sorted(sizes[design])
        ]
        blocks.append(f"  {json.dumps(design)}: {{\n" + ",\n".join(rows) + "\n  }")
    path.write_text("{\n" + ",\n".join(blocks) + "\n}\n", encoding="utf-8")


def compare(committed: Sizes, now: Sizes, limit: int = LIMIT) -> Verdict:
    """More than `limit` per cent of growth, or a design or family on one side only, is wrong."""
    verdict = Verdict()
    names = {(design, family) for sizes in (committed, now) for design in sizes for family in sizes[design]}
    for design, family in sorted(names):
        old, new = (sizes.get(design, {}).get(family) for sizes in (committed, now))
        title = f"{design} on {family}"
        if old is None:
            verdict.wrong.append(f"{title}: no committed sizes")
        elif new is None:
            verdict.wrong.append(f"{title}: has committed sizes but is not built any more")
        else:
            for key, name in FIGURES.items():
                change = f"{title}: {name} {old[key]} -> {new[key]}"
                if old[key]:
                    change += f" ({100 * (new[key] - old[key]) / old[key]:+.1f} %)"
                # In whole numbers: exactly the limit is no growth beyond it.
                if 100 * new[key] > (100 + limit) * old[key]:
                    verdict.wrong.append(f"{change}, more than {limit} % larger")
                elif 100 * new[key] < (100 - limit) * old[key]:
                    verdict.smaller.append(f"{change}, more than {limit} % smaller")
    return verdict
