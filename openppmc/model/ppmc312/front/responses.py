"""Response store of the PPMC-312: eight classes of responses and reports (P312-RSP-10..22).

The host side gets one block at a time from `select`, and calls `read` when the host has read this block.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass

from ..codes import SPONTANEOUS, Answer, Source

ALARM, ANSWER, INTERLOCK, HOLD, STOPPED, INPUT, POSITION, ENCODE = range(1, 9)
CLASSES = range(1, 9)
_DEPTH = {INPUT: 2}
_REPLACED = (INTERLOCK, HOLD, STOPPED)


def block(header: int, *content: int | bytes) -> bytes:
    """Return a response block in logical order.

    Args:
        content: bytes of the block without header and length.
    """
    body = b"".join(bytes([part]) if isinstance(part, int) else part for part in content)
    return bytes([header, len(body)]) + body


@dataclass
class Report:
    """A report or a response.

    `blocks` contains the blocks that the host has not read yet, in logical order.

    Attributes:
        source: source of the instruction to which this is the response.
    """

    kind: int
    blocks: list[bytes]
    source: Source | None = None


class Responses:
    """Stores of all classes.

    Args:
        on_stored: on_stored(t) is called when a new block may be loaded.
        was_read: was_read(t, report, block) is called when the host has read a block of a report.
            report.blocks then contains only the blocks after this one.
        response_pending: response_pending() returns True if a response is about to be stored.

    Attributes:
        live_content: functions by class. When a block of such a class is loaded for the host, its function
        returns the current content.
        serial: True in serial mode: a newer report of classes 3 to 5 replaces the older one, and no report
            waits for responses (P312-SER-21).
    """

    def __init__(
        self,
        on_stored: Callable[[int], None],
        was_read: Callable[[int, Report, bytes], None],
        response_pending: Callable[[], bool],
    ) -> None:
        self._on_stored, self._was_read, self._response_pending = on_stored, was_read, response_pending
        self.serial = False
        self.live_content: dict[int, Callable[[], bytes]] = {}
        self._stores: dict[int, list[Report]] = {kind: [] for kind in CLASSES}
        self.loaded: Report | None = None

    def waiting(self, kind: int) -> list[Report]:
        """Return the reports of a class that are not loaded yet, oldest first."""
        return [report for report in self._stores[kind] if report is not self.loaded]

    def occupied(self, kind: int) -> bool:
        """Return True if the store of a class is full of reports that have not been read completely."""
        return len(self._stores[kind]) >= _DEPTH.get(kind, 1)

    @property
    def answer(self) -> Report | None:
        """Unread response to an instruction."""
        return self._stores[ANSWER][0] if self._stores[ANSWER] else None

    def post(self, t: int, kind: int, blocks: Iterable[bytes], source: Source | None = None) -> bool:
        """Store a report. If the store is full, discard the report and return False."""
        if self.occupied(kind):
            if not self.serial or kind not in _REPLACED:
                return False
            self._stores[kind].clear()
        self._stores[kind].append(Report(kind, list(blocks), source))
        self._on_stored(t)
        return True

    def report(self, t: int, kind: int, code: Answer, *content: int | bytes) -> bool:
        """Store a spontaneous report of one block."""
        return self.post(t, kind, [block(SPONTANEOUS, code, *content)])

    def input_change(self, t: int, data: int) -> None:
        """Store report E9.

        If two reports E9 are waiting already, the new data replace the data of the second report.

        Rule: P312-RSP-21.
        """
        if not self.report(t, INPUT, Answer.INPUT_CHANGE, 0, data):
            self._stores[INPUT][1].blocks = [block(SPONTANEOUS, Answer.INPUT_CHANGE, 1, data)]

    def discard(self, kind: int) -> None:
        """Discard the reports of a class that are not loaded yet."""
        self._stores[kind] = [report for report in self._stores[kind] if report is self.loaded]

    # ------------------------------------------------------------------ methods that the host side calls

    def select(self) -> bytes | None:
        """Return the next block for the host (P312-RSP-11).

        The block belongs to the class with the lowest number that holds a report. While a response is about
        to be stored, reports of classes 3 to 8 wait.
        """
        for kind in CLASSES:
            if self._stores[kind] and (kind <= ANSWER or self.serial or not self._response_pending()):
                self.loaded = self._stores[kind][0]
                if kind in self.live_content:
                    self.loaded.blocks = [self.live_content[kind]()]
                return self.loaded.blocks[0]
        return None

    @property
    def alarm_waits(self) -> bool:
        """True if an alarm report waits."""
        return bool(self._stores[ALARM])

    def take(self, t: int) -> tuple[int, bytes] | None:
        """Return (class, block) of the first waiting report, and mark the block as read (serial mode)."""
        block = self.select()
        if block is None or self.loaded is None:
            return None
        kind = self.loaded.kind
        self.read(t)
        return kind, block

    @property
    def any_waiting(self) -> bool:
        """True if a report or response is waiting."""
        return any(self._stores.values())

    def read(self, t: int) -> None:
        """Process the end of the read of the selected block."""
        report, self.loaded = self.loaded, None
        assert report is not None
        block = report.blocks.pop(0)
        if not report.blocks:
            self._stores[report.kind].remove(report)
        self._was_read(t, report, block)
