"""Status register, error numbers and the handshake (P104-STA, P104-ERR, P104-HSK).

The C-event of a byte is the edge on which the core consumes it.
"""

from __future__ import annotations

from cocotb_tests.harness import BUSY, COMMAND, D16, DATA, F16, F100, IBF, OBF, directed

from .env import C_EVENT_LATEST, WRITE_EVENT, Env
from .expected_timing import INIT_A, INIT_B
from .states import enter

LONGEST_BUILD = (0x0A, 255, 0, 11220)


@directed("P104-STA-01", "P104-STA-02", "P104-STA-03", "P104-STA-04", "P104-STA-05", "P104-GEN-01")
async def p104_sta_01_status_bits(dut):
    """Each bit of the status follows only its own condition, during bytes, reads and a motion
    (P104-STA-01).
    """
    env = await Env.start(dut, None)
    host, check = env.host, env.check
    check("P104-STA-07", "status after reset", await host.status(), 0x00)
    check(
        "P104-STA-05",
        "NUM through a switching command",
        await env.statuses("c 84 d 10 d 20"),
        [0x20, 0x10, 0x00],
    )
    await host.command(0x81)
    check("P104-STA-02", "OBF while a byte is unread", await host.status(), OBF)
    await host.read(DATA)
    check("P104-STA-02", "OBF after the read", await host.status(), 0x00)
    check("P104-STA-05", "ERR with number 2", await host.command(0x42), 0xA0)
    await host.init(*LONGEST_BUILD)
    await host.command(0x80, poll=False)
    check("P104-STA-03", "IBF, and BUSY = 0 while initialising", await host.status(), IBF)
    await host.poll(IBF, 0)
    await host.read_data()
    await env.init(*INIT_A)
    await env.go(0x44, 3, rate=99)
    check("P104-STA-04", "BUSY in START", await host.status(), BUSY)
    await env.busy_until(lambda: env.bench.level("int_n") == 0, "P104-STA-04")
    check("P104-STA-04", "BUSY after the end", await host.status(), 0x00)
    await env.go(0x43, 40)
    await env.busy_until(lambda: len(env.bench.rises("pout_n", env.since)) == 40, "P104-STA-04")
    await env.bench.clocks(6)
    check("P104-STA-04", "BUSY after the ramp", await host.status(), 0x00)


@directed("P104-STA-06", "P104-ERR-00", "P104-ERR-03", "P104-STA-05")
async def p104_sta_06_errors_replace(dut):
    """After any sequence of errors, ERR and NUM are those of the byte that was accepted last
    (P104-STA-06).
    """
    env = await Env.start(dut, None)
    got = await env.statuses(
        "c 00 c 42 d 00 c 40 c 0A d 09 d 04 d C0 d FF d 00 c 0A d 04 d 09 d 04 d 00 c 86 d 00"
    )
    expected = [
        0x80,
        0xA0,
        0xB0,
        0x80,
        0x40,
        0x30,
        0x20,
        0x10,
        0xC0,
        0xB0,
        0x40,
        0x30,
        0x20,
        0x10,
        0xD0,
        0x10,
        0x00,
    ]
    env.check("P104-ERR-00", "statuses at rest", got, expected)
    await env.init(*INIT_A)
    await env.go(0x43, 40)
    await env.pulse(6)
    got = await env.statuses("c 42 d 00 c 87 c 41 c 41 c C2")
    env.check("P104-ERR-00", "statuses while BUSY", got, [0x94, 0xE4, 0x84, 0x04, 0xF4, 0x04])
    await env.idle()
    before = await env.host.command(0x87)
    reads = [await env.host.status() for _ in range(4)]
    reads += [await env.host.read(DATA), await env.host.status()]
    env.check(
        "P104-STA-06", "reading changes nothing", (before, reads[:4], reads[5]), (0x80, [0x80] * 4, 0x80)
    )
    env.check("P104-STA-06", "a good byte clears ERR", await env.host.command(0xC2), 0x00)
    await env.host.command(0x87)
    await env.bench.reset()
    await env.bench.clocks(6)
    env.check("P104-STA-06", "reset clears ERR", await env.host.status(), 0x00)


@directed("P104-ERR-01")
async def p104_err_01_check_order(dut):
    """If a command has several faults, they are checked in this order: undefined, stop at standstill, BUSY,
    not initialised, error 7 (P104-ERR-01).
    """
    env = await Env.start(dut, None)
    for code, status in ((0xC4, 0x80), (0x00, 0x80), (0x40, 0x80), (0x46, 0xA0), (0xC6, 0xA0)):
        env.check("P104-ERR-01", f"{code:#x}, not initialised", await env.host.command(code), status)
    for state, code, status in (
        ("DEC", 0xC4, 0x84),
        ("DEC", 0x42, 0x94),
        ("DEC", 0x41, 0xF4),
        ("DEC natural", 0x41, 0xF4),
        ("FIN ramp", 0x41, 0xF4),
        ("FIN constant", 0x41, 0x04),
        ("FIN ramp", 0x46, 0x94),
        ("FIN ramp", 0xC7, 0x84),
        ("READY", 0x41, 0x80),
    ):
        await enter(env, state)
        env.check("P104-ERR-01", f"{code:#x} in {state}", await env.host.command(code), status)


@directed("P104-ERR-02", "P104-INI-03")
async def p104_err_02_init_checks(dut):
    """Illegal initialisation values are checked when the 4th byte is accepted, not before; error 4 has
    priority over error 5 (P104-ERR-02).
    """
    env = await Env.start(dut, None)
    cases = {(5, 6, 100): 0xD0, (0, 255, 11220): 0xD0, (9, 4, 3): 0xD0, (9, 4, 0): 0xD0, (9, 4, 11221): 0xC0}
    cases |= {(9, 4, 0xFFFF): 0xC0, (5, 6, 11221): 0xC0, (5, 6, 3): 0xD0, (255, 255, 4): 0, (0, 0, 11220): 0}
    for (rl, rh, pa), status in cases.items():
        got = [await env.status_after(0x0A)]
        got += [await env.status_after(byte, DATA) for byte in (rl, rh, pa & 0xFF, pa >> 8)]
        env.check("P104-ERR-02", f"statuses of {(rl, rh, pa)}", got, [0x40, 0x30, 0x20, 0x10, status])


@directed("P104-ERR-03", "P104-BAD-01", "P104-BAD-02")
async def p104_err_03_faulty_bytes_are_harmless(dut):
    """During a motion with INT pending, faulty bytes do not change pulses, INT, outputs or the output queue
    (P104-ERR-03).
    """
    env = await Env.start(dut, INIT_B)
    await env.move(0x42)
    await env.host.command(0x83)
    await env.go(0x43, 30)
    since = env.bench.now
    while len(env.pulses) < 29:
        for byte, reg, status in (
            (0x87, 1, 0x85),
            (0x43, 1, 0x95),
            (0x77, 0, 0xE5),
            (0x83, 1, 0x95),
            (0xFF, 1, 0x85),
        ):
            env.check("P104-ERR-03", f"status after {byte:#x}", await env.status_after(byte, reg), status)
        await env.bench.clocks(200)
    await env.idle()
    ramp = [19, 17, 15, 14, 12, 12, 11, 10, 10, 9, *[9] * 9, 9, 10, 10, 11, 12, 12, 14, 15, 17, 19]
    env.check_train("P104-ERR-03", ramp)
    for name in ("int_n", "aux_n", "auxo", "dir", "hold"):
        env.check("P104-ERR-03", f"edges of {name}", env.bench.edges(name, since), [])
    env.check("P104-ERR-03", "queue", [await env.host.read_data() for _ in range(3)], [0, 0, 0])
    for byte, reg, status in ((0x87, 1, 0x80), (0x77, 0, 0xB0), (0x40, 1, 0x80), (0x00, 1, 0x80)):
        env.check("P104-ERR-03", f"status at rest after {byte:#x}", await env.status_after(byte, reg), status)
    env.check("P104-ERR-03", "int_n", env.bench.edges("int_n", since), [])
    await env.result("P104-ERR-03", 30, 0x83, 0)


@directed("P104-HSK-01", "P104-HSK-04", "P104-INI-07", "P104-FSM-02", "P104-BAD-06")
async def p104_hsk_04_table_build_window(dut):
    """During the build of the longest ramp table, bytes wait; when the build ends, only the newest byte is
    accepted (P104-HSK-04).
    """
    env = await Env.start(dut, None)
    last = 0
    for bytes_in in ([], [(1, 0xC1)], [(1, 0xC1), (1, 0xC2), (1, 0x86)], [(1, 0x87), (0, 0x55)]):
        await env.host.send(0x0A, [255, 0, 11220 & 0xFF])
        edge0 = await env.host.data(11220 >> 8, poll=False)
        await env.host.poll(IBF, 0)
        for reg, byte in bytes_in or [(1, 0xC2)]:
            last = byte if reg else 0
            await env.host.write(reg, byte)
        waited = 0
        while (status := await env.host.status()) & IBF:
            env.check("P104-HSK-04", "status in the window", status, IBF)
            waited = env.bench.now - edge0
            await env.bench.clocks(50)
        env.window("P104-HSK-04", "length of the window", waited, 100, 40_000 + C_EVENT_LATEST + 8)
        expected = {0xC1: 0x00, 0xC2: 0x00, 0x86: 0x10, 0: 0xB0}[last]
        env.check("P104-FSM-02", f"status after {bytes_in}", status, expected)
    await env.bench.clocks(4)
    env.check("P104-HSK-02", "aux_n: C1 of the second run, C2 of the third lost", env.bench.level("aux_n"), 0)


@directed("P104-HSK-02", "P104-BAD-06", builds=(F16, F100))
async def p104_hsk_02_replacement(dut):
    """If two bytes are written 2 to 16 cycles apart near a C-event, the second byte is kept, and no byte is
    executed twice (P104-HSK-02).
    """
    env = await Env.start(dut, None)
    # Length of the gap before the second write, and of its strobe. Its edge 0 follows that of the first write
    # by gap + strobe. If this is 8 cycles or more, the first byte was certainly accepted: its C-event is at
    # most 8 cycles after its write event.
    spacings = [(1, 1), (1, 2), *((gap, 2) for gap in range(2, 15))]
    sure = next(i for i, pair in enumerate(spacings) if sum(pair) == C_EVENT_LATEST - WRITE_EVENT)
    first_seen = []
    for gap, strobe in spacings:
        await env.host.command(0xC2)
        await env.host.write(COMMAND, 0xC1, gap=gap)
        await env.host.write(COMMAND, 0x86, strobe=strobe)
        await env.bench.clocks(16)
        env.check("P104-HSK-02", f"second byte, gap {gap}", await env.host.status(), 0x10)
        first_seen.append(1 - env.bench.level("aux_n"))
    env.check("P104-HSK-02", "first byte taken, per spacing", first_seen, sorted(first_seen))
    env.check("P104-HSK-01", "first byte taken", set(first_seen[sure:]), {1})
    outcomes = []
    for gap, strobe in spacings:
        # A data byte follows a command, so that the command/data flag is replaced, too.
        await env.host.command(0x84)
        await env.host.write(COMMAND, 0x86, gap=gap)
        await env.host.write(DATA, 0x0F, strobe=strobe)
        await env.bench.clocks(16)
        outcomes.append((await env.host.status(), env.bench.level("auxo")))
        await env.host.send(0x86, [0x00])
        await env.bench.clocks(2)
    env.check("P104-HSK-02", "kinds of outcome", set(outcomes) <= {(0x10, 0xF), (0x00, 0x0)}, True)
    env.check("P104-HSK-02", "command, then its data", set(outcomes[sure:]), {(0x00, 0x0)})


@directed("P104-HSK-02", "P104-DS-02", builds=(D16,))
async def p104_hsk_02_replacement_when_closed(dut):
    """While the mailbox is closed, command and data bytes replace each other, and only the last byte is
    accepted (P104-HSK-02).
    """
    env = await Env.start(dut, INIT_A)
    await env.go(0x44, 2, rate=50)
    last = await env.pulse(2)
    for reg, byte in ((0, 0x00), (1, 0xC1), (1, 0x86), (0, 0x0F), (1, 0x81)):
        await env.host.write(reg, byte)
    env.check("P104-HSK-01", "status while closed", await env.host.status() & IBF, IBF)
    status = await env.host.poll(IBF, 0, dense=1000)
    env.check("P104-HSK-02", "status after", status, OBF)
    env.window("P104-DS-07", "time of the C-event", env.bench.now - last, 2496, 2530)
    env.check("P104-HSK-02", "0x81", await env.host.read_data(), 0xCF)
    env.check("P104-HSK-02", "aux pins", (env.bench.edges("aux_n"), env.bench.edges("auxo")), ([], []))


@directed("P104-HSK-03", "P104-GEN-07", "P104-OPR-01", builds=(F16, F100))
async def p104_hsk_03_all_on_one_edge(dut):
    """If a CCW step starts in an OFF phase of the chopper, hold, dir and s change on the same edge
    (P104-HSK-03).
    """
    env = await Env.start(dut, (0x2A, 9, 4, 4))
    await env.bench.edge("s", 0)
    await env.bench.clocks(20)
    edge0 = await env.go(0x4A, poll=False)
    await env.bench.clocks(8)
    status = await env.host.status()
    await env.pulse(1)
    edges = {name: env.bench.edges(name, edge0) for name in ("hold", "dir", "s")}
    started = edges["hold"][0][0]
    expected = {
        "hold": [(started, 0)],
        "dir": [(started, 1)],
        "s": [(started, 0b00011), (env.pulses[0], 0b01001)],
    }
    env.check("P104-HSK-03", "edges of the start", edges, expected)
    env.window("P104-HSK-03", "edge 0 to pins", started - edge0, WRITE_EVENT, C_EVENT_LATEST + 2)
    env.check("P104-HSK-03", "status with IBF = 0", status, BUSY)
    await env.idle()
    for code, pin in ((0xC1, "aux_n"), (0x80, "int_n")):
        edge0 = await env.host.write(COMMAND, code)
        await env.bench.clocks(12)
        env.window("P104-HSK-03", f"edge 0 to {pin}", env.bench.edges(pin, edge0)[0][0] - edge0, 2, 12)
    await env.host.read_data()
    await env.host.command(0x86)
    edge0 = await env.host.write(DATA, 0x0F)
    await env.bench.clocks(12)
    env.check("P104-AUX-02", "auxo: all four at once", [v for _, v in env.bench.edges("auxo", edge0)], [0])


@directed("P104-HSK-05", "P104-STA-02", "P104-RD-07", builds=(F16, F100))
async def p104_hsk_05_output_queue(dut):
    """After a 3-byte read command, data reads at any distance return the bytes, and OBF is 0 or 1 as
    documented (P104-HSK-05).
    """
    env = await Env.start(dut, INIT_A)
    await env.go(0x45, rate=9)
    await env.pulse(2, 50)
    await env.host.command(0x40)
    await env.idle()
    for gap in range(1, 9):
        for length in (4, 5, 8):
            await env.host.command(0x83)
            got = []
            for _ in range(3):
                await env.host.poll(OBF, OBF)
                got.append(await env.host.read(DATA, strobe=length, gap=gap))
                soon = await env.host.read(1)
                if gap >= 7:
                    # The read clears OBF on edge 2'; the next byte sets OBF again at most 4 cycles later.
                    env.check("P104-HSK-05", "OBF 8 cycles after the read", soon & OBF, int(len(got) < 3))
            env.check("P104-HSK-05", f"bytes, gap {gap}, strobe {length}", got, [0xFD, 0xFF, 0xFF])
            env.check("P104-HSK-05", "OBF after the third byte", await env.host.status() & OBF, 0)
    await env.host.command(0x81)
    for gap in (1, 2, 3):
        await env.host.command(0x81)
        await env.host.read(DATA, gap=gap)
        env.check("P104-HSK-05", f"OBF of a read byte, gap {gap}", await env.host.status() & OBF, 0)


@directed("P104-HSK-06", "P104-BAD-07")
async def p104_hsk_06_empty_read(dut):
    """With OBF = 0, a data read returns the last byte again and has no effect (P104-HSK-06)."""
    env = await Env.start(dut, INIT_A)
    env.check("P104-HSK-06", "before any byte", await env.host.read(DATA), 0x00)
    await env.host.fetch(0x81)
    await env.host.command(0x43)
    got = [await env.host.read(DATA) for _ in range(3)] + [await env.host.status()]
    env.check("P104-HSK-06", "stale bytes and status", got, [0xCF, 0xCF, 0xCF, 0x30])
    env.bench.set(alm_n=0)
    await env.bench.clocks(8)
    env.check("P104-HSK-06", "stale byte does not follow pins", await env.host.read(DATA), 0xCF)


@directed("P104-HSK-07", "P104-BAD-03", "P104-BAD-04", "P104-INI-02")
async def p104_hsk_07_cancel(dut):
    """Any command cancels an incomplete command, and is then checked as usual (P104-HSK-07)."""
    env = await Env.start(dut, INIT_A)
    await env.host.send(0x43, [0x09])
    await env.bench.clocks(40_000)
    env.check("P104-BAD-03", "NUM after a long silence", await env.host.status(), 0x20)
    for code, status in (
        (0x40, 0x80),
        (0x41, 0x80),
        (0xC2, 0x00),
        (0x87, 0x80),
        (0x00, 0x80),
        (0x84, 0x20),
        (0x44, 0x40),
    ):
        for half in ((0x43, [1, 2]), (0x0A, [1, 1, 4]), (0x84, [1]), (0x86, []), (0x44, [1, 2, 3])):
            await env.host.send(*half)
            env.check("P104-HSK-07", f"{code:#x} after {half}", await env.host.command(code), status)
            if status & 0x80 or not status:
                env.check("P104-HSK-07", "a late byte is not expected", await env.host.data(0), 0xB0)
    await env.host.send(0x44, [9, 1, 0, 0])
    await env.result("P104-HSK-07", 2, 0x84, 0)
    env.check("P104-HSK-07", "old init still valid: interval", env.bench.intervals(), [320])
    await env.go(0x44, 3, rate=99)
    await env.host.command(0x86)
    env.check("P104-HSK-07", "faulty command cancels 0x86", await env.host.command(0x42), 0x94)
    env.check("P104-HSK-07", "its data is error 6", await env.host.data(0x0F), 0xE4)
    env.check("P104-HSK-07", "auxo", env.bench.edges("auxo"), [])


@directed("P104-HSK-08", "P104-BAD-22")
async def p104_hsk_08_queue_stays(dut):
    """Unread bytes stay in the queue during other commands and motions, until another read command is
    executed (P104-HSK-08).
    """
    env = await Env.start(dut, INIT_A)
    await env.move(0x44, 2, rate=9)
    await env.host.command(0x80)
    for code in (0x87, 0x40, 0xC1, 0xC2, 0x43, 0xC0):
        await env.host.command(code)
        env.check("P104-HSK-08", f"OBF after {code:#x}", await env.host.status() & OBF, OBF)
    await env.init(*INIT_A)
    await env.go(0x44, 3, rate=50)
    env.check("P104-HSK-08", "a read while BUSY", await env.host.command(0x81), 0x95)
    env.check("P104-HSK-08", "byte read during BUSY", await env.host.read_data(), 0x84)
    await env.idle()
    await env.host.command(0x83)
    await env.host.command(0x82)
    env.check("P104-HSK-08", "byte of the newer command", await env.host.read_data(), 0x90)
    env.check("P104-HSK-08", "queue is empty", await env.host.status() & OBF, 0)
