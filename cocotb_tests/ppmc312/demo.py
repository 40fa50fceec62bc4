"""Program of `make demo PART=ppmc312` on the block registers.

The program makes one move with each of three kinds of ramps, speed changes that wait for positions and for an
event pin, and a high-speed zero return.
"""

from __future__ import annotations

from typing import Any

import cocotb

from cocotb_tests.harness import BlockHost, RtlBench
from cocotb_tests.harness.bus import CSR
from cocotb_tests.harness.sessions import DemoLog

from .bench import PPMC312

START, HIGH, RAMP = 320, 64, 1150  # START and HIGH in ticks of 1/8 us: 25 and 125 kpps; RAMP in pulses
PULSES = 3000
# A curve for a motor with less torque at high speed, fastest stage first; it also has 1150 pulses.
CURVE = ((64, 300), (70, 210), (78, 150), (88, 110), (100, 90), (116, 75), (136, 60), (162, 50),
         (196, 40), (240, 30), (280, 20), (320, 15))  # fmt: skip
ANSWERS = 0x10
CW, CCW = 0x00, 0x40
CRUISE, SLOWER = 160, 128  # 50 and 62.5 kpps
TO_HIGH, TO_SLOWER, EVENT_AFTER = 400, 1900, 2300  # pulses
HOME_FROM, HOME_TO = 600, -450  # positions between which the origin switch is closed
BEGIN = 2500  # position where the zero return begins
LONG = 3_000_000


class Interrupted(BlockHost):
    """Host that waits for the interrupt of each answer, as a host with other tasks does."""

    async def response(self, timeout: int | None = None) -> str:
        """Return the next response block."""
        await self.bench.level_is("irq_n", 0, timeout or LONG)
        await self.bench.clocks(16)
        block = await super().response(timeout)
        await self.bench.clocks(16)  # irq_n is deasserted for this answer within 16 cycles
        return block


def initial(flags: int) -> str:
    """Return the block of the initial setting."""
    return f"03 09 00 {flags:02X} {START:04X} {HIGH:04X} {RAMP:06X}"


def move(flags: int, pulses: int) -> str:
    """Return the block of a ramped move."""
    return f"03 08 82 {flags:02X} 0000 {pulses:08X}"


async def free_curve(host: BlockHost) -> None:
    """Transfer the curve in three blocks: all rates, ten pulse numbers, and the other pulse numbers."""
    await host.ask(f"02 03 01 00 {len(CURVE):02X}")
    rates = " ".join(f"{rate:04X}" for rate, _ in CURVE)
    pulses = [f"{count:06X}" for _, count in CURVE]
    for header, data in ((0, rates), (0, " ".join(pulses[:10])), (1, " ".join(pulses[10:]))):
        await host.ask(f"{header:02X} {len(bytes.fromhex(data)):02X} {data}")


async def pulses(bench: RtlBench, count: int) -> None:
    """Wait for `count` pulses."""
    for _ in range(count):
        await bench.edge("pout", 1, LONG)


@cocotb.test()
async def demo_blocks(dut: Any) -> None:
    """The host's program runs on the bus of a device that was just powered up; the run is recorded."""
    bench = await RtlBench.start(dut, PPMC312)
    host = Interrupted(bench)
    demo_log = DemoLog(bench)
    with demo_log.chapter("reset", "after reset"):
        await host.write(CSR, ANSWERS)
        await host.ask("03 01 40")
        await host.ask("03 01 4D")
    with demo_log.chapter("set_free", "load the free curve"):
        await free_curve(host)
    with demo_log.chapter("free", f"{PULSES} pulses, free curve"):
        await host.ask(move(CW, PULSES))
        await host.response()
    with demo_log.chapter("set_sigmoid", "build the sigmoid table"):
        await host.ask(initial(0x08))
    with demo_log.chapter("sigmoid", f"{PULSES} pulses back, sigmoid"):
        await host.ask(move(CCW, PULSES))
        await host.response()
    with demo_log.chapter("set_linear", "build the linear table"):
        await host.ask(initial(0x00))
    with demo_log.chapter("linear", f"{PULSES} pulses, linear"):
        await host.ask(move(CW, PULSES))
        await host.response()
    with demo_log.chapter("register", "instructions that wait"):
        await host.ask("03 06 43 00 00000000")
        await host.ask(f"03 08 87 04 {HIGH:04X} {TO_HIGH:08X}")
        await host.ask(f"03 08 88 04 {SLOWER:04X} {TO_SLOWER:08X}")
        await host.ask("03 02 81 05")
        await host.ask("03 01 4D")
    with demo_log.chapter("override", "changes at positions, stop by event 0"):
        await host.ask(f"03 04 85 00 {CRUISE:04X}")
        await pulses(bench, TO_HIGH)
        await host.response()
        await pulses(bench, TO_SLOWER - TO_HIGH - 20)
        await host.response()
        await pulses(bench, EVENT_AFTER - TO_SLOWER)
        bench.set(evt0_n=0)
        await bench.clocks(200)
        bench.set(evt0_n=1)
        await host.response()
        await host.response()
    with demo_log.chapter("return", "high-speed zero return"):
        await host.ask(f"03 06 43 00 {BEGIN:08X}")
        await host.ask("03 04 11 40 0000")
        await pulses(bench, BEGIN - HOME_FROM)
        bench.set(org_n=0)
        await pulses(bench, HOME_FROM - HOME_TO)
        bench.set(org_n=1)
        await bench.edge("dir", 0, LONG)
        # The motor moves back until the switch closes again.
        await pulses(bench, overrun() - 1)
        bench.set(org_n=0)
        await host.response()
        await host.ask("03 02 42 00")
    await bench.clocks(4000)
    demo_log.save()


def overrun() -> int:
    """Return the number of pulses that the deceleration makes beyond the far end of the switch."""
    return HOME_TO - (HOME_FROM - RAMP)
