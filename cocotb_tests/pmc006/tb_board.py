"""A board with a PMC006B4: both lines, strobes of the converter, LEDs, button, content of the EEPROM."""

from __future__ import annotations

from typing import Any

import cocotb
from cocotb.clock import Clock
from cocotb.triggers import ClockCycles, Event, FallingEdge, RisingEdge, Timer, with_timeout
from cocotb.utils import get_sim_time

from cocotb_tests.harness import same
from cocotb_tests.harness.line import UartBfm
from cocotb_tests.pmc006.frames import command, of_reply

BAUD, ADDRESS = 115_200, 255
ACCEPTED = 3  # reply to an accepted instruction s
INPUTS = {"btn_n": 1, "uart_rxd": 1, "rs485_rxd": 1, "cmp": 0, "ext1": 1, "ext2": 1, "gpi": 31}
INPUTS |= {"conv": 0, "adc_stb": 0, "bemf_stb": 0}
LINE, MOVING, SWITCH, RUNNING = range(4)  # indices of the LEDs


class Host(UartBfm):
    """The PC on one of the two lines of the board."""

    def __init__(self, rxd: Any, txd: Any, de: Any) -> None:
        super().__init__(rxd, txd, BAUD)
        self._de = de
        self.bytes = bytearray()
        self._whole = Event()

    def on_char(self, byte: int) -> None:
        """Collect a byte of a reply; DE must be asserted."""
        same("DE", int(self._de.value), 1)
        self.bytes.append(byte)
        if len(self.bytes) == 8:
            self._whole.set()

    async def ask(self, code: str, data: int = 0) -> int:
        """Send a frame; wait for its reply on this line and until the line is free; return the data."""
        self.bytes.clear()
        self._whole.clear()
        await self.send(command(ADDRESS, code, data))
        await with_timeout(self._whole.wait(), 10, "ms")
        await self._time(1)  # the byte was received in the middle of its stop bit
        address, value = of_reply(bytes(self.bytes))
        same("address", address, ADDRESS)
        return value


class Board:
    """The board after power-on, with a PC on each line."""

    def __init__(self, dut: Any) -> None:
        self.dut = dut
        for name, level in INPUTS.items():
            getattr(dut, name).value = level
        Clock(dut.clk, 125, "ns").start()
        self.usb = Host(dut.uart_rxd, dut.uart_txd, dut.rs485_de)
        self.rs485 = Host(dut.rs485_rxd, dut.rs485_txd, dut.rs485_de)

    def led(self, which: int) -> int:
        """Return the state of an LED, 1 = on."""
        return int(self.dut.lamps.value) >> which & 1

    async def boot(self) -> None:
        """Wait until the bridges are on, which is the end of the boot; the LED "running" is lit then."""
        await with_timeout(RisingEdge(self.dut.bridge_a_en), 60, "ms")
        same("running", self.led(RUNNING), 1)

    async def strobe(self, name: str, level: int) -> None:
        """Make one conversion of minimum length on the bus of the converter, then apply another level."""
        pin = getattr(self.dut, name)
        self.dut.conv.value, pin.value = level, 1
        await ClockCycles(self.dut.clk, 4)
        self.dut.conv.value, pin.value = 1023 - level, 0
        await ClockCycles(self.dut.clk, 4)


async def start(dut: Any) -> Board:
    """Power on and boot the board; record both lines from then on."""
    board = Board(dut)
    await board.boot()
    await ClockCycles(dut.clk, 10)
    for host in (board.usb, board.rs485):
        host.listen()
    return board


@cocotb.test()
async def board006_both_lines(dut: Any) -> None:
    """If either host sends a frame, both lines carry the reply, DE is asserted for its length, and the LED
    "line" is lit.
    """
    board = await start(dut)
    same("LED before", board.led(LINE), 0)
    for host, other in ((board.usb, board.rs485), (board.rs485, board.usb)):
        other.bytes.clear()
        same("DE", int(dut.rs485_de.value), 0)
        same("microstepping", await host.ask("k"), 16)
        same("the other line", bytes(other.bytes), bytes(host.bytes))
        same("LED", board.led(LINE), 1)
    same("DE", int(dut.rs485_de.value), 0)


@cocotb.test()
async def board006_motion_and_leds(dut: Any) -> None:
    """A move lights its LED until its last step, the switches light their LED, and the outputs follow
    instruction y.
    """
    board = await start(dut)
    usb, steps = board.usb, 0
    same("y", await usb.ask("y", 0b10110 << 3), 0b10110 << 3)
    same("gpo", int(dut.gpo.value), 0b10110)
    for name in ("ext1", "ext2"):
        same("LED", board.led(SWITCH), 0)
        getattr(dut, name).value = 0
        await Timer(10, "us")
        same(f"LED of {name}", board.led(SWITCH), 1)
        getattr(dut, name).value = 1
        await Timer(10, "us")
    same("LED", board.led(MOVING), 0)
    same("step", await usb.ask("s", 5), ACCEPTED)
    same("LED", board.led(MOVING), 1)
    while board.led(MOVING):
        await with_timeout(FallingEdge(dut.mon_step), 10, "ms")
        steps += 1
        await ClockCycles(dut.clk, 40)
    same("steps", steps, 5)
    same("position", await usb.ask("c"), 5)


@cocotb.test()
async def board006_converter(dut: Any) -> None:
    """Two strobes share one data bus: the speed uses only the values of the first strobe, the stall detector
    only those of the second.
    """
    board = await start(dut)
    usb = board.usb
    # VSET selects the analog speed with full scale 1198. With the sample 512 the speed is 1198 * 513 // 1024
    # = 600 pps, which is the start speed, so the whole move has this speed.
    for code, data in (("A", 0), ("W", 0x0108), ("W", 1198), ("A", 0), ("E", 0)):
        await usb.ask(code, data)
    same("VMAX", await usb.ask("q"), 1198)
    for code, data in (("T", 2), ("Y", 1), ("Z", 100)):  # two samples below 100 cause a stall
        same(code, await usb.ask(code, data), data)
    await board.strobe("adc_stb", 512)
    await board.strobe("bemf_stb", 1000)
    same("step", await usb.ask("s", 1000), ACCEPTED)
    times = []
    for _ in range(4):
        await with_timeout(RisingEdge(dut.mon_step), 10, "ms")
        times.append(get_sim_time("us"))
        for _ in range(3):  # These values are low, too, but their strobe is that of the speed
            await board.strobe("adc_stb", 30)
    period = (times[-1] - times[0]) / 3
    assert abs(period - 1e6 / 600) <= 1, f"{period} us from step to step"
    same("not stalled", await usb.ask("j"), 0b01001)
    await board.strobe("bemf_stb", 99)
    await board.strobe("bemf_stb", 100)
    await board.strobe("bemf_stb", 99)
    same("one low level", await usb.ask("j"), 0b01001)
    await board.strobe("bemf_stb", 99)
    same("stalled", await usb.ask("j") >> 4, 1)


@cocotb.test()
async def board006_button_and_eeprom(dut: Any) -> None:
    """The button resets part and bridges immediately. Saved settings are restored, unsaved settings are
    not.
    """
    board = await start(dut)
    rs485 = board.rs485
    for code, data in (("m", 32), ("v", 2000), ("t", 0)):
        await rs485.ask(code, data)
    await Timer(4, "ms")  # time to write a page at 400 kHz, and the write time of the device
    dut.btn_n.value = 0
    await with_timeout(FallingEdge(dut.bridge_a_en), 1, "us")
    same("bridges", int(dut.bridge_b_en.value), 0)
    same("running", board.led(RUNNING), 0)
    await Timer(100, "us")
    dut.btn_n.value = 1
    await board.boot()
    await ClockCycles(dut.clk, 10)
    same("saved", await rs485.ask("k"), 32)
    same("not saved", await rs485.ask("q"), 1000)
