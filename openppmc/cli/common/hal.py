"""The command `hal`: axes as a component of LinuxCNC's HAL. The logic is in `openppmc.linuxcnc`."""

from __future__ import annotations

import signal
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from types import FrameType
from typing import Annotated, Any, TypeVar

import typer

from ...errors import PpmcError
from ...host.axis import CCW, CW, OnProgress
from ...host.part import Device
from ...host.stopping import name_of
from ...linuxcnc import PERIOD, Controller, Machine, Reading
from . import output
from .line_session import parse_numbers
from .options import MOST_AXES, SetupValues, with_setup
from .presenter import presenter_of
from .session import Guard, Interrupted, note_mismatch, open_board, setup_values

SHORTEST_RAMP = 4
Name = Annotated[str, typer.Option(metavar="NAME", help="name of the component, as in loadusr -Wn")]
Axes = Annotated[
    str | None, typer.Option("--axes", metavar="N", help="axes or stations, as 1,3 or 1-4 (all)")
]


class RampDrive:
    """Axis of a part whose set-up is a ramp: the parts on the bridge, and PPMC-312 on a line."""

    def __init__(self, axis: Any, values: SetupValues, xtal_hz: int) -> None:
        self.axis, self._values, self._xtal_hz = axis, values, xtal_hz
        self._applied: object = None

    def prepare(self, start: float, velocity: float, acceleration: float) -> None:
        high = velocity or self._values.high
        low = min(start or self._values.start, high)
        changes: dict[str, Any] = {"start": low, "high": high}
        if acceleration:
            changes["ramp"] = max(SHORTEST_RAMP, round((high * high - low * low) / (2 * acceleration)))
        setup = self._values.merged(changes).plan(self._xtal_hz, self.axis.kind, self.axis.number)
        if setup != self._applied:
            self.axis.apply(setup)
            self._applied = setup

    def home(self, sign: int, pps: float, progress: OnProgress) -> object:
        return self.axis.home(CW if sign > 0 else CCW, pps or None, progress=progress)

    def clear(self) -> None:
        self._applied = None
        if hasattr(self.axis, "clear_alarm") and self.axis.status().in_alarm:
            self.axis.clear_alarm()

    def read(self) -> Reading:
        """Read position and limits."""
        inputs = self.axis.inputs()
        return Reading(self.axis.position, inputs.limit_cw, inputs.limit_ccw)


DeviceT = TypeVar("DeviceT", bound=Device)


@contextmanager
def closed_on_error(device: DeviceT) -> Iterator[DeviceT]:
    """Close a device if the block, which examines it, fails, so that it can be opened again."""
    try:
        yield device
    except BaseException:
        device.close()
        raise


class HalGuard(Guard):
    """Guard that counts repeated SIGTERMs as one, because halcmd may send several during a deceleration."""

    def _on_signal(self, number: int, frame: FrameType | None) -> None:
        if number != signal.SIGTERM or not self.count:
            super()._on_signal(number, frame)


def serve(name: str, connect: Callable[[], Machine]) -> None:
    """Run the component until a signal ends it. A lost port is opened again at `reset`."""
    try:
        import hal
    except ImportError as error:
        raise PpmcError(
            f"LinuxCNC's Python module hal cannot be imported ({error}); install LinuxCNC, and openppmc "
            "in an environment with its packages (python3 -m venv --system-site-packages)"
        ) from None

    def report(line: str) -> None:
        output.note(f"{name}: {line}")

    with HalGuard() as guard:
        machine = connect()
        if not machine.drives:
            raise PpmcError(
                f"{machine.device.link.name}: no station replies; check power, baud rate and wires"
            )
        component = hal.component(name)
        controller = Controller(component, hal, machine.drives, report, guard.check)
        component.ready()
        try:
            while True:
                with machine.device as device, guard.stop_motors_on_exit(device):
                    controller.attach(machine)
                    while controller.machine:
                        controller.cycle()
                machine = _reconnect(controller, connect, report)
        except Interrupted:
            report(f"{name_of(guard.number)}: the port was lost, so no motor was stopped")
            raise typer.Exit(guard.status) from None
        finally:
            component.exit()


def _reconnect(
    controller: Controller, connect: Callable[[], Machine], report: Callable[[str], None]
) -> Machine:
    """Wait for `reset` and open the device again."""
    while True:
        controller.cycle()
        if controller.reopen:
            controller.reopen = False
            try:
                return connect()
            except PpmcError as error:
                report(f"error: {error}")
        time.sleep(PERIOD)


@with_setup
def hal(typed: dict[str, Any], axes: Axes = None, name: Name = "openppmc") -> None:
    """Serve axes as a component of LinuxCNC's HAL, loaded by loadusr -W."""
    numbers = None
    if axes is not None:
        numbers = parse_numbers("--axes", axes, range(1, MOST_AXES + 1), f"axes are 1 to {MOST_AXES}", "1-4")

    def connect() -> Machine:
        nonlocal numbers
        with closed_on_error(open_board()) as part:
            note_mismatch(part)
            numbers = numbers or list(range(1, len(part.axes) + 1))
            xtal_hz = part.link.identity.xtal_hz
            drives = {
                number: RampDrive(
                    part.axes[part.kind.check_axis(number) - 1], setup_values(typed, number), xtal_hz
                )
                for number in numbers
            }
            return Machine(part, drives, partial(presenter_of(part.kind).start_together, part))

    serve(name, connect)
