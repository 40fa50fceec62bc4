"""Status register, byte rules and the accept/reject table: STMC-ST, STMC-CMD, STMC-FSM, STMC-BAD-01..08."""

from __future__ import annotations

from typing import Any

from cocotb_tests.harness import BUSY, COMMAND, DATA, ERR, F16, IBF, OBF, directed

from .env import Lab
from .expected_timing import SHEET, STANDARD
from .states import MOVING, RESTING, enter, leave

READS = {"SHEET": (0x80, 0x82, 0x83, 0x84), "FAMILY": (0x80, 0x81, 0x82, 0x83)}
RAMP_COMMANDS = (3, 6)


def kind_of(code: int, reads: tuple[int, ...]) -> str:
    """Return the kind of a command byte; it follows from the table of all codes alone."""
    if code < 0x40:
        return "init" if code & 3 else "undefined"
    if code < 0x80:
        return ("stop", "slow", "single", "ramp", "steady", "limit", "ramp0", "search")[code & 7]
    return "read" if code in reads else "undefined"


def expected(kind: str) -> int:
    """Return the CODE field of an accepted code: the number of data bytes that follow."""
    return {"init": 0x40, "ramp": 0x30, "steady": 0x40, "limit": 0x10, "search": 0x10}.get(kind, 0x00)


def verdict(kind: str, state: str) -> int:
    """Return the status of a code in a state without BUSY, from the accept/reject table."""
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
    lab = await Lab.start(dut, None, clock=0)
    reads = READS["SHEET" if lab.sheet else "FAMILY"]
    count = 0
    for code in range(256):
        kind = kind_of(code, reads)
        count += kind == "undefined"
        got = await lab.host.command(code)
        lab.check("STMC-BAD-01", f"status after {code:#04x}", got & ~OBF, verdict(kind, "U") & ~OBF)
        if kind == "read":
            while await lab.host.status() & OBF:
                await lab.host.read(DATA)
                await lab.bench.clocks(8)
    lab.check("STMC-BAD-01", "number of undefined codes", count, 16 + 124)


@directed("STMC-FSM-01", "STMC-FSM-02", "STMC-CMD-01", "STMC-STP-04", "STMC-ST-03")
async def stmc_fsm_01_accept_table(dut: Any) -> None:
    """In each state, each kind of byte sets the status of the accept/reject table (STMC-FSM-01)."""
    lab = await Lab.start(dut, None, clock=0)
    for state in (*RESTING, *MOVING):
        for code in SAMPLE:
            kind = kind_of(code, READS["FAMILY"])
            ends = state in MOVING and kind in ("stop", "slow")
            await enter(lab, state)
            got = await lab.host.command(code)
            moving = BUSY if state in MOVING else 0
            wanted = verdict(kind, state)
            if ends or (not moving and kind in ("single", "ramp0")):
                lab.check("STMC-FSM-01", f"{code:#04x} in {state}", got & ~BUSY, wanted)
            else:
                lab.check("STMC-FSM-01", f"{code:#04x} in {state}", got, wanted | moving)


@directed("STMC-CMD-03", "STMC-BAD-02", "STMC-BAD-03", "STMC-ST-03")
async def stmc_cmd_03_data_bytes(dut: Any) -> None:
    """In each state, a data byte is accepted or sets error 3 or 6, and has no other effect
    (STMC-CMD-03).
    """
    lab = await Lab.start(dut, None, clock=0)
    for state in (*RESTING, *MOVING):
        await enter(lab, state)
        since = lab.bench.now
        got = await lab.host.data(0x03)
        if state == "S single":
            lab.check("STMC-CMD-03", f"data byte in {state}", got & ~BUSY, 0xE0)
            continue
        wanted = 0xE0 | BUSY if state in MOVING else {"W from U": 0x30, "W from I": 0x20}.get(state, 0xB0)
        lab.check("STMC-CMD-03", f"data byte in {state}", got, wanted)
        lab.quiet("STMC-CMD-03", since)
        await leave(lab)


@directed("STMC-ST-02", "STMC-ST-03", "STMC-ST-04", "STMC-CMD-01", "STMC-CMD-02")
async def stmc_st_03_error_field(dut: Any) -> None:
    """After an error, only an accepted command clears ERR; rejected and accepted data bytes do not
    (STMC-ST-03).
    """
    lab = await Lab.start(dut)
    got = await lab.statuses("c C0 d 00")
    lab.check("STMC-ST-03", "statuses", got, [0x80, 0xB0])
    lab.since = lab.bench.now
    await lab.go(0x44, 2, 20)
    got = await lab.statuses("d 01 c C0 c 80")
    lab.check("STMC-ST-03", "statuses while busy", got, [0xE4, 0x84, 0x94])
    await lab.idle()
    lab.check("STMC-ST-04", "status after the end", await lab.host.status(), 0x90)
    await lab.bench.clocks(300)
    got = await lab.statuses("c 43 d 05 c C1 d 00 c 44 d 00 d 00 d 00 d 00 d 01 c 40")
    wanted = [0x30, 0x20, 0x80, 0xB0, 0x40, 0x30, 0x20, 0x10, 0xD0, 0xB0, 0x80]
    lab.check("STMC-ST-03", "statuses at rest", got, wanted)
    lab.check("STMC-ST-02", "80 clears ERR", await lab.host.command(0x80), OBF)


@directed("STMC-CMD-02", "STMC-BAD-04", "STMC-FSM-03")
async def stmc_cmd_02_unfinished_commands(dut: Any) -> None:
    """Incomplete commands have no effect, however long they wait and whichever code follows
    (STMC-CMD-02).
    """
    lab = await Lab.start(dut)
    since = lab.bench.now
    for script in ("c 43 d 05 d 00", "c 44 d 07 d 01 d 00", "c 0A d 05 d 05 d 00", "c 45", "c 08", "c 47"):
        await lab.statuses(script)
        await lab.bench.clocks(300)
        lab.quiet("STMC-CMD-02", since)
    await lab.host.command(0x80)
    lab.check("STMC-CMD-02", "FIN", await lab.host.read_data(), 0x80)
    await lab.go(0x43, 3)
    await lab.outcome("STMC-CMD-02", 3, 0x83, 0, [20, 20])


@directed("STMC-ST-01", "STMC-BAD-08")
async def stmc_bad_08_motion_before_the_initialisation(dut: Any) -> None:
    """Before initialisation, motions return error 2, and each of their data bytes returns error 3
    (STMC-BAD-08).
    """
    lab = await Lab.start(dut, None)
    lab.check("STMC-ST-01", "status", await lab.host.status(), 0x00)
    for code, count in ((0x42, 0), (0x43, 3), (0x44, 4), (0x45, 1), (0x46, 0), (0x4F, 1)):
        got = [await lab.status_after(code)] + [await lab.status_after(5, DATA) for _ in range(count)]
        lab.check("STMC-BAD-08", f"statuses of {code:#x}", got, [0xA0, *[0xB0] * count])
    lab.quiet("STMC-BAD-08", 0)
    await lab.init(*STANDARD)
    lab.check("STMC-BAD-08", "registers", await lab.host.run("c 80 r c 83 rrr"), [0x80, 0, 0, 0])


@directed("STMC-BAD-17", "STMC-BAD-03", "STMC-MOT-02")
async def stmc_bad_17_two_motions_back_to_back(dut: Any) -> None:
    """A second motion directly after the first returns error 1, and its data bytes return error 6
    (STMC-BAD-17).
    """
    lab = await Lab.start(dut)
    await lab.go(0x43, 3)
    got = await lab.statuses("c 44 d 01 d 00 d 00 d 00")
    lab.check("STMC-BAD-17", "statuses", got, [0x94, *[0xE4] * 4])
    await lab.outcome("STMC-BAD-17", 3, 0x83, 0, [20, 20])


@directed("STMC-RD-01", "STMC-CMD-01", "STMC-BAD-11", "STMC-FIN-04", "STMC-REM-02")
async def stmc_rd_01_reads(dut: Any) -> None:
    """Each accepted read of any kind replaces the previous answer, read or unread (STMC-RD-01)."""
    lab = await Lab.start(dut)
    await lab.go(0x44, 1000, 5)
    await lab.in_gap(4)
    await lab.halt()
    for _ in range(3):
        lab.check("STMC-FIN-04", "FIN", await lab.finish(), 0xC4)
        lab.check("STMC-REM-02", "REM", await lab.remaining(), 994)
    await lab.host.command(0x83)
    lab.check("STMC-RD-01", "status", await lab.host.command(0xC0), ERR | OBF)
    lab.check("STMC-CMD-01", "answer stays", await lab.host.read(DATA), 994 & 0xFF)
    await lab.bench.clocks(8)
    lab.check("STMC-CMD-01", "answer stays", await lab.host.command(0x43), 0x30 | OBF)
    lab.check("STMC-CMD-01", "second byte", await lab.host.read(DATA), 994 >> 8)
    await lab.bench.clocks(8)
    await lab.host.write(COMMAND, 0x80)
    status = await lab.host.poll(IBF, 0)
    lab.check("STMC-RD-01", "status with IBF = 0", status, OBF)
    lab.check("STMC-BAD-11", "replaced", await lab.host.read(DATA), 0xC4)
    await lab.bench.clocks(10)
    lab.check("STMC-BAD-11", "nothing more", await lab.host.status(), 0)


@directed("STMC-FSM-01", "STMC-FSM-04", "STMC-STP-03")
async def stmc_fsm_04_stops_before_step_0(dut: Any) -> None:
    """In state S of commands 2..7, 40 or 41 prevents all steps, except that 41 leaves one step in
    commands 3 and 6 (STMC-FSM-04).
    """
    lab = await Lab.start(dut, clock=0)
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
            await lab.go(code, n, divisor)
            await lab.host.command(stop)
            steps = int(stop == 0x41 and number in RAMP_COMMANDS)
            if steps:
                await lab.bench.clocks(100)
                await lab.ticks(2)
            await lab.result("STMC-FSM-04", steps, 0xC0 | number, total - 1 - steps)
