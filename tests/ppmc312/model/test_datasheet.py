"""DATASHEET times of the PPMC-312 (chapter 8)."""

from __future__ import annotations

import pytest

from cocotb_tests.harness.verifies import verifies
from cocotb_tests.ppmc312.host import CSR, MREF, T1, T2, TF, Host

STOP = "03 02 80 00"


@pytest.mark.parametrize(
    ("setting", "ms"),
    [
        (T1, 115),
        ("03 0E 00 11 03E8 01F4 00C8 0007D0 0005DC", 200),
        (T2, 175),
        ("03 0E 00 19 03E8 01F4 00C8 0007D0 0005DC", 260),
    ],
)
@verifies("P312-CHK-65", "P312-TIM-02", "P312-TIM-03", "P312-TIM-04", "P312-TIM-05")
def test_datasheet_setting_times(setting: str, ms: int) -> None:
    host = Host(timing="DATASHEET")
    host.issue(setting)
    host.go(host.header + ms * 16_000 - 16)
    assert host.read(CSR) & MREF and host.condition == 0x01
    host.go(host.header + ms * 16_000 + 16)
    assert not host.read(CSR) & MREF and host.condition == 0x02


@verifies("P312-INP-01", "P312-INP-20", "P312-TIM-14", "P312-CMD-27")
def test_datasheet_run_is_the_plain_pin() -> None:
    """RUN starts and holds an operation without the 200 us of the other pins; 27 shows these plain."""
    host = Host(*TF, timing="DATASHEET")
    for low in (1, 2, 100, 5000):
        host.pins(run=0)
        host.ask("03 04 86 00 0190")
        assert host.condition == 0x20
        mark = host.mark = host.t
        host.pins(run=1)
        host.pause(low - 1)
        host.pins(run=0)  # one clk of RUN is enough
        assert host.response() == "23 01 E2" and host.condition == 0x08
        host.mark = mark
        assert host.pulse(1) - mark in range(80, 80 + 8)
        host.ask(STOP)
        host.response()
    # Low for 20 clk: it counts where it is tested, directly before t0, and nowhere else.
    host = Host(*TF, timing="DATASHEET")
    host.issue("03 02 84 00")
    delay = host.pulse(1) - 80 - host.header
    for before, held in ((300, False), (40, False), (12, True), (-20, False)):
        host = Host(*TF, timing="DATASHEET")
        host.issue("03 02 84 00")
        host.go(host.header + delay - before)
        host.pins(run=0)
        host.pause(19)
        host.pins(run=1)
        assert host.response() == "03 01 84"
        assert (host.response() == "23 01 E2") == held, before
    host = Host(*TF, timing="DATASHEET")
    host.pins(fl_n=0, alm_n=0, org_n=0)
    assert host.ask("03 01 27") == "03 03 27 6D E0" and host.condition == 0x02
    host.pins(fl_n=1, alm_n=1, org_n=1)


@verifies("P312-TIM-13", "P312-TIM-20")
def test_datasheet_output_time_and_ready_time() -> None:
    host = Host(timing="DATASHEET")
    assert host.model.log.of("out_oe")[0][0] - 25_600 in range(0, 8)
    host.issue("03 02 26 01")
    host.wait()
    (edge,) = host.model.log.of("auxo_n")
    assert abs(edge[0] - host.header - 4800) <= 16
    assert host.response() == "03 01 26"
    host.issue("03 09 00 01 03E8 03E8 0007D0")
    host.pause(4096)
    assert host.response().startswith("03 0B F0 03")


@pytest.mark.parametrize(
    ("block", "us"),
    [
        ("03 08 82 40 0000 0000001E", 100),
        ("03 08 82 40 0000 00000007", 700),
        ("03 08 82 40 0096 00000014", 900),
        ("03 08 82 40 0096 00000007", 1400),
        ("03 08 83 40 0190 00000003", 400),
        ("03 04 86 40 0190", 400),
        ("03 04 85 40 0000", 60),
        ("03 04 85 40 0096", 400),
        ("03 04 11 40 0000", 60),
        ("03 04 11 40 0096", 400),
        ("03 04 10 40 0190", 500),
        ("03 02 84 40", 500),
    ],
)
@verifies(
    "P312-CHK-68", "P312-TIM-06", "P312-TIM-07", "P312-TIM-08", "P312-TIM-09", "P312-TIM-10", "P312-TIM-11"
)
def test_datasheet_start_times(block: str, us: int) -> None:
    host = Host(*TF, timing="DATASHEET")
    host.issue(block)
    header = host.header
    host.pulse(1)
    assert abs(host.pulses()[0] - header - 16 * us) <= 16
    assert host.pulses()[0] - host.model.log.rises("dir", host.mark)[0] in (80, 81, 82)


@verifies("P312-TIM-12", "P312-TIM-14")
def test_datasheet_stop_and_pins() -> None:
    host = Host(*TF, timing="DATASHEET")
    host.ask("03 04 86 00 0064")
    mark = host.mark
    host.pulse(5, 10)
    host.issue(STOP)
    header = host.header
    assert host.response() == "03 01 80"
    host.mark = mark
    assert header < host.pulses()[-1] <= header + 5616
    assert host.pulses()[-1] > header + 5600 - 1700
    host.response()
    host.ask("03 04 86 00 0064")
    host.pulse(5, 10)
    host.pins(fl_n=0)
    host.pause(3000)
    host.pins(fl_n=1)
    low = host.t
    host.pins(fl_n=0)
    assert host.response().startswith("23 06 E0 01")
    assert low + 3200 - 1700 < host.pulses()[-1] <= low + 3205


@verifies("P312-TIM-12", "P312-BLK-01")
def test_datasheet_stop_of_what_ends_by_itself() -> None:
    """80 is judged when it comes: that the status is RDY after its 350 us is no error."""
    host = Host(*TF, timing="DATASHEET")
    host.ask("03 08 83 00 0064 00000008")
    mark = host.mark
    host.pulse(7, 10)
    host.issue(STOP)
    header = host.header
    assert host.response() == "23 06 E0 40 00 00 00 08" and host.condition == 0x02
    assert host.t < header + 5600 - 2000
    assert host.response() == "03 01 80" and host.t > header + 5600 - 16
    host.mark = mark
    assert len(host.pulses()) == 8 and host.quiet()
