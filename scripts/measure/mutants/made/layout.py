"""Places of the registers in a model of Verilator, from its C++ header and the RTL."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

_CLOCKED = re.compile(r"(\{[^{}]*\}|\w+)(?:\[[^\]]*\]|\.\w+)*\s*<=")
"""Registers, or a list of them. Names before other `<=` are found, too, and do no harm."""
_CONNECTED = re.compile(r"\.(\w+)\s*\(\s*(\w+)")
"""Port and the signal to which it is connected."""
_VARIABLE = re.compile(
    r"^ +(?:VL_(?:IN|OUT|INOUT)(?P<bits>\w*)\((?P<port>\w+),\d+,\d+(?:,(?P<words>\d+))?\)"
    r"|(?P<kind>[CSIQ]Data|Vl\w+<.*>) (?P<name>\w+));",
    re.MULTILINE,
)
_SIZES = {"CData": 1, "8": 1, "SData": 2, "16": 2, "IData": 4, "": 4, "QData": 8, "64": 8}


def registers(header: str, texts: Iterable[str]) -> Iterator[int]:
    """Yield where the variables of a model end, then place and size of each register and input, in bytes.

    Args:
        header: the C++ header of the model.
        texts: the RTL files.
    """
    clocked = _clocked("\n".join(texts))
    found: list[int] = []
    at = 0
    variables = header.partition("DESIGN SPECIFIC STATE")[2].partition("INTERNAL VARIABLES")[0]
    for group in re.sub(r"/\*.*?\*/", "", variables).split("struct {"):
        lines = list(_VARIABLE.finditer(group))
        sizes = [_size(line["kind"] or line["bits"], line["words"]) for line in lines]
        widest = max((align for _, align in sizes), default=1)
        at = _aligned(at, widest)
        for line, (size, align) in zip(lines, sizes, strict=True):
            at = _aligned(at, align)
            name = line["name"] or line["port"]
            if "VL_IN" in line[0] or name.rpartition("__")[2] in clocked:
                found += [at, size]
            at += size
        at = _aligned(at, widest)
    yield _aligned(at, 8)
    yield from found


def _clocked(text: str) -> set[str]:
    """Return the names of registers, and of all signals that a model may contain in place of a register."""
    found = {name for left in _CLOCKED.findall(text) for name in re.findall(r"[A-Za-z_]\w*", left)}
    connected = _CONNECTED.findall(text)
    while more := {signal for port, signal in connected if port in found} - found:
        found |= more
    return found


def _size(kind: str, words: str | None = None) -> tuple[int, int]:
    """Return size and alignment of a type of Verilator in bytes."""
    if array := re.fullmatch(r"VlUnpacked<(.*), (\d+)>", kind):
        size, align = _size(array[1])
        return size * int(array[2]), align
    if wide := re.fullmatch(r"VlWide<(\d+)>", kind):
        words = wide[1]
    return (4 * int(words), 4) if words else (_SIZES[kind], _SIZES[kind])


def _aligned(place: int, align: int) -> int:
    return -(-place // align) * align
