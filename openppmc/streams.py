"""Output of text to stdout and stderr, which may have any encoding.

The streams may be closed or full, and the reader may end early.
"""

from __future__ import annotations

import errno
import io
import os
import re
import stat
import sys
import unicodedata
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from shutil import get_terminal_size
from typing import TextIO

PIPE_CLOSED = 141
"""Exit status if the reader of stdout has ended: 128 + SIGPIPE, as in shells."""
TERMINAL_CLOSED = 129
"""Exit status if the terminal was closed: 128 + SIGHUP. A write may fail before the signal arrives."""
NARROW = 80
"""On a terminal with fewer columns than this, a table that is too wide is printed as a list.

On a terminal with fewer columns, the help is plain text.
"""

ASCII = {
    **{chr(code): "*" for code in range(0x2800, 0x2900)},  # spinners
    **{chr(code): "#" for code in range(0x2580, 0x25A0)},  # blocks
    **{chr(code): "+" for code in range(0x2500, 0x2580)},  # corners of boxes; their lines:
    **dict.fromkeys("─━┄┅┈┉╌╍═╴╶╸╺╼╾‐‑‒–—―−", "-"), **dict.fromkeys("│┃┆┇┊┋╎╏║╵╷╹╻", "|"),
    **dict.fromkeys("“”„«»", '"'), **dict.fromkeys("‘’‚", "'"), **dict.fromkeys("•·⋅", "*"),
    "→": "->", "←": "<-", "↔": "<->", "²": "^2", "³": "^3", "µ": "u", "μ": "u", "Ω": "ohm", "°": "deg",
    "×": "x", "±": "+-", "≤": "<=", "≥": ">=", "≠": "!=", "≈": "~", "½": "1/2", "¼": "1/4", "¹": "^1",
    "▶": ">", "▸": ">", "◂": "<", "✓": "ok", "✗": "x", "§": "section ", "ß": "ss", "ø": "o", "æ": "ae",
    "%": "\u066a",  # cp864 has only the Arabic percent sign
}  # fmt: skip
"""Replacements for characters that an encoding does not have.

In addition to these replacements, letters lose their accents.
"""


class StdoutLost(SystemExit):
    """Standard output cannot be written.

    The exit status is PIPE_CLOSED if the reader of the pipe has ended, TERMINAL_CLOSED if the terminal was
    closed, and otherwise 1.
    """

    def __init__(self, error: OSError) -> None:
        # Windows reports EINVAL for a pipe without a reader.
        ended = error.errno == errno.EPIPE or (os.name == "nt" and error.errno == errno.EINVAL)
        closed = error.errno == errno.EIO and stat.S_ISCHR(os.fstat(1).st_mode)
        self.status = PIPE_CLOSED if ended else TERMINAL_CLOSED if closed else 1
        super().__init__(self.status)
        reason = "closed" if error.errno == errno.EBADF else error.strerror or str(error)
        self.reason = "the reader has ended" if ended else reason
        self.motors = ""
        """Text that states how moving motors were stopped; empty if no motor moved."""

    @property
    def line(self) -> str:
        """Line that is printed for the user; empty if the reader has ended and no motor was moving."""
        if self.status == PIPE_CLOSED and not self.motors:
            return ""
        line = f"error: stdout: cannot be written ({self.reason})"
        return f"{line}: {self.motors}" if self.motors else f"{line}; send it to a file or another program"


def readable(text: str, encoding: str) -> str:
    """Replace characters that an encoding does not have.

    Columns remain aligned: if a replacement is longer, the next two or more spaces of the line become
    shorter.

    >>> readable("a → b, 3 m/s², Zürich, 日", "ascii")
    'a -> b, 3 m/s^2, Zurich, \\\\u65e5'
    >>> readable("→ 05    position", "cp437")
    '-> 05   position'
    """
    if _has(encoding, text):
        return text
    pieces, extra = [], 0
    for piece in re.split(r"(\n| {2,})", text):
        if piece.startswith("  "):
            shorter = min(extra, len(piece) - 1)
            pieces.append(piece[shorter:])
            extra -= shorter
            continue
        pieces.append("".join(c if _has(encoding, c) else _ascii(c) for c in piece))
        extra = 0 if piece == "\n" else extra + len(pieces[-1]) - len(piece)
    return "".join(pieces)


def _has(encoding: str, text: str) -> bool:
    try:
        text.encode(encoding)
    except UnicodeError:
        return False
    return True


def _ascii(character: str) -> str:
    plain = unicodedata.normalize("NFKD", character).encode("ascii", "ignore").decode()
    return ASCII.get(character) or plain or character.encode("ascii", "backslashreplace").decode()


class _Stream(io.TextIOWrapper):
    """Text stream that replaces a standard stream.

    Args:
        failed: function that is called once if the stream cannot be written; the rest of the text is
            discarded. It must not raise an OSError, because rich and click catch this exception.
    """

    def __init__(self, stream: io.TextIOWrapper, failed: Callable[[OSError], None]) -> None:
        stream.flush()
        super().__init__(
            stream.buffer,
            stream.encoding,
            "backslashreplace",
            line_buffering=stream.line_buffering,
            write_through=stream.write_through,
        )
        self._failed = failed

    def write(self, text: str, /) -> int:
        try:
            super().write(readable(text, self.encoding))
        except OSError as error:
            self._drop(error)
        return len(text)

    def flush(self) -> None:
        try:
            super().flush()
        except OSError as error:
            self._drop(error)

    def _drop(self, error: OSError) -> None:
        """Send all further text to the null device.

        Otherwise, the interpreter would write this text when it ends, and report an error.
        """
        with suppress(OSError):
            nowhere = os.open(os.devnull, os.O_WRONLY)
            os.dup2(nowhere, self.fileno())
            os.close(nowhere)
        self._failed(error)


class Ended:
    """Object in which a block of `wrapped` stores its exit status.

    Attributes:
        status: exit status; the block sets it.
    """

    status = 0


@contextmanager
def wrapped() -> Iterator[Ended]:
    """Context manager in whose block stdout and stderr accept any text.

    If stdout cannot be written, StdoutLost ends the block, and one line on stderr states the reason. An exit
    status other than 0 that the block has set is kept, because the block has already reported its error. Text
    that cannot be written to stderr is discarded.
    """
    lost: list[StdoutLost] = []

    def fail(error: OSError) -> None:
        lost.append(StdoutLost(error))
        raise lost[0]

    before = sys.stdin, sys.stdout, sys.stderr
    sys.stdin = _opened(sys.stdin, os.O_RDONLY, "r")
    out, err = _opened(sys.stdout, os.O_RDONLY), _opened(sys.stderr, os.O_WRONLY)
    sys.stdout, sys.stderr = _wrapped(out, fail), _wrapped(err, lambda error: None)
    ended = Ended()
    try:
        try:
            yield ended
        except SystemExit as done:
            if done.code and not isinstance(done, StdoutLost):
                raise
        with suppress(StdoutLost):
            sys.stdout.flush()
        if lost and not ended.status:
            ended.status = lost[0].status
            if lost[0].line:
                print(lost[0].line, file=sys.stderr)
    finally:
        for stream in (sys.stdout, sys.stderr):
            if isinstance(stream, _Stream):
                with suppress(StdoutLost):
                    stream.detach()
        sys.stdin, sys.stdout, sys.stderr = before


def guarded(run: Callable[[], int]) -> int:
    """Call `run` in a block of `wrapped`; return the exit status."""
    with wrapped() as ended:
        ended.status = run()
    return ended.status


def is_narrow() -> bool:
    """Return True if this terminal is so narrow that wide tables are lists and help is plain text."""
    return get_terminal_size().columns < NARROW


def _opened(stream: TextIO | None, flags: int, mode: str = "w") -> TextIO:
    """Return the stream, or a replacement for it if it is closed.

    Without the replacement, the next file or port that is opened would get the number of the closed stream.

    Args:
        flags: flags of the null device. With O_RDONLY, a write fails; with O_WRONLY, written text is
            discarded.
    """
    if stream is not None:
        return stream
    return io.TextIOWrapper(open(os.open(os.devnull, flags), f"{mode}b", closefd=False), "utf-8")


def _wrapped(stream: TextIO, failed: Callable[[OSError], None]) -> TextIO:
    return _Stream(stream, failed) if isinstance(stream, io.TextIOWrapper) else stream
