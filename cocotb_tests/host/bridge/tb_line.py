"""UB-LIN: characters, rates, breaks, and two frames whose bytes are written out."""

from __future__ import annotations

import math

import cocotb

from cocotb_tests.harness import configs
from cocotb_tests.harness.jitter import jitters
from openppmc.host.frames import encode

from .bench import SECOND, Bench, now, same
from .settings import ALL_RATES, FAST, SLOW, baud_of, rates_of

# The CRC of the string "123456789" has the known check value 29B1. The bridge executes the string as a
# script, whose ops return 51 + 53 + 55 + 57 bytes.
LITERAL = bytes.fromhex("7E 31 32 33 34 35 36 37 38 39 29 B1 7E")
NOTHING = bytes.fromhex("7E 00 00 1D 0F 7E")  # SEQ 0, NOP; the answer (SEQ 0, RESULT 0) has the same bytes


@cocotb.test()
@configs(ALL_RATES)
async def line_literal_frames(dut):
    """The line idles high and starts at 115 200 baud; two frames have the bytes that are written out in this
    file (UB-LIN-01, UB-LIN-02, UB-FRM-01, UB-FRM-03).
    """
    bench = await Bench.start(dut)
    same("idle", (int(dut.txd_o.value), bench.edges), (1, []))
    await bench.send(NOTHING)
    await bench.message()
    same("line bytes", bytes(byte for _, byte in bench.line), NOTHING)
    await bench.send(LITERAL)
    answer = await bench.message()
    same("head and length", (answer[:2], len(answer)), (b"\x31\x00", 2 + 51 + 53 + 55 + 57))


@cocotb.test()
@configs(ALL_RATES, FAST)
async def line_rates(dut):
    """Each available code sets its rate once the answer to the request has been sent; all other codes are
    rejected (UB-LIN-02, UB-LIN-03, UB-LIN-07).
    """
    bench = await Bench.start(dut)
    rates = rates_of(bench.config)
    for code in [*range(7), 7, 8, 0x40, 255, *reversed(range(7))]:
        answer = await bench.ask(bytes([2, code]))
        if code not in rates:
            same(f"code {code}", answer, b"\x03\x00\x00")
            same("old rate still", await bench.done("06"), b"\xff")
            continue
        same(f"code {code}", answer, b"\x00")
        bench.baud = rates[code]
        bench.edges.clear()
        same("at the new rate", await bench.done("06 06"), b"\xff\xff")
        check_edges(bench)


def check_edges(bench: Bench) -> None:
    """Check the edges within each character.

    Each edge must be at the cycle nearest to its ideal time, where the start bit may be up to one cycle late.
    """
    bit = bench.config.clk_hz / bench.baud
    start, checked = None, 0
    for time, _ in bench.edges:
        if start is None or bench.clk_of(time - start) > 9.5 * bit:
            start = time
            continue
        clk = bench.clk_of(time - start)
        near = round(clk / bit) * bit
        assert -0.3 <= clk - near <= 1.3, f"{bench.baud} baud: edge after {clk} cycles, bit time {bit}"
        checked += 1
    assert checked > 10


@cocotb.test()
@configs(ALL_RATES)
async def line_tolerance(dut):
    """At every rate, the bridge receives characters without a pause from a host that is 2 % slow or fast
    (UB-LIN-03, UB-LIN-04).
    """
    bench = await Bench.start(dut)
    for code, rate in rates_of(bench.config).items():
        # The extra cycle of JITTER=1 at any phase exceeds the tolerance if a bit has fewer than 10 cycles.
        if jitters() and bench.config.clk_hz < 10 * rate:
            continue
        await bench.done(bytes([2, code]))
        bench.baud = rate
        for error in (-0.02, 0.02, -0.01, 0.01):
            bench.error = error
            data = bytes([0x00, 0xFF, 0x55, 0xAA, 0x01, 0x80, bench.rng.getrandbits(8)])
            await bench.done(bytes([0x84, len(data)]) + data)
            same(f"{rate} baud {error:+}", bench.accesses(), [("W", 4, byte) for byte in data])
        bench.error = 0.0


@cocotb.test()
@configs(SLOW)
async def line_middle(dut):
    """The bridge samples each bit only in its middle, and a short low level is not a start bit (UB-LIN-03,
    UB-LIN-04).
    """
    bench = await Bench.start(dut)
    for byte in (0x00, 0xFF, 0x55, 0xAA, 0x7E, 0x31):
        script = bytes([0x12, byte])
        for char in encode(b"\x00" + script):
            bits = [0, *(char >> n & 1 for n in range(8)), 1]
            # Each bit consists of ten slices. In data bits, the outer three slices at each end have the wrong
            # level, and the four middle slices have the correct level.
            slices = []
            for n, bit in enumerate(bits):
                wrong = 1 - bit if 1 <= n <= 8 else bit
                slices += [wrong] * 3 + [bit] * 4 + [wrong] * 3
            await bench.levels(slices, 0.1)
        bench.rxd.value = 1
        same("answer", await bench.message(), b"\x00\x00")
        same("write", bench.accesses(), [("W", 2, byte)])
    for low in (0.1, 0.25, 0.4):
        line = encode(b"\x00\x12\x77")
        await bench.send(line[:4])
        for _ in range(3):
            await bench.levels([0], low)
            await bench.levels([1], 2.0)
        await bench.send(line[4:])
        same(f"start of {low} bit", await bench.message(), b"\x00\x00")
        same("write", bench.accesses(), [("W", 2, 0x77)])


@cocotb.test()
@configs(FAST)
async def line_framing_error(dut):
    """A low stop bit within a frame causes one NAK 1, however long the line stays low; a low stop bit while
    the bridge waits for a flag causes no NAK (UB-LIN-05, UB-FRM-06).
    """
    bench = await Bench.start(dut)
    line = encode(b"\x05\x12\x34")
    await bench.send([0x55], stop=0)
    await bench.silent("in the hunt")
    await bench.send(line[:3])
    await bench.send([0x12], stop=0)
    same("NAK", await bench.message(), b"\x81\x01")
    await bench.send(line[4:-1])
    await bench.silent("hunt until a flag")
    await bench.send(line)
    same("the next frame is good", await bench.message(), b"\x05\x00")
    await bench.send(line[:3])
    await bench.levels([0], 60)
    bench.rxd.value = 1
    same("long low level", await bench.message(), b"\x81\x01")
    await bench.silent("only one")
    same("accesses", bench.accesses(), [("W", 2, 0x34)])


@cocotb.test()
@configs(ALL_RATES)
async def line_break(dut):
    """A break restores the rate after reset, and the bridge waits for a flag. While a higher rate is
    selected, a character 00 that is sent at the rate after reset is also a break (UB-LIN-05, UB-LIN-06,
    UB-FRM-08).
    """
    bench = await Bench.start(dut)
    for code in (1, 4):
        await bench.done(bytes([2, code]))
        bench.baud = rates_of(bench.config)[code]
        await bench.done("00")
        # A framing error that is not a break does not change the rate.
        await bench.send([0x10], stop=0)
        same("NAK", await bench.message(), b"\x81\x01")
        await bench.done("00")
        line = encode(b"\x00\x12\x01")
        await bench.send(line[:3])
        bench.baud = baud_of(bench.config)
        await bench.send([0x00])
        same("in a frame it is a framing error", await bench.message(), b"\x81\x01")
        await bench.send(line[3:-1])
        await bench.silent("hunt")
        await bench.done("00")
    # The break occurs during a script that requests another rate.
    await bench.send(encode(b"\x70\x02\x04\x77\x00\x01"))
    await bench.quiet()
    await bench.send([0x00], stop=0)
    same("wait ended", await bench.message(), b"\x70\x05\x02" + bytes([bench.accesses()[-1][2]]))
    same("NAK 7", await bench.message(), b"\x81\x07")
    await bench.done("00")


@cocotb.test()
@configs(SLOW)
async def line_rate_trial(dut):
    """The bridge returns to the old rate if no valid frame arrives within 1000 ms; after a valid frame it
    keeps the new rate (UB-LIN-07).
    """
    bench = await Bench.start(dut)
    await bench.done("02 01")
    switched, bench.baud = now(), 230_400
    await bench.ms(990)
    wrong = bytearray(encode(b"\x00\x00"))
    wrong[2] ^= 1
    await bench.send(wrong)
    same("a bad frame does not count", await bench.message(), b"\x81\x02")
    await bench.ms(1002 - (now() - switched) * 1000 / SECOND)
    bench.baud = 115_200
    await bench.done("02 01")
    switched, bench.baud = now(), 230_400
    await bench.ms(998)
    await bench.done("00")
    assert (now() - switched) * 1000 / SECOND < 1000
    await bench.ms(1100)
    await bench.done("00")


@cocotb.test()
@configs(ALL_RATES)
async def line_no_drift(dut):
    """The average bit time is exactly the frequency of `clk` divided by the rate: no edge of a long answer
    drifts (UB-LIN-03).
    """
    bench = await Bench.start(dut)
    bench.slave.registers[2] = 0x55
    await bench.done("32 20")
    check_edges(bench)
    bit = bench.config.clk_hz / bench.baud
    starts = [t for (t, level), (before, _) in zip(bench.edges[1:], bench.edges, strict=False) if level == 0]
    assert len(starts) > 20 and math.isclose(bit, 130.21, abs_tol=0.01)
