"""IOC with one EPICS motor record for each axis, over Channel Access.

Requires the extra `epics`. `openppmc ioc` runs it; docs/host.md lists the fields.
"""

from __future__ import annotations

import asyncio
import logging
import math
from collections.abc import Awaitable, Callable, Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import partial
from typing import Any

from .errors import PpmcError, needs
from .host.errors import (
    AxisBusy,
    Disconnected,
    LinkError,
    NoAnswer,
    OutOfRange,
    PortError,
    WrongDevice,
)
from .host.line import LineBus
from .host.motion_result import EndUnknown, LimitReached, StoppedByCommand
from .host.part import Device
from .host.stopping import NOT_KNOWN, stop_motors
from .positioner import Positioner, Switches, finite

needs("epics", "the IOC", "caproto")

from caproto import AlarmSeverity, AlarmStatus, CaprotoError, CAStatus, ChannelAlarm, SkipWrite  # noqa: E402
from caproto.asyncio.server import Context  # noqa: E402
from caproto.server import PVGroup, PvpropertyDouble, pvproperty  # noqa: E402
from caproto.server.records import MotorFields, register_record  # noqa: E402

POLL = 0.1
"""Seconds between two updates of the readbacks."""
RETRY = 2.0
"""Seconds from the end of an attempt to open a lost port to the next attempt."""
COMMANDS = ("RLV", "TWF", "TWR", "HOMF", "HOMR", "STOP")
"""Fields to which a put of a value other than 0 is a command. After the command, their value is 0 again."""
IN_UNITS = ("VAL", "RBV", "DRBV", "RLV", "TWV", "OFF", "HLM", "LLM")
"""Fields with the unit EGU."""
DIRECTION, DONE, PLUS_LS, HOME_LS, PROBLEM = 0x1, 0x2, 0x4, 0x8, 0x200
MOVING, COMM_ERR, MINUS_LS, HOMED = 0x400, 0x1000, 0x2000, 0x4000
"""Bits of MSTA."""


@dataclass(frozen=True)
class Units:
    """Initial values of a record.

    Attributes:
        mres: change of the position by one pulse, in `egu`; negative if the position decreases in direction
        CW.
        prec: decimal places that clients show.
        limits: soft limits in `egu`; (0, 0) for no limits.
    """

    mres: float = 1
    egu: str = "pulses"
    prec: int = 3
    limits: tuple[float, float] = (0, 0)


class Abandoned(Exception):  # noqa: N818 - not an error
    """A put has no result: the IOC ends while the motion continues, or another put has replaced it."""


class Alarm(ChannelAlarm):  # type: ignore[misc]
    """Alarm of all fields of a record.

    A rejected put does not change the alarm; caproto would change it to WRITE.
    """

    async def write(self, *, status: Any = None, **others: Any) -> None:
        if status is not AlarmStatus.WRITE:
            await super().write(status=status, **others)


@register_record
class Fields(MotorFields):  # type: ignore[misc]
    """Fields of a motor record. The record itself executes each put to a field."""

    _record_type = "motor"

    async def group_write(self, instance: Any, value: Any) -> Any:
        return await self.parent.group.put(instance.pvspec.name, value)


class Setpoint(PvpropertyDouble):  # type: ignore[misc]
    """Field VAL. The record itself checks the limits."""

    async def verify_value(self, value: Any) -> Any:
        return await self.group.put("VAL", value)


class Motor(PVGroup):  # type: ignore[misc]
    """Motor record of one axis.

    A put that starts a motion returns when the motor has stopped. Its status is ECA_PUTFAIL if the motion did
    not end as requested.

    Args:
        ioc: the IOC, which runs the threads of the record.
        pvname: name of the record.
        positioner: the axis, initialised.
        units: initial values.

    Attributes:
        moving: True from the start of a motion until it has ended and no further motion is requested.
    """

    motor = pvproperty(value=0.0, dtype=Setpoint, name="", record="motor")

    def __init__(self, ioc: Ioc, pvname: str, positioner: Positioner, units: Units) -> None:
        super().__init__(prefix=pvname)
        self._ioc, self._positioner, self._units, self._alarm = ioc, positioner, units, Alarm()
        positioner.pulses_per_unit = 1 / units.mres
        self._channels = {"VAL": self.motor, **self.motor.fields}
        for name, channel in self._channels.items():
            channel.alarm, channel.auth_write = self._alarm, partial(self._put, name, channel.auth_write)
        self._task: asyncio.Task[Exception | None] | None = None
        self._next: Callable[[], None] | None = None
        self._executed: Callable[[], None] | None = None
        self._publishing = asyncio.Lock()
        self._seen, self._switches = math.nan, Switches(False, False, False)
        self._problem: Exception | None = None
        self.moving = self._stopped = self._silent = self._unknown = self._homed = self._forward = False
        get = self._get
        self._puts: dict[str, Callable[[Any], Awaitable[None]]] = {
            "VAL": self._put_position,
            "RLV": lambda value: self._go_by(value),
            "TWF": lambda value: self._go_by(get("TWV")),
            "TWR": lambda value: self._go_by(-get("TWV")),
            "HOMF": lambda value: self._go_home(True),
            "HOMR": lambda value: self._go_home(False),
            "STOP": self._stop,
            "SPMG": self._put_spmg,
            "HLM": lambda value: self._put_limits(get("LLM"), value),
            "LLM": lambda value: self._put_limits(value, get("HLM")),
            "VBAS": lambda value: self._put_speeds(base=value / abs(units.mres)),
            "VELO": lambda value: self._put_speeds(top=value / abs(units.mres)),
            "ACCL": lambda value: self._put_speeds(seconds=value),
            "OFF": self._put_offset,
            "EGU": self._put_egu,
        }

    async def start(self) -> None:
        """Read the part and set all fields. Raises the error of the part."""
        units = self._units
        await self._set(LVIO=0, MRES=units.mres, UDF=b"\0", EGU=units.egu)
        for channel in self._channels.values():
            if hasattr(channel, "precision"):
                await channel.write_metadata(precision=units.prec)
        await self._put_egu(units.egu)
        await self._put_limits(*units.limits)
        await self._checked(self._read_speeds)
        await self._show_speeds()
        await self._checked(self._look)
        await self._publish()

    async def refresh(self) -> None:
        """Publish the state of the part. It is read before, unless a motion is in progress."""
        if not self.moving:
            await self._call(self._look)
        await self._publish()

    def lose(self) -> None:
        """Mark the position as unknown, because the part does not respond."""
        self._silent = self._unknown = True
        self._homed = False

    def attach(self, device: Device) -> None:
        """Replace the object of the device after the device was opened again; no thread may use the axis."""
        self._positioner.attach(device)

    async def close(self) -> None:
        """Wait until no thread of this record uses the axis."""
        if self._task is not None:
            await asyncio.wait([self._task])

    # ------------------------------------------------------------------ fields

    def _get(self, name: str) -> Any:
        return self._channels[name].value

    async def _set(self, **values: Any) -> None:
        """Write these values to their fields, in the order of the arguments, if the values are new."""
        for name, value in values.items():
            channel = self._channels[name]
            if channel.value is not value and channel.value != value:
                await channel.write(value, verify_value=False, update_fields=False)

    def _new_alarm(self) -> tuple[AlarmStatus, AlarmSeverity]:
        if self._silent:
            return AlarmStatus.COMM, AlarmSeverity.INVALID_ALARM
        if self._unknown:
            return AlarmStatus.STATE, AlarmSeverity.INVALID_ALARM
        if isinstance(self._problem, LimitReached):
            return AlarmStatus.HIGH if self._forward else AlarmStatus.LOW, AlarmSeverity.MAJOR_ALARM
        if self._problem is not None:
            return AlarmStatus.STATE, AlarmSeverity.MAJOR_ALARM
        if self._stopped:
            return AlarmStatus.STATE, AlarmSeverity.MINOR_ALARM
        return AlarmStatus.NO_ALARM, AlarmSeverity.NO_ALARM

    async def _publish(self) -> None:
        """Write all fields that depend on the part: the alarm first, DMOV last."""
        async with self._publishing:
            (status, severity), busy, (low, high, origin) = self._new_alarm(), self.moving, self._switches
            if (status, severity) != (self._alarm.status, self._alarm.severity):
                await self._alarm.write(status=status, severity=severity)
            position = math.nan if self._unknown else self._seen
            known = not math.isnan(position)
            if known and not busy and self._get("SPMG") != "Pause":
                if abs(self._get("VAL") - position) > abs(self._units.mres):
                    await self._set(VAL=position)
            state = {
                DIRECTION: self._forward,
                DONE: not busy,
                MOVING: busy,
                PLUS_LS: high,
                MINUS_LS: low,
                HOME_LS: origin,
                HOMED: self._homed,
                PROBLEM: self._problem is not None or self._unknown,
                COMM_ERR: self._silent,
            }
            await self._set(
                STAT=status.name,
                SEVR=("NO_ALARM", "MINOR", "MAJOR", "INVALID")[severity],
                RBV=position,
                DRBV=position - self._positioner.offset if known else math.nan,
                RRBV=self._get("RRBV") if math.isnan(self._seen) else self._positioner.to_pulses(self._seen),
                HLS=int(high),
                LLS=int(low),
                ATHM=int(origin),
                TDIR=int(self._forward),
                MSTA=sum(bit for bit, on in state.items() if on),
                MOVN=int(busy),
                DMOV=int(not busy),
            )

    # ------------------------------------------------------------------ motions

    async def _run(self, job: Callable[[], None], **fields: Any) -> None:
        """Execute a motion in a thread, after a stop of the motion in progress; wait until the motor stops.

        Args:
            fields: fields that are written at the start, with their values.

        Raises:
            PpmcError: the motion did not end as requested.
            Abandoned: a stop or another put replaced the motion.
        """
        self._next = job
        if self.moving:
            self._positioner.stop_requested = True
            await self._call(self._positioner.send_stop)
        else:
            self.moving = True
            self._task = asyncio.create_task(self._work())
        await self._set(**fields)
        assert self._task is not None
        error = await asyncio.shield(self._task)
        if error is not None:
            raise error
        if self._executed is not job:
            raise Abandoned

    async def _work(self) -> Exception | None:
        """Execute motions until no further motion is requested; return the error of the last motion."""
        while True:
            error: Exception | None = None
            stopped = True
            while self._next is not None:
                job, self._next = self._next, None
                self._executed, self._positioner.stop_requested, self._stopped = job, False, False
                await self._publish()
                error = await self._call(job)
                if isinstance(error, Abandoned):
                    return error
                stopped = isinstance(error, StoppedByCommand) and self._positioner.stop_requested
            self._stopped = stopped
            self._problem = None if self._stopped else error
            if self._problem is not None:
                self._ioc.report(self._problem, self.prefix)
            if isinstance(self._problem, EndUnknown):
                self._unknown, self._homed = True, False
            if not self._unknown:
                await self._call(self._look)
            if self._next is None:
                break
        self.moving = False
        await self._publish()
        if self._get("SPMG") == "Move":
            await self._set(SPMG="Pause")
        return error

    async def _call(self, job: Callable[[], None]) -> Exception | None:
        """Call a function in a thread; return its exception.

        If the port is lost, the function is not called, and the error of the port is returned.
        """
        if self._ioc.lost is not None:
            return self._ioc.lost
        self._ioc.calls += 1
        try:
            await asyncio.get_running_loop().run_in_executor(self._ioc.threads, job)
        except Exception as error:
            if isinstance(error, LinkError) and not isinstance(error, EndUnknown):
                self.lose()
                self._ioc.lose(error, self._positioner.device)
            return error
        finally:
            self._ioc.calls -= 1
        return None

    async def _checked(self, job: Callable[[], None]) -> None:
        """Call a function in a thread, and raise the exception that `_call` returns."""
        error = await self._call(job)
        if error is not None:
            raise error

    # Functions that threads call.

    def _look(self) -> None:
        with self._positioner.lock:
            self._seen, self._switches = self._positioner.position, self._positioner.switches()
        if self._silent:
            self._silent, self._ioc.reported = False, ""

    def _report(self, position: float) -> None:
        if self._ioc.closing:
            raise Abandoned
        self._seen, self._switches = position, self._positioner.switches()

    def _move(self, position: float) -> None:
        self._positioner.leave_limit(position)
        motion = self._positioner.start_move(position)
        if motion is not None:
            self._positioner.follow(motion, self._report)

    def _reject(self) -> None:
        raise PpmcError("the position is not known; home first, or set the position with SET")

    def _home(self, forward: bool) -> None:
        self._homed = False
        self._positioner.initialise()
        self._positioner.home(forward, self._report)
        self._homed, self._unknown = True, False

    def _confirm(self) -> None:
        """Initialise the axis, which may have lost its set-up, after a client has stated the position."""
        self._positioner.initialise()
        self._look()
        self._problem, self._unknown = None, False

    def _read_speeds(self) -> None:
        self._speeds = self._shown = self._positioner.speeds()

    def _set_speeds(self, **changes: float) -> None:
        """Set speeds. VBAS and VELO keep the requested values, because clients wait until they read them."""
        speeds = self._speeds._replace(**changes)
        self._positioner.set_speeds(speeds, "seconds" in changes)
        self._speeds = speeds
        self._shown = speeds._replace(seconds=self._positioner.speeds().seconds)

    # ------------------------------------------------------------------ puts of clients

    async def _put(self, name: str, write: Callable[..., Any], *arguments: Any, **options: Any) -> Any:
        """Execute the put of a client and return its status; log a rejection.

        An exception here would cause an ErrorResponse, which the threading client of caproto does not expect.
        """
        try:
            return await write(*arguments, **options)
        except Exception as error:
            if error is not self._problem and not isinstance(error, (Abandoned, StoppedByCommand)):
                self._ioc.report(error, f"{self.prefix}.{name}")
            return CAStatus.ECA_PUTFAIL

    async def put(self, name: str, value: Any) -> Any:
        """Execute a put and return the value of the field.

        Raises:
            OutOfRange: the record does not support puts to this field, or it does not support the value.
        """
        if hasattr(value, "item"):
            value = value.item()  # of numpy
        if isinstance(value, float):
            finite(value, "value")
        if name in ("TWV", "SET") or (name in COMMANDS and not value):
            return value
        if name not in self._puts:
            raise OutOfRange("this record does not support puts to the field")
        await self._puts[name](value)
        if name in COMMANDS:
            return 0
        raise SkipWrite  # the field has its value

    def _check_mode(self, *modes: str) -> None:
        if self._get("SPMG") in modes:
            raise PpmcError(f"SPMG is {self._get('SPMG')}; set it to Go")

    async def _go(self, position: float) -> None:
        """Move to a position if limits and SPMG permit it."""
        if self._unknown:
            # DMOV changes to 0 and back, because EpicsMotor of ophyd waits for this change.
            await self._run(self._reject)
        low, high, slack = self._get("LLM"), self._get("HLM"), abs(self._units.mres) / 2
        if (low or high) and not low - slack <= position <= high + slack:
            await self._set(LVIO=1)
            raise OutOfRange(f"position {position:g} is outside the soft limits {low:g} to {high:g}")
        self._check_mode("Stop")
        if self._get("SPMG") == "Pause":
            await self._set(VAL=position, LVIO=0)
            return
        self._forward = position > self._seen
        await self._run(partial(self._move, position), VAL=position, LVIO=0)

    async def _go_by(self, distance: float) -> None:
        await self._go(self._get("VAL") + distance)

    async def _go_home(self, forward: bool) -> None:
        self._check_mode("Stop", "Pause")
        self._forward = forward
        await self._run(partial(self._home, forward), LVIO=0)

    async def _stop(self, value: Any = 1) -> None:
        # After an error of the line, a motor may be moving although its record does not follow the motion.
        self._next, self._positioner.stop_requested = None, True
        await self._checked(self._positioner.send_stop)

    async def _put_spmg(self, value: Any) -> None:
        modes = self._channels["SPMG"].enum_strings
        if value not in modes:
            raise OutOfRange(f"{value!r}: use {', '.join(modes)}")
        paused = self._get("SPMG") == "Pause"
        await self._set(SPMG=value)
        if value in ("Stop", "Pause"):
            await self._stop()
        elif paused and not self.moving:
            await self._go(self._get("VAL"))

    async def _put_position(self, value: float) -> None:
        if self._get("SET") == "Set":
            self._check_idle()
            if self._unknown:
                await self._checked(self._confirm)
            await self._put_offset(value - self._seen + self._get("OFF"))
        else:
            await self._go(value)

    async def _put_offset(self, value: float) -> None:
        """Set the offset of the positions. In pulses, the soft limits do not change."""
        self._check_idle()
        shift = value - self._get("OFF")
        await self._set(OFF=value)
        self._positioner.offset = value
        self._seen += shift
        if self._get("LLM") or self._get("HLM"):
            await self._put_limits(self._get("LLM") + shift, self._get("HLM") + shift)
        await self._set(VAL=self._seen)
        await self._publish()

    async def _put_limits(self, low: float, high: float) -> None:
        ends = {"lower_ctrl_limit": low, "upper_ctrl_limit": high}
        await self.motor.write_metadata(**ends, lower_disp_limit=low, upper_disp_limit=high)
        await self._set(LLM=low, HLM=high)

    async def _put_speeds(self, **changes: float) -> None:
        self._check_idle()
        await self._checked(partial(self._set_speeds, **changes))
        await self._show_speeds()

    async def _show_speeds(self) -> None:
        base, top, seconds = self._shown
        step = abs(self._units.mres)
        await self._set(VBAS=base * step, VELO=top * step, ACCL=seconds)

    async def _put_egu(self, value: str) -> None:
        for name in IN_UNITS:
            await self._channels[name].write_metadata(units=value)
        await self._set(EGU=value)

    def _check_idle(self) -> None:
        if self.moving:
            raise AxisBusy(0, "the motor is moving; stop it first")


class Ioc:
    """Motor records of a device.

    Args:
        motors: axis and initial values of each record, by its name.
        log: called with one line for each problem.
        reopen: called in a thread to open the device again after the port was lost; with None,
            the port stays lost.

    Attributes:
        threads: threads that use the device.
        closing: True if the threads should end.
        reported: last problem of the port that was logged.
        lost: last error of the port since it was lost; None while the port is open.
        calls: number of calls in threads that use the device.
    """

    def __init__(
        self,
        motors: Mapping[str, tuple[Positioner, Units]],
        log: Callable[[str], None],
        reopen: Callable[[], Device] | None = None,
    ) -> None:
        self.threads = ThreadPoolExecutor(2 * len(motors) + 1)
        self.closing, self.reported, self._log, self._reopen = False, "", log, reopen
        self.lost: LinkError | None = None
        self.calls, self._retry_at = 0, 0.0
        self._attempt: asyncio.Task[None] | None = None
        self.motors = [Motor(self, name, *values) for name, values in motors.items()]

    def report(self, error: Exception, name: str = "") -> None:
        """Log a problem. A problem of the port is logged only once for all records."""
        if not isinstance(error, LinkError) or isinstance(error, EndUnknown):
            kind = "" if isinstance(error, PpmcError) else f"{type(error).__name__}: "
            self._log(f"{name}: {kind}{error}")
        elif str(error) != self.reported:
            self.reported = str(error)
            self._log(self.reported)

    def lose(self, error: LinkError, device: Device) -> None:
        """Report an error of the port, and decide whether the port has to be opened again.

        If only a station of a line does not reply, the port stays open, and the other stations continue.
        """
        self.report(error)
        gone = isinstance(error, (Disconnected, PortError)) or not isinstance(device, LineBus)
        if gone and self.lost is None:
            self.lost = error
            for motor in self.motors:
                motor.lose()

    async def _open_again(self) -> None:
        """Try to open the lost port.

        If the port opens, motors that are still moving are stopped, because no client follows their motions.
        """
        assert self._reopen is not None
        loop = asyncio.get_running_loop()
        try:
            device = await loop.run_in_executor(self.threads, self._reopen)
            for motor in self.motors:
                motor.attach(device)
            state = await loop.run_in_executor(self.threads, lambda: stop_motors([device], every=True))
            if state.startswith(NOT_KNOWN):
                raise NoAnswer(state)
        except PpmcError as error:
            self.lost = error if isinstance(error, LinkError) else WrongDevice(str(error))
            self.report(self.lost)
            return
        finally:
            self._retry_at = loop.time() + RETRY
        self.lost, self.reported = None, ""
        self._log(f"{device.link.name}: the port is open again: {state}; home, or set positions with SET")

    async def _update(self) -> None:
        """If RETRY seconds have passed, begin an attempt to open a lost port. Publish all records."""
        if self._attempt is not None and self._attempt.done():
            done, self._attempt = self._attempt, None
            done.result()
        used = self.calls or any(motor.moving for motor in self.motors)
        if self.lost is not None and self._reopen and not used and self._attempt is None:
            if asyncio.get_running_loop().time() >= self._retry_at:
                self._attempt = asyncio.create_task(self._open_again())
        for motor in self.motors:
            await motor.refresh()

    async def run(self, check: Callable[[], None], ready: Callable[[int], None]) -> None:
        """Serve the records until `check`, which is called about ten times a second, raises an exception.

        Args:
            ready: called with the TCP port when clients can connect.
        """
        for motor in self.motors:
            await motor.start()
        try:
            context = Context({name: pv for motor in self.motors for name, pv in motor.pvdb.items()})
        except CaprotoError as error:
            raise PpmcError(f"Channel Access: {error}") from error

        async def started(library: Any) -> None:
            ready(context.port)

        server = asyncio.create_task(context.run(startup_hook=started))
        try:
            while not server.done():
                check()
                await self._update()
                await asyncio.sleep(POLL)
            try:
                server.result()
            except Exception as error:
                text = f"Channel Access: {error}; check the EPICS_CA variables"
                raise PpmcError(text) from error
        finally:
            self.closing = True
            if self._attempt is not None:
                await asyncio.wait([self._attempt])
            for motor in self.motors:
                await motor.close()
            server.cancel()
            await asyncio.wait([server])
            for circuit in tuple(context.circuits):
                circuit.client.close()  # caproto closes only the sockets that listen
            self.threads.shutdown()


def serve(
    motors: Mapping[str, tuple[Positioner, Units]],
    check: Callable[[], None],
    ready: Callable[[int], None],
    log: Callable[[str], None],
    reopen: Callable[[], Device] | None = None,
) -> None:
    """Run an IOC; see `Ioc`. Motions that are in progress at its end continue."""
    # `log` receives all problems.
    for name in ("caproto", "asyncio"):
        logging.getLogger(name).setLevel(logging.CRITICAL)
    asyncio.run(Ioc(motors, log, reopen).run(check, ready))
