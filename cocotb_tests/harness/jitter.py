"""`make test JITTER=1`: every synchroniser samples each change of a pin one cycle late with probability 1/2.

The build replaces rtl/common/ppmc_sync.sv by tb/jitter/ppmc_sync.sv. `StageLog` determines which changes the
first stages have sampled late; the golden model receives the levels as sampled. Thus the comparison is exact.
Two registers may sample the same pin (a strobe of the host bus, a serial line). Such a pin has two names in
the model: "<pin>" for the first register, and "stage.<pin>" for the second one. If only "stage.<pin>" belongs
to a synchroniser, the first register samples the pin directly.
"""

from __future__ import annotations

import os
import re
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
LATE = "late_q"
"""Name of a register in the simulated synchroniser: its bits mark the levels that the last edge sampled
late.
"""
SECOND = "stage."
Rows = Sequence[tuple[int, int]]


def jitters() -> bool:
    """Return whether simulations have the random extra cycle."""
    return bool(os.environ.get(JITTER))


def reason_against(item: Any) -> str:
    """Return the reason why a simulated test does not run with JITTER=1; "" if it runs.

    Directed tests and random hosts of a device run, because the golden model receives the sampled levels.
    Other tests run if their checks allow the extra cycle.

    Raises ValueError if neither is the case and no reason is stated.
    """
    part = PARTS.get(item.part)
    staged = bool(part and part.stages)
    if staged and item.module.endswith(".tb_random"):
        return ""
    if item.exact:
        return str(item.exact)
    if not item.tolerant and not (staged and item.uncompared is not None):
        raise ValueError(f"{item.id}: state why it does not run with JITTER=1 (exact=), or that it can run")
    return ""


def stage_counts(log: str) -> tuple[int, int]:
    """Return how many changes the synchronisers of a simulation have sampled late, and without delay."""
    rows = re.findall(r"^ppmc_sync: (\d+) late, (\d+) prompt$", log, re.MULTILINE)
    return sum(int(late) for late, _ in rows), sum(int(prompt) for _, prompt in rows)


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
        self._bits: dict[str, list[tuple[str, int, int]]] = {}
        for path, names in part.stages.items():
            place = 0
            for name in reversed(names):
                port, bit = part.locate(name.removeprefix(SECOND))
                full = port if name == name.removeprefix(SECOND) else SECOND + port
                for number in range(part.width(port)) if bit is None else [bit]:
                    self._bits.setdefault(full, []).append((path, place, number))
                    place += 1
        self._names: dict[str, list[str]] = {}
        for name in self._bits:
            self._names.setdefault(name.removeprefix(SECOND), []).append(name)
        self._driven = 0
        self._checks: list[tuple[int, bool, str, int]] = []
        self._pins = {port: part.inputs.get(port, 1) for port in self._names}
        self._last = {name: self._pins[port] for port, names in self._names.items() for name in names}
        self.changes = [Change(0, name, level) for name, level in self._last.items() if SECOND in name]
        self.late = self.prompt = 0

    @property
    def pending(self) -> int | None:
        """First edge at which a changed pin is sampled later than the last call of `add`, or None."""
        return self._checks[0][0] if self._checks else None

    def add(self, driven: Sequence[Change], rows: Mapping[str, Rows], now: int) -> None:
        """Process the driven changes that are new since the last call, up to edge `now` - 1.

        Args:
            rows: for each path of a synchroniser, the changes of `late_q`: (edge, bits that it samples late).
        """
        for change in driven[self._driven :]:
            self._checks.append((change.t, False, change.pin, change.value))
            if change.pin in self._names:
                self._checks.append((change.t + 1, True, change.pin, 0))
        self._driven = len(driven)
        self._checks.sort(key=lambda check: check[:2])
        count = bisect_right(self._checks, now - 1, key=lambda check: check[0])
        for t, is_next, pin, value in self._checks[:count]:
            if not is_next:
                self._pins[pin] = value
                if pin not in self._bits:
                    self.changes.append(Change(t, pin, value))
            for name in self._names.get(pin, ()):
                self._sample(t, name, self._pins[pin], rows, is_next)
        del self._checks[:count]

    def _sample(self, t: int, name: str, pin: int, rows: Mapping[str, Rows], is_next: bool) -> None:
        """Add the level of an input that edge t samples, if it differs from the previous one."""
        level = pin
        for path, place, number in self._bits[name]:
            n = bisect_right(rows[path], (t, 1 << 300))
            level ^= (rows[path][n - 1][1] >> place & 1 if n else 0) << number
        self.late += level != pin
        self.prompt += level == pin and not is_next
        if level != self._last[name]:
            self._last[name] = level
            self.changes.append(Change(t, name, level))
