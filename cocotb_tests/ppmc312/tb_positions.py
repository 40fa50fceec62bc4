"""Positions, windows, interlock and input monitor of the PPMC-312 at its pins (P312-MON, P312-OUT-03)."""

from __future__ import annotations

from typing import Any

from cocotb_tests.harness import directed
from cocotb_tests.harness.bus import DRR
from cocotb_tests.ppmc312.blocks import TF
from cocotb_tests.ppmc312.directed_host import TICK
from cocotb_tests.ppmc312.host import Host
from cocotb_tests.ppmc312.messages import message, stopped
from openppmc.model.ppmc312.codes import SPONTANEOUS, Answer, Code


async def encoder(host: Host, count: int) -> None:
    """Apply `count` edges of the encoder at the highest allowed rate; a negative count is CCW.

    With JITTER=1, the direction changes one cycle before the edge, so that both are sampled in order.
    """
    for _ in range(abs(count)):
        if host.bench.slack:
            await host.pins(epdir=int(count < 0))
        await host.pins(epin=1, epdir=int(count < 0))
        await host.pause(2)
        await host.pins(epin=0)
        await host.pause(2)


async def encode_reports(host: Host) -> list[str]:
    """Read all responses; return the values of the reports of the encode monitor, 01 for outside."""
    values = []
    while not await host.quiet(200):
        *_, code, value = (await host.response()).split()
        if int(code, 16) == Answer.ENCODE_CHANGE:
            values.append(value)
    return values


@directed("P312-CMD-42", "P312-CMD-43", "P312-MON-01", "P312-MOT-05", "P312-GEN-03")
async def p312_positions(dut: Any) -> None:
    host = await Host.start(dut, *TF)
    await host.ask(message(Code.POSITION_SET, "00 01234567"))
    await host.ask(message(Code.POSITION_SET, "01 89ABCDEF"))
    await encoder(host, 5)
    await encoder(host, -7)
    assert await host.ask(message(Code.POSITION_READ, "00")) == message(Code.POSITION_READ, "00 01 23 45 67")
    assert await host.ask(message(Code.POSITION_READ, "01")) == message(Code.POSITION_READ, "01 89 AB CD ED")
    await host.ask(message(Code.POSITION_SET, "01 00000001"))
    await encoder(host, -3)
    assert await host.ask(message(Code.POSITION_READ, "01")) == message(Code.POSITION_READ, "01 FF FF FF FE")
    await encoder(host, 4)
    assert await host.ask(message(Code.POSITION_READ, "01")) == message(Code.POSITION_READ, "01 00 00 00 02")
    # Falling edges, and changes of the direction alone, are not counted.
    for levels in ({"epin": 1, "epdir": 1}, {"epdir": 0}, {"epdir": 1}, {"epin": 0}, {"epdir": 0}):
        await host.pins(**levels)
        await host.pause(4)
    assert await host.ask(message(Code.POSITION_READ, "01")) == message(Code.POSITION_READ, "01 00 00 00 01")
    # POS follows pout immediately, also if it is read while pulses are counted.
    await host.ask(message(Code.POSITION_SET, "00 0000FFFE"))
    await host.ask(message(Code.FOREVER_CONSTANT, "00 0190"))
    mark = host.mark
    for number, value in ((1, "00 00 FF FF"), (2, "00 01 00 00"), (3, "00 01 00 01")):
        host.mark = mark
        await host.pulse(number, 2)
        assert await host.ask(message(Code.POSITION_READ, "00")) == message(Code.POSITION_READ, f"00 {value}")
    assert await host.ask(message(Code.POSITION_SET, "00 00000000")) == message(Answer.STATUS, "00 08")


@directed(
    "P312-MON-01",
    "P312-MON-02",
    "P312-MON-03",
    "P312-MON-04",
    "P312-MON-05",
    "P312-RSP-22",
    "P312-CMD-02",
    "P312-CMD-03",
    "P312-CHK-46",
    "P312-CHK-48",
    "P312-CMD-4D",
)
async def p312_windows_at_their_edges(dut: Any) -> None:
    for code, answer, enabled, outside in (("02", "E4", 0x08, 0x01), ("03", "E3", 0x10, 0x02)):
        host = await Host.start(dut, f"03 04 {code} 03 0004")
        for edges, value in ((4, None), (1, 1), (-1, 0), (-9, 1), (1, 0), (4, None), (4, None), (1, 1)):
            await encoder(host, edges)
            if value is None:
                assert await host.quiet(20)
                continue
            assert await host.response() == f"23 02 {answer} {value:02X}"
            assert await host.ask(message(Code.STATUS)) == message(
                Code.STATUS, f"{enabled | outside * value:02X} 01 00"
            )
        # A disabled monitor sends no reports. When it is enabled again with RES = 0, it begins with the state
        # "inside" and sends only one report.
        assert await host.ask(f"03 04 {code} 00 0004") == f"03 01 {code}"
        assert await host.ask(message(Code.STATUS)) == message(Code.STATUS, "00 01 00")
        await host.ask(f"03 04 {code} 01 0004")
        assert await host.response() == f"23 02 {answer} 01"
        assert await host.ask(message(Code.STATUS)) == message(Code.STATUS, "00 01 00")
        await encoder(host, -5)
        assert await host.quiet(20)
        # Distances are signed and have a wide range.
        await host.ask(message(Code.POSITION_SET, "00 80000000"))
        await host.ask(message(Code.POSITION_SET, "01 7FFF0001"))
        await host.ask(f"03 04 {code} 03 FFFF")
        assert await host.quiet(20)
        await encoder(host, -1)
        assert await host.response() == f"23 02 {answer} 01"
        for encoder_position, value in (("8000FFFF", 0), ("80010000", 1), ("00000000", None)):
            await host.ask(message(Code.POSITION_SET, f"01 {encoder_position}"))
            assert (
                await host.quiet(20)
                if value is None
                else await host.response() == f"23 02 {answer} {value:02X}"
            )


@directed("P312-RSP-22", "P312-MON-05", "P312-RSP-10")
async def p312_reports_that_vanish_and_that_stay(dut: Any) -> None:
    host = await Host.start(dut, message(Code.ENCODE, "03 0002"), message(Code.IN_POSITION, "01 0002"))
    # While an answer is unread, the encoder moves out of both windows and back. This discards the report of
    # the monitor that reports automatically, but not that of the monitor that reports only once.
    await host.issue(message(Code.VERSION))
    await host.wait()
    await encoder(host, 3)
    await host.pause(20)
    await encoder(host, -1)
    assert await host.response() == message(Code.VERSION, "12")
    assert await host.response() == message(Answer.POSITION_CHANGE, "01", source=SPONTANEOUS)
    assert await host.quiet()
    # A report is loaded, and then the distance returns into the window. After the report has been read, the
    # return counts as another change.
    await encoder(host, 1)
    await host.pause(20)
    await encoder(host, -1)
    assert [await host.response(), await host.response()] == [
        message(Answer.ENCODE_CHANGE, "01", source=SPONTANEOUS),
        message(Answer.ENCODE_CHANGE, "00", source=SPONTANEOUS),
    ]
    assert await host.quiet()
    # The encode monitor is disabled while its report waits for another report to be read: the waiting report
    # is discarded.
    await host.ask(message(Code.IN_POSITION, "03 0002"))
    await encoder(host, 1)
    await host.issue(message(Code.ENCODE, "00 0002"))
    assert [await host.response(), await host.response()] == [
        message(Answer.POSITION_CHANGE, "01", source=SPONTANEOUS),
        message(Code.ENCODE),
    ]
    assert await host.quiet()


@directed("P312-RSP-22", "P312-MON-05")
async def p312_return_as_the_report_is_loaded(dut: Any) -> None:
    """The distance returns into the window at each cycle around the end of a read, which loads the report."""
    counts = set()
    for delay in range(1, 20):
        host = await Host.start(dut, message(Code.ENCODE, "03 0002"))
        await host.issue(message(Code.VERSION))
        await host.wait()
        await encoder(host, 3)
        await host.pause(20)
        for _ in message(Code.VERSION, "12").split()[1:]:
            await host.read(DRR)
        strobe = {0: {"cs_n": 0, "oe_n": 0, "rs": DRR}, 5: {"cs_n": 1, "oe_n": 1}}
        edge = {delay: {"epin": 1, "epdir": 1}, delay + 4: {"epin": 0}}
        for cycle in range(40):
            host.bench.set(**strobe.get(cycle, {}), **edge.get(cycle, {}))
            await host.pause(1)
        reports = await encode_reports(host)
        assert reports in ([], ["01", "00"]), f"{reports} at delay {delay}"
        counts.add(len(reports))
    assert counts == {0, 2}


@directed("P312-MON-05", "P312-RSP-22")
async def p312_a_short_departure_is_reported_as_one(dut: Any) -> None:
    """With RES = 0, pulse 3 leaves the window; at each cycle around it, an encoder edge returns into it."""
    counts = set()
    for delay in range(-4, 12):
        host = await Host.start(dut, *TF, message(Code.ENCODE, "01 0002"))
        await host.issue(message(Code.CONSTANT, "00 0190 00000003"))
        await host.bench.until(await host.pulse(2) + 0x190 * TICK + delay)
        await encoder(host, 1)
        reports = await encode_reports(host)
        assert reports in ([], ["01"]), f"{reports} at delay {delay}"
        counts.add(len(reports))
    assert counts == {0, 1}


@directed("P312-MON-03", "P312-MON-04")
async def p312_in_position_keeps_still_during_output(dut: Any) -> None:
    host = await Host.start(dut, *TF, message(Code.IN_POSITION, "03 0001"))
    await host.ask(message(Code.CONSTANT, "00 0190 00000004"))
    mark = host.mark
    await host.pulse(3, 20)
    # The distance is now outside the window, but is not compared. It is inside again when the pulse output
    # ends.
    assert await host.ask(message(Code.STATUS)) == message(Code.STATUS, "08 08 00")
    host.mark = mark
    await host.pulse(4, 20)
    await encoder(host, 4)
    assert await host.response() == stopped(0x40, 4) and await host.quiet()
    await host.ask(message(Code.CONSTANT, "00 0190 00000002"))
    assert {await host.response(), await host.response()} == {
        stopped(0x40, 6),
        message(Answer.POSITION_CHANGE, "01", source=SPONTANEOUS),
    }
    # In the END wait, the pulse output has already ended.
    await host.ask(message(Code.END_TERMINAL, "01"))
    await host.ask(message(Code.CONSTANT, "40 0190 00000002"))
    assert (
        await host.response() == message(Answer.POSITION_CHANGE, "00", source=SPONTANEOUS)
        and host.condition == 0x08
    )


@directed("P312-OUT-03", "P312-CMD-04", "P312-CMD-44", "P312-CHK-49", "P312-MOT-05")
async def p312_interlock_by_its_position(dut: Any) -> None:
    host = await Host.start(dut, *TF, message(Code.INTERLOCK_POSITION, "00000003"))
    for sign, first in ((0x00, 3), (0x40, 3)):
        # A motion that starts at the interlock position does not trigger the interlock; a motion that arrives
        # from either side does.
        await host.ask(message(Code.POSITION_SET, f"00 {first if sign else 0:08X}"))
        assert await host.ask(message(Code.INTERLOCK)) == message(Code.INTERLOCK, "01")
        assert await host.ask(message(Code.STATUS)) == message(Code.STATUS, "40 02 00")
        if sign:
            await host.ask(message(Code.CONSTANT, "40 0190 00000002"))
            assert await host.response() == stopped(0x40, 1) and host.out("intlk_n") == 0
        await host.ask(message(Code.CONSTANT, "00 0190 00000004"))
        mark = host.mark
        assert await host.response() == message(Answer.INTERLOCK_END, source=SPONTANEOUS)
        (edge,) = host.bench.rises("intlk_n", mark)
        number = 2 if sign else 3
        host.mark = mark
        assert 0 <= edge - host.pulses()[number - 1] <= 4
        assert (await host.response())[:11] == "23 06 E0 40"
        # The interlock position stays stored; without instruction 44 it has no effect.
        await host.ask(message(Code.CONSTANT, "40 0190 00000004"))
        await host.response()
        assert await host.quiet()
    assert await host.ask(message(Code.INTERLOCK)) == message(Code.INTERLOCK, "01")
    assert await host.ask(message(Code.INTERLOCK)) == message(Code.INTERLOCK, "00")
    assert host.out("intlk_n") == 1 and await host.ask(message(Code.STATUS)) == message(
        Code.STATUS, "00 02 00"
    )
    # The position is set while the interlock is active. A setting that makes position and interlock position
    # equal does not trigger the interlock either.
    await host.ask(message(Code.INTERLOCK))
    await host.ask(message(Code.POSITION_SET, "00 00000003"))
    assert await host.quiet() and host.out("intlk_n") == 0


@directed("P312-MON-10", "P312-CMD-28", "P312-RSP-21", "P312-CHK-50", "P312-RSP-10")
async def p312_input_changes_are_sampled(dut: Any) -> None:
    host = await Host.start(dut)
    await host.pins(auxi=0x0F)
    await host.ask(message(Code.MASK, "FF 3C"))
    base = None
    # A level that is shorter than a sample period is detected only if it is present at the sample.
    for level in (0x33, 0x0F, 0x03, 0x3F):
        await host.pins(auxi=level)
        await host.wait()
        now = host.t
        await host.response()
        if base is not None:
            assert (now - base) % 800 < 60 or (now - base) % 800 > 740
        base = now
    # Bits outside the mask are not reported.
    await host.pins(auxi=0xFC)
    assert await host.quiet(2000)
    for first, second in ((0xE0, 0xFC), (0xC0, 0xFC)):
        await host.pause(800 - (host.t - base) % 800 + 100)
        await host.pins(auxi=first)
        await host.pause(300)
        await host.pins(auxi=second)
        assert await host.quiet(2000)
    # Mask 0 disables the monitor. Another instruction 28 samples a new reference value and discards pending
    # reports.
    await host.issue(message(Code.MASK, "01 00"))
    await host.pins(auxi=0xFF)
    assert await host.response() == message(Code.MASK) and await host.quiet(2000)
    await host.ask(message(Code.MASK, "01 81"))
    assert await host.quiet(2000)
    await host.issue(message(Code.VERSION))
    await host.wait()
    await host.pins(auxi=0x7F)
    await host.pause(2000)
    await host.read(7), await host.read(7), await host.read(7), await host.read(7)
    assert await host.response() == message(Answer.INPUT_CHANGE, "00 80", source=SPONTANEOUS)
    # A pending report is discarded, but a report in the read window is not.
    await host.pins(auxi=0xFE)
    await host.wait()
    await host.pins(auxi=0x7F)
    await host.pause(2000)
    await host.issue(message(Code.MASK, "01 00"))
    assert [await host.response(), await host.response()] == [
        message(Answer.INPUT_CHANGE, "00 81", source=SPONTANEOUS),
        message(Code.MASK),
    ]
    assert await host.quiet(2000)
    # With bit 0 of the flags = 0, the monitor sends only one report.
    await host.ask(message(Code.MASK, "00 01"))
    await host.pins(auxi=0x00)
    assert await host.response() == message(Answer.INPUT_CHANGE, "00 01", source=SPONTANEOUS)
    await host.pins(auxi=0x01)
    assert await host.quiet(2000)
