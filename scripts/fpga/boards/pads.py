"""All pads that a part uses on a board: signal, direction, package pin and electrical properties."""

from __future__ import annotations

from dataclasses import dataclass

from cocotb_tests.harness.project import ProjectError
from scripts.fpga.boards.carrier import Carrier, Port
from scripts.fpga.boards.description import Carried, Description

HOST_RESET = "host_rst_n"
"""The reset input from the host of a bus, active low; it is not a port of a carrier."""


@dataclass(frozen=True)
class Pad:
    """One pad of the FPGA.

    Attributes:
        bit: name of the port, or of a bit of the port.
        way: direction: in, out or inout.
        pull: pull resistor: up, down or none.
    """

    bit: str
    pin: str
    where: str
    way: str
    pull: str
    standard: str

    @property
    def port(self) -> str:
        """The port name without the bit number."""
        return self.bit.split("[")[0]


@dataclass(frozen=True)
class Group:
    """A group of pads with a title."""

    title: str
    pads: tuple[Pad, ...]


@dataclass(frozen=True)
class Fitted:
    """A part on a board, with the ports of its carrier and all pads."""

    board: Description
    on: Carried
    carrier: Carrier
    groups: tuple[Group, ...]

    @property
    def top(self) -> str:
        """Name of the top."""
        return self.board.top(self.on)

    @property
    def pads(self) -> list[Pad]:
        """All pads, in the order of the groups."""
        return [pad for group in self.groups for pad in group.pads]

    def bits(self, port: str) -> list[str]:
        """Return the bits of a port that have a pad, lowest first."""
        found = [pad.bit for pad in self.pads if pad.port == port]
        return sorted(found, key=lambda bit: int(bit.rstrip("]").rpartition("[")[2]) if "[" in bit else 0)


def own_pads(board: Description, on: Carried) -> list[Group]:
    """Return the pads of the board itself: oscillator, reset, LEDs, constant outputs, UART."""
    clock, reset = board.clock, board.reset
    rows = [(clock["port"], clock["pin"], clock["what"], "in", "none")]
    if reset:
        rows.append((reset["port"], reset["pin"], reset["what"], "in", reset.get("pull", "up")))
    if on.leds:
        rows += [(led["port"], led["pin"], led["what"], "out", "none") for led in board.leds["pins"]]
    rows += [(name, tie["pin"], tie["what"], "out", "none") for name, tie in board.ties.items()]
    groups = [Group("Board", tuple(_pad(board, *row) for row in rows))]
    if "uart" in on.hosts:
        lines = (("uart_rxd", "rxd", "in", "up"), ("uart_txd", "txd", "out", "none"))
        groups.append(
            Group(
                board.uart["title"],
                tuple(
                    _pad(board, port, board.uart[line]["pin"], board.uart[line]["what"], way, pull)
                    for port, line, way, pull in lines
                ),
            )
        )
    return groups


def _pad(board: Description, bit: str, pin: object, where: str, way: str, pull: str) -> Pad:
    """Return a pad, with the I/O standard of its package pin."""
    exceptions = board.pads.get("exceptions", {})
    standards = [name for name, pins in exceptions.items() if str(pin) in map(str, pins)]
    return Pad(bit, str(pin), where, way, pull, standards[0] if standards else board.pads["standard"])


def _signal(fitted_to: str, carrier: Carrier, signal: str) -> tuple[list[str], str]:
    """Return a signal's bits, lowest first, and its direction; raise ProjectError if it is unknown."""
    name = signal.split("[")[0]
    if name == HOST_RESET:
        return [signal], "in"
    if name in carrier.two_way():
        port = carrier.side(name)
        way = "out" if port.output else "inout"
        names = Port(name, False, port.bits, "", "").bit_names()
    elif name in carrier.ports:
        port = carrier.ports[name]
        way, names = "out" if port.output else "in", port.bit_names()
    else:
        raise ProjectError(f"{fitted_to}: {signal}: {carrier.name} has no such port")
    if signal != name and signal not in names:
        raise ProjectError(f"{fitted_to}: {signal}: {carrier.name} has {names[0]} to {names[-1]}")
    return ([signal] if signal != name else names), way


def fit(board: Description, on: Carried, carrier: Carrier) -> Fitted:
    """Return a part with its pads on a board; raise ProjectError for a wrong signal or pin."""
    where = f"{board.source}: parts: {on.name}"
    groups = own_pads(board, on)
    for title, signals in on.pins.items():
        pads = []
        for signal, places in signals.items():
            bits, way = _signal(where, carrier, signal)
            if len(places) > len(bits):
                raise ProjectError(f"{where}: {signal}: {len(places)} pins for {len(bits)} bits")
            for bit, place in zip(bits, places, strict=False):
                name, _, _ = place.partition(", ")
                if name not in board.headers:
                    raise ProjectError(f"{where}: {signal}: {name} is not a header pin")
                pull = "none" if way == "out" else "up"
                pads.append(_pad(board, bit, board.headers[name], place, way, pull))
        groups.append(Group(title, tuple(pads)))
    fitted = Fitted(board, on, carrier, tuple(groups))
    pins, ports = [pad.pin for pad in fitted.pads], [pad.bit for pad in fitted.pads]
    for names in (pins, ports):
        if twice := next((name for name in names if names.count(name) > 1), None):
            raise ProjectError(f"{where}: {twice} is used twice")
    return fitted
