"""A line of golden models with the pins of `ppmc312_line`, without a simulator.

The models run independently. If a model drives a level at an edge, the others receive it at the next edge.
"""

from __future__ import annotations

import heapq
from collections.abc import Mapping

from cocotb_tests.harness import Config
from openppmc.model.ppmc312.part import Ppmc312

from .setting import ALL, F8L, LINE, SEVERAL, SINGLE, STATIONS


def straps(levels: Mapping[str, int], station: int) -> dict[str, int]:
    """Return the pins of one station, taken from the pins of the line; rxd is not included."""
    rows = {pin: levels[pin] >> station & 1 for pin in SINGLE}
    for pin, width in SEVERAL.items():
        rows[pin] = levels[pin] >> width * station & (1 << width) - 1
    return {"mode": 0, **rows}


def heard(levels: Mapping[str, int], driven: int, station: int) -> int:
    """Return the level that a station receives.

    Args:
        driven: one bit for each station, 0 where its driver makes the line low.
    """
    low = ALL & ~driven
    pulled = not levels["master"]
    pulled |= bool(levels["hear_others"] and low & ~(1 << station))
    pulled |= bool(levels["hear_self"] and low >> station & 1)
    return int(not pulled) ^ (levels["noise"] >> station & 1)


class ModelLine:
    """Line of `count` golden models.

    `now` is the next edge, which samples the levels that are set now. Keyword arguments are pins of the line
    (`setting.LINE`) from edge 0 on.
    """

    def __init__(
        self, config: Config = F8L, sum_mode: str = "BINARY", count: int = STATIONS, **pins: int
    ) -> None:
        self.levels = {**LINE.inputs, **pins}
        self.stations = [
            Ppmc312(
                config.clk_hz,
                config.xtal_hz,
                config.timing,
                sum_mode=sum_mode,
                straps=straps(self.levels, number),
            )
            for number in range(count)
        ]
        self.now = 0
        self.edges: list[tuple[int, int]] = []
        self._line = 1
        self._driven = ALL
        self._rxd = [1] * count
        self._due: list[int | None] = [None] * count
        self._heap: list[tuple[int, int]] = []
        for number in range(count):
            self._plan(number)
        self._hear(0)

    # ------------------------------------------------------------------ as a bench

    async def until(self, edge: int) -> int:
        """Run to just before this edge; do nothing if it has passed."""
        self.now = max(self.now, edge)
        self._run(self.now - 1)
        return self.now

    def set(self, **levels: int) -> int:
        """Set pins from edge `now` on; return `now`."""
        changed = {pin: level for pin, level in levels.items() if self.levels[pin] != level}
        before, self.levels = self.levels, {**self.levels, **changed}
        for pin in changed.keys() & SINGLE.keys():
            for number in range(len(self.stations)):
                if (before[pin] ^ changed[pin]) >> number & 1:
                    self.stations[number].pins(self.now, **{pin: changed[pin] >> number & 1})
                    self._plan(number)
        if changed.keys() & {"master", "noise", "hear_others", "hear_self"}:
            self._hear(self.now)
            self._log(self.now)
        return self.now

    async def fall(self, limit: int) -> int | None:
        """Wait until the line is low.

        Returns:
            The edge at which the line fell, or None if it is still high after `limit` cycles.
        """
        end = self.now + limit
        while self._line:
            due = self._next()
            if due is None or due > end:
                await self.until(end)
                return None
            self._run(due)
            self.now = max(self.now, due + 1)
        return self.edges[-1][0]

    def line_at(self, edge: int) -> int:
        """Return the level of the line just after an edge."""
        return next((level for t, level in reversed(self.edges) if t <= edge), 1)

    # ------------------------------------------------------------------ inside

    def _plan(self, number: int) -> None:
        due = self._due[number] = self.stations[number].next_event
        if due is not None:
            heapq.heappush(self._heap, (due, number))

    def _next(self) -> int | None:
        """Return the next edge at which a station has an event."""
        while self._heap and self._due[self._heap[0][1]] != self._heap[0][0]:
            heapq.heappop(self._heap)
        return self._heap[0][0] if self._heap else None

    def _run(self, last: int) -> None:
        """Process all edges up to this one."""
        while (edge := self._next()) is not None and edge <= last:
            driven = self._driven
            while self._heap and self._heap[0][0] == edge:
                number = heapq.heappop(self._heap)[1]
                if self._due[number] != edge:
                    continue
                station = self.stations[number]
                station.run_until(edge)
                levels = station.log.levels
                bit = 1 << number
                self._driven = (
                    self._driven | bit if levels["txd"] or not levels["snd"] else self._driven & ~bit
                )
                self._plan(number)
            if self._driven != driven:
                self._log(edge)
                self._hear(edge + 1)

    def _hear(self, edge: int) -> None:
        for number, station in enumerate(self.stations):
            level = heard(self.levels, self._driven, number)
            if level != self._rxd[number]:
                self._rxd[number] = level
                station.pins(edge, rxd=level)
                self._plan(number)

    def _log(self, edge: int) -> None:
        level = int(self.levels["master"] and self._driven == ALL)
        if level != self._line:
            self._line = level
            self.edges.append((edge, level))
