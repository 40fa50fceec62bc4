"""The driver of the PPMC-312 on the modelled board, in virtual time."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from itertools import pairwise

import pytest

from openppmc.host import (
    CCW,
    CW,
    AlarmStop,
    AxisBusy,
    Cause,
    EndUnknown,
    LimitReached,
    Link,
    NothingToStop,
    NotInitialised,
    OriginNotFound,
    OutOfRange,
    Ppmc104,
    Ppmc312,
    ProtocolError,
    StoppedByCommand,
    Timeout,
    UnknownCommand,
    WrongDevice,
    open_part,
)
from openppmc.host.errors import StartRefused
from openppmc.host.model_port import ModelPort
from openppmc.host.ppmc312 import blocks
from openppmc.host.ppmc312.answers import (
    Alarm,
    EncoderChange,
    EventBuffer,
    Executed,
    Failed,
    HoldExecuted,
    InPositionChange,
    InputChange,
    InterlockEnded,
    Response,
    Stopped,
)
from openppmc.host.ppmc312.blocks import WINDOW
from openppmc.host.ppmc312.errors import (
    CurveRefused,
    EventFailed,
    HeldByRun,
    InAlarm,
    InvalidBlockLength,
    OverrideFailed,
    ParameterRefused,
    RateRefused,
    RegistrationRefused,
    TableRefused,
    UnexpectedInstruction,
)
from openppmc.host.ppmc312.window import CONTROL
from openppmc.host.script import Script
from openppmc.model.ppmc312.carrier import Carrier
from openppmc.model.ppmc312.codes import Cause as Bit
from openppmc.model.ppmc312.codes import Code, Source, State
from openppmc.sim.common.machine import parse_machine

TF = ((2500, 3), (5000, 4), (10_000, 5))
"""Speeds with 3, 4 and 5 pulses: at 1 MHz, rates 400, 200, 100 (table TF in docs/ppmc312/README.md, 8.2)."""


@contextmanager
def board(plant: str = "", curve: bool = True) -> Iterator[Ppmc312]:
    """Provide a part with the short table TF, or without a table if `curve` is false."""
    with Ppmc312.open(f"model:speed=max,part=ppmc312,{plant}") as part:
        if curve:
            part.load_curve(TF, base_clock=1_000_000)
        yield part


@pytest.fixture
def part() -> Iterator[Ppmc312]:
    with board() as ready:
        yield ready


def model(part: Ppmc312) -> Carrier:
    """Return the modelled board."""
    assert isinstance(part.link.port, ModelPort)
    assert isinstance(part.link.port.board, Carrier)
    return part.link.port.board


def messages(part: Ppmc312) -> int:
    """Return the number of scripts that the bridge has executed."""
    assert isinstance(part.link.port, ModelPort)
    return part.link.port.bridge.scripts


def gaps(part: Ppmc312, act: Callable[[], object]) -> list[int]:
    """Run `act` and return the intervals between its pulses in ticks of 1 us, recorded in the
    modelled board.
    """
    seen: list[int] = []
    machine = model(part)
    real = machine._follow

    def follow(edge: object) -> None:
        if edge.signal == "pout" and edge.value:  # type: ignore[attr-defined]
            seen.append(edge.t)  # type: ignore[attr-defined]
        real(edge)  # type: ignore[arg-type]

    machine._follow = follow  # type: ignore[method-assign,assignment]
    act()
    machine._follow = real  # type: ignore[method-assign]
    return [(b - a) // 16 for a, b in pairwise(seen)]


# ---------------------------------------------------------------------- opening


def test_what_answers_is_checked() -> None:
    with open_part("model:speed=max,part=ppmc312") as part:
        assert isinstance(part, Ppmc312)
        assert part.version() == 0x12 and part.axes == (part,)
    with pytest.raises(WrongDevice, match="PPMC-312, not a PPMC-104"):
        Ppmc104.open("model:speed=max,part=ppmc312")


def test_opening_clears_what_others_left() -> None:
    """When a driver opens the part, it reads all that another program has left: half an answer and a report.

    An unread response would make the next instruction cause an alarm.
    """
    port = ModelPort("speed=max,part=ppmc312")
    link = Link(port)
    block = blocks.bus_order(blocks.block(Code.STATUS))
    script = Script().write(2, 0x20).write(3, 0x20 - len(block)).write_many(5, block)
    link.execute(script.wait(0, 0x04, 0).read_many(7, 2))
    port.board.set_pins(alm_n=0)
    part = Ppmc312(link)
    assert list(part.reports) == [Alarm(0)]
    assert part.status().in_alarm
    port.board.set_pins(alm_n=1)
    part.clear_alarm()
    assert part.status().state is State.INI


def test_an_instruction_is_one_message(part: Ppmc312) -> None:
    """An instruction with its answer needs one message of the bridge, regardless of the size of the
    answer.
    """
    for ask in (part.version, part.status, lambda: part.position, part.inputs, part.excitation_on):
        before = messages(part)
        ask()
        assert messages(part) - before == 1


def test_reports_that_come_first_are_not_lost(part: Ppmc312) -> None:
    """If a stop report is waiting when the next instruction is sent, the report is not lost."""
    part.start_constant(2, 10_000)
    part.link.pause(0.01)
    assert model(part).part.core.responses.any_waiting
    assert part.position == 2
    assert part.motion is not None and part.motion.result is not None
    assert part.motion.wait().pulses == 2


def test_words_of_the_machine() -> None:
    """The machine options of every part have a cam as origin; encoder options exist only for this part."""
    (plant,) = parse_machine("part=ppmc312").plants
    assert [plant.levels(at)["origin"] for at in (-51, -50, 0, 1)] == [1, 0, 0, 1]
    assert [at for at in range(-450, 450) if not plant.index_level(at)] == [-420, -20, 380]
    (plant,) = parse_machine("origin=-7..9").plants
    assert [plant.levels(at)["origin"] for at in (-8, -7, 9, 10)] == [1, 0, 0, 1]
    (plant,) = parse_machine("part=ppmc312,index=0,block=5,origin=3").plants
    assert plant.index_level(-20) and not plant.levels(-1000)["origin"]
    assert [plant.steps(at, ccw) for at, ccw in ((4, 0), (5, 0), (5, 1))] == [True, False, True]
    for text, complaint in (
        ("block=5", "block=5: only a ppmc312 has an encoder"),
        ("part=stmc,index=5", "index=5: only a ppmc312 has an encoder"),
        ("part=ppmc312,index=-5", "index=-5: must not be negative; use the pulses of a turn"),
        ("part=ppmc312,origin=5..1", "the first position must not exceed the last one"),
    ):
        with pytest.raises(ValueError, match=complaint):
            parse_machine(text)


# ---------------------------------------------------------------------- tables


def test_linear_sigmoid_and_own_deceleration_reach_the_part() -> None:
    with board(curve=False) as part:
        for sigmoid in (False, True):
            setup = part.initialise(1000, 5000, 2000, 500, 3500, sigmoid, base_clock=1_000_000)
            table = model(part).part.core.table
            assert table == setup.table and table.separate and table.clk == 1
            read = part.read_table()
            assert read.rates == table.rates[::-1][: 127 - table.first]
            assert (sum(read.up), sum(read.down)) == (2000, 3500)
        assert part.status().state is State.NOR
        assert model(part).part.outputs["exon_n"] == 0


def test_free_curve_is_read_back(part: Ppmc312) -> None:
    read = part.read_table()
    assert (read.rates, read.up, read.down) == ((100, 200, 400), (5, 4, 3), ())
    part.load_curve([(1000 + 40 * k, 20 + k, 19) for k in range(127)])
    read = part.read_table()
    assert len(read.rates) == 127 and read.up == tuple(range(146, 19, -1)) and set(read.down) == {19}


def test_without_a_table() -> None:
    with board(curve=False) as part:
        for act in (lambda: part.step(CW), lambda: part.move(5), part.read_table):
            with pytest.raises(NotInitialised):
                act()
        for act in (lambda: part.jog(CW), lambda: part.change_speed(5), lambda: part._default_speed):
            with pytest.raises(OutOfRange, match="initialise first"):
                act()


def test_what_the_part_itself_refuses(part: Ppmc312) -> None:
    """If the driver is made to send blocks that it never builds, the part rejects each with its own
    exception.
    """
    for block, kind, text in (
        (blocks.initial_setting(1, 1000, 1, 2000), RateRefused, "high rate 2 to 65519"),
        (blocks.initial_setting(1, 1000, 200, 761), TableRefused, "2 pulses"),
        (blocks.initial_setting(1, 1000, 873, 2000), TableRefused, "too close"),
        (blocks.free_curve(1, [100, 200], [5, 4])[0][:3] + b"\x09\x00", CurveRefused, "2 to 127 stages"),
        (blocks.block(0x46), UnknownCommand, "does not know"),
        (b"\x03\x09\x40", InvalidBlockLength, "length"),
        (b"\x07\x01\x40", UnexpectedInstruction, "did not expect"),
        (blocks.block(Code.POSITION_READ, b"\x07"), ParameterRefused, "operand"),
    ):
        with pytest.raises(kind, match=text):
            part.instruct(block)
    assert part.status().state is State.INI and not part.reports


def test_a_speed_outside_the_table(part: Ppmc312) -> None:
    for pps in (2490, 10_300):
        with pytest.raises(OutOfRange, match="outside 2500 to 10000 pps, the speeds of the table"):
            part.move_constant(5, pps)
    assert part.rate_of(2500) == 400 and part._default_speed == 2500


# ---------------------------------------------------------------------- motions


def test_pulses_of_a_move(part: Ppmc312) -> None:
    """Moves have the intervals of worked moves E1 and E3 (P312-CHK-15); at constant speed all intervals are
    equal.
    """
    assert gaps(part, lambda: part.move(30)) == [400] * 3 + [200] * 4 + [100] * 16 + [200] * 4 + [400] * 2
    assert part.motion is not None and part.motion.shape == "trapezoid"
    assert gaps(part, lambda: part.move(-23)) == [400] * 3 + [200] * 4 + [100] * 9 + [200] * 4 + [400] * 2
    assert part.motion.shape == "triangle" and part.position == 7
    assert gaps(part, lambda: part.move_constant(5, 4000)) == [250] * 4
    assert part.position == part.encoder == model(part).position - 4000 == 12


def test_ends(part: Ppmc312) -> None:
    end = part.move(-30)
    assert (end.cause, end.pulses, end.remaining, end.position, end.finish) == (
        Cause.COMPLETE,
        -30,
        0,
        -30,
        0x40,
    )
    assert part.move_to(10).pulses == 40 and part.move(0).pulses == 0
    assert part.step(CCW).position == 9
    for pulses in (1 << 32, -(1 << 32)):
        with pytest.raises(OutOfRange, match="1 to 4294967295 pulses either way"):
            part.start_move(pulses)
    with pytest.raises(OutOfRange, match="pulse only"):
        part.move(5, pulse_only=True)


def test_progress_and_timeout(part: Ppmc312) -> None:
    motion = part.start_move(5000)
    with pytest.raises(Timeout, match="motion still in progress after 0.2 s"):
        motion.wait(0.2)
    now = motion.poll()
    assert now is not None and 0 < now.done == now.position < now.requested == 5000
    seen = []
    assert motion.wait(progress=seen.append).pulses == 5000
    assert [p.done for p in seen] == sorted(p.done for p in seen) and len(seen) >= 2
    assert motion.poll() is None


def test_only_what_the_state_allows(part: Ppmc312) -> None:
    for act in (part.stop, part.halt, lambda: part.change_speed(5000)):
        with pytest.raises(NothingToStop):
            act()
    motion = part.jog(CW, 2500)
    for act in (lambda: part.move(5), part.excitation_off, part.zero, lambda: part.apply(part.known_setup())):
        with pytest.raises(AxisBusy):
            act()
    assert motion.result is None and part.motion is motion
    assert part.stop().cause is Cause.STOP  # type: ignore[union-attr]


def test_stops_and_changes_of_speed(part: Ppmc312) -> None:
    """A stop from the high speed has a ramp of twelve pulses; at the stop speed there is no ramp (LOW)."""
    motion = part.jog(CW, high=True)
    part.process_reports(0.05)
    end = part.stop()
    assert end is not None and end.finish == Bit.SLOW and end.cause is Cause.STOP and motion.result == end
    part.jog(CCW, 2500)
    assert part.stop().finish == Bit.LOW  # type: ignore[union-attr]
    part.jog(CW, high=True)
    part.process_reports(0.05)
    assert part.halt().finish == Bit.STOP  # type: ignore[union-attr]
    part.jog(CCW, 2500)
    part.change_speed(10_000)
    part.process_reports(0.05)
    with pytest.raises(OutOfRange, match="outside 2500 to 10000"):
        part.change_speed(10_200)
    part.change_speed(5000, ramped=False)
    motion = part.motion  # type: ignore[assignment]
    one = motion.poll()
    part.process_reports(0.1)
    two = motion.poll()
    assert one is not None and two is not None
    assert (two.done - one.done) / (two.seconds - one.seconds) == pytest.approx(5000, rel=0.03)
    with pytest.raises(StoppedByCommand, match="stop command ended the motion"):
        part.stop().check()  # type: ignore[union-attr]


def test_a_motion_of_another_program_is_stopped(part: Ppmc312) -> None:
    part.instruct(blocks.run(CW, 400), 4)
    end = part.stop()
    assert end is not None and end.pulses is None and end.cause is Cause.STOP


def test_leaving_by_an_error_decelerates() -> None:
    with pytest.raises(ZeroDivisionError), board() as part:
        motion = part.jog(CW, high=True)
        part.process_reports(0.02)
        machine = model(part)
        raise ZeroDivisionError
    machine.run_until(machine.t + 160_000)
    assert machine.part.state is State.NOR and motion.result is None


def test_limits_and_alarm() -> None:
    with board("cw=4050,slow_cw=5000") as part:
        with pytest.raises(
            LimitReached, match="limit switch ended the motion at position 50 after 50 of 900"
        ):
            part.move(900)
        with pytest.raises(StartRefused, match="move in the other direction"):
            part.move(5)
        assert part.inputs().limit_cw and part.move(-10).complete
    with board("slow_cw=4050,alarm=3900..3950") as part:
        with pytest.raises(LimitReached, match="slow-down limit ended the motion at position 62 after 62"):
            part.move(900)
        with pytest.raises(AlarmStop, match="alarm input ended the motion at position -50 after 112"):
            part.move(-900)
        assert part.next_report() == Alarm(0)
        with pytest.raises(InAlarm, match="clear the alarm"):
            part.move(5)
        part.clear_alarm()
        assert part.status().in_alarm  # the input is still active
        model(part).set_pins(alm_n=1)
        part.clear_alarm()
        assert part.status().state is State.NOR and part.move(5).complete


def test_speed_limit(part: Ppmc312) -> None:
    """With an active slow-down limit, a motion slower than the speed limit is not ended."""
    part.limit_speed(6000)
    model(part).set_pins(fhl_n=0)
    assert part.move_constant(10, 5000).complete
    with pytest.raises(StartRefused):
        part.move_constant(10, 6000)


# ---------------------------------------------------------------------- homing


@pytest.mark.parametrize("start", [4000, 5, 0, -20, -60, -500])
@pytest.mark.parametrize("way", [{}, {"fast": True}, {"to_limit": True}, {"index": True}])
def test_home_finds_one_place(start: int, way: dict[str, bool]) -> None:
    """Homing from any position ends at the CW edge of the cam (-50..0), or at the index on the cam (-20).

    If the motor starts beyond the cam, only a search that begins at a limit finds it.
    """
    with board(f"start={start},cw=4200,slow_cw=4100,ccw=-900,slow_ccw=-600") as part:
        if start < -50 and "to_limit" not in way:
            with pytest.raises(OriginNotFound, match="limit switch was reached before the origin"):
                part.home(**way)
            return
        end = part.home(**way)
        assert end.cause is Cause.ORIGIN and end.position == 0
        assert model(part).position == (-20 if "index" in way else 0)
        assert part.position == part.encoder == 0


def test_zero_return_and_search(part: Ppmc312) -> None:
    part.move(-3800)
    assert part.search(CCW, 5000).wait().cause is Cause.ORIGIN
    assert model(part).position == 0
    part.move(300)
    end = part.zero_return(CCW).wait()
    # Phase 1 decelerates for twelve pulses; phase 2 returns to the cam, which the motor has not left.
    assert end.finish == Bit.ORIGIN and model(part).position == -12


# ---------------------------------------------------------------------- overrides and events


def test_overrides(part: Ppmc312) -> None:
    part.override_speed(5000, at=200)
    part.override_stop(at=400)
    part.override_stop(at=-50, slow=False)
    assert part.status().overrides == 3
    with pytest.raises(
        StoppedByCommand, match="stop command ended the motion at position 407 after 407 of 900"
    ):
        part.move(900)
    assert [part.next_report() for _ in range(3)] == [
        Executed(Source.OVERRIDE, Code.RAMP_CHANGE),
        Executed(Source.OVERRIDE, Code.SLOW_STOP),
        None,
    ]
    end = part.jog(CCW, high=True).wait()
    assert (end.position, end.finish) == (-50, Bit.STOP)
    assert part.next_report() == Executed(Source.OVERRIDE, Code.STOP)


def test_overrides_that_fail(part: Ppmc312) -> None:
    """A change of speed with a ramp fails during a ramp, and the stop that is registered after it is
    discarded.
    """
    part.override_speed(5000, at=5)
    part.override_stop(at=100)
    assert part.move(500).complete
    report = part.next_report()
    assert isinstance(report, Failed) and isinstance(report.error, OverrideFailed)
    assert report.by is Source.OVERRIDE and "the state did not allow it" in str(report.error)
    assert part.status().overrides == 0
    for n in range(8):
        part.override_stop(at=10_000 + n)
    with pytest.raises(RegistrationRefused, match="eight overrides"):
        part.override_stop(at=5)


def test_overrides_too_close_together(part: Ppmc312) -> None:
    """If an override is executed while the answer of the previous one is unread, an alarm is raised
    (P312-RSP-20).
    """
    part.override_speed(5000, at=200)
    part.override_speed(10_000, at=201)
    with pytest.raises(AlarmStop):
        part.move(900)
    reports = [part.next_report(), part.next_report()]
    assert Alarm(1) in reports and "read the part's reports" in str(Alarm(1).error)
    assert Executed(Source.OVERRIDE, Code.RAMP_CHANGE) in reports
    part.clear_alarm()
    assert part.status().state is State.NOR


@pytest.mark.parametrize("seen", [None, lambda progress: None], ids=["silent", "progress"])
def test_no_instruction_while_an_override_waits(
    part: Ppmc312, seen: Callable[[object], None] | None, monkeypatch: pytest.MonkeyPatch
) -> None:
    """An override that is triggered while an answer is unread is an alarm, so a wait sends no instruction
    (P312-RSP-20).
    """
    sent: list[int] = []
    real = part.window.execute

    def execute(block: bytes, *words: int) -> Response:
        sent.append(block[2])
        return real(block, *words)

    part.override_speed(5000, at=9000)
    motion = part.start_move(20_000)
    monkeypatch.setattr(part.window, "execute", execute)
    with pytest.raises(Timeout):
        motion.wait(0.7, seen)
    assert part.reports == deque() and not sent
    assert motion.wait(progress=seen).complete
    assert part.reports == deque([Executed(Source.OVERRIDE, Code.RAMP_CHANGE)]) and Code.STATUS in sent


@pytest.mark.parametrize("begin", ["override", "event", "another program"])
def test_a_reset_ends_the_wait_for_an_override(part: Ppmc312, begin: str) -> None:
    if begin == "event":
        part.event_add(1, blocks.block(Code.SLOW_STOP))
    else:
        part.override_stop(at=10_000)
    motion = part.start_move(20_000)
    if begin == "another program":
        part._waiting = None
    part.link.execute(Script().reset())
    with pytest.raises(EndUnknown, match="reported no end"):
        motion.wait(5)


def test_an_alarm_by_an_unread_answer_is_named(part: Ppmc312) -> None:
    """Only an alarm at the pin is described as one."""
    part.override_speed(5000, at=200)
    motion = part.start_move(900)
    block = blocks.block(Code.VERSION)
    part.link.execute(part.window._append_block(Script().write(CONTROL, WINDOW), block))
    part.link.pause(0.1)
    with pytest.raises(AlarmStop, match="an unread answer ended the motion at position 200 after") as error:
        motion.wait().check(900)
    assert "input" not in str(error.value) and "drive" not in str(error.value)


def test_overrides_by_event(part: Ppmc312) -> None:
    part.override_move(40, event=1)
    part.override_run(CCW, event=2, pps=5000)
    part.override_stop(event=1, slow=False)
    assert part.status().override_events == (1, 2)
    part.pulse_event(1)
    part.process_reports(0.1)
    assert part.position == 40
    part.pulse_event(2)
    part.process_reports(0.05)
    part.pulse_event(1)
    part.process_reports(0.05)
    assert not part.status().busy and part.position < -100
    done = [report for report in part.reports if isinstance(report, Executed)]
    assert [report.code for report in done] == [Code.RAMP, Code.FOREVER_CONSTANT, Code.STOP]
    assert [type(report) for report in part.reports if report not in done] == [Stopped, Stopped]


@pytest.mark.parametrize("how", [{}, {"at": 5, "event": 1}, {"event": 3}, {"at": 1 << 32}])
def test_what_an_override_waits_for(part: Ppmc312, how: dict[str, int]) -> None:
    with pytest.raises(OutOfRange):
        part.override_stop(**how)


def test_event_buffers(part: Ppmc312) -> None:
    part.event_add(1, blocks.outputs(5))
    part.event_add(1, part.move_block(-30))
    assert part.event_buffer(1) == EventBuffer(0, (Code.OUTPUT, Code.RAMP))
    assert part.status().events == (1,)
    part.pulse_event(1)
    part.process_reports(0.01)
    assert model(part).part.outputs["auxo_n"] == 0x3A
    assert part.event_buffer(1).following == 1
    part.pulse_event(1)
    part.process_reports(0.1)
    assert part.position == -30
    assert part.event_delete(1) and part.event_delete(1) and not part.event_delete(1)
    for _ in range(4):
        part.event_add(2, blocks.single_step(CW))
    with pytest.raises(RegistrationRefused, match="event buffer 2 is full"):
        part.event_add(2, blocks.single_step(CW))
    with pytest.raises(RegistrationRefused, match="in use by its buffer"):
        part.override_stop(event=2)
    part.override_stop(event=1)
    with pytest.raises(RegistrationRefused, match="event 1 is in use by an override"):
        part.event_add(1, blocks.single_step(CW))


def test_the_end_of_another_motion_is_no_end_of_ours(part: Ppmc312, monkeypatch: pytest.MonkeyPatch) -> None:
    """The stop report of another motion does not end a motion that starts after it.

    Here an event makes a step just before the start, so its answer and its stop report arrive first.
    """
    part.event_add(1, blocks.single_step(CW))
    monkeypatch.setattr(part.link, "forget_events", lambda: part.pulse_event(1))
    motion = part.start_constant(200, 2500)
    assert motion.result is None
    assert part.next_report() == Executed(Source.EVENT, Code.STEP)
    assert part.next_report() == Stopped(Bit.NORMAL, 1)
    with pytest.raises(ProtocolError, match="201 of 200 pulses counted, position 201"):
        motion.wait()  # the event has moved the motor by one step


def test_an_event_that_fails(part: Ppmc312) -> None:
    part.event_add(2, blocks.single_step(CW))
    model(part).set_pins(fl_n=0)
    part.pulse_event(2)
    report = part.next_report(0.1)
    assert isinstance(report, Failed) and isinstance(report.error, EventFailed)
    assert "a limit switch was active" in str(report.error)
    assert part.event_buffer(2) == EventBuffer(0, ())


# ---------------------------------------------------------------------- monitors, terminals


def test_encoder_that_stands() -> None:
    """If an obstacle stops the shaft after 50 pulses, all pulses are output, and both monitors report the
    deviation.
    """
    with board("block=4050") as part:
        part.watch_encoder(20)
        part.watch_position(20)
        assert part.move(100).complete
        assert (part.position, part.encoder, model(part).position) == (100, 50, 4050)
        status = part.status()
        assert status.encoder_outside and status.position_outside
        assert {part.next_report(), part.next_report()} == {EncoderChange(True), InPositionChange(True)}
        part.move(-35)
        part.set_position(65)
        part.set_position(60, encoder=True)
        assert {part.next_report(0.1), part.next_report(0.1)} == {
            EncoderChange(False),
            InPositionChange(False),
        }
        part.watch_encoder(None)
        part.watch_position(None)
        assert not part.status().encoder_watched and not part.status().position_watched
        for watch in (part.watch_encoder, part.watch_position):
            with pytest.raises(OutOfRange, match="outside 1 to 65535"):
                watch(0)


def test_interlock(part: Ppmc312) -> None:
    part.interlock(50)
    assert part.status().interlock and model(part).part.outputs["intlk_n"] == 0
    part.interlock(60)
    part.move(100)
    assert part.next_report() == InterlockEnded() and not part.status().interlock
    part.interlock(50)
    part.interlock(None)
    assert not part.status().interlock


def test_run_and_end(part: Ppmc312) -> None:
    part.allow_run(False)
    motion = part.start_move(30)
    assert motion.waited_for_run and part.status().state is State.WRN
    with pytest.raises(HeldByRun, match="a start waits for RUN"):
        part.stop()
    part.allow_run(True)
    assert motion.wait(1).complete
    assert part.next_report() == HoldExecuted()
    part.allow_run(False)
    motion = part.start_move(30)
    part.monitor_run(False)
    assert motion.wait(1).complete and not part.status().run_monitored
    part.monitor_run(False)
    assert not part.status().run_monitored
    part.monitor_run(True)
    part.allow_run(True)
    part.monitor_end(True)
    model(part).set_pins(end_n=1)
    motion = part.start_move(30)
    with pytest.raises(Timeout):
        motion.wait(0.2)
    part.monitor_end(False)
    assert motion.wait(1).complete


def test_terminals(part: Ppmc312) -> None:
    pins = model(part).part.outputs
    part.auxo(0x15)
    assert pins["auxo_n"] == 0x2A
    part.zero_clamp()
    part.counter_clear()
    assert (pins["zclmp_n"], pins["cclr_n"], pins["aclr_n"]) == (0, 0, 1)
    part.clear_alarm()
    assert pins["aclr_n"] == 0
    part.excitation_off()
    assert pins["exon_n"] == 1 and part.status().state is State.NOR
    model(part).set_pins(auxi=0x5A)
    assert part.aux_inputs() == 0x5A
    part.watch_inputs(0x0F)
    model(part).set_pins(auxi=0xA7)
    assert part.next_report(0.1) == InputChange(0x0D, False)
    part.watch_inputs(0)


def test_reset(part: Ppmc312) -> None:
    """Both kinds of reset end a motion and clear table, reports and position."""
    for reset in (part.reset, part.software_reset):
        part.load_curve(TF, base_clock=1_000_000)
        part.jog(CW)
        part.process_reports(0.05)
        reset()
        assert part.motion is None and part.setup is None and not part.reports
        assert part.status().state is State.INI and part.position == 0


def test_a_part_that_somebody_reset_is_noticed(part: Ppmc312) -> None:
    motion = part.jog(CW)
    part.link.execute(Script().reset())
    with pytest.raises(ProtocolError, match="reported no end"):
        motion.wait()


def test_a_part_in_reset_is_told(part: Ppmc312) -> None:
    model(part).part.pins(model(part).part.now + 1, rst_n=0)
    with pytest.raises(Timeout, match="the part"):
        part.version()


def test_datasheet_timing() -> None:
    """With DATASHEET timing, a table takes 115 ms and a reset 1.6 ms; the driver waits that long."""
    with board("timing=DATASHEET", curve=False) as part:
        begin = part.link.clock()
        part.initialise()
        assert 0.115 < part.link.clock() - begin < 0.2
        assert part.move(300).complete
        part.reset()
        part.initialise(sigmoid=True, stop_pps=900)
        part.event_add(1, blocks.single_step(CW))
        part.pulse_event(1)
        part.process_reports(0.05)
        assert part.position == 1


def test_crystal_and_clock() -> None:
    """With any crystal, the speeds are those that were requested."""
    with board("xtal=8000000,clk=27000000", curve=False) as part:
        part.initialise(1000, 5000, 2000)
        motion = part.start_constant(500, 2500)
        begin = part.link.clock()
        motion.wait()
        assert part.link.clock() - begin == pytest.approx(0.2, abs=0.01)
