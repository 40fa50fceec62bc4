"""The two open-drain lines between the golden model of the PMC006 and its EEPROM."""

from __future__ import annotations

from typing import Any

from openppmc.model.carrier.eeprom import Eeprom24C32


class I2cBus:
    """The lines, with a `run_until` that replaces that of the model and also runs the EEPROM.

    If the part or the device pulls a line at edge t, the line is low from edge t + 1 on. The levels of the
    lines reach the model through `model.pins`.
    """

    def __init__(self, model: Any, device: Eeprom24C32) -> None:
        self.model, self.device = model, device
        self._run = model.run_until
        self._lines = (1, 1)
        self._pulled = (0, 0)
        self._look: int | None = 0
        model.run_until = self.run_until

    def again(self, t: int) -> None:
        """Evaluate the lines at edge t, because the device was changed from outside."""
        self._look = t if self._look is None else min(t, self._look)

    @property
    def due(self) -> int | None:
        """Next edge at which a line may change or the device has an event."""
        levels, own = self.model.log.levels, self._look
        if (levels["scl_oe"], levels["sda_oe"]) != self._pulled:
            own = min(self.model.now + 1, own or self.model.now + 1)
        return min((t for t in (own, self.device.due) if t is not None), default=None)

    def run_until(self, t: int) -> None:
        """Run the model to edge t and update the lines."""
        model, device, levels, run = self.model, self.device, self.model.log.levels, self._run
        while True:
            pulled = levels["scl_oe"], levels["sda_oe"]
            if pulled != self._pulled:
                self._pulled = pulled
                self.again(model.now + 1)
            own, event = self._look, model.next_event
            if device.due is not None and (own is None or device.due < own):
                own = device.due
            edge = t + 1 if event is None else event
            if own is not None and own <= edge:
                edge = own
            if edge > t:
                break
            if edge == own:
                self._settle(edge)
            run(edge)
        if t > model.now:
            run(t)

    def _settle(self, t: int) -> None:
        """Evaluate the levels of the lines at edge t."""
        device = self.device
        scl, sda = (
            int(not mine and not its)
            for mine, its in zip(self._pulled, (device.scl, device.sda), strict=True)
        )
        if (scl, sda) != self._lines:
            self._lines = scl, sda
            self.model.pins(t, scl_i=scl, sda_i=sda)
        self._look = None
        before = device.scl, device.sda
        device.on_lines(t, scl, sda)
        if (device.scl, device.sda) != before:
            self._look = t + 1
