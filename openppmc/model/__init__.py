"""Golden models: pure Python, integers and fractions, written from the rules and not from the RTL.

`ppmc104.Ppmc104`, `ppmc2104.Ppmc2104`, `ppmc312.Ppmc312`, `pmc006.Pmc006` and `stmc.Stmc` are the parts at
pin level, `j105_stmc.J105Stmc` is the board around the last, `predict.predict_move` the same arithmetic for
plots. Modules with a part's number or "stmc" in their name hold what is special to it, the others serve every
part of the family.
"""

from .edges import Edge
from .j105_stmc import J105Stmc
from .pmc006 import Pmc006
from .ppmc104 import Ppmc104
from .ppmc312 import Ppmc312
from .ppmc2104 import Ppmc2104
from .predict import Move, predict_move
from .stmc import Stmc
from .timebase import Latency, Timebase

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
