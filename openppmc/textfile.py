"""Reader of text files in UTF-8 (with or without a byte order mark), UTF-16, or Latin-1."""

from __future__ import annotations

import codecs
from collections.abc import Iterator
from pathlib import Path

_MARKS = (
    (codecs.BOM_UTF32_LE, "utf-32"),
    (codecs.BOM_UTF32_BE, "utf-32"),
    (codecs.BOM_UTF8, "utf-8-sig"),
    (codecs.BOM_UTF16_LE, "utf-16"),
    (codecs.BOM_UTF16_BE, "utf-16"),
)
_CONTROL = frozenset(range(32)) - frozenset(b"\t\n\r\f\v\x1a") | {127}


class NotTextError(ValueError):
    """The bytes are not text; the message contains the line number."""


def encoding_of(head: bytes) -> str:
    """Return the encoding that the first bytes of a file indicate; `utf-8` if they indicate no other one."""
    for mark, name in _MARKS:
        if head.startswith(mark):
            return name
    # In UTF-16 without a byte order mark, every second byte of plain text is 0.
    sample = head[: len(head) // 2 * 2]
    for name, zero, text in (("utf-16-le", 1, 0), ("utf-16-be", 0, 1)):
        if len(sample) > 3 and not any(sample[zero::2]) and all(sample[text::2]):
            return name
    return "utf-8"


def decode_text(data: bytes) -> str:
    """Return the text in `data`. Raises NotTextError.

    Bytes that are not UTF-8 are read as Latin-1.
    """
    encoding = encoding_of(data[:64])
    if encoding in ("utf-16", "utf-32") and len(data) <= 4:
        raise NotTextError("line 1: a byte order mark and no text; save it as UTF-8")
    try:
        text = data.decode(encoding)
    except UnicodeDecodeError as error:
        if encoding != "utf-8":
            line = data[: error.start].count(b"\n") + 1
            raise NotTextError(f"line {line}: cut off or damaged; save it as UTF-8") from None
        text = data.decode("latin-1")
    for number, row in enumerate(text.split("\n"), 1):
        bad = next((one for one in row if ord(one) in _CONTROL), None)
        if bad is not None:
            raise NotTextError(f"line {number}: byte {ord(bad):02X} is no text; save it as UTF-8")
    return text.replace("\r\n", "\n").replace("\r", "\n")


def read_text(path: Path) -> str:
    """Return the text of a file. Raises OSError or NotTextError."""
    return decode_text(path.read_bytes())


def chunks(path: Path, size: int = 1 << 19) -> Iterator[bytes]:
    """Yield the content of a text file as bytes in UTF-8.

    If `encoding_of` returns UTF-8 for the file, the bytes are not changed or checked.

    Raises:
        OSError: the file cannot be read.
        NotTextError: the file is encoded in UTF-16 or UTF-32, and is damaged.
    """
    with path.open("rb") as file:
        data = file.read(size)
        encoding = encoding_of(data[:64])
        decoder = codecs.getincrementaldecoder(encoding)() if encoding not in ("utf-8", "utf-8-sig") else None
        if encoding == "utf-8-sig":
            data = data[3:]
        while data:
            try:
                yield decoder.decode(data).encode() if decoder else data
            except (UnicodeDecodeError, UnicodeEncodeError):
                raise NotTextError("cut off or damaged; save it as UTF-8") from None
            data = file.read(size)
