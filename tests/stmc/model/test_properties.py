"""Invariants of the golden models of the STMC and its board, with random hosts, switches and clocks."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from cocotb_tests.harness import verifies
from openppmc.model.chip import Square
from openppmc.model.motion.ramp import profile_index
from openppmc.model.stmc.part import Stmc
from openppmc.model.stmc.pc104_board import J105Stmc
from tests.stmc.model.host import EXT16, INTERNAL, SWITCHES, Host, count, init

gap = st.one_of(st.integers(1, 12), st.integers(1, 400), st.integers(1, 5000))
byte = st.one_of(
    st.integers(0, 255), st.sampled_from([0x40, 0x41, 0x42, 0x43, 0x44, 0x46, 0x4B, 0x1A, 9, 4, 0x80])
)
action = st.one_of(
    st.tuples(st.just("code"), gap, byte),
    st.tuples(st.just("data"), gap, byte),
    st.tuples(st.just("setting"), gap, st.sampled_from([0x1A, 0x0A, 0x3A, 0x17, 0x19])),
    st.tuples(st.just("move"), gap, st.sampled_from([0x43, 0x4B, 0x53, 0x63])),
    st.tuples(st.just("read"), gap, st.integers(0, 1)),
    st.tuples(st.sampled_from(SWITCHES), gap, st.integers(0, 1)),
)
ramp = st.tuples(st.integers(1, 60), st.integers(0, 59), st.integers(0, 40)).map(
    lambda r: (r[0], max(1, r[0] - r[1]), r[2])
)


def play(host: Host, actions: list[tuple[str, int, int]]) -> None:
    """Run random actions."""
    for kind, wait, value in actions:
        host.pause(wait)
        if kind in ("code", "data"):
            host.write(int(kind == "code"), value)
        elif kind == "setting":
            for i, b in enumerate((value, 9, 4, 4, 0)):
                host.write(int(i == 0), b, gap=3)
        elif kind == "move":
            for i, b in enumerate((value, 13, 0, 0)):
                host.write(int(i == 0), b, gap=3)
        elif kind == "read":
            host.read(value)
        else:
            host.pins(**{kind: value})
    host.sync()


@settings(max_examples=60)
@given(
    st.lists(action, max_size=40),
    st.sampled_from(["FAST", "DATASHEET"]),
    st.sampled_from([8_000_000, 11_059_200, 16_000_000]),
)
def test_any_host_can_be_recovered_from(actions, timing, clk_hz):
    host = Host("", timing=timing, clk_hz=clk_hz)
    play(host, actions)
    edges = host.model.edges
    assert all(a.t <= b.t for a, b in zip(edges, edges[1:], strict=False))
    assert len({(e.t, e.signal) for e in edges}) == len(edges)
    host.poll(2, 0)
    for _ in range(8):
        host.pause(4000)
        if not host.poll(2, 0) & 4:
            break
        host.command(0x40)
    assert host.poll(2, 0) & 4 == 0
    host.pins(**dict.fromkeys(SWITCHES, 1))
    host.run(init(0x1A, 9, 4, 4) + "c 80 r")
    while host.status() & 1:
        host.read(0)
    host.start("c 43 " + count(9))
    host.pause(4000)
    host.idle()
    assert host.finish() == (0x83, 0)
    assert host.gaps()[-9:] == [9, 6, 5, 4, 4, 4, 5, 6, 9]


@settings(max_examples=60)
@given(ramp, st.integers(1, 60), st.data())
def test_requests_in_any_gap(setting, n, data):
    d1, d2, pa = setting
    host = Host(init(0x0A, *setting), ext=0)
    host.start("c 43 " + count(n - 1))
    i = data.draw(st.integers(0, max(0, n - 2)))
    if n > 1:
        host.in_gap(i)
        mark = host.mark
        host.command(0x41)
        host.mark = mark
    fin, rem = host.finish()
    made = len(host.pulses())
    top = 0 if d1 == d2 else pa
    x = [round(g / 1280) for g in host.intervals()]
    v = min(i, top)
    whole = [profile_index(n, top, j) for j in range(1, n)]
    if n == 1 or n - 1 - i <= v:
        assert made == n and fin == 0x83
    elif v == 0 or x[:1] == [host_level(setting, v)]:
        assert made == i + 1
    else:
        assert made == min(i + v + 2, n)
    assert rem == max(n - 1 - made, 0) and (fin == 0x83) == (made == n)
    if made == n:
        assert x == [host_level(setting, k) for k in whole]


def host_level(setting: tuple[int, int, int], k: int) -> int:
    """Return x(k) with integers: the smallest r with 4Y < (2r + 1)^2, where Y is the square of the exact x(k)
    (STMC-RMP-01).
    """
    d1, d2, pa = setting
    if pa == 0 or d1 == d2:
        return d2
    r, top, low = 1, 4 * pa * d1**2 * d2**2, pa * d2**2 + (d1**2 - d2**2) * k
    while top >= (2 * r + 1) ** 2 * low:
        r += 1
    return r


@settings(max_examples=40)
@given(st.integers(8_000_000, 200_000_000), st.integers(1, 20), st.data())
def test_square_wave_is_an_accumulator(clk_hz, divider, data):
    hz = clk_hz // 4 // divider - data.draw(st.integers(0, 1000))
    square, acc, level = Square(clk_hz, hz), 0, 0
    for edge in range(1, 200):
        acc += 2 * hz
        if acc >= clk_hz:
            acc -= clk_hz
            level ^= 1
            assert (square.next_edge, square.next_level) == (edge, level)
            square.advance()
    for wrong in (0, clk_hz // 4 + 1):
        with pytest.raises(ValueError, match="square wave"):
            Square(clk_hz, wrong)


def test_times_scale_with_the_crystal():
    for xtal_hz in (8_000_000, 20_000_000):
        host = Host(INTERNAL, xtal_hz=xtal_hz, ext=0)
        host.move("c 44 d 03 " + count(3))
        falls = host.pulses()
        exact = [-(-i * 3 * 1280 * 16_000_000 // xtal_hz) for i in range(4)]
        assert [t - falls[0] for t in falls] == exact and EXT16


# ------------------------------------------------------------------ the board


class Isa:
    """ISA accesses to the model of the board."""

    def __init__(self, **parameters: int) -> None:
        self.model = J105Stmc(**parameters)
        self.t = 8

    def write(self, address: int, value: int, aen: int = 0) -> None:
        self.model.pins(self.t, sa=address, aen=aen, sd_i=value)
        self.model.pins(self.t + 2, iow_n=0)
        self.model.pins(self.t + 10, iow_n=1)
        self.t += 24

    def read(self, address: int, aen: int = 0) -> tuple[int, int]:
        self.model.pins(self.t, sa=address, aen=aen)
        self.model.pins(self.t + 2, ior_n=0)
        self.model.run_until(self.t + 9)
        got = self.model.outputs["sd_oe"], self.model.outputs["sd_o"]
        self.model.pins(self.t + 10, ior_n=1)
        assert self.model.outputs["sd_oe"] == 0
        self.t += 24
        return got


@verifies("AC-46", "J105-01", "J105-02", "J105-03", "J105-05", "J105-07")
def test_ac_46_board():
    isa = Isa()
    for address in (0x3B2, 0x3AF, 0x1B1):
        isa.write(address, 0x43)
        assert isa.read(address)[0] == 0
    isa.write(0x3B1, 0x43, aen=1)
    assert isa.read(0x3B1, aen=1)[0] == 0 and isa.read(0x3B1) == (1, 0)
    for i, value in enumerate((0x1A, 20, 5, 8, 0)):
        isa.write(0x3B1 if not i else 0x3B0, value)
    isa.t += 6_000
    for i, value in enumerate((0x43, 0x13, 0, 0)):
        isa.write(0x3B1 if not i else 0x3B0, value)
    isa.t += 100_000
    isa.model.run_until(isa.t)
    log = isa.model.log
    steps = [t for t, _ in log.of("s")][1:]
    assert len(steps) == 20 and [e for e in log.of("drv")][1:] == [(t, v & 15) for t, v in log.of("s")[1:]]
    assert abs(steps[-1] - steps[0] - 161 * 16_000_000 / 48_675) <= 2
    assert log.rises("irq") == [steps[-1] + 1] and isa.model.outputs["irq"] == 1
    isa.t += 1
    isa.write(0x3B1, 0x80)
    assert isa.read(0x3B0) == (1, 0x83) and isa.model.outputs["irq"] == 0


@verifies("AC-47", "J105-06")
def test_ac_47_board_clock_and_reset():
    isa = Isa()
    for i, value in enumerate((0x1A, 141, 141, 0, 0, 0x43, 0x14, 0, 0)):
        isa.write(0x3B1 if i in (0, 5) else 0x3B0, value)
    isa.model.run_until(1_100_000)
    steps = [t for t, _ in isa.model.log.of("s")][1:]
    assert len(steps) == 21 and abs(steps[-1] - steps[0] - 926_964.6) <= 2
    isa.model.pins(1_100_010, rst_n=0)
    assert isa.model.outputs == {"sd_o": 0, "sd_oe": 0, "irq": 0, "s": 0, "drv": 0, "hold": 1}
    isa.model.pins(1_100_020, rst_n=1)
    isa.t = 1_100_030
    isa.write(0x3B1, 0x42)
    assert isa.read(0x3B1) == (1, 0xA0)


def test_parameters_of_the_board():
    for wrong in ({"base_addr": 0x3B1}, {"base_addr": 0x400}, {"ext_hz": 0}, {"ext_hz": 4_000_001}):
        with pytest.raises(ValueError):
            J105Stmc(**wrong)
    assert isinstance(J105Stmc(base_addr=0x2A0).core, Stmc)
