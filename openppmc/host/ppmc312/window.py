"""The access to a PPMC-312 through its block registers on the bridge.

An instruction needs one message to the bridge and one from the bridge.

The message to the bridge contains these steps: wait until an instruction may be written, write it, wait for a
response, read it. The operation WAIT on RAR returns the number of unread bytes of a response. With a time
limit of 0, WAIT ends the script if all bytes were read. Therefore, no byte is read twice or lost, whether a
pending report arrives before or after the response.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence

from ...model.ppmc312.codes import Cause
from ..errors import ProtocolError, Timeout
from ..link import Link
from ..script import Answer, Result, Script
from .answers import BadResponse, Response
from .blocks import WINDOW, bus_order, start_address

# Registers, written by `make packages` from packages/registers/ppmc312.rdl.
CSR = 0x0  # control and status
CONTROL = 0x2  # write: WCR, 0x20 opens the write window; read: RCR, rewinds the read window, reads as 0x00
ADDRESS = 0x3  # write: WAR, write pointer; read: RAR, read pointer
WRITE = 0x5  # DWR, a byte into the write window; reads as 0x00
READ = 0x7  # DRR, the next byte of the read window
EWRQ = 0x40  # `wrq_n` requests a faster host to wait
EWIRQ = 0x20  # interrupt while MWEF = 0
ERIRQ = 0x10  # interrupt while MREF = 0
MWEF = 0x08  # the write window is closed: an instruction is being processed
MREF = 0x04  # no answer or report is in the read window
# End of the registers.
EMPTY = 0x40
"""Value of RAR if no response is in the read window.

If a response is in the read window, RAR is this value minus the number of unread bytes, 1 to 32.
"""
MASK, LEFT = 0x60, 0x20
"""Mask for the value of RAR, and the masked value that indicates unread bytes."""
WAIT_READ = 0x70 | READ
"""Operation code of a wait that reads bytes of a response."""
SHORTEST, MOST_REPORTS = 3, 64
ANSWER_MS, READY_MS = 250, 50
POSITION_SIZE, START_SIZE, STOPPED_SIZE, POSITION_BYTES = 8, 4, 8, 4
"""Sizes in bytes.

They are the sizes of the response to a position read, of the response to a start, of the report that a motion
has ended, and of the position in this report.
"""


class Window:
    """The transport of instructions through the block registers.

    Args:
        arrived: called with each response or report that does not belong to an instruction of the host.
    """

    def __init__(self, link: Link, arrived: Callable[[Response], None]) -> None:
        self._link = link
        self._on_response = arrived
        self._bytes = bytearray()
        self._bytes_left = 0
        self._state_unknown = True
        self._count = 0
        self.answers = 0
        """Number of responses so far; see `core.Instructions.answers`."""
        self._on_answer: Callable[[Response], None] = lambda response: None

    def open(self) -> None:
        """Prepare the registers after a reset, or after another program used them.

        Afterwards, responses cause an interrupt, and no response is pending or partly read.
        """
        self._bytes.clear()
        self._bytes_left = 0
        # With DATASHEET timing, the part accepts no byte for 1.6 ms after a reset. If the wait fails, the
        # next access raises the error.
        self._link.attempt(Script().timeout(READY_MS).wait(CSR, MWEF, 0))
        self._link.execute(Script().write(CSR, ERIRQ).read(CONTROL))
        self._state_unknown = False
        self.collect()

    # ------------------------------------------------------------------ instructions

    def execute(self, block: bytes, gives: int = SHORTEST, milliseconds: int = ANSWER_MS) -> Response:
        """Execute an instruction; return its response. If it has several blocks, return the first one.

        Args:
            gives: expected size of the response; it only affects the speed.
            milliseconds: longest execution time.

        Raises:
            CommandRefused: the part rejected the instruction.
            Timeout, ProtocolError, LinkError: the transfer failed.
        """
        if self._state_unknown:
            self.open()
        script = self._append_block(Script().wait(CSR, MWEF, 0).write(CONTROL, WINDOW), block)
        script.timeout(milliseconds)
        answer = self._exchange(self._append_read(script, gives))
        found = answer or self._await(milliseconds)
        if (error := found.error) is not None:
            raise error
        return found

    def execute_moves(
        self, first: bytes, moves: Sequence[bytes], milliseconds: int, on_answer: Callable[[Response], None]
    ) -> None:
        """Execute a read of the position, and then moves, all with one frame.

        The next move starts only if the part reports the normal end of the move before it, and no other
        report. Otherwise, the script ends.

        Args:
            first: instruction that reads the position.
            milliseconds: longest wait for the end of a move.
            on_answer: called with each response to an instruction, before the report of the end is processed.

        Raises:
            ProtocolError, LinkError: the transfer failed.
        """
        if self._state_unknown:
            self.open()
        script = Script().timeout(milliseconds).wait(CSR, MWEF, 0).write(CONTROL, WINDOW)
        self._append_exact_read(self._append_block(script, first), POSITION_SIZE)
        for block in moves:
            self._append_exact_read(self._append_block(script, block), START_SIZE)
            self._append_exact_read(script, STOPPED_SIZE, POSITION_BYTES)
            # With the limit 0, the wait reads one byte, the cause.
            script.timeout(0).wait(READ, 0xFF, Cause.NORMAL).timeout(milliseconds)
            script.read_many(READ, STOPPED_SIZE - POSITION_BYTES - 1)
        self._on_answer, before = on_answer, self.answers
        try:
            self._exchange(script)
            if self.answers - before <= len(moves):
                self.collect()  # the response to a rejected start has another size
        finally:
            self._on_answer = lambda response: None

    def next_block(self) -> Response:
        """Return the next block of a response that has several blocks."""
        return self._await(ANSWER_MS)

    def _await(self, milliseconds: int) -> Response:
        """Wait for the response to the host's instruction and return it.

        Other responses and reports may arrive earlier.
        """
        for _ in range(MOST_REPORTS):
            if (found := self._exchange(self._append_read(Script().timeout(milliseconds), 8))) is not None:
                return found
        raise ProtocolError(f"{self._link.name}: reports without end instead of an answer: reset the part")

    def collect(self) -> None:
        """Read the pending responses.

        A response to an instruction of the host is discarded, because no instruction waits for a response.
        """
        if self._state_unknown:
            self.open()
        for _ in range(MOST_REPORTS):
            before = self._count
            self._exchange(self._append_read(Script().timeout(0), 8), patient=False)
            if self._count == before:
                return
        raise ProtocolError(f"{self._link.name}: reports without end: reset the part")

    def was_reset(self) -> bool:
        """Return True if the part may have been reset since `open`. The part executes no instruction."""
        return self._state_unknown or not self._link.execute(Script().read(CSR)).values[0][0] & ERIRQ

    # ------------------------------------------------------------------ internal

    @staticmethod
    def _append_block(script: Script, block: bytes) -> Script:
        """Append the operations that write an instruction block into the open write window."""
        return script.write(ADDRESS, start_address(block)).write_many(WRITE, bus_order(block))

    @staticmethod
    def _append_exact_read(script: Script, size: int, part: int = 0) -> Script:
        """Append a wait for a response of exactly `size` bytes, and a read of its first `part` bytes.

        If `part` is 0, the whole response is read.
        """
        return script.wait(ADDRESS, 0xFF, EMPTY - size).read_many(READ, part or size)

    @staticmethod
    def _append_read(script: Script, gives: int) -> Script:
        """Append the operations that read a response.

        Each response has at least SHORTEST bytes. After these bytes, a byte is read only if an unread byte
        remains.
        """
        script.wait(ADDRESS, MASK, LEFT).read_many(READ, SHORTEST).timeout(0)
        for _ in range(gives - SHORTEST):
            script.wait(ADDRESS, MASK, LEFT).read(READ)
        return script

    def _exchange(self, script: Script, patient: bool = True) -> Response | None:
        """Execute a script, read the bytes of the response that it has not read, and return the response.

        Args:
            patient: True to raise Timeout if no response arrives; False to return `None`.

        Returns:
            The response to the instruction of the host, if any.
        """
        self._state_unknown = True
        answer = self._link.attempt(script)
        found = self._assemble(script, answer, patient)
        while self._bytes_left:
            rest = Script().read_many(READ, self._bytes_left)
            found = self._feed(self._bytes_left, self._link.execute(rest).values[0]) or found
        self._state_unknown = False
        return found

    def _assemble(self, script: Script, answer: Answer, patient: bool) -> Response | None:
        """Assemble responses from the values that a script returned."""
        found, left, received = None, None, False
        giving = [op for op in script.ops if op.response_size]
        for op, value in zip(giving, answer.values, strict=False):
            register = op.code[0] & 15
            if op.name == "WAIT" and register == ADDRESS:
                left = EMPTY - value[0]
            elif register == READ and left is not None:
                found, received = self._feed(left, value) or found, True
                left = self._bytes_left
        failed = answer.failed
        if left and failed is not None and failed.code[0] == WAIT_READ and answer.result is Result.TIMED_OUT:
            # The failed wait has already read the cause byte of the response, which is not NORMAL.
            self._feed(left, [answer.last])
        if answer.result is Result.TIMED_OUT and (received or not patient):
            return found
        if answer.result is Result.TIMED_OUT and answer.failed is not None:
            raise Timeout(f"{self._link.name}: {self._no_response_text(answer)}")
        self._link.check_answer(answer)
        return found

    @staticmethod
    def _no_response_text(answer: Answer) -> str:
        assert answer.failed is not None
        if answer.failed.code[0] & 15 == CSR:
            return "the part accepts no instruction: check for a reset, and for another program that uses it"
        return "the part does not respond: check whether it is in reset"

    def _feed(self, left: int, data: Iterable[int]) -> Response | None:
        """Process bytes of a response.

        Args:
            left: number of unread bytes of the response before `data` was read.
        """
        found = None
        for byte in data:
            self._bytes.append(byte)
            left -= 1
            self._bytes_left = left
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
                    self._on_answer(response)
                else:
                    self._on_response(response)
        return found
