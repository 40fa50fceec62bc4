"""Modelled PMC006B4 on one line."""

from __future__ import annotations

from ..common.char_line import CharLine
from ..common.lines import LineKind
from .line_spec import KNOWN, LineSpec, at_rate, parse_line
from .node import Node


class NodeLine(CharLine[Node]):
    """The line. All controllers hear everything, each finds its frames by itself."""

    def __init__(self, spec: LineSpec) -> None:
        numbered = [*spec.carriages.items()]
        if spec.twin is not None:
            numbered.append((spec.twin, spec.carriages[spec.twin]))
        nodes = [Node(carriage, number, spec) for number, carriage in numbered]
        super().__init__(spec, nodes, spec.clk_hz / spec.baud)


MACHINE = LineKind(parse_line, at_rate, KNOWN, NodeLine)
