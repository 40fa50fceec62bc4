"""Times on the model that no acceptance check covers: pulse widths of the external clock, DATASHEET
delays.
"""

from __future__ import annotations

from tests.ppmc104.model.host import INIT_A, INIT_B, Host

EXTERNAL = "c 1A d 09 d 04 d 04 d 00"


def clock_run(host: Host, period: int, edges: int, phase: int = 0) -> None:
    """Output `edges` periods of the external clock, high for half of each period."""
    start = host.t + phase
    for i in range(edges):
        host.model.pins(start + i * period, clock=1)
        host.model.pins(start + i * period + period // 2, clock=0)
    host.t = start + edges * period


def test_tim_05_external_pulse_width():
    """With the external clock, a clock edge before W ends the low time: a rising edge at rates from 1 on, the
    falling edge at rate 0 (P104-TIM-05).
    """
    for rate, period, low in (
        (1, 64, 64),
        (3, 16, 32),
        (0, 40, 20),
        (0, 126, 63),
        (0, 128, 80),
        (1, 100, 80),
    ):
        host = Host()
        host.run(EXTERNAL + f" c 44 d {rate:02X} d 03 d 00 d 00")
        clock_run(host, period, 30)
        assert host.finish() == (0x84, 0), (rate, period)
        assert host.lows() == [low, low, low, 80], (rate, period)


def datasheet(init: str) -> Host:
    host = Host(timing="DATASHEET")
    host.run(init)
    host.pause(270_000)
    return host


def test_ds_01_pattern_and_ds_11_delays():
    host = Host(timing="DATASHEET")
    for byte in (9, 4, 4, 0):
        if byte == 9:
            host.command(0x0A)
        event = host.write(0, byte)
    host.pause(270_000)
    host.sync()
    (shown, level), *_ = host.model.log.of("s")
    assert level == 0b00011 and 704 <= shown - event <= 720
    for code, signal, clk in ((0xC1, "aux_n", 224), (0xC2, "aux_n", 224), (0xC0, "s", 288)):
        event = host.write(1, code)
        host.pause(400)
        host.sync()
        ((edge, _),) = host.model.log.of(signal, event)
        assert clk <= edge - event <= clk + 16


def test_ds_08_immediate_and_forced_ends():
    for script, end in (("c 44 d 63 d 63 d 00 d 00", 416), ("c 43 d E7 d 03 d 00", 3200)):
        host = datasheet(INIT_B)
        host.run(script)
        host.fall(3, 100)
        t = host.t
        host.pins(l1_n=0)
        host.idle()
        assert 0 <= host.model.now - (t + 2) - end <= 16
    host = datasheet(INIT_B)
    host.run("c 43 d E7 d 03 d 00")
    host.fall(4, 100)
    host.pins(l3_n=0)
    host.pins(l3_n=0)
    host.pins(l3_n=1)
    host.idle()
    assert len(host.pulses()) == 8
    assert 3200 <= host.model.now - host.pulses()[-1] <= 3216
    assert host.finish() == (0x8B, 991)


def test_ds_10_flag_comes_late():
    """A deceleration flag that is set after the natural deceleration has begun sets no cause bit."""
    host = datasheet(INIT_B)
    host.run("c 43 d E7 d 03 d 00")
    host.fall(3, 400)
    host.pins(l3_n=0)
    assert host.finish() == (0x8B, 991) and len(host.pulses()) == 8
    host = datasheet(INIT_A)
    host.run("c 43 d 05 d 00 d 00")
    host.fall(3, 100)
    host.pins(l3_n=0)
    assert host.finish() == (0x83, 0) and len(host.pulses()) == 6
