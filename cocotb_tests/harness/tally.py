"""What a simulation has compared, for whoever started it: counts, a JSON object a line.

TALLY in the environment names the file; without it nothing is written.
"""

from __future__ import annotations

import json
import os
from collections import Counter
from pathlib import Path

TALLY = "OPENPPMC_TALLY"


def tell(**counts: int) -> None:
    """Add these counts to the tally of the run."""
    if name := os.environ.get(TALLY):
        with open(name, "a", encoding="ascii") as file:
            file.write(json.dumps(counts) + "\n")


def told(file: Path) -> Counter[str]:
    """The sums of all that a run has told; nothing if it has told nothing."""
    sums: Counter[str] = Counter()
    if file.is_file():
        for line in file.read_text(encoding="ascii").splitlines():
            sums.update(json.loads(line))
    return sums


def in_words(sums: Counter[str]) -> str:
    """Such as "12 seeds, 3,456 edges"; those that are 0 are left out."""
    return ", ".join(f"{number:,} {name}" for name, number in sums.items() if number)
