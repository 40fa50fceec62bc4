"""Virtual board: Verilated RTL of a part and its bridge; the UART is a pseudo-terminal.

    with openppmc.sim.start("start=2000") as board:
        print(board.port)

The board is built from a checkout of the project. The text consists of words such as `start=2000`, which
docs/virtual_board.md lists. The folder `common` contains the board, its build, the parser of its text, and
lines of modelled stations, which run in Python. The module of a device contains its machine model (positions
of switches, additional words) and, for stations, the line.
"""

from typing import TYPE_CHECKING

from ..lazy import lazy

if TYPE_CHECKING:
    from .common.board import AxisStatus, SimBoard, Status, start
    from .common.build import SimError
    from .common.known import KNOWN
    from .common.lines import LineStatus, SimLine, part_of, start_line
    from .common.spec import Spec, SpecError, parse_spec
else:
    __getattr__, __dir__ = lazy(
        __name__,
        """
        .common.board AxisStatus SimBoard Status start
        .common.build SimError
        .common.known KNOWN
        .common.lines LineStatus SimLine part_of start_line
        .common.spec Spec SpecError parse_spec
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
