"""pmc006_motion: a motion that starts while the planner still computes for a motion that was halted."""

from __future__ import annotations

import cocotb

from ..harness import Block, BlockDriver, same

AREA = "pmc006"
GROUPS = ("common", "motion", "pmc006")
BLOCKS = {
    "motion": Block(
        "pmc006_motion",
        "us_i settings_i:93:pmc006_pkg::motor_settings_t base_i:8"
        " motion_start_i:34:pmc006_pkg::motion_start_t halt_i adc_i:11:pmc006_pkg::sample_t"
        " motion_o:3 step_o drive_cmd_o:26",
    )
}
US, VSTART = 8, 3000
"""Cycles of a microsecond; the start speed, which is also the operand of VMAX."""
START = 1 << 33 | 1000 << 2
"""motion_start_t: a move of 1000 steps."""


def settings() -> int:
    """Return motor_settings_t with an analog speed of at most VSTART."""
    value = 0
    for field, width in (
        (16, 8), (800, 12), (5, 3), (5, 3), (1, 1), (1, 3), (VSTART, 12), (VSTART, 12), (300, 11), (1250, 11),
        (VSTART, 14), (1, 1), (1, 1), (0, 1),
    ):  # fmt: skip
        value = value << width | field
    return value


@cocotb.test()
async def start_speed_after_a_halt(dut):
    """A motion begins at its own speed (P006-MOT-22), also if the previous motion, whose target was lower,
    was halted during its planning.
    """
    u = BlockDriver(dut, "motion", BLOCKS, "step_o")
    for distance in range(64, 72):  # at 68 and 69, the planner outputs the speed of the first motion
        await u.reset(settings_i=settings(), base_i=100)
        time = 0

        async def clk(**inputs):
            nonlocal time
            time += 1
            return await u.clk(us_i=time % US == 0, **inputs)

        async def start(level):
            await clk(adc_i=1 << 10 | level)
            await clk(adc_i=0)
            await clk()
            await clk(motion_start_i=START)

        await start(10)
        since = time
        await clk(motion_start_i=0)
        await clk(halt_i=1)
        await clk(halt_i=0)
        while time < since + distance - 4:
            await clk()
        await start(1023)
        begin, step = time, await clk(motion_start_i=0)
        while not step and time < begin + 5000:
            step = await clk()
        first = 800 + US * -(-1_000_000 // VSTART)
        same(f"distance {distance}: first step", first <= time - begin <= first + US + 4, True)
