"""The driver of the STMC on the modelled board, in virtual time.

tests/ppmc104/host/test_driver.py tests the functions that all parts have in common.
"""

from __future__ import annotations

import doctest
from collections.abc import Iterator
from contextlib import contextmanager
from itertools import pairwise, product

import pytest

from openppmc.host import (
    BOARD_CLOCK,
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
    Stmc,
    UnexpectedData,
    UnexpectedDataBusy,
    WrongDevice,
    open_part,
    speeds,
    stmc,
)
from openppmc.host.capabilities import SetupRequest
from openppmc.host.errors import CommandRefused
from openppmc.host.model_port import ModelPort
from openppmc.host.script import Script
from openppmc.host.stmc import CAPABILITIES as STMC
from openppmc.host.stmc import command_error as refused_stmc
from openppmc.model.carrier.carrier import Plant
from openppmc.model.stmc.carrier import Carrier

XTAL = 16_000_000
W1 = [20, 12, 9, 8, 7, 6, 6, 5, 5, 5, 5, 5, 6, 6, 7, 8, 9, 12, 20]
"""Gaps of a move of 20 steps with divisors 20 and 5 and a ramp of 8: worked move W1 of docs/stmc/README.md,
8.4.
"""


timing = "FAST"


@pytest.fixture(autouse=True, params=["FAST", "DATASHEET"])
def _timing(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    """Run every test with both timings."""
    monkeypatch.setitem(globals(), "timing", request.param)


@contextmanager
def board(plant: str = "", **setup: object) -> Iterator[Stmc]:
    """Yield an initialised part; `setup` has the keyword arguments of `initialise`."""
    with Stmc.open(f"model:speed=max,part=stmc,timing={timing},{plant}") as axis:
        axis.initialise(**setup)  # type: ignore[arg-type]
        yield axis


@pytest.fixture
def axis() -> Iterator[Stmc]:
    with board() as ready:
        yield ready


def model(axis: Stmc) -> Carrier:
    """Return the modelled board."""
    assert isinstance(axis.link.port, ModelPort)
    assert isinstance(axis.link.port.board, Carrier)
    return axis.link.port.board


def gaps(axis: Stmc, steps: int, pps: speeds.Number | None = None) -> list[int]:
    """Return the cycles between the phase changes of a move, recorded in the modelled board."""
    seen: list[int] = []
    machine = model(axis)
    real = machine._follow

    def follow(edge: object) -> None:
        if edge.signal == "s":  # type: ignore[attr-defined]
            seen.append(edge.t)  # type: ignore[attr-defined]
        real(edge)  # type: ignore[arg-type]

    machine._follow = follow  # type: ignore[method-assign,assignment]
    if pps is None:
        axis.move(steps)
    else:
        axis.move_constant(steps, pps)
    machine._follow = real  # type: ignore[method-assign]
    assert len(seen) == abs(steps)
    return [b - a for a, b in pairwise(seen)]


# ---------------------------------------------------------------------- speeds, set-up


def test_the_worked_examples_of_the_sheet() -> None:
    """The doctests of `clock` pass; there are at least five, among them 345/s and 825/s at 48 675 Hz."""
    failed, attempted = doctest.testmod(stmc)
    assert not failed and attempted >= 5


def test_bytes_of_an_initialisation() -> None:
    """The bytes of an initialisation are the code 00sc plmm, D1, D2, and PA (docs/stmc/README.md,
    Initialisation).
    """
    examples: list[tuple[dict[str, object], str]] = [
        ({"start_pps": 345, "high_pps": 825, "ramp_pulses": 400}, "1A 8D 3B 90 01"),
        ({"start_pps": 100, "high_pps": 2500, "ramp_pulses": 65_535}, "0A 7D 05 FF FF"),
        ({"start_pps": 625, "high_pps": 2500, "ramp_pulses": 8, "base_clock": 12_500}, "0A 14 05 08 00"),
        ({"start_pps": 1000, "high_pps": 1000, "ramp_pulses": 0, "external_clock": 20_000}, "1A 14 14 00 00"),
        (
            {"start_pps": 345, "high_pps": 345, "phases": 5, "half_step": True, "positive_logic": False}
            | {"chop": True, "base_clock": BOARD_CLOCK},
            "37 8D 8D C8 00",
        ),
        ({"start_pps": 345, "high_pps": 345, "phases": 3}, "19 8D 8D C8 00"),
    ]
    for arguments, wanted in examples:
        setup = STMC.plan(XTAL, SetupRequest(**arguments))  # type: ignore[arg-type]
        assert bytes([setup.code]) + setup.data == bytes.fromhex(wanted), arguments


@pytest.mark.parametrize(
    ("arguments", "text"),
    [
        ({"start_pps": 49}, "start speed 49 pps is outside 49.0196 to 2500 pps .base clock 12500 Hz"),
        ({"start_pps": 100, "high_pps": 2600}, "high speed 2600 pps is outside 49.0196 to 2500 pps"),
        ({"high_pps": 9800}, "high speed 9800 pps is outside 190.882 to 9735 pps .base clock 48675 Hz"),
        ({"start_pps": 500, "high_pps": 400}, "above high speed"),
        ({"ramp_pulses": 65_536}, "ramp of 65536 pulses is outside 0 to 65535 pulses"),
        ({"ramp_pulses": -1}, "outside 0 to 65535"),
        ({"phases": 2}, "3, 4 or 5"),
        ({"base_clock": 500_000}, "base clock 500000 Hz: this board has 12500 and 48675 Hz"),
        ({"external_clock": 0}, "external clock 0 Hz is outside 0 to 1000000 Hz"),
        ({"external_clock": 20_000}, "high speed 5000 pps is outside 78.4314 to 4000 pps"),
        ({"long_intervals": True}, "long intervals: a J105 STMC does not have that"),
    ],
)
def test_impossible_setups_are_refused_before_the_part_hears_of_them(
    axis: Stmc, arguments: dict[str, object], text: str
) -> None:
    before = axis.setup
    with pytest.raises(OutOfRange, match=text):
        axis.initialise(**arguments)  # type: ignore[arg-type]
    assert axis.setup is before
    assert axis.move(5).complete


def test_steps_with_the_internal_clock() -> None:
    """With the internal clock, a tick is exactly 1280 cycles at 16 MHz."""
    with board(start_pps=625, high_pps=2500, ramp_pulses=8, base_clock=12_500) as axis:
        assert gaps(axis, 20) == [1280 * ticks for ticks in W1]
        assert gaps(axis, -4, 1250) == [12_800] * 3


def test_steps_with_the_clock_of_the_board() -> None:
    """With the clock of 48 675 Hz the steps do not drift: each is within two cycles of the sum of its
    ticks.
    """
    with board(start_pps=2433.75, high_pps=9735, ramp_pulses=8) as axis:
        assert axis.setup is not None and axis.setup.data[:2] == bytes([20, 5])
        seen = gaps(axis, 20)
        for n in range(1, 20):
            assert abs(sum(seen[:n]) - sum(W1[:n]) * 16e6 / 48_675) <= 2
        assert abs(sum(gaps(axis, -21, 345)) - 20 * 141 * 16e6 / 48_675) <= 2


def test_no_ramp_is_the_high_speed_at_once() -> None:
    with board(start_pps=500, high_pps=2500, ramp_pulses=0, base_clock=12_500) as axis:
        assert axis.setup is not None and axis.setup.acceleration == 0
        assert gaps(axis, 6) == [5 * 1280] * 5


def test_a_constant_speed_needs_the_clock_of_an_initialisation() -> None:
    with Stmc.open("model:speed=max,part=stmc") as axis:
        for call in (lambda: axis.move_constant(5, 500), lambda: axis.jog(CW, 500)):
            with pytest.raises(OutOfRange, match="initialise first"):
                call()
        axis.initialise(start_pps=100, high_pps=2000)
        with pytest.raises(OutOfRange, match="speed 5000 pps is outside 49.0196 to 2500"):
            axis.move_constant(5, 5000)
        assert not axis.status().busy


@pytest.mark.parametrize(
    ("phases", "half_step", "positive_logic"), list(product((3, 4, 5), (False, True), (True, False)))
)
def test_every_motor_goes_where_it_is_sent(phases: int, half_step: bool, positive_logic: bool) -> None:
    motor = {"phases": phases, "half_step": half_step, "positive_logic": positive_logic}
    with board(**motor, chop=True) as axis:
        for steps, at in ((23, 23), (-37, -14), (1, -13)):
            assert axis.move(steps).position == at == model(axis).position - 4000
        axis.link.pause(0.01)
        assert axis.position == -13, "the chopper is no step"


# ---------------------------------------------------------------------- opening


def test_open_part() -> None:
    with open_part("model:part=stmc,speed=max") as axis:
        assert isinstance(axis, Stmc) and axis.link.identity.part == 105
    with pytest.raises(WrongDevice, match="the part is a PPMC-104, not a J105 STMC: name the right one"):
        Stmc.open("model:speed=max")
    with pytest.raises(WrongDevice, match="the part is a J105 STMC, not a PPMC-104"):
        Ppmc104.open("model:part=stmc,speed=max")


@pytest.mark.parametrize("read_map", ["SHEET", "FAMILY"])
@pytest.mark.parametrize("moving", [False, True])
def test_read_codes_are_found_out(read_map: str, moving: bool) -> None:
    """The driver detects the read codes at standstill and in a motion of another program, which is not
    disturbed.
    """
    with board(f"read_map={read_map}") as first:
        if moving:
            first.jog(CCW, 1000)
        axis = Stmc.on(first.link)
        assert axis.read_map == read_map
        if moving:
            first.link.pause(0.1)
            assert axis.status().busy
            end = axis.halt()
            assert end is not None and end.cause is Cause.STOP and end.pulses is None
            assert axis.remaining() == (1 << 24) - 1 + axis.position
        assert axis.outputs().ccw == moving
        assert sum(axis.outputs().phases) == 2
        assert axis.status().error is None


def test_other_read_codes_are_not_sent(axis: Stmc, monkeypatch: pytest.MonkeyPatch) -> None:
    """The driver never sends codes from 84h on, which the default map does not define; it sends 81h, which
    identifies the map, only once.
    """
    sent: list[int] = []
    real = model(axis).write
    monkeypatch.setattr(
        model(axis), "write", lambda a, byte: (sent.append(byte) if a & 1 else None, real(a, byte))
    )
    for _ in range(2):
        axis.move(3)
        axis.outputs()
    assert [code for code in sent if code >= 0x80] == [0x80, 0x81, 0x80, 0x83, 0x82, 0x80, 0x80, 0x83, 0x82]


# ---------------------------------------------------------------------- motions


def test_moves(axis: Stmc) -> None:
    for steps, at in ((1000, 1000), (-300, 700), (0, 700), (-1, 699)):
        end = axis.move(steps)
        assert (end.cause, end.pulses, end.remaining, end.position) == (Cause.COMPLETE, steps, 0, at)
        assert axis.position == at == model(axis).position - 4000
    assert axis.move_to(-25).pulses == -724
    assert axis.move_constant(20, 2000).position == -5
    assert axis.step(CCW).position == -6
    axis.zero()
    assert axis.position == 0 and axis.remaining() == 0


def test_the_end_comes_as_a_message(axis: Stmc) -> None:
    """`int_n` reports the end of a motion, so the driver need not wait for its poll of BUSY every half
    second.
    """
    before = axis.link.clock()
    assert axis.move(300).complete
    assert axis.link.clock() - before < 0.15


def test_stops(axis: Stmc) -> None:
    axis.jog(CW, high=True)
    axis.link.pause(0.5)
    before = axis.position
    end = axis.stop()
    assert end is not None and end.cause is Cause.STOP and end.pulses == end.position == axis.position
    assert 200 <= end.position - before <= 215, "200 steps of ramp"
    for stop in (axis.stop, axis.halt):
        axis.jog(CCW, 1000)
        axis.link.pause(0.2)
        before = axis.position
        end = stop()
        assert end is not None and end.position is not None and before - 2 <= end.position <= before
    with pytest.raises(NothingToStop):
        axis.stop()


def test_limits() -> None:
    with board("start=37500,cw=38500") as axis:
        with pytest.raises(LimitReached, match="slow-down limit .* other direction") as caught:
            axis.move(100_000)
        assert caught.value.result.cause is Cause.SLOW_LIMIT
        assert model(axis).position == 38_000 + 201
        with pytest.raises(LimitReached) as caught:
            axis.move_constant(100_000, 5000)
        assert caught.value.result.cause is Cause.LIMIT and model(axis).position == 38_500
        assert axis.inputs().active == ["limit cw", "slow cw"]
        with pytest.raises(LimitReached) as caught:
            axis.step(CW)
        assert (caught.value.result.pulses, caught.value.result.remaining) == (0, 1)
        with pytest.raises(OriginNotFound, match="a limit switch was reached before the origin"):
            axis.home(CW)
        assert axis.move(-50).pulses == -50, "away from the switch is free"


def test_motor_off() -> None:
    """The MON input of the STMC is reported where other parts report the alarm."""
    with board("alarm=4500..4600") as axis:
        text = "MON input ended the motion at position 500 after 500 of 2000 pulses: switch the motor on"
        with pytest.raises(AlarmStop, match=text) as caught:
            axis.move(2000)
        assert caught.value.result.cause_text == "MON input"
        assert axis.inputs().active == ["motor off"]
        with pytest.raises(AlarmStop):
            axis.step(CCW)


# ---------------------------------------------------------------------- homing


@pytest.mark.parametrize("start", [700, 1, 0, -37, -200, -999])
@pytest.mark.parametrize("how", [{}, {"fast": True}, {"to_limit": True}])
def test_home_finds_the_same_place_from_everywhere(start: int, how: dict[str, bool]) -> None:
    with board(f"start={start}", start_pps=2000, high_pps=8000, ramp_pulses=100) as axis:
        end = axis.home(CCW, **how)
        assert end.cause is Cause.ORIGIN and end.position == axis.position == 0
        assert model(axis).position == 0


class Flag(Plant):
    """Plant whose reference point is active over 21 steps."""

    def levels(self, position: int) -> dict[str, int]:
        return {**super().levels(position), "origin": int(not -20 <= position <= 0)}


@pytest.mark.parametrize("how", [{"fast": True}, {"to_limit": True}])
def test_home_comes_back_to_a_flag_it_has_passed(how: dict[str, bool]) -> None:
    """Homing as in the data sheet finds a flag that the motor has passed: it moves to the end of the travel,
    then back to the reference point with command 7.
    """
    with board("start=300", start_pps=2000, high_pps=8000, ramp_pulses=100) as axis:
        model(axis).plants = (Flag(ccw=-1000, slow_ccw=-200),)
        assert axis.home(CCW, **how).cause is Cause.ORIGIN
        assert model(axis).position == 0, "the same edge as a search from above"


def test_a_flag_on_the_other_side_is_not_found(axis: Stmc) -> None:
    """A search that starts below the flag ends at the deceleration limit, and the driver reports this
    (R-19).
    """
    model(axis).plants = (Flag(start=-100, ccw=-1000, slow_ccw=-200),)
    model(axis).positions[0] = -100
    with pytest.raises(OriginNotFound, match="home in the other direction") as caught:
        axis.home(CCW)
    assert caught.value.result.cause is Cause.SLOW_LIMIT and model(axis).position == -200


# ---------------------------------------------------------------------- errors


def test_every_error_number_is_raised_as_its_own_exception(axis: Stmc) -> None:
    """Each error number that a script provokes on the golden model raises its own exception; number 4 does
    not exist.
    """
    rest: list[tuple[type[CommandRefused], int, Script]] = [
        (NothingToStop, 0x80, Script().call(0x40)),
        (NothingToStop, 0x80, Script().call(0xC0)),
        (UnexpectedData, 0xB0, Script().call(0x1A, 20, 5, 8, 0, 0)),
        (InvalidRamp, 0xD0, Script().call(0x1A, 5, 20, 8, 0)),
        (InvalidRamp, 0xD0, Script().call(0x44, 0, 4, 0, 0)),
    ]
    busy: list[tuple[type[CommandRefused], int, Script]] = [
        (AxisBusy, 0x94, Script().call(0x42)),
        (AxisBusy, 0x94, Script().call(0x83)),
        (UnexpectedDataBusy, 0xE4, Script().call(0x41, 0x00)),
        (AlreadyDecelerating, 0xF4, Script().call(0x41)),
    ]
    for scripts in (rest, busy):
        for kind, status, script in scripts:
            with pytest.raises(kind) as caught:
                axis.link.execute(script)
            assert caught.value.status == status
        if scripts is rest:
            axis.initialise()
            axis.jog(CW, high=True)
            axis.link.pause(0.2)
    assert axis.motion is not None and axis.motion.wait().cause is Cause.STOP
    axis.reset()
    assert axis.setup is None
    with pytest.raises(NotInitialised, match=r"not initialised \(power-up or reset\)") as caught:
        axis.move(5)
    assert caught.value.status == 0xA0
    assert "divisor" in str(refused_stmc(0xD0)) and "divisor" not in str(refused_stmc(0x90))


def test_reset_is_no_step(axis: Stmc) -> None:
    """After a reset, the position is kept, and steps are counted from the first pattern on."""
    axis.move(1)
    axis.reset()
    axis.initialise()
    assert axis.position == 1 and not sum(axis.outputs().phases[2:])


def test_during_a_motion(axis: Stmc) -> None:
    axis.jog(CW, 2000)
    for call in (lambda: axis.move(5), axis.initialise, axis.outputs, axis.remaining):
        with pytest.raises(AxisBusy):
            call()
    assert axis.status().busy and axis.inputs().active == []
    axis.halt()


def test_what_the_part_does_not_have(axis: Stmc) -> None:
    for call, what in (
        (lambda: axis.move(5, pulse_only=True), "pulse only"),
        (lambda: axis.jog(CW, high=True, pulse_only=True), "pulse only"),
        (axis.excitation_off, "excitation off"),
    ):
        with pytest.raises(OutOfRange, match=f"{what}: a J105 STMC does not have that"):
            call()
    assert model(axis).counts == [0] and axis.status().error is None
