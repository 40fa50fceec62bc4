"""Status register, byte rules and accept/reject table: STMC-ST, STMC-CMD, STMC-FSM, STMC-BAD-01..08."""

from __future__ import annotations

from typing import Any

from cocotb_tests.harness import BUSY, COMMAND, DATA, ERR, F16, IBF, OBF, directed

from .env import Env
from .expected_timing import SHEET, STANDARD
from .states import MOVING, RESTING, enter, leave

READS = {"SHEET": (0x80, 0x82, 0x83, 0x84), "FAMILY": (0x80, 0x81, 0x82, 0x83)}
RAMP_COMMANDS = (3, 6)


def kind_of(code: int, reads: tuple[int, ...]) -> str:
    """Return the kind of a command byte, derived from the table of all codes only."""
    if code < 0x40:
        return "init" if code & 3 else "undefined"
    if code < 0x80:
        return ("stop", "slow", "single", "ramp", "steady", "limit", "ramp0", "search")[code & 7]
    return "read" if code in reads else "undefined"


def expected(kind: str) -> int:
    """Return the CODE field for an accepted code: the number of data bytes that follow."""
    return {"init": 0x40, "ramp": 0x30, "steady": 0x40, "limit": 0x10, "search": 0x10}.get(kind, 0x00)


def expected_status(kind: str, state: str) -> int:
    """Return the status for a code in a state without BUSY, according to the accept/reject table."""
    moving = state in MOVING
    if kind == "undefined":
        return 0x80
    if kind == "stop":
        return 0x00 if moving else 0x80
    if kind == "slow":
        if not moving:
            return 0x80
        return 0xF0 if state in ("S flagged", "D", "D natural") else 0x00
    if moving:
        return 0x90
    if kind == "read":
        return OBF
    if kind != "init" and state.endswith("U"):
        return 0xA0
    return expected(kind)


# One code of each kind, some with don't-care bits set.
SAMPLE = (0x0A, 0x08, 0x40, 0x78, 0x41, 0x59, 0x42, 0x43, 0x64, 0x45, 0x46, 0x47, 0x80, 0x83, 0x84, 0xC3)


@directed("STMC-MOT-01", "STMC-STP-05", "STMC-BAD-01", builds=(F16, SHEET))
async def stmc_all_codes_before_the_initialisation(dut: Any) -> None:
    """Before initialisation, each of the 256 codes sets the status of its kind (STMC-MOT-01)."""
    env = await Env.start(dut, None, clock=0)
    reads = READS["SHEET" if env.sheet else "FAMILY"]
    count = 0
    for code in range(256):
        kind = kind_of(code, reads)
        count += kind == "undefined"
        got = await env.host.command(code)
        env.check("STMC-BAD-01", f"status after {code:#04x}", got & ~OBF, expected_status(kind, "U") & ~OBF)
        if kind == "read":
            while await env.host.status() & OBF:
                await env.host.read(DATA)
                await env.bench.clocks(8)
    env.check("STMC-BAD-01", "number of undefined codes", count, 16 + 124)


@directed("STMC-FSM-01", "STMC-FSM-02", "STMC-CMD-01", "STMC-STP-04", "STMC-ST-03")
async def stmc_fsm_01_accept_table(dut: Any) -> None:
    """In each state, each kind of byte sets the status of the accept/reject table (STMC-FSM-01)."""
    env = await Env.start(dut, None, clock=0)
    for state in (*RESTING, *MOVING):
        for code in SAMPLE:
            kind = kind_of(code, READS["FAMILY"])
            ends = state in MOVING and kind in ("stop", "slow")
            await enter(env, state)
            got = await env.host.command(code)
            moving = BUSY if state in MOVING else 0
            want = expected_status(kind, state)
            if ends or (not moving and kind in ("single", "ramp0")):
                env.check("STMC-FSM-01", f"{code:#04x} in {state}", got & ~BUSY, want)
            else:
                env.check("STMC-FSM-01", f"{code:#04x} in {state}", got, want | moving)


@directed("STMC-CMD-03", "STMC-BAD-02", "STMC-BAD-03", "STMC-ST-03")
async def stmc_cmd_03_data_bytes(dut: Any) -> None:
    """In each state, a data byte is either accepted or sets error 3 or 6, and has no other effect
    (STMC-CMD-03).
    """
    env = await Env.start(dut, None, clock=0)
    for state in (*RESTING, *MOVING):
        await enter(env, state)
        since = env.bench.now
        got = await env.host.data(0x03)
        if state == "S single":
            env.check("STMC-CMD-03", f"data byte in {state}", got & ~BUSY, 0xE0)
            continue
        want = 0xE0 | BUSY if state in MOVING else {"W from U": 0x30, "W from I": 0x20}.get(state, 0xB0)
        env.check("STMC-CMD-03", f"data byte in {state}", got, want)
        env.quiet("STMC-CMD-03", since)
        await leave(env)


@directed("STMC-ST-02", "STMC-ST-03", "STMC-ST-04", "STMC-CMD-01", "STMC-CMD-02")
async def stmc_st_03_error_field(dut: Any) -> None:
    """After an error, only an accepted command clears ERR; data bytes, accepted or rejected, do not
    (STMC-ST-03).
    """
    env = await Env.start(dut)
    got = await env.statuses("c C0 d 00")
    env.check("STMC-ST-03", "statuses", got, [0x80, 0xB0])
    env.since = env.bench.now
    await env.go(0x44, 2, 20)
    got = await env.statuses("d 01 c C0 c 80")
    env.check("STMC-ST-03", "statuses while busy", got, [0xE4, 0x84, 0x94])
    await env.idle()
    env.check("STMC-ST-04", "status after the end", await env.host.status(), 0x90)
    await env.bench.clocks(300)
    got = await env.statuses("c 43 d 05 c C1 d 00 c 44 d 00 d 00 d 00 d 00 d 01 c 40")
    want = [0x30, 0x20, 0x80, 0xB0, 0x40, 0x30, 0x20, 0x10, 0xD0, 0xB0, 0x80]
    env.check("STMC-ST-03", "statuses at rest", got, want)
    env.check("STMC-ST-02", "80 clears ERR", await env.host.command(0x80), OBF)


@directed("STMC-CMD-02", "STMC-BAD-04", "STMC-FSM-03")
async def stmc_cmd_02_unfinished_commands(dut: Any) -> None:
    """An incomplete command has no effect, however long it waits and whichever code follows (STMC-CMD-02)."""
    env = await Env.start(dut)
    since = env.bench.now
    for script in ("c 43 d 05 d 00", "c 44 d 07 d 01 d 00", "c 0A d 05 d 05 d 00", "c 45", "c 08", "c 47"):
        await env.statuses(script)
        await env.bench.clocks(300)
        env.quiet("STMC-CMD-02", since)
    await env.host.command(0x80)
    env.check("STMC-CMD-02", "FIN", await env.host.read_data(), 0x80)
    await env.go(0x43, 3)
    await env.outcome("STMC-CMD-02", 3, 0x83, 0, [20, 20])


@directed("STMC-ST-01", "STMC-BAD-08")
async def stmc_bad_08_motion_before_the_initialisation(dut: Any) -> None:
    """Before initialisation, motions return error 2, and each of their data bytes returns error 3
    (STMC-BAD-08).
    """
    env = await Env.start(dut, None)
    env.check("STMC-ST-01", "status", await env.host.status(), 0x00)
    for code, count in ((0x42, 0), (0x43, 3), (0x44, 4), (0x45, 1), (0x46, 0), (0x4F, 1)):
        got = [await env.status_after(code)] + [await env.status_after(5, DATA) for _ in range(count)]
        env.check("STMC-BAD-08", f"statuses of {code:#x}", got, [0xA0, *[0xB0] * count])
    env.quiet("STMC-BAD-08", 0)
    await env.init(*STANDARD)
    env.check("STMC-BAD-08", "registers", await env.host.run("c 80 r c 83 rrr"), [0x80, 0, 0, 0])


@directed("STMC-BAD-17", "STMC-BAD-03", "STMC-MOT-02")
async def stmc_bad_17_two_motions_back_to_back(dut: Any) -> None:
    """A second motion command directly after the first returns error 1, and its data bytes return error 6
    (STMC-BAD-17).
    """
    env = await Env.start(dut)
    await env.go(0x43, 3)
    got = await env.statuses("c 44 d 01 d 00 d 00 d 00")
    env.check("STMC-BAD-17", "statuses", got, [0x94, *[0xE4] * 4])
    await env.outcome("STMC-BAD-17", 3, 0x83, 0, [20, 20])


@directed("STMC-RD-01", "STMC-CMD-01", "STMC-BAD-11", "STMC-FIN-04", "STMC-REM-02")
async def stmc_rd_01_reads(dut: Any) -> None:
    """Each accepted read of any kind replaces the previous answer, whether it was read or not
    (STMC-RD-01).
    """
    env = await Env.start(dut)
    await env.go(0x44, 1000, 5)
    await env.in_gap(4)
    await env.halt()
    for _ in range(3):
        env.check("STMC-FIN-04", "FIN", await env.finish(), 0xC4)
        env.check("STMC-REM-02", "REM", await env.remaining(), 994)
    await env.host.command(0x83)
    env.check("STMC-RD-01", "status", await env.host.command(0xC0), ERR | OBF)
    env.check("STMC-CMD-01", "answer stays", await env.host.read(DATA), 994 & 0xFF)
    await env.bench.clocks(8)
    env.check("STMC-CMD-01", "answer stays", await env.host.command(0x43), 0x30 | OBF)
    env.check("STMC-CMD-01", "second byte", await env.host.read(DATA), 994 >> 8)
    await env.bench.clocks(8)
    await env.host.write(COMMAND, 0x80)
    status = await env.host.poll(IBF, 0)
    env.check("STMC-RD-01", "status with IBF = 0", status, OBF)
    env.check("STMC-BAD-11", "replaced", await env.host.read(DATA), 0xC4)
    await env.bench.clocks(10)
    env.check("STMC-BAD-11", "nothing more", await env.host.status(), 0)


@directed("STMC-FSM-01", "STMC-FSM-04", "STMC-STP-03")
async def stmc_fsm_04_stops_before_step_0(dut: Any) -> None:
    """In state S of commands 2 to 7, codes 40 and 41 prevent all steps. Exception: in commands 3 and 6, one
    step follows code 41 (STMC-FSM-04).
    """
    env = await Env.start(dut, clock=0)
    for code, n, divisor, number in (
        (0x42, None, None, 2),
        (0x43, 50, None, 3),
        (0x44, 50, 5, 4),
        (0x45, None, 5, 5),
        (0x46, None, None, 6),
        (0x47, None, 5, 7),
    ):
        total = {2: 1, 3: 50, 4: 50}.get(number, 1 << 24)
        for stop in (0x40, 0x41):
            await env.go(code, n, divisor)
            await env.host.command(stop)
            steps = int(stop == 0x41 and number in RAMP_COMMANDS)
            if steps:
                await env.bench.clocks(100)
                await env.ticks(2)
            await env.result("STMC-FSM-04", steps, 0xC0 | number, total - 1 - steps)
