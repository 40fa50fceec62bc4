"""Scripts: the speed that follows the voltage on GPI1, and the clocks behind all times."""

from __future__ import annotations

import pytest

from cocotb_tests.harness.verifies import verifies

from .scenes import END, Op, after_steps, cruise, download, load, quick, rest, rot, run, start, still
from .script_host import Host


def regulated(full: int, value: int) -> Host:
    """A host on a part with ANALOG = 1, made so by E; `value` is the last sample."""
    host = quick()
    host.ok(u=5, o=5)
    download(host, [Op(0x08, 1, full)])
    assert host.ask("E") == 1 and host.ask("q") == full
    host.strobe(adc_data=value)
    return host


def target(full: int, value: int) -> int:
    """The live target (P006-MOT-51)."""
    return full * (value + (value >> 9)) // 1024


@pytest.mark.parametrize("value", [1023, 511, 512, 700])
@verifies("P006-MOT-51", "P006-MOT-50", "P006-STA-02", "P006-STA-04")
def test_targets(value: int) -> None:
    """Below VSTART the motion runs at the target from its first step on."""
    assert [target(8000, h) for h in (0, 1, 511, 512, 1023)] == [0, 7, 3992, 4007, 8000]
    host = regulated(3000, value)
    run(host)
    after_steps(host, 12)
    steps = host.steps()
    whole = [-(-number * 1_000_000 // target(3000, value)) for number in range(1, 13)]
    assert host.intervals() == [b - a for a, b in zip(whole, whole[1:], strict=False)]
    assert len(steps) == 12 and host.ask("I") == 0


@verifies("P006-MOT-21", "P006-STA-04", "P006-MOT-20", "P006-MOT-52")
def test_move_below_its_start_speed() -> None:
    """No planning and no deceleration; exactly N steps at the target. Acceptance looks at VMAX."""
    host = regulated(3000, 990)
    start(host, 256)
    mark = host.mark
    rest(host)
    assert host.made(mark) == 256 and set(host.intervals(mark)) == {344, 345}
    host.ok(L=2000)
    download(host, [Op(0x08, 1, 2999)])
    assert host.ask("E") == 1 and host.ask("s", 256) == 0


@verifies("P006-MOT-31", "P006-MOT-51", "P006-STA-10", "P006-BAD-20")
def test_voltage_of_zero() -> None:
    """No steps, BUSY stays; the copy of the voltage is renewed every 10 ms; I ends it all."""
    host = regulated(3000, 0)
    start(host, 400)
    mark = host.mark
    assert still(host, host.us(4_000)) and host.busy
    host.strobe(adc_data=800)
    cruise(host, 1_000_000 / target(3000, 800), 90_000)
    begun = host.steps(mark)[0] - host.edges("mon_busy", mark)[0][0]
    # 1 = a t² / 2 takes 6 ms more.
    assert host.us(15_500) < begun < host.us(17_500)
    host.strobe(adc_data=0)
    host.ms(12)
    count = host.made(mark)
    assert count and host.busy
    host.ms(45)
    assert still(host, host.us(2_000)) and host.busy and host.ask("I") == 0 and not host.busy
    # A short move does not look at the voltage, and one without samples since the reset has none.
    start(host, 5)
    rest(host)
    assert host.made() == 5


@verifies("P006-MOT-52", "P006-MOT-51", "P006-MOT-50", "P006-CMD-43", "P006-PRG-14")
def test_regulation_survives_the_program_and_v_ends_it() -> None:
    host = quick()
    host.ok(u=5, o=5)
    host.strobe(adc_data=600)
    load(host, Op(0x08, 1, 4000), rot(1_000_000), END)
    mark = host.mark
    cruise(host, 1_000_000 / target(4000, 600))
    host.strobe(adc_data=900)
    cruise(host, 1_000_000 / target(4000, 900))
    gaps = host.intervals(mark)[-12:]
    assert all(b <= a + 1 for a, b in zip(gaps, gaps[1:], strict=False))
    host.ok(v=3000)
    cruise(host, 1_000_000 / 3000)
    host.strobe(adc_data=100)
    host.ms(12)
    assert set(host.intervals(mark)[-5:]) <= {333, 334} and host.ask("I") == 0
