"""The ophyd positioner on the golden models, used as in a bluesky plan."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

import pytest
from bluesky import RunEngine
from bluesky.plans import scan
from ophyd.sim import det
from ophyd.utils import LimitError

from openppmc.host import (
    AxisBusy,
    Disconnected,
    EndUnknown,
    LimitReached,
    NotInitialised,
    OutOfRange,
    Pmc006Bus,
    StoppedByCommand,
    open_part,
)
from openppmc.host.part import Device
from openppmc.ophyd import PpmcPositioner
from openppmc.positioner import Positioner

PARTS = ("ppmc104", "ppmc2104", "stmc", "ppmc312", "bank")
PATIENCE = 60.0


@contextmanager
def started(part: str = "ppmc104", words: str = "speed=max") -> Iterator[Device]:
    """Open a device with initialised axes: 2000 to 8000 pps, each motor at 4000 in the machine model."""
    with open_part(f"model:part={part},{words}") as device:
        for axis in device.axes:
            axis.initialise(start_pps=2000, high_pps=8000, ramp_pulses=1000 if part == "ppmc312" else 100)
        yield device


def ends(motor: PpmcPositioner, position: float) -> BaseException | None:
    """Return the exception of a move to a position; None if the move succeeds."""
    return motor.set(position).exception(PATIENCE)


@pytest.mark.parametrize("part", PARTS)
def test_scan(part):
    """In a bluesky scan over the last axis of a device, each event has the position in units.

    A move into the slow-down limit fails with the error of the driver.
    """
    with started(part) as device:
        motor = PpmcPositioner(device, len(device.axes), name="theta", pulses_per_unit=-10, egu="deg")
        seen = []
        RunEngine()(scan([det], motor, 0, -20, 5), lambda name, doc: seen.append((name, doc)))
        assert [doc["data"]["theta"] for name, doc in seen if name == "event"] == [0, -5, -10, -15, -20]
        assert device.axes[-1].position == 200
        (described,) = [doc["data_keys"]["theta"] for name, doc in seen if name == "descriptor"]
        assert described["units"] == "deg" and f"axis {len(device.axes)}" in described["source"]
        assert isinstance(ends(motor, -100_000), LimitReached) and not motor.moving
        assert ends(motor, -20) is None and motor.position == -20


@pytest.mark.parametrize("part", PARTS)
def test_a_reset_during_a_move(part):
    """If a device is reset during a move, the Status fails, because the end of the move is not confirmed."""
    with started(part) as device:
        motor = PpmcPositioner(device, 1, name="theta", pulses_per_unit=100)
        with motor._positioner.lock:
            status = motor.set(50)
            device.link.pause(0.1)
            device.link.port.board.reset()
        assert isinstance(status.exception(PATIENCE), EndUnknown) and not motor.moving


def test_station_of_a_line():
    """On a line of PMC006B4, the axis number selects the station, and two stations can move at the
    same time.
    """
    with Pmc006Bus.open("model:part=pmc006,speed=max,address=1..2") as bus:
        motors = [PpmcPositioner(bus, station, name=f"m{station}") for station in (1, 2)]
        moves = [motor.set(300 * station) for station, motor in enumerate(motors, 1)]
        for move in moves:
            move.wait(PATIENCE)
        assert [motor.position for motor in motors] == [300, 600]


def test_two_axes_at_once():
    """Moves of two positioners of one device can overlap; readbacks are reported during the motion."""
    with started("ppmc2104", "speed=1") as device:
        motors = [PpmcPositioner(device, axis, name=f"a{axis}") for axis in (1, 2)]
        told = []
        motors[0].subscribe(lambda value, **_: told.append(value), event_type="readback", run=False)
        moves = [motors[0].set(20_000), motors[1].set(-300)]
        assert [motor.moving for motor in motors] == [True, True]
        for move in moves:
            move.wait(PATIENCE)
        assert [motor.position for motor in motors] == [20_000, -300]
        assert told == sorted(told) and len(told) > 2


@pytest.mark.parametrize("success", (False, True))
def test_stop_in_motion(success):
    """A stop during a motion decelerates the motor. The Status then fails, unless the call has
    success=True.
    """
    with started(words="speed=1") as device:
        motor = PpmcPositioner(device, name="x")
        motor.stop()  # a stop without a motion is not an error
        move = motor.set(30_000)
        with pytest.raises(AxisBusy, match="x is moving"):
            motor.set(5)
        motor.stop(success=success)
        error = move.exception(PATIENCE)
        assert error is None if success else isinstance(error, StoppedByCommand)
        assert 0 < motor.position < 30_000 and not motor.moving
        assert ends(motor, 10) is None


def test_stop_before_the_start():
    """After a stop, neither a move nor homing starts until the caller resets the stop request."""
    with started() as device:
        positioner = Positioner(device)
        positioner.stop()
        with pytest.raises(StoppedByCommand, match="at position 0 after 0 of 100 pulses"):
            positioner.start_move(100)
        with pytest.raises(StoppedByCommand):
            positioner.home(False, print)
        assert device.axes[0].position == 0
        positioner.stop_requested = False
        positioner.follow(positioner.start_move(100), print)
        assert positioner.position == 100 and positioner.start_move(100) is None
        # A stop request between two motions of a homing prevents the next motion.
        with pytest.raises(StoppedByCommand):
            positioner.home(False, lambda position: setattr(positioner, "stop_requested", True))


def test_bad_positions():
    """A position that is outside the soft limits or not a number is rejected without a motion."""
    with started() as device:
        motor = PpmcPositioner(device, name="x", pulses_per_unit=100, limits=(-1, 2))
        for bad in (2.01, -5):
            with pytest.raises(LimitError):
                motor.set(bad)
        for bad in (float("nan"), float("inf"), "5", None, True):
            with pytest.raises(OutOfRange, match="is not a finite number"):
                motor.set(bad)
        assert motor.position == 0 and ends(motor, 0.0049) is None and motor.position == 0
        assert ends(motor, 0.0051) is None and motor.position == 0.01


@pytest.mark.parametrize(
    ("words", "told"),
    (
        ({"axis": 2}, "axis 2: .* has axes 1 to 1"),
        ({"axis": 0}, "axis 0: "),
        ({"pulses_per_unit": 0}, "pulses_per_unit 0"),
        ({"pulses_per_unit": float("nan")}, "pulses_per_unit nan is not a finite number"),
    ),
)
def test_bad_axis_and_scale(words, told):
    """A missing axis or an invalid scale is rejected."""
    with started() as device, pytest.raises(OutOfRange, match=told):
        PpmcPositioner(device, name="x", **words)


def test_not_initialised():
    """On a device that is not initialised, the Status of a move fails; after the initialisation a move
    succeeds.
    """
    with open_part("model:speed=max") as device:
        motor = PpmcPositioner(device, name="x")
        assert isinstance(ends(motor, 100), NotInitialised) and not motor.moving
        device.axes[0].initialise(start_pps=2000, high_pps=8000, ramp_pulses=100)
        assert ends(motor, 100) is None


def test_unplugged_port():
    """If the port disappears during a motion, this Status and that of the next move fail with
    Disconnected.
    """
    with started(words="speed=max,unplug=2") as device:
        motor = PpmcPositioner(device, name="x")
        assert isinstance(ends(motor, 30_000), Disconnected) and not motor.moving
        assert isinstance(ends(motor, 0), Disconnected)
