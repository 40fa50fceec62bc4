"""The parallel bus of the PPMC-312 at its limits: strobes, windows, order of accesses, resets, mode pins."""

from __future__ import annotations

import pytest

from cocotb_tests.harness.verifies import verifies
from cocotb_tests.ppmc312.host import CSR, DRR, DWR, MREF, MWEF, RAR, RCR, T1, TF, WAR, WCR, Host
from cocotb_tests.ppmc312.words import message
from openppmc.model.ppmc312.codes import SPONTANEOUS, Answer, Code

ADDRESSES = range(8)


def strobe(host: Host, length: int, gap: int = 3, **levels: int) -> None:
    """Bus pins for some clk, then idle for some."""
    host.model.pins(host.t, **levels)
    host.model.pins(host.t + length, cs_n=1, we_n=1, oe_n=1)
    host.t += length + gap


@verifies("P312-PAR-10", "P312-GEN-01")
def test_write_takes_the_last_sample() -> None:
    host = Host()
    model = host.model
    # Register and data change during the strobe; the last level before its end counts.
    for end, levels in ((2, {"cs_n": 1}), (2, {"we_n": 1}), (1, {"cs_n": 1, "we_n": 1})):
        model.pins(host.t, cs_n=0, we_n=0, rs=WCR, d_i=0x00)
        model.pins(host.t + 1, rs=CSR, d_i=0x70)
        model.pins(host.t + 1 + end, **levels)
        model.pins(host.t + 2 + end, cs_n=1, we_n=1, rs=7, d_i=0x8F)
        host.t += 5 + end
        assert host.read(CSR) == 0x74
        host.write(CSR, 0x00)


@verifies("P312-PAR-10", "P312-PAR-05", "P312-GEN-04")
def test_shortest_strobes_back_to_back() -> None:
    host = Host()
    for _ in range(3):
        for reg, byte in ((WCR, 0x20), (WAR, 0x1C), (DWR, 0x2A), (DWR, 0x26), (DWR, 0x02), (DWR, 0x03)):
            strobe(host, 3, 3, cs_n=0, we_n=0, rs=reg, d_i=byte)
        assert host.response() == message(Code.OUTPUT) and host.out("auxo_n") == 0x15
        host.ask(message(Code.OUTPUT, "00"))


@verifies("P312-PAR-11", "P312-PAR-09")
def test_reads_drive_the_bus() -> None:
    host = Host(message(Code.EXCITATION_ON))
    host.issue(message(Code.VERSION))
    host.wait()
    for reg, value in zip(ADDRESSES, (0x00, 0, 0, 0x3C, 0, 0, 0, 0x12), strict=True):
        mark = host.t
        strobe(host, 9, 6, cs_n=0, oe_n=0, rs=reg)
        host.sync()
        (rise,), (fall,) = host.model.log.rises("d_oe", mark), host.model.log.falls("d_oe", mark)
        assert rise - mark in range(0, 5) and fall - mark - 9 in range(0, 5)
        assert host.out("d_o") == value, reg
        assert len([edge for edge in host.model.log.of("d_o", mark) if edge[0] > mark + 4]) == 0
    # One byte is gone; a rewind brings it back.
    assert host.read(RAR) == 0x3D and host.read(RCR) == 0 and host.read(RAR) == 0x3C
    assert host.response() == message(Code.VERSION, "12")


@verifies("P312-PAR-11", "P312-PAR-08")
def test_one_value_a_strobe() -> None:
    """A response that comes during a read of CSR, and one that goes, do not change what the strobe shows."""
    host = Host(T1)
    host.issue(message(Code.VERSION))
    mark = host.t
    strobe(host, 400, 6, cs_n=0, oe_n=0, rs=CSR)
    host.sync()
    assert len(host.model.log.of("d_o", mark)) <= 1 and host.read(CSR) == 0x00
    assert host.response() == message(Code.VERSION, "12")
    assert host.read(RAR) == 0x40 and host.read(DRR) == 0


@verifies("P312-PAR-11", "P312-CMD-FF", "P312-PAR-06")
def test_a_read_that_meets_the_software_reset() -> None:
    """Strobes that begin up to 40 clk after the header of FF: driven in time, one value, to their end."""
    for reg, most in ((CSR, 40), (DRR, 34)):  # later the answer is there, and it would be read
        seen = []
        for after in range(1, most + 1):
            host = Host()
            if reg == DRR:
                host.ask(message(Code.EXCITATION_ON))
                host.issue(message(Code.VERSION))
                host.wait()
            host.put(message(Code.RESET))
            host.go(host.header + after)
            mark = host.t
            strobe(host, 12, 6, cs_n=0, oe_n=0, rs=reg)
            host.sync()
            (rise,), (fall,) = host.model.log.rises("d_oe", mark), host.model.log.falls("d_oe", mark)
            assert rise - mark in range(0, 5) and fall - mark - 12 in range(0, 5), after
            assert not [edge for edge in host.model.log.of("d_o", mark) if edge[0] > rise], after
            seen.append(host.out("d_o"))
            host.pause(40)
            # Nothing of the strobe outlives the reset.
            assert host.response() == message(Code.RESET) and host.read(CSR) == MREF
        if reg == CSR:
            # Busy also where the strobe begins during the reset, then ready.
            assert seen[:24] == [MWEF | MREF] * 24 and MREF in seen and seen == sorted(seen, reverse=True)
        else:
            # The byte of the old response as long as there is one, then nothing.
            assert seen[:18] == [0x12] * 18 and seen[-1] == 0 and seen == sorted(seen, reverse=True)


@verifies("P312-PAR-11", "P312-PAR-10", "P312-PAR-12", "P312-CMD-FF")
def test_a_write_that_meets_the_software_reset() -> None:
    """CSR may be written at any time: before the reset it is cleared, after it it stands."""
    seen = []
    for after in range(1, 41):
        host = Host()
        host.put(message(Code.RESET))
        host.go(host.header + after)
        host.write(CSR, 0x70)
        assert host.response() == message(Code.RESET)
        seen.append(host.read(CSR) >> 4)
    assert seen[0] == 0 and seen[-1] == 7 and seen == sorted(seen)
    # The wait request of an access during the reset goes with EWRQ.
    for after in range(8, 32):
        host = Host()
        host.write(CSR, 0x40)
        host.put(message(Code.RESET))
        host.go(host.header + after)
        strobe(host, 4, 3, cs_n=0, we_n=0, rs=DWR)
        strobe(host, 4, 3, cs_n=0, we_n=0, rs=DWR)
        host.write(CSR, 0x40)
        strobe(host, 12, 6, cs_n=0, we_n=0, rs=DWR)
        assert host.response() == message(Code.RESET) and host.out("wrq_n") == 1


@verifies("P312-PAR-09", "P312-BAD-01", "P312-BAD-10")
def test_no_access() -> None:
    host = Host()
    mark = host.t
    for levels in (
        {"cs_n": 1, "we_n": 0},
        {"cs_n": 1, "oe_n": 0},
        {"cs_n": 0, "we_n": 0, "oe_n": 0},
        {"cs_n": 0},
    ):
        for reg in (CSR, WCR, DWR, DRR):
            strobe(host, 5, 4, rs=reg, d_i=0x70, **levels)
    host.sync()
    assert not host.model.log.rises("d_oe", mark)
    for reg in (1, 4, 6, 7):
        host.write(reg, 0x70)
    assert [host.read(reg) for reg in ADDRESSES] == [0x04, 0, 0, 0x40, 0, 0, 0, 0]


@verifies("P312-PAR-01", "P312-GEN-05", "P312-PAR-06")
def test_control_bits() -> None:
    host = Host()
    for byte in (0xFF, 0x8F, 0x40, 0x20, 0x10, 0x00, 0x70):
        host.write(CSR, byte)
        assert host.read(CSR) == 0x04 | byte & 0x70
    host.write(CSR, 0x30)
    host.issue(message(Code.OUTPUT, "FF"))
    host.write(CSR, 0x50)
    assert host.read(CSR) & 0x70 == 0x50
    assert host.response() == message(Code.OUTPUT) and host.out("auxo_n") == 0x00
    # Bits that the sheet prints as crosses.
    assert host.ask(message(Code.IN_POSITION, "FA 0001")) == message(Code.IN_POSITION)
    assert host.ask(message(Code.STATUS)) == message(Code.STATUS, "00 01 00")


@verifies("P312-PAR-03", "P312-PAR-04", "P312-PAR-05", "P312-BAD-02", "P312-BAD-03")
def test_write_window_in_any_order() -> None:
    host = Host()

    def data(*block: int) -> None:
        for byte in block:
            host.write(DWR, byte)

    # Armed once, the window stays open; WAR may come first.
    host.write(WAR, 0x1D)
    host.write(WCR, 0x20)
    data(0x40, 0x01, 0x03)
    assert host.response() == message(Code.VERSION, "12")
    host.write(WAR, 0x1D)
    data(0x40, 0x01, 0x03)
    assert host.response() == message(Code.VERSION, "12")
    # Disarmed in the middle, armed again: the bytes between are lost.
    host.write(WAR, 0x1D)
    data(0x40)
    host.write(WCR, 0x21)
    data(0x55, 0x56)
    host.write(WCR, 0x20)
    data(0x01, 0x03)
    assert host.response() == message(Code.VERSION, "12")
    # A new address forgets what was written.
    host.write(WAR, 0x1C)
    data(0x01, 0x26, 0x02)
    host.write(WAR, 0x1D)
    data(0x40, 0x01, 0x03)
    assert host.response() == message(Code.VERSION, "12") and host.out("auxo_n") == 0x3F
    # Outside: nothing is stored, and the pointer does not move, not even round and back to the top.
    for war in (0x20, 0x21, 0x3D, 0x80, 0xBD, 0xFF):
        host.write(WAR, war)
        data(*(0x40, 0x01, 0x03) * 13)
        assert host.quiet(200) and not host.read(CSR) & MWEF
    # A whole window, and the first and last address that work.
    host.put("03 1E" + " 40" * 30)
    assert host.response() == "03 1E F0 23" + " 40" * 28
    host.put("03", war=0x1F)
    assert host.response() == message(Answer.SIZE, "00")


@verifies("P312-PAR-06", "P312-BAD-02")
def test_writes_while_an_instruction_is_processed() -> None:
    host = Host()
    host.issue(T1)
    # None of these counts: the window stays armed, the pointer at its end.
    host.write(WCR, 0x00)
    host.write(WAR, 0x1D)
    for byte in (0x40, 0x01, 0x03):
        host.write(DWR, byte)
    assert host.read(CSR) == MWEF | MREF
    assert host.response() == message(Code.INITIAL)
    for byte in (0x40, 0x01, 0x03):
        host.write(DWR, byte)
    assert host.quiet(300)
    host.write(WAR, 0x1D)
    for byte in (0x40, 0x01, 0x03):
        host.write(DWR, byte)
    assert host.response() == message(Code.VERSION, "12")


@verifies("P312-PAR-07", "P312-BAD-08")
def test_reads_in_any_order() -> None:
    host = Host(message(Code.POSITION_SET, "00 12345678"))
    host.issue(message(Code.POSITION_READ, "00"))
    host.wait()
    want = [0x78, 0x56, 0x34, 0x12, 0x00, 0x42, 0x06, 0x03]
    for count in (0, 3, 7, 1):
        host.read(RCR)
        assert host.read(RAR) == 0x38
        assert [host.read(DRR) for _ in range(count)] == want[:count]
        assert host.read(RAR) == 0x38 + count and not host.read(CSR) & MREF
    # Writes to the same addresses are writes; the reading goes on.
    host.write(RCR, 0x00)
    host.write(DRR, 0x00)
    host.write(RAR, 0x00)
    assert host.read(RAR) == 0x39
    assert [host.read(DRR) for _ in range(7)] == want[1:]
    assert host.read(RAR) == 0x40 and host.read(CSR) & MREF
    assert host.read(RCR) == 0 and host.read(DRR) == 0 and host.read(RAR) == 0x40
    assert host.ask(message(Code.VERSION)) == message(Code.VERSION, "12")


@verifies("P312-PAR-02", "P312-PAR-08")
def test_interrupt_of_both_kinds() -> None:
    host = Host(T1)
    for enables, before, busy, waiting in (
        (0x20, 0, 1, 0),
        (0x10, 1, 1, 0),
        (0x30, 0, 1, 0),
        (0x00, 1, 1, 1),
    ):
        host.write(CSR, enables)
        host.pause(8)
        assert host.out("irq_n") == before
        host.issue(message(Code.VERSION))
        host.pause(8)
        assert host.out("irq_n") == busy, "while it is processed"
        host.wait()
        host.pause(8)
        assert host.out("irq_n") == waiting
        host.response()
        host.pause(9)
        assert host.out("irq_n") == before


@pytest.mark.parametrize("timing", ["FAST", "DATASHEET"])
@verifies("P312-PAR-12", "P312-TIM-15")
def test_wait_request_of_reads_and_writes(timing: str) -> None:
    host = Host(message(Code.VERSION), timing=timing)
    window = 6 if timing == "FAST" else 10
    for enabled in (0x40, 0x00):
        host.write(CSR, enabled)
        host.issue(message(Code.VERSION))
        host.wait()
        for gap in (window - 3, window + 3, 1, window, window - 1):
            mark = host.t
            strobe(host, 14, max(gap, 3), cs_n=0, oe_n=0, rs=DRR)
            host.sync()
            lows = host.model.log.falls("wrq_n", mark)
            if not enabled:
                assert not lows
            host.read(RCR)
        for _ in range(4):
            host.read(DRR)
    host.write(CSR, 0x40)
    host.issue(message(Code.OUTPUT, "11"))
    mark = host.mark
    host.pause(40)
    # Three of the four strobes come too soon after the one before; in DATASHEET it never gets high between.
    assert len(host.model.log.falls("wrq_n", mark)) == (3 if timing == "FAST" else 1)
    assert host.response() == message(Code.OUTPUT) and host.out("auxo_n") == 0x2E


@verifies("P312-GEN-12", "P312-GEN-01", "P312-PRT-02")
def test_reset_in_the_middle_of_a_block() -> None:
    host = Host(
        *TF,
        message(Code.OUTPUT, "3F"),
        message(Code.EXCITATION_ON),
        message(Code.ZERO_CLAMP),
        message(Code.POSITION_SET, "00 00000009"),
        message(Code.END_TERMINAL, "01"),
    )
    host.ask(message(Code.MASK, "01 FF"))
    host.ask(message(Code.IN_POSITION, "01 0001"))
    host.pause(500)
    host.write(CSR, 0x30)
    host.ask(message(Code.CONSTANT, "40 0190 00000009"))
    host.pulse(4, 30)
    host.write(WCR, 0x20)
    host.write(WAR, 0x1D)
    host.write(DWR, 0x40)
    host.model.pins(host.t, rst_n=0, cs_n=0, oe_n=0, rs=CSR)
    host.model.pins(host.t + 12, rst_n=1)
    host.model.pins(host.t + 13, cs_n=1, oe_n=1)
    host.t += 30
    assert (host.read(CSR), host.read(RAR), host.condition) == (0x04, 0x40, 0x01)
    levels = {"auxo_n": 0x3F, "exon_n": 1, "zclmp_n": 1, "irq_n": 1, "dir": 0, "pout": 0, "out_oe": 1}
    assert {name: host.out(name) for name in levels} == levels
    # Neither the pointer nor the arming has survived.
    host.write(DWR, 0x01)
    host.write(DWR, 0x03)
    assert host.quiet(200)
    host.pins(auxi=0xFF)
    assert host.quiet(3000)
    assert host.ask(message(Code.STATUS)) == message(Code.STATUS, "00 01 00")
    assert host.ask(message(Code.POSITION_READ, "00")) == message(Code.POSITION_READ, "00 00 00 00 00")
    assert host.ask(message(Code.POSITION_READ, "01")) == message(Code.POSITION_READ, "01 00 00 00 00")


@verifies("P312-CMD-FF", "P312-GEN-12", "P312-CHK-62")
def test_software_reset_clears_all() -> None:
    host = Host(
        *TF,
        message(Code.OUTPUT, "3F"),
        message(Code.EXCITATION_ON),
        message(Code.ZERO_CLAMP),
        message(Code.COUNTER_CLEAR),
        message(Code.ALARM_CLEAR),
        message(Code.INTERLOCK_POSITION, "00000009"),
    )
    for block in (
        message(Code.POSITION_SET, "01 00000009"),
        message(Code.END_TERMINAL, "01"),
        message(Code.RUN_MONITOR),
        message(Code.INTERLOCK),
        message(Code.ENCODE, "03 0001"),
        message(Code.EVENT_SET, "00", message(Code.OUTPUT, "01")),
        message(Code.CHANGE, "07 00C8"),
    ):
        host.issue(block)
        while host.response()[:2] == "23":
            pass
    host.pause(3000)
    while not host.read(CSR) & MREF:
        host.response()
    assert host.ask(message(Code.STATUS)) == message(Code.STATUS, "D6 02 61")
    host.write(CSR, 0x70)
    assert host.ask(message(Code.RESET)) == message(Code.RESET)
    assert host.read(CSR) == 0x04
    levels = {"auxo_n": 0x3F, "exon_n": 1, "zclmp_n": 1, "irq_n": 1, "cclr_n": 1, "aclr_n": 1, "intlk_n": 1}
    assert {name: host.out(name) for name in levels} == levels
    assert host.ask(message(Code.STATUS)) == message(Code.STATUS, "00 01 00")
    assert host.ask(message(Code.POSITION_READ, "01")) == message(Code.POSITION_READ, "01 00 00 00 00")
    # Interlock position 0 again.
    for block in (*TF, message(Code.INTERLOCK)):
        host.ask(block)
    host.ask(message(Code.STEP, "00"))
    assert (
        host.response() == message(Answer.STOPPED, "40 00 00 00 01", source=SPONTANEOUS)
        and host.out("intlk_n") == 0
    )
    host.ask(message(Code.STEP, "40"))
    assert host.response() == message(Answer.INTERLOCK_END, source=SPONTANEOUS)
    host.response()
    assert host.ask(message(Code.EVENT_READ)) == message(Code.EVENT_READ, "00 00 00 00 00 00")


@verifies("P312-PRT-03", "P312-PRT-01")
def test_mode_is_taken_at_the_end_of_a_reset() -> None:
    host = Host()
    host.pins(mode=0, mod=5, adr=9)
    assert host.ask(message(Code.VERSION)) == message(Code.VERSION, "12")
    assert host.ask(message(Code.VERSION)) == message(Code.VERSION, "12")
    host.model.pins(host.t, rst_n=0)
    host.model.pins(host.t + 12, rst_n=1)
    host.model.pins(host.t + 30, mode=1)
    host.t += 60
    mark = host.t
    host.write(CSR, 0x70)
    host.put(message(Code.VERSION))
    assert host.read(CSR) == 0 and host.quiet(500) is False
    host.sync()
    assert not host.model.log.rises("d_oe", mark) and host.out("irq_n") == host.out("wrq_n") == 1
    assert (host.out("txd"), host.out("snd")) == (1, 0)
    host.model.pins(host.t, rst_n=0)
    host.model.pins(host.t + 12, rst_n=1)
    host.t += 40
    assert host.ask(message(Code.VERSION)) == message(Code.VERSION, "12")


@verifies("P312-PRT-01")
def test_the_serial_line_does_nothing_in_parallel_mode() -> None:
    host = Host()
    for level in (0, 1, 0, 0, 1):
        host.pins(rxd=level, hsp=level, mod=7 * level, adr=15 * level)
        host.pause(40)
    assert (host.out("txd"), host.out("snd")) == (1, 0)
    assert host.ask(message(Code.VERSION)) == message(Code.VERSION, "12")
