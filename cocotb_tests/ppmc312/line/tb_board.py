"""A board with a PPMC-312 on its serial line: straps, both lines, DE, LEDs, button, pulses."""

from __future__ import annotations

from typing import Any

import cocotb
from cocotb.clock import Clock
from cocotb.triggers import FallingEdge, RisingEdge, Timer, with_timeout
from cocotb.utils import get_sim_time

from cocotb_tests.harness import same
from cocotb_tests.harness.line import UartBfm
from cocotb_tests.ppmc312.serial_frames import SPEEDS, summed
from openppmc.model.ppmc312.front.serial import INSTRUCTION, POLL

OPEN = {"mod": 7, "adr": 15}
INPUTS = {"btn_n": 1, "uart_rxd": 1, "rs485_rxd": 1, "fl_n": 1, "alm_n": 1, "auxi": 0xA5} | OPEN
LINK, MOVING, SWITCH, RUNNING = range(4)  # indices of the LEDs


class Master(UartBfm):
    """Master on one of the two lines."""

    def __init__(self, rxd: Any, txd: Any, de: Any) -> None:
        super().__init__(rxd, txd, 1.0)
        self._de = de
        self.bytes = bytearray()

    def on_char(self, byte: int) -> None:
        """Collect a byte of a reply; DE must be asserted."""
        same("DE", int(self._de.value), 1)
        self.bytes.append(byte)

    async def ask(self, station: int, text: str = "") -> str:
        """Send an instruction, or a poll if `text` is empty; wait until the line is free.

        Returns:
            Kind and station of the reply, then its data.
        """
        data = bytes.fromhex(text)
        self.bytes.clear()
        await self.send(summed((INSTRUCTION if data else POLL) | station, data))
        await with_timeout(RisingEdge(self._de), 10, "ms")
        await with_timeout(FallingEdge(self._de), 10, "ms")
        control, text = self.bytes[0], self.bytes[1:-1].decode("ascii")
        same("frame", bytes(self.bytes), summed(control, bytes.fromhex(text)))
        return f"{control:02X} {text}".strip()


class Board:
    """The board with its straps after reset, and a master on each line."""

    def __init__(self, dut: Any, **straps: int) -> None:
        self.dut = dut
        for name, level in (INPUTS | straps).items():
            getattr(dut, name).value = level
        Clock(dut.clk, 125, "ns").start()
        self.usb = Master(dut.uart_rxd, dut.uart_txd, dut.rs485_de)
        self.rs485 = Master(dut.rs485_rxd, dut.rs485_txd, dut.rs485_de)
        self.speed(7)

    def speed(self, mod: int) -> None:
        """Set both masters to the speed that these straps select."""
        self.usb.rate = self.rs485.rate = float(SPEEDS[mod])

    def led(self, which: int) -> int:
        """Return the state of an LED, 1 = on."""
        return int(self.dut.leds.value) >> which & 1

    async def boot(self) -> None:
        """Wait until the LED "running" is on."""
        while not self.led(RUNNING):
            await Timer(50, "us")
        await Timer(50, "us")


async def start(dut: Any, **straps: int) -> Board:
    """Power on the board; record both lines from then on."""
    board = Board(dut, **straps)
    await board.boot()
    for master in (board.usb, board.rs485):
        master.listen()
    return board


@cocotb.test()
async def board312_serial_open_straps(dut: Any) -> None:
    """Open straps select 83 333 baud and station 15.

    The station answers either master on both lines, and DE is asserted for the length of the answer.
    """
    board = await start(dut)
    same("LED before", board.led(LINK), 0)
    for master, other in ((board.usb, board.rs485), (board.rs485, board.usb)):
        other.bytes.clear()
        same("DE", int(dut.rs485_de.value), 0)
        same("inputs", await master.ask(15, "25"), "AF a5")
        same("the other line", bytes(other.bytes), bytes(master.bytes))
        same("LED", board.led(LINK), 1)
        same("ready", await master.ask(15), "9F")
    same("DE", int(dut.rs485_de.value), 0)
    same("bus", int(dut.d_oe.value), 0)


@cocotb.test()
async def board312_serial_half_a_bit(dut: Any) -> None:
    """DE is asserted half a bit after the master's stop bit, and the start bit of the reply follows one bit
    after DE; each is at most 1 us late.
    """
    board = await start(dut)
    bit = 1e6 / board.rs485.rate
    for master in (board.usb, board.rs485):
        await master.send(summed(POLL | 15))
        end = get_sim_time("us")
        await with_timeout(RisingEdge(dut.rs485_de), 1, "ms")
        late = get_sim_time("us") - end - bit / 2
        assert 0 <= late <= 1, f"DE comes {late} us after half a bit"
        await with_timeout(FallingEdge(dut.rs485_txd), 1, "ms")
        late = get_sim_time("us") - end - 1.5 * bit
        assert 0 <= late <= 1, f"the start bit comes {late} us after one and a half"
        await with_timeout(FallingEdge(dut.rs485_de), 1, "ms")
        await Timer(50, "us")


@cocotb.test()
async def board312_serial_straps_and_button(dut: Any) -> None:
    """The straps are sampled at the end of a reset, including a reset by the button.

    This reset stops all motions and clears all state.
    """
    board = await start(dut, adr=3, mod=6)
    rs485 = board.rs485
    board.speed(6)
    same("output", await rs485.ask(3, "26 15"), "93")
    same("auxo_n", int(dut.auxo_n.value), 0x2A)
    dut.adr.value, dut.mod.value = 10, 5
    same("still station 3", await rs485.ask(3), "93")
    dut.btn_n.value = 0
    await Timer(10, "us")
    same("running", board.led(RUNNING), 0)
    same("auxo_n", int(dut.auxo_n.value), 0x3F)
    dut.btn_n.value = 1
    await Timer(100, "us")
    await board.boot()
    board.speed(5)
    same("station 10", await rs485.ask(10), "9A")


@cocotb.test()
async def board312_serial_motion_and_leds(dut: Any) -> None:
    """A move commanded through USB makes its pulses and is polled through RS-485; limit and alarm light an
    LED.
    """
    board = await start(dut)
    usb, pulses = board.usb, []

    async def count() -> None:
        while True:
            await RisingEdge(dut.pout)
            pulses.append(board.led(MOVING))

    cocotb.start_soon(count())
    same("table", await usb.ask(15, "00 00 0140 00A0 000360"), "9F")
    same("LED", board.led(MOVING), 0)
    same("move", await usb.ask(15, "A4 0140 0000001E"), "9F")
    same("direction", int(dut.dir.value), 1)
    said = await board.rs485.ask(15)
    while said == "8F":
        said = await board.rs485.ask(15)
    same("END code", said, "AF 38")
    same("pulses", len(pulses), 30)
    same("LED", (sum(pulses[1:]), board.led(MOVING)), (29, 1))
    same("position", await board.rs485.ask(15, "42"), "AF ffffffe2")
    for name in ("fl_n", "alm_n"):
        same("LED", board.led(SWITCH), 0)
        getattr(dut, name).value = 0
        await Timer(10, "us")
        same(f"LED of {name}", board.led(SWITCH), 1)
        getattr(dut, name).value = 1
        await Timer(10, "us")
    same("alarm", await board.rs485.ask(15), "BF 46")
