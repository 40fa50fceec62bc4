"""What can be read of an STMC at any time, where it differs from the family. Pure."""

from __future__ import annotations

from dataclasses import dataclass

from ..axis.registers import Switches


@dataclass(frozen=True)
class Inputs(Switches):
    """Switches of an STMC; motor_off: MON is low."""

    motor_off: bool
