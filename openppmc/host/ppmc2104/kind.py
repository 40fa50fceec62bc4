"""What a PPMC-2104 allows. Pure."""

from __future__ import annotations

from ...parts import part
from ..axis.kind import RateKind
from ..basis.kind import COILS_OFF, PULSE_ONLY

KIND = RateKind(
    part("ppmc2104"),
    axes=2,
    has=frozenset((PULSE_ONLY, COILS_OFF)),
    outputs=3,
    least_rate=1,
    rate_gap=2,
)
