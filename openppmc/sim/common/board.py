"""Running virtual board: the program of tb/board as a child process."""

from __future__ import annotations

import subprocess
import sys
import threading
from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields
from itertools import takewhile
from pathlib import Path
from types import TracebackType
from typing import Any, TypeVar

from .build import SimError, board_program, build
from .spec import Spec, parse_spec, suffixes

Self = TypeVar("Self", bound="Child")
_KINDS: dict[str, Callable[[str], object]] = {
    "int": int,
    "float": float,
    "bool": lambda text: text == "1",
    "str": str,
}


@dataclass(frozen=True)
class AxisStatus:
    """State of an axis.

    In the fields of switches, True means active.

    For an stmc, `pulses` counts steps, and `alm` is True while MON is low.

    Attributes:
        hold: True if the motor has been at standstill for at least the hold time.
        pulses: number of pulses since the start of the board.
        phases: levels of S5 to S1.
    """

    position: int
    pulses: int
    l1: bool
    l2: bool
    l3: bool
    l4: bool
    cnp: bool
    alm: bool
    hold: bool
    phases: str


@dataclass(frozen=True)
class Status(AxisStatus):
    """State of the board.

    The inherited fields of AxisStatus state axis 1. `second` states axis 2, and `axes` states all axes, axis
    1 first.

    Attributes:
        seconds, clk: time of the board in s, and in cycles.
        factor: board time divided by wall time, measured over the last half second.
        asleep: True if no state can change before the host sends, so that the simulation is paused.
        open: True if a host has opened the port; the line rate is then `rate` bit/s.
        lost: bytes for the host that were discarded because the buffer was full.
        interrupt: True while int_n is low.
    """

    clk: int
    seconds: float
    factor: float
    asleep: bool
    open: bool
    rate: int
    lost: int
    interrupt: bool
    link: bool
    second: AxisStatus | None
    axes: tuple[AxisStatus, ...]

    @classmethod
    def parse(cls, line: str) -> Status:
        """Parse a status line of the program. The names of values of axis 2 end in 2, and so on."""
        values = dict(word.partition("=")[::2] for word in line.split())
        values["interrupt"] = values.pop("int")
        axes = []
        for end in takewhile(lambda end: "position" + end in values, suffixes()):
            axes.append(AxisStatus(**_typed(AxisStatus, {n: values[n + end] for n in _names(AxisStatus)})))
        second = axes[1] if len(axes) > 1 else None
        names = [name for name in _names(cls) if name not in ("second", "axes")]
        known = _typed(cls, {name: values[name] for name in names})
        return cls(**known, second=second, axes=tuple(axes))


def _names(kind: type[AxisStatus]) -> list[str]:
    return [field.name for field in fields(kind)]


def _typed(kind: type[AxisStatus], values: dict[str, str]) -> dict[str, Any]:
    """Convert texts to the declared types of the fields."""
    kinds = {field.name: str(field.type) for field in fields(kind)}
    return {name: _KINDS[kinds[name]](text) for name, text in values.items()}


class Child:
    """Board in a separate process.

    `close`, the end of the `with` block and the end of this program end the process.

    Attributes:
        port: path of its pseudo-terminal.
        process: the child process.
    """

    def __init__(self, command: Sequence[str | Path], env: dict[str, str] | None = None) -> None:
        try:
            # The program ends when its standard input is closed, and therefore also when this process is
            # killed.
            self.process = subprocess.Popen(
                command,
                env=env,
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                encoding="utf-8",
                bufsize=1,
            )
        except OSError as error:
            raise SimError(f"the virtual board does not start: {error.strerror}") from None
        self._lock = threading.Lock()
        word, _, rest = self._line().partition(" ")
        if word != "port":
            self.close()
            raise SimError(f"the virtual board does not start: {rest or 'it ended immediately'}")
        self.port = rest

    def _line(self) -> str:
        assert self.process.stdout is not None
        return self.process.stdout.readline().rstrip("\n")

    @property
    def running(self) -> bool:
        """True while the program is running."""
        return self.process.poll() is None

    def _ask_status(self, word: str = "status") -> str:
        """Send a command of one word, and return the status in the reply.

        Raise SimError if the program has ended.
        """
        assert self.process.stdin is not None
        try:
            with self._lock:
                self.process.stdin.write(f"{word}\n")
                self.process.stdin.flush()
                line = self._line()
        except (OSError, ValueError):
            line = ""
        if not line.startswith("status "):
            raise SimError("the virtual board has ended")
        return line.removeprefix("status ")

    def close(self) -> None:
        """End the program; a second call has no effect."""
        process = self.process
        for pipe in (process.stdin, process.stdout):
            try:
                if pipe is not None:
                    pipe.close()
            except OSError:
                pass  # the program has already ended
        try:
            process.wait(timeout=2)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()

    def __enter__(self: Self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()


class SimBoard(Child):
    """Virtual board; see `Child`.

    Args:
        spec: the requested board.
    """

    def __init__(self, spec: Spec, say: Callable[[str], None]) -> None:
        self.spec = spec
        program = build(
            lambda root: board_program(root, spec.part), spec.parameters, spec.vcd is not None, say
        )
        super().__init__([program, *spec.arguments()])

    def status(self) -> Status:
        """Return the current state. Raise SimError if the program has ended."""
        return Status.parse(self._ask_status())


def start(spec: str = "", say: Callable[[str], None] | None = None, **options: object) -> SimBoard:
    """Start a virtual board: `start("cw=20000,speed=max")` or `start(cw=20000, speed="max")`.

    Raises SpecError (a ValueError) for an invalid text, SimError (a RuntimeError) if the board cannot be
    built or started.

    Args:
        spec: the text after `sim:`.
        say: function that prints a line if a step of the start takes long; by default, it prints on standard
            error.
    """
    return SimBoard(parse_spec(spec, **options), say or to_stderr)


def to_stderr(line: str) -> None:
    """Print a line for the user on standard error."""
    print(line, file=sys.stderr, flush=True)
