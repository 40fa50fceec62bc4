"""What a checked instruction of the PPMC-312 leads to: a refusal, or work with its time."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

from ..codes import Answer, Source, State
from ..front.responses import block


class Refusal(Exception):  # noqa: N818 - an answer, not a fault of the program
    """An abnormality response. number: error number, status or length byte, as the answer needs it. clk: from
    the effect of a short instruction to the refusal."""

    def __init__(self, answer: Answer, number: int = 0, clk: int = 0) -> None:
        super().__init__(f"{answer.name} {number:#04x}")
        self.answer, self.number, self.clk = answer, number, clk


class Work(NamedTuple):
    """An instruction that has passed its checks.

    finish(t) does it at its edge and returns the answer without header and length, or several whole blocks;
    it may still raise Refusal. clk: from the effect of a short instruction to finish. cycles: DATASHEET time
    from the header write or the trigger in XTAL cycles, None for the time of FAST. starts: that time is the
    one of pulse 1, which is TW after t0. begin(t): what it does at once, with the effect of a short one.
    check(t): limits of a start, looked at before it is planned; may raise Refusal.
    """

    finish: Callable[[int], bytes | list[bytes]]
    clk: int = 0
    cycles: int | None = None
    starts: bool = False
    begin: Callable[[int], None] | None = None
    check: Callable[[int], None] | None = None


_FAILURES = {Answer.STATUS: 0x01, Answer.LIMIT: 0x02, Answer.COMMAND: 0x05}
_ECHO = 28


def refusal_block(refusal: Refusal, source: Source, state: State, given: bytes) -> bytes:
    """The answer (10.1); given: code and parameters as received."""
    if source is not Source.HOST:
        failed = Answer.EVENT_FAILED if source is Source.EVENT else Answer.OVERRIDE_FAILED
        return block(source, failed, _FAILURES.get(refusal.answer, 0x00))
    answer, number = refusal.answer, refusal.number
    if answer is Answer.PARAMETER:
        return block(source, answer, number, given[:_ECHO])
    if answer is Answer.STATUS:
        return block(source, answer, number, state)
    if answer is Answer.LIMIT:
        return block(source, answer)
    return block(source, answer, number)
