"""What stations of a line allow: PPMC-312 in serial mode. Pure."""

from __future__ import annotations

from ....parts import part
from ...basis.kind import COILS_OFF, CURVES
from .. import kind
from .ascii import STATIONS, station_number


class LineKind(kind.TableKind):
    """Stations are axes, and their numbers begin with 0."""

    def check_axis(self, axis: int) -> int:
        return station_number(axis)


KIND = LineKind(
    part("ppmc312-serial"),
    axes=STATIONS,
    has=frozenset((COILS_OFF, CURVES)),
    outputs=kind.KIND.outputs,
    alarm=kind.KIND.alarm,
    origin_between=kind.KIND.origin_between,
    usual_ramp=kind.KIND.usual_ramp,
)
