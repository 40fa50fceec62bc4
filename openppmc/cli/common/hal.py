"""The command `hal`: axes as a component of LinuxCNC's HAL. The logic is in `openppmc.linuxcnc`."""

from __future__ import annotations

import signal
import time
from collections.abc import Callable, Sequence
from functools import partial
from types import FrameType
from typing import Annotated, Any

import typer

from ...drives import drive_of
from ...errors import PpmcError
from ...host.capabilities import SetupRequest
from ...host.errors import NoAnswer
from ...host.part import Part
from ...host.stopping import NOT_KNOWN, name_of, stop_motors
from ...linuxcnc import PERIOD, Controller, Machine
from . import output
from .line_session import parse_numbers
from .options import MOST_AXES, with_setup
from .presenter import presenter_of
from .session import Guard, Interrupted, note_mismatch, open_board, setup_values

Name = Annotated[str, typer.Option(metavar="NAME", help="name of the component, as in loadusr -Wn")]
Axes = Annotated[
    str | None, typer.Option("--axes", metavar="N", help="axes or stations, as 1,3 or 1-4 (all)")
]


class HalGuard(Guard):
    """Guard that treats repeated SIGTERMs as one, because halcmd may send several during a deceleration."""

    def _on_signal(self, number: int, frame: FrameType | None) -> None:
        if number != signal.SIGTERM or not self.count:
            super()._on_signal(number, frame)


def serve(name: str, open_device: Callable[[], Any], machine_of: Callable[[Any], Machine]) -> None:
    """Run the component until a signal ends it.

    If the port is lost, it is opened again when the pin `reset` requests it.
    """
    try:
        import hal
    except ImportError as error:
        raise PpmcError(
            f"LinuxCNC's Python module hal cannot be imported ({error}); install LinuxCNC, and openppmc "
            "in an environment with its packages (python3 -m venv --system-site-packages)"
        ) from None

    def report(line: str) -> None:
        output.note(f"{name}: {line}")

    def connect() -> Machine:
        device = open_device()
        try:
            return machine_of(device)
        except BaseException:
            device.close()
            raise

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
    """Wait until the pin `reset` rises, and open the device again.

    Motors that are still moving are stopped, because the component does not follow their motions.
    """
    while True:
        controller.cycle()
        if controller.reopen:
            controller.reopen = False
            try:
                machine = connect()
                state = stop_motors([machine.device], every=True)
                if state.startswith(NOT_KNOWN):
                    raise NoAnswer(state)
                report(f"the port is open again: {state}")
                return machine
            except PpmcError as error:
                report(f"error: {error}")
        time.sleep(PERIOD)


def serve_line(
    name: str,
    numbers: Sequence[int] | None,
    open_bus: Callable[[], Any],
    request: Callable[[int], SetupRequest | None],
) -> None:
    """Serve these stations of a line (`None`: all that reply); `request` returns the set-up of a station."""

    def machine_of(bus: Any) -> Machine:
        nonlocal numbers
        if not numbers:
            bus.scan()
            numbers = [axis.number for axis in bus.axes]
        bus.check(numbers)
        return Machine(bus, {number: drive_of(bus.axis(number), request(number)) for number in numbers})

    serve(name, open_bus, machine_of)


@with_setup
def hal(typed: dict[str, Any], axes: Axes = None, name: Name = "openppmc") -> None:
    """Serve axes as a component of LinuxCNC's HAL, loaded by loadusr -W."""
    numbers = None
    if axes is not None:
        numbers = parse_numbers("--axes", axes, range(1, MOST_AXES + 1), f"axes are 1 to {MOST_AXES}", "1-4")

    def machine_of(part: Part) -> Machine:
        note_mismatch(part)
        chosen = numbers or range(1, len(part.axes) + 1)
        axis = {number: part.axes[part.kind.check_axis(number) - 1] for number in chosen}
        drives = {one: drive_of(axis[one], setup_values(typed, one).request(one)) for one in chosen}
        return Machine(part, drives, partial(presenter_of(part.kind).start_together, part))

    serve(name, open_board, machine_of)
