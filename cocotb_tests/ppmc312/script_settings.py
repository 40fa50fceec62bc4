"""Settings of the PPMC-312 through its pins: initial setting, free curves, table read, what they leave."""

from __future__ import annotations

import pytest

from cocotb_tests.harness.verifies import verifies
from cocotb_tests.ppmc312.host import CSR, MWEF, RATES, T1, T2, T3, T4, TF, TG, TH, Host, clean
from cocotb_tests.ppmc312.words import message
from openppmc.model.ppmc312.codes import SPONTANEOUS, Answer, Code, Source
from openppmc.model.ppmc312.stages.tables import build

T5 = message(Code.INITIAL, "09 2000 0040 00EA60")


def read_table(host: Host) -> tuple[list[int], list[list[int]]]:
    """Head of the table read, and its three lists, fastest stage first."""
    head = bytes.fromhex(host.ask(message(Code.TABLE_READ)))
    assert head[:3] == bytes.fromhex("020A41")
    lists: list[list[int]] = [[], [], []]
    counts = (head[3], head[4], head[5])
    widths, most = (2, 3, 3), (6, 4, 4)
    while [len(values) for values in lists] != list(counts):
        block = bytes.fromhex(host.response())
        item = block[2] - 1
        data = block[3:]
        values = [
            int.from_bytes(data[k : k + widths[item]], "big") for k in range(0, len(data), widths[item])
        ]
        lists[item] += values
        left = counts[item] - len(lists[item])
        assert len(values) == most[item] or left == 0
        last = [len(values) for values in lists] == list(counts)
        assert block[0] == last and block[1] == 1 + len(data)
    assert not host.read(CSR) & MWEF
    return list(head[3:]), lists


def weighted(values: list[int]) -> int:
    """Sum of (i + 1) x value over the stages, slowest first; the values come fastest first."""
    return sum((i + 1) * value for i, value in enumerate(reversed(values)))


@verifies("P312-CHK-09", "P312-CHK-10", "P312-CHK-11", "P312-CMD-41", "P312-TBL-01", "P312-TBL-02")
def test_reference_tables_read_back() -> None:
    sums = {T1: (51_297, 2_435_805, 156_518), T2: (56_947, 2_501_371, 162_503)}
    for setting, (total, rates_sum, pulses_sum) in sums.items():
        head, (rates, up, down) = read_table(Host(setting))
        assert head == [127, 127, 0, 0, 7, 208, 0, 7, 208] and not down
        assert (sum(rates), weighted(rates), weighted(up)) == (total, rates_sum, pulses_sum)
        assert rates[63] == 333 and rates[-1] == 1000 and rates[0] == 200 and sum(up) == 2000
    _, (rates, up, _) = read_table(Host(T5))
    assert weighted(rates) == 1_512_493 and rates[63] == 127 and up[63] == 473
    assert rates[:-7:-1] == [8192, 8036, 7589, 6952, 6226, 5490] and up[:-7:-1] == [7, 7, 8, 9, 9, 11]
    assert up[5::-1] == [934, 935, 937, 937, 937, 938]


@verifies("P312-TBL-03", "P312-TBL-04", "P312-TBL-06", "P312-CMD-41", "P312-GEN-03")
def test_tables_with_two_sides_read_back() -> None:
    for setting, counts in ((T3, [127, 127, 96]), (T4, [127, 96, 127])):
        head, (rates, up, down) = read_table(Host(setting))
        assert head[:3] == counts
        long, short = (up, down) if setting == T3 else (down, up)
        assert rates[95] == 504 and short[::-1][:6] == [8, 9, 10, 9, 9, 10]
        assert short[5::-1] == [22, 22, 22, 22, 22, 23]
        assert sum(short) == 1500 and sum(long) == 2000 and weighted(long) == 156_518
    # The longest numbers: sums beyond 2^38.
    setting = message(Code.INITIAL, "18 FFFF FF80 FEFF FFFFFF 8ABCDE")
    table = build(0xFFFF, 0xFF80, 0xFEFF, 0xFFFFFF, 0x8ABCDE, 0, True)
    head, (rates, up, down) = read_table(Host(setting))
    assert head[3:] == [0xFF, 0xFF, 0xFF, 0x8A, 0xBC, 0xDE]
    assert rates[::-1] == list(table.rates[table.first :])
    assert up[::-1] == list(table.pa[table.sa :]) and down[::-1] == list(table.pd[table.sd :])


@verifies("P312-TBL-02", "P312-TBL-03", "P312-CMD-41")
def test_sigmoid_tables_keep_stages_that_rounding_makes_equal() -> None:
    head, (rates, up, _) = read_table(Host(message(Code.INITIAL, "08 01 2C 00 64 00 0B B8")))
    assert head[:3] == [127, 127, 0] and len(up) == 127 and sum(up) == 3000
    assert rates[:-9:-1] == [300, 300, 300, 299, 299, 298, 297, 296]
    # Both sides: the slower one has all stages, the other one starts at the last stage that is slow enough.
    for rs, rp, counts in (
        (300, 300, [127, 127, 127]),
        (300, 299, [127, 127, 123]),
        (299, 300, [127, 123, 127]),
        (298, 300, [127, 122, 127]),
    ):
        host = Host(message(Code.INITIAL, f"18 {rs:04X} {rp:04X} 0064 000BB8 000FA0"))
        head, (rates, up, down) = read_table(host)
        assert head[:3] == counts and (sum(up), sum(down)) == (3000, 4000)
    for rs, second in ((624, 624), (625, 624), (626, 625)):
        head, (rates, *_) = read_table(Host(message(Code.INITIAL, f"08 {rs:04X} 0064 001770")))
        assert head[:2] == [127, 127] and rates[:-3:-1] == [rs, second]


@verifies("P312-OVR-10", "P312-EVT-01", "P312-CMD-00", "P312-CMD-FC-1", "P312-CMD-FC-9")
def test_an_event_edge_during_00_and_01_is_dropped() -> None:
    """It is remembered, and goes when the buffers are emptied: also with what is registered afterwards."""
    filled = (*TF, message(Code.EVENT_SET, "00", message(Code.OUTPUT, "01")), message(Code.STOP, "07"))
    for block, answer, cond, most in (
        (T1, message(Code.INITIAL), 0x02, 24_000),
        (
            message(Code.INITIAL, "01 03E8 03E8 0007D0"),
            message(Answer.PARAMETER, "03 00 01 03 E8 03 E8 00 07 D0"),
            0x01,
            40,
        ),
        (TF[0], message(Code.FREE_CURVE, "00 03"), 0x01, 40),
        (message(Code.FREE_CURVE, "01 03"), message(Answer.PARAMETER, "10 01 01 03"), 0x01, 40),
    ):
        for after in (30, 36, most // 2 + 16, most):
            host = Host(*filled)
            host.put(block)
            host.go(host.header + after)
            host.pins(evt0_n=0, evt1_n=0)
            assert host.response() == clean(answer), (block, after)
            assert host.quiet(2000) and host.condition == cond and host.out("auxo_n") == 0x3F
            host.pins(evt0_n=1, evt1_n=1)
            if block == TF[0]:
                for rest in TF[1:]:
                    host.ask(rest)
            elif cond == 0x01:
                host = Host.on(host)
                for block_ in TF:
                    host.ask(block_)
            assert host.ask(message(Code.STATUS)) == message(Code.STATUS, "00 02 00")
            assert host.ask(message(Code.EVENT_SET, "00", message(Code.OUTPUT, "02"))) == message(
                Code.EVENT_SET, "00"
            ) and host.quiet(2000)
            host.pins(evt0_n=0)
            assert host.response() == message(Code.OUTPUT, source=Source.EVENT) and host.out("auxo_n") == 0x3D


@verifies("P312-CMD-01", "P312-CMD-FC-1", "P312-CMD-FC-10", "P312-CMD-41")
def test_a_combined_curve_may_be_announced_with_four_bytes() -> None:
    """LE = 0 with L = 04: the last byte means nothing, whatever it is; 03 and 04 are the only lengths."""
    for last in ("00", "01", "02", "7F", "80", "FF"):
        host = Host()
        assert host.ask(f"02 04 01 01 03 {last}") == message(Code.FREE_CURVE, "00 03")
        assert [host.ask(block) for block in TF[1:]] == [
            message(Code.FREE_CURVE, "01 03"),
            message(Code.FREE_CURVE, "0F 00 00 0C 00 00 0C"),
        ]
        head, (rates, up, down) = read_table(host)
        assert head == [3, 3, 0, 0, 0, 12, 0, 0, 12]
        assert (rates, up, down) == ([100, 200, 400], [5, 4, 3], [])
    for block in ("02 02 01 01", "02 05 01 01 03 03 00"):
        assert Host().ask(block)[6:11] == "F0 11"


@verifies("P312-CMD-00", "P312-GEN-05", "P312-TBL-05")
def test_initial_setting_layouts_and_order_of_checks() -> None:
    host = Host()
    good = [
        T1,
        message(Code.INITIAL, "01 03E8 0001 00C8 0007D0 000001"),  # LE = 0: RP and ND mean nothing
        message(Code.INITIAL, "E1 03E8 00C8 0007D0"),  # bits 7..5 mean nothing
        message(Code.INITIAL, "11 03E8 03E8 00C8 0007D0 0007D0"),
    ]
    for block in good:
        assert host.ask(block) == message(Code.INITIAL), block
        assert host.condition == 0x02
        head, (rates, up, down) = read_table(host)
        assert head[2] == (127 if block[9] == "1" else 0) and weighted(rates) == 2_435_805
        assert weighted(up) == 156_518 and (not down or down == up)
    bad = [
        (0x01, message(Code.INITIAL, "11 0010 0010 0001 0007D0 0007D0")),  # before 03
        (0x01, message(Code.INITIAL, "11 03E8 0010 00C8 0007D0 0007D0")),  # stop rate
        (0x03, message(Code.INITIAL, "11 03E8 0100 03E8 0007D0 0007D0")),  # before 02 and 04
        (0x02, message(Code.INITIAL, "11 03E8 03E7 0380 000001 0007D0")),  # before 04 and 05
        (0x04, message(Code.INITIAL, "11 00F0 03E8 00C8 000001 0007D0")),  # before 05
        (0x05, message(Code.INITIAL, "11 03E8 03E8 00C8 0007D0 000476")),  # deceleration side alone
        (0x05, message(Code.INITIAL, "01 03E8 00C8 000000")),
        (0x00, message(Code.INITIAL, "01 03E8 00C8 0007D0 00")),
        (0x00, message(Code.INITIAL)),
        (0x00, message(Code.INITIAL, "11 03E8 01F4 00C8 0007D0 0005DC 00")),
    ]
    for number, block in bad:
        host.ask(T1)
        answer = bytes.fromhex(host.ask(block))
        data = bytes.fromhex(block)[2:]
        assert answer[:4] == bytes([3, len(data) + 2, 0xF0, number]) and answer[4:] == data, block
        assert host.ask(message(Code.STATUS)) == message(Code.STATUS, "00 01 00")
        assert host.ask(message(Code.TABLE_READ)) == message(Answer.STATUS, "00 01")


@verifies("P312-CMD-00", "P312-CMD-FC-1", "P312-CMD-FC-9", "P312-OVR-05", "P312-BLK-02", "P312-CMD-05")
def test_a_setting_empties_the_buffers() -> None:
    filled = (
        *TF,
        message(Code.EVENT_SET, "00", message(Code.INPUT)),
        message(Code.CHANGE, "07 00C8"),
        message(Code.STOP, "04 0000FFFF"),
    )
    for block, state in (
        (T1, 2),
        (message(Code.INITIAL, "01 03E8 03E8 0007D0"), 1),
        (TF[0], 1),
        (message(Code.FREE_CURVE, "01 03"), 1),
    ):
        host = Host(*filled)
        assert host.ask(message(Code.STATUS)) == message(Code.STATUS, "00 02 62")
        host.ask(block)
        if block == TF[0]:
            assert host.ask(message(Code.STATUS)) == message(Answer.STATUS, "02 01")
        assert host.ask(message(Code.STATUS)) == message(Code.STATUS, f"00 {state:02X} 00")
    # Refused by the table of states: nothing happens.
    host = Host(*filled)
    host.ask(message(Code.FOREVER_CONSTANT, "00 0190"))
    for block in (T1, TF[0], message(Code.INITIAL, "01 03E8 00C8 0007")):
        assert host.ask(block) == message(Answer.STATUS, "00 08")
    assert host.ask(message(Code.STATUS)) == message(Code.STATUS, "00 08 62")
    host.ask(message(Code.STOP, "00"))
    host.response()
    host.pins(fhl_n=0)
    # HSL: as set, then RH of the new table, by either way of giving one.
    host.ask(message(Code.SPEED_LIMIT, "00C8"))
    assert host.ask(message(Code.FOREVER_CONSTANT, "00 00C9")) == message(Code.FOREVER_CONSTANT, "00")
    host.ask(message(Code.STOP, "00"))
    host.response()
    for setting in ((T1,), TG):
        for block in setting:
            host.ask(block)
        assert host.ask(message(Code.FOREVER_CONSTANT, "00 0000")) == message(Answer.LIMIT)
    assert host.ask(message(Code.FOREVER_CONSTANT, "00 0065")) == message(Code.FOREVER_CONSTANT, "00")


def curve(rates: list[int], up: list[int], down: list[int] | None, step: tuple[int, int]) -> list[str]:
    """Blocks of a transfer with so many rates and pulse numbers a block."""
    blocks = [
        bytes([2, 3 + (down is not None), 1, 0x11 if down else 1, len(up), *([len(down)] if down else [])])
    ]
    lists = [(rates, 2, step[0]), (up, 3, step[1]), *([(down, 3, step[1])] if down else [])]
    for values, width, most in lists:
        for k in range(0, len(values), most):
            data = b"".join(value.to_bytes(width, "big") for value in values[k : k + most])
            blocks.append(bytes([0, len(data)]) + data)
    blocks[-1] = b"\x01" + blocks[-1][1:]
    return [block.hex() for block in blocks]


CURVES = [
    # The longest in the longest blocks, sides of their own, and one value a block.
    ([300 + 3 * k for k in range(127)], [2 + k for k in range(127)], None, (15, 10)),
    ([50 * (k + 1) for k in range(9)], [0x10_0000 + k for k in range(4)], list(range(2, 11)), (4, 3)),
    ([2, 0xFFFF], [2, 0xFF_FFFD], [3, 4], (1, 1)),
    ([100, 300, 200], [5, 4, 3], [6, 7], (3, 3)),
]


@pytest.mark.parametrize("case", CURVES, ids=["longest", "two-sides", "one-a-block", "not-monotonic"])
@verifies(
    "P312-CMD-01",
    "P312-CMD-FC-1",
    "P312-CMD-FC-2",
    "P312-CMD-FC-3",
    "P312-CMD-FC-8",
    "P312-CMD-FC-10",
    "P312-CHK-12",
    "P312-BAD-15",
)
def test_free_curves(case: tuple) -> None:
    rates, up, down, step = case
    host = Host()
    lists = [rates, up, *([down] if down else [])]
    done, item = 0, 0
    blocks = curve(*case)
    assert host.ask(blocks[0]) == clean(message(Code.FREE_CURVE, f"00 {len(rates):02X}"))
    for block in blocks[1:-1]:
        done += (len(block) // 2 - 2) // (2 if item == 0 else 3)
        if done == len(lists[item]):
            done, item = 0, item + 1
        assert host.ask(block) == clean(message(Code.FREE_CURVE, f"{item:02X} {len(lists[item]) - done:02X}"))
    total, rest = sum(up), sum(down or up)
    assert host.ask(blocks[-1]) == clean(message(Code.FREE_CURVE, f"0F {total:06X} {rest:06X}"))
    assert host.condition == 0x02
    head, got = read_table(host)
    assert head[:3] == [len(rates), len(up), len(down) if down else 0]
    assert got == [rates, up, down or []]
    # Highest and lowest rate that may be asked for: of stage 126 and of the first stage in use.
    assert host.ask(message(Code.CONSTANT, f"00 {rates[0] - 1:04X} 00000001"))[6:11] == "F0 20"
    if rates[-1] < 0xFFFF:
        assert host.ask(message(Code.CONSTANT, f"00 {rates[-1] + 1:04X} 00000001"))[6:11] == "F0 20"
    assert host.ask(message(Code.CONSTANT, f"00 {rates[-1]:04X} 00000001")) == message(Code.CONSTANT, "00")


FC_ERRORS = [
    # Code blocks.
    ("11", ("02 04 01 11 01 03",)),
    ("11", ("02 04 01 11 03 01",)),
    ("11", ("02 04 01 11 80 03",)),
    ("11", ("02 04 01 11 03 80",)),
    ("11", ("02 03 01 11 03",)),
    ("11", ("02 05 01 11 03 03 00",)),
    ("11", ("02 01 01",)),
    ("10", (message(Code.FREE_CURVE, "11 80 03"),)),  # before 11
    # Sizes: 15, 16, also in a block with an instruction's header; then 16, 18/19, 1A, 17 in this order.
    ("15", (TF[0], "00 1F" + "0064" * 15)),
    ("16", (TF[0], "00 07 0064 00C8 0190")),
    ("16", (TF[0], "00 00 64")),
    ("16", (TF[0], "03 03 40")),
    ("16", (TF[0], "01 05 0001 0001 00")),
    ("16", (TF[0], "00 08 0001 0002 0003 0004")),
    ("18", (TF[0], "01 06 0064 0001 0190")),
    ("18", (TF[0], "00 02 0000")),
    ("17", (TF[0], "01 06 0064 00C8 0190")),
    ("17", (TF[0], RATES, "01 03 000005")),
    ("19", (TF[0], RATES, "00 09 FFFFFF 000001 FFFFFF")),
    ("1A", (TF[0], RATES, "00 09 FFFFFF 000002 000002")),
    ("1A", (TF[0], RATES, "00 03 FFFFFF", "00 03 000002")),
    ("17", (TG[0], RATES, "01 09 000005 000004 000003")),
    ("1A", (*TG[:3], "00 06 FFFFFF 000002")),
    ("19", (*TG[:3], "01 06 000006 000000")),
    ("16", (*TG[:3], "01 09 000006 000004 000002")),
    ("17", (*TG[:3], "00 06 000006 000004")),
]


@pytest.mark.parametrize(("number", "blocks"), FC_ERRORS)
@verifies("P312-CMD-FC-4", "P312-CMD-FC-9", "P312-CHK-13", "P312-BAD-11", "P312-BLK-01")
def test_free_curve_errors(number: str, blocks: tuple[str, ...]) -> None:
    host = Host(*TF, message(Code.CHANGE, "07 00C8"), *blocks[:-1])
    echo = bytes.fromhex(blocks[-1])[2:]
    assert (
        host.ask(blocks[-1])
        == f"03 {len(echo[:28]) + 2:02X} F0 {number} {echo[:28].hex(' ').upper()}".strip()
    )
    assert host.ask(message(Code.STATUS)) == message(Code.STATUS, "00 01 00")
    assert host.ask(message(Code.TABLE_READ)) == message(Answer.STATUS, "00 01")
    assert host.ask(RATES) == message(Answer.STATUS, "01 01")


@verifies("P312-CMD-FC-8", "P312-RSP-20", "P312-BAD-11", "P312-INP-31", "P312-CMD-FF")
def test_a_transfer_that_is_disturbed() -> None:
    # The answer to a block is not read: alarm, no transfer any more.
    host = Host(T1, TF[0])
    host.issue(TF[1])
    host.pause(200)
    host.issue(TF[2])
    assert [host.response() for _ in range(2)] == [
        message(Code.FREE_CURVE, "01 03"),
        message(Answer.ALARM, "01", source=SPONTANEOUS),
    ]
    assert host.ask(TF[2]) == message(Answer.STATUS, "01 10")
    host.ask(message(Code.ALARM_CLEAR))
    assert host.condition == 0x01
    # Other instructions do not open one; a curve is complete only once.
    for block in (TF[2], "00 02 0064", "07 01 40"):
        assert host.ask(block) == message(Answer.STATUS, "01 01")
    for block in TH:
        host.ask(block)
    assert host.ask(TH[-1]) == message(Answer.STATUS, "01 02")
    head, (rates, up, down) = read_table(host)
    assert (rates, up, down) == ([100, 200, 400], [6, 4], [5, 4, 3]) and head[:3] == [3, 2, 3]
    for block in ("02 01 40", "02 02 80 00", "02 09 00 01 03E8 00C8 0007D0"):
        assert host.ask(block) == message(Answer.STATUS, "01 02")
    # A block after an unread answer, then FF: it goes through at once.
    host.ask(TF[0])
    host.issue(TF[1])
    host.pause(200)
    host.issue(message(Code.RESET))
    host.pause(200)
    assert host.response() == message(Code.RESET) and host.quiet() and host.condition == 0x01
