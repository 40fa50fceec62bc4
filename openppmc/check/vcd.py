"""A comparison as a VCD file: the outputs of both sides, their differences, and the pins."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from ..errors import needs
from .comparison import Comparison, differing_spans


def clk_ps(params: Any) -> int:
    """Return the length of 1 cycle in ps."""
    return round(1e12 / int(params.get("CLK_HZ", 16_000_000)))


def write_vcd(comparison: Comparison, path: Path) -> None:
    """Write a VCD file with the scopes `expected`, `actual`, `differs` and `pins`.

    A signal in the scope `differs` is 1 while the two levels differ.

    Raises:
        MissingExtraError: pyvcd is not installed.
    """
    needs("plot", "a waveform file", "vcd")
    from vcd import VCDWriter

    recording = comparison.recording
    part = comparison.pins
    scale = clk_ps(recording.params)
    rows: list[tuple[int, Any, int]] = []
    with open(path, "w", encoding="ascii") as handle, VCDWriter(handle, timescale="1 ps", date="") as writer:
        for scope, waves in (("expected", comparison.expected), ("actual", comparison.actual)):
            for name, changes in waves.items():
                width, level = part.width(name), comparison.initial[name]
                var = writer.register_var(scope, name, "wire", size=width, init=level)
                rows += [(t, var, value) for t, value in changes]
        for name in comparison.expected:
            var = writer.register_var("differs", name, "wire", size=1, init=0)
            rows += [(t, var, value) for t, value in differing_spans(comparison, name)]
        for pin, level in {"rst_n": 1, **part.inputs}.items():
            var = writer.register_var("pins", pin, "wire", size=part.width(pin), init=level)
            rows += [(c.t, var, c.value) for c in recording.stimulus if c.pin == pin]
        for t, var, value in sorted(rows, key=lambda row: row[0]):
            writer.change(var, max(0, t) * scale, value)
        writer.close(max(0, recording.end) * scale)
