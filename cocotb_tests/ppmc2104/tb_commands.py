"""Codes, errors and the table of states (P2104-CMD, P2104-ERR, P2104-FSM)."""

from __future__ import annotations

from itertools import product
from typing import Any

from cocotb_tests.harness import IBF, OBF, directed

from .env import Axis, Env
from .expected_timing import (
    CMND1,
    DATA_BYTES,
    ERROR,
    INIT_A,
    INIT_EXT,
    OPERATIONS,
    axis_of,
    kind_of,
)
from .states import MOVING, RAMP, RESTING, enter, leave

# One code of each row of the table.
ROWS = {
    "setting": 0x02,
    "immediate stop": 0x40,
    "deceleration stop": 0x41,
    "step": 0x42,
    "ramp": 0x43,
    "constant": 0x44,
    "rate": 0x45,
    "high": 0x46,
    "read": 0x80,
    "control input": 0x81,
    "output signal": 0x82,
    "read3": 0x83,
    "error": 0x86,
    "off": 0xC0,
    "auxout": 0xE1,  # bit 5 does not select an axis here
    "auxin": 0xC2,
    "switching": 0x84,
    "delay": 0x85,
    "undefined": 0x87,
}
ALWAYS = {"error": 0, "auxout": 0, "auxin": 0, "undefined": 1}
STOPS = ("immediate stop", "deceleration stop")


def reaction(row: str, state: str) -> int | str:
    """Return the response of P2104-FSM-01: an error number, "waits", or 0 if the code is executed."""
    if row in ALWAYS:
        return ALWAYS[row]
    if row in STOPS:
        if state in RESTING:
            return 4 if state == "INITIAL" else 6
        return 0 if row == "immediate stop" or state in RAMP else 8
    if state not in RESTING:
        return 5
    if row in OPERATIONS and state == "INITIAL":
        return 4
    if state == "INITP" and (row in OPERATIONS or row in ("setting", "off")):
        return "waits"
    return 0


async def react(env: Env, axis: Axis, row: str, state: str) -> None:
    """Check one cell of the table for an axis that is in this state."""
    code = ROWS[row] | axis.axis_bit * (row not in ("auxout", "auxin"))
    want = reaction(row, state)
    what = f"{row} ({code:#x}) in {state}, axis {axis.n}"
    edge0 = await env.host.command(code, poll=False)
    await env.bench.until(edge0 + 10)
    status = await env.host.status()
    env.check("P2104-FSM-01", f"IBF after {what}", status & IBF, IBF if want == "waits" else 0)
    if want == "waits":
        env.check("P2104-FSM-01", f"ERROR after {what}", status & ERROR, 0)
        return
    env.check("P2104-FSM-01", f"ERROR after {what}", status & ERROR, ERROR if want else 0)
    kind = kind_of(code)
    if not want and kind in ("read", "read3", "error", "auxin"):
        env.check("P2104-FSM-01", f"OBF after {what}", status & OBF, OBF)
    data = kind in DATA_BYTES and not want
    if state != "INITP":
        env.check("P2104-FSM-01", f"CMND after {what}", status & axis.cmnd, axis.cmnd if data else 0)
    errors = (want, 0) if axis.n == 1 or not want else (0, want)
    if data:
        # An Error code read would end the data wait.
        return
    env.check("P2104-FSM-01", f"errors after {what}", await env.errors(), errors)


async def table(env: Env, axis: Axis, states: tuple[str, ...]) -> None:
    """Check all rows of the table in these columns."""
    for state, row in product(states, ROWS):
        await enter(axis, state)
        await react(env, axis, row, state)
        await leave(axis)


@directed("P2104-FSM-01", "P2104-ERR-04", "P2104-FSM-02", "P2104-FSM-04", "P2104-HSK-04")
async def p2104_fsm_01_at_rest(dut: Any) -> None:
    """In INITIAL, INITP and NORMAL, the response to every instruction is that of the table
    (P2104-FSM-01).
    """
    env = await Env.start(dut)
    for axis in env.axes:
        await table(env, axis, RESTING)


@directed("P2104-FSM-01", "P2104-ERR-04", "P2104-STP-03", "P2104-FSM-03", "P2104-CMD-04")
async def p2104_fsm_01_moving_axis_1(dut: Any) -> None:
    """In every state of a moving axis 1, the response to every instruction is that of the table
    (P2104-FSM-01).
    """
    env = await Env.start(dut)
    await table(env, env.x1, MOVING)


@directed("P2104-FSM-01", "P2104-ERR-04", "P2104-STP-03", "P2104-FSM-02")
async def p2104_fsm_01_moving_axis_2(dut: Any) -> None:
    """In every state of a moving axis 2, the response to every instruction is that of the table
    (P2104-FSM-01).
    """
    env = await Env.start(dut)
    await table(env, env.x2, MOVING)


@directed("P2104-FSM-02", "P2104-OPR-10", "P2104-RD-08")
async def p2104_fsm_02_the_other_axis(dut: Any) -> None:
    """For any states of the two axes, the response to a code depends only on the state of the axis to which
    it is sent (P2104-FSM-02).
    """
    env = await Env.start(dut)
    for axis, other in ((env.x1, env.x2), (env.x2, env.x1)):
        for state in ("INITIAL", "RUNWAIT", "ACC", "DEC", "CONST"):
            await other.init(*INIT_A)
            await enter(axis, state)
            for row in ("immediate stop", "deceleration stop", "read", "output signal", "read3"):
                await react(env, other, row, "NORMAL")
            await other.move(0x43, 9)
            await other.result("P2104-FSM-02", 9, 0x83, 0)
            await other.send(0x84, [0x50, 0x60])
            await other.send(0x85, [0x01])
            await other.init(0x02, 6, 4, 4)
            await other.command(0xC0)
            await react(env, other, "step", "INITIAL")
            await leave(axis)


@directed("P2104-FSM-01", "P2104-ERR-01", "P2104-ERR-02", "P2104-FSM-05", "P2104-STP-07", "P2104-BAD-04")
async def p2104_fsm_01_code_in_a_data_wait(dut: Any) -> None:
    """While data of either axis is expected, any code sets error 3 and cancels the instruction; stops are
    executed nevertheless (P2104-FSM-01).
    """
    env = await Env.start(dut)
    for waiting, axis in product(env.axes, env.axes):
        states = ("INITIAL", "NORMAL", *MOVING) if waiting is not axis else ("INITIAL", "NORMAL")
        for state in states:
            for row, code in ROWS.items():
                if state.startswith("FIN"):
                    continue
                await enter(axis, state)
                await waiting.command(0x84)
                code |= axis.axis_bit * (row not in ("auxout", "auxin"))
                status = await env.host.command(code)
                what = f"{row} in {state} of axis {axis.n}, axis {waiting.n} waiting"
                env.check("P2104-ERR-02", f"OBF, CMND after {what}", status & (OBF | CMND1 | CMND1 << 1), 0)
                error = 8 if row in STOPS and reaction(row, state) == 8 else 3
                charged = axis_of(code)
                await env.bench.clocks(env.cfg.w + 12)
                busy = (await env.host.status()) & axis.busy
                stopped = state not in MOVING or row == "immediate stop"
                # Before pulse 1 the deceleration stop is stored, and the axis still waits for the clock.
                env.check("P2104-FSM-05", f"BUSY after {what}", busy, 0 if stopped else axis.busy)
                if row == "deceleration stop" and state in RAMP:
                    await axis.command(0x41)
                    env.check("P2104-FSM-05", f"flag set by {what}", await axis.error(), 8)
                    error = 0
                errors = (error, 0) if charged == 1 else (0, error)
                env.check("P2104-ERR-01", f"errors after {what}", await env.errors(), errors)
                await leave(axis)
                await leave(waiting)


@directed("P2104-CMD-01", "P2104-CMD-03", "P2104-ERR-01", "P2104-ERR-03", "P2104-BAD-01")
async def p2104_cmd_01_all_codes_while_busy(dut: Any) -> None:
    """While axis 1 waits for its clock and axis 2 is initialised, all codes are decoded before any other
    check (P2104-CMD-01).
    """
    env = await Env.start(dut)
    first, second = env.axes
    await first.init(*INIT_EXT)
    await second.init(*INIT_A)
    await first.go(0x44, 1000, 1)
    for code in range(256):
        kind, axis = kind_of(code), axis_of(code)
        if kind == "undefined":
            error = 1
        elif kind == "stop":
            error = (8 if code & 1 else 0) if axis == 1 else 6
        elif axis == 1 and kind not in ("error", "auxout", "auxin"):
            error = 5
        else:
            error = 0
        status = await env.host.command(code)
        outstanding = kind in DATA_BYTES and not error
        env.check("P2104-CMD-01", f"CMND after {code:#04x}", status & 0x30, 0x20 if outstanding else 0)
        if outstanding:
            await env.host.command(0x87)
            env.check("P2104-CMD-01", f"errors after {code:#04x}", await env.errors(), (3, 0))
        else:
            want = (error, 0) if axis == 1 else (0, error)
            env.check("P2104-CMD-01", f"errors after {code:#04x}", await env.errors(), want)
        if axis == 2 and kind in OPERATIONS and not outstanding:
            env.check("P2104-CMD-01", f"BUSY2 after {code:#04x}", bool(status & second.busy), True)
            await second.halt()
            await env.errors()
        if code == 0xE0:
            await second.init(*INIT_A)
        if kind == "stop" and axis == 1 and not code & 1:
            await first.idle()
            env.check("P2104-CMD-03", f"end status after {code:#04x}", await first.finish(), 0xC4)
            await first.go(0x44, 1000, 1)
    env.check("P2104-ERR-03", "pulses of axis 1", env.bench.pulses(0, first.pout), [])
    await first.halt()


@directed("P2104-CMD-02", "P2104-OPR-08", "P2104-CMD-03")
async def p2104_cmd_02_operation_bits(dut: Any) -> None:
    """I, D, P and the axis bit of each operation each have only their defined effect (P2104-CMD-02)."""
    env = await Env.start(dut)
    axes = await env.both(INIT_A)
    for axis, (code, n, rate) in product(
        axes,
        (
            (0x42, None, None),
            (0x43, 3, None),
            (0xC3, 3, None),
            (0x44, 3, 9),
            (0x45, None, 9),
            (0xC6, None, None),
        ),
    ):
        for masked, ccw in product((0, 0x10), (0, 0x08)):
            pattern = axis.phases_now
            await axis.go(code | masked | ccw, n, rate)
            if n is None and code != 0x42:
                await axis.pulse(3, 4)
                await axis.command(0x40)
            await axis.idle()
            what = f"{code | masked | ccw:#x}, axis {axis.n}"
            env.check("P2104-CMD-02", f"dir, {what}", axis.level("dir"), ccw >> 3)
            ints = [v for _, v in env.bench.edges("int_n", axis.since)]
            env.check("P2104-CMD-02", f"int_n, {what}", ints, [] if masked else [0])
            steps = len(env.bench.edges(axis.phases, axis.since))
            env.check("P2104-OPR-08", f"steps, {what}", steps, 0 if code & 0x80 else len(axis.pulses))
            env.check("P2104-OPR-08", f"pattern moved, {what}", axis.phases_now != pattern, code < 0x80)
            await axis.finish()


@directed("P2104-CMD-04", "P2104-ERR-05", "P2104-HSK-08", "P2104-BAD-03", "P2104-STA-05")
async def p2104_cmd_04_data_bytes(dut: Any) -> None:
    """CMND stays 1 until the last data byte of an instruction, without a time-out (P2104-CMD-04)."""
    env = await Env.start(dut)
    for axis in await env.both(INIT_A):
        for code, data in (
            (0x43, [2, 0, 0]),
            (0x44, [9, 2, 0, 0]),
            (0x45, [9]),
            (0x84, [0x40, 0x50]),
            (0x85, [3]),
            (0x02, [9, 4, 4, 0]),
        ):
            axis.since = env.bench.now
            env.check("P2104-STA-05", "CMND after the code", await axis.command(code), axis.cmnd)
            for place, byte in enumerate(data):
                await env.bench.clocks(3_000)
                env.check("P2104-CMD-04", f"CMND before byte {place}", await env.host.status(), axis.cmnd)
                env.check("P2104-CMD-04", "pulses so far", axis.pulses, [])
                status = await env.host.data(byte)
            last = {0x43: axis.busy, 0x44: axis.busy, 0x45: axis.busy, 0x02: axis.cmnd}.get(code, 0)
            env.check("P2104-CMD-04", f"status after the last byte of {code:#x}", status, last)
            if code == 0x45:
                await axis.halt()
            elif last == axis.busy:
                await axis.idle()
                env.check("P2104-CMD-04", "pulses", len(axis.pulses), 3)
                await axis.finish()
            await axis.ready()


@directed("P2104-ERR-02", "P2104-HSK-08", "P2104-CMD-04")
async def p2104_err_02_abandoned_instructions(dut: Any) -> None:
    """If a code ends an incomplete instruction at any byte, no part of this instruction takes effect
    (P2104-ERR-02).
    """
    env = await Env.start(dut)
    axis = await env.ready(1, INIT_A)
    cases = ((0x02, [20, 10, 9, 0]), (0x43, [5, 0, 0]), (0x44, [9, 3, 0, 0]), (0x47, [9]), (0x84, [64, 64]))
    since = env.bench.now
    for code, data in (*cases, (0x85, [0])):
        for sent in range(len(data)):
            await axis.send(code, data[:sent])
            await env.x2.command(0x86)
            env.check("P2104-ERR-02", f"{code:#x} and {sent} bytes", await env.errors(), (0, 3))
            await env.host.data(data[sent])
            env.check("P2104-ERR-02", "its next byte", await env.errors(), (2, 0))
    await env.bench.clocks(1_000)
    env.quiet("P2104-ERR-02", since)
    pulses = await axis.move(0x43, 14)
    env.check("P2104-ERR-02", "the ramp is the old one", pulses[-1] - pulses[0], 2_720)


@directed("P2104-ERR-05", "P2104-LIM-06", "P2104-OPR-07")
async def p2104_err_05_order_of_checks(dut: Any) -> None:
    """If a last byte has several faults, the first in the order of the checks is reported (P2104-ERR-05)."""
    env = await Env.start(dut)
    for axis in await env.both(INIT_A):
        axis.set(alm_n=0)
        await env.bench.clocks(4)
        await axis.refused("P2104-ERR-05", "45 00 on ALM", 9, 0x45, 0)
        await axis.refused("P2104-ERR-05", "44 00 on ALM", 9, 0x44, 0, 5, 0, 0)
        await axis.refused("P2104-ERR-05", "47 00 on ALM", 9, 0x47, 0)
        await axis.refused("P2104-ERR-05", "47 09 on ALM", 7, 0x47, 9)
        await axis.refused("P2104-INI-03", "RL < RH + 2 and PA > 2BD4h", 9, 0x02, 5, 4, 0xD5, 0x2B)
        await axis.refused("P2104-INI-03", "PA > 2BD4h", 10, 0x02, 6, 4, 0xD5, 0x2B)
        axis.set(alm_n=1)
        env.check("P2104-ERR-03", "end status", await axis.finish(), 0x00)


@directed("P2104-ERR-03", "P2104-BAD-05", "P2104-BAD-06", "P2104-BAD-07", "P2104-BAD-02", "P2104-FSM-01")
async def p2104_err_03_faults_in_motion(dut: Any) -> None:
    """While both axes move, faulty bytes change only the error registers (P2104-ERR-03)."""
    env = await Env.start(dut)
    first, second = await env.both(INIT_A)
    await first.go(0x44, 60, 39)
    await second.go(0x4C, 60, 29)
    for script, errors in (
        ("d 11", (2, 0)),
        ("c 43 d 01 d 02 d 03", (2, 0)),
        ("c 63 d 01 d 02 d 03", (2, 5)),
        ("c 42", (5, 0)),
        ("c 62", (0, 5)),
        ("c 07 c 87 c 64", (1, 5)),
        ("c A7 c BF", (0, 1)),
        ("c 84", (5, 0)),
        ("c 41 c 61", (8, 8)),
    ):
        await env.run(script)
        env.check("P2104-ERR-03", f"errors of {script}", await env.errors(), errors)
    await first.idle()
    await second.idle()
    first.check_train("P2104-ERR-03", [39] * 59)
    second.check_train("P2104-ERR-03", [29] * 59)
    env.check("P2104-ERR-03", "80, A0", await env.run("c 80 r c A0 r"), [0x84, 0x84])
    # If more bytes are sent than the instruction has, the instruction is executed, and the surplus bytes set
    # error 2.
    first.since = env.bench.now
    await env.run("c 44 d 09 d 02 d 00 d 00 d 00 d 7F")
    env.check("P2104-BAD-05", "errors", await env.errors(), (2, 0))
    await first.result("P2104-BAD-05", 3, 0x84, 0)


@directed("P2104-ERR-01", "P2104-ERR-06", "P2104-RD-07", "P2104-STA-06")
async def p2104_err_06_registers(dut: Any) -> None:
    """Each error register contains its newest error and is cleared separately (P2104-ERR-06)."""
    env = await Env.start(dut)
    got = await env.run("c 87 c 40 s c A7 c 42 c 84 d 00 d 00 s e1 s e1 s e2 s")
    expected = [0x80, 0x80, 11, 0x80, 0, 0x80, 1, 0x00]
    env.check("P2104-ERR-06", "statuses and registers", got, expected)
    env.check("P2104-ERR-01", "e2 after 84", await env.run("c A4 d 3F d 40 e1 e2"), [0, 11])
