"""Interrupts and motion of isa_4axis: an interrupt handler, four axes together, both parts with random
hosts.
"""

from __future__ import annotations

from typing import Any

import cocotb

from cocotb_tests.harness import D16, F16, F25, IsaHost, configs
from cocotb_tests.harness.axis_driver import rates

from .models import check_both
from .setting import BUSY1, BUSY2, CMND1, CMND2, ERROR, SOURCE, Setting

RAMP_B = (0x63, 0x13, 0x0A)


async def serve(setting: Setting, found: list[tuple[int, int]]) -> bool:
    """Run the handler of docs/ppmc2104/isa.md, which repeats as long as it can clear causes. Append (axis,
    end status) of each end to `found`.

    Return False if a cause remains, because its axis moves again.
    """
    while True:
        before = len(found)
        _, source, _ = await setting.master.read(SOURCE)
        for number, host in enumerate(setting.hosts):
            if not source >> number & 1:
                continue
            status = await host.status()
            if status & ERROR:
                found += [(0, (await host.fetch(code))[0]) for code in (0x86, 0xA6)]
            for second, busy in enumerate((BUSY1, BUSY2)):
                if not status & busy:
                    end = (await host.fetch(0x80 | second << 5))[0]
                    if end & 0x80:
                        found.append((2 * number + second + 1, end))
        if len(found) == before:
            return not source


class Controller:
    """Edge-triggered interrupt input, like that of the 8259 in a PC: it stores a rising edge until the
    service begins.
    """

    def __init__(self, setting: Setting) -> None:
        self.bench = setting.bench
        self.served = 0

    def requests(self) -> bool:
        """Return whether irq has risen since the last service began."""
        return len(self.bench.rises("irq")) > self.served

    def acknowledge(self) -> None:
        """Begin the service, which clears the stored edge."""
        self.served = len(self.bench.rises("irq"))


@cocotb.test()
@configs(F16, F25)
async def isa_interrupt_handler(dut: Any) -> None:
    """With an edge-triggered handler and four axes that end at various times, no end is missed (ISA-08)."""
    setting = await Setting.start(dut)
    bench, controller = setting.bench, Controller(setting)
    for axis in setting.axes:
        await setting.set_up(axis, 0x02, *RAMP_B)
    found: list[tuple[int, int]] = []
    expected = []
    for turn in range(6):
        for axis, drive in setting.axes.items():
            # The lengths are equal, slightly different or very different, so that ends occur together, during
            # the handler, or between two calls of the handler.
            await drive.go(
                0x44, n=4 + (0, axis, 5 * axis, 0, -axis, 1)[turn] % 9, rate=(29, 10, 49)[turn % 3]
            )
            expected.append((axis, 0x84))
        while len(found) < len(expected):
            if not controller.requests():
                await bench.edge("irq", 1)
            controller.acknowledge()
            nothing_left = await serve(setting, found)
            await bench.align()
            # On an edge-triggered input, irq would cause no further call if it was still high when the
            # handler returned.
            assert nothing_left, "ISA-08: a cause was left behind"
            assert controller.requests() or not bench.level("irq"), "ISA-08: irq stayed high"
        await bench.clocks(100)
    bench.check("ISA-08", "ends", sorted(found), sorted(expected))
    bench.check("ISA-08", "irq at the end", bench.level("irq"), 0)
    check_both(bench, at_least=200)


@cocotb.test()
@configs(F16, F25)
async def isa_write_makes_a_new_edge(dut: Any) -> None:
    """If an axis moves again and the cause of its interrupt cannot be read, a write to base + 4 causes
    another rising edge of irq (ISA-11).
    """
    setting = await Setting.start(dut)
    bench, master = setting.bench, setting.master
    for axis in (1, 4):
        await setting.set_up(axis, 0x02, *RAMP_B)
    for byte in (0x00, 0xFF):
        await master.write(SOURCE, byte)
        await bench.clocks(10)
    bench.check("ISA-11", "edges of irq without a cause", bench.edges("irq"), [])
    await setting.axes[1].go(0x42)
    await bench.edge("irq", 1)
    await setting.axes[1].go(0x45, rate=99)  # END1 stays pending, because it cannot be read now
    await bench.clocks(50)
    bench.check("ISA-11", "edges before", [level for _, level in bench.edges("irq")], [1])
    for byte in (0x00, 0xFF, 0x01):
        since = bench.now
        await master.write(SOURCE, byte)
        await bench.clocks(10)
        levels = bench.edges("irq", since)
        bench.check("ISA-11", "edges by a write", [level for _, level in levels], [0, 1])
        low = (levels[1][0] - levels[0][0]) * bench.period
        bench.check_window("ISA-11", "irq low in ps", low, 530_000 - bench.period, 530_000 + bench.period)
    since = bench.now
    await master.write(SOURCE, 0xFF, aen=1)
    await master.write(SOURCE + 1, 0xFF)
    await master.read(SOURCE)
    bench.check("ISA-11", "edges by other cycles", bench.edges("irq", since), [])
    await setting.axes[4].go(0x42)
    await bench.clocks(500)
    bench.check("ISA-11", "edge of part B behind A's level", bench.edges("irq", since), [])
    await master.write(SOURCE, 0)
    bench.check("ISA-07", "source", (await master.read(SOURCE))[1], 3)
    await setting.hosts[0].command(0x40)
    check_both(bench, at_least=6)


@cocotb.test()
@configs(F16, F25)
async def isa_service_after_the_restart(dut: Any) -> None:
    """If axes are started again before a late handler reads their end statuses, the handler still returns
    each time. While a cause remains, a periodic write to base + 4 causes a new edge of irq; thus the handler
    finds the last end of every axis.
    """
    setting = await Setting.start(dut)
    bench, controller, rng = setting.bench, Controller(setting), setting.bench.rng
    for axis in setting.axes:
        await setting.set_up(axis, 0x02, *RAMP_B)
    found: list[tuple[int, int]] = []
    left = services = ticks = 0
    for turn in range(8):
        for axis in rng.sample(sorted(setting.axes), 4):
            await setting.axes[axis].go(0x42)
        await bench.clocks(bench.config.us(20))
        # Interrupts were disabled until here. Some axes now move again while their END is pending.
        again = rng.sample(sorted(setting.axes), 1 + turn % 4)
        for axis in again:
            await setting.axes[axis].go(0x44, n=rng.randrange(2, 30), rate=rng.choice((19, 49, 99)))
        found.clear()
        idle = 0
        while idle < 3:
            if controller.requests():
                controller.acknowledge()
                accesses = len(bench.accesses)
                left = not await serve(setting, found)
                services, idle = services + 1, 0
                assert len(bench.accesses) - accesses < 200, "ISA-08: the handler goes round and round"
            else:
                await bench.clocks(bench.config.us(400))  # wait for the next periodic interrupt of a timer
                if left:
                    left, ticks = False, ticks + 1
                    await setting.master.write(SOURCE, 0)
                elif not any([await host.status() & (BUSY1 | BUSY2) for host in setting.hosts]):
                    idle += 1
        last = dict(found)
        bench.check(
            "ISA-08", "ends", last, {axis: 0x84 if axis in again else 0x82 for axis in sorted(setting.axes)}
        )
        bench.check("ISA-08", "irq at the end", bench.level("irq"), 0)
    assert services > 8 and ticks > 8, f"{services} services, {ticks} ticks"
    check_both(bench, at_least=200)


@cocotb.test()
@configs(F16, F25)
async def isa_four_axes_together(dut: Any) -> None:
    """When RUN rises, four waiting moves in two parts start on the same edge of `clk` (ISA-10)."""
    setting = await Setting.start(dut, run=0)
    bench, axes = setting.bench, setting.axes
    ramps = {1: RAMP_B, 2: (0x3B, 0x09, 20), 3: (0x27, 0x01, 60), 4: (0x0E, 0x0C, 16)}
    for axis, ramp in ramps.items():
        await setting.set_up(axis, (0x02, 0x06, 0x03, 0x05)[axis - 1], *ramp)
    pulses = {1: 120, 2: 250, 3: 400, 4: 100}
    for axis, drive in axes.items():
        await drive.go(0x43 if axis % 2 else 0x4B, n=pulses[axis])
    for host in setting.hosts:
        bench.check("ISA-10", "BUSY of both", await host.status() & 0x3C, BUSY1 | BUSY2)
    bench.check("ISA-10", "pulses before RUN", [drive.pulses for drive in axes.values()], [[]] * 4)
    await bench.align()
    start = bench.set(run=0b1111)
    busy = list(setting.hosts)
    while busy:  # polling continues while the axes move
        busy = [host for host in busy if await host.status() & (BUSY1 | BUSY2)]
    falls = {drive.pulses[0] for drive in axes.values()}
    bench.check("ISA-10", "first falls on one edge", len(falls), 1)
    w = bench.config.w
    bench.check_window("ISA-10", "first fall after RUN", falls.pop() - start, w, w + 6)
    for axis, drive in axes.items():
        indices = [min(j, pulses[axis] - 2 - j, ramps[axis][2]) for j in range(pulses[axis] - 1)]
        drive.check_train("ISA-10", rates(ramps[axis], indices))
    bench.check("ISA-10", "dir", bench.level("dir"), 0b1010)
    check_both(bench, at_least=1000)


async def random_host(setting: Setting, host: IsaHost, actions: int) -> None:
    """Send random instructions of all kinds to one part; some are faulty."""
    bench, rng = setting.bench, setting.bench.rng
    for axis_bit in (0x00, 0x20):
        await host.init(
            rng.choice((0x02, 0x06, 0x13)) | axis_bit, rng.randrange(12, 40), rng.randrange(3, 9), 7
        )
        if bench.config.datasheet:  # do not poll during the long window of the setting
            await bench.clocks(bench.config.us(71_000))
    await host.poll(CMND1 | CMND2, 0)
    for _ in range(actions):
        axis_bit, action = rng.choice((0x00, 0x20)), rng.randrange(10)
        direction = rng.choice((0x00, 0x08))
        if action < 4:
            await host.move(rng.choice((0x43, 0x53, 0xC3)) | axis_bit | direction, rng.randrange(1, 60))
        elif action == 4:
            await host.move(0x44 | axis_bit | direction, rng.randrange(1, 30), rate=rng.randrange(0, 20))
        elif action == 5:
            await host.send(0x45 | axis_bit | direction, [rng.randrange(2, 30)])
        elif action == 6:
            await host.command(rng.choice((0x40, 0x41)) | axis_bit)
        elif action == 7:
            await host.command(rng.choice((0x86, 0xC2, 0x80, 0x83, 0xD1, 0xC1, 0x87)) | axis_bit)
            if await host.status() & 0x01:
                await host.read(0)
        elif action == 8:
            await host.data(rng.randrange(256))
        else:
            await bench.clocks(rng.randrange(20, 3000))
    for axis_bit in (0x00, 0x20):
        await host.command(0x40 | axis_bit)
    await host.wait_idle(busy=BUSY1 | BUSY2)


async def random_switches(setting: Setting) -> None:
    """Change limits, alarms and RUN of all axes at random, until the task is cancelled."""
    bench, rng = setting.bench, setting.bench.rng
    while True:
        pin = f"{rng.choice(('fl_n', 'bl_n', 'fhl_n', 'bhl_n', 'alm_n', 'run'))}[{rng.randrange(1, 5)}]"
        await bench.clocks(rng.randrange(200, 6000))
        bench.set(**{pin: 0})
        await bench.clocks(rng.randrange(1, 400))
        bench.set(**{pin: 1})


@cocotb.test()
@configs(F16, F25, D16)
async def isa_random_both_parts(dut: Any) -> None:
    """With two host programs on one bus and random switches, each part equals its golden model."""
    setting = await Setting.start(dut)
    setting.bench.set(errint_n=setting.bench.rng.randrange(2))
    switches = cocotb.start_soon(random_switches(setting))
    hosts = [cocotb.start_soon(random_host(setting, host, actions=60)) for host in setting.hosts]
    for host in hosts:
        await host
    switches.cancel()
    await setting.bench.clocks(2000)
    check_both(setting.bench, at_least=500)
