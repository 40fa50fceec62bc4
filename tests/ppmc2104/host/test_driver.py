"""The driver of the PPMC-2104 on the modelled board, in virtual time."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from fractions import Fraction

import pytest

from openppmc.host import (
    CCW,
    CW,
    AlarmStop,
    AlreadyDecelerating,
    AxisBusy,
    Cause,
    IncompleteCommand,
    InvalidChopperTimes,
    InvalidRamp,
    LimitReached,
    Link,
    NothingToStop,
    NotInitialised,
    OutOfRange,
    Ppmc104,
    Ppmc2104,
    Progress,
    RampTooLong,
    RateLimitExceeded,
    StartRefused,
    StoppedByCommand,
    Timeout,
    UnexpectedData,
    UnknownCommand,
    WrongDevice,
    open_part,
)
from openppmc.host.errors import CommandRefused
from openppmc.host.model_port import ModelPort
from openppmc.host.ppmc2104.registers import BY_NUMBER as BY_NUMBER_2104
from openppmc.host.script import Script
from openppmc.model.ppmc2104.carrier import Carrier

SETUP = {"start_pps": 2000, "high_pps": 20_000, "ramp_pulses": 100}


@contextmanager
def board(plant: str = "", **setup: object) -> Iterator[Ppmc2104]:
    """Yield a part with both axes initialised; `setup` has the keyword arguments of `initialise`."""
    with Ppmc2104.open(f"model:speed=max,part=ppmc2104,{plant}") as part:
        for axis in (part.x, part.y):
            axis.initialise(**{**SETUP, **setup})  # type: ignore[arg-type]
        yield part


@pytest.fixture
def part() -> Iterator[Ppmc2104]:
    with board() as ready:
        yield ready


def model(part: Ppmc2104) -> Carrier:
    """Return the modelled board."""
    assert isinstance(part.link.port, ModelPort)
    assert isinstance(part.link.port.board, Carrier)
    return part.link.port.board


def first_pulses(part: Ppmc2104) -> list[list[int]]:
    """Return a list for each axis, to which the modelled board appends the cycle of each pulse."""
    seen: list[list[int]] = [[], []]
    real = model(part)._follow
    levels = [1, 1]

    def follow(edge: object) -> None:
        if edge.signal == "pout_n":  # type: ignore[attr-defined]
            for n in (0, 1):
                level = edge.value >> n & 1  # type: ignore[attr-defined]
                if levels[n] and not level:
                    seen[n].append(edge.t)  # type: ignore[attr-defined]
                levels[n] = level
        real(edge)  # type: ignore[arg-type]

    model(part)._follow = follow  # type: ignore[method-assign,assignment]
    return seen


# ---------------------------------------------------------------------- opening


def test_open_part_takes_the_driver_of_what_is_there() -> None:
    with open_part("model:part=ppmc2104,speed=max") as part:
        assert isinstance(part, Ppmc2104)
        assert part.link.identity.axes == 2
        assert part.axis[1] is part.x and part.axis[2] is part.y
    with open_part("model:speed=max", number=104) as part:
        assert isinstance(part, Ppmc104)
    with pytest.raises(WrongDevice, match="PPMC-104, not a PPMC-2104"):
        open_part("model:speed=max", number=2104)
    with pytest.raises(WrongDevice, match="PPMC-2104, not a PPMC-104"):
        Ppmc104.open("model:part=ppmc2104,speed=max")


def test_a_part_without_a_driver() -> None:
    port = ModelPort("speed=max")
    engine = port.bridge._engine
    engine._identity = engine._identity.replace(b"\x68\x00", b"\xe7\x03")
    with pytest.raises(WrongDevice, match="PPMC-999; there are drivers for PPMC-104, PPMC-2104, J105"):
        open_part(port)


def test_opening_clears_what_others_left() -> None:
    """When a driver opens the part, it clears errors of both axes, an incomplete command, and an unread
    answer.
    """
    port = ModelPort("part=ppmc2104,speed=max")
    link = Link(port)
    for script in (
        Script().post(1, b"\x07").post(1, b"\xa7"),  # undefined codes: error 1 of both axes
        Script().post(1, b"\x02").post(0, b"\x63"),  # only two bytes of an initialisation
        Script().post(1, b"\x83").post(1, b"\x22"),  # an unread answer, then a command of axis 2
    ):
        link.execute(script)
        part = Ppmc2104.on(link)
        status = part.status()
        assert not status.error and not any(status.working) and not any(status.busy)
        assert part.x.outputs().phases == (1, 1, 1, 1, 1)
        assert part.y.remaining() == 0
    link.close()


def test_a_motion_of_another_program_goes_on() -> None:
    port = ModelPort("part=ppmc2104,speed=max")
    first = Ppmc2104.open(port)
    first.y.initialise(**SETUP)
    first.y.jog(CW, 2000)
    part = Ppmc2104.on(first.link)
    part.link.pause(0.2)
    assert part.status().busy == (False, True)
    assert part.y.position > 300
    with pytest.raises(AlreadyDecelerating, match="axis 2: .* runs at constant speed"):
        part.y.stop()
    end = part.y.halt()
    assert end is not None and end.cause is Cause.STOP and end.pulses is None
    assert part.y.position == model(part).positions[1] - 4000


@pytest.mark.parametrize("early", [True, False])
def test_ends_that_nobody_read_hide_no_other(early: bool) -> None:
    """The driver reads the end status of another program's motion, so that int_n can report later ends.

    The motion may end before or after this program opens the part.
    """
    first = Ppmc2104.open("model:part=ppmc2104,speed=max")
    first.x.initialise(**SETUP)
    first.x.start_move(50 if early else 2000)
    if early:
        first.link.pause(0.5)
    part = Ppmc2104.on(first.link)
    part.y.initialise(**SETUP)
    before = part.link.clock()
    assert part.y.move(3000).complete
    assert part.link.clock() - before < 0.33, "the end came as a message, not by the look every half second"
    assert part.x.position == (50 if early else 2000)


def test_an_axis_left_waiting_for_run_does_not_start() -> None:
    """If a program ended between the commands of a coordinated start, the next program can open the part and
    use the other axis. The waiting axis waits until a stop is requested.
    """
    port = ModelPort("part=ppmc2104,speed=max")
    first = Ppmc2104.open(port)
    for axis in (first.x, first.y):
        axis.initialise(**SETUP)
    first.link.execute(Script().straps(0xF3).call(0x43, 99, 0, 0))
    part = Ppmc2104.on(first.link)
    part.y.initialise(**SETUP)
    assert part.y.move(50).complete
    assert part.x.inputs().active == [] and part.y.inputs().active == []
    part.link.pause(0.5)
    assert part.status().busy == (True, False)
    assert model(part).counts == [0, 50]
    for _ in range(2):
        with pytest.raises(AxisBusy, match="axis 1"):
            part.x.move(5)
        with pytest.raises(AxisBusy, match="axis 1"):
            part.move_together(5, 5)
        assert part.y.move(50).complete and part.y.inputs().active == []
        part.link.pause(0.1)
        assert model(part).counts[0] == 0
    end = part.x.halt()
    assert end is not None and end.cause is Cause.STOP
    part.x.initialise(**SETUP)
    assert part.x.move(7).position == 7


# ---------------------------------------------------------------------- moves


def test_both_axes_are_axes(part: Ppmc2104) -> None:
    for n, axis in enumerate((part.x, part.y)):
        for pulses, at in ((1000, 1000), (-300, 700), (1, 701), (0, 701), (-1, 700)):
            end = axis.move(pulses)
            assert (end.cause, end.pulses, end.remaining, end.position) == (Cause.COMPLETE, pulses, 0, at)
            assert axis.position == at == model(part).positions[n] - 4000
        assert axis.move_to(-25).pulses == -725
        assert axis.move_constant(20, 2000).position == -5
        assert axis.step(CCW).position == -6
        assert axis.remaining() == 0
        axis.zero()
        assert axis.position == 0
    assert model(part).positions == [3994, 3994]


def test_a_move_of_one_axis_leaves_the_other_alone(part: Ppmc2104) -> None:
    motion = part.y.start_constant(3000, 2000)
    assert part.x.move(700).complete
    assert part.x.home(fast=True).cause is Cause.ORIGIN
    assert motion.wait().check(3000).pulses == 3000
    assert model(part).counts[1] == 3000


def test_the_end_of_the_other_axis_does_not_hide_this_one(part: Ppmc2104) -> None:
    """int_n stays low while an end status is unread, so the wait for one axis also reads the end status of
    the other axis.
    """
    short, long = part.x.start_move(100), part.y.start_move(2000)
    before = part.link.clock()
    end = long.wait()
    seconds = part.link.clock() - before
    assert end.complete and short.result is not None and short.result.complete
    assert seconds < 0.3, "the end came as a message, not by the look every half second"


@pytest.mark.parametrize("setups", [({}, {}), ({}, {"start_pps": 1000}), ({"start_pps": 1000}, {})])
def test_together_begins_on_one_clk(setups: tuple[dict[str, int], dict[str, int]]) -> None:
    """A coordinated start works even if the ramps need different base clocks: the driver sets the straps of
    each axis.
    """
    with board() as part:
        for axis, setup in zip((part.x, part.y), setups, strict=True):
            axis.initialise(**{**SETUP, **setup})
        seen = first_pulses(part)
        ends = part.move_together(1500, -900)
        assert [end.pulses for end in ends] == [1500, -900]
        assert [len(pulses) for pulses in seen] == [1500, 900]
        assert seen[0][0] == seen[1][0]
        for pulses, axis in zip(seen, (part.x, part.y), strict=True):
            assert axis.setup is not None
            assert pulses[1] - pulses[0] == 16_000_000 / axis.setup.start.reached
        assert model(part).positions == [5500, 3100]


def test_together_at_constant_speeds(part: Ppmc2104) -> None:
    """In a coordinated start at constant speeds, the axes can use different base clocks."""
    seen = first_pulses(part)
    part.move_together(40, 300, 1000, 100_000)
    assert seen[0][0] == seen[1][0]
    assert {b - a for a, b in zip(seen[0], seen[0][1:], strict=False)} == {16_000}
    assert {b - a for a, b in zip(seen[1], seen[1][1:], strict=False)} == {160}


def test_together_with_an_axis_that_does_not_move(part: Ppmc2104) -> None:
    assert [end.pulses for end in part.move_together(0, 70)] == [0, 70]
    assert [end.pulses for end in part.move_together(-70, 0)] == [-70, 0]
    assert [end.pulses for end in part.move_together(0, 0)] == [0, 0]
    with pytest.raises(OutOfRange, match="1 to 16777216"):
        part.start_moves(0, 5)


def test_together_stops_both_when_one_meets_a_limit() -> None:
    with board("slow_cw2=5000") as part:
        with pytest.raises(LimitReached, match="axis 2: slow-down limit ended the motion"):
            part.move_together(20_000, 20_000)
        assert part.x.motion is not None and part.x.motion.result is not None
        assert part.x.motion.result.cause is Cause.STOP
        assert model(part).positions[1] == 5000 + 101
        assert model(part).positions[0] < 7000
        assert part.move_together(-100, -100)[1].complete


@pytest.mark.parametrize("blocked", [1, 2])
def test_together_with_a_blocked_axis_moves_neither(blocked: int) -> None:
    suffix = "" if blocked == 1 else "2"
    with board(f"start{suffix}=40000") as part:
        with pytest.raises(StartRefused, match=f"axis {blocked}: the motor cannot start"):
            part.move_together(500, 500)
        assert model(part).counts == [0, 0]
        assert not any(part.status().busy) and not part.status().error
        part.axis[3 - blocked].move(50)
        assert part.move_together(-5, -5)[0].complete
        assert sum(model(part).counts) == 40


def test_together_with_an_axis_that_is_busy(part: Ppmc2104) -> None:
    part.y.jog(CW, 2000)
    with pytest.raises(AxisBusy, match="axis 2"):
        part.move_together(50, 50)
    assert model(part).counts[0] == 0
    assert part.status().busy == (False, True), "the motion that was there goes on"
    part.y.stop()


def test_progress_of_both(part: Ppmc2104) -> None:
    seen: list[Progress] = []
    part.move_together(3000, 9000, progress=seen.append)
    assert seen and {now.requested for now in seen} <= {3000, 9000}


def test_leaving_the_block_by_an_exception_brakes_both() -> None:
    with pytest.raises(ZeroDivisionError), board() as part:
        part.start_moves(30_000, -3_000)
        part.link.pause(0.1)
        raise ZeroDivisionError
    machine = model(part)
    machine.run_until(machine.t + machine.clk_hz)
    assert not machine.part.busy(1) and not machine.part.busy(2)
    assert all(0 < abs(count) < 2500 for count in machine.counts)


# ---------------------------------------------------------------------- stops


def test_stop_with_a_ramp(part: Ppmc2104) -> None:
    part.y.jog(CW, high=True)
    part.link.pause(0.3)
    before = part.y.position
    end = part.y.stop()
    assert end is not None and end.cause is Cause.STOP
    assert end.position is not None and 100 <= end.position - before <= 130, "100 pulses of ramp"


def test_stop_at_constant_speed_is_immediate(part: Ppmc2104) -> None:
    """At constant speed the part rejects a decelerating stop, so the driver stops immediately
    (P2104-STP-03).
    """
    part.x.jog(CCW, 2000)
    part.link.pause(0.3)
    before = part.x.position
    end = part.x.stop()
    assert end is not None and end.cause is Cause.STOP
    assert end.position is not None and before - 3 <= end.position <= before


def test_stop_twice_and_stop_at_rest(part: Ppmc2104) -> None:
    part.x.jog(CW, high=True)
    part.link.pause(0.3)
    assert part.x.stop(wait=False) is None
    end = part.x.stop()
    assert end is not None and end.cause is Cause.STOP and end.pulses is not None and end.pulses > 2000
    for call in (part.x.stop, part.x.halt):
        with pytest.raises(NothingToStop, match="axis 1: nothing to stop"):
            call()
    with (
        Ppmc2104.open("model:part=ppmc2104,speed=max") as fresh,
        pytest.raises(NothingToStop, match="axis 2"),
    ):
        fresh.y.stop()


def test_stop_while_the_part_waits_for_run(part: Ppmc2104) -> None:
    """If the RUN pin is held low externally, a move outputs no pulse, and a stop ends it."""
    model(part).set_pins(run=0)
    model(part).straps = lambda levels: None  # type: ignore[method-assign]
    motion = part.x.start_move(500)
    with pytest.raises(Timeout):
        motion.wait(timeout=0.3)
    part.x.stop(wait=False)
    end = motion.wait(timeout=1)
    assert (end.cause, end.pulses, end.remaining) == (Cause.STOP, 0, 500)


def test_a_stopped_move_tells(part: Ppmc2104) -> None:
    motion = part.y.start_move(15_000)
    part.link.pause(0.2)
    part.y.stop(wait=False)
    with pytest.raises(StoppedByCommand, match=r"axis 2: stop command ended the motion at position \d+"):
        motion.wait().check(15_000)


# ---------------------------------------------------------------------- switches


def test_limits_and_starts_on_them(part: Ppmc2104) -> None:
    with pytest.raises(LimitReached, match="axis 1: slow-down limit"):
        part.x.move(100_000)
    assert model(part).position == 38_000 + 101
    with pytest.raises(LimitReached) as caught:
        part.x.move_constant(100_000, 5000)
    assert caught.value.result.cause is Cause.LIMIT
    assert model(part).position == 40_000
    assert part.x.inputs().active == ["limit cw", "slow cw"]
    assert part.y.inputs().active == []
    # The part rejects such a start (error 7); the driver raises the same error as for a PPMC-104.
    with pytest.raises(LimitReached, match="after 0 of 1 pulses") as caught:
        part.x.step(CW)
    assert caught.value.result.pulses == 0
    assert not part.status().error
    assert part.x.move(-50).pulses == -50


def test_alarm() -> None:
    with board("alarm2=4500..4600") as part:
        with pytest.raises(AlarmStop, match="axis 2: alarm input ended the motion at position 500 after 500"):
            part.y.move(2000)
        with pytest.raises(AlarmStop, match="after 0 of 3"):
            part.y.move(3)
        assert part.x.move(2000).complete


def test_a_refused_start_whose_switch_has_gone(part: Ppmc2104, monkeypatch: pytest.MonkeyPatch) -> None:
    quiet = part.x.inputs()
    model(part).set_pins(fl_n=0b10)
    monkeypatch.setattr(part.x, "inputs", lambda: quiet)
    with pytest.raises(StartRefused, match="axis 1: the motor cannot start: the limit switch"):
        part.x.move(5)


@pytest.mark.parametrize("start", [4000, 500, 0, -37, -400])
@pytest.mark.parametrize("how", [{}, {"fast": True}, {"to_limit": True}])
def test_home(start: int, how: dict[str, bool]) -> None:
    with board(f"start2={start}") as part:
        end = part.y.home(CCW, **how)
        assert end.cause is Cause.ORIGIN
        assert end.position == part.y.position == 0
        assert model(part).positions == [4000, 0]


# ---------------------------------------------------------------------- errors of the part


def test_every_error_number_has_its_exception(part: Ppmc2104) -> None:
    """Each error number that a script provokes on the golden model raises its own exception, and the driver
    clears the error immediately.
    """
    link = part.link
    model(part).set_pins(bl_n=0b01)
    rest: list[tuple[int, type[CommandRefused], Script]] = [
        (1, UnknownCommand, Script().call(0xA7)),
        (2, UnexpectedData, Script().call(0xF1, 0x00)),
        (3, IncompleteCommand, Script().post(1, b"\x63").call(0xA0)),
        (6, NothingToStop, Script().call(0x60)),
        (7, StartRefused, Script().call(0x6A)),
        (9, InvalidRamp, Script().call(0x22, 5, 4, 100, 0)),
        (10, RampTooLong, Script().call(0x22, 9, 4, 0xD5, 0x2B)),
        (11, InvalidChopperTimes, Script().call(0xA4, 0x3F, 0x80)),
    ]
    part.y.move(3)
    for number, kind, script in rest:
        with pytest.raises(kind, match="^axis [12]: ") as caught:
            link.execute(script)
        assert str(caught.value).startswith(f"axis {1 if number == 2 else 2}: ")
        assert not part.status().error
    part.y.jog(CW, 2000)
    for number, kind, script in (
        (5, AxisBusy, Script().call(0x62)),
        (8, AlreadyDecelerating, Script().call(0x61)),
    ):
        with pytest.raises(kind, match="^axis 2: "):
            link.execute(script)
        rest.append((number, kind, script))
    part.y.halt()
    part.y.excitation_off()
    with pytest.raises(NotInitialised, match="axis 2: it is not initialised"):
        part.y.move(1)
    seen = {number for number, *_ in rest} | {4, 12, 13}
    assert seen == set(BY_NUMBER_2104) == set(range(1, 14))


def test_too_fast_with_datasheet_timing() -> None:
    """With DATASHEET timing, rates above the limits return errors 12 and 13 (P2104-DS-30)."""
    with board("timing=DATASHEET", high_pps=10_000) as part:
        with pytest.raises(RateLimitExceeded, match="axis 1: .* too high for one axis"):
            part.x.start_constant(5, 250_000)
        assert part.x.move_constant(5, 20_000).complete
        part.y.jog(CW, 2000)
        with pytest.raises(RateLimitExceeded, match="axis 1: .* while the other axis is in use"):
            part.x.start_constant(5, 20_000)
        assert part.x.move_constant(5, 10_000).complete
        part.y.stop()
        seen = first_pulses(part)
        assert part.move_together(100, 200)[0].complete
        assert seen[0][0] == seen[1][0]
        assert part.x.home(fast=True).position == 0
        assert part.link.repeats == 0


# ---------------------------------------------------------------------- the rest


@pytest.mark.parametrize(
    ("arguments", "text"),
    [
        ({"start_pps": 100}, "start speed 100 pps is outside 488.281 to 62500 pps"),
        ({"high_pps": 2000}, "too close together"),
        ({"high_pps": 300_000}, "300000 pps is outside 1953.12 to 250000 pps"),
        ({"ramp_pulses": 3}, "outside 4 to 11220 pulses"),
        ({"phases": 6}, "3, 4 or 5"),
        ({"base_clock": 1}, "500000 and 125000 Hz"),
    ],
)
def test_impossible_setups(part: Ppmc2104, arguments: dict[str, int], text: str) -> None:
    before = part.y.setup
    with pytest.raises(OutOfRange, match=text):
        part.y.initialise(**{**SETUP, **arguments})
    assert part.y.setup is before
    assert part.y.move(5).complete


def test_bad_arguments(part: Ppmc2104) -> None:
    calls: list[Callable[[], object]] = [
        lambda: part.x.jog(2),
        lambda: part.x.move_constant(5, 300_000),
        lambda: part.auxo(4),
        lambda: part.x.switching(31, 100),
        lambda: part.x.hold_delay(100),
        lambda: part.move_together(1 << 25, 5),
    ]
    for call in calls:
        with pytest.raises(OutOfRange):
            call()
    assert model(part).counts == [0, 0]


def test_registers_and_auxiliary(part: Ppmc2104) -> None:
    part.y.move(-1)
    outputs = part.y.outputs()
    assert (outputs.phases, outputs.hold, outputs.ccw) == ((0, 1, 1, 0, 1), False, True)
    part.link.pause(0.01)
    assert part.y.outputs().hold and part.x.outputs().phases == (0, 0, 1, 1, 1)
    model(part).set_pins(auxi=0b10)
    part.x.jog(CW, 2000)
    assert part.auxi() == 2
    for value, levels in ((0, 3), (1, 2), (2, 1), (3, 0)):
        part.auxo(value)
        assert model(part).part.outputs["auxo"] == levels
    with pytest.raises(AxisBusy):
        part.x.outputs()
    with pytest.raises(AxisBusy):
        part.x.excitation_off()
    part.x.stop()


def test_switching_and_hold_delay(part: Ppmc2104) -> None:
    assert part.y.switching(40, 127.5) == (40, Fraction(255, 2))
    assert part.y.hold_delay(20_000) == 19_968
    part.y.move(1)
    assert not part.y.outputs().hold
    part.link.pause(0.02)
    assert part.y.outputs().hold


def test_reset(part: Ppmc2104) -> None:
    part.start_moves(5000, 5000)
    part.reset()
    assert part.status().raw == 0
    for axis in (part.x, part.y):
        with pytest.raises(NotInitialised):
            axis.move(1)
        axis.initialise(**SETUP)
        assert axis.move(1).complete


def test_noise_during_coordinated_starts(monkeypatch: pytest.MonkeyPatch) -> None:
    """If every fifth transfer loses a byte, each pair of moves is nevertheless made exactly once."""
    with board() as part:
        port = part.link.port
        write, count = port.write, 0

        def lossy(data: bytes) -> None:
            nonlocal count
            count += 1
            write(data[:3] + data[4:] if count % 5 == 0 else data)

        monkeypatch.setattr(port, "write", lossy)
        for turn in range(10):
            ends = part.move_together(10, -20)
            assert [end.position for end in ends] == [10 * (turn + 1), -20 * (turn + 1)]
        assert part.link.repeats > 3
        monkeypatch.setattr(port, "write", write)


def test_ctrl_c_in_the_middle_of_a_coordinated_start(part: Ppmc2104, monkeypatch: pytest.MonkeyPatch) -> None:
    """If Ctrl-C occurs while the driver waits for the answer to a coordinated start, both axes run; the
    driver stops them before it raises KeyboardInterrupt.
    """
    read = part.link.port.read

    def strike(timeout: float) -> bytes:
        monkeypatch.setattr(part.link.port, "read", read)
        raise KeyboardInterrupt

    monkeypatch.setattr(part.link.port, "read", strike)
    with pytest.raises(KeyboardInterrupt):
        part.start_moves(20_000, 20_000)
    assert not any(part.status().busy)
    assert all(count < 1000 for count in model(part).counts)
    assert part.move_together(5, 5)[0].complete
