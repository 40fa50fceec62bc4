"""Driver of the PPMC-312 on a line of modelled stations, in virtual time."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager

import pytest
from serial.rs485 import RS485Settings

from openppmc.host import (
    CCW,
    CW,
    AlarmStop,
    AxisBusy,
    Cause,
    LimitReached,
    NotInitialised,
    OriginNotFound,
    OutOfRange,
    PortError,
    Ppmc312Bus,
    StoppedByCommand,
    Timeout,
)
from openppmc.host.capabilities import SetupRequest
from openppmc.host.errors import StartRefused
from openppmc.host.ppmc312 import blocks
from openppmc.host.ppmc312.answers import (
    Alarm,
    EncoderChange,
    Executed,
    Failed,
    HoldExecuted,
    InPositionChange,
    InputChange,
    InterlockEnded,
    Stopped,
)
from openppmc.host.ppmc312.errors import (
    HeldByRun,
    InAlarm,
    InvalidBlockLength,
    ParameterRefused,
    RateRefused,
    RegistrationRefused,
)
from openppmc.host.ppmc312.line.wire import SumMode
from openppmc.model.ppmc312.codes import Cause as Bit
from openppmc.model.ppmc312.codes import Source, State
from tests.common.host.line_ports import Played

FAST = (4000, 8000, 600)
"""The start speed and the high speed in pulses/s, and the ramp in pulses, of a table whose motions need
little simulation time.
"""
SPEED = 83_333


@contextmanager
def line(text: str = "stations=2", initialised: int | None = 1) -> Iterator[Ppmc312Bus]:
    """Provide a line on which one station is initialised."""
    with Ppmc312Bus.open(f"model:speed=max,{text}", SPEED) as bus:
        if initialised is not None:
            bus.axis(initialised).initialise(*FAST)
        yield bus


def pins(bus: Ppmc312Bus, station: int, **levels: int) -> None:
    """Set pins of a station's part; the plant sets all other pins."""
    bus.line.port.line.station(station).set_pins(**levels)  # type: ignore[attr-defined]


def test_moves_of_one_station() -> None:
    with line() as bus:
        axis = bus.axis(1)
        assert (axis.version(), axis.status().state) == (0x12, State.NOR)
        end = axis.move(50)
        assert (end.cause, end.pulses, end.remaining, end.position) == (Cause.COMPLETE, 50, 0, 50)
        assert axis.move_to(-20).pulses == -70
        assert axis.move_constant(30, 5000).complete and axis.position == 10
        assert axis.step(CCW).position == 9 and axis.move(0).pulses == 0
        assert axis.end_status() is Bit.NORMAL
        axis.set_position(-5)
        axis.set_position(123_456, encoder=True)
        assert (axis.position, axis.encoder) == (-5, 123_456)
        axis.zero()
        assert (axis.position, axis.encoder) == (0, 0)
        assert axis.counters.faults == 0 == axis.counters.repeated


def test_several_stations_at_once() -> None:
    with line("stations=3..6", 3) as bus:
        bus.axis(6).initialise(*FAST)
        seen = []
        motions = [bus.axis(3).start_move(600), bus.axis(6).start_move(-1500)]
        ends = bus.wait(motions, progress=seen.append)
        assert [end.position for end in ends] == [600, -1500]
        assert seen and seen[-1].requested == 2100 and 0 < seen[-1].done <= 2100
        assert bus.axis(3).status().state is State.NOR and not bus.wait([])
        motions = [bus.axis(3).jog(CW), bus.axis(6).jog(CCW, high=True)]
        with pytest.raises(Timeout, match=r"station 3, 6: motion still in progress after 0.05 s"):
            bus.wait(timeout=0.05)
        ends = bus.stop()
        assert [end.cause for end in ends] == [Cause.STOP, Cause.STOP] and not bus.stop()
        with pytest.raises(OutOfRange, match="no motion to wait for"):
            bus.wait([bus.axis(4)])


def test_stops_and_changes_of_speed() -> None:
    with line() as bus:
        axis = bus.axis(1)
        axis.jog(CW, high=True)
        bus.process_reports(0.05)
        end = axis.stop()
        assert end is not None and end.cause is Cause.STOP and end.finish == Bit.SLOW
        axis.jog(CW, speed=5000)
        axis.change_speed(7000)
        bus.process_reports(0.1)
        axis.change_speed(4000, ramped=False)
        end = axis.halt()
        assert end is not None and end.finish == Bit.STOP
        motion = axis.start_move(4000)
        axis._request_stop()
        with pytest.raises(StoppedByCommand, match=r"station 1: stop command ended the motion"):
            motion.wait().check(motion.requested)
        motion = axis.start_move(4000)
        with pytest.raises(AxisBusy, match="station 1: the part is busy"):
            axis.step(CW)
        assert axis.motion is motion
        axis.halt()
        assert [report.__class__ for report in axis.poll()] == []


def test_homing() -> None:
    with line("stations=2,start=60,cw=400") as bus:
        axis = bus.axis(1)
        for how in ({}, {"fast": True}, {"index": True}):
            assert axis.home(CCW, **how).cause is Cause.ORIGIN and axis.position == 0
            axis.move(60)
        with pytest.raises(OriginNotFound, match="limit switch was reached before the origin"):
            axis.home(CW, search_pps=8000)


def test_limits_and_alarm() -> None:
    with line("stations=2,cw=4700,slow_cw=4200,alarm1=3900..3910") as bus:
        axis, other = bus.axis(1), bus.axis(0)
        with pytest.raises(AlarmStop, match="station 1: alarm input ended the motion at position -90"):
            axis.move(-500)
        assert axis.poll() == [Alarm(0)]
        with pytest.raises(InAlarm, match="station 1: the part is in alarm"):
            axis.step(CW)
        other.initialise(*FAST)
        other.limit_speed(4500)
        with pytest.raises(LimitReached, match="station 0: slow-down limit"):
            other.move(1000)
        with pytest.raises(LimitReached, match="station 0: limit switch"):
            other.move_constant(1000, 4000)
        with pytest.raises(StartRefused, match="station 0: the motor cannot start"):
            other.move(5)
        assert other.inputs().limit_cw and other.inputs().slow_cw


def test_alarm_clears() -> None:
    with line() as bus:
        axis = bus.axis(1)
        pins(bus, 1, alm_n=0)
        assert axis.next_report() == Alarm(0) and axis.status().in_alarm
        pins(bus, 1, alm_n=1)
        axis.clear_alarm()
        assert axis.move(5).complete


def test_refusals_say_what_they_are() -> None:
    with line(initialised=None) as bus:
        axis = bus.axis(0)
        with pytest.raises(NotInitialised, match="station 0: the part has no table"):
            axis.instruct(blocks.single_step(CW))
        axis.initialise(*FAST)
        with pytest.raises(RateRefused, match="station 0: the speed is outside"):
            axis.instruct(blocks.run(CW, 20))
        with pytest.raises(ParameterRefused, match="station 0: the part rejects a value"):
            axis.instruct(blocks.block(0x06, b"\x02"))
        with pytest.raises(InvalidBlockLength, match="up to 10 bytes"):
            axis.instruct(blocks.event_register(1, bytes.fromhex("030984000000000000")))
        assert axis.error_code() == 0x48 and axis.error_code() == 0
        pins(bus, 0, run=0)
        motion = axis.start_move(5)
        with pytest.raises(HeldByRun):
            axis.step(CW)
        with pytest.raises(HeldByRun):
            axis.error_counts()
        assert axis.busy_now() and motion.result is None
        pins(bus, 0, run=1)
        assert motion.wait().complete and axis.poll() == [HoldExecuted()]


def test_only_the_bus_can() -> None:
    with line() as bus:
        axis = bus.axis(1)
        with pytest.raises(OutOfRange, match="free curves: a PPMC-312 in serial mode"):
            axis.kind.plan(16_000_000, SetupRequest(curve="x.csv"))
        with pytest.raises(OutOfRange, match="free curves: only on the parallel bus"):
            axis.load_curve([(2500, 3), (5000, 4), (10_000, 5)])
        with pytest.raises(OutOfRange, match="separate deceleration"):
            axis.initialise(1000, 5000, 2000, stop_pps=800)
        with pytest.raises(OutOfRange, match="reading the table"):
            axis.read_table()
        with pytest.raises(OutOfRange, match="event buffer"):
            axis.event_buffer(1)
        with pytest.raises(OutOfRange, match="several blocks"):
            axis.window.next_block()
        axis.initialise(1000, 8000, 4000, sigmoid=True)


def test_overrides() -> None:
    with line() as bus:
        axis = bus.axis(1)
        axis.override_speed(8000, at=150, ramped=False)
        axis.override_stop(at=300, slow=False)
        axis.override_stop(event=1)
        assert axis.status().overrides == 3
        end = axis.jog(CW, speed=5000).wait()
        assert (end.cause, end.position) == (Cause.STOP, 300)
        assert axis.poll().count(Executed(Source.OVERRIDE, None)) >= 1
        motion = axis.jog(CW)
        pins(bus, 1, evt0_n=0)
        end = motion.wait()
        assert end.finish == Bit.LOW and end.cause is Cause.STOP  # caused by the override, not by a limit
        for _ in range(8):
            axis.override_stop(at=100_000)
        with pytest.raises(RegistrationRefused, match="station 1: all places are taken"):
            axis.override_stop(at=100_000)
        with pytest.raises(OutOfRange, match="event buffer"):
            axis.override_move(5, event=1)


def test_events() -> None:
    with line() as bus:
        axis = bus.axis(1)
        assert axis.event_delete(2) is False
        axis.event_add(2, axis.move_block(7))
        axis.event_add(2, blocks.single_step(CCW))
        assert axis.status().events == (2,)
        for wanted in (7, 6):
            pins(bus, 1, evt1_n=0)
            pins(bus, 1, evt1_n=1)
            bus.process_reports(0.05)
            assert axis.position == wanted
            assert axis.poll() == [Executed(Source.EVENT, None), Stopped(Bit.NORMAL, wanted)]
        assert axis.event_delete(2) and axis.event_delete(2) and not axis.event_delete(2)
        axis.event_add(1, blocks.run(CW, 20))
        pins(bus, 1, evt0_n=0)
        (failed,) = axis.poll()
        assert isinstance(failed, Failed) and "station 1: an event's instruction was not" in str(failed.error)


def test_monitors_and_reports() -> None:
    with line("stations=1,block0=4020", 0) as bus:
        axis = bus.axis(0)
        axis.watch_position(10)
        axis.watch_encoder(10)
        axis.interlock(15)
        assert axis.status().interlock
        axis.watch_inputs(0xF0)
        pins(bus, 0, auxi=0x5F)
        axis.move(40)
        reports = axis.poll()
        for report in (
            InterlockEnded(),
            EncoderChange(True),
            InPositionChange(True),
            InputChange(0xA0, False),
        ):
            assert report in reports
        assert not axis.status().interlock
        assert (axis.position, axis.encoder) == (40, 20) and axis.aux_inputs() == 0x5F
        axis.watch_encoder(None)
        axis.watch_position(None)
        axis.interlock(100)
        axis.interlock(None)
        axis.monitor_run(False)
        assert not axis.status().run_monitored and not axis.status().interlock
        axis.monitor_end(True)
        assert axis.status().end_monitored


def test_terminals() -> None:
    with line() as bus:
        axis = bus.axis(1)
        axis.excitation_off()
        axis.excitation_on()
        axis.auxo(0x15)
        axis.counter_clear()
        axis.zero_clamp()
        outputs = bus.line.port.line.station(1).part.outputs  # type: ignore[attr-defined]
        levels = [outputs[name] for name in ("exon_n", "auxo_n", "cclr_n", "zclmp_n")]
        assert levels == [0, 0x2A, 0, 0]


def test_reset() -> None:
    with line() as bus:
        axis = bus.axis(1)
        axis.move(9)
        axis.jog(CW)
        axis.reset()
        assert axis.status().state is State.INI and axis.position == 0 and axis.motion is None
        with pytest.raises(OutOfRange, match="initialise first"):
            axis.rate_of(5000)


def test_an_error_leaves_nothing_running() -> None:
    with pytest.raises(RuntimeError), line() as bus:
        motion = bus.axis(1).jog(CW)
        raise RuntimeError
    assert motion.stop_ordered


def test_checksums_of_characters_and_echo() -> None:
    with Ppmc312Bus.open("model:speed=max,stations=1,sum=chars", sum_mode=SumMode.CHARS) as bus:
        assert bus.axis(0).version() == 0x12 and bus.axis(0).counters.faults == 0
    with Ppmc312Bus.open("model:speed=max,stations=1,echo=on", echo=True) as bus:
        assert bus.axis(0).version() == 0x12 and not bus.poll([0]) and bus.line.stray_bytes == 0


def test_a_slower_crystal() -> None:
    """All speeds, including the baud rate of the line, are proportional to the crystal frequency."""
    with Ppmc312Bus.open("model:speed=max,stations=1,xtal=8000000", xtal_hz=8_000_000) as bus:
        axis = bus.axis(0)
        assert bus.line.baud == 9600
        setup = axis.initialise(*FAST)
        assert float(setup.clock.hertz) == 4_000_000 and axis.move(5).complete
        assert axis.counters.faults == 0
    with Ppmc312Bus.open("model:speed=max,stations=1,xtal=8000000,baud=19200", 38_400) as bus:
        assert bus.scan() == []


def test_datasheet_timing_is_waited_for() -> None:
    with Ppmc312Bus.open("model:speed=max,stations=1,timing=DATASHEET") as bus:
        axis = bus.axis(0)
        bus.line.pause(0.002)  # the station ignores frames that arrive so soon after its reset
        axis.initialise(*FAST)
        assert axis.move(5).complete and axis.counters.repeated == 0


@pytest.mark.parametrize(
    ("options", "error", "text"),
    [
        ({"speed": 9600}, PortError, "9600 bit/s is no speed of a line: there are 19200, 38400, 83333"),
        ({"patience": 0}, OutOfRange, "patience 0 s"),
        ({"xtal_hz": 20_000_000}, OutOfRange, "crystal 20000000 Hz"),
    ],
)
def test_wrong_options(options: dict[str, int], error: type[Exception], text: str) -> None:
    with pytest.raises(error, match=text):
        Ppmc312Bus.open(Played(), **options)  # type: ignore[arg-type]


def test_wrong_ports() -> None:
    for port, text in (
        ("/dev/none", "no such port"),
        ("socket://localhost:1", r"cannot be opened \(.*\): check address"),
        ("nothing://x", "cannot be opened"),
        ("model:stations=17", "a number from 1 to 16"),
    ):
        with pytest.raises(PortError, match=text):
            Ppmc312Bus.open(port)
    master, slave = os.openpty()
    with pytest.raises(PortError, match="cannot switch a driver by RTS"):
        Ppmc312Bus.open(os.ttyname(slave), rs485=RS485Settings())
    os.close(master)
    os.close(slave)
    with pytest.raises(OutOfRange, match="stations 0 to 15"):
        Ppmc312Bus.open(Played()).axis(16)
