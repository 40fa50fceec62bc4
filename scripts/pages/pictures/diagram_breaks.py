"""Move texts of a timing diagram away from its break marks, or remove a mark if that fails."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Any

from scripts.pages.pictures.diagram_width import boxes, lanes, text_width

SVG = "http://www.w3.org/2000/svg"
NUMBER = re.compile(r"-?\d+(?:\.\d+)?")
LANE, TOP = 30, 5
"""Distance between two lines, and height above the first line, in px."""
MARK = (7, -2, 22)
"""Size of a break mark in px: on each side of its centre, and above and below the top of its line."""
ROOM = 5
SMALL = 11 / 13
"""Size of the text of an arrow, relative to the size of a text in a box."""


@dataclass(frozen=True)
class Area:
    """An occupied rectangle in px; x = 0 is the first column. `node` in `parent` is the SVG element."""

    left: float
    right: float
    top: float
    bottom: float
    node: ET.Element | None = None
    parent: ET.Element | None = None

    def hits(self, other: Area) -> bool:
        """Return whether the areas overlap."""
        return (
            self.left < other.right
            and other.left < self.right
            and self.top < other.bottom
            and other.top < self.bottom
        )


def _named(root: ET.Element, name: str) -> ET.Element | None:
    return next((node for node in root.iter() if node.get("id") == name), None)


def _place(node: ET.Element) -> list[float]:
    return [float(found) for found in NUMBER.findall(node.get("transform", ""))]


def _around(x: float, y: float, text: str, scale: float = 1) -> Area:
    half = text_width(text) * scale / 2 + ROOM
    return Area(x - half, x + half, y - 7, y + 7)


def marks(root: ET.Element) -> Iterator[Area]:
    """Yield all break marks."""
    for group in root.iter(f"{{{SVG}}}g"):
        if group.get("id", "").startswith("wavegap_"):
            _, top = _place(group)
            side, above, below = MARK
            for use in group:
                (x, *_) = _place(use)
                yield Area(x - side, x + side, top + above, top + below, use, group)


def _words(node: ET.Element) -> str:
    return "".join(node.itertext()).strip()


def _drop(blocked: Iterable[Area]) -> None:
    for area in blocked:
        if area.parent is not None and area.node is not None and area.node in area.parent:
            area.parent.remove(area.node)


def _nearest(areas: Iterable[Area], taken: list[Area]) -> Area | None:
    return next((area for area in areas if not any(area.hits(other) for other in taken)), None)


def _in_boxes(root: ET.Element, signal: list[Any], step: int, taken: list[Area]) -> Iterator[Area]:
    """Move the text of each box sideways within this box, away from the areas in `taken`; yield its new area.

    If no place is free, the text does not move, and the marks that it covers are removed.
    """
    for number, lane in enumerate(lanes(signal)):
        drawn = _named(root, f"wavelane_draw_{number}_0")
        texts = [] if drawn is None else drawn.findall(f"{{{SVG}}}text")
        y = TOP + LANE * number + 10
        for node, (first, end) in zip(texts, boxes(lane.get("wave", "")), strict=False):
            text, x = _words(node), float(node.get("x", "0"))
            if not text:
                continue
            reach = max(0, int(step * (end - first) / 2 - text_width(text) / 2 - 4))
            shifts = sorted(range(-reach, reach + 1), key=abs)
            found = _nearest((_around(x + shift, y, text) for shift in shifts), taken)
            if found is None:
                found = _around(x, y, text)
                _drop(mark for mark in taken if mark.hits(found))
            node.set("x", f"{(found.left + found.right) / 2:g}")
            yield found


def _along(path: str) -> Iterator[tuple[float, float]]:
    """Yield points of an arrow from its middle outwards."""
    x, y, *rest = (float(number) for number in NUMBER.findall(path))
    curved = "c" in path
    dx, dy = (rest[-2], rest[-1]) if curved else (rest[0] - x, rest[1] - y)
    first = rest[0] if curved else dx / 3
    for n in sorted(range(10, 91), key=lambda n: abs(n - 50)):
        t = n / 100
        if curved:
            last = rest[2]
            along = 3 * (1 - t) ** 2 * t * first + 3 * (1 - t) * t**2 * last + t**3 * dx
            yield x + along, y + (3 * (1 - t) * t**2 + t**3) * dy
        else:
            yield x + t * dx, y + t * dy


def _on_arrows(root: ET.Element, marked: list[Area], texts: list[Area]) -> None:
    """Move the text of each arrow along this arrow, away from the break marks and the other texts.

    If no place is free of both, the text may cover another text. If no place is free of marks, the text is in
    the middle of the arrow, and the marks that it covers are removed.
    """
    arcs = _named(root, "wavearcs_0")
    path = ""
    for node in [] if arcs is None else arcs:
        if node.tag.endswith("path"):
            path = node.get("d", "")
        elif (text := _words(node)) and path:
            areas = [_around(x, y, text, SMALL) for x, y in _along(path)]
            found = _nearest(areas, marked + texts) or _nearest(areas, marked)
            if found is None:
                found = areas[0]
                _drop(mark for mark in marked if mark.hits(found))
            at = f"{(found.left + found.right) / 2:.1f},{(found.top + found.bottom) / 2:.1f}"
            node.set("transform", f"translate({at})")
            texts.append(found)


def step_aside(root: ET.Element, signal: list[Any], step: int) -> None:
    """Separate texts and break marks of a drawn diagram whose columns have `step` px."""
    marked = list(marks(root))
    texts = list(_in_boxes(root, signal, step, marked))
    _on_arrows(root, [mark for mark in marked if mark.parent is not None and mark.node in mark.parent], texts)
