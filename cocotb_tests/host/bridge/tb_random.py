"""Random scripts and random line noise: ppmc_uart_bridge compared with the golden model, byte for byte."""

from __future__ import annotations

import random

import cocotb
from cocotb.triggers import Timer

from cocotb_tests.harness import configs
from openppmc.host.frames import encode
from openppmc.model.carrier.bridge import Bridge

from .bench import Bench, same
from .settings import FAST, TWO, axes_of, params_of
from .slave import RegisterModel, without_polls

LONGEST_SCRIPT = 253


def random_op(rng: random.Random) -> bytes:
    """Return a random op; most ops are legal."""

    def some(n: int) -> bytes:
        return bytes(rng.choice((0x7D, 0x7E, rng.getrandbits(8))) for _ in range(n))

    count = rng.choice((1, 1, 2, 3, 5, 20, rng.randint(1, 120)))
    low = rng.getrandbits(4)
    choice = rng.choices(range(14), weights=(2, 1, 1, 2, 1, 1, 4, 4, 2, 3, 6, 4, 4, 2))[0]
    return (
        lambda: bytes([rng.choice((0, 0, 6, 9, 0x0A, 0x0B))]),
        lambda: b"\x01",
        lambda: bytes([2, rng.choice((0, 0, 5, 6, 7, 64, 255))]),
        lambda: bytes([3, rng.choice((0, 1, 1, 1, 2, 0x81))]),
        lambda: bytes([5]),
        lambda: bytes([7]) + some(1),
        lambda: bytes([0x10 | low]) + some(1),
        lambda: bytes([0x20 | low]),
        lambda: bytes([0x30 | low, count]),
        lambda: bytes([0x40 | low, count]) + some(count),
        lambda: bytes([0x50 | (n := rng.randint(1, 15))]) + some(n),
        lambda: bytes([0x60 | rng.choice((1, 1, 2, 3))]),
        lambda: bytes([0x70 | low, mask := rng.getrandbits(8), rng.getrandbits(8) & mask]),
        lambda: rng.choice(
            (
                b"\x08",
                bytes([0x80 | low, count]) + some(count),
                bytes([rng.randint(0x90, 0xFF)]),
                b"\x0f",
                b"\x0c",
                b"\x0d\x03",
                bytes([0x90, rng.choice((0, 1, 3, 200))]),
                b"\x50",
                b"\x60",
            )
        ),
    )[choice]()


def random_script(rng: random.Random) -> bytes:
    """Return a script that fits into a frame; its waits time out after 1 ms."""
    script = b"\x04\x01\x00"
    for _ in range(rng.choice((0, 1, 2, 4, 8, 30))):
        op = random_op(rng)
        if len(script) + len(op) > LONGEST_SCRIPT:
            break
        script += op
    if rng.random() < 0.15:
        script = script[: rng.randint(0, len(script))]
        # Without an op TIMEOUT, the limit of a wait is 250 ms, which is too long for a test.
        script = script if len(script) >= 3 else b""
    return script


class Pair:
    """RTL and golden model, each with a separate instance of the same part model."""

    def __init__(self, bench: Bench, twin: RegisterModel) -> None:
        params = params_of(bench.config)
        self.bench, self.twin = bench, twin
        axes = axes_of(bench.config)
        part = params.get("Part", 104)
        self.model = Bridge(twin, part, params["ClkHz"], params["XtalHz"], axes=axes)
        self.model.rate = 0
        bench.dut.count_i.value = sum((twin.count(n + 1) & 0xFFFFFFFF) << 32 * n for n in range(axes))

    def pins(self, level: int) -> None:
        """Set the levels of all pins for the RTL and for the golden model; bit 0 is int_n."""
        self.bench.slave.pin_levels = self.twin.pin_levels = level
        self.bench.dut.pins_i.value = level

    async def exchange(self, what: str, data: bytes) -> None:
        """Send data; the bytes from the bridge and its accesses must equal those of the model."""
        bench = self.bench
        before = len(bench.line)
        want = self.model.receive(data)
        await bench.send(data)
        # At most one wait fails, which takes up to 2 ms.
        for _ in range(60):
            if len(bench.line) - before >= len(want):
                break
            await Timer(bench.period * 2000, "ps")
        await bench.quiet(30)
        got = bytes(byte for _, byte in bench.line[before:])
        assert got == want, f"{what}, sent {data.hex()}: got {got.hex()}, want {want.hex()}"
        got_log, want_log = (without_polls(toy.log) for toy in (bench.slave, self.twin))
        same(f"{what}, sent {data.hex()}: accesses", got_log, want_log)
        same("straps", int(bench.dut.straps_o.value), (self.twin.strap_bytes or [0xFF])[-1])
        bench.slave.log.clear()
        self.twin.log.clear()
        bench.got.clear()


@cocotb.test()
@configs(FAST, TWO)
async def random_scripts(dut):
    """For 250 random scripts, some of them repeated or with SEQ 0 or SEQ >= 128, the answers and the accesses
    equal those of the model (UB-ANS-01 to UB-ANS-05, UB-OPS-02).
    """
    bench = await Bench.start(dut)
    rng = bench.rng
    seed = rng.getrandbits(32)
    bench.slave = RegisterModel(seed, refuse=0.05)
    pair = Pair(bench, RegisterModel(seed, refuse=0.05))
    line = encode(b"\x00\x00")
    for n in range(250):
        if rng.random() < 0.85:
            seq = rng.choice((0, n % 128, n % 128, n % 128, rng.getrandbits(8)))
            line = encode(bytes([seq]) + random_script(rng))
        pair.pins(rng.getrandbits(8) | 1)
        await pair.exchange(f"script {n}", line)


@cocotb.test()
@configs(FAST)
async def random_noise(dut):
    """For damaged frames, the bridge sends the same NAKs as the model and executes no op (UB-FRM-01 to
    UB-FRM-06).
    """
    bench = await Bench.start(dut)
    rng = bench.rng
    pair = Pair(bench, RegisterModel())
    bench.slave = RegisterModel()
    for n in range(150):
        # The script contains only WRITE, READ and NOP, so no part of it can take long.
        script = b"".join(
            rng.choice((b"\x00", b"\x12\x7d", b"\x12\x7e", b"\x24")) for _ in range(rng.randint(0, 9))
        )
        line = bytearray(encode(bytes([rng.getrandbits(8)]) + script))
        kind, place = rng.randrange(6), rng.randrange(1, len(line) - 1)
        if kind == 0:
            line[place] ^= 1 << rng.randrange(8)
        elif kind == 1:
            del line[place]
        elif kind == 2:
            line.insert(place, 0x7D)
        elif kind == 3:
            line = line[:place] + b"\x7e"
        elif kind == 4:
            line = bytearray(rng.getrandbits(7) & 0x7C for _ in range(rng.randint(1, 9))) + b"\x7e"
        # Each frame has only one fault, because a second NAK might not be queued.
        if line[1:-1].count(0x7E):
            continue
        await pair.exchange(f"line {n}", bytes(line))
