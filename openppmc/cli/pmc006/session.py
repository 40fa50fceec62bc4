"""The line of PMC006B4 that a command has opened, and output of the commands."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Annotated, Any

import typer

from ...host import MotionResult, Pmc006, Pmc006Bus
from ...host.pmc006.part import ScanResult, find
from ...host.pmc006.settings import SETTINGS, Setting, drive_current, mean_acceleration
from ...host.pmc006.wire import ADDRESSES, FACTORY, LAST, Flags, Modes
from ..common.board import BOARD
from ..common.line_session import guarded, line_options, parse_numbers
from ..common.session import Guard

if TYPE_CHECKING:
    from rich.table import Table

LINE_WORDS = "rs485, rts=high, rts=low, patience=SECONDS"
Address = Annotated[
    str | None,
    typer.Option(
        "--address",
        "-a",
        metavar="N",
        envvar="OPENPPMC_ADDRESS",
        help="pmc006: controllers, as 3, 1,5 or 1-4 (the first that replies)",
    ),
]


def parse_addresses(text: str) -> list[int]:
    """Parse `3`, `1,5` or `1-4`. Raise BadParameter for any other text."""
    span = f"addresses are 1 to {LAST}, factory-new controllers have {FACTORY}"
    return parse_numbers("--address", text, ADDRESSES, span, "1-4")


@dataclass
class Session:
    """An open line."""

    bus: Pmc006Bus
    guard: Guard

    def selected_axes(self, text: str | None) -> list[Pmc006]:
        """Return the controllers of --address; without --address, the first controller that replies."""
        if text is None:
            numbers = [find(self.bus.line, self._on_scan_progress)]
            self.guard.bar_off()
        else:
            numbers = parse_addresses(text)
            self.bus.check(numbers)
        parts = [self.bus.axis(number) for number in numbers]
        for part in parts:
            part.alone = len(parts) == 1
        return parts

    def one(self, text: str | None) -> Pmc006:
        """Return the controller of a command for one controller.

        Raise BadParameter if --address names several controllers.
        """
        if text is not None and len(parse_addresses(text)) > 1:
            raise typer.BadParameter(f"--address {text!r}: the command is for one controller; name only one")
        return self.selected_axes(text)[0]

    def scan(self) -> list[ScanResult]:
        """Return all controllers that reply; show a progress bar during the search."""
        found = self.bus.scan(progress=self._on_scan_progress)
        self.guard.bar_off()
        return found

    def _on_scan_progress(self, address: int) -> None:
        self.guard.check()
        self.guard.count_bar("looking for controllers", ADDRESSES.index(address), len(ADDRESSES))

    def on_word_progress(self, done: int, of: int) -> None:
        """Check for signals and update the bar. This is the progress callback of a download."""
        self.guard.check()
        self.guard.count_bar("words of the program", done, of)


def open_bus() -> Pmc006Bus:
    """Open the line."""
    options = line_options(BOARD.line, LINE_WORDS)
    if BOARD.baud is not None:
        options["baud"] = BOARD.baud
    return Pmc006Bus.open(BOARD.port, **options)


@contextmanager
def opened() -> Iterator[Session]:
    """Open the line. A signal n stops the motors, and the exit status is then 128 + n."""
    with guarded(open_bus) as (bus, guard):
        yield Session(bus, guard)


_HEADS = ("address", "version", "state", "position", "line faults")


def state(flags: Flags | None, modes: Modes | None) -> str:
    """Return a text with the state of the motor and each condition that prevents a start."""
    if flags is None or modes is None:
        return "-"
    words = ["running" if modes.running else "moving"] if flags.busy else []
    words += [f"stopped by EXT{number}" for number in flags.stops]
    words += ["off-line"] if modes.free else []
    words += ["stalled"] if flags.stall else []
    return ", ".join(words) or "at rest"


def prefix(part: Pmc006) -> str:
    """Return the prefix of lines about a controller; empty if the program uses only one."""
    return "" if part.alone else f"controller {part.address}: "


def found_table(found: Iterable[ScanResult]) -> Table:
    """Return a table with one row for each controller."""
    from rich.table import Table

    grid = Table(box=None, pad_edge=False)
    for head in _HEADS:
        grid.add_column(head, justify="left" if head == "state" else "right")
    for one in found:
        grid.add_row(
            str(one.address),
            one.version or "-",
            state(one.flags, one.modes),
            "-" if one.position is None else str(one.position),
            str(one.counters.faults),
        )
    return grid


def found_values(found: Iterable[ScanResult]) -> list[dict[str, Any]]:
    """Return the values for JSON."""
    return [
        {
            "address": one.address,
            "version": one.version,
            "state": state(one.flags, one.modes),
            "position": one.position,
            "line": asdict(one.counters),
            "trouble": one.problem,
        }
        for one in found
    ]


def end_line(end: MotionResult) -> str:
    """Return one line with position, steps, and the cause of the end of the motion."""
    steps = ""
    if end.pulses is not None:
        steps = f", {abs(end.pulses)} steps {'backward' if end.pulses < 0 else 'forward'}"
    return f"{end.message_prefix}position {end.position}{steps}: {end.cause_text}"


# ---------------------------------------------------------------------- one controller


def status_values(part: Pmc006) -> dict[str, Any]:
    """Return all values that change without a command: position, state, levels, line errors."""
    flags, modes, ports = part.flags(), part.modes(), part.ports()
    return {
        "address": part.address,
        "position": part.position,
        "state": state(flags, modes),
        "flags": {"ext1": flags.ext1, "ext2": flags.ext2, "stall": flags.stall},
        "enabled": {"ext1": modes.ext1_enabled, "ext2": modes.ext2_enabled},
        "levels": {"ext1": ports.ext1, "ext2": ports.ext2},
        "inputs": ports.inputs,
        "outputs": ports.outputs,
        "line": asdict(part.counters),
    }


def status_rows(values: dict[str, Any]) -> dict[str, str]:
    """Return the values as rows of text."""
    stops = [
        f"{name.upper()} {'on' if on else 'off'}, level {int(values['levels'][name])}"
        for name, on in values["enabled"].items()
    ]
    return {
        "address": str(values["address"]),
        "position": str(values["position"]),
        "motor": values["state"],
        "stops": "; ".join(stops),
        "GPI5…GPI1": f"{values['inputs']:05b}",
        "GPO5…GPO1": f"{values['outputs']:05b}",
    }


def io_values(part: Pmc006) -> dict[str, Any]:
    """Return the bits of the port word."""
    ports = part.ports()
    return {
        **{f"gpi{n + 1}": ports.inputs >> n & 1 for n in range(5)},
        **{f"gpo{n + 1}": ports.outputs >> n & 1 for n in range(5)},
        "ext1": int(ports.ext1),
        "ext2": int(ports.ext2),
    }


def settings_values(part: Pmc006, names: Iterable[str] = tuple(SETTINGS)) -> dict[str, int]:
    """Return the active settings."""
    return {name: getattr(part, name) for name in names}


def settings_rows(values: dict[str, int]) -> list[tuple[str, ...]]:
    """Return rows of values with unit, range and meaning; the first row has the headings.

    A star marks settings that `save` stores.
    """
    rows: list[tuple[str, ...]] = [("setting", "value", "unit", "", "range", "meaning")]
    for name, value in values.items():
        one: Setting = SETTINGS[name]
        star = "*" if one.saved else ""
        rows.append((name, str(value), one.unit, star, one.span, _meaning(name, value, one.text)))
    return rows


def _meaning(name: str, value: int, text: str) -> str:
    """Return the meaning of a setting.

    For some settings, the text also contains a value that is calculated from the setting.
    """
    if name == "current":
        return f"{text}: drives {drive_current(value)} mA"
    if name in ("acceleration", "deceleration"):
        return f"{mean_acceleration(value)} steps/s² on average"
    if name == "attenuation":
        return f"current at standstill {100 / 2**value:g} % of the peak"
    return text
