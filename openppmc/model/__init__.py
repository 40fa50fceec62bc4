"""Golden models: pure Python, integers and fractions, written from the rules and not from the RTL.

`ppmc104.Ppmc104` and `ppmc2104.Ppmc2104` are the parts at pin level, `predict.predict_move` the same
arithmetic for plots. Modules with a part's number in their name hold what is special to it, the others serve
every part of the family.
"""

from .edges import Edge
from .ppmc104 import Ppmc104
from .ppmc2104 import Ppmc2104
from .predict import Move, predict_move
from .timebase import Latency, Timebase

__all__ = ["Edge", "Latency", "Move", "Ppmc104", "Ppmc2104", "Timebase", "predict_move"]
