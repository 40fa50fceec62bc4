"""PMC006B4 on one line: the RTL, or modelled."""

from __future__ import annotations

from pathlib import Path

from ..common.char_line import CharLine
from ..common.lines import LineKind
from .line_spec import KNOWN, LineSpec, at_rate, parse_line
from .node import Node, first_content


class NodeLine(CharLine[Node]):
    """The line. All controllers hear everything, each finds its frames by itself."""

    def __init__(self, spec: LineSpec) -> None:
        numbered = [*spec.carriages.items()]
        if spec.twin is not None:
            numbered.append((spec.twin, spec.carriages[spec.twin]))
        nodes = [Node(carriage, number, spec) for number, carriage in numbered]
        super().__init__(spec, nodes, spec.clk_hz / spec.baud)


def parameters(spec: LineSpec) -> dict[str, int | str]:
    """Of tb/pmc006/line/line_node.sv."""
    return {"CLK_HZ": spec.clk_hz, "STEP_ACK": spec.step_ack, "BAUD": spec.baud}


def arguments(spec: LineSpec, files: Path) -> list[str]:
    """Of the program in tb/line with tb/pmc006/line/node.h; what the EEPROMs hold is put into files."""
    addresses = [*spec.carriages, *([] if spec.twin is None else [spec.twin])]
    words = [f"stations={len(addresses)}"]
    for place, address in enumerate(addresses):
        its = spec.carriages[address]
        image = files / f"eeprom{place}"
        image.write_bytes(first_content(address, its))
        known: dict[str, object] = {"start": its.start, "low": its.low, "high": its.high, "gpi": its.gpi}
        known |= {"no_eeprom": int(its.no_eeprom), "image": image}
        if its.eeprom is not None:
            known["keep"] = its.eeprom.absolute()
        words += [f"{name}{place}={value}" for name, value in known.items()]
    return words


MACHINE = LineKind(
    parse_line, at_rate, KNOWN, NodeLine, parameters, arguments, sources=("pmc006/eeprom_24c32.sv",)
)
