"""Processing windows of the old chip, TIMING = "DATASHEET" (P2104-DS-01…15, AC-71 to AC-74).

I(j) is the interval that follows pulse j, and W the pulse and set-up time of 5 us in cycles. The C-event of a
byte is the edge on which the core consumes it.
"""

from __future__ import annotations

from typing import Any

from cocotb_tests.harness import D11, D16, IBF, OBF, directed
from cocotb_tests.harness.axis_driver import bytes_of, rates

from .datasheet_timing import ON, PIN, READ, TOLERANCE, after, last_byte, opens, rest
from .env import C_EVENT_LATEST, WRITE_EVENT, Env
from .expected_timing import ERROR, INIT_A, INIT_B, slowed

BOTH = (D16, D11)


@directed("AC-73", "P2104-DS-01", "P2104-INI-07", "P2104-STA-05", "P2104-SW-02", builds=BOTH)
async def p2104_ac_73_setting(dut: Any) -> None:
    """A setting with S = 1 drives the phases immediately and sets CMND for 71 ms; then chopping starts
    (AC-73).
    """
    env = await Env.start(dut)
    axis = env.x1
    edge0 = await last_byte(axis, 0x12, *INIT_B[1:], 0)
    shown = await env.bench.edge(axis.phases)
    env.window("AC-73", "last byte to the pattern", shown - edge0, 2, 12)
    env.check("AC-73", "s1_n", axis.phases_now, 0b11100)
    await env.bench.clocks(200)
    env.check("AC-73", "status", await env.host.status(), axis.cmnd)
    await env.host.command(0xF1, poll=False)
    nominal = env.cfg.us(71_000)
    await env.bench.until(edge0 + 2 + nominal - 20)
    env.check("AC-73", "status just before", await env.host.status(), axis.cmnd | IBF)
    env.check("AC-73", "s1_n edges", [v for _, v in env.bench.edges(axis.phases)], [0b11100])
    off = await env.bench.edge(axis.phases, 0x1F)
    q = env.cfg.quanta
    low, high = nominal + 2 + q(2 * ON) - q(1) - 1, nominal + 10 + q(2 * ON) + q(1) + 1 + TOLERANCE + PIN
    env.window("P2104-DS-01", "last byte to the first OFF", off - edge0, low, high)
    env.check("AC-73", "CMND afterwards", await env.host.status() & axis.cmnd, 0)
    # Code F1 is accepted at the end of this window and takes effect at the end of its own window.
    auxo = env.bench.edges("auxo", edge0)
    if not auxo:
        await env.bench.edge("auxo")
        auxo = env.bench.edges("auxo", edge0)
    env.window(
        "P2104-DS-12", "auxo", auxo[0][0] - edge0 - nominal - env.cfg.us(40), 2, 2 * TOLERANCE + 12 + PIN
    )


@directed(
    "AC-71",
    "P2104-DS-04",
    "P2104-DS-05",
    "P2104-DS-06",
    "P2104-DS-07",
    "P2104-DS-08",
    "P2104-DS-09",
    "P2104-DS-14",
    "P2104-TIM-01",
    builds=BOTH,
)
async def p2104_ac_71_starts(dut: Any) -> None:
    """For each accepted operation, BUSY is set immediately, and pulse 1 occurs W after the end of its window
    (AC-71).
    """
    env = await Env.start(dut)
    axis = await env.ready(1, INIT_B)
    for code, data, micros in (
        (0x42, [], 103),
        (0x44, [0x63, 9, 0, 0], 29),
        (0x45, [0x63], 32),
        (0x47, [0x63], 32),
        (0x46, [], 118),
        (0x4E, [], 118),
        (0x43, bytes_of(9), 340),
        (0xCB, bytes_of(19), 340),
        (0x43, bytes_of(20), 110),
        (0xC3, bytes_of(99), 110),
    ):
        edge0 = await last_byte(axis, code, *data)
        await env.bench.until(edge0 + 12)
        levels = (axis.level("hold"), axis.level("dir"))
        env.check("P2104-DS-14", f"hold, dir of {code:#x}", levels, (0, code >> 3 & 1))
        env.check(
            "P2104-DS-14", "BUSY", await env.host.status() & (axis.busy | axis.cmnd), axis.busy | axis.cmnd
        )
        if code in (0x44, 0xCB):
            await opens(env, "P2104-DS-07", edge0, micros)
        first = await axis.pulse(1)
        after(env, "AC-71", f"pulse 1 of {code:#x}", first, edge0, micros, env.cfg.w)
        env.check("P2104-DS-14", "CMND after the window", await env.host.status() & axis.cmnd, 0)
        await axis.command(0x40)
        await rest(env)


@directed("P2104-DS-14", "P2104-DS-22", "P2104-OPR-02", builds=(D16,))
async def p2104_ds_14_run_in_the_window(dut: Any) -> None:
    """If run changes during the window of an operation, only the level of run at the end of the window
    applies (P2104-DS-14).
    """
    env = await Env.start(dut)
    axis = await env.ready(1, INIT_B)
    w = env.cfg.w
    axis.set(run=0)
    edge0 = await last_byte(axis, 0x42)
    await env.bench.clocks(500)
    axis.set(run=1)
    await env.bench.clocks(300)
    axis.set(run=0)
    await env.bench.until(edge0 + env.cfg.us(103) + 500)
    env.check("P2104-DS-14", "pulses after the window", axis.pulses, [])
    rise = axis.set(run=1)
    env.window("P2104-TIM-02", "run to pulse 1", await axis.pulse(1) - rise, w, w + 6)
    await axis.idle()
    edge0 = await last_byte(axis, 0x42)
    await env.bench.clocks(100)
    axis.set(run=0)
    await env.bench.clocks(100)
    axis.set(run=1)
    after(env, "P2104-DS-14", "pulse 1", await axis.pulse(1), edge0, 103, w)
    await rest(env)
    # The start check uses the level of the input at this moment, without a delay.
    axis.set(alm_n=0)
    await env.bench.clocks(4)
    edge0 = await last_byte(axis, 0x42)
    await env.bench.until(edge0 + 10)
    env.check("P2104-DS-22", "refused at once", await env.host.status() & (ERROR | IBF | axis.busy), ERROR)
    axis.set(alm_n=1)
    await env.bench.clocks(4)
    env.check("P2104-DS-22", "error", await axis.error(), 7)


@directed("AC-72", "P2104-DS-02", "P2104-DS-12", "P2104-HSK-01", builds=BOTH)
async def p2104_ac_72_immediate_stop(dut: Any) -> None:
    """When code 40 is accepted, no further pulse is output. The operation ends 400 us later; bytes wait until
    then (AC-72).
    """
    env = await Env.start(dut)
    axis = await env.ready(1, INIT_B)
    await axis.go(0x44, 1000, 0x63)
    await axis.pulse(10, 400)
    edge0 = await axis.command(0x40, poll=False)
    await env.bench.clocks(40)
    await env.host.command(0xD1, poll=False)
    nominal = env.cfg.us(400)
    await env.bench.until(edge0 + 2 + nominal - 20)
    env.check("AC-72", "status just before", await env.host.status() & (IBF | axis.busy), IBF | axis.busy)
    end = await axis.wait_end()
    after(env, "AC-72", "end", end, edge0, 400)
    # BUSY falls one edge before int_n or earlier, and the waiting code D1 is then accepted.
    env.check("AC-72", "BUSY", await env.host.status() & axis.busy, 0)
    aux = await env.bench.edge("auxo")
    env.window("AC-72", "auxo after the end", aux - end, env.cfg.us(40) - 4, env.cfg.us(40) + TOLERANCE + 8)
    hold = await env.bench.edge(axis.pin("hold"), 1)
    delay = env.cfg.us(3_200)
    env.window("P2104-DS-02", "hold after the end", hold - end, delay - 4, delay + 16 + 4)
    await axis.result("AC-72", 10, 0xC4, 989)
    await rest(env)
    # During FIN the mailbox is closed for 400 us; the normal end is not delayed and sets no bit.
    await axis.go(0x42)
    fall = await axis.pulse(1, 4)
    edge0 = await axis.command(0x40, poll=False)
    end = await axis.wait_end()
    env.window("P2104-DS-15", "normal end after the fall", end - fall, env.cfg.w, env.cfg.w + 4)
    await opens(env, "P2104-DS-02", edge0, 400)
    env.check("P2104-STP-05", "end status", await axis.finish(), 0x82)


@directed("P2104-DS-03", "P2104-STP-02", "P2104-FDC-02", builds=(D16,))
async def p2104_ds_03_deceleration_stop(dut: Any) -> None:
    """Code 41 sets the deceleration flag after 32 us. If the rate is RL at that time, the motion ends
    immediately. If a deceleration or the end has already begun, the flag has no effect (P2104-DS-03).
    """
    env = await Env.start(dut)
    axis = await env.ready(1, INIT_B)
    edge0 = 0

    async def ask(j: int, plus: int, n: int = 100) -> None:
        nonlocal edge0
        await axis.go(0x43, n)
        await axis.pulse(j, plus)
        edge0 = await axis.command(0x41, poll=False)

    # I(6) has index 5 and lasts 896 cycles. The deceleration flag is set 512 cycles after the stop, in I(6)
    # or in I(7).
    for plus, flagged in ((100, 6), (600, 7)):
        await ask(6, plus)
        await opens(env, "P2104-DS-03", edge0, 32)
        expected = slowed(INIT_B[1:], 100, flagged)
        await axis.result("P2104-DS-03", len(expected) + 1, 0xC3, 98 - len(expected))
        axis.check_train("P2104-DS-03", expected)
        await rest(env)
    # In I(1), which has the rate RL, the motion ends when the window ends.
    await ask(1, 100)
    end = await axis.wait_end()
    after(env, "P2104-DS-03", "end at RL", end, edge0, 32)
    await axis.result("P2104-DS-03", 1, 0xC3, 98)
    await rest(env)
    # The stop is requested while accelerating, and its window ends after the natural deceleration (from pulse
    # 6 of 10 on) has begun: the stop has no effect and sets no bit.
    await ask(5, 992 - 300, n=10)
    await axis.result("P2104-DS-03", 10, 0x83, 0)
    axis.check_train("P2104-DS-03", rates(INIT_B[1:], [0, 1, 2, 3, 4, 3, 2, 1, 0]))
    # A rejected stop has no window.
    await rest(env)
    await axis.go(0x45, rate=0x63)
    await axis.pulse(1, 200)
    edge0 = await axis.command(0x41, poll=False)
    await env.bench.until(edge0 + 10)
    env.check("P2104-DS-03", "IBF, ERROR", await env.host.status() & (IBF | ERROR), ERROR)


@directed("AC-74", "P2104-DS-10", "P2104-DS-12", "P2104-INT-03", builds=BOTH)
async def p2104_ac_74_reads(dut: Any) -> None:
    """After each read instruction, OBF is set at the end of its window, and the answer contains the values at
    that time (AC-74).
    """
    env = await Env.start(dut)
    env.bench.set(errint_n=0)
    await env.run("c 87")
    for code, micros in ((0x81, 36), (0x82, 32), (0x83, 37), (0x80, 40), (0xC2, 40), (0xA1, 36), (0x86, 43)):
        edge0 = await env.host.command(code, poll=False)
        await env.host.poll(IBF, 0)
        cmnd = 0 if code == 0xC2 else 0x20 if code & 0x20 else 0x10
        env.check("AC-74", f"status in the window of {code:#x}", await env.host.status() & 0x31, cmnd)
        nominal = env.cfg.us(micros)
        if code == 0x81:
            # The change is after the C-event but before the end of the window, so the answer contains it.
            env.x1.set(org_n=0)
        await env.host.poll(OBF, OBF, dense=1000)
        late = env.bench.now - edge0
        env.window("AC-74", f"OBF of {code:#x}", late, 2 + nominal, 10 + nominal + TOLERANCE + READ)
        got = [await env.host.read_data() for _ in range(3 if code == 0x83 else 1)]
        expected = {0x81: [0x4F], 0x82: [0xFC], 0x83: [0] * 3, 0xA1: [0xCF], 0x86: [1]}.get(code, [0])
        env.check("AC-74", f"answer of {code:#x}", got, expected)
        if code == 0x86:
            up = [t for t, v in env.bench.edges("int_n", edge0) if v][0]
            after(env, "P2104-DS-10", "int_n", up, edge0, micros)
        env.x1.set(org_n=1)
        await env.host.poll(0x30, 0)
    edge0 = await env.host.command(0xA0, poll=False)
    await opens(env, "P2104-DS-10", edge0, 40)


@directed("P2104-DS-11", "P2104-DS-12", "P2104-DS-13", "P2104-AUX-05", "P2104-AUX-04", builds=(D16,))
async def p2104_ds_11_auxiliary(dut: Any) -> None:
    """Codes C0, D1, 84 and 85 take effect at the end of their windows (P2104-DS-11, P2104-DS-12,
    P2104-DS-13).
    """
    env = await Env.start(dut)
    axis = await env.ready(1, (0x12, *INIT_A[1:]))
    edge0 = await last_byte(axis, 0x84, 0x40, 0x40)
    await opens(env, "P2104-DS-13", edge0, 36)
    await env.bench.clocks(3_000)
    spans = {span for _, span in axis.stretches(env.bench.now - 2_500)}
    env.check("P2104-DS-13", "switching times", spans, {512})
    # The value takes effect at the end of the window: a hold timer that starts during the window uses the old
    # value.
    edge0 = await last_byte(axis, 0x85, 0x00)
    await opens(env, "P2104-DS-13", edge0, 32)
    await env.host.command(0xE1)
    edge0 = await env.host.command(0xD1, poll=False)
    aux = [await env.bench.edge("auxo"), await env.bench.edge("auxo")]
    env.window("P2104-DS-12", "D1 after E1", aux[1] - aux[0], env.cfg.us(40), env.cfg.us(40) + TOLERANCE + 4)
    await env.bench.edge(axis.phases, 0b11100)
    edge0 = await last_byte(axis, 0xC0)
    await env.bench.until(edge0 + env.cfg.us(32) - 2)
    await opens(env, "P2104-DS-11", edge0, 32)
    (off, level) = env.bench.edges(axis.phases, edge0)[-1]
    env.check("P2104-DS-11", "phases", level, 0x1F)
    env.window("P2104-DS-11", "C0 to the last edge of the phases", off - edge0, 2, env.cfg.us(32) + 28)
    await env.bench.clocks(2_000)
    env.check("P2104-DS-11", "phases stay off", env.bench.edges(axis.phases, off + 1), [])
    # Errors and data bytes have no window.
    for register, byte in ((1, 0x87), (0, 0x55), (1, 0x42), (1, 0x43), (1, 0x84), (0, 0x40), (1, 0x40)):
        edge0 = await env.host.write(register, byte)
        await env.bench.until(edge0 + C_EVENT_LATEST - WRITE_EVENT + 2)
        env.check("P2104-DS-13", f"IBF after {byte:#x}", await env.host.status() & IBF, 0)


@directed("P2104-DS-15", "P2104-END-01", "P2104-END-02", "P2104-TIM-05", "P2104-SW-02", builds=BOTH)
async def p2104_ds_15_as_fast(dut: Any) -> None:
    """In complete moves, pulses, ends, hold and the release of int_n occur at the same times as in FAST
    (P2104-DS-15).
    """
    env = await Env.start(dut)
    axis = await env.ready(2, INIT_B)
    await axis.go(0x43, 30)
    await axis.idle()
    which = [*range(10), *[10] * 9, *range(9, -1, -1)]
    axis.check_train("P2104-DS-15", rates(INIT_B[1:], which))
    env.check("P2104-DS-15", "low times", set(axis.low_times), {env.cfg.w})
    rise = env.bench.rises(axis.pout, axis.since)[-1]
    env.window("P2104-DS-15", "int_n after pout_n", await axis.wait_end() - rise, 0, 4)
    since = env.bench.now
    await env.x1.go(0x42)
    env.check("P2104-DS-15", "end status", await axis.finish(), 0x83)
    await env.bench.clocks(400)
    env.check("P2104-DS-15", "int_n", [v for _, v in env.bench.edges("int_n", since)], [1])
    hold = await env.bench.edge(axis.pin("hold"), 1)
    delay = env.cfg.us(3_200)
    env.window("P2104-DS-15", "pout_n to hold", hold - rise, delay, delay + 24)
