"""The virtual board: the RTL of a part with its bridge, Verilated, with its UART on a pseudo-terminal.

    with openppmc.sim.start("start=2000") as board:
        print(board.port)

It is built from a checkout of the project; docs/virtual_board.md has the words of the text. Room `common` has
the board, its build, its text, and lines of modelled stations, which run in Python. A part's folder has
`machine`, what is around the part (places of switches, words of its own), and for stations `line`.
"""

from .common.board import AxisStatus, SimBoard, Status, start
from .common.line_child import LineStatus, SimLine, start_line
from .common.lines import part_of
from .common.spec import Spec, SpecError, known_words, parse_spec
from .common.verilator import SimError

KNOWN = known_words()
"""Words of a board's text."""

__all__ = [
    "KNOWN",
    "AxisStatus",
    "LineStatus",
    "SimBoard",
    "SimError",
    "SimLine",
    "Spec",
    "SpecError",
    "Status",
    "parse_spec",
    "part_of",
    "start",
    "start_line",
]
