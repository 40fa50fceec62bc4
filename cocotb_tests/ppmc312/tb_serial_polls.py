"""Reports of serial polls, their order, and the results of events and overrides."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import cocotb

from cocotb_tests.harness import directed
from cocotb_tests.ppmc312.messages import message
from openppmc.model.ppmc312.codes import Code

from .serial_frames import TS, summed
from .serial_host import SerialHost

ON, OFF, STOP, STEP = (f"03 {tail}" for tail in ("01 20", "01 21", "02 80 00", "02 84 00"))


def event(code: str, block: str) -> str:
    """Return an instruction that registers `block`, which has the format of the parallel bus."""
    data = bytes.fromhex(block)
    return f"{code} {data.ljust(10, b'0').hex()}"


@directed("P312-SER-30", "P312-CHK-67", "P312-RSP-10")
async def p312_serial_everything_at_once(dut: Any) -> None:
    """If reports of all classes are pending, each poll returns one of them, in the order of the classes."""
    host = await SerialHost.start(
        dut, TS, "02 01 0002", "03 01 0002", "04 00000004", "90 0000000A", "28 FF", "44"
    )
    await host.pins(run=0)
    await host.ask("85 01F4")
    await host.pins(run=1)
    await host.pins(auxi=0x81)
    await host.pause(1_000)
    await host.pins(auxi=0x80)
    await host.at_rest()
    await host.pins(alm_n=0)
    await host.pause(1_000)
    polls = await host.polls(10)
    assert polls == [
        "B0 46",
        "B0 28",
        "B0 22",
        "B0 23",
        "A0 37",
        "B0 2A 00 81",
        "B0 2A 00 01",
        "B0 27",
        "B0 25",
        "90",
    ]
    assert await host.ask("40") == "A0 37"


@directed("P312-SER-30", "P312-STA-01")
async def p312_serial_busy_and_ready(dut: Any) -> None:
    host = await SerialHost.start(dut)
    assert await host.poll() == "90"
    assert await host.ask(TS) == "90" and await host.poll() == "90"
    assert await host.ask("86 0000") == "90" and await host.state() == 0x04 and await host.poll() == "80"
    assert await host.ask("80") == "90"
    await host.at_rest()
    assert await host.polls(2) == ["A0 37", "90"]
    assert await host.ask("85 0190") == "90" and await host.state() == 0x08 and await host.poll() == "80"
    await host.pins(alm_n=0)
    await host.pause(2_000)
    assert await host.polls(3) == ["B0 46", "A0 31", "90"]
    await host.pins(alm_n=1)
    assert await host.ask("24") == "90" and await host.poll() == "90" and await host.state() == 0x02


@directed("P312-SER-22", "P312-SER-30", "P312-EVT-02", "P312-OVR-04")
async def p312_serial_the_newest_of_events_and_overrides(dut: Any) -> None:
    host = await SerialHost.start(dut, TS, event("49", ON), event("59", STOP))
    await host.blip("evt0_n")
    await host.blip("evt1_n")
    assert await host.polls(2) == ["B0 4A", "90"]
    await host.blip("evt0_n")
    assert await host.ask("B0") == "90"
    await host.blip("evt1_n")
    assert await host.polls(2) == ["B0 4B", "90"]
    await host.blip("evt0_n")
    assert await host.poll() == "B0 29"
    assert await host.asks("B0", "85 01F4") == ["90", "90"]
    await host.blip("evt0_n")
    await host.blip("evt1_n")
    await host.at_rest()
    assert await host.polls(3) == ["B0 28", "A0 37", "90"]


@cocotb.parametrize(
    case=[
        (message(Code.INPUT), "B0 29"),
        (message(Code.STATUS), "B0 29"),
        (message(Code.POSITION_READ, "00"), "B0 29"),
        (message(Code.OUTPUT, "15"), "B0 29"),
        ("03 01 46", "B0 4A"),
        (message(Code.TABLE_READ), "B0 4A"),
        ("03 06 49 00 03 01 20", "B0 4A"),
        (message(Code.STOP, "04"), "B0 4A"),
        (message(Code.FOREVER_RAMP, "00 0001"), "B0 4A"),
        (message(Code.END_TERMINAL, "02"), "B0 4A"),
        (message(Code.EVENT_READ, "01"), "B0 29"),
    ]
)
@directed("P312-SER-22", "P312-EVT-03", "P312-SER-43")
async def p312_serial_what_events_may_do(dut: Any, case: Any) -> None:
    """If an event executes read instructions, their data are discarded; a failure empties the buffer."""
    block, answer = case
    host = await SerialHost.start(dut, TS, event("49", block))
    await host.blip("evt0_n")
    assert await host.quiet(4_000)
    assert await host.polls(2) == [answer, "90"]
    assert await host.ask("4D") == ("A0 00 02 40" if answer == "B0 29" else "A0 00 02 00")
    assert await host.ask("4E") == "A0 00"


@directed("P312-SER-21", "P312-RSP-20")
async def p312_serial_newer_reports_replace_older_ones(dut: Any) -> None:
    """Unread reports do not cause an alarm: the newest stop, end of interlock and hold are each reported
    once.
    """
    host = await SerialHost.start(dut, TS)
    assert await host.ask("84 01F4 00000002") == "90"
    await host.at_rest()
    assert await host.ask("85 01F4") == "90"
    await host.ask("80")
    await host.at_rest()
    assert await host.polls(2) == ["A0 37", "90"]
    for position in (2, 4):
        assert await host.asks(f"04 {host.bench.golden.position + position:08X}", "44") == ["90", "90"]
        await host.pins(run=0)
        assert await host.ask("84 01F4 00000006") == "90"
        await host.pins(run=1)
        await host.at_rest()
    assert await host.polls(4) == ["B0 22", "B0 23", "A0 38", "90"]
    assert await host.state() == 0x02


@directed("P312-SER-21", "P312-SER-22", "P312-RSP-20", "P312-OVR-10")
async def p312_serial_no_alarm_by_unread_answers(dut: Any) -> None:
    """Overrides and events are executed one after the other, regardless of polls."""
    host = await SerialHost.start(dut, TS, event("49", ON), event("49", OFF))
    for _ in range(6):
        await host.blip("evt0_n", gap=300)
    assert host.out("exon_n") == 1 and await host.state() == 0x02
    for position in range(2, 8):
        assert await host.ask(f"9A 01F4 {position:08X}") == "90"
    assert await host.ask("84 0190 0000000A") == "90"
    await host.at_rest()
    assert await host.polls(3) == ["B0 28", "A0 38", "90"] and await host.state() == 0x02


@directed("P312-RSP-22", "P312-MON-05", "P312-SER-42")
async def p312_serial_monitors_that_return(dut: Any) -> None:
    """An unread monitor report is discarded if the distance returns into or out of the window."""
    host = await SerialHost.start(dut, TS, "02 01 0002", "03 01 0002")
    for far in ("00000010", "00000001"):
        assert await host.ask(f"43 {far}") == "90"
    assert await host.poll() == "90"
    assert await host.ask("43 00000010") == "90" and await host.poll() == "B0 27"
    assert await host.asks("43 00000000", "43 00000010") == ["90", "90"]
    assert await host.polls(2) == ["B0 25", "90"]
    assert await host.ask("43 00000000") == "90" and await host.polls(3) == [
        "B0 26",
        "B0 24",
        "90",
    ]


@directed("P312-SER-46", "P312-SER-30")
async def p312_serial_end_status(dut: Any) -> None:
    """Instruction 40 always returns the last stop; polls report it once."""
    host = await SerialHost.start(dut, TS)
    assert await host.ask("40") == "A0 00"
    assert await host.ask("82") == "90"
    await host.at_rest()
    assert [
        await host.ask("40"),
        await host.poll(),
        await host.ask("40"),
        await host.poll(),
        await host.ask("40"),
    ] == [
        "A0 38",
        "A0 38",
        "A0 38",
        "90",
        "A0 38",
    ]
    assert await host.asks("85 01F4", "40") == ["90", "A0 38"]
    await host.pins(fl_n=0)
    await host.pause(2_000)
    assert await host.ask("40") == "A0 33" and await host.poll() == "A0 33"
    await host.pins(fl_n=1)
    assert await host.asks("05 01F4", "86 0000") == ["90", "90"]
    await host.pins(fhl_n=0)
    await host.at_rest()
    assert await host.poll() == "A0 34" and await host.ask("40") == "A0 34"


@directed(
    "P312-SER-30",
    "P312-SER-22",
    "P312-SER-19",
)
async def p312_serial_an_event_around_a_poll(dut: Any) -> None:
    """An event near a poll is reported exactly once."""
    host = await SerialHost.start(dut, TS, event("49", message(Code.EXCITATION_ON)))
    for shift in (*range(-60, -33, 8), *range(-33, -25), *range(-16, 6)):
        await last_bit(host, summed(0x81), shift, evt0_n=0)
        first = await host.hear()
        await host.pins(evt0_n=1)
        assert sorted((first, await host.poll())) == ["90", "B0 29"] and await host.poll() == "90"


async def last_bit(host: SerialHost, frame: bytes, shift: int, **levels: int) -> None:
    """Send a frame; change other pins `shift` cycles after the middle of its last stop bit."""
    await host.send(frame[:-1])
    changes: dict[int, dict[str, int]] = {}
    for place, level in enumerate([0, *(frame[-1] >> k & 1 for k in range(8)), 1]):
        changes[host.t + place * 192] = {"rxd": level}
    middle = host.t + 9 * 192 + 96
    changes[middle + shift] = {**changes.get(middle + shift, {}), **levels}
    for at in sorted(changes):
        await host.bench.until(at)
        host.bench.set(**changes[at])
    host.middle = Fraction(middle)
    await host.go(middle + 96)


@cocotb.parametrize(pin=["alm_n", "auxi", "run"])
@directed("P312-SER-30", "P312-SER-19", "P312-SER-21")
async def p312_serial_a_report_around_a_poll(dut: Any, pin: str) -> None:
    before, after, report = {
        "alm_n": (1, 0, "B0 46"),
        "auxi": (0x00, 0x40, "B0 2A 00 40"),
        "run": (0, 1, "B0 23"),
    }[pin]
    host = await SerialHost.start(dut, TS, "28 FF")
    for shift in range(-12, 8):
        await host.pins(**{pin: before})
        await host.pause(1_500)
        await host.settle()
        if pin == "run":
            assert await host.ask("85 01F4") == "90"
        if pin == "alm_n" and await host.state() == 0x10:
            assert await host.ask("24") == "90"
        await last_bit(host, summed(0x81), shift, **{pin: after})
        said = [await host.hear()]
        await host.pause(1_500)
        said += [await host.poll(), await host.poll()]
        assert said.count(report) == 1
        if pin == "run":
            assert await host.ask("80") == "90"
            await host.at_rest()
        await host.settle()


@directed("P312-OVR-10", "P312-SER-19", "P312-SER-22")
async def p312_serial_an_event_around_an_instruction(dut: Any) -> None:
    """An instruction has its usual reply, and an event near it is executed either before or after it."""
    host = await SerialHost.start(
        dut, TS, event("49", message(Code.EXCITATION_ON)), event("49", message(Code.EXCITATION_OFF))
    )
    for number, shift in enumerate((*range(-60, -10, 6), *range(-10, 12, 2))):
        await host.pins(evt0_n=1)
        value = 0x15 + number % 2
        await last_bit(host, summed(0x91, bytes([0x26, value])), shift, evt0_n=0)
        assert await host.hear() == "90" and await host.polls(2) == ["B0 29", "90"]
        assert host.out("exon_n") == number % 2 and host.out("auxo_n") == ~value & 0x3F
