"""Every abnormality response of the PPMC-312, multiple occurrences, hosts that do not read (2.3, 10)."""

from __future__ import annotations

import pytest

from cocotb_tests.harness.verifies import verifies
from cocotb_tests.ppmc312.host import CSR, MREF, MWEF, T1, TF, Host, clean

STOP = "03 02 80 00"
AT_REST = {"alm_n": 1, "fl_n": 1, "run": 1}


def stopped(cause: int, position: int) -> str:
    return clean(f"23 06 E0 {cause:02X} {position & 0xFFFFFFFF:08X}")


def register(buffer: int, block: str) -> str:
    """49 that registers a block in an event buffer."""
    return f"03 {len(bytes.fromhex(block)) + 2:02X} 49 {buffer:02X} {block}"


def refused(block: str, number: str) -> str:
    """F0 for a block."""
    data = bytes.fromhex(block)[2:30]
    return f"03 {len(data) + 2:02X} F0 {number} " + data.hex(" ").upper()


PARAMETERS = [
    # Number, block; state NOR with table TF. All lengths that are none, then values.
    ("23", "03 02 02 00"),
    ("23", "03 03 03 01 00"),
    ("23", "03 05 02 01 0001 00"),
    ("23", "03 04 04 000000"),
    ("23", "03 06 04 00000000 00"),
    ("23", "03 02 05 01"),
    ("23", "03 04 05 0100 00"),
    ("23", "03 01 06"),
    ("23", "03 03 06 00 00"),
    ("23", "03 03 10 00 00"),
    ("23", "03 05 11 00 0000 00"),
    *(
        ("23", f"03 02 {code} 00")
        for code in ("20", "21", "22", "23", "24", "25", "27", "40", "41", "44", "45", "4D")
    ),
    ("23", "03 02 FF 00"),
    ("23", "03 01 26"),
    ("23", "03 03 26 00 00"),
    ("23", "03 02 28 00"),
    ("23", "03 04 28 00 00 00"),
    ("23", "03 01 42"),
    ("23", "03 03 42 00 00"),
    ("23", "03 05 43 00 000000"),
    ("23", "03 03 47 00 00"),
    ("23", "03 05 82 00 000000"),
    ("23", "03 07 82 00 0000 000000"),
    ("23", "03 09 82 00 0000 00000001 00"),
    ("23", "03 06 83 00 00000001"),
    ("23", "03 03 84 00 00"),
    ("23", "03 03 85 00 00"),
    ("23", "03 05 86 00 0064 00"),
    ("23", "03 07 88 04 0064 000000"),
    ("23", "03 03 80 05 00"),
    ("23", "03 07 81 05 00000000 00"),
    ("23", "03 08 82 00 0000 00000000"),
    ("23", "03 06 82 00 00000000"),
    ("23", "03 08 83 00 0190 00000000"),
    ("23", "03 02 06 02"),
    ("23", "03 02 06 80"),
    ("23", "03 02 42 02"),
    ("23", "03 06 43 80 00000000"),
    ("20", "03 03 05 0000"),
    ("20", "03 03 05 0001"),
    ("21", "03 08 82 04 0000 00000001"),
    ("21", "03 04 85 06 0000"),
    ("24", "03 02 47 02"),
    ("24", "03 02 47 FF"),
    ("25", "03 01 49"),
    ("25", "03 03 49 02 00"),
    ("25", "03 04 49 00 03 01"),
    ("25", "03 06 49 00 02 02 84 00"),
    ("25", "03 06 49 00 03 01 84 00"),
    ("25", "03 06 49 00 03 03 84 00"),
    ("25", "03 04 49 00 03 00"),
    ("25", "03 13 49 00 03 0F" + " 82" * 15),
    ("26", "03 04 02 01 0000"),
    ("26", "03 04 02 07 0000"),
    ("27", "03 04 03 03 0000"),
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
    assert host.ask("03 01 4D") == "03 04 4D 00 02 00" and host.model.position == 0
    assert host.quiet() and not host.model.log.rises("pout", 0)


@verifies("P312-BLK-01", "P312-CMD-49", "P312-GEN-05")
def test_lengths_that_are_just_right() -> None:
    host = Host(*TF)
    assert host.ask("03 12 49 FC 03 0E" + " 82" * 14) == "03 02 49 00"
    assert host.ask("03 01 47") == "03 07 47 01 00 82 00 00 00"
    assert host.ask("03 02 49 FE") == "03 02 49 04"
    assert host.ask(register(1, "03 01 25")) == "03 02 49 00"
    assert host.ask("03 02 26 C0") == "03 01 26" and host.out("auxo_n") == 0x3F
    assert host.ask("03 02 47 01") == "03 07 47 01 00 25 00 00 00"
    assert host.ask("03 03 05 0002") == "03 01 05"
    assert host.ask("03 04 02 01 0001") == "03 01 02"


@verifies(
    "P312-CHK-51", "P312-BLK-01", "P312-BAD-04", "P312-BAD-05", "P312-BAD-06", "P312-RSP-10", "P312-CMD-FF"
)
def test_size_header_and_command_abnormality() -> None:
    host = Host(T1)
    for block, answer in (
        ("03", "03 02 F6 00"),
        ("01", "03 02 F6 00"),
        ("03 01", "03 02 F6 01"),
        ("03 00", "03 02 F6 00"),
        ("FF FF", "03 02 F6 FF"),
        ("03 02 40", "03 02 F6 02"),
        ("03 01 40 00", "03 02 F6 01"),
        ("03 1F" + " 40" * 30, "03 02 F6 1F"),
        ("03 20 40", "03 02 F6 20"),
        ("07 02 40", "03 02 F6 02"),
        ("00 01 40", "03 03 F1 01 02"),
        ("01 01 40", "03 03 F1 01 02"),
        ("04 01 40", "03 03 F1 01 02"),
        ("83 01 40", "03 03 F1 01 02"),
        ("FF 01 46", "03 03 F1 01 02"),
        ("02 01 46", "03 02 F5 46"),
        ("02 02 84 00", "03 03 F1 01 02"),
        ("02 01 FF", "03 03 F1 01 02"),
        ("03 01 FF 00", "03 02 F6 01"),
        ("03 02 FF", "03 02 F6 02"),
        ("03 03 FF 00 00", refused("03 03 FF 00 00", "23")),
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
            assert host.ask(f"03 01 {code:02X}") == f"03 02 F5 {code:02X}"
    assert host.ask("03 01 4D") == "03 04 4D 00 02 00"


@verifies("P312-BLK-01", "P312-STA-01", "P312-STA-03")
def test_order_of_checks() -> None:
    """State, length, value, limit, RUN; OV without its byte is 0."""
    host = Host(T1)
    assert host.ask("03 01 80") == "03 03 F1 00 02"
    assert host.ask("03 03 88 00 00") == "03 03 F1 00 02"
    assert host.ask("03 01 82")[6:11] == "F0 23"
    host.pins(fl_n=0, run=0)
    assert host.ask("03 08 83 00 03E9 00000001")[6:11] == "F0 20"
    assert host.ask("03 08 83 00 03E9 00000000")[6:11] == "F0 23"
    assert host.ask("03 08 82 00 03E9 00000000")[6:11] == "F0 23"
    assert host.ask("03 08 83 00 03E8 00000001") == "03 01 F2"
    assert host.ask("03 08 83 40 03E8 00000001") == "03 02 83 01"
    assert host.ask("03 01 44") == "03 03 F1 00 20"
    assert host.ask("03 02 44 00") == "03 03 F1 00 20"
    assert host.ask("03 01 41") == "03 03 F1 00 20"


@verifies(
    "P312-INP-30", "P312-INP-31", "P312-INP-32", "P312-INP-33", "P312-CMD-24", "P312-STA-01", "P312-OVR-05"
)
def test_alarm_by_its_pin() -> None:
    host = Host(*TF, register(0, "03 01 25"), "03 04 88 07 00C8")
    host.pins(alm_n=0)
    assert host.response() == "23 02 F4 00"
    assert host.out("cd_n") == 0 and host.condition == 0x10
    # A second edge is nothing new.
    host.blip("alm_n", 50, 50)
    assert host.quiet(500)
    for block, answer in (
        (STOP, "03 03 F1 00 10"),
        (T1, "03 03 F1 00 10"),
        ("03 02 26 01", "03 01 26"),
        ("03 01 4D", "03 04 4D 00 10 61"),
        ("03 01 24", "03 01 24"),
    ):
        assert host.ask(block) == answer
    # The event buffer still works, whatever it holds is refused or done by the table of states.
    host.pins(evt0_n=0)
    assert host.response() == "0B 02 25 00"
    assert host.condition == 0x02 and host.out("aclr_n") == 0
    assert host.ask("03 01 4D") == "03 04 4D 00 02 61"


@verifies(
    "P312-RSP-20", "P312-INP-30", "P312-INP-32", "P312-CHK-39", "P312-CHK-40", "P312-BAD-09", "P312-RSP-11"
)
def test_multiple_occurrence_of_each_kind() -> None:
    # 01 by the host, while something moves; the instruction is not executed.
    host = Host(*TF)
    host.ask("03 04 86 00 0190")
    host.pulse(2, 20)
    host.issue("03 01 40")
    host.pause(200)
    host.issue("03 02 26 3F")
    host.pause(200)
    assert host.condition == 0x10 and host.out("auxo_n") == 0x3F and len(host.pulses()) == 0
    assert not host.read(CSR) & MWEF
    # Another one in ABN: the alarm is reported once.
    host.issue("03 02 26 3F")
    host.pause(200)
    assert [host.response() for _ in range(3)] == ["03 02 40 12", "23 02 F4 01", stopped(0x80, 2)]
    assert host.quiet() and host.out("auxo_n") == 0x3F
    # With class 1 read, a further one in ABN is reported again.
    host.issue("03 01 40")
    host.pause(200)
    host.issue("03 01 40")
    assert [host.response() for _ in range(2)] == ["03 02 40 12", "23 02 F4 01"]
    assert host.ask("03 01 24") == "03 01 24" and host.condition == 0x02
    # 01 by an override, by position and by pin: the whole FIFO is emptied.
    for trigger in ("04 00C8 00000003", "05 00C8"):
        host = Host(*TF, f"03 {len(bytes.fromhex(trigger)) + 1:02X} 88 {trigger}", "03 04 88 07 0190")
        host.ask("03 04 86 00 0190")
        host.pulse(2, 20)
        host.issue("03 01 25")
        host.pause(300)
        host.pins(evt0_n=0)
        host.pause(14_000)
        assert host.condition == 0x10
        answers = [host.response() for _ in range(3)]
        assert answers == ["03 02 25 00", "23 02 F4 01", stopped(0x80, 3 if trigger[1] == "4" else 2)]
        assert host.ask("03 01 4D") == "03 04 4D 00 10 00"
    # 01 by an event: its buffer is emptied, the other one is not.
    host = Host(*TF, register(0, "03 01 25"), register(1, "03 01 27"))
    host.issue("03 01 40")
    host.pause(200)
    host.blip("evt1_n")
    assert [host.response() for _ in range(2)] == ["03 02 40 12", "23 02 F4 01"]
    assert host.ask("03 01 4D") == "03 04 4D 00 10 40"


@verifies("P312-RSP-20", "P312-RSP-11", "P312-CHK-40")
def test_second_stop_report_while_the_first_is_half_read() -> None:
    host = Host(*TF)
    host.ask("03 02 84 00")
    host.wait()
    host.read(7)
    host.issue("03 02 84 00")
    host.pause(20_000)
    assert host.condition == 0x10
    host.read(2)
    assert [host.response() for _ in range(3)] == [stopped(0x40, 1), "23 02 F4 03", "03 01 84"]
    assert host.quiet()


@verifies("P312-RSP-11", "P312-RSP-10", "P312-PAR-08", "P312-BAD-08", "P312-RSP-22")
def test_reports_come_in_the_order_of_their_classes() -> None:
    """All classes wait behind one that is being read, created from the last class to the first."""
    host = Host(*TF, "03 05 04 00000003", "03 01 44", "03 04 02 03 0001", "03 04 03 03 0001")
    host.ask("03 03 28 01 FF")
    host.issue("03 01 40")
    host.wait()
    host.read(7)
    host.pins(auxi=1)
    host.pause(1000)
    host.read(2)
    assert host.response() == "03 02 40 12"
    # E9 is in the window now.
    host.wait()
    for level in (3, 7, 15):
        host.pins(auxi=level)
        host.pause(1000)
    host.pins(run=0)
    host.issue("03 08 83 00 0190 00000003")
    host.pause(500)
    host.pins(run=1)
    host.pause(25_000)
    host.pins(alm_n=0)
    host.pause(500)
    assert [host.response() for _ in range(8)] == [
        "23 03 E9 00 01",
        "23 02 F4 00",
        "03 02 83 01",
        "23 01 E1",
        "23 01 E2",
        stopped(0x40, 3),
        "23 03 E9 01 08",
        "23 02 E4 01",
    ]
    assert host.response() == "23 02 E3 01" and host.quiet()


@verifies("P312-EVT-02", "P312-EVT-03", "P312-OVR-03", "P312-OVR-04", "P312-CMD-8V", "P312-RSP-10")
def test_interruptions() -> None:
    for block, levels, status in (
        ("03 04 86 00 0063", {}, "00"),
        ("03 08 83 00 0190 00000000", {}, "00"),
        ("03 02 84 05", {}, None),  # 84 has no OV
        ("03 02 80 05", {}, "00"),
        ("03 02 25 00", {}, "00"),
        (STOP, {}, "01"),
        ("03 02 84 00", {"fl_n": 0}, "02"),
        ("03 04 86 00 0190", {"fl_n": 0}, "02"),
        ("03 01 12", {}, "05"),
    ):
        host = Host(*TF, register(1, block), register(1, "03 01 25"), register(0, "03 01 25"))
        host.pins(**levels)
        host.blip("evt1_n")
        if status is None:
            assert host.response() == "0B 01 84"
            continue
        assert host.response() == f"0B 02 F8 {status}", block
        assert host.ask("03 02 47 01") == "03 07 47 00 00 00 00 00 00"
        assert host.ask("03 02 47 00")[9:11] == "01"
    for block, levels, status in (
        ("03 04 88 05 0063", {}, "00"),
        ("03 08 83 05 0190 00000000", {}, "01"),
        ("03 08 82 05 0000 0000001E", {}, "01"),
        ("03 04 87 05 0191", {}, "00"),
    ):
        host = Host(*TF, block, "03 04 88 07 00C8")
        host.ask("03 04 86 00 0190")
        host.pins(**levels)
        host.blip("evt0_n")
        assert host.response() == f"1B 02 F9 {status}", block
        assert host.ask("03 01 4D") == "03 04 4D 00 08 00"
    for block, levels, status in (
        ("03 08 82 05 0000 00000000", {}, "00"),
        ("03 08 83 05 0190 00000001", {"fl_n": 0}, "02"),
        ("03 04 85 05 0000", {"fl_n": 0}, "02"),
        ("03 02 81 05", {}, "01"),
        ("03 04 86 05 0064", {"alm_n": 0}, "01"),
    ):
        host = Host(*TF, block, "03 06 80 04 00000001")
        host.pins(**levels)
        if "alm_n" in levels:
            assert host.response() == "23 02 F4 00"
        host.blip("evt0_n")
        assert host.response() == f"1B 02 F9 {status}", block
        assert host.ask("03 01 4D").endswith(" 00")


@verifies("P312-OVR-03", "P312-OVR-05", "P312-OVR-02", "P312-INP-20")
def test_overrides_that_start_motions() -> None:
    host = Host(
        *TF, "03 08 82 05 0000 00000007", "03 08 83 47 0190 00000002", "03 04 85 05 0000", "03 04 86 07 0190"
    )
    assert host.ask("03 01 4D") == "03 04 4D 00 02 34"
    for pin, answer, end in (("evt0_n", "1B 02 82 10", 7), ("evt1_n", "1B 02 83 00", 5)):
        host.blip(pin)
        assert host.response() == answer
        assert host.response() == stopped(0x40, end)
    host.pins(run=0)
    host.blip("evt0_n")
    assert host.response() == "1B 02 85 01" and host.condition == 0x20
    host.pins(run=1)
    assert host.response() == "23 01 E2"
    host.blip("evt1_n")
    assert host.response() == "1B 02 F9 01"
    assert host.ask("03 01 4D") == "03 04 4D 00 04 00"


@pytest.mark.parametrize("order", [(0, 1, 2), (2, 1, 0), (1, 0, 2)])
@verifies(
    "P312-OVR-01", "P312-OVR-02", "P312-OVR-12", "P312-CMD-80", "P312-CMD-81", "P312-CMD-87", "P312-CMD-88"
)
def test_position_triggers_of_all_kinds(order: tuple[int, ...]) -> None:
    """Only the head is armed: positions in the wrong order wait for their turn."""
    blocks = ["03 08 88 04 00C8 00000004", "03 08 87 06 0064 00000008", "03 06 81 04 0000000E"]
    host = Host(*TF, *(blocks[n] for n in order))
    host.ask("03 04 86 00 0190")
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
        assert host.ask("03 01 4D") == "03 04 4D 00 08 02"
    else:
        assert host.response() == stopped(*((0x08, 26) if order == (0, 1, 2) else (0x10, 14)))
        assert host.ask("03 01 4D") == f"03 04 4D 00 02 0{3 - len(done)}"
    host.mark = mark
    assert host.gaps() == pulses


@verifies("P312-BAD-09", "P312-RSP-20", "P312-PAR-06", "P312-CHK-62", "P312-CMD-FF")
def test_hosts_that_never_read() -> None:
    """Whatever waits unread: no hang, stops still work, FF gets through."""
    host = Host(*TF, register(0, "03 01 25"))
    host.ask("03 04 86 00 0190")
    host.blip("evt0_n", 20, 300)
    host.issue("03 02 80 00")
    host.pause(2000)
    mark = host.t
    host.pause(20_000)
    assert not host.model.log.rises("pout", mark) and host.read(CSR) & MWEF
    # The bus ignores writes now; reading one answer opens it, FF then needs no reading.
    host.put("03 01 FF")
    assert host.response() == "0B 02 25 00" and host.read(CSR) & MWEF == 0
    host.issue("03 01 FF")
    host.pause(300)
    assert host.response() == "03 01 FF" and host.read(CSR) == MREF and host.condition == 0x01
    # Table read: MWEF opens with its last block; FF may come only then.
    host = Host(*TF)
    host.ask("03 01 41")
    host.pause(1000)
    assert host.read(CSR) & MWEF
    host.response()
    host.pause(50)
    assert not host.read(CSR) & MWEF
    host.issue("03 01 FF")
    host.pause(300)
    assert host.response() == "03 01 FF" and host.quiet()
