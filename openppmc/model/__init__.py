"""Golden models: pure Python, integers and fractions, written from the rules and not from the RTL.

`ppmc104.Ppmc104`, `ppmc2104.Ppmc2104`, `ppmc312.Ppmc312`, `pmc006.Pmc006` and `stmc.Stmc` are the parts at
pin level, `j105_stmc.J105Stmc` is the board around the last, `predict.predict_move` the same arithmetic for
plots. Modules with a part's number or "stmc" in their name hold what is special to it, the others serve every
part of the family.
"""

from .common.edges import Edge
from .common.timebase import Latency, Timebase
from .pmc006.part import Pmc006
from .ppmc104.part import Ppmc104
from .ppmc312.part import Ppmc312
from .ppmc2104.part import Ppmc2104
from .single.predict import Move, predict_move
from .stmc.part import Stmc
from .stmc.pc104_board import J105Stmc

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
