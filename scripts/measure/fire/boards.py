"""Boards on which the sessions of `make fire` run: golden models, with the true positions of their motors."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from openppmc.host import CW, FORWARD, Pmc006, Ppmc104, Ppmc312, Ppmc312Bus, Ppmc2104, PpmcBank, Stmc
from openppmc.host.line_port import ModelLine
from openppmc.host.model_port import ModelPort
from openppmc.host.port import Port

SLOW, FAST = 115_200, 1_000_000


class BridgeBoard:
    """Board with a bridge.

    Attributes:
        starts: true positions of the motors when the session begins; the counters of the board are then 0.
    """

    def __init__(self, text: str) -> None:
        self.port = ModelPort(f"speed=max,{text}")
        self.starts = list(self.port.board.positions)

    def positions(self) -> list[int]:
        """Return the present true positions of the motors."""
        board = self.port.board
        board.run_until(board.t)
        return list(board.positions)

    def restart(self) -> None:
        """Switch the board off and on. The motors stay where they are."""
        port, at = self.port, self.positions()
        fresh = ModelPort(port.name.removeprefix("model:"))
        fresh.board.t = port.board.t
        fresh.board.part.run_until(port.board.t)
        fresh.board.positions[:] = at
        fresh.board.on_interrupt = port._interrupt
        port.board, port.bridge = fresh.board, fresh.bridge


class LineBoard:
    """Serial line with stations; the sessions use the first station."""

    def __init__(self, text: str, baud: int, part: str) -> None:
        self.port = ModelLine(f"speed=max,{text}", baud, part)
        self.starts = self.positions()

    def positions(self) -> list[int]:
        """Return the present true positions of the motors."""
        self.port.line.settle()
        return [self.port.line.stations[0].position]

    def restart(self) -> None:
        """Switch the station off and on. The motor stays where it is."""
        self.positions()
        self.port.line.stations[0].reset()


@dataclass(frozen=True)
class Target:
    """Part with its driver on a line.

    Attributes:
        make: creates a new board.
        open: opens the driver on a port.
        axes: returns the axes of the driver that a session uses.
        prepare: initialises an axis.
        jog: starts an endless motion in the positive direction.
        group: True if the part can start several axes together.
        queue: True if the axes have the method `moves`.
        baud: rate at which the driver opens its port.
        crc: True if the frames have a CRC; else they have a checksum, which may miss two faults in a frame.
        unchecked: number of the bit of a hexadecimal digit to the board that the checksum may miss, or None.
    """

    make: Callable[[], Any]
    open: Callable[[Port], Any]
    axes: Callable[[Any], Sequence[Any]] = lambda device: device.axes
    prepare: Callable[[Any], object] = lambda axis: axis.initialise(2000, 8000, 40)
    jog: Callable[[Any], Any] = lambda axis: axis.jog(CW)
    group: bool = False
    queue: bool = True
    baud: int = SLOW
    crc: bool = True
    unchecked: int | None = None


def _bridge(driver: Any, text: str, baud: int = FAST, **more: Any) -> Target:
    return Target(lambda: BridgeBoard(text), lambda port: driver.open(port, baud), **more)


def _fast_steps(motor: Pmc006) -> None:
    motor.start_speed = motor.stop_speed = motor.max_speed = 2000


TARGETS: dict[str, Target] = {
    "ppmc104": _bridge(Ppmc104, "part=ppmc104"),
    "ppmc104-115200": _bridge(Ppmc104, "part=ppmc104", SLOW),
    "ppmc104-datasheet": _bridge(Ppmc104, "part=ppmc104,timing=DATASHEET"),
    "ppmc2104": _bridge(Ppmc2104, "part=ppmc2104", group=True),
    "stmc": _bridge(Stmc, "part=stmc"),
    "bank": _bridge(PpmcBank, "part=bank,axes=4", axes=lambda device: device.axes[:2], group=True),
    "bank-115200": _bridge(
        PpmcBank, "part=bank,axes=4", SLOW, axes=lambda device: device.axes[:2], group=True
    ),
    "ppmc312": _bridge(Ppmc312, "part=ppmc312", prepare=lambda axis: axis.initialise(4000, 8000, 600)),
    "ppmc312-115200": _bridge(
        Ppmc312, "part=ppmc312", SLOW, prepare=lambda axis: axis.initialise(4000, 8000, 600)
    ),
    "ppmc312-serial": Target(
        lambda: LineBoard("stations=1", 83_333, "ppmc312-serial"),
        lambda port: Ppmc312Bus.open(port, 83_333),
        lambda bus: [bus.axis(0)],
        lambda axis: axis.initialise(4000, 8000, 600),
        queue=False,
        baud=83_333,
        crc=False,
        unchecked=3,
    ),
    "pmc006": Target(
        lambda: LineBoard("eeprom=none", 115_200, "pmc006"),
        lambda port: Pmc006.open(port, 255, 115_200),
        prepare=_fast_steps,
        jog=lambda motor: motor.jog(FORWARD),
        queue=False,
        crc=False,
    ),
}
