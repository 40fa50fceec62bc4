"""Constrained-random hosts of the PPMC-2104AFP: a seed determines a list of actions before the simulation
starts.

`scenario(seed)` is a pure function: the same seed returns the same configuration and the same actions.
`random_player` executes the list on a test bench. The actions are those of `harness.player`, and in addition
("finish", [axes], cycles). `random_codes` creates the instructions and their data.
"""

from __future__ import annotations

from cocotb_tests.harness import D11, D16, F8, F11, F16, F25, F50, F100, Config
from cocotb_tests.harness.config import D25X8
from cocotb_tests.harness.player import ExternalClock, Scenario, random_clock
from cocotb_tests.harness.random_host import HostWriter
from cocotb_tests.ppmc2104.random_codes import KNOWN_CODES, Codes

# Builds of the random tests with their weights. Few seeds use DATASHEET, because these runs are long.
WEIGHTS: list[tuple[Config, int]] = [(F16, 30), (F8, 12), (F11, 16), (F25, 10), (F50, 10), (F100, 8)]
DATASHEET_WEIGHTS: list[tuple[Config, int]] = [(D16, 7), (D11, 4), (D25X8, 3)]

SWITCHES = ("fl_n", "bl_n", "fhl_n", "bhl_n", "alm_n", "org_n")
CLOCK_PERIODS = (16, 20, 33, 64, 100, 127, 128, 129, 144, 160, 320)
READS = ((0x80, 1), (0x81, 1), (0x82, 1), (0x83, 3), (0x86, 1), (0x86, 1))


def scenario(seed: int) -> Scenario:
    """Return the scenario of a seed (any int)."""
    return _Writer(seed).make()


class _Writer(HostWriter):
    """Creates one scenario. A single generator makes all random decisions, in a fixed order."""

    def __init__(self, seed: int) -> None:
        super().__init__("ppmc2104", seed, WEIGHTS, DATASHEET_WEIGHTS, external=(0.25, 0.25))
        one, two = self.externals
        self.codes = Codes(self.rng, self.config.datasheet, (one, two))
        self.set_up: set[int] = set()
        self.moving = 1

    # ------------------------------------------------------------ top level

    def make(self) -> Scenario:
        rng = self.rng
        if rng.random() < 0.2:
            self.any_bytes()
        axes = rng.choice(([1, 2], [2, 1], [1, 2], [1, 2], [1], [2]))
        for axis in axes:
            self.setting(axis, first=True)
        for _ in range(rng.randint(5, 13) if not self.config.datasheet else rng.randint(2, 5)):
            rng.choices(
                (self.operation, self.pair, self.read, self.switching, self.hold_delay, self.any_bytes,
                 self.aux, self.set_again, self.select_pins, self.reset, self.overrun, self.bad_strobes,
                 self.excitation_off, self.half_instruction),
                (45, 18, 10, 5, 4, 7, 4, 5, 5, 2, 5, 3, 2, 4),
            )[0]()  # fmt: skip
        self.release()
        self.add("finish", [1, 2], self.limit_clk)
        for base in (0, 0x20):
            for code, count in ((0x80, 1), (0x83, 3), (0x82, 1), (0x86, 1), (0x80, 1)):
                self.add("fetch", base | code, count)
        self.add("wait", rng.choice((50, 3_000)))
        if rng.random() < 0.05 and self.config.clk_hz <= 16_000_000:
            self.add("wait", self.config.cyc(2048 * 26))  # long enough for the hold timers to expire
        return Scenario(
            self.seed, self.config, self.first_pins(), self.actions, self.clocks(),
            rng.random() < 0.5, self.limit_clk,
        )  # fmt: skip

    def first_pins(self) -> dict[str, int]:
        rng = self.rng
        pins = {"busc": rng.getrandbits(1), "errint_n": rng.getrandbits(1)}
        if rng.random() < 0.4:
            pins |= {"csel": rng.getrandbits(2), "auxi": rng.getrandbits(2)}
        return pins

    def clocks(self) -> tuple[ExternalClock, ExternalClock]:
        """Return the segments of the external clocks: constant, with jitter, or with stops."""
        one, two = (
            random_clock(self.rng, self.scale, CLOCK_PERIODS) if external else ExternalClock()
            for external in self.externals
        )
        return one, two

    def axis(self) -> int:
        return self.rng.choice((1, 2))

    def near(self) -> int:
        """Return an axis: in most cases the axis that was started last."""
        return self.moving if self.rng.random() < 0.75 else self.axis()

    def switch(self, axis: int) -> str:
        return f"{self.rng.choice(SWITCHES)}[{axis}]"

    # ------------------------------------------------------------ instructions without motion

    def setting(self, axis: int, first: bool = False) -> None:
        rng = self.rng
        self.set_up.add(axis)
        code, data = self.codes.setting(axis, wrong=0.08 if first else 0.3)
        self.send_command(code, data, 0.8)
        if rng.random() < 0.3:  # send bytes during the table build
            self.blind([self.random_write() for _ in range(rng.randint(1, 3))])
        if rng.random() < 0.3:
            self.add("wait", self.clk(100, 6_000))

    def set_again(self) -> None:
        self.setting(self.axis())

    def switching(self) -> None:
        rng = self.rng
        values = [rng.choice((0x40, 0x40, 0x53, 0x7F, 0xFF, 0x3F)) for _ in range(2)]
        self.add("send", 0x84 | rng.choice((0, 0x20)), values[: rng.choice((2, 2, 2, 1))])
        self.add("wait", self.clk(100, 8_000))

    def hold_delay(self) -> None:
        self.add("send", 0x85 | self.rng.choice((0, 0x20)), [self.rng.choice((0, 0, 1, 2, 0x18))])

    def aux(self) -> None:
        self.add("send", self.rng.choice((0xC1, 0xD1, 0xE1, 0xF1)), [])

    def excitation_off(self) -> None:
        axis = self.axis()
        self.add("send", 0xC0 | (axis - 1) << 5, [])
        self.set_up.discard(axis)
        if self.rng.random() < 0.8:
            self.setting(axis)

    def half_instruction(self) -> None:
        """Send an instruction without its last data byte, then another code, in many cases a stop of a moving
        axis.
        """
        code, data = self.codes.operation(self.axis())
        self.blind([(1, code), *((0, byte) for byte in data[:-1])])
        if self.rng.random() < 0.6:
            self.add("send", self.rng.choice((0x40, 0x41, 0x60, 0x61)), [])

    def read(self) -> None:
        rng = self.rng
        for _ in range(rng.randint(1, 3)):
            code, count = rng.choice((*READS, (0xC2, 1)))
            code |= rng.choice((0, 0x20)) if code != 0xC2 else 0
            self.add("fetch", code, rng.choice((count, count, 1, 0, count + 1)))

    # ------------------------------------------------------------ operations

    def operation(self) -> None:
        rng, axis = self.rng, self.axis()
        if rng.random() < 0.12:
            self.add("pins", {self.switch(axis): 0})
        if rng.random() < 0.2:
            self.add("pins", {f"run[{axis}]": 0})
        self.start(axis)
        self.disturbances()
        if rng.random() < 0.5:
            self.start(3 - axis)
            self.disturbances()
        self.ended([axis] if rng.random() < 0.4 else [1, 2])

    def pair(self) -> None:
        """Start both axes, either released together by RUN or one directly after the other."""
        rng = self.rng
        gated = rng.random() < 0.6
        if gated:
            self.add("pins", {"run": 0})
        for axis in rng.sample((1, 2), 2):
            self.start(axis)
        if gated:
            self.disturbances(2)
            self.add("pins", {"run": rng.choice((3, 3, 3, 1, 2))})
        self.disturbances()
        self.ended([1, 2])

    def start(self, axis: int) -> None:
        self.moving = axis
        if axis not in self.set_up and self.rng.random() < 0.7:
            self.setting(axis)
        code, data = self.codes.operation(axis)
        self.send_command(code, data, 0.85)

    def ended(self, axes: list[int]) -> None:
        rng = self.rng
        if rng.random() < 0.7:
            self.add("pins", {"run": 3})
        if rng.random() < 0.9:
            self.add("finish", axes, self.limit_clk)
            if rng.random() < 0.3:
                self.add("wait", self.clk(1, 6_000))
            if rng.random() < 0.5:
                self.add("fetch", rng.choice((0x80, 0xA0)), 1)
        if rng.random() < 0.75:
            self.release()

    def release(self) -> None:
        """Set all switches to their idle levels and RUN of both axes to 1."""
        self.add("pins", {**dict.fromkeys(SWITCHES, 3), "run": 3})

    def disturbances(self, most: int = 5) -> None:
        for _ in range(min(most, self.rng.choice((0, 0, 0, 1, 1, 2, 3, 5)))):
            self.disturb()

    def disturb(self) -> None:
        """Add an action that takes place during a motion."""
        rng = self.rng
        self.add("wait", self.clk(1, 4_000))
        rng.choices(
            (
                lambda: self.add("write", 1, 0x40 | rng.randrange(4) << 3 | (self.near() - 1) << 5, 2, 2),
                lambda: self.add("write", 1, 0x41 | rng.randrange(4) << 3 | (self.near() - 1) << 5, 2, 2),
                lambda: self.add("blip", self.switch(self.near()), 0, self.clk(2, 3_000)),
                lambda: self.add("pins", {self.switch(self.near()): rng.getrandbits(1)}),
                lambda: self.add("blip", f"{self.slow()}[{self.near()}]", 0, self.clk(2, 3_000)),
                lambda: self.add("blip", f"run[{self.near()}]", 0, self.clk(2, 500)),
                self.aux,
                self.select_pins,
                self.any_bytes,
                lambda: self.add("status", rng.randint(1, 5)),
                lambda: self.add("read"),
                lambda: self.add("fetch", rng.choice((0x86, 0xA6, 0xC2)), rng.choice((1, 1, 0))),
                lambda: self.add("write", 1, rng.choice((0xC0, 0xE0)), 2, 2),
                self.read,
                self.reset,
            ),
            (8, 26, 12, 6, 12, 4, 6, 6, 7, 6, 4, 5, 2, 4, 1),
        )[0]()

    def slow(self) -> str:
        return self.rng.choice(("fhl_n", "bhl_n"))

    # ------------------------------------------------------------ pins, bad input

    def select_pins(self) -> None:
        rng = self.rng
        pin = rng.choice(("csel[1]", "csel[2]", "auxi", "errint_n", "errint_n"))
        self.add("pins", {pin: rng.getrandbits(2 if pin == "auxi" else 1)})

    def random_write(self) -> tuple[int, int]:
        rng = self.rng
        if rng.random() < 0.5:
            return 1, rng.choice(KNOWN_CODES) | rng.choice((0, 0x20))
        return rng.getrandbits(1), rng.getrandbits(8)

    def bad_strobes(self) -> None:
        """Add an illegal access: both strobes, a strobe that cs_n ends, or a change of direction
        (P2104-BAD-11..13).
        """
        rng = self.rng
        byte, reg = rng.choice((0xC1, 0xD1, 0x87, 0xA7, 0x80, 0x11)), rng.getrandbits(1)
        on = {"cs_n": 0, "a0": reg, "d_i": byte}
        off = {"cs_n": 1, "ds_wrs_n": 1, "rw_rds_n": 1}
        steps = rng.choice(
            (
                [({**on, "ds_wrs_n": 0, "rw_rds_n": 0}, rng.randint(2, 10)), (off, 3)],
                [({**on, "ds_wrs_n": 0, "rw_rds_n": 1}, 3), ({"rw_rds_n": 0}, 3), (off, 4)],
                [({**on, "ds_wrs_n": 0, "rw_rds_n": 0}, 3), ({"rw_rds_n": 1}, 3), (off, 4)],
                [({**on, "ds_wrs_n": 0}, 3), ({"cs_n": 1}, 3), (off, 3)],
                [({**on, "rw_rds_n": 0}, 4), ({"ds_wrs_n": 0}, 3), (off, 4)],
                [({**on, "rw_rds_n": 0}, 5), ({"cs_n": 1}, 3), (off, 3)],
                [({"ds_wrs_n": 0, "d_i": byte}, 4), (off, 3)],
            )
        )
        self.add("raw", steps)

    def reset(self) -> None:
        self.add("reset", self.rng.randint(2, 20))
        self.set_up.clear()
        if self.rng.random() < 0.8:
            self.setting(self.axis())
