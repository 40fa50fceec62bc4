"""What the part needs of the side that the host sees: parallel bus (`mailbox`) or line (`station`)."""

from __future__ import annotations

from typing import Protocol

from ..codes import Source


class HostSide(Protocol):
    """One of the two."""

    def levels(self) -> dict[str, int]:
        """Internal levels behind the pins of this side."""

    def offer(self, t: int) -> None:
        """A response may wait in the store."""

    def done(self, t: int) -> None:
        """The host's instruction has been processed and its answer stored."""

    def ready(self, t: int) -> None:
        """The interface may be used."""

    def answer(self, t: int, source: Source, block: bytes) -> None:
        """Serial mode only: the answer to an instruction, which no store keeps."""
