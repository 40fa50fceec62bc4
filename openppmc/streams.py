"""stdout and stderr of every command: any encoding, closed, full, or read by a program that ends early.

`guarded` is the entry point's frame. Exit status: 141 if the reader of stdout is gone (what a shell reports
for SIGPIPE), 1 and one line on stderr if stdout is closed or full.
"""

from __future__ import annotations

import codecs
import errno
import io
import os
import sys
import unicodedata
from collections.abc import Callable

from .errors import PpmcError

PIPE_CLOSED = 141
"""Exit status if the reader of stdout has gone: 128 + SIGPIPE."""

REPLACED = "openppmc.replaced"
"""Name of the error handler that puts ASCII in place of characters that an encoding does not have."""
ASCII = {
    "→": "->", "←": "<-", "²": "^2", "³": "^3", "µ": "u", "μ": "u", "…": "...", "–": "-", "—": "-", "−": "-",
    "×": "x", "·": "*", "±": "+-", "≤": "<=", "≥": ">=", "≠": "!=", "≈": "~", "°": "deg", "Ω": "ohm",
    "\u2126": "ohm", "‘": "'", "’": "'", "“": '"', "”": '"', "«": '"', "»": '"', "•": "*", "ß": "ss",
    "━": "-", "╸": "-", "╺": "-", "\u00a0": " ", "\u202f": " ", "\u2009": " ",
}  # fmt: skip


class OutputError(PpmcError):
    """Text cannot be written to stdout. number: errno of the cause."""

    def __init__(self, error: OSError) -> None:
        self.number = error.errno
        # A pipe without a reader is EINVAL on Windows.
        self.reader_gone = self.number == errno.EPIPE or (os.name == "nt" and self.number == errno.EINVAL)
        reason = "it is closed" if self.number == errno.EBADF else error.strerror or str(error)
        super().__init__(
            f"stdout: cannot be written ({reason}); send it to a file or a program that can take it"
        )


def replaced(error: UnicodeError) -> tuple[str, int]:
    """Return ASCII for the characters of an encoding error, "?" if there is none like them."""
    if not isinstance(error, UnicodeEncodeError):
        raise error
    return "".join(map(_ascii, error.object[error.start : error.end])), error.end


def _ascii(character: str) -> str:
    """The nearest ASCII of a character."""
    plain = unicodedata.normalize("NFKD", character).encode("ascii", "ignore").decode()
    return ASCII.get(character) or plain or "?"


def printable(text: str) -> str:
    """Return `text` with the characters replaced that stdout cannot show."""
    encoding = getattr(sys.stdout, "encoding", None) or "utf-8"
    codecs.register_error(REPLACED, replaced)
    return text.encode(encoding, REPLACED).decode(encoding)


class _Stdout(io.TextIOWrapper):
    """stdout whose errors are OutputError: libraries that print handle BrokenPipeError in their own ways."""

    def write(self, text: str, /) -> int:
        try:
            return super().write(text)
        except OSError as error:
            raise OutputError(error) from None

    def flush(self) -> None:
        try:
            super().flush()
        except OSError as error:
            raise OutputError(error) from None


class _Stderr(io.TextIOWrapper):
    """stderr that drops what cannot be written: a remark must not end a motion."""

    def write(self, text: str, /) -> int:
        try:
            return super().write(text)
        except OSError:
            return len(text)

    def flush(self) -> None:
        try:
            super().flush()
        except OSError:
            pass


def _closed(flags: int) -> io.TextIOWrapper:
    """Return a stream in place of a closed one, whose number the next port to be opened would get otherwise.

    With O_RDONLY every write fails; with O_WRONLY every write is dropped.
    """
    return open(os.open(os.devnull, flags), "w", encoding="utf-8", closefd=False)


def prepare() -> None:
    """Make stdout and stderr accept any text. Streams that are not those of the process keep their class."""
    codecs.register_error(REPLACED, replaced)
    if sys.stdin is None:
        sys.stdin = open(os.open(os.devnull, os.O_RDONLY), encoding="utf-8", closefd=False)
    if sys.stdout is None:
        sys.stdout = sys.__stdout__ = _closed(os.O_RDONLY)  # type: ignore[misc]
    if sys.stderr is None:
        sys.stderr = sys.__stderr__ = _closed(os.O_WRONLY)  # type: ignore[misc]
    for name, kind in (("stdout", _Stdout), ("stderr", _Stderr)):
        stream = getattr(sys, name)
        if stream is getattr(sys, f"__{name}__") and type(stream) is io.TextIOWrapper:
            stream.flush()
            wrapped = kind(
                stream.buffer,
                stream.encoding,
                REPLACED,
                line_buffering=stream.line_buffering,
                write_through=stream.write_through,
            )
            setattr(sys, name, wrapped)
        elif isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors=REPLACED)


def complain(text: str) -> None:
    """Print one line on stderr."""
    print(f"error: {text}", file=sys.stderr)


def guarded(run: Callable[[], int]) -> int:
    """Prepare the streams, call `run`, write all of stdout. Returns the exit status."""
    prepare()
    try:
        try:
            return run()
        finally:
            sys.stdout.flush()
    except OutputError as error:
        return _lost(error)
    except BrokenPipeError as error:
        return _lost(OutputError(error))


def _lost(error: OutputError) -> int:
    """Drop the rest of stdout; returns the exit status."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    if error.reader_gone:
        return PIPE_CLOSED
    complain(str(error))
    return 1
