"""The block registers of a PPMC-312 behind the bridge: an instruction is one message there and one back.

A message says: when an instruction may be written, write this one; when a response is there, read it. WAIT on
RAR says how much of a response is left, and with a time limit of 0 it ends the script where there is none. So
no byte is read twice and none is lost, whatever comes first: the answer, or a report that waited.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable

from ..errors import ProtocolError, Timeout
from ..link import Link
from ..script import Answer, Result, Script
from .answers import BadResponse, Response
from .blocks import WINDOW, bus_order, start_address

CSR, CONTROL, ADDRESS, WRITE, READ = 0, 2, 3, 5, 7
INTERRUPT_ON_RESPONSE, NOT_WRITABLE = 0x10, 0x08
EMPTY = 0x40
"""RAR without a response; less by the number of bytes left, 1 to 32."""
MASK, LEFT = 0x60, 0x20
"""What RAR shows when bytes are left, and nothing else."""
SHORTEST, MOST_REPORTS = 3, 64
ANSWER_MS, READY_MS = 250, 50


class Window:
    """arrived(response): gets everything but the answers to the host's instructions."""

    def __init__(self, link: Link, arrived: Callable[[Response], None]) -> None:
        self._link = link
        self._arrived = arrived
        self._bytes = bytearray()
        self._left = 0
        self._unsure = True
        self._count = 0
        self.answers = 0
        """Answers to the host so far; reports that come after one are younger than its instruction."""

    def open(self) -> None:
        """After a reset, or when another program may have left something: interrupt on responses, no
        half-read one, nothing waiting."""
        self._bytes.clear()
        self._left = 0
        # With DATASHEET timing a part takes nothing for 1.6 ms after a reset; a stuck one says so later.
        self._link.attempt(Script().timeout(READY_MS).wait(CSR, NOT_WRITABLE, 0))
        self._link.execute(Script().write(CSR, INTERRUPT_ON_RESPONSE).read(CONTROL))
        self._unsure = False
        self.collect()

    # ------------------------------------------------------------------ instructions

    def ask(self, block: bytes, gives: int = SHORTEST, milliseconds: int = ANSWER_MS) -> Response:
        """Carry out an instruction; returns its answer, the first block of it if there are several.

        gives: expected size of the answer, for speed only. milliseconds: how long the part may take. Raises
        the part's refusal (CommandRefused), Timeout, ProtocolError and the errors of the link.
        """
        if self._unsure:
            self.open()
        script = Script().wait(CSR, NOT_WRITABLE, 0)
        script.write(CONTROL, WINDOW).write(ADDRESS, start_address(block))
        script.write_many(WRITE, bus_order(block)).timeout(milliseconds)
        answer = self._talk(self._reading(script, gives))
        found = answer or self._await(milliseconds)
        if (error := found.error) is not None:
            raise error
        return found

    def more(self) -> Response:
        """The next block of an answer of several."""
        return self._await(ANSWER_MS)

    def _await(self, milliseconds: int) -> Response:
        """The answer to the host; other responses may come first."""
        for _ in range(MOST_REPORTS):
            if (found := self._talk(self._reading(Script().timeout(milliseconds), 8))) is not None:
                return found
        raise ProtocolError(f"{self._link.name}: reports without end instead of an answer: reset the part")

    def collect(self) -> None:
        """Read what waits. An answer to the host that nobody waits for is dropped."""
        if self._unsure:
            self.open()
        for _ in range(MOST_REPORTS):
            before = self._count
            self._talk(self._reading(Script().timeout(0), 8), patient=False)
            if self._count == before:
                return
        raise ProtocolError(f"{self._link.name}: reports without end: reset the part")

    # ------------------------------------------------------------------ inside

    @staticmethod
    def _reading(script: Script, gives: int) -> Script:
        """Ops that read a response: the first bytes are always there, each other one is asked for."""
        script.wait(ADDRESS, MASK, LEFT).read_many(READ, SHORTEST).timeout(0)
        for _ in range(gives - SHORTEST):
            script.wait(ADDRESS, MASK, LEFT).read(READ)
        return script

    def _talk(self, script: Script, patient: bool = True) -> Response | None:
        """Run such a script, then read the rest of a response that it has begun; returns the answer to the
        host if there is one. patient: that no response came is an error."""
        self._unsure = True
        answer = self._link.attempt(script)
        found = self._take(script, answer, patient)
        while self._left:
            rest = Script().read_many(READ, self._left)
            found = self._feed(self._left, self._link.execute(rest).values[0]) or found
        self._unsure = False
        return found

    def _take(self, script: Script, answer: Answer, patient: bool) -> Response | None:
        """Sort the values of a script into responses."""
        found, left, heard = None, None, False
        giving = [op for op in script.ops if op.gives]
        for op, value in zip(giving, answer.values, strict=False):
            if op.name == "WAIT" and op.code[0] & 15 == ADDRESS:
                left = EMPTY - value[0]
            elif op.name != "WAIT" and left is not None:
                found, heard = self._feed(left, value) or found, True
        if answer.result is Result.TIMED_OUT and (heard or not patient):
            return found
        if answer.result is Result.TIMED_OUT and answer.failed is not None:
            raise Timeout(f"{self._link.name}: {self._silence(answer)}")
        self._link.judge(answer)
        return found

    @staticmethod
    def _silence(answer: Answer) -> str:
        assert answer.failed is not None
        if answer.failed.code[0] & 15 == CSR:
            return "the part takes no instruction: is it in reset, or busy with another program's one?"
        return "the part does not answer: is it in reset?"

    def _feed(self, left: int, data: Iterable[int]) -> Response | None:
        """Bytes of a response of which so many were left before the first one."""
        found = None
        for byte in data:
            self._bytes.append(byte)
            left -= 1
            self._left = left
            if left == 0:
                raw = bytes(reversed(self._bytes))
                self._bytes.clear()
                self._count += 1
                try:
                    response = Response(raw)
                except BadResponse as error:
                    raise ProtocolError(f"{self._link.name}: {error}") from error
                if response.to_host:
                    found = response
                    self.answers += 1
                else:
                    self._arrived(response)
        return found
