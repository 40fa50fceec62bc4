"""Golden models: pure Python, integers and fractions, written from the rules and not from the RTL.

A folder a part (`ppmc104`, `ppmc2104`, `stmc`, `ppmc312`, `pmc006`); in each, `part` is the part at pin
level, `pins` its pins and `codes` its codes; where there is such, `carrier` is the part as its UART bridge
sees it and `predict` the arithmetic of one move for plots and tables. Parts know the shared rooms and not
each other:

    common      time, events, edges, blocks of a clocked part, UART
    motion      motion of one axis as the family has it: ramp, guard, excitation, chopper
    carrier     UART bridge, the carrier around any part, switches along an axis, EEPROM
    single      parts with one axis on a byte bus: host port, commands, prediction
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
