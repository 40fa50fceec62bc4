"""A running virtual board: the program of tb/board as a child process."""

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
    """An axis. Switches: True = active; hold: True = at rest for the hold time. pulses: made since the start
    (steps of an stmc, whose alm is MON low). phases: levels of S5 to S1."""

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
    """What the board shows; the fields of an axis are those of axis 1, `second` has those of axis 2, `axes`
    of each, axis 1 first.

    seconds, clk: board time. factor: board time / wall time over the last half second. asleep: nothing can
    change before the host speaks, so nothing is computed. open: a host has the port open, at `rate` bit/s.
    lost: bytes for the host that found no room. interrupt: int_n low.
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
        """From the program's own words; those of axis 2 end in 2, and so on."""
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
    """Texts as what the fields are declared as."""
    kinds = {field.name: str(field.type) for field in fields(kind)}
    return {name: _KINDS[kinds[name]](text) for name, text in values.items()}


class Child:
    """A board in a process of its own, which ends with `close`, with the end of the `with` block or with this
    program. port: path of its pseudo-terminal. process: the child."""

    def __init__(self, command: Sequence[str | Path], env: dict[str, str] | None = None) -> None:
        try:
            # The program ends with its standard input, so with this process, however that ends.
            self.process = subprocess.Popen(
                command,
                env=env,
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                text=True,
                bufsize=1,
            )
        except OSError as error:
            raise SimError(f"the virtual board does not start: {error.strerror}") from None
        self._lock = threading.Lock()
        word, _, rest = self._line().partition(" ")
        if word != "port":
            self.close()
            raise SimError(f"the virtual board does not start: {rest or 'it ended at once'}")
        self.port = rest

    def _line(self) -> str:
        assert self.process.stdout is not None
        return self.process.stdout.readline().rstrip("\n")

    @property
    def running(self) -> bool:
        """False when the program has ended."""
        return self.process.poll() is None

    def _ask_status(self, word: str = "status") -> str:
        """What the program answers to a word. Raises SimError when it has ended."""
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
        """End the program; allowed twice."""
        process = self.process
        for pipe in (process.stdin, process.stdout):
            try:
                if pipe is not None:
                    pipe.close()
            except OSError:
                pass  # it has ended already
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
    """A virtual board; see `Child`. spec: what was asked for."""

    def __init__(self, spec: Spec, say: Callable[[str], None]) -> None:
        self.spec = spec
        program = build(
            lambda root: board_program(root, spec.part), spec.parameters, spec.vcd is not None, say
        )
        super().__init__([program, *spec.arguments()])

    def status(self) -> Status:
        """What the board shows now. Raises SimError when the program has ended."""
        return Status.parse(self._ask_status())


def start(spec: str = "", say: Callable[[str], None] | None = None, **options: object) -> SimBoard:
    """Start a virtual board: `start("cw=20000,speed=max")` or `start(cw=20000, speed="max")`.

    spec: the text after `sim:`. say: gets a line when something takes long (default: to standard error).
    Raises SpecError (a ValueError) for a bad text, SimError (a RuntimeError) if it does not build or start.
    """
    return SimBoard(parse_spec(spec, **options), say or to_stderr)


def to_stderr(line: str) -> None:
    """Tell the user, beside what a program prints."""
    print(line, file=sys.stderr, flush=True)
