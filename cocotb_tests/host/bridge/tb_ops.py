"""Ops without waits, accesses to the part (UB-BUS-01), reset pulse, straps, counter, and answers with too
many data bytes.
"""

from __future__ import annotations

import struct

import cocotb

from cocotb_tests.harness import configs

from .bench import Bench, now, same
from .settings import ALL_RATES, FAST, NONE, SLOW, TWO, axes_of, params_of


@cocotb.test()
@configs(FAST, ALL_RATES, SLOW, TWO, NONE)
async def ops_ident(dut):
    """IDENT returns the 16 bytes of the table in the contract (UB-OPS-02)."""
    bench = await Bench.start(dut)
    params = params_of(bench.config)
    top = {8_000_000: 4, 15_000_000: 6, 2_000_000: 1}[bench.config.clk_hz]
    counter = params.get("Counter", 1) << 1
    flags = top << 4 | axes_of(bench.config) - 1 << 2 | counter | params.get("Datasheet", 0)
    part = params.get("Part", 104)
    want = b"PPMC\x01" + struct.pack("<HBII", part, flags, 16_000_000, bench.config.clk_hz)
    same("IDENT", await bench.done("01"), want)
    same("among others", await bench.done("06 01 06"), b"\xff" + want + b"\xff")


@cocotb.test()
@configs(FAST)
async def ops_bus_cycles(dut):
    """Accesses to registers 0 to 15 have the correct order, address, strobe length and gap, exact to the
    cycle (UB-OPS-02, UB-BUS-01).
    """
    bench = await Bench.start(dut)
    bench.slave.registers[7] = 0x31
    script = b"".join(bytes([0x10 | a, 0x80 + a]) for a in range(16)) + bytes([0x27, 0x8A, 3, 1, 2, 3])
    script += bytes([0x3F, 2, 0x2C, 0x11, 0xEE])
    await bench.quiet()
    bench.strobes.clear()
    data = await bench.done(script)
    want = [("W", a, 0x80 + a) for a in range(16)] + [("R", 7, 0x87)]
    want += [("W", 10, 1), ("W", 10, 2), ("W", 10, 3)]
    log = bench.accesses()
    same("accesses", log[:20], want)
    same("kinds", [(k, a) for k, a, _ in log[20:]], [("R", 15), ("R", 15), ("R", 12), ("W", 1)])
    same("data", data, bytes(byte for kind, _, byte in log if kind == "R"))
    assert check_strobes(bench) == len(log)


def check_strobes(bench: Bench) -> int:
    """Check that all recorded pin changes satisfy UB-BUS-01; return the number of accesses."""
    falls = {"rd_no": 0, "wr_no": 0, "cs_no": 0}
    last_rise = last_change = -(10**9)
    cycles = 0
    for time, pin, level in bench.strobes:
        clk = round(bench.clk_of(time), 3)
        if pin in ("a_o", "d_o"):
            assert clk - last_rise >= 1, f"{pin} changes {clk - last_rise} cycles after the strobe"
            last_change = clk
        elif level == 0:
            falls[pin] = clk
            if pin != "cs_no":
                assert clk - last_change >= 1, f"strobe {clk - last_change} cycles after {pin}"
                assert clk - last_rise >= 4, f"only {clk - last_rise} cycles between two strobes"
        else:
            same(
                f"length of {pin}",
                clk - falls[pin] in ((4, 6) if pin == "cs_no" else (4,) if pin == "wr_no" else (6,)),
                True,
            )
            if pin != "cs_no":
                last_rise = clk
                cycles += 1
    return cycles


@cocotb.test()
@configs(FAST)
async def ops_counts(dut):
    """READN, WRITEN and POST work with a count of 1 and with their maximum counts (UB-OPS-02)."""
    bench = await Bench.start(dut)
    for n in (1, 2, 251):
        data = bytes(bench.rng.getrandbits(8) for _ in range(n))
        await bench.done(bytes([0x83, n]) + data)
        same("WRITEN", bench.accesses(), [("W", 3, byte) for byte in data])
    for n in (1, 2, 255):
        data = await bench.done(bytes([0x33, n]))
        same("READN", [("R", 3, byte) for byte in data], bench.accesses())
        same("n", len(data), n)
    bench.slave.lag = 2
    for n in (1, 100):
        data = bytes(bench.rng.getrandbits(8) for _ in range(n))
        await bench.done(bytes([0x40, n]) + data)
        log = bench.accesses()
        same("POST", [entry for entry in log if entry[0] == "W"], [("W", 0, byte) for byte in data])
        for (kind, a, byte), entry in zip(log, log[1:], strict=False):
            if entry[0] == "W":
                assert (kind, a) == ("R", 1) and not byte & 2, "written without a look at IBF"
    assert check_strobes(bench) > 800


@cocotb.test()
@configs(FAST)
async def ops_illegal(dut):
    """Unknown, truncated or illegal ops return result 3 and have no effect (UB-ANS-02, UB-ANS-03,
    UB-ANS-05, UB-OPS-02).
    """
    bench = await Bench.start(dut)
    bad = [bytes([code]) for code in (0x0A, 0x0B, 0x0D, 0x0E, 0x0F)] + [b"\x0d\x01", b"\x90\x01"]
    bad += [bytes([group << 4 | bench.rng.randrange(16), 0, 0]) for group in range(9, 16)]
    bad += [b"\x02", b"\x02\x07", b"\x02\x05", b"\x02\x80", b"\x03", b"\x03\x02", b"\x03\x81", b"\x07"]
    bad += [
        b"\x04",
        b"\x04\x01",
        b"\x12",
        b"\x33",
        b"\x33\x00",
        b"\x43",
        b"\x43\x00",
        b"\x43\x02\x01",
        b"\x50",
    ]
    bad += [b"\x51", b"\x55\x01\x02\x03\x04", b"\x60", b"\x71", b"\x71\x00", b"\x83", b"\x83\x00"]
    bad += [b"\x83\x03\x01\x02", b"\x83\xff" + bytes(240), b"\x5f" + bytes(14)]
    for op in bad:
        prefix = bench.rng.choice(("", "00", "12 21", "24", "0000"))
        before = bytes.fromhex(prefix)
        answer = await bench.ask(before + op)
        log = bench.accesses()
        read = bytes(byte for kind, _, byte in log if kind == "R")
        last = read[-1] if read else 0
        same(f"{prefix} {op.hex()}", answer, bytes([3, len(before), last]) + read)
        same("accesses", len(log), len(before) if prefix == "24" else prefix == "12 21")
    # The script has the maximum length, and its last op lacks one byte.
    answer = await bench.ask(b"\x00" * 240 + b"\x83\x0c" + bytes(11))
    same("POS 240", answer, bytes([3, 240, 0]))
    same("accesses", bench.accesses(), [])
    same("straps", int(dut.straps_o.value), 0xFF)


@cocotb.test()
@configs(FAST)
async def ops_overflow(dut):
    """An answer contains at most 256 data bytes; a further byte causes result 4 (UB-ANS-02, UB-ANS-04,
    UB-ANS-05).
    """
    bench = await Bench.start(dut)
    fill = bytes([0x32, 255])
    same("256", len(await bench.done(fill + b"\x06")), 256)
    bench.accesses()
    # (data bytes of the fill op, ops after it, their read accesses, their data bytes, number of ops between
    # the fill op and the op that fails). Each of the ops in between is one byte long.
    cases = [
        (255, "06 06", 0, 1, 1),
        (255, "22 22", 1, 1, 1),
        (250, "32 0A", 6, 6, 0),
        (250, "22 32 06", 6, 6, 1),
        (253, "08", 0, 0, 0),
        (241, "01", 0, 0, 0),
        (255, "06 72 00 00", 0, 1, 1),
        (255, "06 51 00", 0, 1, 1),
    ]
    for size, text, reads, more, place in cases:
        answer = await bench.ask(bytes([0x32, size]) + bytes.fromhex(text))
        log = bench.accesses()
        same(f"{size}, {text}: head", answer[:3], bytes([4, 2 + place, log[-1][2]]))
        same("data", len(answer) - 3, size + more)
        same("accesses", (len(log), {kind for kind, _, _ in log}), (size + reads, {"R"}))
    for size, text, more in ((252, "08", 4), (240, "01", 16), (249, "32 06 06", 7)):
        answer = await bench.ask(bytes([0x32, size]) + bytes.fromhex(text))
        same(f"{size}, {text} has room", (answer[0], len(answer) - 1), (0, size + more))
    bench.accesses()
    # An answer contains those bytes of a GET that fit.
    bench.slave.hold_obf = 1
    answer = await bench.ask(bytes([0x32, 254]) + b"\x63")
    same("GET", (answer[:2], len(answer) - 3), (b"\x04\x02", 256))
    same("reads of the data register", sum(a == 0 for _, a, _ in bench.accesses()), 2)


@cocotb.test()
@configs(FAST)
async def ops_board(dut):
    """PINS, STRAPS and ZERO have their effects, and COUNT returns one snapshot. RESET is active for 16
    cycles; a pause follows (UB-OPS-02).
    """
    bench = await Bench.start(dut)
    for level in (0x00, 0x81, 0x7E, 0x55):
        dut.pins_i.value = level
        same("PINS", await bench.done("06"), bytes([level]))
    same("after reset", int(dut.straps_o.value), 0xFF)
    for level in (0x00, 0xA5, 0xFF, 0x5A):
        await bench.done(bytes([7, level]))
        same("STRAPS", int(dut.straps_o.value), level)
    for value in (0, -1, 0x12345678, -0x80000000, 0x7FFFFFFF):
        dut.count_i.value = value & 0xFFFFFFFF
        same("COUNT", await bench.done("08"), value.to_bytes(4, "little", signed=True))
    changes = watch(bench, dut.count_zero_o)
    await bench.done("00 09 00")
    same("ZERO", [level for _, level in changes], [1, 0])
    same("one cycle", bench.clk_of(changes[1][0] - changes[0][0]), 1)
    resets = watch(bench, dut.part_rst_no)
    bench.strobes.clear()
    await bench.done("05 12 01")
    same("RESET", [level for _, level in resets], [0, 1])
    same("16 cycles", bench.clk_of(resets[1][0] - resets[0][0]), 16)
    strobe = next(time for time, pin, level in bench.strobes if pin == "wr_no" and not level)
    assert 16 <= bench.clk_of(strobe - resets[1][0]) <= 24, "pause after the reset"
    same("straps stay", int(dut.straps_o.value), 0x5A)


def watch(bench: Bench, pin) -> list[tuple[int, int]]:
    """Return a list to which (time, level) of each change of the pin is appended."""
    changes: list[tuple[int, int]] = []

    async def run() -> None:
        while True:
            await cocotb.triggers.ValueChange(pin)
            changes.append((now(), int(pin.value)))

    cocotb.start_soon(run())
    return changes


@cocotb.test()
@configs(TWO)
async def ops_two_counters(dut):
    """COUNT and ZERO of axis 2 use the counter of axis 2; the op codes that follow these remain illegal
    (UB-OPS-02, UB-ANS-05).
    """
    bench = await Bench.start(dut)
    for first, second in ((0, -1), (0x12345678, -0x80000000), (-2, 0x7D7E5A81)):
        dut.count_i.value = (second & 0xFFFFFFFF) << 32 | first & 0xFFFFFFFF
        want = struct.pack("<iiii", second, first, first, second)
        same("COUNT of both", await bench.done("0A 08 08 0A"), want)
    changes = watch(bench, dut.count_zero_o)
    await bench.done("0B")
    same("ZERO of axis 2", [level for _, level in changes], [2, 0])
    changes.clear()
    await bench.done("09 00 0B")
    same("ZERO of both", [level for _, level in changes], [1, 0, 2, 0])
    answer = await bench.ask(bytes([0x32, 253]) + b"\x0a")
    same("no room", (answer[0], len(answer) - 3), (4, 253))
    for code in range(0x0D, 0x10):
        same("illegal", await bench.ask(bytes([code])), bytes([3, 0, 0]))


@cocotb.test()
@configs(TWO)
async def ops_two_snapshots(dut):
    """While both counters count, COUNT of axis 2 returns a value that its counter has had, never a mixture of
    two values (UB-OPS-02).
    """
    bench = await Bench.start(dut)

    async def run() -> None:
        step = 1
        first, second = 0x7FFFFFF0, 0x00FFFFF0
        while True:
            for n in range(32):
                second += step
                first += n & 1
                dut.count_i.value = second << 32 | first & 0xFFFFFFFF
                await bench.clocks(5)
            step = -step

    cocotb.start_soon(run())
    seen = set()
    for _ in range(6):
        data = await bench.done("0A 00" * 50)
        for n in range(0, 200, 4):
            value = int.from_bytes(data[n : n + 4], "little")
            assert 0x00FFFFF0 <= value <= 0x01000010, f"COUNT {value:08x}"
            seen.add(value >> 24)
    same("both sides of the carry", seen, {0, 1})


@cocotb.test()
@configs(FAST)
async def ops_count_snapshot(dut):
    """While the counter counts, COUNT returns a value that the counter has had, never a mixture of two values
    (UB-OPS-02).
    """
    bench = await Bench.start(dut)

    async def run() -> None:
        value, step = 0x00FFFFF0, 1
        while True:
            # A carry of the counter passes through three bytes, in both directions.
            for _ in range(32):
                value += step
                dut.count_i.value = value
                await bench.clocks(5)
            step = -step

    cocotb.start_soon(run())
    seen = set()
    for _ in range(12):
        data = await bench.done("08 00" * 50)
        for n in range(0, 200, 4):
            value = int.from_bytes(data[n : n + 4], "little")
            assert 0x00FFFFF0 <= value <= 0x01000010, f"COUNT {value:08x}"
            seen.add(value >> 24)
    same("both sides of the carry", seen, {0, 1})
