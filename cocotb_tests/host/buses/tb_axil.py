"""ppmc_axil with the master of cocotbext-axi: handshakes, register map, strobes, and a PPMC-104 that
moves.
"""

from __future__ import annotations

import itertools
import random
from collections.abc import Iterator
from typing import Any

import cocotb
from cocotb.triggers import Combine, RisingEdge, with_timeout
from cocotbext.axi import AxiLiteBus, AxiLiteMaster, AxiResp

from cocotb_tests.harness import F16, configs

from .session import PartMonitor, check_session, run_session
from .setting import TEN_LINES, count_of, start
from .strobe_slave import Registers, StrobeSlave

COUNT = 8
BRIDGE = 4 * COUNT
WRITE_LATENCY, READ_LATENCY, QUICK_LATENCY = 8, 10, 2


def make_master(dut: Any, prefix: str) -> AxiLiteMaster:
    """Return a master at the pins `<prefix>_*`."""
    return AxiLiteMaster(AxiLiteBus.from_prefix(dut, prefix), dut.clk)


def channels(master: AxiLiteMaster) -> dict[str, Any]:
    """Return the five channels of a master; each channel can pause."""
    write, read = master.write_if, master.read_if
    return {
        "aw": write.aw_channel,
        "w": write.w_channel,
        "b": write.b_channel,
        "ar": read.ar_channel,
        "r": read.r_channel,
    }


def pauses(rng: random.Random, share: float) -> Iterator[bool]:
    """Yield stalls of random length that occupy the fraction `share` of the time."""
    while True:
        stalled = rng.random() < share
        yield from itertools.repeat(stalled, rng.randint(1, 12))


async def read_word(master: AxiLiteMaster, address: int) -> tuple[int, int]:
    """Make a 32-bit read; return (response, data)."""
    answer = await with_timeout(master.read(address, 4), 1, "ms")
    return int(answer.resp), int.from_bytes(answer.data, "little")


async def write_bytes(master: AxiLiteMaster, address: int, data: bytes) -> int:
    """Make a write; return its response. Byte lanes outside `data` have WSTRB = 0."""
    return int((await with_timeout(master.write(address, data), 1, "ms")).resp)


@cocotb.test()
@configs(F16, TEN_LINES)
async def axil_random_accesses(dut):
    """With random accesses and stalls on all channels, the data, the responses and the strobes match the
    register map.
    """
    rng, count = await start(dut), count_of(dut)
    bridge = 4 * count
    slave, master = StrobeSlave(dut, "model_axil_bus", count, rng), make_master(dut, "model_axil")
    mirror, want = Registers(count), []
    for share in (0.0, 0.3, 0.7):
        for channel in channels(master).values():
            channel.set_pause_generator(pauses(rng, share))
        for _ in range(120):
            register, level = rng.randrange(count), rng.randrange(2)
            dut.model_axil_bus_int_n.value = level
            what = rng.choice(("write", "write", "lanes", "read", "read", "bridge", "outside"))
            if what == "write":
                value = rng.getrandbits(32)
                length = rng.choice((1, 2, 3, 4))
                resp = await write_bytes(master, 4 * register, value.to_bytes(4, "little")[:length])
                assert resp == AxiResp.OKAY
                mirror.write(register, value & 0xFF)
                want.append(("w", register, value & 0xFF))
            elif what == "lanes":
                lane = rng.randint(1, 3)
                data = rng.randbytes(rng.randint(1, 4 - lane))
                assert await write_bytes(master, 4 * register + lane, data) == AxiResp.OKAY
            elif what == "read":
                expected = mirror.read(register)
                assert await read_word(master, 4 * register) == (AxiResp.OKAY, expected), (
                    f"register {register}"
                )
                want.append(("r", register, expected))
            elif what == "bridge":
                for _ in range(3):
                    await RisingEdge(dut.clk)
                assert int(dut.model_axil_bus_irq.value) == 1 - level
                assert await read_word(master, bridge) == (AxiResp.OKAY, 1 - level)
            else:
                address = rng.randrange(bridge + 4, 2 * bridge, 4)
                assert await read_word(master, address) == (AxiResp.SLVERR, 0)
                for target in (address, bridge):
                    assert await write_bytes(master, target, b"\xff" * 4) == AxiResp.SLVERR
            assert slave.accesses() == want, f"after {what}: {slave.cycles[-2:]}, wanted {want[-2:]}"
    assert len(want) > 100, f"only {len(want)} strobes"


@cocotb.test()
async def axil_reads_and_writes_at_once(dut):
    """Parallel queues of reads and of writes each keep their order, and neither blocks the other."""
    rng = await start(dut)
    slave, master = StrobeSlave(dut, "model_axil_bus", COUNT, rng), make_master(dut, "model_axil")
    written = [(rng.randrange(4), rng.getrandbits(8)) for _ in range(150)]
    fetched = [rng.randrange(4, COUNT) for _ in range(150)]
    mirror = Registers(COUNT)
    expected = [mirror.read(register) for register in fetched]

    async def write_all() -> None:
        events = [master.init_write(4 * register, bytes([value])) for register, value in written]
        for event in events:
            await event.wait()
            assert event.data.resp == AxiResp.OKAY

    async def read_all() -> None:
        events = [master.init_read(4 * register, 4) for register in fetched]
        for event, value in zip(events, expected, strict=True):
            await event.wait()
            assert int.from_bytes(event.data.data, "little") == value
            assert event.data.resp == AxiResp.OKAY

    await with_timeout(Combine(cocotb.start_soon(write_all()), cocotb.start_soon(read_all())), 2, "ms")
    done = slave.accesses()
    assert [(a, v) for kind, a, v in done if kind == "w"] == written
    assert [(a, v) for kind, a, v in done if kind == "r"] == list(zip(fetched, expected, strict=True))
    kinds = "".join(kind for kind, _, _ in done)
    assert "www" not in kinds[:280] and "rrr" not in kinds[:280], f"one channel waited: {kinds}"


@cocotb.test()
async def axil_channel_order(dut):
    """A write causes exactly one strobe, also if AW is long before W, W is long before AW, or the master does
    not accept the response at first.
    """
    rng = await start(dut)
    slave, master = StrobeSlave(dut, "model_axil_bus", COUNT, rng), make_master(dut, "model_axil")
    channel, want = channels(master), []
    for late in ("aw", "w", "aw", "w"):
        value = rng.getrandbits(8)
        channel[late].pause = True
        event = master.init_write(4 * 3, bytes([value]))
        for _ in range(30):
            await RisingEdge(dut.clk)
        assert slave.accesses() == want, f"strobe before {late}"
        assert not int(dut.model_axil_bvalid.value), f"B before {late}"
        channel[late].pause = False
        await with_timeout(event.wait(), 1, "ms")
        want.append(("w", 3, value))
        assert slave.accesses() == want
    # While the master does not accept B, the next write may wait in the bridge, and reads are executed.
    channel["b"].pause = True
    events = [master.init_write(4 * n, bytes([n])) for n in (1, 2)]
    for _ in range(40):
        await RisingEdge(dut.clk)
    want.append(("w", 1, 1))
    assert slave.accesses() == want and int(dut.model_axil_bvalid.value), "a write behind an answer not taken"
    assert (await read_word(master, 4 * 1))[1] == 1
    want.append(("r", 1, 1))
    # Errors of these reads do not change the response on B.
    assert (await read_word(master, BRIDGE + 4))[0] == AxiResp.SLVERR
    channel["b"].pause = False
    for event in events:
        await with_timeout(event.wait(), 1, "ms")
        assert event.data.resp == AxiResp.OKAY
    want.append(("w", 2, 2))
    # While the master does not accept R, R must keep its data. During this time a write and another read
    # either wait or are executed.
    channel["r"].pause = True
    reads = [master.init_read(4 * n, 4) for n in (1, 2)]
    await write_bytes(master, 4 * 5, b"\x77")
    for _ in range(40):
        await RisingEdge(dut.clk)
    assert int(dut.model_axil_rdata.value) == 2 and int(dut.model_axil_rvalid.value)
    assert slave.accesses()[len(want) :] in ([("r", 1, 2), ("w", 5, 0x77)], [("w", 5, 0x77), ("r", 1, 2)])
    channel["r"].pause = False
    for event, value in zip(reads, (2, 2), strict=True):
        await with_timeout(event.wait(), 1, "ms")
        assert int.from_bytes(event.data.data, "little") == value


@cocotb.test()
async def axil_latency(dut):
    """In an idle bridge, B and R become valid after the number of cycles in the header of the module."""
    rng = await start(dut)
    StrobeSlave(dut, "model_axil_bus", COUNT, rng)
    edge = RisingEdge(dut.clk)
    for valids, answer, address, want in (
        (("awvalid", "wvalid"), "bvalid", 4, WRITE_LATENCY),
        (("arvalid",), "rvalid", 4, READ_LATENCY),
        (("arvalid",), "rvalid", BRIDGE, QUICK_LATENCY),
        (("awvalid", "wvalid"), "bvalid", BRIDGE, QUICK_LATENCY),
    ):
        for _ in range(20):
            await edge
        pin = {name: getattr(dut, f"model_axil_{name}") for name in (*valids, answer)}
        dut.model_axil_araddr.value = dut.model_axil_awaddr.value = address
        dut.model_axil_wstrb.value = 0xF
        for name in valids:
            pin[name].value = 1
        await edge
        for name in valids:
            pin[name].value = 0
        waited = 0
        while not int(pin[answer].value):
            await edge
            waited += 1
            assert waited < 50, f"no {answer}"
        assert waited == want, f"{answer} at {address:#x}: {waited} cycles, the header says {want}"
        dut.model_axil_bready.value = dut.model_axil_rready.value = 1
        await edge
        dut.model_axil_bready.value = dut.model_axil_rready.value = 0


@cocotb.test()
async def axil_part_moves(dut):
    """A PPMC-104 that a CPU accesses through the bridge behaves as the golden model does."""
    rng = await start(dut)
    monitor, master = PartMonitor(dut, "u_part_axil"), make_master(dut, "part_axil")
    for channel in channels(master).values():
        channel.set_pause_generator(pauses(rng, 0.3))

    async def read(address: int) -> int:
        resp, value = await read_word(master, address)
        assert resp == AxiResp.OKAY
        return value

    async def write(address: int, value: int) -> None:
        assert await write_bytes(master, address, bytes([value])) == AxiResp.OKAY

    check_session(monitor, await run_session(read, write, lambda: int(dut.part_axil_irq.value)))
