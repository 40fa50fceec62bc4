"""Scripts: resets of a station, the pins that are latched, silent stations, the other host side's pins."""

from __future__ import annotations

import pytest

from cocotb_tests.harness.verifies import verifies
from cocotb_tests.ppmc312.words import message
from openppmc.model.ppmc312.codes import Code

from .host import CSR, Host
from .serial_frames import TS, summed
from .serial_host import SerialHost


def reset(host: SerialHost, clk: int = 12) -> None:
    """Reset pin."""
    host.pins(rst_n=0)
    host.pause(clk)
    host.pins(rst_n=1)
    host.pause(40)
    host.forget()


@pytest.mark.parametrize("characters", [1, 2, 3, 4, 5])
@verifies("P312-GEN-12", "P312-PRT-02", "P312-PRT-03")
def test_reset_in_a_frame(characters: int) -> None:
    host = SerialHost()
    frame = summed(0x91, b"\x26\x15")
    host.send(frame[:characters])
    reset(host)
    host.send(frame[characters:])
    assert host.quiet(6_000) and host.out("auxo_n") == 0x3F
    assert host.poll() == "90" and host.ask("4F") == "A0 00 00 00"


@pytest.mark.parametrize("place", [0.5, 3.5, 8.5, 9.2])
@verifies("P312-GEN-12", "P312-SER-01")
def test_reset_in_a_character(place: float) -> None:
    """What is left of the character may look like another one, but not like a frame."""
    host = SerialHost()
    host.raw("91 32")
    t = host.t
    host.model.pins(t, rxd=0)
    host.go(t + int(place * 192))
    reset(host)
    host.pins(rxd=1)
    host.pause(4_000)
    assert host.poll() == "90"


@pytest.mark.parametrize("clk", [30, 250, 1_000, 4_000, 6_000])
@verifies("P312-GEN-12", "P312-PRT-01", "P312-SER-18")
def test_reset_in_a_reply(clk: int) -> None:
    host = SerialHost("43 12345678")
    host.say("42")
    rise = host.begin()
    host.go(max(host.t, rise + clk))
    assert host.out("snd") == 1
    host.pins(rst_n=0)
    assert host.out("snd") == 0 and host.out("txd") == 1
    reset(host)
    assert host.quiet(8_000)
    assert host.ask("42") == "A0 00 00 00 00"


@verifies("P312-CMD-FF", "P312-CHK-62", "P312-GEN-12")
def test_software_reset() -> None:
    host = SerialHost(TS, "06 01", "26 15", "20", "44", "43 00001000", "90 00002000", "28 FF")
    host.raw("81 00")
    assert host.hear() == "B0 41"
    assert host.ask("81") == "B0 43"
    host.pins(auxi=1)
    host.pause(1_000)
    host.say("FF")
    assert host.quiet(8_000)
    assert (host.out("auxo_n"), host.out("exon_n"), host.out("intlk_n"), host.out("out_oe")) == (
        0x3F,
        1,
        1,
        1,
    )
    assert host.poll() == "90" and host.ask("4D") == "A0 00 01 00"
    assert host.ask("4F") == "A0 00 00 00" and host.ask("4E") == "A0 00" and host.ask("40") == "A0 00"


@verifies("P312-CMD-FF", "P312-STA-01")
def test_software_reset_in_every_state() -> None:
    host = SerialHost()
    for prepare in ("", "86 0000", "85 01F4", "82"):
        assert host.ask(TS) == "90"
        if prepare:
            host.pins(run=int(prepare != "82"))
            assert host.ask(prepare) == "90"
        host.say("FF")
        assert host.quiet(5_000)
        host.pins(run=1)
        assert host.poll() == "90" and host.condition == 0x01
    host.pins(alm_n=0)
    host.pause(20)
    host.say("FF")
    assert host.quiet(5_000)
    assert host.poll() == "B0 46" and host.condition == 0x10


@pytest.mark.parametrize("clk", [0, 400, 1_500, 3_000])
@verifies("P312-CMD-FF", "P312-EVT-03", "P312-SER-19")
def test_software_reset_by_an_event(clk: int) -> None:
    """Also in the middle of a reply, which ends there."""
    host = SerialHost(TS, "49 03 01 FF 00 00 00 00 00 00 00")
    host.say("42")
    host.pause(clk)
    host.pins(evt0_n=0)
    host.pause(60)
    assert host.out("snd") == 0 and host.out("txd") == 1
    host.pins(evt0_n=1)
    host.forget()
    assert host.quiet(8_000)
    assert host.poll() == "90" and host.condition == 0x01


@verifies("P312-PRT-03", "P312-CMD-FF")
def test_pins_that_are_latched() -> None:
    """Address and speed count at the end of a reset only, of either kind."""
    host = SerialHost()
    host.pins(adr=5, mod=6)
    host.pause(20)
    assert host.poll() == "90"
    host.say("FF")
    assert host.quiet(4_000)
    host.raw("81 7E")
    assert host.quiet(8_000)
    host.speed(6)
    host.adr = 5
    assert host.poll() == "90" and host.ask("41") == "A0 12"
    host.pins(adr=9, mod=7)
    assert host.poll() == "90"
    reset(host)
    host.adr = 9
    host.speed(7)
    assert host.poll() == "90"


@verifies("P312-PRT-03", "P312-PRT-01", "P312-CMD-FF")
def test_the_mode_is_latched() -> None:
    """From serial to parallel and back, by resets of both kinds."""
    host = SerialHost()
    host.pins(mode=1)
    host.pause(20)
    assert host.poll() == "90"
    host.say("FF")
    host.pause(200)
    bus = Host.on(host)
    assert (
        bus.read(CSR) == 0x00
        and bus.response() == message(Code.RESET)
        and bus.ask(message(Code.VERSION)) == message(Code.VERSION, "12")
    )
    host.t = bus.t
    host.raw("81 7E")
    assert host.quiet(5_000)
    bus.t = host.t
    bus.pins(mode=0)
    bus.put(message(Code.RESET))
    bus.pause(100)
    host.t = bus.t
    host.forget()
    assert host.quiet(8_000) and host.poll() == "90"


@verifies("P312-PRT-01", "P312-BAD-17")
def test_the_bus_does_nothing() -> None:
    """d_oe, irq_n and wrq_n rest whatever the bus pins do."""
    host = SerialHost(TS)
    assert host.ask("82") == "90"
    for write in (True, False, True):
        host.pins(cs_n=0, **{"we_n" if write else "oe_n": 0}, d_i=0xFF, rs=0)
        host.pause(6)
        assert host.out("d_oe") == 0 and host.out("irq_n") == 1 and host.out("wrq_n") == 1
        host.pins(cs_n=1, we_n=1, oe_n=1)
        host.pause(6)
    assert not any(edge.signal in ("d_oe", "d_o", "irq_n", "wrq_n") for edge in host.model.edges)
    host.pause(20_000)
    assert host.poll() == "A0 38"


@verifies("P312-PRT-01", "P312-PRT-03")
def test_parallel_parts_do_not_listen() -> None:
    host = SerialHost(mode=1)
    for line in ("81 7E", "91 34 31 2D"):
        host.raw(line)
        assert host.quiet(5_000)
    assert not any(edge.signal in ("snd", "txd") for edge in host.model.edges)


@pytest.mark.parametrize("mod", range(5))
@verifies("P312-BAD-17", "P312-CHK-61", "P312-PRT-03")
def test_silent_stations(mod: int) -> None:
    """Speeds without a documented protocol: nothing is sent, the event pins and motions still work."""
    host = SerialHost()
    host.pins(mod=mod)
    host.say("FF")
    host.pause(3_000)
    for bit in (128, 192, 256, 512):
        host.bit = host.bit * 0 + bit
        host.raw("81 7E")
        host.low(20)
        assert host.quiet(4_000)
    host.pins(alm_n=0)
    host.pause(20)
    assert host.out("cd_n") == 0
    host.pins(alm_n=1)
    host.pins(mod=7)
    reset(host)
    host.speed(7)
    assert host.poll() == "90" and host.ask("4F") == "A0 00 00 00"


@pytest.mark.parametrize("hsp", [0, 1])
@verifies("P312-PRT-01")
def test_hsp_has_no_function(hsp: int) -> None:
    host = SerialHost()
    host.pins(hsp=hsp)
    assert host.poll() == "90" and host.ask("41") == "A0 12"


@verifies("P312-PRT-02", "P312-SER-15")
def test_frames_before_out_oe() -> None:
    """A poll, a framing error, most of an instruction: no reply, effect or count, nothing left for later."""
    host = SerialHost(timing="DATASHEET")
    host.pins(rst_n=0)
    host.pause(12)
    host.pins(rst_n=1)
    host.pause(100)
    host.raw("81 7E")
    host.character(0x81, stop=0)
    host.raw("91 32 36 31 35")
    assert not host.out("out_oe")
    host.pause(25_600)
    assert host.out("out_oe")
    host.raw("33")
    assert host.quiet(9_000) and host.out("auxo_n") == 0x3F
    assert host.ask("4F") == "A0 00 00 00" and host.ask("4E") == "A0 00" and host.poll() == "90"


@pytest.mark.parametrize("early", [300, 40, 6, 5, 4, 3, 2, 1, 0, -1, -2, -3, -10])
@verifies("P312-PRT-02")
def test_the_first_character(early: int) -> None:
    """A frame counts when the stop bit of its control code is looked at with out_oe = 1 or later."""
    host = SerialHost(timing="DATASHEET")
    host.pins(rst_n=0)
    host.pause(12)
    host.pins(rst_n=1)
    ready = host.t - 1 + 25_600
    host.back_to(ready - 19 * 96 - early)
    host.raw("81 7E")
    host.pause(9_000)
    assert (host.rise() is not None) == (early < 0)
    host.forget()
    assert host.poll() == "90"
