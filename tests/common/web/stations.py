"""Golden models of the stations of a line, with the pins that the module of the line has."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping

from openppmc.check.records import Edge
from openppmc.model.ppmc312.part import Ppmc312
from scripts.site.webparts import WebPart


class StationModels:
    """One model for each station; bit k of a port is the pin of station k. `edges` is in order of time."""

    def __init__(self, part: WebPart) -> None:
        line, config = part.stations, part.config
        assert line is not None
        self._inputs = {name: (port, bit) for name, port, bit in line.bits(part.device, part.device.inputs)}
        outputs = line.bits(part.device, part.device.watched)
        self._outputs = {(port, bit): name for name, port, bit in outputs}
        self._pins = dict(part.part.inputs)
        self._level = part.part.reset_levels(part.params)
        self.edges: list[Edge] = []
        self.models = [
            Ppmc312(config.clk_hz, config.xtal_hz, config.timing, straps={**line.levels, line.number: number})
            for number in range(line.count)
        ]
        self._taken = [0] * line.count

    @property
    def now(self) -> int:
        """Last edge that all models have simulated."""
        return min(model.now for model in self.models)

    @property
    def next_event(self) -> int | None:
        """Edge of the next event of a model; None if there is none."""
        return min((t for model in self.models if (t := model.next_event) is not None), default=None)

    @property
    def outputs(self) -> Mapping[str, int]:
        """Output levels of all stations after edge `now`."""
        return self._level

    def run_until(self, t: int) -> None:
        """Run all models up to and including edge t."""
        for model in self.models:
            model.run_until(max(t, model.now))
        self._collect()

    def pins(self, t: int, **levels: int) -> None:
        """Set input levels from edge t on."""
        self.run_until(t - 1)
        for name, level in levels.items():
            if name == "rst_n":
                for model in self.models:
                    model.pins(t, rst_n=level)
                continue
            port, bit = self._inputs[name]
            changed, self._pins[name] = level ^ self._pins[name], level
            for number, model in enumerate(self.models):
                if changed >> number & 1:
                    other = model.inputs[port] & ~(1 << bit)
                    model.pins(t, **{port: other | (level >> number & 1) << bit})
        self._collect()

    def _collect(self) -> None:
        """Add the edges of the models since the last call."""
        found: dict[int, list[tuple[int, Edge]]] = defaultdict(list)
        for number, model in enumerate(self.models):
            for edge in model.edges[self._taken[number] :]:
                found[edge.t].append((number, edge))
            self._taken[number] = len(model.edges)
        for t in sorted(found):
            before = dict(self._level)
            for number, edge in found[t]:
                for (port, bit), name in self._outputs.items():
                    if port == edge.signal:
                        level = self._level[name] & ~(1 << number) | (edge.value >> bit & 1) << number
                        self._level[name] = level
            self.edges += [
                Edge(t, name, level) for name, level in self._level.items() if level != before[name]
            ]
