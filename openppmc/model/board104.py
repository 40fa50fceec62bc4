"""A board in Python: golden PPMC-104, pulse counter and plant, in virtual time. The bridge's `Bus`."""

from __future__ import annotations

from collections.abc import Callable

from .plant import Plant
from .ppmc104 import Ppmc104

WRITE_STROBE, READ_STROBE, PAUSE = 4, 6, 4
RESET_CLK = 16
_SWITCHES = ("l1_n", "l2_n", "l3_n", "l4_n", "cnp_n", "alm_n")


class Board104:
    """Ppmc104 with a motor that follows `pout_n` and `dir`.

    `t` is the next free clk edge. `position` is the motor's, `count_value` the pulse counter's.
    on_interrupt: called when `int_n` falls.
    """

    def __init__(
        self,
        plant: Plant,
        clk_hz: int = 16_000_000,
        xtal_hz: int = 16_000_000,
        timing: str = "FAST",
        on_interrupt: Callable[[], None] = lambda: None,
    ) -> None:
        self.part = Ppmc104(clk_hz, xtal_hz, timing)
        self.clk_hz = clk_hz
        self.plant = plant
        self.position = plant.start
        self.count_value = 0
        self.on_interrupt = on_interrupt
        self.t = 8
        self._direction = 0
        self._switches = plant.levels(self.position)
        self.part.pins(self.t - 4, **self._switches)

    @property
    def seconds(self) -> float:
        """Virtual time in s."""
        return self.t / self.clk_hz

    def run_until(self, t: int, stop: Callable[[], bool] = lambda: False) -> None:
        """Let time pass up to edge t, or less far if `stop()` becomes true at an event."""
        part = self.part
        while (edge := part.next_event) is not None and edge < t:
            part.run_until(edge)
            self._watch()
            self.t = max(self.t, edge + 1)
            if stop():
                return
        self.t = max(self.t, t)

    def _watch(self) -> None:
        """Follow the outputs: motor, counter, switches, interrupt."""
        log = self.part.log
        if not log.edges:
            return
        edges = log.edges[:]
        log.edges.clear()
        before = self.position
        for edge in edges:
            if edge.signal == "dir":
                self._direction = edge.value
            elif edge.signal == "pout_n" and not edge.value:
                self.position += -1 if self._direction else 1
                self.count_value += -1 if self._direction else 1
            elif edge.signal == "int_n" and not edge.value:
                self.on_interrupt()
        if self.position != before:
            levels = self.plant.levels(self.position)
            if levels != self._switches:
                self._switches = levels
                self.part.pins(self.part.now + 1, **levels)

    def _settle(self) -> None:
        """Everything before the next access has happened."""
        self.run_until(self.t)
        self.t = max(self.t, self.part.now + 1)

    # ------------------------------------------------------------------ as the bridge sees it

    def read(self, a: int) -> int:
        """One read cycle; only address bit 0 is wired."""
        self._settle()
        value = self.part.read(self.t, a & 1, READ_STROBE)
        self._watch()
        self.t += READ_STROBE + PAUSE
        return value

    def write(self, a: int, byte: int) -> None:
        """One write cycle."""
        self._settle()
        self.part.write(self.t, a & 1, byte, WRITE_STROBE)
        self._watch()
        self.t += WRITE_STROBE + PAUSE

    def reset(self) -> None:
        """Reset of the part; motor and counter stay."""
        self._settle()
        self.part.pins(self.t, rst_n=0)
        self._watch()
        self.t += RESET_CLK
        self.part.pins(self.t, rst_n=1)
        self.t += RESET_CLK
        self._direction = 0

    def straps(self, levels: int) -> None:
        """Bit 0 drives csel, bit 1 vsel."""
        self._settle()
        self.part.pins(self.t, csel=levels & 1, vsel=levels >> 1 & 1)
        self.t += 1

    def pins(self) -> int:
        """int_n, hold and the six switches, from bit 0 up."""
        self._settle()
        outputs = self.part.outputs
        switches = sum(self._switches[name] << place for place, name in enumerate(_SWITCHES))
        return outputs["int_n"] | outputs["hold"] << 1 | switches << 2

    def count(self) -> int:
        """Pulse counter, wraps at 32 bits in the answer."""
        self._settle()
        return self.count_value

    def zero(self) -> None:
        """Pulse counter to 0."""
        self._settle()
        self.count_value = 0

    def now_ms(self) -> float:
        """Virtual time in ms."""
        return self.t * 1000 / self.clk_hz

    def skip(self, limit_ms: float) -> None:
        """Go to the event that changes the status register, or to the limit."""
        part = self.part
        before = part.status
        limit = self.t + max(1, round(limit_ms * self.clk_hz / 1000))
        self.run_until(limit, stop=lambda: part.status != before)
