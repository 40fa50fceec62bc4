"""A polling host on the pins of the STMC model, with a square wave on `ext_clk`."""

from __future__ import annotations

from openppmc.model.chip import Square
from openppmc.model.stmc.part import Stmc
from tests.common.model.host import ModelHost

# Period of the external clock in cycles, as in the acceptance checks.
EXT16 = 16
TICK = 1280
SWITCHES = ("l1_n", "l2_n", "l3_n", "l4_n", "cnp_n", "mon")


def init(code: int, d1: int, d2: int, pa: int) -> str:
    """Return the script of an initialisation with these values."""
    return f"c {code:02X} d {d1:02X} d {d2:02X} d {pa & 0xFF:02X} d {pa >> 8:02X} "


def count(value: int) -> str:
    """Return the script of three data bytes, low byte first."""
    return " ".join(f"d {byte:02X}" for byte in value.to_bytes(3, "little")) + " "


STANDARD = init(0x1A, 20, 5, 8)
INTERNAL = init(0x0A, 20, 5, 8)


class Clocked(Stmc):
    """The model with a free-running external clock; with `ext` = 0 the pin is not driven."""

    def __init__(self, ext: int = EXT16, **parameters: object) -> None:
        super().__init__(**parameters)
        self.square = Square(2 * ext, 2) if ext else None

    @property
    def next_event(self) -> int | None:
        event = super().next_event
        if self.square is None:
            return event
        return self.square.next_edge if event is None else min(event, self.square.next_edge)

    def run_until(self, t: int) -> None:
        while self.square and self.square.next_edge <= t:
            at, level = self.square.next_edge, self.square.next_level
            self.square.advance()
            self.pins(at, ext_clk=level)
        super().run_until(t)


class Host(ModelHost):
    """`ModelHost` of the STMC; it runs its script when it is created.

    Scripts may also contain idle (wait until BUSY = 0).
    """

    MODEL = Clocked

    def __init__(self, script: str = STANDARD, **parameters: object) -> None:
        super().__init__(**parameters)
        self.run(script)

    def run(self, script: str) -> list[int]:
        """Run a script; return the bytes that r reads."""
        got = []
        for part in script.replace("idle", "|idle|").split("|"):
            if part == "idle":
                self.idle()
            else:
                got += super().run(part)
        return got

    def start(self, script: str) -> None:
        """Send a motion command; later calls count the steps from here on."""
        mark = self.t
        self.run(script)
        self.mark = mark

    def move(self, script: str) -> tuple[int, int]:
        """Send a motion command and wait for its end; return FIN and REM."""
        self.start(script)
        return self.finish()

    def pulses(self) -> list[int]:
        """Return the edges of the steps since `mark`; each change of `s` is a step."""
        return [t for t, _ in self.model.log.of("s", self.mark)]

    def gaps(self, tick: int = EXT16) -> list[int]:
        """Return the gaps since `mark` in ticks of `tick` cycles, rounded, because edges of the external
        clock may deviate by one cycle.
        """
        return [round(gap / tick) for gap in self.intervals()]

    def in_gap(self, i: int, after: int = 40) -> None:
        """Run to `after` cycles after step i, which begins gap i."""
        self.fall(i + 1, after)

    def finish(self) -> tuple[int, int]:
        """Wait for the end of the motion; return FIN and REM, read as a host does."""
        self.idle()
        mark = self.mark
        (status,) = self.run("c 80 r")
        low, mid, high = self.run("c 83 rrr")
        self.mark = mark
        return status, low | mid << 8 | high << 16

    def blip(self, clocks: int, **levels: int) -> None:
        """Set levels for `clocks` cycles, then the idle levels."""
        self.pins(**levels)
        self.pause(clocks - 1)
        self.pins(**{pin: self.model.INPUTS[pin] for pin in levels})

    def phases(self) -> list[str]:
        """Return the levels of `s` since `mark`."""
        return [f"{value:05b}" for _, value in self.model.log.of("s", self.mark)]

    def status(self) -> int:
        """Read the status."""
        return self.read(1)
