"""ppmc104_carrier: through its UART, one frame initialises the part and another one starts a move."""

from __future__ import annotations

from typing import Any

import cocotb
from cocotb.triggers import ValueChange

from cocotb_tests.harness import PARTS, configs

from .bench import Bench, same
from .settings import FAST

INITIALISE = "55 0A 09 04 04 00"  # RL 9, RH 4, PA 4, four-phase
MOVE = "54 43 0D 00 00"  # 14 pulses CW
# This is the example in docs/uart_bridge.md, byte by byte.
MOVE_LINE = bytes.fromhex("7E 01 54 43 0D 00 00 60 95 7E")
MOVE_ANSWER = bytes.fromhex("7E 01 00 04 BB 28 7E")
FINISH = "51 80 61"


async def start(dut: Any) -> Bench:
    """Start the board with idle pins and release reset."""
    return await Bench.of_carrier(dut, PARTS["ppmc104"].inputs)


def pulses_of(dut: Any) -> list[int]:
    """Return a list to which the level of dir is appended at each falling edge of pout_n."""
    pulses: list[int] = []

    async def run() -> None:
        while True:
            await ValueChange(dut.pout_n)
            if int(dut.pout_n.value) == 0:
                pulses.append(int(dut.dir.value))

    cocotb.start_soon(run())
    return pulses


@cocotb.test()
@configs(FAST)
async def board_initialise_and_move(dut):
    """The examples of the contract, sent to a PPMC-104, cause the expected pulses, event and count
    (UB-OPS-01, UB-OPS-02, UB-MSG-01).
    """
    bench = await start(dut)
    pulses = pulses_of(dut)
    status = await bench.done(INITIALISE)
    same("initialised, no error", (len(status), status[0] & 0x82), (1, 0))
    await bench.done("03 01 09")  # SEQ 2 is new, because the move had SEQ 1
    before = len(bench.line)
    await bench.send(MOVE_LINE)
    await bench.message()
    same("answer on the line", bytes(byte for _, byte in bench.line[before:]), MOVE_ANSWER)
    event = await bench.message(ms=400)
    same("event: int_n is low, hold and switches are high", (event[0], event[1] & 0x01), (0x80, 0))
    same("14 pulses CW", pulses, [0] * 14)
    data = await bench.done(FINISH)
    same("finish status", (len(data), data[1]), (2, 0x83))
    same("int_n is high again, count", await bench.done("06 08"), bytes([event[1] | 1]) + b"\x0e\x00\x00\x00")
    same("remaining pulses: none", (await bench.done("51 83 63"))[1:], b"\x00\x00\x00")


@cocotb.test()
@configs(FAST)
async def board_pins_straps_reset(dut):
    """PINS reports the switches, STRAPS drives csel, RESET resets the part, and errors of the part are
    reported (UB-OPS-02, UB-ANS-02).
    """
    bench = await start(dut)
    same("idle pins", await bench.done("06"), b"\xff")
    for n, pin in enumerate(("l1_n", "l2_n", "l3_n", "l4_n", "cnp_n", "alm_n")):
        getattr(dut, pin).value = 0
        same(pin, await bench.done("06"), bytes([0xFF & ~(4 << n)]))
        getattr(dut, pin).value = 1
    # Before its initialisation, the part rejects the first byte of a move.
    answer = await bench.ask(MOVE)
    same("refused", (answer[:2], answer[2] & 0x80), (b"\x02\x00", 0x80))
    await bench.done(INITIALISE)
    same("accepted", (await bench.done(MOVE))[0] & 0x80, 0)
    await bench.done("05")
    status = await bench.done("21")
    answer = await bench.ask(MOVE)
    same("reset: refused again", (status[0] & 0x80, answer[0]), (0, 2))
    await bench.done("07 00")
    same("straps pull csel and vsel", (int(dut.u_part.csel.value), int(dut.u_part.vsel.value)), (0, 0))
    await bench.done("07 FF")
    same("straps let go", (int(dut.u_part.csel.value), int(dut.u_part.vsel.value)), (1, 1))
