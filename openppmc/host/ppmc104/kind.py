"""What a PPMC-104 allows. Pure."""

from __future__ import annotations

from ...parts import part
from ..axis.kind import RateKind
from ..basis.kind import AUX, COILS_OFF, LONG, POSITIVE, PULSE_ONLY

KIND = RateKind(part("ppmc104"), has=frozenset((POSITIVE, LONG, PULSE_ONLY, COILS_OFF, AUX)))
