"""Contract of ppmc_i2c_master: times on both lines, compared with the data sheets of the EEPROMs."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from fractions import Fraction
from math import ceil

import cocotb

from ..harness import Block, BlockDriver, rng, same

AREA = "i2c"
NONE, START, STOP, BYTE, FREE = range(5)
CLOCKS = [
    (8_000_000, 400_000),
    (8_727_000, 400_000),  # 0.55 of a bit time is slightly less than 12 cycles
    (8_909_000, 400_000),  # half a bit time is slightly more than 11 cycles
    (11_059_200, 300_000),
    (12_000_000, 400_000),
    (16_000_000, 400_000),
    (25_000_000, 397_000),
    (200_000_000, 400_000),
    (8_000_000, 100_000),
    (8_000_000, 90_000),
]
"""(CLK_HZ, I2C_HZ) of each instance."""
PORTS = (
    "tick_o cmd_i:3:ppmc_i2c_pkg::i2c_cmd_e byte_i:8 ack_i first_o done_o fail_o byte_o:8 nack_o"
    " scl_i sda_i scl_oe_o sda_oe_o"
)
BLOCKS = {
    f"bus{i}": Block("ppmc_i2c_master", PORTS, {"ClkHz": clk, "SclHz": scl})
    for i, (clk, scl) in enumerate(CLOCKS)
}
SHORTEST_NS = {
    "low": (1300, 4700),
    "high": (600, 4000),
    "su_sta": (600, 4700),
    "hd_sta": (600, 4000),
    "su_dat": (100, 250),
    "hd_dat": (0, 0),
    "su_sto": (600, 4000),
    "buf": (1300, 4700),
}
"""Minimum times in ns. The first value is required by the 24LC32A from 2.5 V on (Microchip, table of the AC
characteristics) and by the M24C32 at 400 kHz (ST, the same table); the second value, by the 24AA32A below 2.5
V at 90 kHz.
"""
SENT = (0xA5, 0x3C)
ACCESS_NS = 900
"""Longest time in ns from the fall of SCL until either device outputs its bit; the master samples later."""


@dataclass
class Lines:
    """Levels of both lines over time, and the shortest duration found for each time of the data sheets, in
    cycles.

    The device holds SCL low for `stretch` cycles.
    """

    stretch: int = 0
    t: int = 0
    scl: int = 1
    sda: int = 1
    held: int = 0
    since: dict[str, int] = field(default_factory=dict)
    found: dict[str, int] = field(default_factory=dict)

    def _note(self, name: str, begin: str) -> None:
        if begin in self.since:
            span = self.t - self.since[begin]
            self.found[name] = min(span, self.found.get(name, span))

    def clk(self, scl_oe: int, sda_oe: int) -> tuple[int, int]:
        """Make one clock edge with these output enables of the master (1: pulls low); return the levels of
        both lines.
        """
        self.t += 1
        self.held = max(0, self.held - 1)
        scl, sda = int(not scl_oe and not self.held), int(not sda_oe)
        if sda != self.sda:
            self._data(scl, sda)
        if scl != self.scl:
            if scl:
                self._note("low", "fall")
                if self.since.get("data", -1) >= self.since.get("fall", 0):
                    self._note("su_dat", "data")
                self.since["rise"] = self.t
            else:
                self._note("high", "rise")
                if self.since.get("start", -1) > self.since.get("rise", 0):
                    self._note("hd_sta", "start")
                self.since["fall"] = self.t
                self.held = self.stretch
        self.scl, self.sda = scl, sda
        return scl, sda

    def _data(self, scl: int, sda: int) -> None:
        """Record the meaning of a change of SDA: START, STOP, or a bit while SCL is low."""
        if not (scl and self.scl):
            assert not scl and not self.scl, f"cycle {self.t}: both lines change together"
            self._note("hd_dat", "fall")
            self.since["data"] = self.t
        elif sda:
            self._note("su_sto", "rise")
            self.since["stop"] = self.t
        else:
            self._note("su_sta", "rise")
            self._note("buf", "stop")
            self.since.pop("stop", None)
            self.since["start"] = self.t


def course() -> Iterator[tuple[int, int]]:
    """Yield commands and bytes: transfers with a repeated START, and a START directly after a STOP."""
    for address in (0xA1, 0xA0):
        yield START, 0
        yield BYTE, address
        yield START, 0
        yield BYTE, 0x55
        yield STOP, 0


async def played(dut: object, number: int, stretch: int = 0) -> Lines:
    """Execute the commands of `course` on one instance; return the record of the lines."""
    u = BlockDriver(dut, f"bus{number}", BLOCKS, "done_o scl_oe_o sda_oe_o")
    lines = Lines(stretch)
    await u.reset(scl_i=1, sda_i=1, ack_i=1, cmd_i=NONE)
    delay = [(1, 1)] * 2
    for cmd, byte in course():
        u.put(cmd_i=cmd, byte_i=byte)
        done = 0
        while not done:
            (scl, sda), *delay = delay
            done, scl_oe, sda_oe = await u.clk(scl_i=scl, sda_i=sda)
            delay.append(lines.clk(scl_oe, sda_oe))
    return lines


@cocotb.test()
async def i2c_times_of_the_data_sheets(dut):
    """At each clock frequency, every time on the lines is at least the minimum of the 24LC32A and M24C32, and
    SCL is low for 55 % of the period, exact to the cycle.
    """
    for number, (clk, scl) in enumerate(CLOCKS):
        lines = await played(dut, number)
        found = {name: Fraction(span * 10**9, clk) for name, span in lines.found.items()}
        for name, limits in SHORTEST_NS.items():
            got, shortest = found[name], limits[scl == 90_000]
            assert got >= shortest, f"{clk} Hz, SCL {scl} Hz: {name} {float(got):.1f} ns, want {shortest}"
        low = lines.found["low"]
        assert 0 <= low - Fraction(55 * clk, 100 * scl) < 1, f"{clk} Hz, SCL {scl} Hz: low {low} cycles"


@cocotb.test()
async def i2c_times_with_a_stretched_clock(dut):
    """If a device holds SCL low for any time, SCL is afterwards still high for at least the minimum time."""
    rand = rng()
    for number, (clk, scl) in enumerate(CLOCKS[:6]):
        low = clk * 11 // (scl * 20)
        for stretch in (low, low + 1, rand.randrange(low, 5 * low)):
            lines = await played(dut, number, stretch)
            for name in ("high", "su_sta", "su_sto", "hd_sta"):
                got = Fraction(lines.found[name] * 10**9, clk)
                assert got >= SHORTEST_NS[name][0], f"{clk} Hz, {stretch} cycles: {name} {float(got):.1f} ns"


@cocotb.test()
async def i2c_period(dut):
    """During bytes without a pause, SCL rises once per period, exact to the cycle, without drift."""
    for number, (clk, scl) in enumerate(CLOCKS):
        u = BlockDriver(dut, f"bus{number}", BLOCKS, "done_o scl_oe_o")
        await u.reset(scl_i=1, sda_i=0, ack_i=1, cmd_i=BYTE, byte_i=0)
        rises, before, t = [], 0, 0
        while len(rises) < 30:
            t += 1
            _, pulled = await u.clk()
            if before and not pulled:
                rises.append(t)
            before = pulled
        for n, t in enumerate(rises):
            assert abs(t - rises[0] - n * Fraction(clk, scl)) < 1, f"{clk} Hz: rise {n} after {t - rises[0]}"


@cocotb.test()
async def i2c_access_time(dut):
    """The master receives the bits of a device with the longest access time of the data sheets."""
    for number, (clk, _) in enumerate(CLOCKS[:7]):
        u = BlockDriver(dut, f"bus{number}", BLOCKS, "done_o scl_oe_o")
        await u.reset(scl_i=1, sda_i=1, ack_i=1, cmd_i=BYTE, byte_i=0xFF)
        late = ceil(Fraction(ACCESS_NS * clk, 10**9))
        levels = [int(bit) for byte in SENT for bit in f"{byte:08b}1"]
        before = waits = 0
        sda = expected = 1
        for byte in SENT:
            done = 0
            while not done:
                done, pulled = await u.clk(scl_i=int(not before), sda_i=sda)
                if pulled and not before:
                    waits, expected = late, levels.pop(0) if levels else 1
                elif waits:
                    waits -= 1
                    sda = sda if waits else expected
                before = pulled
            same(f"{clk} Hz: byte", u.get("byte_o"), byte)
