"""Random byte streams on a line with a PPMC-312: after each stream, at most one poll recovers the station.

The golden model receives complete characters instead of levels of rxd, so the simulation of a second on the
line takes a fraction of a second.
"""

from __future__ import annotations

import random
from collections.abc import Iterable

from openppmc.model.ppmc312.codes import State
from openppmc.model.ppmc312.front.serial import LENGTHS
from openppmc.model.ppmc312.part import Ppmc312

from .serial_frames import SILENCE, summed

CHARACTER = 1_920
"""Number of cycles per character at 83.33 kbit/s and 16 MHz."""
BUILD = 70_000
"""Maximum number of cycles of an instruction."""

Stream = Iterable[int | None]
"""Items of a stream: a character; None for a character without a stop bit; a number above 255 for this number
of cycles with an idle line.
"""


class Line:
    """A line with one station, the golden model. `t` is the middle of the last stop bit."""

    def __init__(self, adr: int = 1, sum_mode: str = "BINARY") -> None:
        straps = {"mode": 0, "mod": 7, "adr": adr}
        self.model = Ppmc312(straps=straps, sum_mode=sum_mode)
        self.adr, self.sum_mode = adr, sum_mode
        self.t = CHARACTER

    def send(self, stream: Stream) -> None:
        """Send characters without gaps."""
        for item in stream:
            if item is not None and item > 0xFF:
                self.t += item
                continue
            self.t += CHARACTER
            self.model.run_until(self.t - 1)
            self.model.on_char(self.t, item)
        self.t += 2
        self.model.run_until(self.t)

    def wait(self) -> None:
        """Wait until the station has sent all its replies."""
        model, end = self.model, self.t + BUILD + 20 * CHARACTER
        while model.outputs["snd"] or model.station.busy:
            edge = model.next_event
            assert edge is not None and edge <= end, "a reply does not come, or does not end"
            model.run_until(edge)
        self.t = max(self.t, model.now)

    def ask(self, line: bytes) -> list[bytes]:
        """Return all replies that are sent from the beginning of this frame to the end of its reply."""
        before = len(self.model.replies)
        self.send(line)
        self.wait()
        return [reply for _, reply in self.model.replies[before:]]

    def recovers(self) -> None:
        """Check that the first poll after a stream is answered with exactly one valid reply."""
        self.wait()
        replies = self.ask(summed(0x80 + self.adr, b"", self.sum_mode))
        assert len(replies) == 1, f"{len(replies)} replies to a poll"
        control = replies[0][0]
        data = bytes.fromhex(replies[0][1:-1].decode("ascii"))
        assert control & 0x0F == self.adr and replies[0] == summed(control, data, self.sum_mode)
        assert replies[0][1:3] != b"41", "a good poll is called bad"
        del self.model.replies[:], self.model.sent[:]
        replies = self.ask(summed(0x90 + self.adr, b"\x41", self.sum_mode))
        assert [reply[0] & 0xF0 for reply in replies] == [0xA0], "the version is not told"


def stream(rng: random.Random, adr: int, sum_mode: str = "BINARY", size: int = 40) -> list[int | None]:
    """Return random bytes, partial and complete frames, framing errors, and silence."""
    items: list[int | None] = []
    while len(items) < size:
        kind = rng.random()
        if kind < 0.3:
            items += rng.randbytes(rng.randint(1, 8))
        elif kind < 0.75:
            code = rng.choice(list(LENGTHS))
            frame = summed(0x90 + adr, bytes([code]) + rng.randbytes(LENGTHS[code]), sum_mode)
            cut = len(frame) if rng.random() < 0.6 else rng.randrange(1, len(frame))
            items += frame[:cut]
        elif kind < 0.85:
            items += summed(0x80 + rng.choice((adr, rng.randrange(16))), b"", sum_mode)
        elif kind < 0.93:
            items.append(None)
        else:
            items.append(rng.choice((300, CHARACTER, 30_000, SILENCE - 500, SILENCE + 500)))
    if items[-1] == SILENCE - 500:
        # The reply that is sent after 20 ms (P312-SER-12, -17) would collide with the poll that follows.
        items[-1] = SILENCE + 500
    return items


def campaign(seed: int, size: int) -> int:
    """Send `size` bytes to one station after the other, with a poll after every few dozen bytes.

    Returns:
        The number of bytes sent.

    Raises:
        AssertionError: A station does not recover; the text states the seed.
    """
    rng = random.Random(f"p312 streams {seed}")
    sent = 0
    while sent < size:
        line = Line(rng.randrange(16), rng.choice(("BINARY", "BINARY", "CHARS")))
        if rng.random() < 0.7:
            line.ask(summed(0x90 + line.adr, bytes.fromhex("00 00 01F4 00C8 000320"), line.sum_mode))
        for _ in range(12):
            items = stream(rng, line.adr, line.sum_mode, rng.choice((3, 12, 40, 80)))
            line.send(items)
            sent += sum(item is None or item < 0x100 for item in items)
            try:
                line.recovers()
            except AssertionError as error:
                raise AssertionError(f"streams of seed {seed}: {error}") from error
            assert line.model.state in State
    return sent
