"""Functions that the pictures of all parts share: single bits, pin changes, accesses and times as text."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from matplotlib.axes import Axes

from openppmc.plot.motion import INK

Changes = list[tuple[int, int]]
Levels = Mapping[str, Changes]


def bit(changes: Sequence[tuple[int, int]], index: int) -> Changes:
    """Return the changes of one bit of a vector."""
    found: Changes = []
    for t, value in changes:
        level = value >> index & 1
        if not found or found[-1][1] != level:
            found.append((t, level))
    return found


def falls(changes: Changes) -> list[int]:
    """Return the edges at which a pin becomes low; at an active-low pulse output, these are the pulses."""
    return [t for t, level in changes if level == 0]


def rises(changes: Changes) -> list[int]:
    """Return the edges at which a pin becomes high."""
    return [t for t, level in changes if level == 1]


def first(changes: Sequence[tuple[int, int]], level: int, since: int) -> int:
    """Return the edge of the first change to a level at or after edge `since`."""
    return next(t for t, value in changes if value == level and t >= since)


def access_text(access: Any) -> str:
    """Return a host access as one word: C43 command, DE7 data, S04 status read, R83 data read."""
    return f"{('DC' if access.kind == 'write' else 'RS')[access.reg]}{access.byte:02X}"


def register_text(access: Any) -> str:
    """Return an access to a named register as text: name, `:=` for a write, and byte."""
    return f"{access.kind.removesuffix(' read')} {access.byte:02X}"


def frame_text(access: Any) -> str:
    """Return a frame of a serial host, or the reply to it, as text with the data."""
    return f"{access.kind} {access.byte:X}"


def pin(stimulus: Sequence[Any], name: str) -> Changes:
    """Return the recorded changes of an input pin."""
    return [(change.t, change.value) for change in stimulus if change.pin == name]


def micros(clk: int, clk_hz: int) -> str:
    """Return a time in µs without unnecessary digits."""
    return f"{clk * 1e6 / clk_hz:.6g} µs"


def spans(edges: Sequence[int], clk_hz: int) -> list[tuple[int, int, str]]:
    """Return a dimension line between each two consecutive edges."""
    return [(a, b, micros(b - a, clk_hz)) for a, b in zip(edges, edges[1:], strict=False)]


def heading(axes: Axes, text: str) -> None:
    """Write a title in the style of the close-ups."""
    axes.set_title(text, loc="left", fontsize=10.5, fontweight="bold", color=INK)


def subtitle(comparison: Any, clk_hz: int) -> str:
    """Return the subtitle: what the picture shows, and the result of the comparison."""
    verdict = "no difference" if comparison.mismatch is None else "DIFFERENT, see compare.txt"
    return (
        f"RTL in simulation at {clk_hz / 1e6:g} MHz. {comparison.edges_compared} edges of all "
        f"outputs compared with the golden model: {verdict}. Pins with * are active low."
    )
