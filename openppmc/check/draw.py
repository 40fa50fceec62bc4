"""PNG of a comparison with the signals near the first difference."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from ..errors import needs
from .comparison import Comparison, differing_spans
from .records import Access, level_at
from .vcd import clk_ps

BLUE, ORANGE, GREY, RED = "#1f5fa8", "#c65d00", "#6b6b6b", "#d62728"
SHADE = "#f7c9c9"


def window(comparison: Comparison) -> tuple[int, int]:
    """Return the first and last edge of the time window of the picture.

    The window includes up to five changes of the differing signal before and after the difference.
    """
    m = comparison.mismatch
    assert m is not None
    times = sorted({t for side in (comparison.expected, comparison.actual) for t, _ in side[m.signal]})
    before = [t for t in times if t < m.t][-5:]
    after = [t for t in times if t > m.t][:5]
    ends = [side[0] for side in (m.expected, m.actual) if side is not None]
    start, stop = min([m.t - 12, *before]), max([m.t + 12, *after, *ends])
    # In a wide window the difference would be invisible, so the window is limited to 4000 cycles before it
    # and, except for the two differing edges, 4000 cycles after it.
    start, stop = max(start, m.t - 4000), min(stop, max(m.t + 4000, max(ends) + 12))
    margin = max(2, (stop - start) // 20)
    return start - margin, stop + margin


def draw_png(comparison: Comparison, path: Path) -> None:
    """Draw both waveforms of every active output near the first difference.

    The accesses of the host are above the waveforms. The left side is a wide view. If the difference is only
    a few pixels wide there, the right side shows it enlarged.

    Raises:
        MissingExtraError: matplotlib is not installed.
    """
    needs("plot", "a picture of the difference", "matplotlib")
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    m, recording = comparison.mismatch, comparison.recording
    assert m is not None, "draw_png needs a difference to draw"
    low, high = window(comparison)
    outputs = _outputs_to_draw(comparison, low, high)
    pins = _pins_to_draw(comparison, low, high)
    ends = [side[0] for side in (m.expected, m.actual) if side is not None]
    reach = max(30, 2 * (max(ends) - m.t))
    zoom = (m.t - reach, max(ends) + reach)
    zoomed = (high - low) > 4 * (zoom[1] - zoom[0])
    rows = 2.1 * len(outputs) + 1.1 * len(pins)
    figure = Figure(figsize=(15 if zoomed else 12, 2.0 + 0.42 * rows), dpi=110, layout="constrained")
    FigureCanvasAgg(figure)
    views = [(low, high), zoom] if zoomed else [(low, high)]
    panels: Any = figure.subplots(1, len(views), squeeze=False, width_ratios=[1.9, 1] if zoomed else [1])[0]
    for number, (axes, (start, stop)) in enumerate(zip(panels, views, strict=True)):
        _panel(axes, comparison, outputs, pins, start, stop, labels=number == 0)
        axes.set_xlabel(
            f"clock edge   (1 cycle = {clk_ps(recording.params) / 1000:g} ns)"
            if number == 0
            else f"zoom: {stop - start} cycles"
        )
    _title(figure, comparison)
    figure.savefig(path, metadata={"Software": None})


def _panel(
    axes: Any, comparison: Comparison, outputs: list[str], pins: list[str], low: int, high: int, labels: bool
) -> None:
    """Draw the waveforms of all signals in one time window."""
    m, recording = comparison.mismatch, comparison.recording
    assert m is not None
    part = comparison.pins
    y, ticks = 0.0, []
    for name in outputs:
        for start, stop in _shaded(comparison, name, low, high):
            axes.fill_between([start, stop], y - 1.85, y + 0.1, color=SHADE, lw=0, zorder=1)
        width, initial = part.width(name), comparison.initial[name]
        _lane(axes, comparison.expected[name], initial, width, y - 0.8, low, high, BLUE)
        _lane(axes, comparison.actual[name], initial, width, y - 1.75, low, high, ORANGE)
        ticks.append((y - 0.85, name, RED if name in m.differing else "black"))
        y -= 2.1
        axes.axhline(y + 0.13, color="#e4e4e4", lw=0.8, zorder=0)
    for pin in pins:
        initial = {"rst_n": 1, **part.inputs}[pin]
        changes = [(c.t, c.value) for c in recording.stimulus if c.pin == pin]
        _lane(axes, changes, initial, part.width(pin), y - 0.8, low, high, GREY)
        ticks.append((y - 0.4, f"{pin} (in)", GREY))
        y -= 1.1
    axes.axvline(m.t, color=RED, lw=1.0, ls="--", zorder=4)
    _mark_accesses(axes, recording.accesses, low, high)
    axes.set_xlim(low, high)
    axes.set_ylim(y - 0.2, 1.4)
    axes.set_yticks([t[0] for t in ticks], [t[1] if labels else "" for t in ticks])
    for label, tick in zip(axes.get_yticklabels(), ticks, strict=True):
        label.set_color(tick[2])
    axes.tick_params(axis="y", length=0)
    axes.ticklabel_format(axis="x", style="plain", useOffset=False)
    axes.locator_params(axis="x", nbins=7, integer=True)
    axes.grid(axis="x", color="#ececec", lw=0.7, zorder=0)
    for side in ("top", "right", "left"):
        axes.spines[side].set_visible(False)


def _title(figure: Any, comparison: Comparison) -> None:
    from matplotlib.lines import Line2D
    from matplotlib.patches import Patch

    m, recording = comparison.mismatch, comparison.recording
    assert m is not None
    params = ", ".join(f"{name}={value}" for name, value in recording.params.items())
    params += f", seed {recording.seed}" if recording.seed else ""

    def told(side: tuple[int, int] | None) -> str:
        return "no further edge" if side is None else f"{side[1]:#x} at {side[0]}"

    figure.suptitle(
        f"{recording.part}: first difference at edge {m.t}: {m.signal}, model {told(m.expected)}, "
        f"{comparison.seen} {told(m.actual)}\n{params}",
        x=0.01,
        ha="left",
        fontsize=11,
    )
    figure.legend(
        handles=[
            Line2D([], [], color=BLUE, lw=2, label="golden model (upper)"),
            Line2D([], [], color=ORANGE, lw=2, label=f"{comparison.seen} (lower)"),
            Patch(color=SHADE, label="levels differ"),
        ],
        loc="outside lower right",
        ncols=3,
        frameon=False,
        fontsize=9,
    )


def _outputs_to_draw(comparison: Comparison, low: int, high: int) -> list[str]:
    """Return the signals to draw.

    The signals that differ are first, in order of time, followed by other signals with an edge in the window.
    """
    m = comparison.mismatch
    assert m is not None

    def active(name: str) -> bool:
        return any(
            low <= t <= high for side in (comparison.expected, comparison.actual) for t, _ in side[name]
        )

    first = [name for name in m.differing if name == m.signal or active(name)]
    others = [name for name in comparison.initial if name not in first and active(name)]
    # The read data bus is omitted unless it differs.
    return first + [name for name in others if name not in ("d_o", "d_oe")]


def _pins_to_draw(comparison: Comparison, low: int, high: int) -> list[str]:
    changed = {c.pin for c in comparison.recording.stimulus if low <= c.t <= high}
    bus_differs = comparison.mismatch is not None and comparison.mismatch.signal in ("d_o", "d_oe")
    part = comparison.pins
    order = ["rst_n", *part.inputs]
    return [pin for pin in order if pin in changed and (bus_differs or pin not in part.bus_pins)]


def _shaded(comparison: Comparison, name: str, low: int, high: int) -> list[tuple[int, int]]:
    spans, start = [], None
    for t, differs in [*differing_spans(comparison, name), (high, 0)]:
        if differs:
            start = t
        elif start is not None:
            if start < high and t > low:
                spans.append((max(start, low), min(t, high)))
            start = None
    return spans


def _lane(
    axes: Any,
    changes: list[tuple[int, int]],
    initial: int,
    width: int,
    y: float,
    low: int,
    high: int,
    color: str,
) -> None:
    """Draw one waveform of height 0.8 with its base at y; vectors are boxes with hex values."""
    level = level_at(changes, low, initial)
    points = [(low, level), *((t, v) for t, v in changes if low < t <= high), (high, None)]
    if width == 1:
        xs, ys = [], []
        for (t, value), (after, _) in zip(points, points[1:], strict=False):
            xs += [t, after]
            ys += [y + 0.7 * (value or 0)] * 2
        axes.plot(xs, ys, color=color, lw=1.6, solid_joinstyle="miter", zorder=3)
        return
    span = high - low
    for (t, value), (after, _) in zip(points, points[1:], strict=False):
        slope = min(span * 0.002, (after - t) / 2)
        top, base, middle = y + 0.7, y, y + 0.35
        axes.fill(
            [t, t + slope, after - slope, after, after - slope, t + slope],
            [middle, top, top, middle, base, base],
            facecolor="white",
            edgecolor=color,
            lw=1.2,
            zorder=2,
        )
        if (after - t) / span > 0.022 * (2 if width > 4 else 1.6):
            text = f"{value:0{width}b}" if width in (2, 5) else f"{value:02X}" if width == 8 else f"{value:X}"
            if width == 5 and (after - t) / span < 0.05:
                text = f"{value:02X}"
            axes.text(
                (t + after) / 2, middle, text, ha="center", va="center", fontsize=8, color=color, zorder=4
            )


def _mark_accesses(axes: Any, accesses: list[Access], low: int, high: int) -> None:
    """Draw writes as labelled ticks and reads as small ticks above the waveforms."""
    last = -1e9
    for access in accesses:
        if not low <= access.t <= high:
            continue
        write = access.kind == "write"
        axes.plot(
            [access.t] * 2, [0.15, 0.5 if write else 0.3], color="black" if write else GREY, lw=1, zorder=4
        )
        if write and access.t - last > (high - low) * 0.03:
            text = f"{'c' if access.reg else 'd'} {access.byte:02X}"
            axes.text(access.t, 0.55, text, ha="center", va="bottom", fontsize=8, zorder=4)
            last = access.t
