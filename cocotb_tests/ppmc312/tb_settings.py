"""Initial settings of the PPMC-312: the tables that result from them, the order of checks, and the buffers
that a setting clears.
"""

from __future__ import annotations

from typing import Any

from cocotb_tests.harness import directed
from cocotb_tests.harness.bus import clean
from cocotb_tests.ppmc312.blocks import T1, T2, T3, T4, TF, TG
from cocotb_tests.ppmc312.host import Host
from cocotb_tests.ppmc312.messages import message
from cocotb_tests.ppmc312.table_read import read_table
from openppmc.model.ppmc312.codes import Answer, Code, Source
from openppmc.model.ppmc312.stages import build

T5 = message(Code.INITIAL, "09 2000 0040 00EA60")


def weighted(values: list[int]) -> int:
    """Return the sum of (i + 1) x value over the stages, where stage i = 0 is the slowest; `values` begin
    with the fastest stage.
    """
    return sum((i + 1) * value for i, value in enumerate(reversed(values)))


@directed("P312-CHK-09", "P312-CHK-10", "P312-CHK-11", "P312-CMD-41", "P312-TBL-01", "P312-TBL-02")
async def p312_reference_tables_read_back(dut: Any) -> None:
    sums = {T1: (51_297, 2_435_805, 156_518), T2: (56_947, 2_501_371, 162_503)}
    for setting, (total, rates_sum, pulses_sum) in sums.items():
        head, (rates, up, down) = await read_table(await Host.start(dut, setting))
        assert head == [127, 127, 0, 0, 7, 208, 0, 7, 208] and not down
        assert (sum(rates), weighted(rates), weighted(up)) == (total, rates_sum, pulses_sum)
        assert rates[63] == 333 and rates[-1] == 1000 and rates[0] == 200 and sum(up) == 2000
    _, (rates, up, _) = await read_table(await Host.start(dut, T5))
    assert weighted(rates) == 1_512_493 and rates[63] == 127 and up[63] == 473
    assert rates[:-7:-1] == [8192, 8036, 7589, 6952, 6226, 5490] and up[:-7:-1] == [7, 7, 8, 9, 9, 11]
    assert up[5::-1] == [934, 935, 937, 937, 937, 938]


@directed("P312-TBL-03", "P312-TBL-04", "P312-TBL-06", "P312-CMD-41", "P312-GEN-03")
async def p312_tables_with_two_sides_read_back(dut: Any) -> None:
    for setting, counts in ((T3, [127, 127, 96]), (T4, [127, 96, 127])):
        head, (rates, up, down) = await read_table(await Host.start(dut, setting))
        assert head[:3] == counts
        long, short = (up, down) if setting == T3 else (down, up)
        assert rates[95] == 504 and short[::-1][:6] == [8, 9, 10, 9, 9, 10]
        assert short[5::-1] == [22, 22, 22, 22, 22, 23]
        assert sum(short) == 1500 and sum(long) == 2000 and weighted(long) == 156_518
    # The largest numbers result in sums above 2^38.
    setting = message(Code.INITIAL, "18 FFFF FF80 FEFF FFFFFF 8ABCDE")
    table = build(0xFFFF, 0xFF80, 0xFEFF, 0xFFFFFF, 0x8ABCDE, 0, True)
    head, (rates, up, down) = await read_table(await Host.start(dut, setting))
    assert head[3:] == [0xFF, 0xFF, 0xFF, 0x8A, 0xBC, 0xDE]
    assert rates[::-1] == list(table.rates[table.first :])
    assert up[::-1] == list(table.pa[table.sa :]) and down[::-1] == list(table.pd[table.sd :])


@directed("P312-TBL-02", "P312-TBL-03", "P312-CMD-41")
async def p312_sigmoid_tables_keep_stages_that_rounding_makes_equal(dut: Any) -> None:
    head, (rates, up, _) = await read_table(
        await Host.start(dut, message(Code.INITIAL, "08 01 2C 00 64 00 0B B8"))
    )
    assert head[:3] == [127, 127, 0] and len(up) == 127 and sum(up) == 3000
    assert rates[:-9:-1] == [300, 300, 300, 299, 299, 298, 297, 296]
    # The ramp with the slower start or stop rate has all stages. The other ramp begins at the last stage that
    # is not faster than its own rate.
    for rs, rp, counts in (
        (300, 300, [127, 127, 127]),
        (300, 299, [127, 127, 123]),
        (299, 300, [127, 123, 127]),
        (298, 300, [127, 122, 127]),
    ):
        host = await Host.start(dut, message(Code.INITIAL, f"18 {rs:04X} {rp:04X} 0064 000BB8 000FA0"))
        head, (rates, up, down) = await read_table(host)
        assert head[:3] == counts and (sum(up), sum(down)) == (3000, 4000)
    for rs, second in ((624, 624), (625, 624), (626, 625)):
        head, (rates, *_) = await read_table(
            await Host.start(dut, message(Code.INITIAL, f"08 {rs:04X} 0064 001770"))
        )
        assert head[:2] == [127, 127] and rates[:-3:-1] == [rs, second]


@directed("P312-OVR-10", "P312-EVT-01", "P312-CMD-00", "P312-CMD-FC-1", "P312-CMD-FC-9")
async def p312_an_event_edge_during_00_and_01_is_dropped(dut: Any) -> None:
    """If an event edge occurs during instruction 00 or 01, it is stored, then discarded when the buffers are
    emptied.

    It does not trigger an entry that is registered afterwards.
    """
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
            host = await Host.start(dut, *filled)
            await host.put(block)
            await host.go(host.header + after)
            await host.pins(evt0_n=0, evt1_n=0)
            assert await host.response() == clean(answer), (block, after)
            assert await host.quiet(2000) and host.condition == cond and host.out("auxo_n") == 0x3F
            await host.pins(evt0_n=1, evt1_n=1)
            if block == TF[0]:
                for rest in TF[1:]:
                    await host.ask(rest)
            elif cond == 0x01:
                host = Host(host.bench)
                for block_ in TF:
                    await host.ask(block_)
            assert await host.ask(message(Code.STATUS)) == message(Code.STATUS, "00 02 00")
            assert await host.ask(message(Code.EVENT_SET, "00", message(Code.OUTPUT, "02"))) == message(
                Code.EVENT_SET, "00"
            ) and await host.quiet(2000)
            await host.pins(evt0_n=0)
            assert (
                await host.response() == message(Code.OUTPUT, source=Source.EVENT)
                and host.out("auxo_n") == 0x3D
            )


@directed("P312-CMD-00", "P312-GEN-05", "P312-TBL-05")
async def p312_initial_setting_layouts_and_order_of_checks(dut: Any) -> None:
    host = await Host.start(dut)
    good = [
        T1,
        message(Code.INITIAL, "01 03E8 0001 00C8 0007D0 000001"),  # LE = 0: RP and ND are ignored
        message(Code.INITIAL, "E1 03E8 00C8 0007D0"),  # bits 7..5 are ignored
        message(Code.INITIAL, "11 03E8 03E8 00C8 0007D0 0007D0"),
    ]
    for block in good:
        assert await host.ask(block) == message(Code.INITIAL), block
        assert host.condition == 0x02
        head, (rates, up, down) = await read_table(host)
        assert head[2] == (127 if block[9] == "1" else 0) and weighted(rates) == 2_435_805
        assert weighted(up) == 156_518 and (not down or down == up)
    bad = [
        (0x01, message(Code.INITIAL, "11 0010 0010 0001 0007D0 0007D0")),  # checked before error 03
        (0x01, message(Code.INITIAL, "11 03E8 0010 00C8 0007D0 0007D0")),  # the stop rate is out of range
        (0x03, message(Code.INITIAL, "11 03E8 0100 03E8 0007D0 0007D0")),  # checked before errors 02 and 04
        (0x02, message(Code.INITIAL, "11 03E8 03E7 0380 000001 0007D0")),  # checked before errors 04 and 05
        (0x04, message(Code.INITIAL, "11 00F0 03E8 00C8 000001 0007D0")),  # checked before error 05
        (0x05, message(Code.INITIAL, "11 03E8 03E8 00C8 0007D0 0002F9")),  # only the deceleration ramp
        (0x05, message(Code.INITIAL, "01 03E8 00C8 000000")),
        (0x00, message(Code.INITIAL, "01 03E8 00C8 0007D0 00")),
        (0x00, message(Code.INITIAL)),
        (0x00, message(Code.INITIAL, "11 03E8 01F4 00C8 0007D0 0005DC 00")),
    ]
    for number, block in bad:
        await host.ask(T1)
        answer = bytes.fromhex(await host.ask(block))
        data = bytes.fromhex(block)[2:]
        assert answer[:4] == bytes([3, len(data) + 2, 0xF0, number]) and answer[4:] == data, block
        assert await host.ask(message(Code.STATUS)) == message(Code.STATUS, "00 01 00")
        assert await host.ask(message(Code.TABLE_READ)) == message(Answer.STATUS, "00 01")


@directed("P312-CMD-00", "P312-CMD-FC-1", "P312-CMD-FC-9", "P312-OVR-05", "P312-BLK-02", "P312-CMD-05")
async def p312_a_setting_empties_the_buffers(dut: Any) -> None:
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
        host = await Host.start(dut, *filled)
        assert await host.ask(message(Code.STATUS)) == message(Code.STATUS, "00 02 62")
        await host.ask(block)
        if block == TF[0]:
            assert await host.ask(message(Code.STATUS)) == message(Answer.STATUS, "02 01")
        assert await host.ask(message(Code.STATUS)) == message(Code.STATUS, f"00 {state:02X} 00")
    # The table of states rejects the setting, which then has no effect.
    host = await Host.start(dut, *filled)
    await host.ask(message(Code.FOREVER_CONSTANT, "00 0190"))
    for block in (T1, TF[0], message(Code.INITIAL, "01 03E8 00C8 0007")):
        assert await host.ask(block) == message(Answer.STATUS, "00 08")
    assert await host.ask(message(Code.STATUS)) == message(Code.STATUS, "00 08 62")
    await host.ask(message(Code.STOP, "00"))
    await host.response()
    await host.pins(fhl_n=0)
    # Until the next table, HSL keeps the value that was set. After instruction 00 or 01 sets a new table, HSL
    # is RH of this table.
    await host.ask(message(Code.SPEED_LIMIT, "00C8"))
    assert await host.ask(message(Code.FOREVER_CONSTANT, "00 00C9")) == message(Code.FOREVER_CONSTANT, "00")
    await host.ask(message(Code.STOP, "00"))
    await host.response()
    for setting in ((T1,), TG):
        for block in setting:
            await host.ask(block)
        assert await host.ask(message(Code.FOREVER_CONSTANT, "00 0000")) == message(Answer.LIMIT)
    assert await host.ask(message(Code.FOREVER_CONSTANT, "00 0065")) == message(Code.FOREVER_CONSTANT, "00")
