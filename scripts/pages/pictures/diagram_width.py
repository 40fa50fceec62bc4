"""Fit timing diagrams into the width of a page, with narrower columns or several rows."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from copy import deepcopy
from functools import cache
from pathlib import Path
from typing import Any

import matplotlib
from fontTools.ttLib import TTFont

COLUMN = 688
"""Width of the text on a page of the site in px. It is larger in windows above 1220 px and on GitHub."""
MOST = COLUMN * 11 // 10
"""Largest width of a drawing in px. In the page, its smallest text of 11 px then has 10 px."""
STEPS = ({"hscale": 2}, {"hscale": 3, "skin": "narrow"}, {"hscale": 1}, {"hscale": 1, "skin": "narrow"})
"""WaveDrom's `hscale` and skin for columns of 80, 60, 40 and 20 px."""
WIDTHS = (80, 60, 40, 20)
NAMES, GROUP, EDGE = 16, 33, 8
"""Spaces in px: around names of lines, for the name of a group, to the right of lines and titles."""
TEXT = 13
"""Text size in a box in px."""
FRAME = 9
"""Width in px that WaveDrom adds to the fields of a register."""
TRIES = sorted(
    ((rows, *step) for rows in range(1, 5) for step in zip(WIDTHS, STEPS, strict=True)),
    key=lambda found: (found[0] + 1.5 * (found[1] < 40), -found[1]),
)
"""Rows and column widths, best first: few rows (columns below 40 px count as 1.5 more), wide columns."""

Lane = dict[str, Any]


def text_width(text: str) -> float:
    """Return the width in px of a 13 px text in the widest of the fonts, DejaVu Sans."""
    advance, names = _advances()
    return sum(advance[names.get(ord(letter), ".notdef")] for letter in text) * TEXT


@cache
def _advances() -> tuple[dict[str, float], dict[int, str]]:
    """Return the width of each glyph in em, and the name of the glyph for each character code."""
    font = TTFont(Path(matplotlib.get_data_path()) / "fonts/ttf/DejaVuSans.ttf")
    unit = font["head"].unitsPerEm
    return {name: font["hmtx"][name][0] / unit for name in font.getGlyphOrder()}, font.getBestCmap()


def lanes(signal: Sequence[Any]) -> Iterator[Lane]:
    """Yield the lines of a drawing, including lines in groups."""
    for entry in signal:
        if isinstance(entry, list):
            yield from lanes(entry[1:])
        else:
            yield entry


def boxes(wave: str) -> list[tuple[int, int]]:
    """Return the first column of each box with a text, and the first column after the box."""
    starts = [n for n, brick in enumerate(wave) if brick in "=23456789"]
    return [(n, next((m for m in range(n + 1, len(wave)) if wave[m] not in ".|"), len(wave))) for n in starts]


def step_of(drawing: dict[str, Any]) -> int:
    """Return the width of a column in px."""
    config = drawing.get("config", {})
    return int((20 if config.get("skin") == "narrow" else 40) * config.get("hscale", 1))


def _columns(lane: Lane) -> int:
    """Return the columns of a line, without the additional column of a line that is half a cycle early."""
    return len(lane.get("wave", "")) - bool(lane.get("phase"))


def _depth(signal: Sequence[Any]) -> int:
    return max((1 + _depth(entry[1:]) if isinstance(entry, list) else 0 for entry in signal), default=0)


def names(drawing: dict[str, Any]) -> float:
    """Return the width in px of the names of lines and groups."""
    longest = max(text_width(lane.get("name", "")) for lane in lanes(drawing["signal"]))
    return NAMES + math.ceil(longest) + GROUP * _depth(drawing["signal"])


def width(drawing: dict[str, Any], step: int) -> float:
    """Return the width in px of a drawing with columns of `step` px."""
    half = any(lane.get("phase") for lane in lanes(drawing["signal"])) / 2
    return names(drawing) + EDGE + step * (max(map(_columns, lanes(drawing["signal"]))) + half)


def readable(drawing: dict[str, Any], step: int) -> bool:
    """Return whether all texts fit into their boxes, and all edge numbers above their columns."""
    tick = drawing.get("head", {}).get("tick")
    every = list(lanes(drawing["signal"]))
    if tick is not None and text_width(str(max(map(_columns, every)) + tick)) > step:
        return False
    return all(
        text_width(text.strip()) <= step * (end - first) - 4
        for lane in every
        for text, (first, end) in zip(lane.get("data", ()), boxes(lane.get("wave", "")), strict=False)
    )


def _cut(lane: Lane, first: int, end: int) -> Lane:
    """Return columns `first` to `end` - 1 of a line.

    The first of these columns states its level, even if the line only continues an earlier level there.
    """
    if "wave" not in lane:
        return {**lane, "node": lane["node"][first:end]} if "node" in lane else lane
    wave, tail = lane["wave"], "." if lane.get("phase") else ""
    texts = dict(zip((at for at, _ in boxes(wave)), lane.get("data", ()), strict=False))
    at = next(n for n in range(first, -1, -1) if wave[n] not in ".|")
    piece = wave[at] + wave[first + 1 : end] + tail
    found = {**lane, "wave": piece, "data": [texts[n] for n in (at, *range(first + 1, end)) if n in texts]}
    if "node" in lane:
        found["node"] = lane["node"][first:end]
    return {key: value for key, value in found.items() if value or key == "name"}


def _part(signal: Sequence[Any], first: int, end: int) -> list[Any]:
    return [
        [entry[0], *_part(entry[1:], first, end)] if isinstance(entry, list) else _cut(entry, first, end)
        for entry in signal
    ]


def wrapped(drawing: dict[str, Any], cuts: Sequence[int]) -> dict[str, Any] | None:
    """Return the drawing in rows that begin at these columns, or None if an arrow connects two rows."""
    count = max(map(_columns, lanes(drawing["signal"])))
    rows = [_part(drawing["signal"], a, b) for a, b in zip((0, *cuts), (*cuts, count), strict=True)]
    for arrow in drawing.get("edge", ()):
        ends = {arrow.split()[0][0], arrow.split()[0][-1]}
        held = [ends & {c for lane in lanes(row) for c in lane.get("node", "")} for row in rows]
        if ends not in held:
            return None
    signal = rows[0]
    for row in rows[1:]:
        signal += [{}, *row]
    return {**drawing, "signal": signal}


def _breaks(drawing: dict[str, Any]) -> list[int]:
    """Return the columns that follow a break of all lines."""
    waves = [lane["wave"] for lane in lanes(drawing["signal"]) if "wave" in lane]
    shortest = min(map(len, waves))
    return [n + 1 for n in range(shortest - 1) if all(wave[n] == "|" for wave in waves)]


def _rows(drawing: dict[str, Any], step: int, count: int) -> dict[str, Any] | None:
    """Return the drawing in `count` rows of about equal length, or None if it is too wide for them."""
    if count == 1:
        return drawing if width(drawing, step) <= MOST else None

    def choose(before: tuple[int, ...], left: int) -> Iterator[tuple[int, ...]]:
        if not left:
            yield before
            return
        for at in found:
            if not before or at > before[-1]:
                yield from choose((*before, at), left - 1)

    found = _breaks(drawing)
    made = [wrapped(drawing, cuts) for cuts in choose((), count - 1)]
    fitting = [one for one in made if one and width(one, step) <= MOST]
    return min(fitting, key=lambda one: width(one, step), default=None)


def fitted(drawing: dict[str, Any]) -> dict[str, Any]:
    """Return a drawing that is at most MOST px wide; raise ValueError if this is not possible."""
    drawing = deepcopy(drawing)
    config = drawing.setdefault("config", {})
    if "signal" not in drawing:
        return {**drawing, "config": config | {"hspace": MOST - FRAME}}
    most = step_of(drawing)
    for rows, step, settings in TRIES:
        if step <= most and readable(drawing, step) and (found := _rows(drawing, step, rows)):
            return {**found, "config": config | settings}
    raise ValueError(f"wider than {MOST} px, and cannot be cut")
