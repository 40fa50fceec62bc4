"""Scripts: what polls of the serial mode tell, in which order, and what events and overrides leave behind."""

from __future__ import annotations

from fractions import Fraction

import pytest

from cocotb_tests.harness.verifies import verifies
from cocotb_tests.ppmc312.words import message
from openppmc.model.ppmc312.codes import Code

from .serial_frames import TS, summed
from .serial_host import SerialHost

ON, OFF, STOP, STEP = (f"03 {tail}" for tail in ("01 20", "01 21", "02 80 00", "02 84 00"))


def event(code: str, block: str) -> str:
    """Registration of a parallel block."""
    data = bytes.fromhex(block)
    return f"{code} {data.ljust(10, b'0').hex()}"


def at_rest(host: SerialHost) -> None:
    """Let a motion end."""
    end = host.t + 4_000_000
    while not host.model.core.operation.at_rest:
        assert host.t < end, "the motion does not end"
        host.step()
    host.pause(200)


@verifies("P312-SER-30", "P312-CHK-67", "P312-RSP-10")
def test_everything_at_once() -> None:
    """All eight classes wait; each poll takes the first."""
    host = SerialHost(TS, "02 01 0002", "03 01 0002", "04 00000004", "90 0000000A", "28 FF", "44")
    host.pins(run=0)
    host.ask("85 01F4")
    host.pins(run=1)
    host.pins(auxi=0x81)
    host.pause(1_000)
    host.pins(auxi=0x80)
    at_rest(host)
    host.pins(alm_n=0)
    host.pause(1_000)
    polls = [host.poll() for _ in range(10)]
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
    assert host.ask("40") == "A0 37"


@verifies("P312-SER-30", "P312-STA-01")
def test_busy_and_ready() -> None:
    host = SerialHost()
    assert host.poll() == "90"
    assert host.ask(TS) == "90" and host.poll() == "90"
    assert host.ask("86 0000") == "90" and host.condition == 0x04 and host.poll() == "80"
    assert host.ask("80") == "90"
    at_rest(host)
    assert host.poll() == "A0 37" and host.poll() == "90"
    assert host.ask("85 0190") == "90" and host.condition == 0x08 and host.poll() == "80"
    host.pins(alm_n=0)
    host.pause(2_000)
    assert [host.poll() for _ in range(3)] == ["B0 46", "A0 31", "90"]
    host.pins(alm_n=1)
    assert host.ask("24") == "90" and host.poll() == "90" and host.condition == 0x02


@verifies("P312-SER-22", "P312-SER-30", "P312-EVT-02", "P312-OVR-04")
def test_the_newest_of_events_and_overrides() -> None:
    host = SerialHost(TS, event("49", ON), event("59", STOP))
    host.blip("evt0_n")
    host.blip("evt1_n")
    assert host.poll() == "B0 4A" and host.poll() == "90"
    host.blip("evt0_n")
    assert host.ask("B0") == "90"
    host.blip("evt1_n")
    assert host.poll() == "B0 4B" and host.poll() == "90"
    host.blip("evt0_n")
    assert host.poll() == "B0 29"
    assert host.ask("B0") == "90" and host.ask("85 01F4") == "90"
    host.blip("evt0_n")
    host.blip("evt1_n")
    at_rest(host)
    assert [host.poll() for _ in range(3)] == ["B0 28", "A0 37", "90"]


@pytest.mark.parametrize(
    ("block", "answer"),
    [
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
    ],
)
@verifies("P312-SER-22", "P312-EVT-03", "P312-SER-43")
def test_what_events_may_do(block: str, answer: str) -> None:
    """Data of read instructions are dropped; a failure empties the buffer."""
    host = SerialHost(TS, event("49", block))
    host.blip("evt0_n")
    assert host.quiet(4_000)
    assert host.poll() == answer and host.poll() == "90"
    assert host.ask("4D") == ("A0 00 02 40" if answer == "B0 29" else "A0 00 02 00")
    assert host.ask("4E") == "A0 00"


@verifies("P312-SER-21", "P312-RSP-20")
def test_newer_reports_replace_older_ones() -> None:
    """No alarm: the newest stop, end of interlock and hold are told, once."""
    host = SerialHost(TS)
    assert host.ask("84 01F4 00000002") == "90"
    at_rest(host)
    assert host.ask("85 01F4") == "90"
    host.ask("80")
    at_rest(host)
    assert host.poll() == "A0 37" and host.poll() == "90"
    for position in (2, 4):
        assert host.ask(f"04 {host.model.position + position:08X}") == "90" and host.ask("44") == "90"
        host.pins(run=0)
        assert host.ask("84 01F4 00000006") == "90"
        host.pins(run=1)
        at_rest(host)
    assert [host.poll() for _ in range(4)] == ["B0 22", "B0 23", "A0 38", "90"]
    assert host.condition == 0x02


@verifies("P312-SER-21", "P312-SER-22", "P312-RSP-20", "P312-OVR-10")
def test_no_alarm_by_unread_answers() -> None:
    """Overrides and events follow each other, whatever has been polled."""
    host = SerialHost(TS, event("49", ON), event("49", OFF))
    for _ in range(6):
        host.blip("evt0_n", gap=300)
    assert host.out("exon_n") == 1 and host.condition == 0x02
    for position in range(2, 8):
        assert host.ask(f"9A 01F4 {position:08X}") == "90"
    assert host.ask("84 0190 0000000A") == "90"
    at_rest(host)
    assert [host.poll() for _ in range(3)] == ["B0 28", "A0 38", "90"] and host.condition == 0x02


@verifies("P312-RSP-22", "P312-MON-05", "P312-SER-42")
def test_monitors_that_return() -> None:
    """A report nobody has asked for vanishes when the distance returns."""
    host = SerialHost(TS, "02 01 0002", "03 01 0002")
    for far in ("00000010", "00000001"):
        assert host.ask(f"43 {far}") == "90"
    assert host.poll() == "90"
    assert host.ask("43 00000010") == "90" and host.poll() == "B0 27"
    assert host.ask("43 00000000") == "90" and host.ask("43 00000010") == "90"
    assert host.poll() == "B0 25" and host.poll() == "90"
    assert host.ask("43 00000000") == "90" and [host.poll() for _ in range(3)] == ["B0 26", "B0 24", "90"]


@verifies("P312-SER-46", "P312-SER-30")
def test_end_status() -> None:
    """40 tells the last stop for ever, polls tell it once."""
    host = SerialHost(TS)
    assert host.ask("40") == "A0 00"
    assert host.ask("82") == "90"
    at_rest(host)
    assert [host.ask("40"), host.poll(), host.ask("40"), host.poll(), host.ask("40")] == [
        "A0 38",
        "A0 38",
        "A0 38",
        "90",
        "A0 38",
    ]
    assert host.ask("85 01F4") == "90" and host.ask("40") == "A0 38"
    host.pins(fl_n=0)
    host.pause(2_000)
    assert host.ask("40") == "A0 33" and host.poll() == "A0 33"
    host.pins(fl_n=1)
    assert host.ask("05 01F4") == "90" and host.ask("86 0000") == "90"
    host.pins(fhl_n=0)
    at_rest(host)
    assert host.poll() == "A0 34" and host.ask("40") == "A0 34"


@verifies("P312-SER-30", "P312-SER-22", "P312-SER-19")
def test_an_event_around_a_poll() -> None:
    """Whatever the poll meets, nothing is lost and nothing is told twice."""
    host = SerialHost(TS, event("49", message(Code.EXCITATION_ON)))
    for shift in (*range(-60, -20, 5), *range(-16, 6)):
        last_bit(host, summed(0x81), shift, evt0_n=0)
        first = host.hear()
        host.pins(evt0_n=1)
        assert sorted((first, host.poll())) == ["90", "B0 29"] and host.poll() == "90"


def last_bit(host: SerialHost, frame: bytes, shift: int, **levels: int) -> None:
    """A frame, with other pins changing `shift` clk after the middle of its last stop bit."""
    host.send(frame[:-1])
    changes: dict[int, dict[str, int]] = {}
    for place, level in enumerate([0, *(frame[-1] >> k & 1 for k in range(8)), 1]):
        changes[host.t + place * 192] = {"rxd": level}
    middle = host.t + 9 * 192 + 96
    changes[middle + shift] = {**changes.get(middle + shift, {}), **levels}
    for at in sorted(changes):
        host.model.pins(at, **changes[at])
    host.middle = Fraction(middle)
    host.go(middle + 96)


@pytest.mark.parametrize("pin", ["alm_n", "auxi", "run"])
@verifies("P312-SER-30", "P312-SER-19", "P312-SER-21")
def test_a_report_around_a_poll(pin: str) -> None:
    before, after, report = {
        "alm_n": (1, 0, "B0 46"),
        "auxi": (0x00, 0x40, "B0 2A 00 40"),
        "run": (0, 1, "B0 23"),
    }[pin]
    host = SerialHost(TS, "28 FF")
    for shift in range(-12, 8):
        host.pins(**{pin: before})
        host.pause(1_500)
        host.settle()
        if pin == "run":
            assert host.ask("85 01F4") == "90"
        if pin == "alm_n" and host.condition == 0x10:
            assert host.ask("24") == "90"
        last_bit(host, summed(0x81), shift, **{pin: after})
        said = [host.hear()]
        host.pause(1_500)
        said += [host.poll(), host.poll()]
        assert said.count(report) == 1
        if pin == "run":
            assert host.ask("80") == "90"
            at_rest(host)
        host.settle()


@verifies("P312-OVR-10", "P312-SER-19", "P312-SER-22")
def test_an_event_around_an_instruction() -> None:
    """The instruction has its reply, the event is done before or after it."""
    host = SerialHost(TS, event("49", message(Code.EXCITATION_ON)), event("49", message(Code.EXCITATION_OFF)))
    for number, shift in enumerate((*range(-60, -10, 6), *range(-10, 12, 2))):
        host.pins(evt0_n=1)
        value = 0x15 + number % 2
        last_bit(host, summed(0x91, bytes([0x26, value])), shift, evt0_n=0)
        assert host.hear() == "90" and host.poll() == "B0 29" and host.poll() == "90"
        assert host.out("exon_n") == number % 2 and host.out("auxo_n") == ~value & 0x3F
