"""For any move, pulse times, widths and counts at the pins of the PPMC-312 follow the closed formulas."""

from __future__ import annotations

from math import ceil

from hypothesis import given
from hypothesis import strategies as st

from cocotb_tests.harness import Config, OnModel, on_model, verifies
from cocotb_tests.ppmc312.host import Host
from openppmc.model.ppmc312.stages import DIVIDERS, constant, curve, ramped


def free_curve(clk: int, rates: list[int], pa: list[int], pd: list[int]) -> list[str]:
    """Return the blocks of a free curve with a separate deceleration list."""
    blocks = [f"02 04 01 {0x10 | clk:02X} {len(pa):02X} {len(pd):02X}"]
    for width, values in ((2, rates), (3, pa), (3, pd)):
        for k in range(0, len(values), 10):
            data = b"".join(value.to_bytes(width, "big") for value in values[k : k + 10])
            blocks.append(f"00 {len(data):02X} {data.hex()}")
    blocks[-1] = "01" + blocks[-1][2:]
    return blocks


@st.composite
def settings(draw: st.DrawFn) -> tuple[int, list[int], list[int], list[int]]:
    """Draw base clock, rates and pulses of a small curve; the rates begin with the fastest."""
    clk = draw(st.integers(0, 2))
    least = 16 if clk == 0 else 4
    rates = sorted(draw(st.lists(st.integers(least, 600), min_size=2, max_size=14)))
    pulses = st.lists(st.integers(2, 9), min_size=2, max_size=len(rates))
    pa, pd = draw(pulses), draw(pulses)
    return clk, rates[: max(len(pa), len(pd))], pa, pd


@given(settings(), st.integers(1, 150), st.booleans(), st.data(), st.sampled_from([8, 16, 27, 50]))
@verifies("P312-MOT-01", "P312-MOT-02", "P312-MOT-03", "P312-MOT-05", "P312-MOT-06", "P312-MOT-07")
def test_any_move(
    setting: tuple[int, list[int], list[int], list[int]], n: int, ccw: bool, data: st.DataObject, mhz: int
) -> None:
    clk, rates, pa, pd = setting
    table = curve(rates, pa, pd, clk)
    rate = data.draw(st.integers(min(table.high, table.slowest), max(table.high, table.slowest)))
    ramp = data.draw(st.booleans())
    plan = ramped(table, rate, n) if ramp else constant(table, rate, n)
    build = Config(f"{mhz}m", clk_hz=mhz * 1_000_000)
    host = on_model(Host.start(OnModel(build), *free_curve(clk, rates, pa, pd)))
    code, kind = (0x82, plan.kind) if ramp else (0x83, 0)
    flags = 0x40 if ccw else 0
    block = f"03 08 {code:02X} {flags:02X} {rate:04X} {n:08X}"
    assert on_model(host.ask(block)) == f"03 02 {code:02X} {kind:02X}"
    position = -n & 0xFFFFFFFF if ccw else n
    on_model(host.arrival())
    stored = host.t - 1
    assert on_model(host.response()).replace(" ", "") == f"2306E040{position:08X}"

    def clks(ticks: int) -> int:
        return ceil(ticks * DIVIDERS[clk] * mhz / 16)

    steps = plan.steps()
    begins = [sum(step.rate for step in steps[:k]) for k in range(n + 1)]
    edges = host.pulses()
    assert [edge - edges[0] for edge in edges] == [clks(ticks) for ticks in begins[:n]]
    assert 0 <= stored - edges[0] - clks(begins[n]) <= 64
    changes = host.bench.edges("pout", host.mark)
    falls = [t for t, level in changes if not level]
    for k, (rise, fall) in enumerate(zip(edges, falls, strict=True)):
        half = clks(begins[k] + steps[k].rate // 2) - clks(begins[k])
        assert fall - rise == min(ceil(80 * mhz / 16), half)
    assert host.out("dir") == int(ccw)
