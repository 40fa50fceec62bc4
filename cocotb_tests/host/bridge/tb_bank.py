"""ppmc_bank_carrier: its UART gives access to one axis of a bank at a time (docs/bank/carrier.md)."""

from __future__ import annotations

from typing import Any

import cocotb

from cocotb_tests.harness import configs

from .bench import Bench, same
from .settings import BANK

AXES = dict(BANK.extra)["AXES"]
SWITCHES = ("l1_n", "l2_n", "l3_n", "l4_n", "cnp_n", "alm_n")
ALL = (1 << AXES) - 1
INITIALISE = "55 0A 09 04 04 00"  # RL 9, RH 4, PA 4, four-phase
POSITION = "24 25 26 27"
FINISH = "51 80 61"


def chosen(axis: int) -> str:
    """Return the op that selects an axis."""
    return f"13 {axis:02X} "


async def start(dut: Any) -> Bench:
    """Start the board with idle pins, release reset, and wait until the bank is ready."""
    idle = {**dict.fromkeys(SWITCHES, ALL), "spi_cs_n": 1, "sck": 0, "mosi": 0}
    return await Bench.of_carrier(dut, idle, AXES + 40)


@cocotb.test()
@configs(BANK)
async def bank_registers_of_an_axis(dut):
    """After an axis is chosen, IDENT, INFO, CONFIG and MASK are at the addresses in docs/bank/carrier.md."""
    bench = await start(dut)
    ident = await bench.done("01")
    same("part number, no counter", (ident[5] | ident[6] << 8, ident[7] & 0x0E), (32, 0))
    same("axis after reset", await bench.done("23"), b"\x00")
    info = await bench.done("".join(chosen(k) + "2C" for k in range(3)))
    same("INFO", info, bytes([0x42, 1, AXES]))
    for axis in range(AXES):
        await bench.done(chosen(axis) + f"12 {axis & 3:02X}")
    for axis in reversed(range(AXES)):
        same(f"CONFIG of {axis}", await bench.done(chosen(axis) + "22 23"), bytes([axis & 3, axis]))
    await bench.done(chosen(0) + "18 05")
    same("MASK is the same at the axis with the same index", await bench.done("28"), b"\x05")
    for axis in (AXES, 63, 64, 255):
        seen = await bench.done(chosen(axis) + "12 00 21 22 23")
        same(f"axis {axis} is not there", seen, bytes([255, 255, axis]))
    await bench.done("05")
    same("RESET: axis 0, CONFIG", await bench.done("23 22"), b"\x00\x03")


@cocotb.test()
@configs(BANK)
async def bank_moves(dut):
    """If two axes move one after the other, events, map, finish status and position are those of the axis
    that has moved.
    """
    bench = await start(dut)
    await bench.done("03 01")
    for axis, code, count in ((2, "43", 14), (1, "4B", -14)):
        status = await bench.done(chosen(axis) + INITIALISE)
        same("initialised, no error", (len(status), status[0] & 0x82), (1, 0))
        same("started", await bench.done(f"54 {code} 0D 00 00"), b"\x04")
        event = await bench.message(ms=400)
        same("event: int_n is low", (event[0], event[1] & 1), (0x80, 0))
        same("map", await bench.done(chosen(0) + "29"), bytes([1 << axis]))
        same("finish status", (await bench.done(chosen(axis) + FINISH))[1:], b"\x83")
        same("map is empty", await bench.done(chosen(0) + "29"), b"\x00")
        data = await bench.done(chosen(axis) + POSITION)
        same("position", int.from_bytes(data, "little", signed=True), count)
    same("the others", await bench.done(chosen(0) + POSITION + chosen(3) + POSITION), bytes(8))


@cocotb.test()
@configs(BANK)
async def bank_pins(dut):
    """PINS reports a switch of an axis only while this axis is chosen. The LED is lit while a limit or an
    alarm is active.
    """
    bench = await start(dut)
    for axis in range(AXES):
        for n, pin in enumerate(SWITCHES):
            getattr(dut, pin).value = ALL & ~(1 << axis)
            seen = await bench.done(chosen(axis) + "06" + chosen(axis ^ 1) + "06")
            same(f"{pin}[{axis}]", seen, bytes([0xFF & ~(4 << n), 0xFF]))
            same("LED", int(dut.led_switch.value), int(pin != "cnp_n"))
            getattr(dut, pin).value = ALL
    same("nothing moves", int(dut.led_moving.value), 0)
