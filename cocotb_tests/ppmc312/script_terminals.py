"""Terminals, timers, positions, monitors and status of the PPMC-312 at their pins (chapters 3.4, 7)."""

from __future__ import annotations

from cocotb_tests.harness.verifies import verifies
from cocotb_tests.ppmc312.host import T1, TF, Host, clean
from cocotb_tests.ppmc312.words import message
from openppmc.model.ppmc312.codes import SPONTANEOUS, Answer, Code, Source

CLEAR = 393_216


def stopped(cause: int, position: int) -> str:
    return clean(message(Answer.STOPPED, f"{cause:02X} {position & 0xFFFFFFFF:08X}", source=SPONTANEOUS))


def encoder(host: Host, count: int) -> None:
    """So many edges of the encoder, negative ones CCW, as fast as they may come."""
    for _ in range(abs(count)):
        host.pins(epin=1, epdir=int(count < 0))
        host.pause(2)
        host.pins(epin=0)
        host.pause(2)


@verifies(
    "P312-CMD-20", "P312-CMD-21", "P312-CMD-23", "P312-CMD-25", "P312-CMD-26", "P312-CMD-27", "P312-CMD-40"
)
@verifies("P312-CMD-4D")
def test_pins_and_reads() -> None:
    host = Host(*TF)
    for block, name, level in (
        (message(Code.EXCITATION_ON), "exon_n", 0),
        (message(Code.EXCITATION_ON), "exon_n", 0),
        (message(Code.EXCITATION_OFF), "exon_n", 1),
        (message(Code.ZERO_CLAMP), "zclmp_n", 0),
        *((message(Code.OUTPUT, f"{1 << n:02X}"), "auxo_n", 0x3F ^ 1 << n & 0x3F) for n in range(8)),
        (message(Code.OUTPUT, "3F"), "auxo_n", 0),
    ):
        assert host.ask(block) == f"03 01 {block[6:8]}"
        assert host.out(name) == level
    for auxi in (0x01, 0x80, 0x5A, 0xFF):
        host.pins(auxi=auxi)
        assert host.ask(message(Code.INPUT)) == message(Code.INPUT, f"{auxi:02X}")
    first = ("alm_n", "end_n", "index_n", "org_n", "fhl_n", "bhl_n", "fl_n", "bl_n")
    for place, pin in enumerate(first[1:], 1):
        host.pins(**{pin: 0})
        assert host.ask(message(Code.TERMINALS)) == message(
            Code.TERMINALS, f"{0xFF & ~(0x80 >> place):02X} E0"
        ), pin
        host.pins(**{pin: 1})
    for pin, value in (("evt1_n", "60"), ("evt0_n", "A0"), ("run", "C0")):
        host.pins(**{pin: 0})
        assert host.ask(message(Code.TERMINALS)) == message(Code.TERMINALS, f"FF {value}")
        host.pins(**{pin: 1})
    host.pins(alm_n=0)
    assert host.response() == message(Answer.ALARM, "00", source=SPONTANEOUS)
    assert host.ask(message(Code.TERMINALS)) == message(Code.TERMINALS, "7F E0")
    assert host.ask(message(Code.VERSION)) == message(Code.VERSION, "12")
    # exon_n, zclmp_n and outputs have nothing to do with pulses.
    assert (host.out("exon_n"), host.out("zclmp_n"), host.out("auxo_n")) == (1, 0, 0)


@verifies("P312-CMD-22", "P312-CMD-24", "P312-INP-33", "P312-CHK-37")
def test_clear_pulses() -> None:
    host = Host(message(Code.COUNTER_CLEAR), message(Code.ALARM_CLEAR))
    first = {name: host.model.log.falls(name)[0] for name in ("cclr_n", "aclr_n")}
    host.pause(CLEAR + 100)
    for name, fall in first.items():
        assert host.model.log.of(name) == [(fall, 0), (fall + CLEAR, 1)]
    # Both run on their own; 24 again restarts its time only.
    host.ask(message(Code.ALARM_CLEAR))
    again = host.model.log.falls("aclr_n")[-1]
    host.pause(200_000)
    host.ask(message(Code.COUNTER_CLEAR))
    host.issue(message(Code.ALARM_CLEAR))
    restart = host.header
    host.response()
    host.pause(2 * CLEAR)
    assert host.model.log.falls("aclr_n")[-1] == again
    assert 0 < host.model.log.rises("aclr_n")[-1] - CLEAR - restart < 100
    fall, rise = host.model.log.of("cclr_n")[-2:]
    assert rise[0] - fall[0] == CLEAR


@verifies("P312-GEN-02", "P312-CMD-22", "P312-OUT-01", "P312-MOT-01", "P312-MOT-03", "P312-MON-10")
def test_times_of_the_crystal_at_another_clock() -> None:
    host = Host(*TF, clk_hz=27_000_000)
    host.ask(message(Code.COUNTER_CLEAR))
    host.ask(message(Code.MASK, "01 01"))
    host.ask(message(Code.CONSTANT, "40 0190 00000002"))
    assert host.response() == stopped(0x40, -2)
    turned = host.model.log.rises("dir", host.mark)[0]
    assert host.pulses()[0] - turned in (135, 136, 137)
    changes = host.model.log.of("pout", host.mark)
    assert [b[0] - a[0] for a, b in zip(changes[::2], changes[1::2], strict=True)] == [135, 135]
    last = host.pulses()[-1]
    host.pause(2_720_000)
    (fall, _), (rise, _) = host.model.log.of("cclr_n")
    assert rise - fall == CLEAR * 27 // 16
    assert abs(host.model.log.falls("cd_n")[0] - last - 2_700_000 - 10_800) <= 5


@verifies("P312-OUT-01", "P312-CHK-45", "P312-MOT-06")
def test_current_reduction_after_each_kind_of_end() -> None:
    # Counted from the end of pulse output, which an immediate stop does not draw out.
    host = Host(*TF, message(Code.END_TERMINAL, "01"))
    host.ask(message(Code.FOREVER_CONSTANT, "00 0190"))
    host.pulse(2, 2000)
    host.pins(fl_n=0)
    low = host.t
    host.pause(1_600_200)
    (edge,) = host.model.log.falls("cd_n")
    assert 0 <= edge - low - 1_600_000 < 10
    assert host.condition == 0x08  # END wait does not hold it up
    host.pins(end_n=0, fl_n=1)
    host.response()
    # alm_n takes it down at once, whatever the state; t0 brings it up.
    host.pins(end_n=1)
    host.ask(message(Code.END_TERMINAL, "00"))
    host.ask(message(Code.STEP, "00"))
    assert host.out("cd_n") == 1
    host.response()
    host.pins(alm_n=0)
    low = host.t
    host.pause(10)
    assert 0 < host.model.log.falls("cd_n")[-1] - low < 8
    host.response()
    host.pins(alm_n=1)
    host.pause(10)
    assert host.out("cd_n") == 0


@verifies("P312-OUT-02", "P312-MON-06", "P312-CHK-47", "P312-CMD-23")
def test_zero_clamp() -> None:
    host = Host(*TF, message(Code.ZERO_CLAMP))
    host.issue(message(Code.STEP, "40"))
    host.response()
    turned = host.model.log.rises("dir", host.mark)
    assert host.model.log.rises("zclmp_n", host.mark) == turned
    host.response()
    assert host.out("zclmp_n") == 1
    # By FO: when inside, or by END, after the output has ended; not without EN.
    for flags, distance, end_n, level in (
        (5, 3, 1, 0),
        (5, 2, 1, 1),
        (5, 2, 0, 0),
        (4, 9, 0, 1),
        (1, 9, 0, 1),
    ):
        host = Host(*TF, message(Code.IN_POSITION, f"{flags:02X} {distance:04X}"))
        host.pins(end_n=end_n)
        host.ask(message(Code.CONSTANT, "00 0190 00000003"))
        host.pause(12_000)
        assert host.out("zclmp_n") == 1
        host.pause(10_000)
        assert host.out("zclmp_n") == level, (flags, distance, end_n)


@verifies("P312-CMD-42", "P312-CMD-43", "P312-MON-01", "P312-MOT-05", "P312-GEN-03")
def test_positions() -> None:
    host = Host(*TF)
    host.ask(message(Code.POSITION_SET, "00 01234567"))
    host.ask(message(Code.POSITION_SET, "01 89ABCDEF"))
    encoder(host, 5)
    encoder(host, -7)
    assert host.ask(message(Code.POSITION_READ, "00")) == message(Code.POSITION_READ, "00 01 23 45 67")
    assert host.ask(message(Code.POSITION_READ, "01")) == message(Code.POSITION_READ, "01 89 AB CD ED")
    host.ask(message(Code.POSITION_SET, "01 00000001"))
    encoder(host, -3)
    assert host.ask(message(Code.POSITION_READ, "01")) == message(Code.POSITION_READ, "01 FF FF FF FE")
    encoder(host, 4)
    assert host.ask(message(Code.POSITION_READ, "01")) == message(Code.POSITION_READ, "01 00 00 00 02")
    # Falling edges and the direction alone do not count.
    for levels in ({"epin": 1, "epdir": 1}, {"epdir": 0}, {"epdir": 1}, {"epin": 0}, {"epdir": 0}):
        host.pins(**levels)
        host.pause(4)
    assert host.ask(message(Code.POSITION_READ, "01")) == message(Code.POSITION_READ, "01 00 00 00 01")
    # Reads while counting: POS follows pout at once.
    host.ask(message(Code.POSITION_SET, "00 0000FFFE"))
    host.ask(message(Code.FOREVER_CONSTANT, "00 0190"))
    mark = host.mark
    for number, value in ((1, "00 00 FF FF"), (2, "00 01 00 00"), (3, "00 01 00 01")):
        host.mark = mark
        host.pulse(number, 2)
        assert host.ask(message(Code.POSITION_READ, "00")) == message(Code.POSITION_READ, f"00 {value}")
    assert host.ask(message(Code.POSITION_SET, "00 00000000")) == message(Answer.STATUS, "00 08")


@verifies("P312-MON-01", "P312-MON-02", "P312-MON-03", "P312-MON-04", "P312-MON-05", "P312-RSP-22")
@verifies("P312-CMD-02", "P312-CMD-03", "P312-CHK-46", "P312-CHK-48", "P312-CMD-4D")
def test_windows_at_their_edges() -> None:
    for code, answer, enabled, outside in (("02", "E4", 0x08, 0x01), ("03", "E3", 0x10, 0x02)):
        host = Host(f"03 04 {code} 03 0004")
        for edges, value in ((4, None), (1, 1), (-1, 0), (-9, 1), (1, 0), (4, None), (4, None), (1, 1)):
            encoder(host, edges)
            if value is None:
                assert host.quiet(20)
                continue
            assert host.response() == f"23 02 {answer} {value:02X}"
            assert host.ask(message(Code.STATUS)) == message(
                Code.STATUS, f"{enabled | outside * value:02X} 01 00"
            )
        # Off: nothing more; enabled again it begins inside, and once with RES = 0.
        assert host.ask(f"03 04 {code} 00 0004") == f"03 01 {code}"
        assert host.ask(message(Code.STATUS)) == message(Code.STATUS, "00 01 00")
        host.ask(f"03 04 {code} 01 0004")
        assert host.response() == f"23 02 {answer} 01"
        assert host.ask(message(Code.STATUS)) == message(Code.STATUS, "00 01 00")
        encoder(host, -5)
        assert host.quiet(20)
        # Distances of a large range, signed.
        host.ask(message(Code.POSITION_SET, "00 80000000"))
        host.ask(message(Code.POSITION_SET, "01 7FFF0001"))
        host.ask(f"03 04 {code} 03 FFFF")
        assert host.quiet(20)
        encoder(host, -1)
        assert host.response() == f"23 02 {answer} 01"
        for encoder_position, value in (("8000FFFF", 0), ("80010000", 1), ("00000000", None)):
            host.ask(message(Code.POSITION_SET, f"01 {encoder_position}"))
            assert host.quiet(20) if value is None else host.response() == f"23 02 {answer} {value:02X}"


@verifies("P312-RSP-22", "P312-MON-05", "P312-RSP-10")
def test_reports_that_vanish_and_that_stay() -> None:
    host = Host(message(Code.ENCODE, "03 0002"), message(Code.IN_POSITION, "01 0002"))
    # Behind an answer: outside and back again leaves nothing of the automatic one; the single one stays.
    host.issue(message(Code.VERSION))
    host.wait()
    encoder(host, 3)
    host.pause(20)
    encoder(host, -1)
    assert host.response() == message(Code.VERSION, "12")
    assert host.response() == message(Answer.POSITION_CHANGE, "01", source=SPONTANEOUS)
    assert host.quiet()
    # Loaded, then the value returns: the report is read, and the return is a change again.
    encoder(host, 1)
    host.pause(20)
    encoder(host, -1)
    assert [host.response(), host.response()] == [
        message(Answer.ENCODE_CHANGE, "01", source=SPONTANEOUS),
        message(Answer.ENCODE_CHANGE, "00", source=SPONTANEOUS),
    ]
    assert host.quiet()
    # Disabled while it waits behind another one.
    host.ask(message(Code.IN_POSITION, "03 0002"))
    encoder(host, 1)
    host.issue(message(Code.ENCODE, "00 0002"))
    assert [host.response(), host.response()] == [
        message(Answer.POSITION_CHANGE, "01", source=SPONTANEOUS),
        message(Code.ENCODE),
    ]
    assert host.quiet()


@verifies("P312-MON-03", "P312-MON-04")
def test_in_position_keeps_still_during_output() -> None:
    host = Host(*TF, message(Code.IN_POSITION, "03 0001"))
    host.ask(message(Code.CONSTANT, "00 0190 00000004"))
    mark = host.mark
    host.pulse(3, 20)
    # Outside by now, but not looked at; inside again when the output ends.
    assert host.ask(message(Code.STATUS)) == message(Code.STATUS, "08 08 00")
    host.mark = mark
    host.pulse(4, 20)
    encoder(host, 4)
    assert host.response() == stopped(0x40, 4) and host.quiet()
    host.ask(message(Code.CONSTANT, "00 0190 00000002"))
    assert {host.response(), host.response()} == {
        stopped(0x40, 6),
        message(Answer.POSITION_CHANGE, "01", source=SPONTANEOUS),
    }
    # In END wait the output is over.
    host.ask(message(Code.END_TERMINAL, "01"))
    host.ask(message(Code.CONSTANT, "40 0190 00000002"))
    assert (
        host.response() == message(Answer.POSITION_CHANGE, "00", source=SPONTANEOUS)
        and host.condition == 0x08
    )


@verifies("P312-OUT-03", "P312-CMD-04", "P312-CMD-44", "P312-CHK-49", "P312-MOT-05")
def test_interlock() -> None:
    host = Host(*TF, message(Code.INTERLOCK_POSITION, "00000003"))
    for sign, first in ((0x00, 3), (0x40, 3)):
        # Standing on it at the start does not count; arriving from either side does.
        host.ask(message(Code.POSITION_SET, f"00 {first if sign else 0:08X}"))
        assert host.ask(message(Code.INTERLOCK)) == message(Code.INTERLOCK, "01")
        assert host.ask(message(Code.STATUS)) == message(Code.STATUS, "40 02 00")
        if sign:
            host.ask(message(Code.CONSTANT, "40 0190 00000002"))
            assert host.response() == stopped(0x40, 1) and host.out("intlk_n") == 0
        host.ask(message(Code.CONSTANT, "00 0190 00000004"))
        mark = host.mark
        assert host.response() == message(Answer.INTERLOCK_END, source=SPONTANEOUS)
        (edge,) = host.model.log.rises("intlk_n", mark)
        number = 2 if sign else 3
        host.mark = mark
        assert 0 <= edge - host.pulses()[number - 1] <= 4
        assert host.response()[:11] == "23 06 E0 40"
        # The position stays; without 44 nothing happens there.
        host.ask(message(Code.CONSTANT, "40 0190 00000004"))
        host.response()
        assert host.quiet()
    assert host.ask(message(Code.INTERLOCK)) == message(Code.INTERLOCK, "01")
    assert host.ask(message(Code.INTERLOCK)) == message(Code.INTERLOCK, "00")
    assert host.out("intlk_n") == 1 and host.ask(message(Code.STATUS)) == message(Code.STATUS, "00 02 00")
    # Set while it runs: equality by setting does not count either.
    host.ask(message(Code.INTERLOCK))
    host.ask(message(Code.POSITION_SET, "00 00000003"))
    assert host.quiet() and host.out("intlk_n") == 0


@verifies("P312-MON-10", "P312-CMD-28", "P312-RSP-21", "P312-CHK-50", "P312-RSP-10")
def test_input_changes_are_sampled() -> None:
    host = Host()
    host.pins(auxi=0x0F)
    host.ask(message(Code.MASK, "FF 3C"))
    base = None
    # Shorter than a sample period: seen only if it stands at the sample.
    for level in (0x33, 0x0F, 0x03, 0x3F):
        host.pins(auxi=level)
        host.wait()
        now = host.t
        host.response()
        if base is not None:
            assert (now - base) % 800 < 60 or (now - base) % 800 > 740
        base = now
    # Bits outside of the mask do not report.
    host.pins(auxi=0xFC)
    assert host.quiet(2000)
    for first, second in ((0xE0, 0xFC), (0xC0, 0xFC)):
        host.pause(800 - (host.t - base) % 800 + 100)
        host.pins(auxi=first)
        host.pause(300)
        host.pins(auxi=second)
        assert host.quiet(2000)
    # Mask 0 stops it, a new 28 takes a new former value and drops what waits.
    host.issue(message(Code.MASK, "01 00"))
    host.pins(auxi=0xFF)
    assert host.response() == message(Code.MASK) and host.quiet(2000)
    host.ask(message(Code.MASK, "01 81"))
    assert host.quiet(2000)
    host.issue(message(Code.VERSION))
    host.wait()
    host.pins(auxi=0x7F)
    host.pause(2000)
    host.read(7), host.read(7), host.read(7), host.read(7)
    assert host.response() == message(Answer.INPUT_CHANGE, "00 80", source=SPONTANEOUS)
    # What waits behind a report in the window is dropped, that one is not.
    host.pins(auxi=0xFE)
    host.wait()
    host.pins(auxi=0x7F)
    host.pause(2000)
    host.issue(message(Code.MASK, "01 00"))
    assert [host.response(), host.response()] == [
        message(Answer.INPUT_CHANGE, "00 81", source=SPONTANEOUS),
        message(Code.MASK),
    ]
    assert host.quiet(2000)
    # Single mode.
    host.ask(message(Code.MASK, "00 01"))
    host.pins(auxi=0x00)
    assert host.response() == message(Answer.INPUT_CHANGE, "00 01", source=SPONTANEOUS)
    host.pins(auxi=0x01)
    assert host.quiet(2000)


@verifies(
    "P312-MOT-35", "P312-STA-02", "P312-CHK-44", "P312-CMD-06", "P312-BAD-18", "P312-BAD-19", "P312-CMD-45"
)
def test_end_wait() -> None:
    host = Host(*TF, message(Code.END_TERMINAL, "01"))
    assert host.ask(message(Code.STATUS)) == message(Code.STATUS, "04 02 00")
    for stop, cause in ((message(Code.STOP, "00"), 0x04), (message(Code.SLOW_STOP, "00"), 0x10)):
        host.ask(message(Code.FOREVER_CONSTANT, "00 0190"))
        mark = host.mark
        host.pulse(2, 20)
        host.ask(stop)
        host.pause(7000)
        assert host.condition == 0x08 and host.quiet(200)
        # Nothing of all this does anything; overrides register.
        for block in (
            message(Code.CHANGE, "00 0064"),
            message(Code.RAMP_CHANGE, "00 00C8"),
            message(Code.STOP, "00"),
            message(Code.SLOW_STOP, "00"),
        ):
            assert host.ask(block) == clean(f"03 01 {block[6:8]}")
        assert host.ask(message(Code.CHANGE, "07 00C8")) == message(Answer.REGISTERED)
        assert (
            host.ask(message(Code.FOREVER_CONSTANT, "00 0190"))
            == host.ask(message(Code.STEP, "00"))
            == message(Answer.STATUS, "00 08")
        )
        host.pins(fl_n=0, org_n=0, run=0)
        host.pause(200)
        host.pins(fl_n=1, org_n=1, run=1)
        host.mark = mark
        count = len(host.pulses())
        host.pins(end_n=0)
        answer = host.response()
        assert answer[:11] == f"23 06 E0 {cause:02X}" and count <= 3
        host.pins(end_n=1)
    # END low already: no wait; 06 00 in END wait, FF in END wait.
    host.pins(end_n=0)
    host.ask(message(Code.STEP, "00"))
    assert host.response()[:11] == "23 06 E0 40"
    host.pins(end_n=1)
    host.ask(message(Code.STEP, "00"))
    host.pause(7000)
    assert host.condition == 0x08
    assert host.ask(message(Code.END_TERMINAL, "00")) == message(Code.END_TERMINAL, "00")
    assert host.response()[:11] == "23 06 E0 40"
    host.ask(message(Code.END_TERMINAL, "01"))
    host.ask(message(Code.STEP, "00"))
    host.pause(7000)
    assert host.ask(message(Code.RESET)) == message(Code.RESET) and host.condition == 0x01 and host.quiet()


@verifies("P312-INP-01", "P312-TIM-14", "P312-TIM-16")
def test_datasheet_recognition_times() -> None:
    host = Host(*TF, message(Code.END_TERMINAL, "01"), timing="DATASHEET")
    host.ask(message(Code.STEP, "00"))
    host.pause(16_000)
    assert host.condition == 0x08
    # Low for less than 200 us: 27 shows it, nothing else sees it.
    host.pins(end_n=0, fl_n=0)
    assert host.ask(message(Code.TERMINALS)) == message(Code.TERMINALS, "BD E0")
    host.pins(end_n=1, fl_n=1)
    host.pause(5000)
    assert host.condition == 0x08
    low = host.t
    host.pins(end_n=0)
    host.wait()
    assert 3200 <= host.t - low < 3300
    assert host.response() == stopped(0x40, 1)
    for _ in range(3):
        host.pins(alm_n=0)
        host.pause(3190)
        host.pins(alm_n=1)
        host.pause(3)
    assert host.condition == 0x02 and host.quiet(100)
    host.pins(alm_n=0)
    low = host.t
    host.wait()
    assert 3200 <= host.t - low < 3300 and host.condition == 0x10


@verifies("P312-TIM-12", "P312-TIM-20", "P312-OVR-12", "P312-INP-31")
def test_datasheet_triggered_stop() -> None:
    """80 by EVT: 350 us after the filtered edge; by position at once."""
    host = Host(*TF, message(Code.STOP, "05"), timing="DATASHEET")
    host.ask(message(Code.FOREVER_CONSTANT, "00 0064"))
    mark = host.mark
    host.pulse(3, 10)
    low = host.t
    host.pins(evt0_n=0)
    assert host.response() == message(Code.STOP, source=Source.OVERRIDE)
    host.mark = mark
    assert 400_000 + 5600 - 1700 <= host.pulses()[-1] - low <= 400_000 + 5620
    assert host.response() == stopped(0x04, len(host.pulses()))
    assert host.ask(T1)[:5] == "03 01"


@verifies("P312-CMD-25", "P312-CMD-27", "P312-INP-01", "P312-EVT-01")
def test_25_and_27_show_all_pins_at_one_clk() -> None:
    """Pins that change together are seen together, whoever asks, up to one clk and not after it."""
    names = ("alm_n", "end_n", "index_n", "org_n", "fhl_n", "bhl_n", "fl_n", "bl_n", "evt1_n", "run")
    pins = dict.fromkeys(names, 0)
    for code, levels, shown in (
        ("27", pins, {"03": ("FF E0", "00 40"), "0B": ("FF A0", "00 00")}),
        ("25", {"auxi": 0x5A}, {"03": ("FF", "5A"), "0B": ("FF", "5A")}),
    ):
        for source, (before, after) in shown.items():
            seen = []
            for clk in range(14, 34):
                host = Host(*TF, message(Code.EVENT_SET, f"00 03 01 {code}"))
                host.pins(auxi=0xFF)
                host.pause(800)
                if source == "03":
                    host.put(f"03 01 {code}")
                    host.go(host.header + clk)
                else:
                    host.pins(evt0_n=0)
                    host.pause(clk - 1)
                host.pins(**levels)
                answer = next(text for text in iter(host.response, "") if text.startswith(source))
                assert answer[6:8] == code and answer[9:] in (before, after), clk
                seen.append(answer[9:] == after)
            assert seen == sorted(seen, reverse=True) and len(set(seen)) == 2, source
