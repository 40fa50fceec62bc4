"""Modelled PMC006B4 on one line."""

from __future__ import annotations

from ..common.char_line import CharLine
from .line_spec import LineSpec
from .node import Node


class NodeLine(CharLine):
    """The line. All controllers hear everything, each finds its frames by itself."""

    def __init__(self, spec: LineSpec) -> None:
        numbered = [*spec.carriages.items()]
        if spec.twin is not None:
            numbered.append((spec.twin, spec.carriages[spec.twin]))
        super().__init__(
            spec, [Node(carriage, number, spec) for number, carriage in numbered], spec.clk_hz / spec.baud
        )
