"""Code map, don't-care bits, response to each command in each state (P104-CMD, P104-FSM), and starts of
operations (P104-OPR).
"""

from __future__ import annotations

from cocotb_tests.harness import BUSY, DATA, ERR, directed

from .env import Env
from .expected_timing import INIT_A
from .states import CONSTANT, MOVING, enter
from .tb_acceptance_moves import kind_of

OPERATIONS = (0x42, 0x43, 0x44, 0x45, 0x46, 0x47, 0xC3, 0xC6)
READS = (0x80, 0x81, 0x82, 0x83, 0x85)
UNDEFINED = (0x00, 0x3C, 0x87, 0x88, 0xA0, 0xBF, 0xC4, 0xC5, 0xC7, 0xFF)
PARAMETERS = {0x42: 0, 0x43: 3, 0x44: 4, 0x45: 1, 0x46: 0, 0x47: 1, 0xC3: 3, 0xC6: 0}


@directed("P104-CMD-01", "P104-CMD-03", "P104-OPR-03")
async def p104_cmd_01_all_codes_ready(dut):
    """After initialisation, each of the 256 codes sets NUM to its number of parameters or takes effect
    (P104-CMD-01).
    """
    env = await Env.start(dut, INIT_A)
    expected = {"undefined": 0x80, "stop": 0x80, "init": 0x40, "switching": 0x20, "aux": 0x10, "on": 0x00}
    expected |= {"read": 0x01, "off": 0x00}
    for code in range(256):
        kind = kind_of(code)
        if kind == "operation":
            count = PARAMETERS[code & 0xC7]
            status = count << 4 if count else BUSY
        else:
            status = expected[kind]
        env.check("P104-CMD-01", f"status of {code:#04x}", await env.host.command(code), status)
        if status & BUSY:
            await env.host.command(0x40)
            await env.idle()
        if kind == "read":
            await env.host.run("rrr" if code == 0x83 else "r")
        if kind == "off" and code & 7 == 0:
            await env.init(*INIT_A)


@directed("P104-CMD-04", "P104-CMD-03", "P104-AUX-05", "P104-OPR-12", "P104-RD-01", "P104-INI-04")
async def p104_cmd_04_all_codes_busy(dut):
    """During a move, of all 256 codes, only the commands that BUSY allows are executed (P104-CMD-04)."""
    env = await Env.start(dut, INIT_A)
    await env.go(0x44, 10, rate=255)
    for code in range(256):
        kind = kind_of(code)
        if kind == "stop":
            continue
        status = {"undefined": 0x84, "aux": 0x14, "on": 0x04, "off": 0x04}.get(kind, 0x94)
        env.check("P104-CMD-04", f"status of {code:#04x}", await env.host.command(code), status)
        if kind == "aux":
            env.check("P104-CMD-04", "its data byte", await env.host.data(code), 0x04)
        elif kind in ("on", "off"):
            await env.bench.clocks(2)
            level = 1 if code & 7 == 2 else 0
            env.check("P104-AUX-05", f"aux_n after {code:#04x}", env.bench.level("aux_n"), level)
        elif kind != "undefined":
            env.check("P104-CMD-04", f"data after {code:#04x}", await env.host.data(code), 0xE4)
    await env.result("P104-CMD-04", 10, 0x84, 0)
    env.check_train("P104-CMD-04", [255] * 9)


@directed("P104-CMD-04", "P104-CMD-02", "P104-STP-01", "P104-STP-07")
async def p104_cmd_04_stop_codes_busy(dut):
    """Every code of the two stop commands ends a move; bit I of the move determines INT (P104-CMD-04)."""
    env = await Env.start(dut, INIT_A)
    for code in (c for c in range(0x40, 0x80) if c & 7 < 2):
        masked = bool(code & 0x20)
        await env.go(0x54 if masked else 0x44, 10, rate=9)
        await env.pulse(2, 100)
        env.check("P104-CMD-04", f"ERR of {code:#04x}", await env.host.command(code) & ERR, 0)
        await env.idle()
        env.check("P104-STP-07", f"int_n after {code:#04x}", env.bench.level("int_n"), int(masked))
        await env.result("P104-STP-01", 2, 0xC4, 7)


@directed("P104-CMD-02", "P104-OPR-01", "P104-PHS-07")
async def p104_cmd_02_bits_of_operations(dut):
    """For every operation and all values of X, I and D, dir is D, INT is NOT I, and X is ignored
    (P104-CMD-02).
    """
    env = await Env.start(dut, INIT_A)
    for base in OPERATIONS:
        for bits in range(8):
            code = base | bits << 3
            since = env.bench.now
            count = PARAMETERS[base]
            data = {0: [], 1: [3], 3: [2, 0, 0], 4: [3, 2, 0, 0]}[count]
            status = await env.host.send(code, data)
            env.check("P104-OPR-01", f"status after {code:#04x}", status, BUSY)
            await env.bench.clocks(2)
            env.check("P104-CMD-02", f"dir of {code:#04x}", env.bench.level("dir"), bits & 1)
            env.check("P104-OPR-01", f"hold of {code:#04x}", env.bench.level("hold"), 0)
            await env.bench.nth_fall(1, since)
            if base in (0x45, 0x46, 0x47, 0xC6):
                await env.host.command(0x40)
            await env.idle()
            env.check("P104-CMD-02", f"int_n of {code:#04x}", env.bench.level("int_n"), bits >> 1 & 1)
            env.check("P104-RD-03", f"op bits of {code:#04x}", await env.finish() & 0x87, 0x80 | base & 7)


@directed("P104-CMD-02", "P104-CMD-03", "P104-AUX-04")
async def p104_cmd_02_bits_of_others(dut):
    """Bits 5..3 of the AUX and Excitation OFF codes are ignored (P104-CMD-02)."""
    env = await Env.start(dut, INIT_A)
    for bits in range(8):
        for low, level in ((1, 0), (2, 1)):
            await env.host.command(0xC0 | bits << 3 | low)
            await env.bench.clocks(2)
            env.check("P104-CMD-02", f"aux_n, bits {bits}", env.bench.level("aux_n"), level)
        env.check(
            "P104-CMD-02", f"Excitation OFF, bits {bits}", await env.host.command(0xC0 | bits << 3), 0x00
        )
        await env.bench.clocks(2)
        env.check("P104-AUX-04", "s", env.bench.level("s"), 0)
        env.check("P104-AUX-04", "0x42 afterwards", await env.host.command(0x42), 0xA0)
        await env.init(*INIT_A)


async def reactions(env: Env, state: str) -> dict[str, int]:
    """Return the status that each command class, except stops, must set in `state` (P104-FSM-01)."""
    moving = state in MOVING
    busy = BUSY if moving else 0
    table = {f"{code:02X}": 0x80 | busy for code in UNDEFINED}
    table |= {"0A": 0x94 if moving else 0x40, "84": 0x94 if moving else 0x20, "86": 0x10 | busy}
    table |= {f"{code:02X}": 0x94 if moving else 0x01 for code in READS}
    table |= {"C0": busy, "C1": busy, "C2": busy}
    for code in OPERATIONS:
        start = PARAMETERS[code] << 4 or BUSY
        table[f"{code:02X}"] = 0x94 if moving else (start if state == "READY" else 0xA0)
    return table


@directed("P104-FSM-01", "P104-CMD-04", "P104-BAD-12", "P104-BAD-21", "P104-BAD-02")
async def p104_fsm_01_table(dut):
    """In each state, the response to each command class and to unexpected data is that of the table
    (P104-FSM-01).
    """
    env = await Env.start(dut, None)
    for state in ("UNINIT", "READY", *MOVING):
        for text, status in (await reactions(env, state)).items():
            await enter(env, state)
            code = int(text, 16)
            env.check("P104-FSM-01", f"{text} in {state}", await env.host.command(code), status)
            if code == 0x86:
                await env.host.data(0x0F)
                await env.bench.clocks(2)
                env.check("P104-FSM-01", f"auxo in {state}", env.bench.level("auxo"), 0)
            elif code in (0xC0, 0xC1):
                await env.bench.clocks(2)
                on = code == 0xC1 or state in MOVING
                env.check("P104-BAD-21", f"aux_n after {text} in {state}", env.bench.level("aux_n"), 1 - on)
        await enter(env, state)
        stray = 0xE4 if state in MOVING else 0xB0
        env.check("P104-FSM-01", f"stray data in {state}", await env.host.data(0x42), stray)


@directed("P104-FSM-01", "P104-STP-01", "P104-STP-02", "P104-STP-06", "P104-STP-08", "P104-STP-03")
async def p104_fsm_01_stops(dut):
    """In each state, a stop command ends the motion, sets the deceleration flag, returns an error or has no
    effect, as the table of chapter 7 states (P104-FSM-01).
    """
    env = await Env.start(dut, None)
    for state in ("UNINIT", "READY"):
        for code in (0x40, 0x41):
            await enter(env, state)
            env.check("P104-STP-02", f"{code:#x} in {state}", await env.host.command(code), 0x80)
            env.check("P104-STP-02", "hold", env.bench.level("hold"), 1)
    for state in MOVING:
        await enter(env, state)
        status = await env.host.command(0x40)
        env.check("P104-FSM-01", f"ERR of 0x40 in {state}", status & ERR, 0)
        if state.startswith("FIN"):
            env.check("P104-STP-08", f"0x40 in {state}: still BUSY", status, BUSY)
            await env.result("P104-STP-08", 1, 0x84 if state in CONSTANT else 0x83, 0)
        else:
            await env.idle()
            env.check("P104-STP-01", f"finish bits 7, 6 in {state}", await env.finish() & 0xF8, 0xC0)
    for state in MOVING:
        await enter(env, state)
        status = await env.host.command(0x41)
        if state in ("DEC", "DEC natural", "FIN ramp"):
            env.check("P104-STP-04", f"0x41 in {state}", status, 0xF4)
        elif state == "FIN constant":
            env.check("P104-STP-08", f"0x41 in {state}", status, BUSY)
            await env.result("P104-STP-08", 1, 0x84, 0)
        elif state in CONSTANT:
            env.check("P104-STP-05", f"ERR of 0x41 in {state}", status & ERR, 0)
            await env.idle()
            env.check("P104-STP-05", f"finish status in {state}", await env.finish(), 0xC4)
        else:
            env.check("P104-STP-03", f"0x41 in {state}", status, BUSY)
            env.check("P104-STP-04", f"second 0x41 in {state}", await env.host.command(0x41), 0xF4)


@directed("P104-FSM-01", "P104-OPR-12", "P104-BAD-12", "P104-CMD-04")
async def p104_fsm_01_parameters_of_refused_operations(dut):
    """During a move, a second operation returns error 1, each of its parameters returns error 6, and the move
    is not affected (P104-FSM-01).
    """
    env = await Env.start(dut, INIT_A)
    await env.go(0x44, 8, rate=99)
    await env.pulse(1)
    got = await env.statuses("c 43 d 01 d 00 d 00 c 4C d 09 d 01 d 00 d 00 c 0A d 01 c C6")
    env.check("P104-BAD-12", "statuses", got, [0x94, *[0xE4] * 3, 0x94, *[0xE4] * 4, 0x94, 0xE4, 0x94])
    await env.result("P104-OPR-12", 8, 0x84, 0)
    env.check_train("P104-OPR-12", [99] * 7)


@directed("P104-FSM-03", "P104-AUX-02")
async def p104_fsm_03_parameter_across_the_end(dut):
    """If command 0x86 is accepted during a move, a data byte that is sent after the end of the move is still
    its parameter (P104-FSM-03).
    """
    env = await Env.start(dut, INIT_A)
    await env.go(0x44, 2, rate=99)
    env.check("P104-FSM-03", "status of 0x86", await env.host.command(0x86), 0x14)
    await env.idle()
    env.check("P104-FSM-03", "NUM after the end", await env.host.status(), 0x10)
    env.check("P104-FSM-03", "status of the data", await env.host.data(0x0C), 0x00)
    await env.bench.clocks(2)
    env.check("P104-FSM-03", "auxo", env.bench.level("auxo"), 0x3)
    env.check("P104-FSM-03", "one byte only", await env.status_after(0x00, DATA), 0xB0)
