"""The recorder of the bridge (each change with its cycle, full memory, read-back), and the op VERSION."""

from __future__ import annotations

from typing import Any

import cocotb
from cocotb.triggers import FallingEdge

from cocotb_tests.harness import configs
from openppmc.host.selftest.recording import Recorded

from .bench import Bench, same
from .settings import FAST, REC, TWO

BEGIN, END, REWIND, INFO = "0D 01", "0D 00", "0D 02", "0E"
WIDTH, MOST, BYTES = 9, 32, 3
LONGEST = (1 << 8 * BYTES - WIDTH) - 1


async def drive(bench: Bench, levels: list[tuple[int, int]]) -> None:
    """Drive watch_i with a list of (number of cycles before the change, level)."""
    for gap, level in levels:
        for _ in range(gap):
            await FallingEdge(bench.dut.clk_i)
        bench.dut.watch_i.value = level


async def read_all(bench: Bench) -> tuple[Recorded, list[tuple[int, int]]]:
    """Return the recorder's state, and (cycle, levels) of all records; read in portions of random size."""
    info = Recorded.parse(await bench.done(INFO))
    left, data = info.count * info.record_bytes, b""
    while left:
        n = min(left, bench.rng.randint(1, 60))
        data += await bench.done(bytes([0x90, n]))
        left -= n
    return info, list(info.samples(data))


@cocotb.test()
@configs(REC)
async def recorder_changes(dut: Any) -> None:
    """The recorder stores the cycle of each change, also after long pauses, and the cycle of the end of the
    recording (UB-REC-01, UB-REC-02, UB-REC-03, UB-REC-04, UB-OPS-02).
    """
    bench = await Bench.start(dut)
    for turn in range(3):
        first = bench.rng.getrandbits(WIDTH)
        bench.dut.watch_i.value = first
        await bench.done(BEGIN)
        steps, level = [], first
        for gap in (5, 1, 1, 1, 2, *(bench.rng.choice((1, 2, 7, 300)) for _ in range(12)), LONGEST + 40, 1):
            level ^= bench.rng.choice((1, 1 << WIDTH - 1, bench.rng.randrange(1, 1 << WIDTH)))
            steps.append((gap, level))
        await drive(bench, steps)
        await bench.clocks(10)
        await bench.done(END)
        info, samples = await read_all(bench)
        assert not info.running and not info.full
        same("shape", (info.record_bytes, info.width, info.most), (BYTES, WIDTH, MOST))
        same("the first record", samples[0], (0, first))
        changes = [(t, now) for (_, was), (t, now) in zip(samples, samples[1:], strict=False) if was != now]
        same("levels", [now for _, now in changes], [level for _, level in steps])
        gaps = [b - a for (a, _), (b, _) in zip(changes, changes[1:], strict=False)]
        same(f"cycles between, turn {turn}", gaps, [gap for gap, _ in steps[1:]])
        same("a rest has a record of its own, and the end", len(samples), 1 + len(steps) + 1 + 1)
        assert samples[-1][0] - changes[-1][0] > 10, "the end is when END was done"


@cocotb.test()
@configs(REC)
async def recorder_full(dut: Any) -> None:
    """One record more than the memory can store sets FULL and ends the recording; the stored records are
    correct (UB-REC-04).
    """
    bench = await Bench.start(dut)
    await bench.done(BEGIN)
    await drive(bench, [(3, n % 2 + 2 * n) for n in range(1, MOST)])
    info = Recorded.parse(await bench.done(INFO))
    same("as many as there is room for", (info.count, info.full, info.running), (MOST, False, True))
    await drive(bench, [(3, 0), (3, 1)])
    await bench.clocks(4)
    info, samples = await read_all(bench)
    same("one more", (info.count, info.full, info.running), (MOST, True, False))
    same("those before it", [level for _, level in samples], [0, *(n % 2 + 2 * n for n in range(1, MOST))])
    await bench.done(END)
    same("END changes nothing", Recorded.parse(await bench.done(INFO)), info)
    await bench.done(f"{BEGIN} {END}")
    info, samples = await read_all(bench)
    same("restarted", (info.count, info.full, [level for _, level in samples]), (2, False, [1, 1]))


@cocotb.test()
@configs(REC)
async def recorder_reading(dut: Any) -> None:
    """Bytes are read in order, REWIND returns to the first byte, and reads during a recording return zeros.
    An answer with too many data bytes, and invalid operands, have the effects that the rules state
    (UB-REC-03, UB-ANS-05).
    """
    bench = await Bench.start(dut)
    bench.dut.watch_i.value = 0x155
    await bench.done(f"{BEGIN} 00 00 {END}")
    whole = await bench.done("90 06")
    same("again", await bench.done(f"{REWIND} 90 02 90 04"), whole)
    words = [int.from_bytes(whole[n : n + BYTES], "little") for n in (0, BYTES)]
    same("levels of both", [word >> 8 * BYTES - WIDTH for word in words], [0x155] * 2)
    same("while it runs", await bench.done(f"{BEGIN} 90 05"), bytes(5))
    await bench.done(END)
    for bad in ("0D 03", "0D FF", "0D", "90", "90 00", "91 01", "9F 01"):
        same(bad, await bench.ask(bad), bytes([3, 0, 0]))
    answer = await bench.ask(bytes([0x32, 253]) + b"\x90\x04")
    same("no room for the fourth", (answer[0], len(answer) - 3), (4, 256))
    answer = await bench.ask(bytes([0x32, 241]) + b"\x0e")
    same("no room for RECORDED", (answer[0], len(answer) - 3), (4, 241))
    bench.accesses()
    await bench.done("05")
    same("reset of the part", Recorded.parse(await bench.done(INFO)).running, False)
    same("nothing of it at the part", bench.accesses(), [])


@cocotb.test()
@configs(FAST, TWO)
async def recorder_not_there(dut: Any) -> None:
    """Without a recorder, its ops are unknown; VERSION returns 16 bytes, which are 0 here (UB-REC-05,
    UB-VER-01).
    """
    bench = await Bench.start(dut)
    for op in ("0D 00", "0D 01", "0E", "90 01"):
        same(op, await bench.ask(f"00 {op}"), bytes([3, 1, 0]))
    same("VERSION", await bench.done("0C"), bytes(16))
    answer = await bench.ask(bytes([0x32, 241]) + b"\x0c")
    same("no room", (answer[0], len(answer) - 3), (4, 241))
