"""Blocks of the PPMC-312 by the names of their codes: instructions to it, and its answers."""

from __future__ import annotations

from openppmc.model.ppmc312.codes import Source


def message(code: int, *data: str, source: int = Source.HOST) -> str:
    """Header, length, code and what stands behind it, as a text of hexadecimal bytes in logical order.

    data: hexadecimal texts. source: the header; of an answer, who asked for it.
    """
    behind = " ".join(data)
    return f"{source:02X} {len(bytes.fromhex(behind)) + 1:02X} {code:02X} {behind}".rstrip()
