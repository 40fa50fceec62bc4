"""Golden models in pure Python, with integers and fractions.

The models are written from the rules in the manuals, not from the RTL. Each part has a module or a folder. In
a folder, `part` is the part at pin level, `codes` defines its codes, and `carrier` connects the part to a
UART bridge. A part imports the shared modules, but no other part:

    clock       time, events, edges
    chip        blocks of a clocked part, pins; `uart`: a UART
    motion      motion of one axis of the PPMC family: ramp, limits, excitation, chopper
    carrier     UART bridge, the carrier of any part, switches along an axis, EEPROM
    single      parts with one axis on a byte bus: host port, commands, prediction of a move
"""

from typing import TYPE_CHECKING

from ..lazy import lazy

if TYPE_CHECKING:
    from .clock import Edge, Latency, Timebase
    from .pmc006.part import Pmc006
    from .ppmc104 import Ppmc104
    from .ppmc312.part import Ppmc312
    from .ppmc2104.part import Ppmc2104
    from .single.predict import Move, predict_move
    from .stmc.part import Stmc
    from .stmc.pc104_board import J105Stmc
else:
    __getattr__, __dir__ = lazy(
        __name__,
        """
        .clock Edge Latency Timebase
        .pmc006.part Pmc006
        .ppmc104 Ppmc104
        .ppmc312.part Ppmc312
        .ppmc2104.part Ppmc2104
        .single.predict Move predict_move
        .stmc.part Stmc
        .stmc.pc104_board J105Stmc
        """,
    )

__all__ = [
    "Edge",
    "J105Stmc",
    "Latency",
    "Move",
    "Pmc006",
    "Ppmc104",
    "Ppmc2104",
    "Ppmc312",
    "Stmc",
    "Timebase",
    "predict_move",
]
