"""Scripts: times at a clock that is no multiple of 1 MHz: nothing is more than a clk from its place."""

from __future__ import annotations

from itertools import pairwise

from cocotb_tests.harness.verifies import verifies

from .reference import HOME, code, sines
from .scenes import Op, after_steps, image, load, page, quick, rest, run, start, with_eeprom
from .script_host import Host


@verifies("P006-PAR-01", "P006-MOT-03", "P006-MOT-20", "P006-MOT-05", "P006-AC-45")
def test_intervals() -> None:
    """M13; `intervals` looks at every one, the sum at the drift."""
    host = Host()
    host.ok(u=3, o=3, v=3200)
    start(host, 256)
    rest(host)
    gaps = host.intervals()
    assert gaps[:3] == [1613, 1534, 1439] and gaps[-3:] == [1667, 1667, 1666]
    steps = host.steps()
    assert host.in_us(steps[-1] - steps[0]) == 122_842 - 1659


@verifies("P006-PAR-01", "P006-MOT-40", "P006-PRG-30", "P006-PRG-31")
def test_speed_mode_and_keys() -> None:
    host = quick(2500)
    run(host)
    after_steps(host, 30)
    steps = host.steps()
    assert host.in_us(steps[-1] - steps[0]) == 29 * 400 and host.ask("I") == 0
    load(host, Op(0x13, 1, 1), Op(0x01, 0, 10_000), Op(0x0D, 0, 2))
    after_steps(host, 3)
    host.pins(gpi=0b11110)
    edge = host.t - 1
    halt = host.until("mon_busy", 0, 2_000)
    assert host.us(1_000) <= halt - edge <= host.us(1_002) + 8
    host.ok(F=0)


@verifies("P006-PAR-01", "P006-EXC-31", "P006-EXC-30")
def test_idle_time() -> None:
    host = quick()
    start(host, 1)
    fall = rest(host)
    host.go(fall + host.us(99_998))
    assert host.refs() == sines(HOME + 8, code(800))
    host.go(fall + host.us(100_002) + 64)
    assert host.refs() == sines(HOME + 8, code(800) >> 1)


@verifies("P006-PAR-01", "P006-EEP-01", "P006-EEP-10")
def test_eeprom_at_another_rate_and_address() -> None:
    """SCL keeps its rate over the whole transfer, within a clk of its quarter ticks."""
    host = with_eeprom(image(page(a04=32)), write_us=300)
    assert host.ask("k") == 32
    hz = int(str(host.tape.params["I2C_HZ"]))
    host.ok(m=64)
    assert host.ask("t") == 1
    host.ms(3)
    assert host.eeprom is not None and host.eeprom.memory[4] == 64
    period = host.clk_hz / hz
    edges = host.edges("scl_oe", host.said)
    falls = [t for t, level in edges if level]
    # START and STOP are longer than a bit.
    assert {abs(b - a - period) <= 1 for a, b in pairwise(falls) if b - a < 1.2 * period} == {True}
    lows = [b - a for (a, level), (b, _) in pairwise(edges) if level]
    assert len(lows) > 600 and all(0 <= low - 0.55 * period < 2 for low in lows)
