"""Result of the checks of an instruction of the PPMC-312: a rejection, or work with its time."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

from ..codes import Answer, Source, State
from ..front.responses import block


class Rejection(Exception):  # noqa: N818 - an answer, not a fault of the program
    """Rejection of an instruction, with an abnormality response.

    Args:
        number: byte of the response that states the reason: error number, status or length byte.
        clk: cycles from the effect of a short instruction to the rejection.
    """

    def __init__(self, answer: Answer, number: int = 0, clk: int = 0) -> None:
        super().__init__(f"{answer.name} {number:#04x}")
        self.answer, self.number, self.clk = answer, number, clk


class Work(NamedTuple):
    """Work of an instruction that has passed its checks.

    Attributes:
        finish: finish(t) executes the work at edge t. It returns the response without header and length, or
            several whole blocks; it may raise Rejection.
        clk: cycles from the effect of a short instruction to finish.
        cycles: DATASHEET time in crystal cycles, from the write of the header or from the trigger; `None` if
            the time is that of FAST.
        starts: True if the DATASHEET time ends at pulse 1, which is TW after t0.
        begin: begin(t) executes the first effect, at the edge at which a short instruction takes effect.
        check: check(t) checks the limits of a start before it is planned; it may raise Rejection.
    """

    finish: Callable[[int], bytes | list[bytes]]
    clk: int = 0
    cycles: int | None = None
    starts: bool = False
    begin: Callable[[int], None] | None = None
    check: Callable[[int], None] | None = None


_FAILURES = {Answer.STATUS: 0x01, Answer.LIMIT: 0x02, Answer.COMMAND: 0x05}
_ECHO = 28


def rejection_block(rejection: Rejection, source: Source, state: State, given: bytes) -> bytes:
    """Return the response to a rejected instruction (docs/ppmc312/README.md, 6.1 Blocks).

    Args:
        given: code and parameters of the instruction as received.
    """
    if source is not Source.HOST:
        failed = Answer.EVENT_FAILED if source is Source.EVENT else Answer.OVERRIDE_FAILED
        return block(source, failed, _FAILURES.get(rejection.answer, 0x00))
    answer, number = rejection.answer, rejection.number
    if answer is Answer.PARAMETER:
        return block(source, answer, number, given[:_ECHO])
    if answer is Answer.STATUS:
        return block(source, answer, number, state)
    if answer is Answer.LIMIT:
        return block(source, answer)
    return block(source, answer, number)
