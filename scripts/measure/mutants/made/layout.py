"""Places of the registers in a model of Verilator, from its C++ header and the RTL."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from typing import Any

from scripts.measure import syntax

_VARIABLE = re.compile(
    r"^ +(?:VL_(?:IN|OUT|INOUT)(?P<bits>\w*)\((?P<port>\w+),\d+,\d+(?:,(?P<words>\d+))?\)"
    r"|(?P<kind>[CSIQ]Data|Vl\w+<.*>) (?P<name>\w+));",
    re.MULTILINE,
)
_PART = re.compile(r"(__BRA__\d+(__03a\d+)?__KET__)+$")
"""End of the name of a part of a register."""
_SIZES = {"CData": 1, "8": 1, "SData": 2, "16": 2, "IData": 4, "": 4, "QData": 8, "64": 8}


def registers(header: str, texts: Iterable[str]) -> Iterator[int]:
    """Yield where the variables of a model end, then place and size of each register and input, in bytes.

    Args:
        header: the C++ header of the model.
        texts: the RTL files.
    """
    clocked = _clocked(texts)
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
            name = _PART.sub("", line["name"] or line["port"])
            *path, signal = re.split(r"__+(?:DOT__|BRA__\d+__KET__|Vcellout__)*", name)
            instance = next((one for one in reversed(path) if one in clocked), "")
            if "VL_IN" in line[0] or signal in clocked.get(instance, ()):
                found += [at, size]
            at += size
        at = _aligned(at, widest)
    yield _aligned(at, 8)
    yield from found


def _clocked(texts: Iterable[str]) -> dict[str, set[str]]:
    """Return instance -> names of registers, and of all signals that a model may contain in their place.

    Instances of different modules that have the same name are not distinguished.
    """
    found: dict[str, set[str]] = {}
    instances: dict[str, set[str]] = {}
    connected: list[tuple[str, str, str, set[str]]] = []
    for text in texts:
        for module in syntax.found(syntax.tree(text), "ModuleDeclaration"):
            name = module.header.name.valueText
            left = (one.left for one in syntax.found(module, "NonblockingAssignmentExpression"))
            found[name] = {signal for one in left for signal in _names(one)}
            instances[name] = {name}  # a model has the name of its top module
            for group in syntax.found(module, "HierarchyInstantiation"):
                child = group.type.valueText
                for instance in syntax.found(group, "HierarchicalInstance"):
                    instances.setdefault(instance.decl.name.valueText, set()).add(child)
                    for port in syntax.found(instance, "NamedPortConnection"):
                        pin = port.name.valueText
                        connected.append((name, child, pin, _names(port.expr) if port.expr else {pin}))
    grows = True
    while grows:
        grows = False
        for name, child, pin, signals in connected:
            if pin in found.get(child, ()) and not signals <= found[name]:
                found[name] |= signals
                grows = True
    return {
        instance: set().union(*(found.get(one, ()) for one in every)) for instance, every in instances.items()
    }


def _names(node: Any) -> set[str]:
    return set(re.findall(r"[A-Za-z_]\w*", re.sub(r"//.*", "", str(node))))


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
