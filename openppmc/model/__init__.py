"""Golden models: pure Python, integers and fractions, written from the rules and not from the RTL.

`ppmc104.Ppmc104` is the part at pin level, `predict.predict_move` the same arithmetic for plots; `ramp`,
`excitation`, `timebase`, `edges`, `scheduler` serve every part of the family.
"""

from .edges import Edge
from .ppmc104 import Ppmc104
from .predict import Move, predict_move
from .timebase import Latency, Timebase

__all__ = ["Edge", "Latency", "Move", "Ppmc104", "Timebase", "predict_move"]
