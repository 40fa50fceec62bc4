"""Resets of a station, latched pins, silent stations, pins of the parallel bus."""

from __future__ import annotations

from typing import Any

import cocotb

from cocotb_tests.harness import D16, directed
from cocotb_tests.harness.bus import CSR
from cocotb_tests.ppmc312.messages import message
from openppmc.model.ppmc312.codes import Code

from .host import Host
from .serial_frames import TS, summed
from .serial_host import SerialHost


async def reset(host: SerialHost, clk: int = 12) -> None:
    """Assert the reset pin for `clk` cycles."""
    await host.pins(rst_n=0)
    await host.pause(clk)
    await host.pins(rst_n=1)
    await host.pause(40)
    host.forget()


@cocotb.parametrize(characters=[1, 2, 3, 4, 5])
@directed("P312-GEN-12", "P312-PRT-02", "P312-PRT-03")
async def p312_serial_reset_in_a_frame(dut: Any, characters: int) -> None:
    host = await SerialHost.start(dut)
    frame = summed(0x91, b"\x26\x15")
    await host.send(frame[:characters])
    await reset(host)
    await host.send(frame[characters:])
    assert await host.quiet(6_000) and host.out("auxo_n") == 0x3F
    assert await host.poll() == "90" and await host.ask("4F") == "A0 00 00 00"


@cocotb.parametrize(place=[0.5, 3.5, 8.5, 9.2])
@directed("P312-GEN-12", "P312-SER-01")
async def p312_serial_reset_in_a_character(dut: Any, place: float) -> None:
    """After a reset, the remaining bits of a character may be received as another character, but not as a
    frame.
    """
    host = await SerialHost.start(dut)
    await host.raw("91 32")
    t = host.t
    await host.go(t)
    host.bench.set(rxd=0)
    await host.go(t + int(place * 192))
    await reset(host)
    await host.pins(rxd=1)
    await host.pause(4_000)
    assert await host.poll() == "90"


@cocotb.parametrize(clk=[30, 250, 1_000, 4_000, 6_000])
@directed("P312-GEN-12", "P312-PRT-01", "P312-SER-18")
async def p312_serial_reset_in_a_reply(dut: Any, clk: int) -> None:
    host = await SerialHost.start(dut, "43 12345678")
    await host.say("42")
    rise = await host.begin()
    await host.go(max(host.t, rise + clk))
    assert host.out("snd") == 1
    await host.pins(rst_n=0)
    assert host.out("snd") == 0 and host.out("txd") == 1
    await reset(host)
    assert await host.quiet(8_000)
    assert await host.ask("42") == "A0 00 00 00 00"


@directed("P312-CMD-FF", "P312-CHK-62", "P312-GEN-12")
async def p312_serial_software_reset(dut: Any) -> None:
    host = await SerialHost.start(
        dut, TS, "06 01", "26 15", "20", "44", "43 00001000", "90 00002000", "28 FF"
    )
    await host.raw("81 00")
    assert await host.hear() == "B0 41"
    assert await host.ask("81") == "B0 43"
    await host.pins(auxi=1)
    await host.pause(1_000)
    await host.say("FF")
    assert await host.quiet(8_000)
    assert (host.out("auxo_n"), host.out("exon_n"), host.out("intlk_n"), host.out("out_oe")) == (
        0x3F,
        1,
        1,
        1,
    )
    assert await host.poll() == "90" and await host.ask("4D") == "A0 00 01 00"
    assert await host.asks("4F", "4E", "40") == ["A0 00 00 00", "A0 00", "A0 00"]


@directed("P312-CMD-FF", "P312-STA-01")
async def p312_serial_software_reset_in_every_state(dut: Any) -> None:
    host = await SerialHost.start(dut)
    for prepare in ("", "86 0000", "85 01F4", "82"):
        assert await host.ask(TS) == "90"
        if prepare:
            await host.pins(run=int(prepare != "82"))
            assert await host.ask(prepare) == "90"
        await host.say("FF")
        assert await host.quiet(5_000)
        await host.pins(run=1)
        assert await host.poll() == "90" and await host.state() == 0x01
    await host.pins(alm_n=0)
    await host.pause(20)
    await host.say("FF")
    assert await host.quiet(5_000)
    assert await host.poll() == "B0 46" and await host.state() == 0x10


@cocotb.parametrize(clk=[0, 400, 1_500, 3_000])
@directed("P312-CMD-FF", "P312-EVT-03", "P312-SER-19")
async def p312_serial_software_reset_by_an_event(dut: Any, clk: int) -> None:
    """If an event executes a software reset, it ends a reply that is being sent."""
    host = await SerialHost.start(dut, TS, "49 03 01 FF 00 00 00 00 00 00 00")
    await host.say("42")
    await host.pause(clk)
    await host.pins(evt0_n=0)
    await host.pause(60)
    assert host.out("snd") == 0 and host.out("txd") == 1
    await host.pins(evt0_n=1)
    host.forget()
    assert await host.quiet(8_000)
    assert await host.poll() == "90" and await host.state() == 0x01


@directed("P312-PRT-03", "P312-CMD-FF")
async def p312_serial_pins_that_are_latched(dut: Any) -> None:
    """Address and speed are sampled only at the end of a reset, regardless of whether the pin or instruction
    FF causes the reset.
    """
    host = await SerialHost.start(dut)
    await host.pins(adr=5, mod=6)
    await host.pause(20)
    assert await host.poll() == "90"
    await host.say("FF")
    assert await host.quiet(4_000)
    await host.raw("81 7E")
    assert await host.quiet(8_000)
    host.speed(6)
    host.adr = 5
    assert await host.poll() == "90" and await host.ask("41") == "A0 12"
    await host.pins(adr=9, mod=7)
    assert await host.poll() == "90"
    await reset(host)
    host.adr = 9
    host.speed(7)
    assert await host.poll() == "90"


@directed("P312-PRT-03", "P312-PRT-01", "P312-CMD-FF")
async def p312_serial_the_mode_is_latched(dut: Any) -> None:
    """Resets of both kinds switch from serial to parallel mode and back."""
    host = await SerialHost.start(dut)
    await host.pins(mode=1)
    await host.pause(20)
    assert await host.poll() == "90"
    await host.say("FF")
    await host.pause(200)
    bus = Host(host.bench)
    assert await bus.read(CSR) == 0x00 and await bus.response() == message(Code.RESET)
    assert await bus.ask(message(Code.VERSION)) == message(Code.VERSION, "12")
    await host.raw("81 7E")
    assert await host.quiet(5_000)
    await bus.pins(mode=0)
    await bus.put(message(Code.RESET))
    await bus.pause(100)
    host.forget()
    assert await host.quiet(8_000) and await host.poll() == "90"


@directed("P312-PRT-01", "P312-BAD-17")
async def p312_serial_the_bus_does_nothing(dut: Any) -> None:
    """d_oe, irq_n and wrq_n do not change, regardless of the levels of the bus pins."""
    host = await SerialHost.start(dut, TS)
    assert await host.ask("82") == "90"
    for write in (True, False, True):
        await host.pins(cs_n=0, **{"we_n" if write else "oe_n": 0}, d_i=0xFF, rs=0)
        await host.pause(6)
        assert host.out("d_oe") == 0 and host.out("irq_n") == 1 and host.out("wrq_n") == 1
        await host.pins(cs_n=1, we_n=1, oe_n=1)
        await host.pause(6)
    assert not any(host.bench.edges(output) for output in ("d_oe", "d_o", "irq_n", "wrq_n"))
    await host.pause(20_000)
    assert await host.poll() == "A0 38"


@directed("P312-PRT-01", "P312-PRT-03")
async def p312_serial_parallel_parts_do_not_listen(dut: Any) -> None:
    host = await SerialHost.start(dut, mode=1)
    for line in ("81 7E", "91 34 31 2D"):
        await host.raw(line)
        assert await host.quiet(5_000)
    assert not host.bench.edges("snd") and not host.bench.edges("txd")


@cocotb.parametrize(mod=[0, 1, 2, 3, 4])
@directed("P312-BAD-17", "P312-CHK-61", "P312-PRT-03")
async def p312_serial_silent_stations(dut: Any, mod: int) -> None:
    """At a speed without a documented protocol, the station sends nothing; event pins and motions work."""
    host = await SerialHost.start(dut)
    await host.pins(mod=mod)
    await host.say("FF")
    await host.pause(3_000)
    for bit in (128, 192, 256, 512):
        host.bit = host.bit * 0 + bit
        await host.raw("81 7E")
        await host.low(20)
        assert await host.quiet(4_000)
    await host.pins(alm_n=0)
    await host.pause(20)
    assert host.out("cd_n") == 0
    await host.pins(alm_n=1)
    await host.pins(mod=7)
    await reset(host)
    host.speed(7)
    assert await host.poll() == "90" and await host.ask("4F") == "A0 00 00 00"


@cocotb.parametrize(hsp=[0, 1])
@directed("P312-PRT-01")
async def p312_serial_hsp_has_no_function(dut: Any, hsp: int) -> None:
    host = await SerialHost.start(dut)
    await host.pins(hsp=hsp)
    assert await host.poll() == "90" and await host.ask("41") == "A0 12"


@directed("P312-PRT-02", "P312-SER-15", builds=(D16,))
async def p312_serial_frames_before_out_oe(dut: Any) -> None:
    """Frames that arrive before out_oe = 1 have no reply and no effect, are not counted, and leave no state.

    The test sends a poll, a framing error, and most of an instruction.
    """
    host = await SerialHost.start(
        dut,
    )
    await host.pins(rst_n=0)
    await host.pause(12)
    await host.pins(rst_n=1)
    await host.pause(100)
    await host.raw("81 7E")
    await host.character(0x81, stop=0)
    await host.raw("91 32 36 31 35")
    assert not host.out("out_oe")
    await host.pause(25_600)
    assert host.out("out_oe")
    await host.raw("33")
    assert await host.quiet(9_000) and host.out("auxo_n") == 0x3F
    assert await host.asks("4F", "4E") == ["A0 00 00 00", "A0 00"] and await host.poll() == "90"


@cocotb.parametrize(early=[300, 40, 6, 5, 4, 3, 2, 1, 0, -1, -2, -3, -10])
@directed("P312-PRT-02", builds=(D16,))
async def p312_serial_the_first_character(dut: Any, early: int) -> None:
    """A frame is received if the stop bit of its control code is sampled while out_oe = 1."""
    host = await SerialHost.start(
        dut,
    )
    await host.pins(rst_n=0)
    await host.pause(12)
    await host.pins(rst_n=1)
    ready = host.t - 1 + 25_600
    host.back_to(ready - 19 * 96 - early)
    await host.raw("81 7E")
    await host.pause(9_000)
    assert (host.rise() is not None) == (early < 0)
    host.forget()
    assert await host.poll() == "90"
