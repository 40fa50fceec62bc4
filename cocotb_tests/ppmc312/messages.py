"""Blocks of the PPMC-312 with named codes: instructions and answers."""

from __future__ import annotations

from openppmc.model.ppmc312.codes import SPONTANEOUS, Answer, Code, Source


def message(code: int, *data: str, source: int = Source.HOST) -> str:
    """Return header, length, code and data as a text of hexadecimal bytes in logical order.

    Args:
        data: parameters as hexadecimal texts.
        source: header byte; for an answer, the source of the instruction.
    """
    behind = " ".join(data)
    return f"{source:02X} {len(bytes.fromhex(behind)) + 1:02X} {code:02X} {behind}".rstrip()


def register(buffer: int, block: str) -> str:
    """Return a block of instruction 49, which registers the block `block` in the event buffer `buffer`."""
    return message(Code.EVENT_SET, f"{buffer:02X} {block}")


def stopped(cause: int, position: int) -> str:
    """Return the report of a stop as a host receives it; a negative position is encoded in 32 bits."""
    text = message(Answer.STOPPED, f"{cause:02X} {position & 0xFFFFFFFF:08X}", source=SPONTANEOUS)
    return bytes.fromhex(text).hex(" ").upper()


def rates(text: str) -> list[int]:
    """Return a text such as `400x3 200x4` as a list of intervals."""
    words = (word.split("x") for word in text.split())
    return [int(rate) for rate, count in words for _ in range(int(count))]
