"""ppmc_wishbone with a classic master: register map, strobes, aborted requests, and a PPMC-104 that moves."""

from __future__ import annotations

import cocotb
from cocotb.triggers import RisingEdge

from cocotb_tests.harness import F16, configs

from .session import PartMonitor, check_session, run_session
from .setting import TEN_LINES, count_of, start
from .strobe_slave import Registers, StrobeSlave
from .wishbone import WishboneMaster

COUNT = 8
BRIDGE = 4 * COUNT
WRITE_LATENCY, READ_LATENCY, QUICK_LATENCY = 6, 8, 1


@cocotb.test()
@configs(F16, TEN_LINES)
async def wishbone_random_accesses(dut):
    """With random accesses, with and without pauses, the data, the responses and the strobes match the
    register map.
    """
    rng, count = await start(dut), count_of(dut)
    bridge = 4 * count
    slave, master = StrobeSlave(dut, "model_wb_bus", count, rng), WishboneMaster(dut, "model_wb")
    mirror, want = Registers(count), []
    for _ in range(600):
        register, level, keep = rng.randrange(count), rng.randrange(2), rng.random() < 0.6
        dut.model_wb_bus_int_n.value = level
        sel = rng.choice((0xF, 0x1, rng.getrandbits(4)))
        value = rng.getrandbits(32)
        what = rng.choice(("write", "write", "read", "read", "bridge", "outside"))
        if what == "write":
            ok, _ = await master.access(4 * register, value, sel, keep)
            assert ok
            if sel & 1:
                mirror.write(register, value & 0xFF)
                want.append(("w", register, value & 0xFF))
        elif what == "read":
            ok, data = await master.access(4 * register, None, sel, keep)
            expected = mirror.read(register) if sel & 1 else 0
            assert (ok, data) == (True, expected), f"register {register}, SEL {sel:#x}: {data:#x}"
            if sel & 1:
                want.append(("r", register, expected))
        elif what == "bridge":
            master.idle()
            await master.clocks(3)
            assert int(dut.model_wb_bus_irq.value) == 1 - level
            assert await master.access(bridge, None, sel, keep) == (True, 1 - level)
        else:
            address = rng.randrange(bridge + 4, 2 * bridge, 4)
            assert await master.access(address, None, sel, keep) == (False, 0), "reserved word"
            for target in (address, bridge):
                assert not (await master.access(target, value, sel, keep))[0], f"write to {target:#x}"
        if not keep:
            await master.clocks(rng.randrange(6))
    master.idle()
    await master.clocks(4)
    assert slave.accesses() == want
    assert len(want) > 200, f"only {len(want)} strobes"


@cocotb.test()
async def wishbone_give_up(dut):
    """If the master withdraws requests, each strobe that has begun is complete, and no later access receives
    the response of a withdrawn request.
    """
    rng = await start(dut)
    slave, master = StrobeSlave(dut, "model_wb_bus", COUNT, rng), WishboneMaster(dut, "model_wb")
    answered = dropped = 0
    for n in range(300):
        await master.clocks(rng.randrange(12))
        register, other, value = rng.randrange(4), rng.randrange(4, COUNT), rng.getrandbits(8)
        first = len(slave.cycles)
        got = await master.give_up(4 * register, value if n % 2 else None, rng.randint(1, 10))
        answered, dropped = answered + got, dropped + (not got)
        await master.clocks(rng.choice((1, 1, 2, 5)))
        before = slave.registers.values[other]
        ok, data = await master.access(4 * other)
        assert (ok, data) == (True, before), f"access after a give-up: {data:#x}, wanted {before:#x}"
        await master.clocks(2)
        done = slave.accesses()[first:]
        assert done[-1] == ("r", other, before) and len(done) <= 2, done
        if len(done) == 2:
            assert done[0][:2] == ("w" if n % 2 else "r", register), done
        else:
            assert not got, "answered without a strobe"
    assert answered > 30 and dropped > 30, f"{answered} answered, {dropped} dropped"


@cocotb.test()
async def wishbone_latency(dut):
    """In an idle bridge, responses occur after the number of cycles in the header of the module, also for
    accesses without a pause between them.
    """
    rng = await start(dut)
    StrobeSlave(dut, "model_wb_bus", COUNT, rng)
    master = WishboneMaster(dut, "model_wb")
    for address, value, want in (
        (4, 1, WRITE_LATENCY),
        (4, None, READ_LATENCY),
        (BRIDGE, None, QUICK_LATENCY),
        (BRIDGE, 1, QUICK_LATENCY),
    ):
        await master.clocks(20)
        await master.access(address, value)
        assert master.latency == want, f"{address:#x}: {master.latency} cycles, the header says {want}"
    for value, want in ((1, WRITE_LATENCY + 1), (None, READ_LATENCY + 1)):
        await master.clocks(20)
        await master.access(4, 1, keep=True)
        await master.access(4, value)
        assert master.latency == want, f"in a row: {master.latency} cycles, the header says {want}"


@cocotb.test()
async def wishbone_part_moves(dut):
    """A PPMC-104 that a CPU accesses through the bridge behaves as the golden model does."""
    rng = await start(dut)
    monitor, master = PartMonitor(dut, "u_part_wb"), WishboneMaster(dut, "part_wb")

    async def read(address: int) -> int:
        await master.clocks(rng.randrange(8))
        ok, value = await master.access(address, sel=rng.choice((0x1, 0xF)))
        assert ok
        return value

    async def write(address: int, value: int) -> None:
        ok, _ = await master.access(address, value | rng.getrandbits(24) << 8)
        assert ok
        await RisingEdge(dut.clk)

    check_session(monitor, await run_session(read, write, lambda: int(dut.part_wb_irq.value)))
