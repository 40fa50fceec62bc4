"""Acceptance checks of the PPMC-312: overrides, event buffers, multiple occurrence, interlock."""

from __future__ import annotations

from typing import Any

import cocotb

from cocotb_tests.harness import D16, F16, directed
from cocotb_tests.harness.bus import CSR, MWEF
from cocotb_tests.ppmc312.blocks import T1, TF
from cocotb_tests.ppmc312.host import Host
from cocotb_tests.ppmc312.messages import message, stopped
from openppmc.model.ppmc312.codes import SPONTANEOUS, Answer, Code, Source

STOP = message(Code.STOP, "00")
FAST_CURVE = ("02 03 01 00 02", "00 04 0004 0190", "01 06 000005 000005")


def at(position: int, code: int = 0x80) -> str:
    """Return the block that registers instruction 80 or 81 for a position."""
    return message(code, f"04 {position:08X}")


@cocotb.parametrize(setting=[TF, FAST_CURVE])
@directed("P312-CHK-23", "P312-CHK-24", "P312-OVR-12", builds=(F16, D16))
async def p312_stop_at_a_position(dut: Any, setting: tuple[str, ...]) -> None:
    host = await Host.start(dut, *setting)
    assert await host.ask(at(20)) == message(Answer.REGISTERED)
    assert await host.ask(message(Code.FOREVER_CONSTANT, "00 0000")) == message(Code.FOREVER_CONSTANT, "00")
    assert await host.response() == message(Code.STOP, source=Source.OVERRIDE)
    assert await host.response() == stopped(0x04, 20)
    assert len(host.pulses()) == 20


@directed("P312-OVR-12", "P312-MOT-34")
async def p312_stop_at_the_last_pulse_changes_nothing(dut: Any) -> None:
    host = await Host.start(dut, *TF, at(10))
    await host.ask(message(Code.CONSTANT, "00 0190 0000000A"))
    assert await host.response() == message(Code.STOP, source=Source.OVERRIDE)
    assert await host.response() == stopped(0x40, 10)


@directed("P312-CHK-25", "P312-OVR-01")
async def p312_nine_registrations(dut: Any) -> None:
    host = await Host.start(dut, *TF)
    assert [await host.ask(at(20)) for _ in range(9)] == [message(Answer.REGISTERED)] * 8 + [
        message(Answer.REGISTRATION, "00")
    ]
    assert await host.ask(message(Code.STATUS)) == message(Code.STATUS, "00 02 08")


@directed("P312-CHK-26", "P312-CMD-82")
async def p312_trigger_not_possible(dut: Any) -> None:
    host = await Host.start(dut, *TF)
    for code, tail in ((0x82, "0000 0000001E"), (0x83, "0190 0000001E"), (0x85, "0000"), (0x86, "0190")):
        for flags in ("04", "06"):
            data = bytes.fromhex(flags + tail)
            answer = await host.ask(message(code, f"{data.hex()}"))
            assert answer.split()[2:5] == ["F0", "21", f"{code:02X}"]
    for block in (
        message(Code.STOP, "04"),
        message(Code.SLOW_STOP, "06"),
        message(Code.RAMP_CHANGE, "04 0064"),
        message(Code.CHANGE, "04 0064"),
    ):
        assert (await host.ask(block)).split()[2:4] == ["F0", "23"]
    assert await host.ask(message(Code.RAMP, "05 0000 0000001E")) == message(Answer.REGISTERED)
    assert await host.ask(message(Code.CHANGE, "07 FFFF")) == message(Answer.REGISTERED)
    assert await host.ask(message(Code.STATUS)) == message(Code.STATUS, "00 02 32")


@directed("P312-CHK-27")
async def p312_evt_in_use(dut: Any) -> None:
    host = await Host.start(dut, *TF, message(Code.CHANGE, "05 00C8"))
    assert await host.ask(message(Code.EVENT_SET, "00", message(Code.STEP, "00"))) == message(
        Code.EVENT_SET, "01"
    )
    assert await host.ask(message(Code.EVENT_SET, "01", message(Code.STEP, "00"))) == message(
        Code.EVENT_SET, "00"
    )
    assert await host.ask(message(Code.CHANGE, "07 00C8")) == message(Answer.REGISTRATION, "01")
    host = await Host.start(dut, *TF, message(Code.EVENT_SET, "00", message(Code.STEP, "00")))
    assert await host.ask(message(Code.CHANGE, "05 00C8")) == message(Answer.REGISTRATION, "01")


@directed("P312-CHK-28", "P312-EVT-01", "P312-EVT-02")
async def p312_event_buffer_wraps(dut: Any) -> None:
    host = await Host.start(
        dut,
        *TF,
        message(Code.EVENT_SET, "00", message(Code.OUTPUT, "01")),
        message(Code.EVENT_SET, "00", message(Code.OUTPUT, "02")),
    )
    for level in (0x3E, 0x3D, 0x3E):
        await host.blip("evt0_n")
        assert await host.response() == message(Code.OUTPUT, source=Source.EVENT)
        assert host.out("auxo_n") == level
    assert await host.ask(message(Code.EVENT_READ, "00")) == message(Code.EVENT_READ, "02 01 26 26 00 00")
    assert await host.ask(message(Code.EVENT_READ)) == message(Code.EVENT_READ, "02 01 26 26 00 00")


@directed("P312-CHK-29", "P312-EVT-02")
async def p312_event_interruption(dut: Any) -> None:
    host = await Host.start(dut, *TF, message(Code.EVENT_SET, "01", message(Code.STEP, "00")))
    await host.pins(fl_n=0)
    await host.blip("evt1_n")
    assert await host.response() == message(Answer.EVENT_FAILED, "02", source=Source.EVENT)
    assert await host.ask(message(Code.EVENT_READ, "01")) == message(Code.EVENT_READ, "00 00 00 00 00 00")


@cocotb.parametrize(
    case=[
        (message(Code.EVENT_SET, "00 03 00"), "00"),
        (message(Code.STOP, "05"), "00"),
        (message(Code.FREE_CURVE, "01 03"), "00"),
        (message(Code.TABLE_READ), "00"),
        (message(Code.EVENT_SET, "02"), "00"),
        ("03 01 46", "05"),
        (message(Code.STOP, "00"), "01"),
        (message(Code.STEP), "00"),
        (message(Code.ORIGIN_SEARCH, "00 0001"), "00"),
    ]
)
@directed("P312-EVT-02", "P312-EVT-03")
async def p312_event_failures(dut: Any, case: Any) -> None:
    block, number = case
    host = await Host.start(dut, *TF)
    assert await host.ask(message(Code.EVENT_SET, "00", block)) == message(Code.EVENT_SET, "00")
    await host.blip("evt0_n")
    assert await host.response() == message(Answer.EVENT_FAILED, number, source=Source.EVENT)
    assert await host.ask(message(Code.EVENT_READ, "00")) == message(Code.EVENT_READ, "00 00 00 00 00 00")


@directed("P312-EVT-03")
async def p312_reset_and_setting_from_events(dut: Any) -> None:
    host = await Host.start(dut, *TF, message(Code.EVENT_SET, "00", message(Code.RESET)))
    await host.blip("evt0_n")
    assert await host.response() == message(Code.RESET) and host.condition == 0x01
    host = await Host.start(dut, *TF, "03 0D 49 00" + T1)
    await host.blip("evt0_n", gap=50_000)
    assert await host.response() == message(Code.INITIAL, source=Source.EVENT)
    assert host.bench.golden.core.table is not None and host.bench.golden.core.table.na == 2000
    assert await host.ask(message(Code.STATUS)) == message(Code.STATUS, "00 02 00")


@directed("P312-CHK-30")
async def p312_registration_and_deletion(dut: Any) -> None:
    host = await Host.start(dut, *TF)
    assert await host.ask(message(Code.EVENT_SET, "02")) == message(Code.EVENT_SET, "05")
    answers = [await host.ask(message(Code.EVENT_SET, "00", message(Code.STEP, "00"))) for _ in range(5)]
    assert answers == [message(Code.EVENT_SET, "00")] * 4 + [message(Code.EVENT_SET, "02")]
    assert [await host.ask(message(Code.EVENT_SET, "02")) for _ in range(5)] == [
        message(Code.EVENT_SET, f"0{s}") for s in (3, 3, 3, 4, 5)
    ]


@cocotb.parametrize(
    block=[message(Code.EVENT_SET, "02"), message(Code.EVENT_SET, "00", message(Code.OUTPUT, "04"))]
)
@directed("P312-EVT-01")
async def p312_registration_and_deletion_start_with_the_first_again(dut: Any, block: str) -> None:
    host = await Host.start(
        dut, *TF, *(message(Code.EVENT_SET, "00", message(Code.OUTPUT, f"0{n}")) for n in (1, 2, 3))
    )
    await host.blip("evt0_n")
    await host.response()
    assert (await host.ask(message(Code.EVENT_READ))).split()[4] == "01"
    await host.ask(block)
    assert (await host.ask(message(Code.EVENT_READ))).split()[4] == "00"
    await host.blip("evt0_n")
    assert await host.response() == message(Code.OUTPUT, source=Source.EVENT) and host.out("auxo_n") == 0x3E


@directed("P312-EVT-04")
async def p312_edges_without_a_taker(dut: Any) -> None:
    host = await Host.start(dut, *TF, message(Code.CHANGE, "07 00C8"), message(Code.RAMP_CHANGE, "05 0190"))
    await host.ask(message(Code.FOREVER_CONSTANT, "00 0064"))
    await host.blip("evt0_n")
    assert await host.quiet() and await host.ask(message(Code.STATUS)) == message(Code.STATUS, "00 08 32")
    await host.blip("evt1_n")
    assert await host.response() == message(Code.CHANGE, source=Source.OVERRIDE)
    await host.blip("evt0_n")
    assert await host.response() == message(Code.RAMP_CHANGE, source=Source.OVERRIDE)
    assert await host.ask(message(Code.STATUS)) == message(Code.STATUS, "00 04 00")


@directed("P312-CHK-31", "P312-OVR-04")
async def p312_override_interruption(dut: Any) -> None:
    host = await Host.start(dut, *TF, message(Code.RAMP, "05 0000 0000001E"), at(5000))
    await host.ask(message(Code.FOREVER_CONSTANT, "00 0064"))
    mark = host.mark
    await host.pulse(10)
    await host.blip("evt0_n")
    assert await host.response() == message(Answer.OVERRIDE_FAILED, "01", source=Source.OVERRIDE)
    assert await host.ask(message(Code.STATUS)) == message(Code.STATUS, "00 08 00")
    await host.ask(STOP)
    position = host.bench.golden.position
    assert await host.response() == stopped(0x04, position)
    host.mark = mark
    assert len(host.pulses()) == position


@directed("P312-OVR-02", "P312-OVR-11")
async def p312_a_position_passed_one_pulse_later_is_not_missed(dut: Any) -> None:
    host = await Host.start(
        dut, *TF, message(Code.CHANGE, "04 00C8 0000000A"), message(Code.CHANGE, "04 0190 0000000B"), at(14)
    )
    await host.ask(message(Code.FOREVER_CONSTANT, "00 0064"))
    for answer in (
        message(Code.CHANGE, source=Source.OVERRIDE),
        message(Code.CHANGE, source=Source.OVERRIDE),
        message(Code.STOP, source=Source.OVERRIDE),
    ):
        assert await host.response() == answer
    assert await host.response() == stopped(0x04, 14)
    assert host.gaps() == [100] * 10 + [200] + [400] * 2


@directed("P312-OVR-02")
async def p312_equality_that_persists_is_no_trigger(dut: Any) -> None:
    host = await Host.start(dut, *TF, at(0))
    await host.ask(message(Code.CONSTANT, "00 0190 00000002"))
    assert await host.response() == stopped(0x40, 2)
    await host.ask(message(Code.CONSTANT, "40 0190 00000005"))
    assert await host.response() == message(Code.STOP, source=Source.OVERRIDE)
    assert await host.response() == stopped(0x04, 0)


@directed("P312-CHK-49", "P312-OUT-03")
async def p312_interlock(dut: Any) -> None:
    host = await Host.start(dut, *TF, message(Code.INTERLOCK_POSITION, "0000000A"))
    assert await host.ask(message(Code.INTERLOCK)) == message(Code.INTERLOCK, "01")
    assert host.out("intlk_n") == 0
    await host.ask(message(Code.CONSTANT, "00 0190 00000014"))
    assert await host.response() == message(Answer.INTERLOCK_END, source=SPONTANEOUS)
    assert len(host.pulses()) == 10 and host.out("intlk_n") == 1
    assert await host.ask(message(Code.STATUS)) == message(Code.STATUS, "00 08 00")
    assert await host.response() == stopped(0x40, 20)
    assert await host.ask(message(Code.INTERLOCK)) == message(Code.INTERLOCK, "01")
    assert (
        await host.ask(message(Code.INTERLOCK)) == message(Code.INTERLOCK, "00") and host.out("intlk_n") == 1
    )


@directed("P312-CHK-70", "P312-RSP-20")
async def p312_a_stop_does_not_wait_for_a_read(dut: Any) -> None:
    host = await Host.start(dut, *TF, message(Code.EVENT_SET, "00", message(Code.INPUT)))
    await host.pins(auxi=0xFF)
    await host.ask(message(Code.FOREVER_CONSTANT, "00 0064"))
    mark = host.mark
    await host.pulse(10)
    await host.blip("evt0_n")
    await host.issue(STOP)
    header = host.header
    await host.pause(20_000)
    assert await host.read(CSR) & MWEF
    assert await host.response() == message(Code.INPUT, "FF", source=Source.EVENT)
    assert await host.response() == message(Code.STOP)
    assert not await host.read(CSR) & MWEF
    assert await host.response() == stopped(0x04, host.bench.golden.position)
    host.mark = mark
    assert host.pulses()[-1] <= header + 64
    assert await host.quiet()


@directed("P312-RSP-20")
async def p312_an_event_after_an_unread_answer_is_an_alarm(dut: Any) -> None:
    host = await Host.start(dut, *TF, message(Code.EVENT_SET, "00", message(Code.INPUT)))
    await host.issue(message(Code.VERSION))
    await host.pause(200)
    await host.blip("evt0_n")
    assert await host.response() == message(Code.VERSION, "12")
    assert await host.response() == message(Answer.ALARM, "01", source=SPONTANEOUS)
    assert host.condition == 0x10
    await host.ask(message(Code.ALARM_CLEAR))
    assert await host.ask(message(Code.EVENT_READ)) == message(Code.EVENT_READ, "00 00 00 00 00 00")


@directed("P312-CHK-72")
async def p312_position_stop_after_an_unread_answer(dut: Any) -> None:
    host = await Host.start(dut, *TF, message(Code.CHANGE, "04 00C8 00000012"), at(19))
    await host.ask(message(Code.FOREVER_CONSTANT, "00 0064"))
    await host.pulse(19)
    await host.pause(20_000)
    assert len(host.pulses()) == 19
    assert await host.response() == message(Code.CHANGE, source=Source.OVERRIDE)
    assert await host.response() == message(Answer.ALARM, "01", source=SPONTANEOUS)
    assert await host.response() == stopped(0x80, 19)
    assert await host.quiet() and host.condition == 0x10


@directed("P312-OVR-05", "P312-INP-31")
async def p312_buffers_survive_an_alarm(dut: Any) -> None:
    host = await Host.start(dut, *TF, at(5), message(Code.EVENT_SET, "00", message(Code.STEP, "00")))
    await host.pins(alm_n=0)
    assert await host.response() == message(Answer.ALARM, "00", source=SPONTANEOUS)
    await host.pins(alm_n=1)
    await host.ask(message(Code.ALARM_CLEAR))
    assert await host.ask(message(Code.STATUS)) == message(Code.STATUS, "00 02 41")
    await host.blip("evt0_n")
    assert await host.response() == message(Code.STEP, source=Source.EVENT)
    assert await host.response() == stopped(0x40, 1)


@directed("P312-INP-31")
async def p312_alarm_aborts_a_transfer(dut: Any) -> None:
    host = await Host.start(dut, *TF[:2])
    await host.pins(alm_n=0)
    assert await host.response() == message(Answer.ALARM, "00", source=SPONTANEOUS)
    assert await host.ask(TF[2]) == message(Answer.STATUS, "01 10")


@directed("P312-OVR-10", "P312-BAD-13", exact="a level of one cycle may not be sampled")
async def p312_one_edge_is_remembered(dut: Any) -> None:
    host = await Host.start(
        dut,
        *TF,
        message(Code.EVENT_SET, "00", message(Code.OUTPUT, "01")),
        message(Code.EVENT_SET, "00", message(Code.OUTPUT, "02")),
        message(Code.EVENT_SET, "01", message(Code.OUTPUT, "04")),
    )
    await host.pins(evt0_n=0, evt1_n=0)
    await host.pins(evt0_n=1, evt1_n=1)
    await host.pause(4)
    await host.pins(evt0_n=0)
    await host.pause(4)
    await host.pins(evt0_n=1)
    await host.pause(500)
    # The second edge of evt0 and the edge of evt1 are processed before the first answer is read.
    assert {await host.response(), await host.response()} == {
        message(Code.OUTPUT, source=Source.EVENT),
        message(Answer.ALARM, "01", source=SPONTANEOUS),
    }
    assert host.out("auxo_n") == 0x3E
