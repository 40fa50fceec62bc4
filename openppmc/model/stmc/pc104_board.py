"""Golden model of the J105 STMC board: the core with an ISA slave and a step clock of 48.675 kHz.

Rules J105-01..07. This module contains the logic between the core and the bus; the core is in `part`.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from ..chip import Square
from ..clock import Edge, EdgeLog, Latency
from .part import Stmc

SWITCHES = ("l1_n", "l2_n", "l3_n", "l4_n", "cnp_n", "mon")
INPUTS: dict[str, int] = {
    "rst_n": 1,
    "sa": 0,
    "aen": 0,
    "ior_n": 1,
    "iow_n": 1,
    "sd_i": 0,
    **dict.fromkeys(SWITCHES, 1),
}
OUTPUTS: dict[str, int] = {"sd_o": 0, "sd_oe": 0, "irq": 0, "s": 0, "drv": 0, "hold": 1}
WIDTHS: dict[str, int] = {"sa": 10, "sd_i": 8, "sd_o": 8, "s": 5, "drv": 4}


class J105Stmc:
    """J105 board.

    The time and the output edges of the board are the same as those of its core.

    The other arguments are the same as for the core, except that there is no phase_idle.

    Args:
        base_addr: even, 0..0x3FE.
        ext_hz: 1..clk_hz/4.

    Raises:
        ValueError: a value is out of range.
    """

    def __init__(
        self,
        clk_hz: int = 16_000_000,
        xtal_hz: int = 16_000_000,
        timing: str = "FAST",
        read_map: str = "FAMILY",
        hold_xt: int = 544_000,
        chop_on_xt: int = 1_040,
        chop_off_xt: int = 1_740,
        base_addr: int = 0x3B0,
        ext_hz: int = 48_675,
        latency: Latency | None = None,
    ) -> None:
        if base_addr & 1 or not 0 <= base_addr <= 0x3FE:
            raise ValueError(f"base address {base_addr:#x} is not an even one of 0..0x3fe")
        self.core = Stmc(
            clk_hz,
            xtal_hz,
            timing,
            read_map,
            hold_xt=hold_xt,
            chop_on_xt=chop_on_xt,
            chop_off_xt=chop_off_xt,
            latency=latency,
        )
        self._base = base_addr
        self._pins = dict(INPUTS)
        # The core samples the register of the accumulator one edge after it has changed.
        self._lag = self.core.latency.reset_tick + 1
        self._square = Square(clk_hz, ext_hz, self._lag)
        self.log = EdgeLog(OUTPUTS)
        self._edges_passed = 0
        self._irq_pending: list[tuple[int, int]] = []

    # ------------------------------------------------------------------ time

    @property
    def now(self) -> int:
        """Last edge that was simulated, -1 before edge 0."""
        return self.core.now

    @property
    def next_event(self) -> int:
        """Edge of the next event that does not depend on an input change."""
        edges = [self._square.next_edge, *(at for at, _ in self._irq_pending)]
        event = self.core.next_event
        return min(edges if event is None else [*edges, event])

    def run_until(self, t: int) -> None:
        """Run all edges up to and including t."""
        while self._pins["rst_n"] and self._square.next_edge <= t:
            at, level = self._square.next_edge, self._square.next_level
            self._square.advance()
            self.core.pins(at, ext_clk=level)
        self.core.run_until(t)
        self._follow()

    # ------------------------------------------------------------------ pins

    def pins(self, t: int, **levels: int) -> None:
        """Set input levels; edge t is the first edge that samples them.

        Raises ValueError for an unknown pin.
        """
        for pin in levels:
            if pin not in INPUTS:
                raise ValueError(f"no input pin {pin!r}")
        self.run_until(t - 1)
        released = levels.get("rst_n") == 1 and not self._pins["rst_n"]
        reset = levels.get("rst_n") == 0 and self._pins["rst_n"]
        self._pins.update(levels)
        pins = self._pins
        core = {pin: pins[pin] for pin in ("rst_n", *SWITCHES)}
        core |= {"rd_n": pins["ior_n"], "wr_n": pins["iow_n"], "d_i": pins["sd_i"]}
        core |= {"cs_n": int(not self._selected), "a0": pins["sa"] & 1}
        if reset:
            core["ext_clk"] = 0
            self._irq_pending.clear()
        if released:
            self._square.restart(t + self._lag)
        self.core.pins(t, **core)
        self._follow()
        if reset:
            self._irq_pending.clear()
            self.log.set(t, "irq", 0)
        self._drive_bus(t)

    @property
    def _selected(self) -> bool:
        return self._pins["sa"] >> 1 == self._base >> 1 and not self._pins["aen"]

    # ------------------------------------------------------------------ outputs

    def _drive_bus(self, t: int) -> None:
        """Update sd_oe from the current pins and the core (J105-03)."""
        enabled = self.core.log.levels["d_oe"] and self._selected and not self._pins["ior_n"]
        self.log.set(t, "sd_oe", int(bool(enabled)))

    def _follow(self) -> None:
        """Pass new output edges of the core to the pins of the board, in order of time."""
        new_edges = self.core.edges[self._edges_passed :]
        self._edges_passed += len(new_edges)
        for edge in new_edges:
            self._irq_until(edge.t)
            if edge.signal == "d_o":
                self.log.set(edge.t, "sd_o", edge.value)
            elif edge.signal == "d_oe":
                enabled = edge.value and self._selected and not self._pins["ior_n"]
                self.log.set(edge.t, "sd_oe", int(bool(enabled)))
            elif edge.signal == "int_n":
                self._irq_pending.append((edge.t + 1, 1 - edge.value))
            else:
                self.log.set(edge.t, edge.signal, edge.value)
                if edge.signal == "s":
                    self.log.set(edge.t, "drv", edge.value & 0b1111)
        self._irq_until(self.now)

    def _irq_until(self, t: int) -> None:
        """Update irq, which follows int_n by one cycle (J105-05)."""
        while self._irq_pending and self._irq_pending[0][0] <= t:
            at, level = self._irq_pending.pop(0)
            self.log.set(at, "irq", level)

    @property
    def edges(self) -> list[Edge]:
        """All output edges so far, in order of time."""
        return self.log.edges

    @property
    def outputs(self) -> Mapping[str, int]:
        """Output levels after edge `now`."""
        return MappingProxyType(self.log.levels)
