"""Power-up of the PMC006B4 (docs/pmc006/README.md, 14 EEPROM).

The sequence checks the restore key, releases the bus, and reads the parameters and the program.
"""

from __future__ import annotations

from collections.abc import Callable

from ...chip import Phase
from ..execution_context import ExecutionContext
from ..settings import PAGE, Settings, framed, values_of
from .eeprom import COMPLETE, COPY, MARK, PROGRAM, SIZE, Bus, BusSequence, Engine


def program_of(block: bytes) -> list[int] | None:
    """Return the words of a program from its bytes in the EEPROM, `None` if checksum or mark is invalid."""
    body, total, mark = block[:SIZE], int.from_bytes(block[SIZE : SIZE + 2], "little"), block[SIZE + 2]
    if mark != COMPLETE or sum(body) % 65536 != total:
        return None
    return [int.from_bytes(body[at : at + 4], "little") for at in range(0, SIZE, 4)]


class Boot:
    """Sequence after a reset.

    Args:
        ended: ended(t, valid) is called at the end of BOOT; `valid` is True if there is a valid program.
        stored: stored(t) is called when registers have received new values.
    """

    def __init__(
        self,
        context: ExecutionContext,
        engine: Engine,
        bus: Bus,
        ended: Callable[[int, bool], None],
        stored: Callable[[int], None],
    ) -> None:
        self._context, self._engine, self._bus = context, engine, bus
        self._ended, self._stored = ended, stored
        self._restoring = self._restore_pending = self._whole = False
        self._loaded = self._copied = False
        self._page, self._rest = bytearray(PAGE), bytearray(MARK + 1 - PROGRAM)

    def begin(self, t: int) -> None:
        """Begin the sequence at edge t, the first internal edge."""
        self._engine.run(t, "boot", self._read_sequence(), self._process_program)

    def restore(self, t: int) -> None:
        """Process FSET, which was low for the required time (P006-EEP-21)."""
        self._restoring = self._restore_pending = True
        self._apply(t, vars(Settings()))

    def _read_sequence(self) -> BusSequence[None]:
        yield
        while not self._bus.level("fset_n") and not self._restoring:
            yield
        if not self._bus.level("sda_i"):
            yield from self._bus.clear()
        yield from self._engine.poll()
        yield from self._engine.fetch(0, len(self._page), self._page.__setitem__)
        yield from self._engine.fetch(PROGRAM, len(self._rest), self._rest.__setitem__)
        self._whole = True

    def _copy_read_sequence(self) -> BusSequence[None]:
        """Read the copy of page 0, because page 0 is invalid. The buffer is the same."""
        yield from self._engine.fetch(COPY, len(self._page), self._page.__setitem__)
        self._whole = True

    # ------------------------------------------------------------------ processing of the data

    def _process_program(self, t: int) -> None:
        """Process the program that was read. The bus has been idle for one cycle."""
        words = program_of(bytes(self._rest)) if self._whole else None
        self._valid = words is not None
        self._context.program.words[:] = words or [0] * (SIZE // 4)
        core_timing = self._context.services.core_timing
        self._at(
            t + (core_timing.program_kept if self._valid else core_timing.program_cleared), self._check_page
        )

    def _check_page(self, t: int) -> None:
        """Check the parameter block, after the program was stored or cleared."""
        if self._whole and framed(bytes(self._page)) and not self._restoring:
            self._at(t + self._context.services.core_timing.fields, self._load)
        else:
            self._schedule_finish(t)

    def _load(self, t: int) -> None:
        """Load the parameters, whose fields have been checked."""
        values = values_of(bytes(self._page))
        if values is None or self._restoring:
            self._schedule_finish(t)
            return
        self._loaded = True
        core_timing = self._context.services.core_timing
        self._at(t + core_timing.trigm, lambda now: self._store(now, values))
        self._at(t + core_timing.fields, self._schedule_finish)

    def _store(self, t: int, values: dict[str, int]) -> None:
        if not self._restoring:
            self._apply(t, values)

    def _apply(self, t: int, values: dict[str, int]) -> None:
        self._context.settings.load(values)
        self._stored(t)

    def _schedule_finish(self, t: int) -> None:
        self._at(t + 1, self._finish)

    def _finish(self, t: int) -> None:
        """Start a pending restore, or read the copy of an invalid page; otherwise, end the sequence."""
        if self._restore_pending:
            self._restore_pending = False
            self._engine.run(t + 1, "fact", self._engine.fact(), self._schedule_finish)
        elif self._whole and not (self._loaded or self._copied or self._restoring):
            self._copied, self._whole = True, False
            self._engine.run(t + 1, "boot", self._copy_read_sequence(), self._process_program)
        else:
            if not self._restoring:
                self._engine.page_valid = not (self._loaded and self._copied)
            self._ended(t, self._valid)

    def _at(self, t: int, action: Callable[[int], None]) -> None:
        self._context.services.queue.at(t, Phase.STORE, action)
