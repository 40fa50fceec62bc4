"""Carries script files out; `program` reads them."""

from __future__ import annotations

from collections.abc import Callable, Iterable

from ..host import Ppmc104, PpmcError, units
from .guard import Guard
from .options import SetupValues
from .program import ScriptError, Step


class Player:
    """Carries a program out. say: gets the lines that the user sees."""

    def __init__(
        self, axis: Ppmc104, guard: Guard, values: SetupValues, name: str, say: Callable[[str], None]
    ) -> None:
        self._axis, self._guard, self._values, self._name, self._say = axis, guard, values, name, say

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
            except ScriptError:
                raise
            except PpmcError as error:
                raise ScriptError(f"{self._name}:{step.line}: {error}") from error
            finally:
                self._guard.bar_off()

    def _do(self, step: Step) -> None:
        axis, values, progress = self._axis, step.values, self._guard.progress
        if step.word == "init":
            self._values = self._values.merged(values)
            axis.apply(self._values.plan(axis.link.identity.xtal_hz))
        elif step.word == "move":
            speed = values["speed"]
            if speed is None or values["pulses"] == 0:
                axis.move(values["pulses"], progress)
            else:
                axis.move_constant(values["pulses"], speed, progress)
        elif step.word == "goto":
            axis.move_to(values["position"], progress)
        elif step.word == "step":
            axis.step(values["side"])
        elif step.word == "jog":
            axis.jog(values["side"], values["speed"], values["ramped"])
            self._guard.pause(axis, values["seconds"])
            axis.stop()
        elif step.word == "home":
            fast, limit = values["approach"] == "fast", values["approach"] == "to-limit"
            axis.home(values["side"], values["speed"], fast, limit, progress=progress)
        elif step.word == "wait":
            self._guard.pause(axis, values["seconds"])
        elif step.word == "stop":
            if axis.status().busy:
                axis.stop()
        elif step.word == "zero":
            axis.zero()
        elif step.word == "aux":
            axis.aux(values["on"])
        elif step.word == "auxo":
            axis.auxo(values["value"])
        elif step.word == "off":
            axis.excitation_off()
        else:
            self._say(f"{self._name}:{step.line}: position {axis.position}")


def check_speeds(steps: Iterable[Step], values: SetupValues, xtal_hz: int, name: str) -> None:
    """Refuse speeds and ramps that the part cannot do before anything moves. ScriptError."""
    for step in steps:
        try:
            if step.word == "init":
                values = values.merged(step.values)
                values.plan(xtal_hz)
            elif step.values.get("speed") is not None and values.external_clock is None:
                units.any_clock(xtal_hz, step.values["speed"])
        except PpmcError as error:
            raise ScriptError(f"{name}:{step.line}: {error}") from error
        check_speeds(step.body, values, xtal_hz, name)
