"""User program of a PMC006B4: download, read-back, burn, run, halt."""

from __future__ import annotations

from collections.abc import Callable, Collection
from functools import partial

from ...model.pmc006.program import WORDS, Program, harmless
from ..errors import NoAnswer, OutOfRange
from .axis import Axis
from .wire import Code, ProgramRuns, ProgramVerifyFailed, Storage, StorageBusy, StorageFailed

OnCount = Callable[[int, int], None]
"""Function that is called with the number of transferred words and the total number of words."""
SAVE_SECONDS, BURN_SECONDS = 0.03, 0.4
"""Time in s for which the EEPROM is busy after a save or a burn, with some reserve."""
_LOOKS = 10
"""Number of reads of the EEPROM's state, at intervals of the time above. It allows for a slow I2C clock."""
_MASK = 0xFFFFFFFF


class Memory(Axis):
    """User program and EEPROM of a controller; see `pmc006.Pmc006`."""

    _here: int | None = None
    """Word pointer of the part, `None` if it is unknown."""

    # ------------------------------------------------------------------ program in the buffer

    def load_program(self, program: Program, progress: OnCount | None = None) -> None:
        """Write those words of a program that differ from the buffer, and read these words back.

        Raises:
            ProgramRuns: a program is running.
            ProgramVerifyFailed: a word that was read back differs from the program.
        """
        if self.program_runs():
            raise ProgramRuns(0, f"{self._message_prefix}{ProgramRuns.text}")
        found = self._read_words(range(WORDS), progress, WORDS)
        places = [place for place, word in enumerate(program.words) if word != found[place]]
        total = WORDS + 2 * len(places)
        for done, place in enumerate(places, WORDS + 1):
            self._seek(place)
            self._write(place, program.words[place])
            if progress is not None:
                progress(done, total)
        self._here = None
        for place, got in self._read_words(places, progress, total).items():
            if got != (want := program.words[place]):
                raise ProgramVerifyFailed(
                    got & _MASK,
                    f"{self._message_prefix}word {place} of the program reads {got:08X}, not {want:08X}: "
                    "load it again",
                )

    def read_program(self, progress: OnCount | None = None) -> Program:
        """Return the program in the buffer. The call is allowed at any time."""
        return Program(tuple(self._read_words(range(WORDS), progress, WORDS).values()))

    def _read_words(self, places: Collection[int], progress: OnCount | None, total: int) -> dict[int, int]:
        """Read words of the buffer.

        Args:
            total: number of words in the whole operation, for `progress`.
        """
        words: dict[int, int] = {}
        self._here = None
        for place in places:
            self._seek(place)
            words[place] = self._read(place)
            if progress is not None:
                progress(total - len(places) + len(words), total)
        return words

    # ------------------------------------------------------------------ EEPROM

    def save(self) -> None:
        """Save the settings for the next power-up, and wait until they are stored.

        Raises:
            StorageBusy: the EEPROM is being written.
            StorageFailed: the EEPROM did not respond.
        """
        self._store(Code.SAVE, SAVE_SECONDS)

    def burn_program(self) -> None:
        """Save the program for the next power-up, and wait until it is stored.

        Raises:
            StorageBusy: the EEPROM is being written.
            StorageFailed: the EEPROM did not respond.
        """
        self._store(Code.BURN, BURN_SECONDS)

    def _store(self, code: Code, seconds: float) -> None:
        repeated = self.counters.repeated
        got = self.execute(code, good=_yes_or_no)
        if not got and self.counters.repeated == repeated:
            raise StorageBusy(0, f"{self._message_prefix}{StorageBusy.text}")
        # If the reply was lost and the repeated instruction is rejected, the part is executing the first one.
        for _ in range(_LOOKS):
            self.line.pause(seconds)
            state = self.execute(Code.STORED, good=lambda value: value in set(Storage))
            if state == Storage.KEPT:
                return
            if state == Storage.FAILED:
                raise StorageFailed(state, f"{self._message_prefix}{StorageFailed.text}")
        raise StorageBusy(0, f"{self._message_prefix}{StorageBusy.text}")

    # ------------------------------------------------------------------ running

    def run_program(self, begin: int = 0) -> None:
        """Start the program at an instruction, 0 to 99.

        Raises:
            ProgramRuns: a program is running.
            LostReply: it is unknown whether the program was started.
        """
        self._point(2 * _instruction(begin))
        if not self._execute_risky(Code.RUN_PROGRAM, self._started):
            raise ProgramRuns(0, f"{self._message_prefix}{ProgramRuns.text}")

    def _started(self) -> int | None:
        try:
            if self.program_runs():
                return 1
        except NoAnswer as error:
            raise self._lost_reply(str(error)) from error
        raise self._lost_reply("no program runs now, but a short one may have run")

    def halt_program(self) -> None:
        """Halt the program; a motion continues.

        After the call, the functions of the keys are off, and `offline` is unchanged.
        """
        offline = self.offline
        self.offline = 0
        if offline:
            self.offline = 1

    def try_instruction(self, place: int) -> None:
        """Execute one instruction of the buffer, 0 to 99.

        Jumps and similar instructions have no effect.

        Raises:
            ProgramRuns: a program is running.
            LostReply: it is unknown whether the instruction was executed.
        """
        self._point(2 * _instruction(place))
        if not self._execute_risky(Code.TRY, self._resolve_tried):
            raise ProgramRuns(0, f"{self._message_prefix}{ProgramRuns.text}")

    def _resolve_tried(self) -> int | None:
        raise self._lost_reply("it is unknown whether the instruction was executed")

    def program_runs(self) -> bool:
        """Return True if a program runs, waits or is paused.

        No read-out reports this state. Therefore, this method requests the execution of a buffer instruction
        that has no effect. The part rejects this request while a program runs.

        Raises:
            ProgramRuns: the buffer contains no instruction without an effect.
        """
        for place in range(WORDS // 2 - 1, -1, -1):
            self._point(2 * place)
            if harmless(self._read(2 * place)):
                self._point(2 * place)
                again = partial(self._point, 2 * place)
                return not self.execute(Code.TRY, good=_yes_or_no, resolve=again)
        raise ProgramRuns(0, f"{self._message_prefix}the buffer holds no END: halt the program first")

    # ------------------------------------------------------------------ internal

    def _execute_risky(self, code: Code, resolve: Callable[[], int | None]) -> int:
        return self.execute(code, good=_yes_or_no, resolve=resolve, risky=True)

    def _point(self, word: int) -> None:
        """Set the word pointer of the part."""
        self._here = None
        self.execute(Code.POINTER, word, good=lambda value: value == word)

    def _seek(self, word: int) -> None:
        """Set the word pointer of the part, unless the pointer already has this value."""
        if self._here != word:
            self._point(word)

    def _write(self, place: int, word: int) -> None:
        expected = word - (word >> 31 << 32)
        got = self.execute(
            Code.WRITE_WORD,
            word,
            good=lambda value: value in (0, expected),
            resolve=lambda: self._point(place),
        )
        if got != expected:
            raise ProgramRuns(0, f"{self._message_prefix}word {place} was not written: {ProgramRuns.text}")
        self._here = place + 1

    def _read(self, place: int) -> int:
        word = self.execute(Code.READ_WORD, resolve=lambda: self._point(place)) & _MASK
        self._here = place + 1
        return word


def _yes_or_no(value: int) -> bool:
    return value in (0, 1)


def _instruction(place: int) -> int:
    if place not in range(WORDS // 2):
        raise OutOfRange(f"instruction {place}: there are 0 to {WORDS // 2 - 1}")
    return place
