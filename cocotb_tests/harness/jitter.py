"""`make test JITTER=1`: every synchroniser samples each change of a pin one cycle late with probability 1/2.

The build replaces rtl/common/ppmc_sync.sv by tb/jitter/ppmc_sync.sv. `StageLog` reads which levels the first
stages have sampled, and passes exactly these levels to the golden model. Thus the comparison remains exact.
A pin that a register also samples directly (the strobes of the host bus) has two names in the model: its own
for the direct register, and "stage.<pin>" for the synchroniser.
"""

from __future__ import annotations

import os
from bisect import bisect_right
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from openppmc.check.records import Change

from .part import PARTS, Part
from .paths import ROOT

JITTER = "OPENPPMC_JITTER"
"""Environment variable: if set, the synchronisers of a simulation have the random extra cycle."""
MODELS = {ROOT / "rtl/common/ppmc_sync.sv": ROOT / "tb/jitter/ppmc_sync.sv"}
STAGE = "stage_q"
FIRST_SAMPLE = 2
"""Edge of the first sample after the release of the reset, which is edge 0."""
Rows = Sequence[tuple[int, int]]


def jitters() -> bool:
    """Return whether simulations have the random extra cycle."""
    return bool(os.environ.get(JITTER))


def is_jittered(item: Any) -> bool:
    """Return whether a simulated test can run with JITTER=1: its device lists its synchronisers."""
    if item.part not in PARTS or not PARTS[item.part].stages:
        return False
    exact = item.exact or PARTS[item.part].exact
    return (item.uncompared == "" and not exact) or item.module.endswith(".tb_random")


def with_jitter(sources: Sequence[Path]) -> list[Path]:
    """Return the sources of a design, with the simulation model of each synchroniser."""
    return [MODELS.get(ROOT / path, path) for path in sources] if jitters() else list(sources)


class StageLog:
    """Converts driven pin changes to the changes that the synchronisers have sampled.

    Attributes:
        changes: changes so far, in order of time.
        late: number of changes that were sampled one cycle late.
        prompt: number of changes that were sampled without the extra cycle.
    """

    def __init__(self, part: Part) -> None:
        self._part = part
        self._bits: dict[str, list[tuple[str, int, int]]] = {}
        for path, pins in part.stages.items():
            place = 0
            for pin in reversed(pins):
                port, bit = part.locate(pin)
                for number in range(part.width(port)) if bit is None else [bit]:
                    self._bits.setdefault(port, []).append((path, place, number))
                    place += 1
        direct = part.direct & set(self._bits)
        self._name = {pin: f"stage.{pin}" if pin in direct else pin for pin in self._bits}
        self._direct = direct
        self._driven = 0
        self._checks: list[tuple[int, str, int | None]] = []
        self._last: dict[str, int] = dict(part.inputs)
        self._sampling_from = FIRST_SAMPLE
        self.changes = [Change(0, self._name[pin], part.inputs[pin]) for pin in sorted(direct)]
        self.late = self.prompt = 0

    def add(
        self, driven: Sequence[Change], rows: Mapping[str, Rows], first: Mapping[str, int], now: int
    ) -> None:
        """Process the driven changes that are new since the last call, up to edge `now` - 1.

        Args:
            rows: path of a first stage -> (edge, level) of its changes.
            first: path -> level before the first change.
        """
        for change in driven[self._driven :]:
            self._checks.append((change.t, change.pin, change.value))
            if change.pin in self._bits:
                self._checks.append((change.t + 1, change.pin, None))
        self._driven = len(driven)
        self._checks.sort(key=lambda check: check[0])
        count = bisect_right(self._checks, now - 1, key=lambda check: check[0])
        for t, pin, value in self._checks[:count]:
            self._check(t, pin, value, rows, first)
        del self._checks[:count]

    def _check(
        self, t: int, pin: str, value: int | None, rows: Mapping[str, Rows], first: Mapping[str, int]
    ) -> None:
        if pin == "rst_n" and value is not None:
            self._sampling_from = t + FIRST_SAMPLE if value else 1 << 62
        if value is not None and (pin not in self._bits or pin in self._direct):
            self.changes.append(Change(t, pin, value))
        if pin not in self._bits:
            return
        if t < self._sampling_from:
            level = value
        else:
            level = 0
            for path, place, number in self._bits[pin]:
                found = rows[path]
                n = bisect_right(found, (t, 1 << 300))
                level |= ((found[n - 1][1] if n else first[path]) >> place & 1) << number
            if value is None:
                self.late += level != self._last[pin]
            else:
                self.prompt += level == value
        if level is not None and level != self._last[pin]:
            self._last[pin] = level
            self.changes.append(Change(t, self._name[pin], level))
