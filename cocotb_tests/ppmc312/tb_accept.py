"""Acceptance table of the PPMC-312 at its pins: every instruction in every state (P312-STA-01)."""

from __future__ import annotations

from typing import Any

import cocotb

from cocotb_tests.harness import directed
from cocotb_tests.ppmc312.blocks import T1, TF
from cocotb_tests.ppmc312.host import Host
from cocotb_tests.ppmc312.messages import message
from openppmc.model.ppmc312.codes import Answer, Code

# A row contains a block and one letter for each of the states INI, NOR, ACC, FIX, ABN and WRN: O = accepted,
# . = rejected. Blocks with flags 05 have OV = 1.
ROWS = [
    (T1, "OO...."),
    ("02 03 01 01 03", "OO...."),
    (message(Code.IN_POSITION, "00 0001"), "OO...."),
    (message(Code.ENCODE, "00 0001"), "OO...."),
    (message(Code.INTERLOCK_POSITION, "00000001"), "OO...."),
    (message(Code.SPEED_LIMIT, "0100"), ".O...."),
    (message(Code.END_TERMINAL, "00"), "OO...."),
    (message(Code.STOP, "00"), "..OO.."),
    (message(Code.STOP, "05"), ".OOO.."),
    (message(Code.SLOW_STOP, "00"), "..OO.."),
    (message(Code.SLOW_STOP, "05"), ".OOO.."),
    (message(Code.RAMP, "00 0000 00000001"), ".O...."),
    (message(Code.RAMP, "05 0000 00000001"), ".OOO.."),
    (message(Code.CONSTANT, "00 0000 00000001"), ".O...."),
    (message(Code.CONSTANT, "05 0000 00000001"), ".OOO.."),
    (message(Code.STEP, "00"), ".O...."),
    (message(Code.FOREVER_RAMP, "00 0000"), ".O...."),
    (message(Code.FOREVER_RAMP, "05 0000"), ".OOO.."),
    (message(Code.FOREVER_CONSTANT, "00 0000"), ".O...."),
    (message(Code.FOREVER_CONSTANT, "05 0000"), ".OOO.."),
    (message(Code.RAMP_CHANGE, "00 0100"), "...O.."),
    (message(Code.RAMP_CHANGE, "05 0100"), ".OOO.."),
    (message(Code.CHANGE, "00 0100"), "..OO.."),
    (message(Code.CHANGE, "05 0100"), ".OOO.."),
    (message(Code.ORIGIN_SEARCH, "00 0100"), ".O...."),
    (message(Code.ZERO_RETURN, "00 0100"), ".O...."),
    (message(Code.EXCITATION_ON), "OO...."),
    (message(Code.EXCITATION_OFF), "OO...."),
    (message(Code.COUNTER_CLEAR), "OO...."),
    (message(Code.ZERO_CLAMP), "OO...."),
    (message(Code.ALARM_CLEAR), "OO..OO"),
    (message(Code.INPUT), "OOOOOO"),
    (message(Code.OUTPUT, "00"), "OOOOOO"),
    (message(Code.TERMINALS), "OOOOOO"),
    (message(Code.MASK, "00 00"), "OO...."),
    (message(Code.VERSION), "OOOOOO"),
    (message(Code.TABLE_READ), ".O...."),
    (message(Code.POSITION_READ, "00"), "OOOOOO"),
    (message(Code.POSITION_SET, "00 00000000"), "OO...."),
    (message(Code.INTERLOCK), ".O...."),
    (message(Code.RUN_MONITOR), ".O...O"),
    (message(Code.EVENT_READ), ".O...."),
    (message(Code.EVENT_SET, "02"), ".O...."),
    (message(Code.STATUS), "OOOOOO"),
    (message(Code.RESET), "OOOOOO"),
]
CONDITIONS = (0x01, 0x02, 0x04, 0x08, 0x10, 0x20)


async def in_state(dut: Any, condition: int) -> Host:
    """Return a host whose part is in this state."""
    host = await Host.start(dut, *(TF if condition != 0x01 else ()))
    if condition == 0x04:
        await host.ask(message(Code.RAMP, "00 0000 00001388"))
    elif condition == 0x08:
        await host.ask(message(Code.FOREVER_CONSTANT, "00 0190"))
    elif condition == 0x10:
        await host.pins(alm_n=0)
        await host.response()
        await host.pins(alm_n=1)
    elif condition == 0x20:
        await host.pins(run=0)
        await host.ask(message(Code.STEP, "00"))
    assert host.condition == condition
    return host


@cocotb.parametrize(case=ROWS)
@directed("P312-STA-01", "P312-STA-03")
async def p312_accept_table(dut: Any, case: Any) -> None:
    block, row = case
    for condition, letter in zip(CONDITIONS, row, strict=True):
        answer = await (await in_state(dut, condition)).ask(block)
        if letter == ".":
            assert answer == message(Answer.STATUS, f"00 {condition:02X}"), hex(condition)
        else:
            assert answer.split()[2] in (block.split()[2], "E8"), (hex(condition), answer)


@directed("P312-STA-01", "P312-BLK-01")
async def p312_a_code_that_is_none(dut: Any) -> None:
    """The code is checked before the state: in every state, the answer to an undefined code reports that
    code.
    """
    for condition in CONDITIONS:
        host = await in_state(dut, condition)
        for code in ("07", "48", "FE"):
            assert await host.ask(message(int(code, 16))) == message(Answer.COMMAND, code), hex(condition)
