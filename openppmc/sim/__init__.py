"""The virtual board: the RTL of a part with its bridge, Verilated, with its UART on a pseudo-terminal.

    with openppmc.sim.start("start=2000") as board:
        print(board.port)

It is built from a checkout of the project; docs/virtual_board.md has the words of the text. Room `common` has
the board, its build, its text, and lines of modelled stations, which run in Python. A part's folder has
`machine`, what is around the part (places of switches, words of its own), and for stations `line`.
"""

from typing import TYPE_CHECKING

from ..lazy import lazy

if TYPE_CHECKING:
    from .common.board import AxisStatus, SimBoard, Status, start
    from .common.known import KNOWN
    from .common.line_child import LineStatus, SimLine, start_line
    from .common.lines import part_of
    from .common.spec import Spec, SpecError, parse_spec
    from .common.verilator import SimError
else:
    __getattr__, __dir__ = lazy(
        __name__,
        """
        .common.board AxisStatus SimBoard Status start
        .common.known KNOWN
        .common.line_child LineStatus SimLine start_line
        .common.lines part_of
        .common.spec Spec SpecError parse_spec
        .common.verilator SimError
        """,
    )

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
