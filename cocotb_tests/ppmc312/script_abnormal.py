"""Every abnormality response of the PPMC-312, multiple occurrences, hosts that do not read (2.3, 10)."""

from __future__ import annotations

import pytest

from cocotb_tests.harness.verifies import verifies
from cocotb_tests.ppmc312.host import CSR, MREF, MWEF, T1, TF, Host, clean
from cocotb_tests.ppmc312.words import message
from openppmc.model.ppmc312.codes import SPONTANEOUS, Answer, Code, Source

STOP = message(Code.STOP, "00")
AT_REST = {"alm_n": 1, "fl_n": 1, "run": 1}


def stopped(cause: int, position: int) -> str:
    return clean(message(Answer.STOPPED, f"{cause:02X} {position & 0xFFFFFFFF:08X}", source=SPONTANEOUS))


def register(buffer: int, block: str) -> str:
    """49 that registers a block in an event buffer."""
    return message(Code.EVENT_SET, f"{buffer:02X} {block}")


def refused(block: str, number: str) -> str:
    """F0 for a block."""
    data = bytes.fromhex(block)[2:30]
    return f"03 {len(data) + 2:02X} F0 {number} " + data.hex(" ").upper()


PARAMETERS = [
    # Number, block; state NOR with table TF. All lengths that are none, then values.
    ("23", message(Code.IN_POSITION, "00")),
    ("23", message(Code.ENCODE, "01 00")),
    ("23", message(Code.IN_POSITION, "01 0001 00")),
    ("23", message(Code.INTERLOCK_POSITION, "000000")),
    ("23", message(Code.INTERLOCK_POSITION, "00000000 00")),
    ("23", message(Code.SPEED_LIMIT, "01")),
    ("23", message(Code.SPEED_LIMIT, "0100 00")),
    ("23", message(Code.END_TERMINAL)),
    ("23", message(Code.END_TERMINAL, "00 00")),
    ("23", message(Code.ORIGIN_SEARCH, "00 00")),
    ("23", message(Code.ZERO_RETURN, "00 0000 00")),
    *(
        ("23", f"03 02 {code} 00")
        for code in ("20", "21", "22", "23", "24", "25", "27", "40", "41", "44", "45", "4D")
    ),
    ("23", message(Code.RESET, "00")),
    ("23", message(Code.OUTPUT)),
    ("23", message(Code.OUTPUT, "00 00")),
    ("23", message(Code.MASK, "00")),
    ("23", message(Code.MASK, "00 00 00")),
    ("23", message(Code.POSITION_READ)),
    ("23", message(Code.POSITION_READ, "00 00")),
    ("23", message(Code.POSITION_SET, "00 000000")),
    ("23", message(Code.EVENT_READ, "00 00")),
    ("23", message(Code.RAMP, "00 000000")),
    ("23", message(Code.RAMP, "00 0000 000000")),
    ("23", message(Code.RAMP, "00 0000 00000001 00")),
    ("23", message(Code.CONSTANT, "00 00000001")),
    ("23", message(Code.STEP, "00 00")),
    ("23", message(Code.FOREVER_RAMP, "00 00")),
    ("23", message(Code.FOREVER_CONSTANT, "00 0064 00")),
    ("23", message(Code.CHANGE, "04 0064 000000")),
    ("23", message(Code.STOP, "05 00")),
    ("23", message(Code.SLOW_STOP, "05 00000000 00")),
    ("23", message(Code.RAMP, "00 0000 00000000")),
    ("23", message(Code.RAMP, "00 00000000")),
    ("23", message(Code.CONSTANT, "00 0190 00000000")),
    ("23", message(Code.END_TERMINAL, "02")),
    ("23", message(Code.END_TERMINAL, "80")),
    ("23", message(Code.POSITION_READ, "02")),
    ("23", message(Code.POSITION_SET, "80 00000000")),
    ("20", message(Code.SPEED_LIMIT, "0000")),
    ("20", message(Code.SPEED_LIMIT, "0001")),
    ("21", message(Code.RAMP, "04 0000 00000001")),
    ("21", message(Code.FOREVER_RAMP, "06 0000")),
    ("24", message(Code.EVENT_READ, "02")),
    ("24", message(Code.EVENT_READ, "FF")),
    ("25", message(Code.EVENT_SET)),
    ("25", message(Code.EVENT_SET, "02 00")),
    ("25", message(Code.EVENT_SET, "00 03 01")),
    ("25", message(Code.EVENT_SET, "00 02 02 84 00")),
    ("25", message(Code.EVENT_SET, "00 03 01 84 00")),
    ("25", message(Code.EVENT_SET, "00 03 03 84 00")),
    ("25", message(Code.EVENT_SET, "00 03 00")),
    ("25", "03 13 49 00 03 0F" + " 82" * 15),
    ("26", message(Code.IN_POSITION, "01 0000")),
    ("26", message(Code.IN_POSITION, "07 0000")),
    ("27", message(Code.ENCODE, "03 0000")),
    ("23", "03 1E 84" + " 00" * 29),  # an echo of 28 bytes at most
]


@verifies(
    "P312-BLK-01", "P312-BLK-02", "P312-CMD-49", "P312-CMD-47", "P312-CMD-02", "P312-CMD-03", "P312-CMD-05"
)
@verifies("P312-CMD-06", "P312-CMD-42", "P312-CMD-43", "P312-OVR-01", "P312-CHK-18", "P312-CHK-26")
def test_parameter_abnormality() -> None:
    host = Host(*TF)
    for number, block in PARAMETERS:
        assert host.ask(block) == refused(block, number), block
    # None of them has changed anything.
    assert host.ask(message(Code.STATUS)) == message(Code.STATUS, "00 02 00") and host.model.position == 0
    assert host.quiet() and not host.model.log.rises("pout", 0)


@verifies("P312-BLK-01", "P312-CMD-49", "P312-GEN-05")
def test_lengths_that_are_just_right() -> None:
    host = Host(*TF)
    assert host.ask("03 12 49 FC 03 0E" + " 82" * 14) == message(Code.EVENT_SET, "00")
    assert host.ask(message(Code.EVENT_READ)) == message(Code.EVENT_READ, "01 00 82 00 00 00")
    assert host.ask(message(Code.EVENT_SET, "FE")) == message(Code.EVENT_SET, "04")
    assert host.ask(register(1, message(Code.INPUT))) == message(Code.EVENT_SET, "00")
    assert host.ask(message(Code.OUTPUT, "C0")) == message(Code.OUTPUT) and host.out("auxo_n") == 0x3F
    assert host.ask(message(Code.EVENT_READ, "01")) == message(Code.EVENT_READ, "01 00 25 00 00 00")
    assert host.ask(message(Code.SPEED_LIMIT, "0002")) == message(Code.SPEED_LIMIT)
    assert host.ask(message(Code.IN_POSITION, "01 0001")) == message(Code.IN_POSITION)


@verifies(
    "P312-CHK-51", "P312-BLK-01", "P312-BAD-04", "P312-BAD-05", "P312-BAD-06", "P312-RSP-10", "P312-CMD-FF"
)
def test_size_header_and_command_abnormality() -> None:
    host = Host(T1)
    for block, answer in (
        ("03", message(Answer.SIZE, "00")),
        ("01", message(Answer.SIZE, "00")),
        ("03 01", message(Answer.SIZE, "01")),
        ("03 00", message(Answer.SIZE, "00")),
        ("FF FF", message(Answer.SIZE, "FF")),
        ("03 02 40", message(Answer.SIZE, "02")),
        ("03 01 40 00", message(Answer.SIZE, "01")),
        ("03 1F" + " 40" * 30, message(Answer.SIZE, "1F")),
        ("03 20 40", message(Answer.SIZE, "20")),
        ("07 02 40", message(Answer.SIZE, "02")),
        ("00 01 40", message(Answer.STATUS, "01 02")),
        ("01 01 40", message(Answer.STATUS, "01 02")),
        ("04 01 40", message(Answer.STATUS, "01 02")),
        ("83 01 40", message(Answer.STATUS, "01 02")),
        ("FF 01 46", message(Answer.STATUS, "01 02")),
        ("02 01 46", message(Answer.COMMAND, "46")),
        ("02 02 84 00", message(Answer.STATUS, "01 02")),
        ("02 01 FF", message(Answer.STATUS, "01 02")),
        ("03 01 FF 00", message(Answer.SIZE, "01")),
        ("03 02 FF", message(Answer.SIZE, "02")),
        (message(Code.RESET, "00 00"), refused(message(Code.RESET, "00 00"), "23")),
    ):
        if len(bytes.fromhex(block)) == 1:
            host.mark = host.t
            host.put(block)
            assert host.response() == answer
        else:
            assert host.ask(block) == answer, block
    known = {*range(0x07), 0x10, 0x11, *range(0x20, 0x29), *range(0x40, 0x46), 0x47, 0x49, 0x4D}
    known |= {*range(0x80, 0x89), 0xFF}
    for code in range(256):
        if code not in known:
            assert host.ask(message(code)) == message(Answer.COMMAND, f"{code:02X}")
    assert host.ask(message(Code.STATUS)) == message(Code.STATUS, "00 02 00")


@verifies("P312-BLK-01", "P312-STA-01", "P312-STA-03")
def test_order_of_checks() -> None:
    """State, length, value, limit, RUN; OV without its byte is 0."""
    host = Host(T1)
    assert host.ask(message(Code.STOP)) == message(Answer.STATUS, "00 02")
    assert host.ask(message(Code.CHANGE, "00 00")) == message(Answer.STATUS, "00 02")
    assert host.ask(message(Code.RAMP))[6:11] == "F0 23"
    host.pins(fl_n=0, run=0)
    assert host.ask(message(Code.CONSTANT, "00 03E9 00000001"))[6:11] == "F0 20"
    assert host.ask(message(Code.CONSTANT, "00 03E9 00000000"))[6:11] == "F0 23"
    assert host.ask(message(Code.RAMP, "00 03E9 00000000"))[6:11] == "F0 23"
    assert host.ask(message(Code.CONSTANT, "00 03E8 00000001")) == message(Answer.LIMIT)
    assert host.ask(message(Code.CONSTANT, "40 03E8 00000001")) == message(Code.CONSTANT, "01")
    assert host.ask(message(Code.INTERLOCK)) == message(Answer.STATUS, "00 20")
    assert host.ask(message(Code.INTERLOCK, "00")) == message(Answer.STATUS, "00 20")
    assert host.ask(message(Code.TABLE_READ)) == message(Answer.STATUS, "00 20")


@verifies(
    "P312-INP-30", "P312-INP-31", "P312-INP-32", "P312-INP-33", "P312-CMD-24", "P312-STA-01", "P312-OVR-05"
)
def test_alarm_by_its_pin() -> None:
    host = Host(*TF, register(0, message(Code.INPUT)), message(Code.CHANGE, "07 00C8"))
    host.pins(alm_n=0)
    assert host.response() == message(Answer.ALARM, "00", source=SPONTANEOUS)
    assert host.out("cd_n") == 0 and host.condition == 0x10
    # A second edge is nothing new.
    host.blip("alm_n", 50, 50)
    assert host.quiet(500)
    for block, answer in (
        (STOP, message(Answer.STATUS, "00 10")),
        (T1, message(Answer.STATUS, "00 10")),
        (message(Code.OUTPUT, "01"), message(Code.OUTPUT)),
        (message(Code.STATUS), message(Code.STATUS, "00 10 61")),
        (message(Code.ALARM_CLEAR), message(Code.ALARM_CLEAR)),
    ):
        assert host.ask(block) == answer
    # The event buffer still works, whatever it holds is refused or done by the table of states.
    host.pins(evt0_n=0)
    assert host.response() == message(Code.INPUT, "00", source=Source.EVENT)
    assert host.condition == 0x02 and host.out("aclr_n") == 0
    assert host.ask(message(Code.STATUS)) == message(Code.STATUS, "00 02 61")


@verifies(
    "P312-RSP-20", "P312-INP-30", "P312-INP-32", "P312-CHK-39", "P312-CHK-40", "P312-BAD-09", "P312-RSP-11"
)
def test_multiple_occurrence_of_each_kind() -> None:
    # 01 by the host, while something moves; the instruction is not executed.
    host = Host(*TF)
    host.ask(message(Code.FOREVER_CONSTANT, "00 0190"))
    host.pulse(2, 20)
    host.issue(message(Code.VERSION))
    host.pause(200)
    host.issue(message(Code.OUTPUT, "3F"))
    host.pause(200)
    assert host.condition == 0x10 and host.out("auxo_n") == 0x3F and len(host.pulses()) == 0
    assert not host.read(CSR) & MWEF
    # Another one in ABN: the alarm is reported once.
    host.issue(message(Code.OUTPUT, "3F"))
    host.pause(200)
    assert [host.response() for _ in range(3)] == [
        message(Code.VERSION, "12"),
        message(Answer.ALARM, "01", source=SPONTANEOUS),
        stopped(0x80, 2),
    ]
    assert host.quiet() and host.out("auxo_n") == 0x3F
    # With class 1 read, a further one in ABN is reported again.
    host.issue(message(Code.VERSION))
    host.pause(200)
    host.issue(message(Code.VERSION))
    assert [host.response() for _ in range(2)] == [
        message(Code.VERSION, "12"),
        message(Answer.ALARM, "01", source=SPONTANEOUS),
    ]
    assert host.ask(message(Code.ALARM_CLEAR)) == message(Code.ALARM_CLEAR) and host.condition == 0x02
    # 01 by an override, by position and by pin: the whole FIFO is emptied.
    for trigger in ("04 00C8 00000003", "05 00C8"):
        host = Host(*TF, message(Code.CHANGE, trigger), message(Code.CHANGE, "07 0190"))
        host.ask(message(Code.FOREVER_CONSTANT, "00 0190"))
        host.pulse(2, 20)
        host.issue(message(Code.INPUT))
        host.pause(300)
        host.pins(evt0_n=0)
        host.pause(14_000)
        assert host.condition == 0x10
        answers = [host.response() for _ in range(3)]
        assert answers == [
            message(Code.INPUT, "00"),
            message(Answer.ALARM, "01", source=SPONTANEOUS),
            stopped(0x80, 3 if trigger[1] == "4" else 2),
        ]
        assert host.ask(message(Code.STATUS)) == message(Code.STATUS, "00 10 00")
    # 01 by an event: its buffer is emptied, the other one is not.
    host = Host(*TF, register(0, message(Code.INPUT)), register(1, message(Code.TERMINALS)))
    host.issue(message(Code.VERSION))
    host.pause(200)
    host.blip("evt1_n")
    assert [host.response() for _ in range(2)] == [
        message(Code.VERSION, "12"),
        message(Answer.ALARM, "01", source=SPONTANEOUS),
    ]
    assert host.ask(message(Code.STATUS)) == message(Code.STATUS, "00 10 40")


@verifies("P312-RSP-20", "P312-RSP-11", "P312-CHK-40")
def test_second_stop_report_while_the_first_is_half_read() -> None:
    host = Host(*TF)
    host.ask(message(Code.STEP, "00"))
    host.wait()
    host.read(7)
    host.issue(message(Code.STEP, "00"))
    host.pause(20_000)
    assert host.condition == 0x10
    host.read(2)
    assert [host.response() for _ in range(3)] == [
        stopped(0x40, 1),
        message(Answer.ALARM, "03", source=SPONTANEOUS),
        message(Code.STEP),
    ]
    assert host.quiet()


@verifies("P312-RSP-11", "P312-RSP-10", "P312-PAR-08", "P312-BAD-08", "P312-RSP-22")
def test_reports_come_in_the_order_of_their_classes() -> None:
    """All classes wait behind one that is being read, created from the last class to the first."""
    host = Host(
        *TF,
        message(Code.INTERLOCK_POSITION, "00000003"),
        message(Code.INTERLOCK),
        message(Code.IN_POSITION, "03 0001"),
        message(Code.ENCODE, "03 0001"),
    )
    host.ask(message(Code.MASK, "01 FF"))
    host.issue(message(Code.VERSION))
    host.wait()
    host.read(7)
    host.pins(auxi=1)
    host.pause(1000)
    host.read(2)
    assert host.response() == message(Code.VERSION, "12")
    # E9 is in the window now.
    host.wait()
    for level in (3, 7, 15):
        host.pins(auxi=level)
        host.pause(1000)
    host.pins(run=0)
    host.issue(message(Code.CONSTANT, "00 0190 00000003"))
    host.pause(500)
    host.pins(run=1)
    host.pause(25_000)
    host.pins(alm_n=0)
    host.pause(500)
    assert [host.response() for _ in range(8)] == [
        message(Answer.INPUT_CHANGE, "00 01", source=SPONTANEOUS),
        message(Answer.ALARM, "00", source=SPONTANEOUS),
        message(Code.CONSTANT, "01"),
        message(Answer.INTERLOCK_END, source=SPONTANEOUS),
        message(Answer.HOLD_EXECUTED, source=SPONTANEOUS),
        stopped(0x40, 3),
        message(Answer.INPUT_CHANGE, "01 08", source=SPONTANEOUS),
        message(Answer.POSITION_CHANGE, "01", source=SPONTANEOUS),
    ]
    assert host.response() == message(Answer.ENCODE_CHANGE, "01", source=SPONTANEOUS) and host.quiet()


@verifies("P312-EVT-02", "P312-EVT-03", "P312-OVR-03", "P312-OVR-04", "P312-CMD-8V", "P312-RSP-10")
def test_interruptions() -> None:
    for block, levels, status in (
        (message(Code.FOREVER_CONSTANT, "00 0063"), {}, "00"),
        (message(Code.CONSTANT, "00 0190 00000000"), {}, "00"),
        (message(Code.STEP, "05"), {}, None),  # 84 has no OV
        (message(Code.STOP, "05"), {}, "00"),
        (message(Code.INPUT, "00"), {}, "00"),
        (STOP, {}, "01"),
        (message(Code.STEP, "00"), {"fl_n": 0}, "02"),
        (message(Code.FOREVER_CONSTANT, "00 0190"), {"fl_n": 0}, "02"),
        ("03 01 12", {}, "05"),
    ):
        host = Host(
            *TF, register(1, block), register(1, message(Code.INPUT)), register(0, message(Code.INPUT))
        )
        host.pins(**levels)
        host.blip("evt1_n")
        if status is None:
            assert host.response() == message(Code.STEP, source=Source.EVENT)
            continue
        assert host.response() == message(Answer.EVENT_FAILED, status, source=Source.EVENT), block
        assert host.ask(message(Code.EVENT_READ, "01")) == message(Code.EVENT_READ, "00 00 00 00 00 00")
        assert host.ask(message(Code.EVENT_READ, "00"))[9:11] == "01"
    for block, levels, status in (
        (message(Code.CHANGE, "05 0063"), {}, "00"),
        (message(Code.CONSTANT, "05 0190 00000000"), {}, "01"),
        (message(Code.RAMP, "05 0000 0000001E"), {}, "01"),
        (message(Code.RAMP_CHANGE, "05 0191"), {}, "00"),
    ):
        host = Host(*TF, block, message(Code.CHANGE, "07 00C8"))
        host.ask(message(Code.FOREVER_CONSTANT, "00 0190"))
        host.pins(**levels)
        host.blip("evt0_n")
        assert host.response() == message(Answer.OVERRIDE_FAILED, status, source=Source.OVERRIDE), block
        assert host.ask(message(Code.STATUS)) == message(Code.STATUS, "00 08 00")
    for block, levels, status in (
        (message(Code.RAMP, "05 0000 00000000"), {}, "00"),
        (message(Code.CONSTANT, "05 0190 00000001"), {"fl_n": 0}, "02"),
        (message(Code.FOREVER_RAMP, "05 0000"), {"fl_n": 0}, "02"),
        (message(Code.SLOW_STOP, "05"), {}, "01"),
        (message(Code.FOREVER_CONSTANT, "05 0064"), {"alm_n": 0}, "01"),
    ):
        host = Host(*TF, block, message(Code.STOP, "04 00000001"))
        host.pins(**levels)
        if "alm_n" in levels:
            assert host.response() == message(Answer.ALARM, "00", source=SPONTANEOUS)
        host.blip("evt0_n")
        assert host.response() == message(Answer.OVERRIDE_FAILED, status, source=Source.OVERRIDE), block
        assert host.ask(message(Code.STATUS)).endswith(" 00")


@verifies("P312-OVR-03", "P312-OVR-05", "P312-OVR-02", "P312-INP-20")
def test_overrides_that_start_motions() -> None:
    host = Host(
        *TF,
        message(Code.RAMP, "05 0000 00000007"),
        message(Code.CONSTANT, "47 0190 00000002"),
        message(Code.FOREVER_RAMP, "05 0000"),
        message(Code.FOREVER_CONSTANT, "07 0190"),
    )
    assert host.ask(message(Code.STATUS)) == message(Code.STATUS, "00 02 34")
    for pin, answer, end in (
        ("evt0_n", message(Code.RAMP, "10", source=Source.OVERRIDE), 7),
        ("evt1_n", message(Code.CONSTANT, "00", source=Source.OVERRIDE), 5),
    ):
        host.blip(pin)
        assert host.response() == answer
        assert host.response() == stopped(0x40, end)
    host.pins(run=0)
    host.blip("evt0_n")
    assert (
        host.response() == message(Code.FOREVER_RAMP, "01", source=Source.OVERRIDE) and host.condition == 0x20
    )
    host.pins(run=1)
    assert host.response() == message(Answer.HOLD_EXECUTED, source=SPONTANEOUS)
    host.blip("evt1_n")
    assert host.response() == message(Answer.OVERRIDE_FAILED, "01", source=Source.OVERRIDE)
    assert host.ask(message(Code.STATUS)) == message(Code.STATUS, "00 04 00")


@pytest.mark.parametrize("order", [(0, 1, 2), (2, 1, 0), (1, 0, 2)])
@verifies(
    "P312-OVR-01", "P312-OVR-02", "P312-OVR-12", "P312-CMD-80", "P312-CMD-81", "P312-CMD-87", "P312-CMD-88"
)
def test_position_triggers_of_all_kinds(order: tuple[int, ...]) -> None:
    """Only the head is armed: positions in the wrong order wait for their turn."""
    blocks = [
        message(Code.CHANGE, "04 00C8 00000004"),
        message(Code.RAMP_CHANGE, "06 0064 00000008"),
        message(Code.SLOW_STOP, "04 0000000E"),
    ]
    host = Host(*TF, *(blocks[n] for n in order))
    host.ask(message(Code.FOREVER_CONSTANT, "00 0190"))
    mark = host.mark
    done, pulses = {
        (0, 1, 2): (
            ["88", "87", "81"],
            [400] * 4 + [200] * 4 + [100] * 6 + [100] * 5 + [200] * 4 + [400] * 2,
        ),
        (2, 1, 0): (["81"], [400] * 13),
        (1, 0, 2): (["87"], [400] * 8 + [200] * 4 + [100] * 7),
    }[order]
    for code in done:
        assert host.response() == f"1B 01 {code}"
    if order == (1, 0, 2):
        host.mark = mark
        host.pulse(20, 20)
        assert host.ask(message(Code.STATUS)) == message(Code.STATUS, "00 08 02")
    else:
        assert host.response() == stopped(*((0x08, 26) if order == (0, 1, 2) else (0x10, 14)))
        assert host.ask(message(Code.STATUS)) == message(Code.STATUS, f"00 02 0{3 - len(done)}")
    host.mark = mark
    assert host.gaps() == pulses


@verifies("P312-BAD-09", "P312-RSP-20", "P312-PAR-06", "P312-CHK-62", "P312-CMD-FF")
def test_hosts_that_never_read() -> None:
    """Whatever waits unread: no hang, stops still work, FF gets through."""
    host = Host(*TF, register(0, message(Code.INPUT)))
    host.ask(message(Code.FOREVER_CONSTANT, "00 0190"))
    host.blip("evt0_n", 20, 300)
    host.issue(message(Code.STOP, "00"))
    host.pause(2000)
    mark = host.t
    host.pause(20_000)
    assert not host.model.log.rises("pout", mark) and host.read(CSR) & MWEF
    # The bus ignores writes now; reading one answer opens it, FF then needs no reading.
    host.put(message(Code.RESET))
    assert host.response() == message(Code.INPUT, "00", source=Source.EVENT) and host.read(CSR) & MWEF == 0
    host.issue(message(Code.RESET))
    host.pause(300)
    assert host.response() == message(Code.RESET) and host.read(CSR) == MREF and host.condition == 0x01
    # Table read: MWEF opens with its last block; FF may come only then.
    host = Host(*TF)
    host.ask(message(Code.TABLE_READ))
    host.pause(1000)
    assert host.read(CSR) & MWEF
    host.response()
    host.pause(50)
    assert not host.read(CSR) & MWEF
    host.issue(message(Code.RESET))
    host.pause(300)
    assert host.response() == message(Code.RESET) and host.quiet()
