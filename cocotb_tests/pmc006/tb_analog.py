"""Speed that follows the voltage on GPI1, and the time bases.

Instructions are named by their letters; a number after the letter is the data.
"""

from __future__ import annotations

from typing import Any

import cocotb

from .builds import directed
from .host import Host
from .moves import (
    STALL,
    after_steps,
    constant_speed_host,
    cruise,
    download,
    is_stopped,
    load,
    run,
    samples,
    start,
    wait_stopped,
)
from .programs import END, Op, rot


async def regulated(dut: Any, full: int, value: int) -> Host:
    """Return the host of a part whose analog speed instruction E has switched on, with full scale `full`;
    `value` is the last sample of the converter.
    """
    host = await constant_speed_host(dut)
    await host.ok(u=5, o=5)
    await download(host, [Op(0x08, 1, full)])
    assert await host.ask("E") == 1 and await host.ask("q") == full
    await host.strobe(adc_data=value)
    return host


def target(full: int, value: int) -> int:
    """Return the present target speed (P006-MOT-51)."""
    return full * (value + (value >> 9)) // 1024


@cocotb.parametrize(value=[1023, 511, 512, 700, 441, 952])
@directed("P006-MOT-51", "P006-MOT-50", "P006-STA-02", "P006-STA-04")
async def p006_targets(dut: Any, value: int) -> None:
    """If the target is below VSTART, the motion runs at the target from its first step on.

    With the values 441 and 952, the exact target is only 1/128 below the next integer.
    """
    assert [target(8000, h) for h in (0, 1, 511, 512, 1023)] == [0, 7, 3992, 4007, 8000]
    host = await regulated(dut, 3000, value)
    await run(host)
    await after_steps(host, 12)
    steps = host.steps()
    whole = [-(-number * 1_000_000 // target(3000, value)) for number in range(1, 13)]
    assert host.intervals() == [b - a for a, b in zip(whole, whole[1:], strict=False)]
    assert len(steps) == 12 and await host.ask("I") == 0


@directed("P006-MOT-21", "P006-STA-04", "P006-MOT-20", "P006-MOT-52")
async def p006_move_below_its_start_speed(dut: Any) -> None:
    """A move whose analog target is below the start speed has no acceleration or deceleration: exactly N
    steps at the target.

    The check of instruction s uses the operand of VSET, not this target.
    """
    host = await regulated(dut, 3000, 990)
    await start(host, 256)
    mark = host.mark
    await wait_stopped(host)
    assert host.step_count(mark) == 256 and set(host.intervals(mark)) == {344, 345}
    await host.ok(L=2000)
    await download(host, [Op(0x08, 1, 2999)])
    assert await host.ask("E") == 1 and await host.ask("s", 256) == 0


@directed("P006-MOT-31", "P006-MOT-51", "P006-STA-10", "P006-BAD-20")
async def p006_voltage_of_zero(dut: Any) -> None:
    """At a voltage of 0, no steps are made, and BUSY stays set until instruction I ends the motion.

    The part samples the voltage every 10 ms.
    """
    host = await regulated(dut, 3000, 0)
    await start(host, 400)
    mark = host.mark
    assert await is_stopped(host, host.us(4_000)) and await host.busy()
    await host.strobe(adc_data=800)
    await cruise(host, 1_000_000 / target(3000, 800), 90_000)
    begun = host.steps(mark)[0] - host.edges("mon_busy", mark)[0][0]
    # After the sample, the first step occurs when a t² / 2 reaches 1 step: 6 ms after the acceleration
    # begins.
    assert host.us(15_500) < begun < host.us(17_500)
    await host.strobe(adc_data=0)
    await host.ms(12)
    count = host.step_count(mark)
    assert count and await host.busy()
    await host.ms(45)
    assert await is_stopped(host, host.us(2_000))
    assert await host.busy()
    assert await host.ask("I") == 0
    assert not await host.busy()
    # A move of 5 steps does not use the voltage. Without a sample since the reset, there is no voltage to
    # use.
    await start(host, 5)
    await wait_stopped(host)
    assert host.step_count() == 5


@directed("P006-STL-01", "P006-MOT-31", "P006-MOT-51")
async def p006_samples_at_a_speed_of_zero(dut: Any) -> None:
    """At a voltage of 0, the speed is constant, but samples of the stall detector do not count."""
    host = await regulated(dut, 3000, 0)
    await host.ok(Z=511, T=3, Y=1)
    await start(host, 400)
    await host.ms(25)
    await samples(host, *[0] * 5)
    assert await host.busy() and not await host.status() & STALL
    await host.strobe(adc_data=800)
    await cruise(host, 1_000_000 / target(3000, 800), 90_000)
    await host.ms(3)
    await samples(host, *[0] * 5)
    assert await host.status() & STALL and await host.ask("I") == 0


@directed("P006-MOT-52", "P006-MOT-51", "P006-MOT-50", "P006-CMD-43", "P006-PRG-14")
async def p006_regulation_survives_the_program_and_v_ends_it(dut: Any) -> None:
    host = await constant_speed_host(dut)
    await host.ok(u=5, o=5)
    await host.strobe(adc_data=600)
    await load(host, Op(0x08, 1, 4000), rot(1_000_000), END)
    mark = host.mark
    await cruise(host, 1_000_000 / target(4000, 600))
    await host.strobe(adc_data=900)
    await cruise(host, 1_000_000 / target(4000, 900))
    gaps = host.intervals(mark)[-12:]
    assert all(b <= a + 1 for a, b in zip(gaps, gaps[1:], strict=False))
    await host.ok(v=3000)
    await cruise(host, 1_000_000 / 3000)
    await host.strobe(adc_data=100)
    await host.ms(12)
    assert set(host.intervals(mark)[-5:]) <= {333, 334} and await host.ask("I") == 0
