"""Carries script files out; `program` reads them."""

from __future__ import annotations

from collections.abc import Callable, Iterable

from ...host import Axis, End, NothingToStop, Ppmc104, Ppmc312, Ppmc2104, PpmcError
from ...host.basis.kind import AUX, COILS_OFF, Kind
from ..ppmc312 import words
from . import show
from .options import SetupValues
from .program import OF_ALL_AXES, OF_AXES, ScriptError, Step
from .session import Session


def positions(axes: Iterable[Axis]) -> str:
    """Where they stand, in words."""
    at = [str(axis.position) for axis in axes]
    return f"position{'s' if len(at) > 1 else ''} {' and '.join(at)}"


def stop_all(axes: tuple[Axis, ...], now: bool = False) -> list[End]:
    """Stop motions, perhaps of another program, and wait for their ends. All are stopped before an error is
    told; that one rests already is none as long as another moves."""
    errors: list[PpmcError] = []
    moving = []
    for axis in axes:
        try:
            (axis.halt if now else axis.stop)(wait=False)
            moving.append(axis)
        except PpmcError as error:
            errors.append(error)
    ends = [axis.motion.wait() for axis in moving if axis.motion is not None]
    for error in errors:
        if len(errors) == len(axes) or not isinstance(error, NothingToStop):
            raise error
    return ends


class Player:
    """Carries a program out. values: set-ups of the axes in use. say: gets the lines that the user sees."""

    def __init__(
        self, session: Session, values: dict[int, SetupValues], name: str, say: Callable[[str], None]
    ) -> None:
        self._session, self._guard, self._part = session, session.guard, session.part
        self._values, self._name, self._say = values, name, say

    def run(self, steps: Iterable[Step]) -> None:
        """All steps. ScriptError with file:line for what the board refuses."""
        for step in steps:
            self._guard.check()
            if step.word == "repeat":
                for _ in range(step.values["turns"]):
                    self.run(step.body)
                continue
            try:
                self._do(step)
                show.reports(self._part, self._say)
            except ScriptError:
                raise
            except PpmcError as error:
                raise ScriptError(f"{self._name}:{step.line}: {error}") from error
            finally:
                self._guard.bar_off()

    def _do(self, step: Step) -> None:
        values, progress = step.values, self._guard.progress
        number = step.axis or 1
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
            if motion.end is None:
                axis.stop()
        elif step.word == "home":
            fast, limit = values["approach"] == "fast", values["approach"] == "to-limit"
            axis.home(values["side"], values["speed"], fast, limit, progress=progress)
        elif step.word == "wait":
            self._guard.pause(self._part, values["seconds"])
        elif step.word == "stop":
            status = self._part.status().raw
            if busy := tuple(motor for motor in self._session.chosen(step.axis) if status & motor.busy):
                stop_all(busy)
        elif step.word == "zero":
            axis.zero()
        elif step.word == "aux" and isinstance(self._part, Ppmc104):
            self._part.aux(values["on"])
        elif step.word in words.WORDS and isinstance(self._part, Ppmc312):
            words.do(self._part, step.word, values)
        elif step.word == "auxo" and isinstance(self._part, (Ppmc104, Ppmc2104, Ppmc312)):
            self._part.auxo(values["value"])
        elif step.word == "off":
            for motor in self._chosen(step):
                motor.excitation_off()
        else:
            self._say(f"{self._name}:{step.line}: {positions(self._chosen(step))}")

    def _chosen(self, step: Step) -> tuple[Axis, ...]:
        """The axis that a line names, or all that the program uses."""
        numbers = sorted(self._values) if step.axis is None else [step.axis]
        return tuple(self._session.axis(number) for number in numbers)

    def _move(self, step: Step, axis: Axis) -> None:
        """move and goto, one axis or both."""
        values, progress = step.values, self._guard.progress
        absolute, speed = step.word == "goto", values.get("speed")
        wanted = [values["position" if absolute else "pulses"], values["second"]]
        if wanted[1] is not None and isinstance(self._part, Ppmc2104):
            at = [motor.position if absolute else 0 for motor in self._part.axes]
            x, y = (value - begin for value, begin in zip(wanted, at, strict=True))
            self._part.together(x, y, speed, speed, progress)
            return
        pulses = wanted[0] - (axis.position if absolute else 0)
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
                used.add(kind.check_axis(step.axis or 1))
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
    if lacks := words.lacks(step.word, kind):
        return lacks
    if step.word == "off" and COILS_OFF not in kind.has:
        return f"a {kind} cannot switch its coils off"
    if step.word == "aux" and AUX not in kind.has:
        return f"a {kind} has no output AUX" + (": use auxo" if kind.outputs else "")
    if step.word == "auxo" and not kind.outputs:
        return f"a {kind} has no auxiliary outputs"
    if step.word == "auxo" and step.values["value"] > kind.outputs:
        return f"outputs {step.values['value']} is outside 0 to {kind.outputs}"
    return ""


def check_speeds(
    steps: Iterable[Step], values: dict[int, SetupValues], xtal_hz: int, name: str, kind: Kind
) -> None:
    """Refuse speeds and ramps that the part cannot do before anything moves. ScriptError."""
    for step in steps:
        axis = step.axis or 1
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
