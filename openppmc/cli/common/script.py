"""The script files, with one command per line: `read_program` parses a file, `ScriptRunner` executes it."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any, Protocol

import typer

from ...host import PpmcError
from ...host.capabilities import COILS_OFF, Capabilities
from ...host.part import AnyAxis
from ...textfile import NotTextError, read_text
from . import output
from .options import SetupValues, with_setup
from .script_parser import (
    AXES,
    READERS,
    Numbered,
    Reader,
    check_no_more_words,
    part_commands,
    read_axis,
    read_repeat,
)
from .session import Guard, initialise, opened, setup_values, stop_all


def positions(axes: Iterable[AnyAxis]) -> str:
    """Return the positions of the axes as text."""
    at = [str(axis.position) for axis in axes]
    return f"position{'s' if len(at) > 1 else ''} {' and '.join(at)}"


class ScriptTarget(Protocol):
    """Members of an open board or an open line that a script uses."""

    guard: Guard

    @property
    def part(self) -> Any: ...
    @property
    def kind(self) -> Capabilities: ...
    @property
    def presenter(self) -> Any: ...
    @property
    def xtal_hz(self) -> int: ...
    def axis(self, number: int = 1) -> AnyAxis: ...
    def selected_axes(self, number: int | None) -> Sequence[AnyAxis]: ...


def number_of(step: Step) -> int:
    """Return the axis that a line names; 1 if the line names no axis."""
    return 1 if step.axis is None else step.axis


def execute_steps(steps: Iterable[Step], name: str, guard: Guard, do: Callable[[Step], None]) -> None:
    """Execute all steps with `do`. For a step `repeat`, its body is executed several times.

    The progress bar of a step is removed at the end of the step. If the part rejects a step, ScriptError with
    file:line is raised.
    """
    for step in steps:
        guard.check()
        if step.word == "repeat":
            for _ in range(step.values["turns"]):
                execute_steps(step.body, name, guard, do)
            continue
        try:
            do(step)
        except ScriptError:
            raise
        except PpmcError as error:
            raise ScriptError(f"{name}:{step.line}: {error}") from error
        finally:
            guard.bar_off()


class ScriptRunner:
    """Executes a program.

    Args:
        values: set-ups of the axes in use.
        say: function that prints a line for the user.
    """

    def __init__(
        self, session: ScriptTarget, values: dict[int, SetupValues], name: str, say: Callable[[str], None]
    ) -> None:
        self._session, self._guard, self._part = session, session.guard, session.part
        self._values, self._name, self._print_line = values, name, say

    def run(self, steps: Iterable[Step]) -> None:
        """Execute all steps. Raise ScriptError with file:line if the board rejects one."""
        execute_steps(steps, self._name, self._guard, self._execute_and_report)

    def _execute_and_report(self, step: Step) -> None:
        self._execute(step)
        self._session.presenter.reports(self._part, self._print_line)

    def _execute(self, step: Step) -> None:
        values, progress = step.values, self._guard.progress
        number = number_of(step)
        axis = self._session.axis(number)
        if step.word == "init":
            self._values[number] = self._values[number].merged(values)
            axis.apply(self._values[number].plan(self._session.xtal_hz, self._session.kind, number))
        elif step.word in ("move", "goto"):
            self._move(step, axis)
        elif step.word == "step":
            axis.step(values["side"])
        elif step.word == "jog":
            motion = axis.jog(values["side"], values["speed"], values["ramped"])
            self._guard.pause(self._part, values["seconds"])
            motion.wait() if motion.over else axis.stop()
        elif step.word == "home":
            fast, limit = values["approach"] == "fast", values["approach"] == "to-limit"
            axis.home(values["side"], values["speed"], fast, limit, progress=progress)
        elif step.word == "wait":
            self._guard.pause(self._part, values["seconds"])
        elif step.word == "stop":
            stop_all(self._session.presenter.busy(self._part, self._session.selected_axes(step.axis)))
        elif step.word == "zero":
            axis.zero()
        elif own := part_commands().get(step.word):
            own.execute(self._part, values)
        elif step.word == "off":
            for motor in self._selected_axes(step):
                motor.excitation_off()
        else:
            self._print_line(f"{self._name}:{step.line}: {positions(self._selected_axes(step))}")

    def _selected_axes(self, step: Step) -> tuple[AnyAxis, ...]:
        """Return the axis that a line names, or all axes that the program uses."""
        numbers = sorted(self._values) if step.axis is None else [step.axis]
        return tuple(self._session.axis(number) for number in numbers)

    def _move(self, step: Step, axis: AnyAxis) -> None:
        """Execute the command `move` or `goto` for one axis or for both axes."""
        values, progress = step.values, self._guard.progress
        absolute, speed = step.word == "goto", values.get("speed")
        first, second = values["position" if absolute else "pulses"], values["second"]
        if second is not None:
            x, y = (motor.position if absolute else 0 for motor in self._part.axes[:2])
            self._session.presenter.move_together(self._part, {1: first - x, 2: second - y}, speed, progress)
            return
        pulses = first - (axis.position if absolute else 0)
        if speed is None or pulses == 0:
            axis.move(pulses, progress)
        else:
            axis.move_constant(pulses, speed, progress)


def check_steps(steps: Iterable[Step], name: str, kind: Capabilities) -> list[int]:
    """Return the axes of a program, [1] if it names none. Raise ScriptError for an unsupported step."""
    return sorted(_axes_of(steps, name, kind)) or [1]


def _axes_of(steps: Iterable[Step], name: str, kind: Capabilities) -> set[int]:
    used: set[int] = set()
    for step in steps:
        try:
            if step.word in OF_AXES and (step.axis is not None or step.word not in OF_ALL_AXES):
                used.add(kind.check_axis(number_of(step)))
            if step.values.get("second") is not None:
                used.add(kind.check_axis(2))
        except PpmcError as error:
            raise ScriptError(f"{name}:{step.line}: {error}") from error
        if reason := _unsupported_reason(step, kind):
            raise ScriptError(f"{name}:{step.line}: {reason}")
        used |= _axes_of(step.body, name, kind)
    return used


def _unsupported_reason(step: Step, kind: Capabilities) -> str:
    """Return why the part does not support this step, as text; empty if the part supports it."""
    if own := part_commands().get(step.word):
        return own.unsupported_reason(kind, step.values)
    if step.word == "off" and COILS_OFF not in kind.has:
        return f"a {kind} cannot switch its coils off"
    return ""


def check_speeds(
    steps: Iterable[Step], values: dict[int, SetupValues], xtal_hz: int, name: str, kind: Capabilities
) -> None:
    """Raise ScriptError for unsupported speeds and ramps, before the first motion."""
    for step in steps:
        axis = number_of(step)
        try:
            if step.word == "init":
                values[axis] = values[axis].merged(step.values)
                values[axis].plan(xtal_hz, kind, axis)
            elif step.values.get("speed") is not None:
                clock = values[axis].plan(xtal_hz, kind, axis).clock
                kind.constant_clock(xtal_hz, clock, step.values["speed"])
        except PpmcError as error:
            raise ScriptError(f"{name}:{step.line}: {error}") from error
        check_speeds(step.body, values, xtal_hz, name, kind)


DEEPEST = 20


class ScriptError(PpmcError):
    """A line of a script cannot be parsed or executed; the message begins with file:line."""


@dataclass(frozen=True)
class Step:
    """One line of a script.

    Attributes:
        body: steps that a `repeat` executes several times.
        axis: number as written in the line; None if the line names no axis.
    """

    line: int
    word: str
    values: dict[str, Any]
    body: tuple[Step, ...] = ()
    axis: int | None = None


OF_AXES = ("init", "move", "goto", "step", "jog", "home", "stop", "zero", "off", "position")
"""Commands that may end with axis=N. Without axis=N, they apply to axis 1."""
OF_ALL_AXES = ("stop", "off", "position")
"""Commands that may end with axis=N. Without axis=N, they apply to all axes."""


def read_file(file: Path) -> tuple[str, str]:
    """Return name and text of a script file; - is standard input. Raise PpmcError."""
    name = "stdin" if str(file) == "-" else str(file)
    try:
        text = typer.get_text_stream("stdin").read() if name == "stdin" else read_text(file)
    except OSError as error:
        raise PpmcError(f"{file}: cannot be read ({error.strerror})") from error
    except NotTextError as error:
        raise PpmcError(f"{file}: not a text file in UTF-8 or UTF-16: {error}") from error
    except UnicodeDecodeError as error:
        raise PpmcError(f"{file}: not a text file in UTF-8") from error
    return name, text.removeprefix("\ufeff")


def read_program(
    text: str,
    name: str,
    readers: Mapping[str, Reader] | None = None,
    of_axes: Collection[str] = OF_AXES,
    numbered: Numbered = AXES,
) -> tuple[Step, ...]:
    """Return all steps of a script file. Raise ScriptError for the first invalid line.

    Args:
        readers: parser of each known command; None for the commands of parts with the UART bridge.
        of_axes: commands that may end with axis=N.
        numbered: name and range of the number that a line may end with, such as `axis=2`.
    """
    if readers is None:
        readers = READERS | {word: own.parse for word, own in part_commands().items()}
    stack: list[tuple[int, dict[str, Any], list[Step]]] = [(0, {}, [])]
    for number, line in enumerate(text.splitlines(), 1):
        words = line.split("#", 1)[0].split()
        if not words:
            continue
        word, rest = words[0].lower(), words[1:]
        try:
            if word == "end":
                check_no_more_words(rest)
                if len(stack) == 1:
                    raise ValueError("end without repeat")
                start, values, body = stack.pop()
                if not body:
                    raise ValueError("nothing to repeat")
                stack[-1][2].append(Step(start, "repeat", values, tuple(body)))
            elif word == "repeat":
                if len(stack) > DEEPEST:
                    raise ValueError(f"repeat: nested deeper than {DEEPEST}")
                stack.append((number, read_repeat(rest), []))
            elif word in readers:
                axis = read_axis(rest, numbered) if word in of_axes else None
                step = Step(number, word, readers[word](rest), axis=axis)
                if axis is not None and step.values.get("second") is not None:
                    raise ValueError("two numbers move both axes; omit axis=")
                stack[-1][2].append(step)
            else:
                known = ", ".join(sorted([*readers, "repeat", "end"]))
                raise ValueError(f"unknown command {words[0]!r} (there are {known})")
        except (ValueError, PpmcError) as error:
            raise ScriptError(f"{name}:{number}: {error}") from error
    if len(stack) > 1:
        raise ScriptError(f"{name}:{stack[-1][0]}: repeat without end")
    if not stack[0][2]:
        raise ScriptError(f"{name}:1: no command in this file")
    return tuple(stack[0][2])


@with_setup
def script(
    typed: dict[str, Any],
    file: Annotated[Path, typer.Argument(help="text file, one command a line; - for standard input")],
) -> None:
    """Execute a file of commands."""
    name, text = read_file(file)
    steps = read_program(text, name)
    with opened() as session:
        used = check_steps(steps, name, session.kind)
        values = {axis: setup_values(typed, axis) for axis in used}
        check_speeds(steps, dict(values), session.xtal_hz, name, session.kind)
        initialise(session, values)
        ScriptRunner(session, values, name, output.print_line).run(steps)
        session.guard.bar_off()
        output.print_line(f"done, {positions(session.axis(number) for number in used)}")
