"""Coverage crosses of the data sheet: instruction of a frame × state, counted in the golden model."""

from __future__ import annotations

from typing import Any

from cocotb_tests.harness.crosses import Count, Cross, Crosses, before
from openppmc.model.pmc006.codes import LETTERS
from openppmc.model.pmc006.instructions.executor import Executor

NONE = "an undefined code"
OPS = (*LETTERS, NONE)
MOTION = Cross(
    "instruction of a frame and motion",
    OPS,
    (
        *("at standstill", "at standstill, start blocked"),
        *("move, rate changing", "move, rate constant", "speed mode"),
    ),
)
BESIDE = Cross("instruction of a frame and other activity", OPS, ("nothing", "program", "EEPROM"))


def _motion(context: Any) -> str:
    if not context.motion.busy:
        return MOTION.columns[context.settings.free or context.stop_monitor.locked]
    return "speed mode" if context.running else MOTION.columns[2 + context.motion.at_constant_speed]


def _hook(count: Count) -> None:
    def begun(executor: Any, t: int, command: Any) -> None:
        context, op = executor._context, chr(command.code)
        op = op if op in LETTERS else NONE
        count(MOTION.name, op, _motion(context))
        count(
            BESIDE.name,
            op,
            "EEPROM" if context.eeprom.busy else "nothing" if context.program.halted else "program",
        )

    before(Executor, "_execute_host", begun)


CROSSES = Crosses((MOTION, BESIDE), _hook)
