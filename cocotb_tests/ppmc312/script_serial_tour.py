"""Scripts: a short tour of the serial mode, which netlists can be shown as well."""

from __future__ import annotations

from cocotb_tests.harness.verifies import verifies

from .serial_frames import TS, summed
from .serial_host import SerialHost


@verifies(
    "P312-SER-01", "P312-SER-02", "P312-SER-13", "P312-SER-18", "P312-SER-20", "P312-SER-30", "P312-SER-45"
)
def test_tour() -> None:
    """Each kind of frame and of reply, a motion, an event, an override, errors of all three counters."""
    host = SerialHost(adr=10)
    assert host.poll() == "90" and host.ask("41") == "A0 12" and host.ask("82") == "B0 43"
    assert host.ask(TS) == "90" and host.ask("63 12345678") == "90" and host.ask("62") == "A0 12 34 56 78"
    assert host.ask("90 00000005") == "90" and host.ask("49 03 01 20 00 00 00 00 00 00 00") == "90"
    assert host.ask("85 0190") == "90"
    assert host.poll() == "B0 28" and host.settle() == ["A0 37"]
    host.blip("evt0_n", gap=300)
    assert host.poll() == "B0 29" and host.out("exon_n") == 0
    assert host.ask("42") == "A0 00 00 00 05" and host.ask("84 0000 00000000") == "B0 42"
    host.send(summed(0x9A, b"\x26\x15")[:-1] + b"\x00")
    assert host.hear() == "B0 41" and host.out("auxo_n") == 0x3F
    host.send(summed(0x9A, b"\x25") + summed(0x8A))
    assert host.hear(timed=False) == "A0 00"
    host.character(0x8A, stop=0)
    assert host.ask("4F") == "A0 01 01 01" and host.ask("4E") == "A0 42" and host.ask("40") == "A0 37"
    host.pins(alm_n=0)
    host.pause(20)
    assert host.poll() == "B0 46" and host.poll() == "90"


@verifies("P312-SER-01", "P312-SER-12", "P312-SER-17", "P312-CMD-FF")
def test_bad_frames_and_resets() -> None:
    host = SerialHost(error=0.02)
    host.raw("91 32 36 31 4A 33")
    assert host.hear() == "B0 41"
    host.raw("91 33 33 30 92 32 35 48 A1 7E")
    assert host.quiet(3_000)
    host.say("42")
    rise = host.begin()
    host.go(rise + 3_000)
    host.pins(rst_n=0)
    host.pause(12)
    host.pins(rst_n=1)
    host.pause(40)
    host.forget()
    assert host.quiet(3_000) and host.poll() == "90" and host.ask("26 15") == "90"
    host.say("FF")
    assert host.quiet(3_000) and host.out("auxo_n") == 0x3F and host.poll() == "90"
