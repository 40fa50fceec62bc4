"""UB-WAIT, UB-OPS-01: conditions, time limits and interruption of POST, CALL, GET and WAIT."""

from __future__ import annotations

import cocotb

from cocotb_tests.harness import configs
from openppmc.host.frames import encode

from .bench import SECOND, Bench, now, same
from .settings import FAST, SLOW
from .slave import ERR, IBF, OBF, RegisterModel


@cocotb.test()
@configs(FAST)
async def waits_handshake(dut):
    """A status with IBF = 0 is read before each write, and one with OBF = 1 before each data read; the bytes
    are in order (UB-OPS-01, UB-WAIT-01, UB-OPS-02).
    """
    bench = await Bench.start(dut, RegisterModel(lag=4))
    for _ in range(30):
        n = bench.rng.randint(1, 15)
        command = bytes([3, *(bench.rng.getrandbits(8) for _ in range(n - 1))])
        data = await bench.done(bytes([0x50 | n]) + command + b"\x63" + b"\x46\x02\x0a\x0b")
        log = bench.accesses()
        writes = [("W", 1, 3)] + [("W", 0, byte) for byte in command[1:]] + [("W", 6, 10), ("W", 6, 11)]
        same("writes", [entry for entry in log if entry[0] == "W"], writes)
        reads = bytes(byte for kind, a, byte in log if (kind, a) == ("R", 0))
        same("data read", data[1:], reads)
        for n, (kind, a, _) in enumerate(log):
            status = log[n - 1][2] if n else 0
            if kind == "W":
                assert log[n - 1][:2] == ("R", 1) and not status & IBF, f"write with IBF, {log}"
                if a < 2:
                    assert log[n + 1][:2] == ("R", 1), f"no look at IBF after a byte of CALL, {log}"
            elif a == 0:
                assert log[n - 1][:2] == ("R", 1) and status & OBF, f"read without OBF, {log}"
        # CALL returns the status that its last wait has read.
        end = max(n for n, (kind, a, _) in enumerate(log) if kind == "W" and a < 2) + 1
        while log[end][2] & IBF:
            end += 1
        same("status", data[0], log[end][2])


@cocotb.test()
@configs(FAST)
async def waits_refused(dut):
    """If ERR is set after a byte of CALL, the result is 2 without a status byte, and no further byte is
    written (UB-ANS-02, UB-ANS-04, UB-OPS-01).
    """
    bench = await Bench.start(dut, RegisterModel(refuse=1.0))
    answer = await bench.ask("00 24 53 11 22 33")
    log = bench.accesses()
    same("head", answer, bytes([2, 2, log[-1][2], log[0][2]]))
    assert log[-1][2] & ERR
    same("writes", [entry for entry in log if entry[0] == "W"], [("W", 1, 0x11)])
    # POST ignores ERR. CALL ignores an error that was set before its first byte.
    await bench.done("40 02 01 02")
    bench.slave.refuse = 0.0
    same("cleared by the command", len(await bench.done("51 00")), 1)


@cocotb.test()
@configs(FAST)
async def waits_condition(dut):
    """WAIT compares register AND mask with the value and returns the complete byte (UB-WAIT-01,
    UB-OPS-02).
    """
    bench = await Bench.start(dut)
    for _ in range(40):
        a, mask, byte = bench.rng.randint(2, 15), bench.rng.getrandbits(8), bench.rng.getrandbits(8)
        bench.slave.registers[a] = byte
        same("at once", await bench.done(bytes([0x70 | a, mask, byte & mask])), bytes([byte]))
        same("one read", bench.accesses(), [("R", a, byte)])
    for a, mask in ((2, 0x80), (5, 0x01), (9, 0x0F)):
        data = await bench.done(bytes([0x70 | a, mask, 0x00]))
        log = bench.accesses()
        same("byte", data[0], log[-1][2])
        same("first that fits", [byte & mask == 0 for _, _, byte in log], [False] * (len(log) - 1) + [True])
    # A value bit outside the mask can never match.
    same("never", (await bench.ask("04 00 00 72 00 01"))[:2], b"\x01\x03")


@cocotb.test()
@configs(SLOW)
async def waits_time(dut):
    """A wait that fails returns result 1 after its limit (default 250 ms) and at most 1 ms later; with limit
    0 it reads once (UB-WAIT-01, UB-ANS-02, UB-ANS-04).
    """
    bench = await Bench.start(dut)
    bench.slave.hold_ibf, bench.slave.hold_obf = 1, 0
    cases = (
        ("52 01 02", 250, 0),
        ("04 01 00 41 01 55", 1, 3),
        ("04 03 00 04 1E 00 61", 30, 6),
        ("04 00 00 61", 0, 3),
        ("04 00 00 51 01", 0, 3),
        ("04 00 00 71 02 00", 0, 3),
        ("04 00 01 71 02 00", 256, 3),
    )
    for text, limit, place in cases:
        await bench.send(encode(b"\x00" + bytes.fromhex(text)))
        start = now()
        answer = await bench.message(limit + 30)
        log = bench.accesses()
        same(text, answer, bytes([0, 1, place, log[-1][2]]))
        # The answer begins shortly after the end of the wait; `begun` is the start of the first character.
        begun = bench.line[-len(encode(answer))][0] - round(9.5 * bench.bit_ps())
        took = (begun - start) * 1000 / SECOND
        assert limit - 0.1 <= took <= limit + 1.3, f"{text}: {took} ms"
        same("accesses", ({entry[:2] for entry in log}, len(log) == 1), ({("R", 1)}, limit == 0))
        if limit:
            # A wait reads without pauses: one read per 10 cycles, and at most 3 more cycles for the decision.
            assert len(log) >= limit * bench.config.clk_hz / 1000 / 13, f"only {len(log)} reads in {limit} ms"
    bench.slave.hold_ibf = 0
    answer = await bench.ask("04 01 00 51 07 61", ms=100)
    same("data before the wait that failed", answer, b"\x01\x05\x40\x40")
    # The limit applies to each wait, not to the whole script; the next script begins with 250 ms again.
    bench.slave.hold_obf = 1
    same("GET keeps what it has read", len(await bench.done("04 00 00 62 42 02 01 02")), 2)


@cocotb.test()
@configs(SLOW)
async def waits_limit_each(dut):
    """The limit restarts for each wait of an op: a POST with waits of 2 ms each succeeds with a limit of 3 ms
    (UB-WAIT-01).
    """

    class Lazy(RegisterModel):
        def read(self, a: int) -> int:
            self.hold_ibf = int(now() - written[-1] < 2 * SECOND // 1000)
            return super().read(a)

        def write(self, a: int, byte: int) -> None:
            written.append(now())
            super().write(a, byte)

    written = [0]
    bench = await Bench.start(dut, Lazy())
    await bench.done("04 03 00 40 04 01 02 03 04")
    same("bytes", len(written), 5)
    assert written[-1] - written[1] >= 6 * SECOND // 1000
    answer = await bench.ask("04 01 00 40 04 01 02 03 04")
    same("1 ms is too short", answer[:2], b"\x01\x03")


@cocotb.test()
@configs(FAST)
async def waits_interrupted(dut):
    """Received bytes end a wait with result 5, but flags do not (UB-FRM-07, UB-WAIT-01, UB-ANS-02)."""
    bench = await Bench.start(dut)
    bench.slave.hold_obf = 0
    frames = (("24 61", 1, [0x00]), ("04 E8 03 72 00 01", 3, [0x7D]), ("61", 0, encode(b"\x05\x13\x44")[1:]))
    for text, place, more in frames:
        bench.accesses()
        await bench.send(encode(b"\x01" + bytes.fromhex(f"07{place:02x}" + text)))
        await bench.send(b"\x7e" * 8)
        await bench.quiet(50)
        assert int(dut.active_o.value) == 1 and not bench.got, "a flag ended the wait"
        start = now()
        await bench.send(more)
        answer = await bench.message()
        log = bench.accesses()
        same(text, answer[:4], bytes([1, 5, place + 2, log[-1][2]]))
        begun = bench.line[-len(encode(answer))][0] - 9.5 * bench.bit_ps()
        # The wait ends immediately: within one read access after the middle of the first stop bit.
        assert 0 <= bench.clk_of(begun - start - 9.5 * bench.bit_ps()) <= 45
        same("NAK 7", await bench.message(), b"\x81\x07")
        await bench.silent("the bytes are dropped")
        bench.seq = 1
        await bench.done("07 FF")
        assert ("W", 3, 0x44) not in bench.accesses()
