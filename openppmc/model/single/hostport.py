"""Host side of the models: write path, read path, mailbox, output queue.

Strobes and registers: P104-BUS-05..07, P2104-BUS-05..10. Mailbox: P104-HSK-01..04, P2104-HSK-01..04. Output
queue: P104-HSK-05, -06, -08, P2104-HSK-06, -07. Each part defines the pins of a strobe, the other status
bits, and the conditions under which a byte stays in the input buffer.

The two registers that drive the bus (d_oe and d_o) sample a read strobe directly (P104-PORT-02, D-05). All
other registers use the output of a synchroniser, which may sample the strobe up to one cycle later. Let E be
the first edge that directly samples the strobe, and S the first edge at which the synchroniser samples it. E'
and S' are the first edges that no longer sample the strobe. The rules then state:

- P104-BUS-05, P2104-BUS-06: d_oe rises at E and falls at E'. d_o is loaded at E and loaded again
  (refreshed) at each edge up to S + 1.
- P104-HSK-05, P2104-BUS-08: a data read clears OBF at S' + 2 if OBF was 1 at the last refresh. The last
  refresh is at S + 1, or at S if the synchroniser sampled the strobe only once. If a read instruction is
  executed before S' + 2, OBF stays 1 for the answer of this instruction.
- P104-HSK-05: from the last refresh on, a status read no longer shows the OBF of this byte.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import Protocol

from ..chip import Context, Phase
from ..clock import Event
from ..motion.codes import IBF, OBF
from .codes import Kind, decode

# Functions that only the PPMC-104 has: its strobes, and the gate that blocks bytes at high speed.


def strobes(pins: Mapping[str, int]) -> tuple[bool, bool]:
    """Return (write strobe, read strobe); if wr_n and rd_n are both low, both are False (P104-BUS-02)."""
    selected = not pins["cs_n"]
    writing = selected and not pins["wr_n"] and bool(pins["rd_n"])
    reading = selected and not pins["rd_n"] and bool(pins["wr_n"])
    return writing, reading


class SpeedGate:
    """Gate for DATASHEET timing. Above a certain speed, only stop commands pass (P104-DS-12).

    Args:
        retry: retry(t) is called when the host port must check a waiting byte again.
    """

    def __init__(self, retry: Callable[[int], None]) -> None:
        self._retry = retry
        self._fast = (False, False, 0)

    def set(self, t: int, fast: bool) -> None:
        """Close or open the gate at edge t. Stop commands pass a closed gate."""
        self._fast = (self._is_fast(t), fast, t)
        if not fast:
            self._retry(t)

    def _is_fast(self, t: int) -> bool:
        before, after, since = self._fast
        return after if t >= since else before

    def must_wait(self, t: int, byte: int, command: bool) -> bool:
        """Return True if this byte must remain in the buffer at edge t."""
        stop = command and decode(byte).kind in (Kind.STOP, Kind.SLOW_STOP)
        return self._is_fast(t) and not stop


AcceptByte = Callable[[int, int, bool, int], None]
Strobes = Callable[[Mapping[str, int]], tuple[bool, bool]]
MustWait = Callable[[int, int, bool], bool]

WRITE_SYNC = 2
READ_SYNC = 2
ALWAYS = 1 << 62
"""Last edge of the refreshes of d_o while the synchroniser has not sampled the strobe."""


class BytePort(Protocol):
    """Members of the host side that the commands and the motion use."""

    def answer(self, values: Iterable[int]) -> None:
        """Load the response bytes of a read command into the output queue."""

    def close_until(self, t: int) -> None:
        """Accept no byte before edge t (processing window)."""


class HostPort:
    """Host side, which converts bus strobes to bytes and back.

    Args:
        take: take(t, byte, is_command, stored_at) is called when a byte is consumed at edge t (its C-event);
            stored_at is the edge of its write event.
        state: state() returns all status bits except IBF and OBF.
        strobes: strobes(pins) returns the levels of write strobe and read strobe; True = active.
        must_wait: must_wait(t, byte, is_command) returns True if the byte must stay in the buffer at edge t.
            If it returns True, it must call `retry` when the byte may pass.
    """

    def __init__(
        self,
        context: Context,
        take: AcceptByte,
        state: Callable[[], int],
        strobes: Strobes,
        must_wait: MustWait = lambda t, byte, command: False,
    ) -> None:
        self._context = context
        self._take_byte = take
        self._state = state
        self._strobes = strobes
        self._must_wait = must_wait
        self._pins: dict[str, int] = {}
        self._writing = self._reading = self._sampled = False
        self._write_began = self._read_began = 0
        self._refreshing = False
        self._last_refresh = ALWAYS
        self._in_pipe = 0
        self._buffer = (0, False)
        self._stored_at = 0
        self.ibf = self.obf = False
        self._output_byte = 0
        self._queue: list[int] = []
        self._is_data_read = self._counts = self._is_final = False
        self._clearing: Event | None = None
        self._presenting: Event | None = None
        self._closed_until = 0

    # ------------------------------------------------------------------ strobes

    def sample(self, t: int, pins: Mapping[str, int], stage: Mapping[str, int]) -> None:
        """Sample new levels of the bus pins at edge t (P104-BUS-05, -06).

        Args:
            stage: levels of strobe pins that the synchroniser samples, if they differ from `pins`.
        """
        _, reading = self._strobes(pins)
        writing, sampled = self._strobes({**pins, **stage} if stage else pins)
        if self._writing and not writing:
            self._in_pipe += 1
            byte, command = self._pins["d_i"], bool(self._pins["a0"])
            self._context.queue.at(t + WRITE_SYNC, Phase.STORE, lambda at: self._store(at, byte, command))
        elif writing and not self._writing:
            self._write_began = t
        self._writing = writing
        self._pins = dict(pins)
        if reading != self._reading:
            self._reading = reading
            self._context.log.set(t, "d_oe", int(reading))
            self._refresh(t)
        if sampled != self._sampled:
            self._sampled = sampled
            (self._begin_read if sampled else self._end_read)(t)

    def _refresh(self, t: int) -> None:
        """Until the last refresh, load d_o with the value of the selected register just before edge t."""
        if not self._reading:
            return
        if t <= self._last_refresh:
            value = self._output_byte
            if self._pins["a0"]:
                # As long as the synchroniser samples a write strobe, the byte of this strobe is treated as a
                # waiting byte.
                value = self.status | (IBF if self._writing and self._write_began < t else 0)
            self._context.log.set(t, "d_o", value)
        if not self._refreshing:
            self._refreshing = True
            self._context.queue.at(t + 1, Phase.BUS, self._refresh_next)

    def _refresh_next(self, t: int) -> None:
        self._refreshing = False
        if t <= self._last_refresh:
            self._refresh(t)

    def _begin_read(self, t: int) -> None:
        """Process edge S of a read strobe."""
        self._read_began, self._last_refresh = t, t + 1
        self._is_data_read = not self._pins["a0"]
        self._counts = self._is_data_read and self._readable
        self._context.queue.at(t + 1, Phase.LEVELS, self._decide)

    def _decide(self, t: int) -> None:
        """If edge S + 1 still samples the strobe, decide at this edge whether the read clears OBF."""
        if self._sampled and t == self._read_began + 1:
            self._counts = self._is_final = self._is_data_read and self._readable

    def _end_read(self, t: int) -> None:
        """Process edge S' of a read strobe."""
        self._last_refresh = ALWAYS
        if self._counts:
            self._clearing = self._context.queue.at(t + READ_SYNC, Phase.QUEUE, self._clear)
        self._counts = self._is_final = False

    @property
    def _readable(self) -> bool:
        return self.obf and self._clearing is None

    @property
    def status(self) -> int:
        """Status register as a read returns it.

        IBF is already 1 while a byte is being stored, and OBF is already 0 while a byte is being cleared.
        """
        waiting = self.ibf or self._in_pipe > 0
        unread = self._readable and not self._is_final
        return self._state() | (IBF if waiting else 0) | (OBF if unread else 0)

    # ------------------------------------------------------------------ output queue

    def answer(self, values: Iterable[int]) -> None:
        """Load the response bytes of a read command; earlier bytes are discarded (P104-HSK-08)."""
        self._queue = list(values)
        self._output_byte = self._queue.pop(0)
        self.obf = True
        self._counts = self._is_final = False
        for event in (self._clearing, self._presenting):
            if event:
                event.cancel()
        self._clearing = self._presenting = None

    def _clear(self, t: int) -> None:
        self._clearing = None
        self.obf = False
        if self._queue:
            at = t + self._context.latency.queue_next
            self._presenting = self._context.queue.at(at, Phase.QUEUE, self._present)

    def _present(self, t: int) -> None:
        self._presenting = None
        self._output_byte = self._queue.pop(0)
        self.obf = True

    # ------------------------------------------------------------------ mailbox

    def _store(self, t: int, byte: int, command: bool) -> None:
        """Process a write event. The byte replaces a byte that is still waiting (P104-HSK-02)."""
        self._in_pipe -= 1
        self._buffer = (byte, command)
        self._stored_at = t
        self.ibf = True
        self._context.queue.at(t + self._context.latency.c_event, Phase.COMMAND, self._try)

    def close_until(self, t: int) -> None:
        """Accept no byte before edge t (processing window)."""
        self._closed_until = max(self._closed_until, t)

    def retry(self, t: int) -> None:
        """Check a waiting byte again at edge t."""
        self._context.queue.at(t, Phase.COMMAND, self._try)

    def _try(self, t: int) -> None:
        latency = self._context.latency
        if not self.ibf or t < self._stored_at + latency.c_event:
            return
        byte, command = self._buffer
        opens = self._closed_until + (latency.window_open if self._closed_until > self._stored_at else 0)
        if t < opens:
            self.retry(opens)
            return
        if self._must_wait(t, byte, command):
            return
        self.ibf = False
        self._take_byte(t, byte, command, self._stored_at)
