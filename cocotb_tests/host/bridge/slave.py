"""A mailbox part in Python whose behaviour depends only on its accesses, never on time.

Therefore the RTL and the golden model can each have an instance, and both must make the same accesses.
"""

from __future__ import annotations

import random

IBF, OBF, ERR = 0x02, 0x01, 0x80


class RegisterModel:
    """Mailbox with 16 registers; register 1 is the status and register 0 the data.

    After a write to register 0 or 1, IBF stays 1 for up to `lag` status reads. A write to register 1 may
    produce answer bytes; OBF is set after some further status reads. `refuse` is the probability that it sets
    ERR. `log` contains ("W" or "R", a, byte) of every access. `hold_ibf` and `hold_obf` replace the bits IBF
    and OBF of the status, unless they are None.
    """

    def __init__(self, seed: int = 1, lag: int = 3, refuse: float = 0.0) -> None:
        self.rng = random.Random(seed)
        self.lag, self.refuse = lag, refuse
        self.registers = [17 * a & 0xFF for a in range(16)]
        self.log: list[tuple[str, int, int]] = []
        self.hold_ibf: int | None = None
        self.hold_obf: int | None = None
        self.error = False
        self._ibf_reads = 0
        self._obf_reads = 0
        self._queue: list[int] = []
        self.resets = 0
        self.strap_bytes: list[int] = []
        self.pin_levels = 0xFF
        self.zeros = 0

    # ---------------------------------------------------------------- bus

    def read(self, a: int) -> int:
        """Return the byte of one read access."""
        if a == 1:
            byte = self._status()
        elif a == 0:
            byte = self._queue.pop(0) if self._queue else 0xE7
        else:
            byte = self.registers[a]
            self.registers[a] = (byte * 5 + 2 * a + 1) & 0xFF  # each register reads as every value in turn
        self.log.append(("R", a, byte))
        return byte

    def write(self, a: int, byte: int) -> None:
        """Store the byte of one write access."""
        self.log.append(("W", a, byte))
        if a > 1:
            self.registers[a] = byte
            return
        self._ibf_reads = self.rng.randint(0, self.lag)
        if a == 1:
            self.error = self.rng.random() < self.refuse
            self._queue = [self.rng.getrandbits(8) for _ in range(byte & 3)]
            self._obf_reads = self.rng.randint(0, self.lag)

    def _status(self) -> int:
        ibf, obf = self._ibf_reads > 0, bool(self._queue) and self._obf_reads == 0
        self._ibf_reads = max(0, self._ibf_reads - 1)
        self._obf_reads = max(0, self._obf_reads - 1)
        ibf = bool(ibf if self.hold_ibf is None else self.hold_ibf)
        obf = bool(obf if self.hold_obf is None else self.hold_obf)
        return ERR * self.error | IBF * ibf | OBF * obf | 0x40

    # Further methods that the golden model calls.

    def reset(self) -> None:
        """Execute op RESET."""
        self.resets += 1

    def straps(self, byte: int) -> None:
        """Execute op STRAPS."""
        self.strap_bytes.append(byte)

    def pins(self) -> int:
        """Execute op PINS."""
        return self.pin_levels

    def zero(self, axis: int = 1) -> None:
        """Execute op ZERO."""
        self.zeros += axis

    def count(self, axis: int = 1) -> int:
        """Execute op COUNT."""
        return -0x1234567 if axis == 1 else 0x7D7E5A81


def without_polls(log: list[tuple[str, int, int]]) -> list[tuple[str, int, int]]:
    """Return the log without repeated reads of the same byte; their number depends on time."""
    return [entry for n, entry in enumerate(log) if entry[0] == "W" or n == 0 or log[n - 1] != entry]
