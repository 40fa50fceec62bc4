"""Constrained-random hosts of the STMC core: a seed determines a list of actions before the simulation
starts.

`scenario(seed)` is a pure function. The actions are those of `harness.player`, and in addition ("finish",
cycles). Gaps last at least 64 cycles, so that every rule is exact (STMC-CLK-04).
"""

from __future__ import annotations

from cocotb_tests.harness import D16, F16, Config
from cocotb_tests.harness.config import D25X8
from cocotb_tests.harness.player import ExternalClock, Scenario, random_clock
from cocotb_tests.harness.random_host import HostWriter

from .expected_timing import F8X20, F12, F200, ODD, SHEET, SWITCHES

# Builds of the random tests with their weights. Few seeds use DATASHEET, because these runs are long.
WEIGHTS: list[tuple[Config, int]] = [
    (F16, 34), (F12, 14), (F8X20, 14), (ODD, 14), (SHEET, 16), (F200, 4),
]  # fmt: skip
DATASHEET_WEIGHTS: list[tuple[Config, int]] = [(D16, 8), (D25X8, 4)]

MOTIONS = (0x42, 0x43, 0x43, 0x43, 0x43, 0x44, 0x44, 0x45, 0x46, 0x46, 0x47)
INIT_CODES = tuple(code for code in range(0x40) if code & 3)
WRONG = ((0, 0, 5), (5, 6, 100), (5, 0, 0xFFFF), (0, 255, 0), (254, 255, 4))
KNOWN = (
    0x40, 0x41, 0x42, 0x43, 0x44, 0x45, 0x47, 0x79, 0x80, 0x81, 0x82, 0x83, 0x84, 0x0A, 0x1F, 0x30, 0x85,
    0xC1,
)  # fmt: skip
COUNTS = (1, 1, 2, 3, 4, 5, 7, 8, 9, 10, 12, 13, 17, 22, 30, 60, 1000)
READS = ((0x80, 1), (0x81, 1), (0x82, 1), (0x83, 3), (0x84, 3))


def scenario(seed: int) -> Scenario:
    """Return the scenario of a seed (any int)."""
    return _Writer(seed).make()


class _Writer(HostWriter):
    """Creates one scenario. `least` is the minimum divisor for which gaps are long enough for the clock."""

    def __init__(self, seed: int) -> None:
        super().__init__("stmc", seed, WEIGHTS, DATASHEET_WEIGHTS, external=(0.75,))
        self.fast = self.external and self.rng.random() < 0.6
        self.least = 4 if self.fast else 1

    # ------------------------------------------------------------ top level

    def make(self) -> Scenario:
        rng = self.rng
        if rng.random() < 0.25:
            self.any_bytes()
        self.init(first=True)
        for _ in range(rng.randint(5, 14) if not self.config.datasheet else rng.randint(2, 6)):
            rng.choices(
                (self.motion, self.read, self.any_bytes, self.init, self.reset, self.overrun,
                 self.bad_strobes, self.half_command, self.pause),
                (60, 10, 8, 6, 2, 5, 3, 4, 5),
            )[0]()  # fmt: skip
        self.add("pins", dict.fromkeys(SWITCHES, 1))
        self.add("finish", self.limit_clk)
        for code, count in ((0x80, 1), (0x84, 3), (0x83, 3), (0x82, 1), (0x81, 1)):
            self.add("fetch", code, count)
        self.add("wait", rng.choice((50, 3_000)))
        if rng.random() < 0.05 and self.config.clk_hz <= 16_000_000:
            self.add("wait", self.config.cyc(546_000))  # long enough for the hold timer to expire
        pins = {rng.choice(SWITCHES): 0} if rng.random() < 0.15 else {}
        return Scenario(
            self.seed, self.config, pins, self.actions, (self.clock(),), rng.random() < 0.5, self.limit_clk
        )

    def clock(self) -> ExternalClock:
        """Return the segments of the clock pin, if this host uses it; times are in cycles."""
        if not self.external:
            return ExternalClock()
        near = (20, 24, 33, 40, 64) if self.fast else (70, 80, 100, 128, 320)
        return random_clock(self.rng, 1.0, near)

    # ------------------------------------------------------------ commands without motion

    def ramp(self) -> tuple[int, int, int]:
        """Return a legal (D1, D2, PA); most are small, so that their tables are built quickly."""
        rng, least = self.rng, self.least
        kind = rng.random()
        slow = (5, 6, 10, 13, 20, 26) if self.external else (1, 2, 3, 4, 6)
        if kind < 0.6:
            d1 = rng.choice(slow)
            return d1, rng.randint(min(least, d1), d1), rng.choice((1, 2, 3, 4, 4, 5, 6, 8, 10, 15))
        if kind < 0.7:  # a flat ramp: equal divisors, or no ramp steps
            d1 = rng.choice(slow)
            return (d1, d1, rng.choice((0, 1, 50))) if rng.random() < 0.5 else (d1, min(least, d1), 0)
        if kind < 0.8:  # the ramp begins flat: several levels have the divisor D1
            d1 = rng.choice(slow) + least + 1
            return d1, d1 - 1, rng.randint(3, 24)
        if kind < 0.92 or self.config.datasheet:
            d1 = rng.randint(least, 60)
            return d1, rng.randint(least, d1), rng.randint(0, 60)
        return rng.choice(
            ((255, least, 4), (255, least, 65535), (255, 254, 65535), (5, 4, 1), (40, least, 1000))
        )

    def init(self, first: bool = False) -> None:
        rng = self.rng
        d1, d2, pa = rng.choice(WRONG) if rng.random() < (0.06 if first else 0.3) else self.ramp()
        code = rng.choice(INIT_CODES)
        code = code | 0x10 if self.external and rng.random() < 0.9 else code & ~0x10
        self.send_command(code, [d1, d2, pa & 0xFF, pa >> 8], 0.8)
        if rng.random() < 0.3:  # send bytes during the table build
            self.blind([self.random_write() for _ in range(rng.randint(1, 3))])
        if rng.random() < 0.3:
            self.add("wait", self.clk(100, 6_000))

    def read(self) -> None:
        rng = self.rng
        for _ in range(rng.randint(1, 3)):
            code, count = rng.choice(READS)
            self.add("fetch", code, rng.choice((count, count, 1, 0, count + 1)))

    def pause(self) -> None:
        """Wait long enough for several phases of the chopper."""
        self.add("wait", self.clk(100, 9_000))

    def half_command(self) -> None:
        """Omit the last data byte before the next command."""
        code, data = self.motion_bytes()
        self.blind([(1, code), *((0, byte) for byte in data[:-1])])
        if self.rng.random() < 0.5:
            self.add("send", self.rng.choice((0x40, 0x42, 0x80, 0x85)), [])

    # ------------------------------------------------------------ motions

    def motion_bytes(self) -> tuple[int, list[int]]:
        """Return a motion command: short moves, small divisors, in some cases too few or too many data
        bytes.
        """
        rng = self.rng
        code = (
            rng.choice(MOTIONS)
            | rng.getrandbits(1) << 3
            | (rng.random() < 0.3) << 4
            | rng.getrandbits(1) << 5
        )
        d = rng.choice(COUNTS) - 1
        if rng.random() < 0.02:
            d = rng.choice((1 << 24, 1 << 16, 257)) - 1
        divisor = rng.choice((1, 2, 3, 4, 5, 8, 10, 16, 31))
        divisor = 0 if rng.random() < 0.04 else max(self.least, divisor)
        count = [d & 0xFF, d >> 8 & 0xFF, d >> 16]
        data = {3: count, 4: [divisor, *count], 5: [divisor], 7: [divisor]}.get(code & 7, [])
        if rng.random() < 0.04:
            data = data[:-1] if rng.random() < 0.5 else [*data, rng.getrandbits(8)]
        return code, data

    def motion(self) -> None:
        rng = self.rng
        if rng.random() < 0.12:
            self.add("pins", {rng.choice(SWITCHES): 0})
        self.send_command(*self.motion_bytes(), 0.85)
        for _ in range(rng.choice((0, 0, 0, 1, 1, 2, 3, 5))):
            self.disturb()
        if rng.random() < 0.9:
            self.add("finish", self.limit_clk)
            if rng.random() < 0.3:
                self.add("wait", self.clk(1, 6_000))
            if rng.random() < 0.5:
                self.add("fetch", 0x80, 1)
        if rng.random() < 0.75:
            self.add("pins", dict.fromkeys(SWITCHES, 1))

    def disturb(self) -> None:
        """Add an action that takes place during a motion."""
        rng = self.rng
        self.add("wait", self.clk(1, 4_000 if self.external else 12_000))
        rng.choices(
            (
                lambda: self.add("write", 1, 0x40 | rng.getrandbits(3) << 3, 2, 2),
                lambda: self.add("write", 1, 0x41 | rng.getrandbits(3) << 3, 2, 2),
                lambda: self.add("blip", rng.choice(SWITCHES), 0, self.clk(2, 3_000)),
                lambda: self.add("blip", rng.choice(("l3_n", "l4_n")), 0, self.clk(2, 3_000)),
                lambda: self.add("pins", {rng.choice(SWITCHES): rng.getrandbits(1)}),
                self.any_bytes,
                lambda: self.add("status", rng.randint(1, 5)),
                lambda: self.add("read"),
                self.read,
                self.reset,
            ),
            (10, 24, 12, 14, 8, 10, 6, 4, 4, 1),
        )[0]()

    # ------------------------------------------------------------ bad input

    def random_write(self) -> tuple[int, int]:
        """Return the register and the byte of a write. If the byte is used as a divisor, a constant-speed
        motion is not too fast for the clock.
        """
        rng = self.rng
        if rng.random() < 0.5:
            return 1, rng.choice(KNOWN)
        reg, byte = rng.getrandbits(1), rng.getrandbits(8)
        return reg, byte if reg else max(self.least, byte) * (rng.random() > 0.05)

    def bad_strobes(self) -> None:
        self.bad_bus((0xC1, 0x42, 0x87, 0x80, 0x1A))

    def reset(self) -> None:
        rng = self.rng
        self.add("reset", rng.randint(2, 20))
        if rng.random() < 0.8:
            self.init()
