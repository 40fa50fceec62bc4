"""Free-curve transfer of the PPMC-312: P312-CMD-01, P312-CMD-FC-1..10."""

from __future__ import annotations

from ..codes import LE
from .tables import LAST, STAGES, SettingError, Table

CODE_HEADER, MORE, LAST_BLOCK = 0x02, 0x00, 0x01
RATES, ACCELERATION, DECELERATION = range(3)
_WIDTH = (2, 3, 3)
_MOST_PULSES = 0xFFFFFF


class FreeCurve:
    """One transfer, opened by the code block. Every error raises SettingError and ends the transfer.

    table: the finished one, None until the last block is in.
    """

    def __init__(self, header: int, parameters: bytes) -> None:
        """Code block: parameters after the code. Errors 0x10, 0x11."""
        if header != CODE_HEADER:
            raise SettingError(0x10)
        if len(parameters) not in (2, 3) or (len(parameters) == 2 and parameters[0] & LE):
            raise SettingError(0x11)
        flags, n_a = parameters[0], parameters[1]
        self._separate, self._clk = bool(flags & LE), flags & 7
        n_d = parameters[2] if self._separate else n_a
        if not (2 <= n_a <= STAGES and 2 <= n_d <= STAGES):
            raise SettingError(0x11)
        self._needs = [max(n_a, n_d), n_a, n_d if self._separate else 0]
        self._lists: list[list[int]] = [[], [], []]
        self.table: Table | None = None

    def _expected(self) -> int | None:
        """List that the next block belongs to; None if nothing is missing."""
        for item, (need, values) in enumerate(zip(self._needs, self._lists, strict=True)):
            if len(values) < need:
                return item
        return None

    def answer(self) -> bytes:
        """Parameters of the answer to the last block (P312-CMD-FC-1..3)."""
        if self.table:
            return b"\x0f" + self.table.na.to_bytes(3, "big") + self.table.nd.to_bytes(3, "big")
        item = self._expected()
        assert item is not None
        return bytes([item, self._needs[item] - len(self._lists[item])])

    def add(self, header: int, data: bytes) -> None:
        """Data block. Errors 0x16..0x1A in the order of P312-CMD-FC-4."""
        item = self._expected()
        assert item is not None
        width, values = _WIDTH[item], self._lists[item]
        count, rest = divmod(len(data), width)
        if rest or not count or len(values) + count > self._needs[item]:
            raise SettingError(0x16)
        fresh = [int.from_bytes(data[k : k + width], "big") for k in range(0, len(data), width)]
        if min(fresh) <= 1:
            raise SettingError(0x18 if item == RATES else 0x19)
        values += fresh
        if item != RATES and sum(values) > _MOST_PULSES:
            raise SettingError(0x1A)
        if (header == LAST_BLOCK) != (self._expected() is None):
            raise SettingError(0x17)
        if header == LAST_BLOCK:
            self.table = self._finish()

    def _finish(self) -> Table:
        def slow_first(values: list[int]) -> tuple[int, ...]:
            return (0,) * (STAGES - len(values)) + tuple(reversed(values))

        rates, pa, pd = self._lists
        pd = pd if self._separate else pa
        return Table(
            slow_first(rates),
            slow_first(pa),
            slow_first(pd),
            LAST + 1 - len(pa),
            LAST + 1 - len(pd),
            self._clk,
            self._separate,
        )


def curve(rates: list[int], pa: list[int], pd: list[int] | None = None, clk: int = 1) -> Table:
    """Table of a free curve given at once, fastest stage first. Raises SettingError."""
    stages = [len(pa), len(pd)] if pd else [len(pa)]
    transfer = FreeCurve(CODE_HEADER, bytes([clk | (LE if pd else 0), *stages]))
    for item, values in ((RATES, rates), (ACCELERATION, pa), (DECELERATION, pd or [])):
        for k in range(0, len(values), 10):
            data = b"".join(v.to_bytes(_WIDTH[item], "big") for v in values[k : k + 10])
            final = item == (DECELERATION if pd else ACCELERATION) and k + 10 >= len(values)
            transfer.add(LAST_BLOCK if final else MORE, data)
    assert transfer.table is not None
    return transfer.table
