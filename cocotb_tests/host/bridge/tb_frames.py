"""UB-FRM: flags, escapes, CRC, lengths, faults, and bytes during a script or an answer."""

from __future__ import annotations

import cocotb

from cocotb_tests.harness import configs
from openppmc.host.frames import crc16, encode

from .bench import SECOND, Bench, now, same
from .settings import FAST, SLOW


def nak(code: int) -> bytes:
    """Return the payload of a NAK."""
    return bytes([0x81, code])


def script_of(length: int) -> bytes:
    """Return a script of this length: a WRITEN to register 3, filled up with NOPs."""
    return b"\x00" * length if length < 3 else b"\x83\x01\x99" + b"\x00" * (length - 3)


@cocotb.test()
@configs(FAST)
async def frames_flags_and_escapes(dut):
    """The bridge accepts repeated and shared flags, escapes of any byte, and noise before a flag
    (UB-FRM-01, UB-FRM-02, UB-FRM-05).
    """
    bench = await Bench.start(dut)
    line = encode(b"\x01\x12\x7e\x13\x7d\x14\x5d")
    assert bytes.fromhex("127D5E137D5D145D") in line
    want = [("W", 2, 0x7E), ("W", 3, 0x7D), ("W", 4, 0x5D)]
    content = b"\x02\x12\x7e\x13\x7d\x14\x5d"
    content += crc16(content).to_bytes(2, "big")
    everything_escaped = b"\x7e" + b"".join(bytes([0x7D, byte ^ 0x20]) for byte in content) + b"\x7e"
    # The byte 5D is escaped as 7D 7D. The content must not contain the byte 5E, which would be escaped as 7D
    # 7E and end the frame.
    assert b"\x7d\x7d" in everything_escaped and b"\x7d\x7e" not in everything_escaped
    cases = (
        (b"\x11\x22\x7d" + line, 1),
        (b"\x7e\x7e\x7e" + encode(b"\x03" + line[2:8].replace(b"\x7d\x5e", b"\x7e") + b"\x00"), 3),
        (everything_escaped, 2),
    )
    for data, seq in cases[::2]:
        await bench.send(data)
        same("answer", await bench.message(), bytes([seq, 0]))
        same("writes", bench.accesses(), want)
    await bench.send(b"\x7e\x7e\x7e" + encode(b"\x03\x12\x34") + b"\x7e\x7e\x7e")
    same("flags in a row", await bench.message(), b"\x03\x00")
    await bench.send(encode(b"\x04\x12\x35")[1:])
    same("the flag before is enough", await bench.message(), b"\x04\x00")
    same("writes", bench.accesses(), [("W", 2, 0x34), ("W", 2, 0x35)])
    await bench.silent("nothing more")
    # The bridge also escapes bytes of answers: data, and in some cases a byte of the CRC.
    for _ in range(40):
        data = bytes(bench.rng.choice((0x7D, 0x7E, bench.rng.getrandbits(8))) for _ in range(3))
        script = b"".join(bytes([0x12, byte, 0x22]) for byte in data)
        same("data", await bench.done(script), data)


@cocotb.test()
@configs(FAST)
async def frames_every_bit(dut):
    """A frame in which any one bit is inverted is not executed; the next frame is executed (UB-FRM-03,
    UB-FRM-06).
    """
    bench = await Bench.start(dut)
    # The frame contains no flag and no escape, and the inversion of one bit in the script does not produce
    # one.
    line = encode(b"\x21\x12\x31\x13\x42")
    good = encode(b"\x00\x14\x01")
    for place in range(1, len(line) - 1):
        for bit in range(8):
            bad = bytearray(line)
            bad[place] ^= 1 << bit
            await bench.send(bad)
            reply = await bench.message()
            assert reply[0] == 0x81 and reply[1] in (2, 4, 6), f"byte {place}, bit {bit}: {reply.hex()}"
            # An inverted bit may produce a flag; then the remaining bytes are a second invalid frame.
            while 0x7E in bad[1:-1] and len(bench.line) and not await nothing(bench):
                assert bench.got.pop(0)[0] == 0x81
            same(f"byte {place}, bit {bit}", bench.accesses(), [])
    await bench.send(good)
    same("answer", await bench.message(), b"\x00\x00")
    same("write", bench.accesses(), [("W", 4, 1)])


async def nothing(bench: Bench) -> bool:
    """Return True if no message arrives for some time."""
    await bench.quiet(120)
    return not bench.got


@cocotb.test()
@configs(FAST)
async def frames_faults(dut):
    """Frames of length 0 to 258, with 7D 7E, or with a wrong CRC are answered as the rules state, and the
    bridge works afterwards (UB-FRM-04, UB-FRM-06).
    """
    bench = await Bench.start(dut)
    for length in (0, 1, 3, 251, 252, 253):
        await bench.send(encode(bytes([length & 0x7F]) + script_of(length)))
        same(f"{length + 3} bytes", (await bench.message())[1], 0)
        same("write", bench.accesses(), [("W", 3, 0x99)] if length >= 3 else [])
    for length in (254, 255, 300):
        await bench.send(encode(b"\x01" + script_of(length), limit=400))
        same(f"{length + 3} bytes", await bench.message(), nak(3))
        await bench.silent("only one NAK, the frame's last flag begins the next")
        await bench.send(encode(b"\x00\x00")[1:])
        same("next frame", await bench.message(), b"\x00\x00")
    # The bridge sends the NAK before the end of the frame, and ignores all bytes up to the next flag.
    await bench.send(encode(b"\x01" + script_of(254), limit=400)[:-1])
    same("257 bytes", await bench.message(), nak(3))
    await bench.send(encode(b"\x01\x00")[1:-1])
    await bench.silent("hunt")
    await bench.send(b"\x7e")
    for content in (b"\x05", b"\x05\x00"):
        await bench.send(content + b"\x7e")
        same(f"{len(content)} bytes", await bench.message(), nak(4))
    # Two bytes are not a frame, even if they are a correct CRC.
    await bench.send(b"\xff\xff\x7e")
    same("CRC only", await bench.message(), nak(4))
    for content in (b"\x05\x12\x34\x7d", b"\x7d", encode(b"\x05\x12\x34")[1:-1] + b"\x7d"):
        await bench.send(content + b"\x7e")
        same("7D 7E", await bench.message(), nak(6))
    await bench.send(b"\x05\x12\x34\x00\x00\x7e")
    same("CRC", await bench.message(), nak(2))
    await bench.send(encode(b"\x05\x12\x34")[1:])
    same("the flag that ended it begins the next", await bench.message(), b"\x05\x00")
    same("accesses", bench.accesses(), [("W", 2, 0x34)])


@cocotb.test()
@configs(SLOW)
async def frames_silence(dut):
    """After 100 ms of silence within a frame, the bridge sends NAK 5 and then ignores bytes until a flag. The
    bridge does neither before 100 ms have passed, nor between frames (UB-FRM-06).
    """
    bench = await Bench.start(dut)
    line = encode(b"\x06\x12\x34")
    await bench.send(line[:2])
    await bench.ms(98)
    await bench.send(line[2:4])
    await bench.ms(98)
    await bench.send(line[4:])
    same("98 ms", await bench.message(), b"\x06\x00")
    await bench.ms(250)
    await bench.silent("no silence between frames")
    for part in (line[1:3], b"\x7e\x7d"):
        await bench.send(part)
        start = now()
        same("NAK", await bench.message(150), nak(5))
        told = (bench.line[-6][0] - start) * 1000 / SECOND
        assert 99.5 <= told <= 103, f"NAK {told} ms after the last byte"
        await bench.send(line[1:-1])
        await bench.silent("hunt")
        await bench.send(line)
        same("next frame", await bench.message(), b"\x06\x00")
    await bench.ms(230)
    await bench.silent("one NAK")


@cocotb.test()
@configs(FAST)
async def frames_while_busy(dut):
    """Bytes other than flags during a script or an answer cause NAK 7 after the answer; then the bridge waits
    for a flag (UB-FRM-07).
    """
    bench = await Bench.start(dut)
    long_script = bytes([0x32, 40])
    line = encode(b"\x01" + long_script)
    other = encode(b"\x02\x13\x01")
    # Bytes that arrive while the bridge sends the answer cause NAK 7, as those during a script do.
    await bench.send(line)
    await bench.quiet(100)
    await bench.send(other[:-1])
    same("answer", (await bench.message())[:2], b"\x01\x00")
    same("NAK", await bench.message(), nak(7))
    await bench.send(other[1:-1])
    await bench.silent("hunt")
    await bench.send(other)
    same("next frame", await bench.message(), b"\x02\x00")
    # Flags during a script are ignored, but the last one may begin the next frame.
    await bench.send(encode(b"\x03" + long_script))
    await bench.send(b"\x7e" * 10)
    same("answer", (await bench.message())[:2], b"\x03\x00")
    await bench.send(encode(b"\x04\x13\x02")[1:])
    same("no NAK, no hunt", await bench.message(), b"\x04\x00")
    # A script without waits is executed completely, although a byte arrives during it.
    await bench.send(encode(b"\x05" + b"\x05" * 100 + b"\x13\x03"))
    await bench.send([0x42])
    same("answer", await bench.message(), b"\x05\x00")
    same("NAK", await bench.message(), nak(7))
    # During a script, a character without a stop bit has the same effect as a byte.
    await bench.send(encode(b"\x06" + long_script))
    await bench.quiet(50)
    await bench.send([0x42], stop=0)
    same("answer", (await bench.message())[:2], b"\x06\x00")
    same("NAK", await bench.message(), nak(7))
    await bench.silent("that was all")
    same("writes", [e for e in bench.accesses() if e[0] == "W"], [("W", 3, 1), ("W", 3, 2), ("W", 3, 3)])


@cocotb.test()
@configs(FAST)
async def frames_garbage(dut):
    """After any garbage, a frame that begins with a flag is executed (UB-FRM-05, UB-FRM-06, UB-FRM-08)."""
    bench = await Bench.start(dut)
    for n in range(60):
        size = bench.rng.choice((1, 3, 8, 30, 30, 300 if n % 20 == 0 else 5))
        garbage = [bench.rng.choice((0x7D, 0x7E, 0x00, bench.rng.getrandbits(8))) for _ in range(size)]
        await bench.send(garbage)
        if bench.rng.random() < 0.3:
            await bench.send([bench.rng.getrandbits(8)], stop=0)
            await bench.quiet(3)
        # The first flag ends a frame that the garbage may have begun. The bridge sends the NAK for that frame
        # while the new frame arrives.
        await bench.send(b"\x7e" + encode(bytes([0, 0x12, n])))
        while (reply := await bench.message())[0] == 0x81:
            assert reply[1] in (1, 2, 3, 4, 6, 8), reply.hex()
        same(f"answer {n}, garbage {bytes(garbage).hex()}", reply, b"\x00\x00")
        await bench.quiet(80)
        bench.got.clear()
        same("write", bench.accesses(), [("W", 2, n)])


@cocotb.test()
@configs(FAST)
async def frames_nak_waits(dut):
    """If many faults occur in succession, the bridge sends NAKs for some of them, each NAK complete, and then
    continues to work (UB-FRM-08).
    """
    bench = await Bench.start(dut)
    await bench.send(b"\x7e\x01" * 30 + b"\x7e")
    await bench.quiet(150)
    assert 3 <= len(bench.got) <= 12 and set(bench.got) == {nak(4)}, bench.got
    bench.got.clear()
    same("next", await bench.done("00"), b"")
