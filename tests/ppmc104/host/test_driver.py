"""The driver of the PPMC-104 on the modelled board, in virtual time."""

from __future__ import annotations

from collections.abc import Iterator
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
    InvalidRamp,
    LimitReached,
    NothingToStop,
    NotInitialised,
    OriginNotFound,
    OutOfRange,
    Ppmc104,
    PpmcError,
    Progress,
    RampTooLong,
    StoppedByCommand,
    Timeout,
    UnexpectedData,
    UnexpectedDataBusy,
)
from openppmc.host.errors import BY_NUMBER, CommandRefused
from openppmc.host.model_port import ModelPort
from openppmc.host.script import Script

timing = "FAST"


@pytest.fixture(autouse=True, params=["FAST", "DATASHEET"])
def _timing(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    """Run every test with both timings."""
    monkeypatch.setitem(globals(), "timing", request.param)


@contextmanager
def board(plant: str = "", **setup: object) -> Iterator[Ppmc104]:
    """Yield an initialised axis; `setup` holds the keyword arguments of `initialise`."""
    with Ppmc104.open(f"model:speed=max,timing={timing},{plant}") as axis:
        axis.initialise(**setup)  # type: ignore[arg-type]
        yield axis


@pytest.fixture
def axis() -> Iterator[Ppmc104]:
    with board() as ready:
        yield ready


def motor(axis: Ppmc104) -> int:
    """Return the position of the modelled motor."""
    assert isinstance(axis.link.port, ModelPort)
    return axis.link.port.board.position


# ---------------------------------------------------------------------- set-up


def test_initialise_tells_what_is_reached() -> None:
    with board(start_pps=3333, high_pps=45_000, ramp_pulses=500) as axis:
        setup = axis.setup
        assert setup is not None
        assert (setup.start.rate, setup.high.rate) == (149, 10)
        assert setup.start.reached == Fraction(500_000, 150)
        assert setup.high.reached == Fraction(500_000, 11)
        assert str(setup.high) == "45454.5 pps"


@pytest.mark.parametrize(
    ("arguments", "base_hz"),
    [
        ({"start_pps": 1000}, 125_000),
        ({"start_pps": 2000}, 500_000),
        ({"start_pps": 2000, "base_clock": 125_000}, 125_000),
        ({"start_pps": 1000, "long_intervals": True}, 125_000),
        ({"start_pps": 3000, "long_intervals": True}, 500_000),
    ],
)
def test_the_motor_runs_at_the_speed_that_was_told(arguments: dict[str, object], base_hz: int) -> None:
    """In a long move at constant speed, the intervals that the part outputs add up to the time that follows
    from the reported speed. This holds for both base clocks, with and without long intervals.
    """
    with board(**arguments) as axis:
        assert axis.setup is not None
        assert axis.setup.clock.hertz == base_hz
        assert isinstance(axis.link.port, ModelPort)
        part = axis.link.port.board.part
        end = axis.start_constant(101, axis.setup.start.reached).wait()
        assert end.complete
        assert (
            sum(interval.quanta or 0 for interval in part.intervals)
            == 100 / axis.setup.start.reached * 4_000_000
        )


def test_a_speed_of_the_other_base_clock() -> None:
    """A constant speed selects the base clock with which it is possible; the next ramp uses its own base
    clock again.
    """
    with board(start_pps=1000, high_pps=5000) as axis:
        assert isinstance(axis.link.port, ModelPort)
        part = axis.link.port.board.part
        axis.move_constant(3, 250_000)
        assert [interval.quanta for interval in part.intervals] == [16, 16]
        axis.move(3)
        assert [interval.quanta for interval in part.intervals] == [4000, 4000]


@pytest.mark.parametrize(
    ("arguments", "text"),
    [
        ({"start_pps": 100}, "start speed 100 pps is outside 488.281 to 125000 pps"),
        ({"high_pps": 200_000}, "high speed 200000 pps is outside 488.281 to 125000 pps"),
        ({"start_pps": 6000}, "start speed 6000 pps is above high speed 5000 pps"),
        ({"ramp_pulses": 3}, "ramp of 3 pulses is outside 4 to 11220 pulses"),
        ({"ramp_pulses": 11_221}, "outside 4 to 11220 pulses"),
        ({"phases": 6}, "3, 4 or 5"),
        ({"base_clock": 1}, "500000 and 125000 Hz"),
        ({"external_clock": 0}, "outside 0 to 1000000 Hz"),
        ({"start_pps": float("nan")}, "not a number"),
    ],
)
def test_impossible_setups_are_refused_before_the_part_hears_of_them(
    axis: Ppmc104, arguments: dict[str, object], text: str
) -> None:
    before = axis.setup
    with pytest.raises(OutOfRange, match=text):
        axis.initialise(**arguments)  # type: ignore[arg-type]
    assert axis.setup is before
    assert axis.move(5).complete


# ---------------------------------------------------------------------- moves


def test_moves(axis: Ppmc104) -> None:
    for pulses, at in ((1000, 1000), (-300, 700), (1, 701), (0, 701), (-1, 700)):
        end = axis.move(pulses)
        assert (end.cause, end.pulses, end.remaining, end.position) == (Cause.COMPLETE, pulses, 0, at)
        assert axis.position == at == motor(axis) - 4000
    assert axis.move_to(-25).pulses == -725
    assert axis.move_constant(20, 2000).position == -5
    assert axis.step(CCW).position == -6
    assert axis.remaining() == 0
    axis.zero()
    assert axis.position == 0


def test_pulse_only_leaves_the_phases(axis: Ppmc104) -> None:
    before = axis.outputs().phases
    axis.move(3, pulse_only=True)
    assert axis.outputs().phases == before
    axis.move(3)
    assert axis.outputs().phases != before


def test_progress(axis: Ppmc104) -> None:
    seen: list[Progress] = []
    axis.move(-3000, progress=seen.append)
    assert len(seen) >= 4
    assert [now.done for now in seen] == sorted(now.done for now in seen)
    assert all(now.requested == 3000 and now.position == -now.done for now in seen)
    assert 0 < seen[0].done < seen[-1].done < 3000


def test_an_exception_from_progress_reaches_the_caller_and_stops_nothing(axis: Ppmc104) -> None:
    class EnoughError(Exception):
        pass

    def enough(now: Progress) -> None:
        raise EnoughError

    with pytest.raises(EnoughError):
        axis.move(3000, progress=enough)
    assert axis.motion is not None
    assert axis.motion.wait().complete


def test_leaving_the_block_by_an_exception_brakes() -> None:
    with pytest.raises(ZeroDivisionError), board() as axis:
        port = axis.link.port
        axis.start_move(30_000)
        axis.link.pause(1.0)
        raise ZeroDivisionError
    assert isinstance(port, ModelPort)
    port.board.run_until(port.board.t + port.board.clk_hz)
    assert not port.board.part.busy
    assert 4000 < port.board.position < 11_000


def test_wait_with_a_limit(axis: Ppmc104) -> None:
    motion = axis.start_move(5000)
    before = axis.link.clock()
    with pytest.raises(Timeout, match="motion still in progress after 0.3 s"):
        motion.wait(timeout=0.3)
    assert 0.3 <= axis.link.clock() - before < 0.5
    assert motion.wait().complete


def test_an_event_that_gets_lost_only_costs_time(axis: Ppmc104) -> None:
    axis.link.execute(Script().events(False))
    assert axis.move(100).complete


@pytest.mark.parametrize("pulses", [(1 << 24) + 1, -(1 << 24) - 1])
def test_too_many_pulses(axis: Ppmc104, pulses: int) -> None:
    with pytest.raises(OutOfRange, match="1 to 16777216 pulses"):
        axis.move(pulses)


def test_bad_arguments(axis: Ppmc104) -> None:
    for call in (
        lambda: axis.start_move(0),
        lambda: axis.jog(2),
        lambda: axis.jog(CW, 100),
        lambda: axis.jog(CW, 1000, high=True),
        lambda: axis.move_constant(5, 600_000),
        lambda: axis.auxo(16),
        lambda: axis.switching(0, 100),
        lambda: axis.home(back_off=0),
    ):
        with pytest.raises(OutOfRange):
            call()
    assert not axis.status().busy


# ---------------------------------------------------------------------- stops


def test_stop_decelerates(axis: Ppmc104) -> None:
    axis.jog(CW, high=True)
    axis.link.pause(0.5)
    before = axis.position
    end = axis.stop()
    assert end is not None
    assert end.cause is Cause.STOP
    assert end.pulses == end.position == motor(axis) - 4000
    assert 190 <= end.position - before <= 230, "200 pulses of ramp"


def test_halt_is_immediate(axis: Ppmc104) -> None:
    axis.jog(CCW, 1000)
    axis.link.pause(0.5)
    before = axis.position
    end = axis.halt()
    assert end is not None
    assert end.position is not None
    assert before - 3 <= end.position <= before
    assert end.pulses == end.position


def test_stop_twice_and_stop_at_rest(axis: Ppmc104) -> None:
    axis.jog(CW, high=True)
    axis.link.pause(0.5)
    assert axis.stop(wait=False) is None
    end = axis.stop()
    assert end is not None and end.cause is Cause.STOP
    with pytest.raises(NothingToStop):
        axis.stop()
    with pytest.raises(NothingToStop):
        axis.halt()


def test_stop_of_a_motion_that_has_just_ended(axis: Ppmc104) -> None:
    axis.start_move(5)
    axis.link.pause(1)
    end = axis.stop()
    assert end is not None and end.complete


def test_stop_of_a_motion_that_another_program_started(axis: Ppmc104) -> None:
    axis.link.execute(Script().call(0x46))
    axis.link.pause(0.5)
    end = axis.stop()
    assert end is not None
    assert (end.cause, end.pulses) == (Cause.STOP, None)
    assert end.position == motor(axis) - 4000


def test_a_stopped_move_tells(axis: Ppmc104) -> None:
    motion = axis.start_move(5000)
    axis.link.pause(0.2)
    axis.stop(wait=False)
    end = motion.wait()
    with pytest.raises(
        StoppedByCommand, match=r"stop command ended the motion at position \d+ after \d+ of 5000 pulses"
    ):
        end.check(5000)
    assert end.pulses is not None
    assert end.pulses + end.remaining == 5000


# ---------------------------------------------------------------------- switches


def test_limits(axis: Ppmc104) -> None:
    with pytest.raises(LimitReached, match="slow-down limit .* other direction") as caught:
        axis.move(100_000)
    assert caught.value.result.cause is Cause.SLOW_LIMIT
    assert motor(axis) == 38_000 + 201
    assert axis.inputs().active == ["slow cw"]
    with pytest.raises(LimitReached) as caught:
        axis.move_constant(100_000, 5000)
    assert caught.value.result.cause is Cause.LIMIT
    assert motor(axis) == 40_000
    assert axis.inputs().active == ["limit cw", "slow cw"]
    with pytest.raises(LimitReached) as caught:
        axis.step(CW)
    assert caught.value.result.pulses == 0
    assert axis.move(-50).pulses == -50, "away from the switch is free"


def test_alarm() -> None:
    with board("alarm=4500..4600") as axis:
        with pytest.raises(
            AlarmStop, match="alarm input ended the motion at position 500 after 500 of 2000"
        ) as caught:
            axis.move(2000)
        assert caught.value.result.cause is Cause.ALARM
        assert axis.inputs().alarm
        with pytest.raises(AlarmStop):
            axis.home()


# ---------------------------------------------------------------------- homing


@pytest.mark.parametrize("start", [4000, 700, 500, 1, 0, -1, -37, -399, -400, 37_999])
@pytest.mark.parametrize("how", [{}, {"fast": True}, {"to_limit": True}])
def test_home_finds_the_same_place_from_everywhere(start: int, how: dict[str, bool]) -> None:
    with board(f"start={start}", start_pps=2000, high_pps=20_000, ramp_pulses=100) as axis:
        if start == 37_999 and not how:
            axis.move(-30_000)
        end = axis.home(CCW, **how)
        assert end.cause is Cause.ORIGIN
        assert end.position == axis.position == 0
        assert motor(axis) == 0, "the first position where the switch is active"
        assert axis.inputs().origin


def test_home_towards_a_switch_that_is_not_there() -> None:
    with board("origin=-5000", start_pps=2000) as axis:
        with pytest.raises(OriginNotFound, match="limit switch was reached before the origin") as caught:
            axis.home(CCW)
        assert caught.value.result.cause is Cause.LIMIT


def test_fast_homing_without_a_slow_down_switch() -> None:
    with board("slow_ccw=-30000,origin=-20000") as axis, pytest.raises(LimitReached):
        axis.home(CCW, fast=True)


def test_home_from_a_switch_that_sticks() -> None:
    with board("origin=100000", start_pps=2000) as axis, pytest.raises(LimitReached):
        axis.home(CCW, back_off=5000)


# ---------------------------------------------------------------------- errors of the part


def test_every_error_number_is_raised_as_its_own_exception(axis: Ppmc104) -> None:
    """Each error number that a script provokes on the golden model raises its own exception."""
    link = axis.link
    rest: list[tuple[type[CommandRefused], int, Script]] = [
        (NothingToStop, 0x80, Script().call(0x40)),
        (UnexpectedData, 0xB0, Script().call(0xC1, 0x00)),
        (RampTooLong, 0xC0, Script().call(0x0A, 9, 4, 0xD5, 0x2B)),
        (InvalidRamp, 0xD0, Script().call(0x0A, 4, 9, 4, 0)),
    ]
    for kind, status, script in rest:
        with pytest.raises(kind) as caught:
            link.execute(script)
        assert caught.value.status == status
    axis.jog(CW, high=True)
    busy: list[tuple[type[CommandRefused], int, Script]] = [
        (AxisBusy, 0x94, Script().call(0x42)),
        (UnexpectedDataBusy, 0xE4, Script().call(0xC1, 0x00)),
        (AlreadyDecelerating, 0xF4, Script().call(0x41).call(0x41)),
    ]
    for kind, status, script in busy:
        with pytest.raises(kind) as caught:
            link.execute(script)
        assert caught.value.status == status
    assert axis.motion is not None
    axis.motion.wait()
    axis.excitation_off()
    with pytest.raises(NotInitialised) as caught:
        axis.move(5)
    assert caught.value.status == 0xA0
    seen = {kind.number for kind, *_ in (*rest, *busy)} | {2}
    assert seen == set(range(8)) == set(BY_NUMBER)
    assert all(issubclass(kind, PpmcError) and kind.text for kind in BY_NUMBER.values())


def test_commands_during_a_motion(axis: Ppmc104) -> None:
    axis.jog(CW, 2000)
    for call in (
        lambda: axis.move(5),
        axis.initialise,
        axis.outputs,
        axis.remaining,
        axis.auxi,
        axis.excitation_off,
    ):
        with pytest.raises(AxisBusy):
            call()
    axis.aux(True)
    axis.auxo(5)
    assert axis.status().busy
    assert isinstance(axis.link.port, ModelPort)
    outputs = axis.link.port.board.part.outputs
    assert (outputs["aux_n"], outputs["auxo"]) == (0, 0b1010)
    axis.halt()
    axis.aux(False)
    assert outputs["aux_n"] == 1


# ---------------------------------------------------------------------- the rest


def test_registers(axis: Ppmc104) -> None:
    status = axis.status()
    assert (status.busy, status.error, status.expected) == (False, None, 0)
    assert axis.outputs().phases == (1, 1, 0, 0, 0)
    axis.move(-1)
    outputs = axis.outputs()
    assert (outputs.phases, outputs.hold, outputs.ccw) == ((1, 0, 0, 1, 0), False, True)
    axis.link.pause(0.05)
    assert axis.outputs().hold
    assert axis.auxi() == 0


def test_switching_times(axis: Ppmc104) -> None:
    assert axis.switching(75, 129) == (75, 129)
    assert axis.switching(60, 100) == (60, 99)
    axis.initialise(long_intervals=True)
    assert axis.switching(25, Fraction(115, 4)) == (25, Fraction(115, 4))


def test_reset(axis: Ppmc104) -> None:
    axis.jog(CW, 2000)
    axis.reset()
    assert not axis.status().busy
    with pytest.raises(NotInitialised):
        axis.move(1)
    with pytest.raises(OutOfRange, match="no speed given"):
        axis.jog(CW)
    axis.initialise()
    assert axis.move(1).complete


def test_excitation_off(axis: Ppmc104) -> None:
    axis.excitation_off()
    assert axis.outputs().phases == (0, 0, 0, 0, 0)


def test_datasheet_timing() -> None:
    """With the processing times of the old chip, an initialisation takes 17 to 163 ms, and moves
    still work.
    """
    with board("timing=DATASHEET", ramp_pulses=11_000) as axis:
        before = axis.link.clock()
        assert axis.move(300).complete
        assert axis.link.clock() - before > 0.16
        axis.initialise()
        assert axis.home(fast=True).position == 0
        assert axis.link.repeats == 0


def test_a_look_before_busy_rises() -> None:
    """With DATASHEET timing, BUSY rises 112 us after the command; a poll before that does not end the
    motion.
    """
    with Ppmc104.open("model:speed=max,timing=DATASHEET", baud=3_000_000) as axis:
        axis.initialise()
        axis.move(1)
        for pulses in (2, 3):
            motion = axis.start_move(pulses)
            assert not axis.status().busy
            assert motion.poll() is not None
            assert axis.status().busy
            assert motion.wait().pulses == pulses


def test_excitation_off_right_after_a_start() -> None:
    """The driver rejects excitation off directly after a start, although a part with DATASHEET timing is not
    BUSY yet; it would execute the code as AUX ON.
    """
    with Ppmc104.open(f"model:speed=max,timing={timing}", baud=3_000_000) as axis:
        axis.initialise(start_pps=5000, high_pps=9000)
        axis.move(1)
        motion = axis.start_move(300)
        with pytest.raises(AxisBusy):
            axis.excitation_off()
        assert isinstance(axis.link.port, ModelPort)
        assert axis.link.port.board.part.outputs["aux_n"] == 1
        assert motion.wait().pulses == 300
        axis.excitation_off()
        assert axis.outputs().phases == (0, 0, 0, 0, 0)


def test_external_clock_that_does_not_run() -> None:
    with board(external_clock=100_000, start_pps=1000) as axis:
        motion = axis.start_move(5)
        with pytest.raises(Timeout):
            motion.wait(timeout=0.5)
        end = axis.halt()
        assert end is not None
        assert (end.pulses, end.remaining) == (0, 5)


def test_wrong_part() -> None:
    port = ModelPort("speed=max")
    port.bridge._engine._identity = port.bridge._engine._identity.replace(b"\x68\x00", b"\x38\x01")
    with pytest.raises(PpmcError, match="PPMC-312, not a PPMC-104"):
        Ppmc104.open(port)


def test_noise_on_the_line(monkeypatch: pytest.MonkeyPatch) -> None:
    """If every fifth transfer loses a byte, each move is nevertheless made exactly once."""
    port = ModelPort("speed=max")
    axis = Ppmc104.open(port)
    count = 0
    write = port.write

    def lossy(data: bytes) -> None:
        nonlocal count
        count += 1
        write(data[:3] + data[4:] if count % 5 == 0 else data)

    monkeypatch.setattr(port, "write", lossy)
    axis.initialise()
    for turn in range(20):
        assert axis.move(10).position == 10 * (turn + 1)
    assert axis.link.repeats > 5
    assert port.board.position == 4200
    axis.close()


def test_ctrl_c_in_the_middle_of_a_request(axis: Ppmc104, monkeypatch: pytest.MonkeyPatch) -> None:
    """If a KeyboardInterrupt occurs between request and answer, the next command works."""
    axis.jog(CW, 2000)
    read = axis.link.port.read

    def strike(timeout: float) -> bytes:
        monkeypatch.setattr(axis.link.port, "read", read)
        raise KeyboardInterrupt

    monkeypatch.setattr(axis.link.port, "read", strike)
    with pytest.raises(KeyboardInterrupt):
        axis.status()
    end = axis.stop()
    assert end is not None and end.cause is Cause.STOP
