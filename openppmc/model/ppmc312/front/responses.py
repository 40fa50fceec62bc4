"""Response store of the PPMC-312: eight classes of answers and reports (P312-RSP-10..22).

The host side takes one block at a time with `pick`, and says with `read` that the host has had it.
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
    """A response block in logical order; content without header and length."""
    body = b"".join(bytes([part]) if isinstance(part, int) else part for part in content)
    return bytes([header, len(body)]) + body


@dataclass
class Report:
    """Blocks that the host has not read yet, in logical order. source: of an answer to an instruction."""

    kind: int
    blocks: list[bytes]
    source: Source | None = None


class Responses:
    """All stores. offered(t) is called when there may be something new to load, read(t, report, block) when
    the host has read a block, which report.blocks no longer has. holding(): an answer is about to be stored.
    fresh: classes whose content is what is true when they are loaded. serial: a newer report of classes 3 to
    5 replaces the older, and nothing waits for answers (P312-SER-21)."""

    def __init__(
        self,
        offered: Callable[[int], None],
        was_read: Callable[[int, Report, bytes], None],
        holding: Callable[[], bool],
    ) -> None:
        self._offered, self._was_read, self._holding = offered, was_read, holding
        self.serial = False
        self.fresh: dict[int, Callable[[], bytes]] = {}
        self._stores: dict[int, list[Report]] = {kind: [] for kind in CLASSES}
        self.loaded: Report | None = None

    def waiting(self, kind: int) -> list[Report]:
        """Reports of a class that are not loaded, oldest first."""
        return [report for report in self._stores[kind] if report is not self.loaded]

    def occupied(self, kind: int) -> bool:
        """Whether the store is full: a report in it has not been read completely."""
        return len(self._stores[kind]) >= _DEPTH.get(kind, 1)

    @property
    def answer(self) -> Report | None:
        """The unread answer to an instruction."""
        return self._stores[ANSWER][0] if self._stores[ANSWER] else None

    def post(self, t: int, kind: int, blocks: Iterable[bytes], source: Source | None = None) -> bool:
        """Store a report; False, and it is lost, if the store is occupied."""
        if self.occupied(kind):
            if not self.serial or kind not in _REPLACED:
                return False
            self._stores[kind].clear()
        self._stores[kind].append(Report(kind, list(blocks), source))
        self._offered(t)
        return True

    def report(self, t: int, kind: int, code: Answer, *content: int | bytes) -> bool:
        """Store a spontaneous report of one block."""
        return self.post(t, kind, [block(SPONTANEOUS, code, *content)])

    def input_change(self, t: int, data: int) -> None:
        """E9: the newest data replace those of the second report that waits (P312-RSP-21)."""
        if not self.report(t, INPUT, Answer.INPUT_CHANGE, 0, data):
            self._stores[INPUT][1].blocks = [block(SPONTANEOUS, Answer.INPUT_CHANGE, 1, data)]

    def withdraw(self, kind: int) -> None:
        """Forget the reports of a class that are not loaded."""
        self._stores[kind] = [report for report in self._stores[kind] if report is self.loaded]

    # ------------------------------------------------------------------ for the host side

    def pick(self) -> bytes | None:
        """The next block for the host, of the waiting class with the lowest number (P312-RSP-11).

        While an answer is about to be stored, reports of classes 3 to 8 wait for it.
        """
        for kind in CLASSES:
            if self._stores[kind] and (kind <= ANSWER or self.serial or not self._holding()):
                self.loaded = self._stores[kind][0]
                if kind in self.fresh:
                    self.loaded.blocks = [self.fresh[kind]()]
                return self.loaded.blocks[0]
        return None

    @property
    def alarmed(self) -> bool:
        """An alarm report waits."""
        return bool(self._stores[ALARM])

    def take(self, t: int) -> tuple[int, bytes] | None:
        """Serial mode: class and block of the first waiting report, which is read by that."""
        block = self.pick()
        if block is None or self.loaded is None:
            return None
        kind = self.loaded.kind
        self.read(t)
        return kind, block

    @property
    def any_waiting(self) -> bool:
        """Whether `pick` has something."""
        return any(self._stores.values())

    def read(self, t: int) -> None:
        """The host has read the block that was picked."""
        report, self.loaded = self.loaded, None
        assert report is not None
        block = report.blocks.pop(0)
        if not report.blocks:
            self._stores[report.kind].remove(report)
        self._was_read(t, report, block)
