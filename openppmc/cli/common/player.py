"""Carries script files out; `program` reads them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import Any, Protocol

from ...host import PpmcError
from ...host.kind import COILS_OFF, Kind
from ...host.part import AnyAxis
from .guard import Guard
from .options import SetupValues
from .program import OF_ALL_AXES, OF_AXES, ScriptError, Step
from .session import stop_all
from .words import own_words


def positions(axes: Iterable[AnyAxis]) -> str:
    """Where they stand, in words."""
    at = [str(axis.position) for axis in axes]
    return f"position{'s' if len(at) > 1 else ''} {' and '.join(at)}"


class Played(Protocol):
    """An open board or line, as far as a script needs it."""

    guard: Guard

    @property
    def part(self) -> Any: ...
    @property
    def kind(self) -> Kind: ...
    @property
    def view(self) -> Any: ...
    @property
    def xtal_hz(self) -> int: ...
    def axis(self, number: int = 1) -> AnyAxis: ...
    def chosen(self, number: int | None) -> Sequence[AnyAxis]: ...


def number_of(step: Step) -> int:
    """The axis that a line is about."""
    return 1 if step.axis is None else step.axis


def carry_out(steps: Iterable[Step], name: str, guard: Guard, do: Callable[[Step], None]) -> None:
    """All steps by `do`, repeated ones as often as they say; a progress bar ends with its step. ScriptError
    with file:line for what the part refuses."""
    for step in steps:
        guard.check()
        if step.word == "repeat":
            for _ in range(step.values["turns"]):
                carry_out(step.body, name, guard, do)
            continue
        try:
            do(step)
        except ScriptError:
            raise
        except PpmcError as error:
            raise ScriptError(f"{name}:{step.line}: {error}") from error
        finally:
            guard.bar_off()


class Player:
    """Carries a program out. values: set-ups of the axes in use. say: gets the lines that the user sees."""

    def __init__(
        self, session: Played, values: dict[int, SetupValues], name: str, say: Callable[[str], None]
    ) -> None:
        self._session, self._guard, self._part = session, session.guard, session.part
        self._values, self._name, self._say = values, name, say

    def run(self, steps: Iterable[Step]) -> None:
        """All steps. ScriptError with file:line for what the board refuses."""
        carry_out(steps, self._name, self._guard, self._do_and_report)

    def _do_and_report(self, step: Step) -> None:
        self._do(step)
        self._session.view.reports(self._part, self._say)

    def _do(self, step: Step) -> None:
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
            stop_all(self._session.view.busy(self._part, self._session.chosen(step.axis)))
        elif step.word == "zero":
            axis.zero()
        elif own := own_words().get(step.word):
            own.do(self._part, values)
        elif step.word == "off":
            for motor in self._chosen(step):
                motor.excitation_off()
        else:
            self._say(f"{self._name}:{step.line}: {positions(self._chosen(step))}")

    def _chosen(self, step: Step) -> tuple[AnyAxis, ...]:
        """The axis that a line names, or all that the program uses."""
        numbers = sorted(self._values) if step.axis is None else [step.axis]
        return tuple(self._session.axis(number) for number in numbers)

    def _move(self, step: Step, axis: AnyAxis) -> None:
        """move and goto, one axis or both."""
        values, progress = step.values, self._guard.progress
        absolute, speed = step.word == "goto", values.get("speed")
        first, second = values["position" if absolute else "pulses"], values["second"]
        if second is not None:
            x, y = (motor.position if absolute else 0 for motor in self._part.axes[:2])
            self._session.view.together(self._part, {1: first - x, 2: second - y}, speed, progress)
            return
        pulses = first - (axis.position if absolute else 0)
        if speed is None or pulses == 0:
            axis.move(pulses, progress)
        else:
            axis.move_constant(pulses, speed, progress)


def check_steps(steps: Iterable[Step], name: str, kind: Kind) -> list[int]:
    """The axes that a program uses, 1 if it names none. ScriptError for what the part does not have."""
    return sorted(_axes_of(steps, name, kind)) or [1]


def _axes_of(steps: Iterable[Step], name: str, kind: Kind) -> set[int]:
    used: set[int] = set()
    for step in steps:
        try:
            if step.word in OF_AXES and (step.axis is not None or step.word not in OF_ALL_AXES):
                used.add(kind.check_axis(number_of(step)))
            if step.values.get("second") is not None:
                used.add(kind.check_axis(2))
        except PpmcError as error:
            raise ScriptError(f"{name}:{step.line}: {error}") from error
        if lacks := _lacks(step, kind):
            raise ScriptError(f"{name}:{step.line}: {lacks}")
        used |= _axes_of(step.body, name, kind)
    return used


def _lacks(step: Step, kind: Kind) -> str:
    """What a part does not have for this step, empty if it has all."""
    if own := own_words().get(step.word):
        return own.lacks(kind, step.values)
    if step.word == "off" and COILS_OFF not in kind.has:
        return f"a {kind} cannot switch its coils off"
    return ""


def check_speeds(
    steps: Iterable[Step], values: dict[int, SetupValues], xtal_hz: int, name: str, kind: Kind
) -> None:
    """Refuse speeds and ramps that the part cannot do before anything moves. ScriptError."""
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
