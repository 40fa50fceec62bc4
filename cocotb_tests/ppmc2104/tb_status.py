"""Status register and handshake (P2104-STA, P2104-HSK)."""

from __future__ import annotations

from itertools import product
from typing import Any

from cocotb_tests.harness import COMMAND, DATA, F11, F16, IBF, OBF, directed
from cocotb_tests.harness.axis_driver import indices, rates

from .env import Env
from .expected_timing import BUILD_LATEST, ERROR, INIT_A, INIT_B
from .states import MOVING, RESTING, enter, leave

# The largest table has all rates and all steps.
LARGEST = (0x02, 255, 1, 0x2BD4)


@directed("P2104-STA-01", "P2104-STA-04", "P2104-STA-05", "P2104-STA-07")
async def p2104_sta_01_every_bit(dut: Any) -> None:
    """Of all status bits, only BUSY and CMND of an axis depend on the state of this axis (P2104-STA-01)."""
    env = await Env.start(dut)
    for axis, state in product(env.axes, (*RESTING, *MOVING)):
        await enter(axis, state)
        want = axis.busy if state in MOVING else axis.cmnd if state == "INITP" else 0
        env.check("P2104-STA-04", f"status in {state} of axis {axis.n}", await env.host.status(), want)
        await env.host.fetch(0xC2)
        await env.host.command(0xD1)
        await env.host.command(0x86)
        await leave(axis)
    statuses = [a.byte for a in env.bench.accesses if a.kind == "read" and a.reg]
    env.check("P2104-STA-07", "bit 6 of all statuses", [s for s in statuses if s & 0x40], [])


@directed("P2104-STA-01", "P2104-STA-06", "P2104-STA-02")
async def p2104_sta_01_all_at_once(dut: Any) -> None:
    """If both axes are busy and there are a data wait, an error and an answer, all status bits are set at the
    same time (P2104-STA-01).
    """
    env = await Env.start(dut)
    for axis in await env.both(INIT_A):
        await axis.go(0x45, rate=255)
    env.check("P2104-STA-01", "both busy", await env.host.status(), 0x0C)
    await env.run("c C2 c 87")
    env.check("P2104-STA-01", "and OBF, ERROR", await env.host.status(), 0x8D)
    await env.host.read(DATA)
    for axis in env.axes:
        await axis.halt()
    await env.x2.go(0x45, rate=255)
    env.check("P2104-STA-01", "CMND1, BUSY2, ERROR", await env.x1.command(0x44), 0x98)
    await env.x1.command(0x86)
    env.check("P2104-STA-06", "ERROR after error 3", await env.host.status() & ERROR, ERROR)


@directed("P2104-STA-05")
async def p2104_sta_05_cmnd(dut: Any) -> None:
    """CMND is 1 only during data waits and table builds (P2104-STA-05)."""
    env = await Env.start(dut)
    for axis in env.axes:
        for code, data in ((0x84, [0x40, 0x50]), (0x85, [0]), (0x02, [9, 4, 4, 0])):
            await axis.command(code)
            for place, byte in enumerate(data):
                status = await env.host.status()
                env.check("P2104-STA-05", f"{code:#x} before byte {place}", status, axis.cmnd)
                await env.host.data(byte)
        env.check("P2104-STA-05", "table being built", await env.host.status(), axis.cmnd)
        await axis.ready()
        for code in (0xC1, 0xC2, 0x80, 0x86):
            status = await env.host.command(code)
            env.check("P2104-STA-05", f"after {code:#x}", status & 0x30, 0)
            if status & OBF:
                await env.host.read(DATA)
        await axis.go(0x42)
        env.check("P2104-STA-05", "CMND in a motion", await env.host.status() & 0x30, 0)
        await axis.idle()
        # After a rejected setting or operation, no data is expected.
        env.check("P2104-STA-05", "refused", await axis.send(0x02, [4, 4, 4, 0]) & 0xB0, ERROR)
        await axis.error()


@directed("P2104-STA-07", "P2104-STA-02", "P2104-STA-03")
async def p2104_sta_07_reading_changes_nothing(dut: Any) -> None:
    """100 reads of the status do not change an answer, an error or an interrupt (P2104-STA-07)."""
    env = await Env.start(dut)
    env.bench.set(errint_n=0)
    await env.run("c 81 c 87")
    since = env.bench.now
    got = {await env.host.status() for _ in range(100)}
    env.check("P2104-STA-07", "statuses", got, {0x81})
    env.quiet("P2104-STA-07", since)
    env.check("P2104-STA-02", "the answer", await env.run("r s"), [0xCF, 0x80])


@directed("P2104-HSK-02", "P2104-BAD-08", "P2104-HSK-01", exact="a level of one cycle may not be sampled")
async def p2104_hsk_02_writes_one_after_the_other(dut: Any) -> None:
    """Of two codes written at any distance, the newer one is always executed, and never a mixture of both
    (P2104-HSK-02).
    """
    env = await Env.start(dut)
    outcomes = []
    for gap in range(1, 12):
        await env.host.write(COMMAND, 0x87, strobe=1, gap=gap)
        await env.host.write(COMMAND, 0xA7, strobe=1, gap=16)
        one, two = await env.errors()
        env.check("P2104-HSK-02", f"newer code, gap {gap}", two, 1)
        outcomes.append(one)
        # A data byte is written over a code. Both the byte and its command/data flag must be replaced.
        await env.host.write(COMMAND, 0x40, strobe=1, gap=gap)
        await env.host.write(DATA, 0x40, strobe=1, gap=16)
        one, two = await env.errors()
        env.check("P2104-HSK-02", f"data byte, gap {gap}", (one, two), (2, 0))
    env.check("P2104-HSK-02", "older code: lost, then never", outcomes, sorted(outcomes))
    env.check("P2104-HSK-01", "older code with time enough", outcomes[7:], [1] * 4)


@directed("P2104-HSK-02", "P2104-HSK-04", "P2104-STP-07")
async def p2104_hsk_02_over_a_waiting_code(dut: Any) -> None:
    """A byte that is written over a step waiting for its table is accepted instead of the step
    (P2104-HSK-02).
    """
    env = await Env.start(dut)
    first, second = env.axes
    await second.init(*INIT_A)
    for code, register in ((0x60, 1), (0x40, 1), (0x87, 1), (0x55, 0), (0xC1, 1)):
        await second.running(99)
        await env.host.init(0x02, 255, 1, 4)
        await first.go(0x42, poll=False)
        await env.bench.clocks(200)
        env.check("P2104-HSK-04", "IBF while it waits", await env.host.status() & IBF, IBF)
        edge0 = await env.host.write(register, code)
        await env.bench.until(edge0 + 10)
        status = await env.host.status()
        env.check("P2104-HSK-02", f"IBF 10 cycles after {code:#x}", status & (IBF | first.cmnd), first.cmnd)
        want = {0x40: (6, 0), 0x87: (1, 0), 0x55: (2, 0)}.get(code, (0, 0))
        env.check("P2104-HSK-02", f"errors after {code:#x}", await env.errors(), want)
        await first.ready()
        env.check("P2104-HSK-02", "the step is lost", first.pulses, [])
        if code == 0x60:
            await second.idle()
            env.check("P2104-STP-07", "end status", await second.finish(), 0xC5)
        else:
            await second.halt()


@directed("P2104-HSK-03", "P2104-OPR-01", "P2104-GEN-06", builds=(F16, F11))
async def p2104_hsk_03_one_edge(dut: Any) -> None:
    """If a CCW move of a chopping axis starts, hold, dir and phases change on one edge (P2104-HSK-03)."""
    env = await Env.start(dut)
    for axis in env.axes:
        await axis.init(0x12, *INIT_A[1:])
        for code in (0x4A, 0x42, 0x4B, 0xC3):
            await env.bench.edge(axis.phases, 0x1F)
            await env.bench.clocks(20)
            n = 3 if code & 1 else None
            edge0 = await axis.go(code, n, poll=False)
            status = await env.host.poll(IBF, 0)
            env.check("P2104-HSK-03", "BUSY with IBF = 0", status & axis.busy, axis.busy)
            first = await axis.pulse(1)
            places = {
                name: axis.edges(name, edge0)[0][0] for name in ("hold", "dir") if axis.edges(name, edge0)
            }
            places["phases"] = [t for t, v in env.bench.edges(axis.phases, edge0) if t < first][-1]
            env.check("P2104-HSK-03", f"edges of {code:#x}: {places}", len(set(places.values())), 1)
            env.window("P2104-HSK-03", "edge 0 to pins", places["phases"] - edge0, 2, 12)
            await axis.idle()
            # Wait until hold rises again, so that the next move makes it fall.
            await env.bench.level_is(axis.pin("hold"), 1)
            await axis.finish()


@directed("P2104-HSK-04", "P2104-HSK-03")
async def p2104_hsk_04_what_waits(dut: Any) -> None:
    """While the table of one axis is built, only settings, operations and Excitation OFF for this axis
    wait (P2104-HSK-04).
    """
    env = await Env.start(dut)
    waits = (0x02, 0x42, 0x43, 0x44, 0x45, 0x46, 0x47, 0xC3, 0xC6, 0xC0)
    taken = (0x40, 0x41, 0x80, 0x81, 0x82, 0x83, 0x84, 0x85, 0x86, 0x87, 0xC1, 0xC2)
    for axis, other in ((env.x1, env.x2), (env.x2, env.x1)):
        await other.init(*INIT_A)
        for mine, code in (*((True, c) for c in (*waits, *taken)), *((False, c) for c in (*waits, *taken))):
            await axis.host.init(0x02 | axis.axis_bit, 40, 1, 4)
            addressed = axis if mine else other
            full = code if code in (0xC1, 0xC2) else code | addressed.axis_bit
            edge0 = await env.host.command(full, poll=False)
            await env.bench.until(edge0 + 10)
            status = await env.host.status()
            waiting = mine and code in waits
            what = f"IBF, {full:#x}, table of axis {axis.n}"
            env.check("P2104-HSK-04", what, status & (IBF | axis.cmnd), axis.cmnd | (IBF if waiting else 0))
            if waiting and code in (0x46, 0xC6):
                await env.host.poll(IBF, 0)
                env.check("P2104-HSK-04", "taken afterwards", await env.host.status() & axis.busy, axis.busy)
            # A stop ends both a data wait and a motion.
            for each in env.axes:
                await each.command(0x40)
                await each.idle()
                await each.ready()
            await env.errors()
            await env.host.fetch(0x80)
            await env.host.fetch(0xA0)
            if not mine and code == 0xC0:
                await other.init(*INIT_A)


@directed("P2104-HSK-04", "P2104-ERR-02", "P2104-FSM-01")
async def p2104_hsk_04_data_wait_during_a_table_build(dut: Any) -> None:
    """During a data wait, a code that otherwise would wait for a table build sets error 3 (P2104-HSK-04)."""
    env = await Env.start(dut)
    for axis, other in ((env.x1, env.x2), (env.x2, env.x1)):
        for code in (0x42, 0x45, 0x02, 0xC0):
            await axis.host.init(0x02 | axis.axis_bit, 200, 1, 4)
            await other.send(0x84, [0x50])
            edge0 = await axis.command(code, poll=False)
            await env.bench.until(edge0 + 10)
            status = await env.host.status()
            env.check("P2104-HSK-04", f"status after {code:#x}", status, axis.cmnd | ERROR)
            env.check("P2104-ERR-02", "errors", await env.errors(), (3, 0) if axis.n == 1 else (0, 3))
            await axis.ready()


@directed("P2104-HSK-05", "P2104-RMP-04")
async def p2104_hsk_05_longest_tables(dut: Any) -> None:
    """If the largest tables of both axes are requested together, the first is complete within 40 000 cycles
    and the second within 80 000 cycles (P2104-HSK-05).
    """
    env = await Env.start(dut)
    first, second = env.axes
    starts, ends = [], []
    for axis in (first, second):
        await axis.send(LARGEST[0], [LARGEST[1], LARGEST[2], LARGEST[3] & 0xFF])
        starts.append(await env.host.data(LARGEST[3] >> 8, poll=False))
    for axis in (first, second):
        await axis.host.poll(axis.cmnd, 0, dense=10_000)
        ends.append(env.bench.now)
    env.window("P2104-HSK-05", "first table", ends[0] - starts[0], 1_000, BUILD_LATEST + 20)
    env.window("P2104-HSK-05", "second table", ends[1] - starts[1], 1_000, 2 * BUILD_LATEST + 20)
    env.check("P2104-HSK-05", "order", ends[0] < ends[1], True)
    for axis in env.axes:
        await axis.move(0x43, 6)
        axis.check_train("P2104-RMP-04", rates(LARGEST[1:], indices(6, LARGEST[3])))


@directed("P2104-HSK-05", "P2104-OPR-10", "P2104-INI-06")
async def p2104_hsk_05_during_a_motion(dut: Any) -> None:
    """The build of a table does not disturb the pulse train of the other axis on its ramp (P2104-HSK-05)."""
    env = await Env.start(dut)
    for axis, other in ((env.x1, env.x2), (env.x2, env.x1)):
        await axis.init(0x02, 60, 1, 40)
        await axis.go(0x43, 300)
        await axis.pulse(1, 10)
        while not (await env.host.status()) & axis.busy == 0:
            await other.init(0x02, 30, 1, 12)
        axis.check_train("P2104-HSK-05", rates((60, 1, 40), indices(300, 40)))
        await other.move(0x43, 30)
        other.check_train("P2104-HSK-05", rates((30, 1, 12), indices(30, 12)))


@directed("P2104-HSK-06", "P2104-HSK-07", "P2104-BAD-25", "P2104-BAD-10", "P2104-RD-06")
async def p2104_hsk_07_answers_stay(dut: Any) -> None:
    """An unread answer stays until another read instruction is executed; other instructions do not change it
    (P2104-HSK-07).
    """
    env = await Env.start(dut)
    first, second = await env.both(INIT_B)
    for axis, other in ((first, second), (second, first)):
        await axis.go(0x43, 0x30201)
        await axis.pulse(2, 50)
        await axis.halt()
        # The remaining count is 0x30201 - 2 - 1 = 0x301FE.
        await axis.command(0x83)
        env.check("P2104-HSK-07", "first byte", await env.host.read(DATA), 0xFE)
        await env.run("c 87 d 00 c C1 c 40 c 84 d 00 d 00 c 43 c 42")
        for each in (other, axis):
            await each.move(0x43, 3)
            await each.init(*INIT_A)
            await each.send(0x85, [1])
            await each.send(0x45, [0])
            await each.command(0x61)
        env.check("P2104-HSK-07", "OBF", await env.host.status() & OBF, OBF)
        env.check("P2104-HSK-07", "the rest", await env.run("rr"), [0x01, 0x03])
        env.check("P2104-HSK-07", "OBF after it", await env.host.status() & OBF, 0)
        # A rejected read does not replace an answer; an executed read of either axis does.
        bit = axis.axis_bit
        for code, answer in ((0xC2, 0x00), (0xA1, 0xCF), (0x81, 0xCF), (0x80 | bit, 0xC5), (0x86 | bit, 5)):
            await axis.command(0x83)
            await axis.running(200)
            await axis.command(0x81)
            env.check("P2104-HSK-07", "OBF after a refused read", await env.host.status() & OBF, OBF)
            await axis.command(0x40)
            await axis.idle()
            await env.host.command(code)
            env.check("P2104-HSK-07", f"answer of {code:#x}", await env.host.read(DATA), answer)
            await env.bench.clocks(8)
            env.check("P2104-HSK-07", f"OBF after {code:#x}", await env.host.status() & OBF, 0)
        await axis.init(*INIT_B)
        await other.init(*INIT_B)
        await axis.finish()
        await other.finish()


@directed("P2104-HSK-08", "P2104-BAD-03")
async def p2104_hsk_08_no_time_out(dut: Any) -> None:
    """If the third data byte is sent 10 ms after the second, it nevertheless starts the move
    (P2104-HSK-08).
    """
    env = await Env.start(dut)
    first, second = await env.both(INIT_A)
    await first.send(0x43, [8, 0])
    await env.bench.clocks(160_000)
    env.check("P2104-HSK-08", "status", await env.host.status(), first.cmnd)
    first.since = env.bench.now
    await env.host.data(0)
    await first.result("P2104-HSK-08", 9, 0x83, 0)
    # Both axes share one data wait: a code of the other axis ends it.
    await first.send(0x43, [8, 0])
    await second.command(0x44)
    env.check("P2104-HSK-08", "status", await env.host.status(), ERROR)
