"""A short sequence in serial mode, which also runs on netlists."""

from __future__ import annotations

from typing import Any

from cocotb_tests.harness import directed

from .serial_frames import TS, summed
from .serial_host import SerialHost


@directed(
    "P312-SER-01", "P312-SER-02", "P312-SER-13", "P312-SER-18", "P312-SER-20", "P312-SER-30", "P312-SER-45"
)
async def p312_serial_sequence(dut: Any) -> None:
    """All kinds of frames and replies work in one sequence.

    The sequence contains a motion, an event, an override, and errors of all three counters.
    """
    host = await SerialHost.start(dut, adr=10)
    assert await host.poll() == "90" and await host.asks("41", "82") == ["A0 12", "B0 43"]
    assert await host.asks(TS, "63 12345678", "62") == ["90", "90", "A0 12 34 56 78"]
    assert await host.asks("90 00000005", "49 03 01 20 00 00 00 00 00 00 00") == ["90", "90"]
    assert await host.ask("85 0190") == "90"
    assert await host.poll() == "B0 28" and await host.settle() == ["A0 37"]
    await host.blip("evt0_n", gap=300)
    assert await host.poll() == "B0 29" and host.out("exon_n") == 0
    assert await host.asks("42", "84 0000 00000000") == ["A0 00 00 00 05", "B0 42"]
    await host.send(summed(0x9A, b"\x26\x15")[:-1] + b"\x00")
    assert await host.hear() == "B0 41" and host.out("auxo_n") == 0x3F
    await host.send(summed(0x9A, b"\x25") + summed(0x8A))
    assert await host.hear(timed=False) == "A0 00"
    await host.character(0x8A, stop=0)
    assert await host.asks("4F", "4E", "40") == ["A0 01 01 01", "A0 42", "A0 37"]
    await host.pins(alm_n=0)
    await host.pause(20)
    assert await host.polls(2) == ["B0 46", "90"]


@directed("P312-SER-01", "P312-SER-12", "P312-SER-17", "P312-CMD-FF")
async def p312_serial_bad_frames_and_resets(dut: Any) -> None:
    host = await SerialHost.start(dut, error=0.02)
    await host.raw("91 32 36 31 4A 33")
    assert await host.hear() == "B0 41"
    await host.raw("91 33 33 30 92 32 35 48 A1 7E")
    assert await host.quiet(3_000)
    await host.say("42")
    rise = await host.begin()
    await host.go(rise + 3_000)
    await host.pins(rst_n=0)
    await host.pause(12)
    await host.pins(rst_n=1)
    await host.pause(40)
    host.forget()
    assert await host.quiet(3_000) and await host.poll() == "90" and await host.ask("26 15") == "90"
    await host.say("FF")
    assert await host.quiet(3_000) and host.out("auxo_n") == 0x3F and await host.poll() == "90"
