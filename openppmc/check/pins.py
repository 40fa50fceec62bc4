"""Pins of a part for reports and pictures."""

from __future__ import annotations

from collections.abc import Mapping
from collections.abc import Set as AbstractSet
from dataclasses import dataclass
from typing import Any, Protocol


class Pinned(Protocol):
    """Pins of a part.

    Attributes:
        inputs: idle level of each input except `rst_n`.
        bus_pins: inputs that are connected to the bus or the line of the host.
        clock: input of the external clock, "" for a part without one.
    """

    @property
    def inputs(self) -> Mapping[str, int]: ...
    @property
    def bus_pins(self) -> AbstractSet[str]: ...
    @property
    def clock(self) -> str: ...
    def width(self, pin: str) -> int:
        """Return the number of bits of an input or output."""


@dataclass(frozen=True)
class ModelPins:
    """`Pinned` of a golden model.

    Attributes:
        outputs: level of each output in reset.
    """

    inputs: Mapping[str, int]
    outputs: Mapping[str, int]
    widths: Mapping[str, int]
    bus_pins: AbstractSet[str]
    clock: str = ""

    def width(self, pin: str) -> int:
        """Return the number of bits of an input or output."""
        return self.widths.get(pin, 1)


_CLOCKS = ("clock", "ext_clk", "extck")


def pins_of(model: Any) -> ModelPins:
    """Return the pins of a golden model immediately after reset (`model.chip.Chip`)."""
    inputs = {pin: level for pin, level in model.INPUTS.items() if pin != "rst_n"}
    clock = next((pin for pin in _CLOCKS if pin in inputs), "")
    return ModelPins(inputs, dict(model.log.initial), model.WIDTHS, frozenset(model.HOST_PINS), clock)
