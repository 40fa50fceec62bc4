"""Constrained-random hosts of the PPMC-104: a seed determines a list of actions before the simulation starts.

`scenario(seed)` is a pure function: the same seed returns the same configuration and the same actions.
`random_player` executes the list on a test bench. The actions are those of `harness.player`, and in addition
("finish", cycles).
"""

from __future__ import annotations

from cocotb_tests.harness import D11, D16, F8, F11, F16, F25, F50, F100, Config
from cocotb_tests.harness.config import D25X8
from cocotb_tests.harness.player import ExternalClock, Scenario, random_clock
from cocotb_tests.harness.random_host import HostWriter

# Builds of the random tests with their weights. Few seeds use DATASHEET, because these runs are long.
WEIGHTS: list[tuple[Config, int]] = [(F16, 30), (F8, 12), (F11, 16), (F25, 10), (F50, 10), (F100, 8)]
DATASHEET_WEIGHTS: list[tuple[Config, int]] = [(D16, 7), (D11, 4), (D25X8, 3)]

OPERATIONS = (0x42, 0x43, 0x43, 0x43, 0x44, 0x44, 0x45, 0x46, 0x47, 0xC3, 0xC3, 0xC6)
INIT_CODES = [c | s << 5 | ck << 4 | lo << 3 | e << 2 for c in (1, 2, 3) for s in (0, 1) for ck in (0, 1)
              for lo in (0, 1) for e in (0, 1)]  # fmt: skip
LIMIT_PINS = ("l1_n", "l2_n", "l3_n", "l4_n", "alm_n", "cnp_n")
CLOCK_PERIODS = (16, 20, 33, 64, 100, 119, 120, 121, 128, 135, 136, 137, 144, 160, 320)
READS = ((0x80, 1), (0x81, 1), (0x82, 1), (0x83, 3), (0x85, 1))


def scenario(seed: int) -> Scenario:
    """Return the scenario of a seed (any int)."""
    return _Writer(seed).make()


class _Writer(HostWriter):
    """Creates one scenario. A single generator makes all random decisions, in a fixed order."""

    def __init__(self, seed: int) -> None:
        super().__init__("ppmc104", seed, WEIGHTS, DATASHEET_WEIGHTS)

    # ------------------------------------------------------------ top level

    def make(self) -> Scenario:
        rng = self.rng
        if rng.random() < 0.25:
            for _ in range(rng.randint(1, 4)):
                self.any_bytes()
        self.init(first=True)
        for _ in range(rng.randint(5, 14) if not self.config.datasheet else rng.randint(2, 6)):
            rng.choices(
                (self.operation, self.read, self.switching, self.any_bytes, self.aux, self.init_again,
                 self.select_pins, self.reset, self.overrun, self.bad_strobes, self.excitation_off),
                (60, 10, 6, 8, 5, 5, 5, 2, 5, 3, 2),
            )[0]()  # fmt: skip
        self.add("finish", self.limit_clk)
        for code, count in ((0x80, 1), (0x83, 3), (0x82, 1), (0x80, 1)):
            self.add("fetch", code, count)
        self.add("wait", rng.choice((50, 3_000)))
        if rng.random() < 0.03 and not self.external and self.config.clk_hz <= 16_000_000:
            self.add("wait", self.config.cyc(544_000))  # long enough for the hold timer to expire
        pins = {}
        if rng.random() < 0.4:
            pins = {"csel": rng.getrandbits(1), "vsel": rng.getrandbits(1), "auxi": rng.getrandbits(4)}
        return Scenario(
            self.seed, self.config, pins, self.actions, (self.clock(),), rng.random() < 0.5, self.limit_clk
        )

    def clock(self) -> ExternalClock:
        """Return the segments of the clock pin, if this host uses it."""
        return random_clock(self.rng, self.scale, CLOCK_PERIODS) if self.external else ExternalClock()

    # ------------------------------------------------------------ set-up commands

    def ramp(self) -> tuple[int, int, int]:
        """Return a legal (RL, RH, PA); most are small, so that their tables are built quickly."""
        rng = self.rng
        kind = rng.random()
        if kind < 0.65:
            rl = rng.choice((3, 5, 9, 12, 19, 25))
            return rl, rng.randint(0, rl), rng.choice((4, 4, 5, 6, 8, 10, 15))
        if kind < 0.75:
            rate = rng.randint(0, 12)
            return rate, rate, rng.randint(4, 12)
        if kind < 0.9:
            rl = rng.randint(1, 60)
            return rl, rng.randint(0, rl), rng.randint(4, 60)
        if self.config.datasheet:
            return rng.choice(((255, 0, 4), (4, 0, 8)))
        return rng.choice(
            ((255, 0, 4), (255, 0, 11220), (255, 254, 11220), (1, 0, 4), (40, 0, 1000), (4, 0, 8))
        )

    def init_code(self) -> int:
        code = self.rng.choice(INIT_CODES)
        return code | 0x10 if self.external and self.rng.random() < 0.8 else code & ~0x10

    def init(self, first: bool = False) -> None:
        rng = self.rng
        rl, rh, pa = self.ramp()
        if rng.random() < (0.08 if first else 0.3):
            rl, rh, pa = rng.choice(((5, 6, 100), (9, 4, 3), (9, 4, 11221), (5, 6, 0xFFFF), (0, 255, 0)))
        data = [rl, rh, pa & 0xFF, pa >> 8]
        if rng.random() < 0.8:
            self.add("send", self.init_code(), data)
        else:
            self.blind([(1, self.init_code()), *((0, byte) for byte in data)])
        if rng.random() < 0.3:  # send bytes during the table build
            self.blind([self.random_write() for _ in range(rng.randint(1, 3))])
        if rng.random() < 0.3:
            self.add("wait", self.clk(100, 6_000))

    def init_again(self) -> None:
        self.init()

    def switching(self) -> None:
        rng = self.rng
        values = [rng.choice((0, 1, 3, 16, 255)), rng.choice((0, 1, 3, 32, 255))]
        self.add("send", 0x84, values[: rng.choice((2, 2, 2, 1))])
        self.add("wait", self.clk(100, 8_000))

    def aux(self) -> None:
        rng = self.rng
        if rng.random() < 0.5:
            self.add("send", rng.choice((0xC1, 0xC2, 0xF9, 0xD2, 0xE1)), [])
        else:
            self.add("send", 0x86, [rng.getrandbits(8)])

    def excitation_off(self) -> None:
        rng = self.rng
        self.add("send", rng.choice((0xC0, 0xF8, 0xD0)), [])
        if rng.random() < 0.5:
            self.aux()
        if rng.random() < 0.8:
            self.init()

    # ------------------------------------------------------------ operations

    def operation(self) -> None:
        rng = self.rng
        code = (
            rng.choice(OPERATIONS)
            | rng.getrandbits(1) << 3
            | (rng.random() < 0.3) << 4
            | rng.getrandbits(1) << 5
        )
        if rng.random() < 0.12:
            self.add("pins", {rng.choice(LIMIT_PINS): 0})
        data = self.parameters(code)
        if rng.random() < 0.85:
            self.add("send", code, data)
        else:
            self.blind([(1, code), *((0, byte) for byte in data)])
        for _ in range(rng.choice((0, 0, 0, 1, 1, 2, 3, 5))):
            self.disturb()
        if rng.random() < 0.9:
            self.add("finish", self.limit_clk)
            if rng.random() < 0.3:
                self.add("wait", self.clk(1, 6_000))
            if rng.random() < 0.5:
                self.add("fetch", 0x80, 1)
        if rng.random() < 0.75:
            self.add("pins", dict.fromkeys(LIMIT_PINS, 1))

    def parameters(self, code: int) -> list[int]:
        """Return the data bytes of an operation: short moves, small rates, in some cases too few or too many
        bytes.
        """
        rng, kind = self.rng, code & 7
        n = rng.choice((1, 1, 2, 3, 4, 5, 7, 8, 9, 10, 13, 21, 22, 30, 60, 1000))
        if rng.random() < 0.02:
            n = rng.choice((1 << 24, 1 << 16, 257))
        d = n - 1
        rate = rng.choice((0, 0, 1, 2, 3, 4, 7, 9, 15, 30))
        count = [d & 0xFF, d >> 8 & 0xFF, d >> 16]
        data = {3: count, 4: [rate, *count], 5: [rate], 7: [rate]}.get(kind, [])
        if rng.random() < 0.04:
            data = data[:-1] if rng.random() < 0.5 else [*data, rng.getrandbits(8)]
        return data

    def disturb(self) -> None:
        """Add an action that takes place during a motion."""
        rng = self.rng
        self.add("wait", self.clk(1, 4_000))
        rng.choices(
            (
                lambda: self.add("write", 1, 0x40 | rng.getrandbits(3) << 3, 2, 2),
                lambda: self.add("write", 1, 0x41 | rng.getrandbits(3) << 3, 2, 2),
                lambda: self.add("blip", rng.choice(LIMIT_PINS), 0, self.clk(2, 3_000)),
                lambda: self.add("pins", {rng.choice(LIMIT_PINS): rng.getrandbits(1)}),
                self.aux,
                self.select_pins,
                self.any_bytes,
                lambda: self.add("status", rng.randint(1, 5)),
                lambda: self.add("read"),
                lambda: self.add("write", 1, 0xC0, 2, 2),
                self.reset,
            ),
            (14, 22, 14, 8, 8, 6, 10, 6, 4, 3, 1),
        )[0]()

    # ------------------------------------------------------------ reads, pins, bad input

    def read(self) -> None:
        rng = self.rng
        for _ in range(rng.randint(1, 3)):
            code, count = rng.choice(READS)
            self.add("fetch", code, rng.choice((count, count, 1, 0, count + 1)))

    def select_pins(self) -> None:
        rng = self.rng
        pin = rng.choice(("csel", "vsel", "auxi", "csel", "vsel"))
        self.add("pins", {pin: rng.getrandbits(4 if pin == "auxi" else 1)})

    def random_write(self) -> tuple[int, int]:
        rng = self.rng
        known = (
            0x40,
            0x41,
            0x42,
            0x43,
            0x44,
            0x80,
            0x81,
            0x83,
            0x84,
            0x86,
            0x0A,
            0x2F,
            0xC1,
            0xC2,
            0x87,
            0x30,
            0xC4,
        )
        return (1, rng.choice(known)) if rng.random() < 0.5 else (rng.getrandbits(1), rng.getrandbits(8))

    def bad_strobes(self) -> None:
        self.bad_bus((0xC1, 0xC2, 0x87, 0x80, 0x11))

    def reset(self) -> None:
        rng = self.rng
        self.add("reset", rng.randint(2, 20))
        if rng.random() < 0.8:
            self.init()
