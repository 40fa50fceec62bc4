"""Replay of recorded inputs into a golden model, which returns the expected outputs.

    edges = expected_edges("ppmc104", {"CLK_HZ": 24_000_000}, changes, end)
    comparison = compare_recording(Recording("ppmc104", params, end=end, stimulus=changes, edges=seen))
    comparison.mismatch     # None, or the first difference

A time is the index of a rising clock edge; 0 is the first edge after the reset. Edge t is the first edge that
samples an input change at t. An output change at t occurs immediately after edge t (`model.chip`). A
recording that begins in a reset contains the changes of `rst_n` to 0 and to 1.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from itertools import groupby
from typing import Any

from .. import parts
from .comparison import Comparison, compare_edges
from .pins import Pinned, pins_of
from .records import Change, Edge, Recording


def new_model(part: str, params: Mapping[str, object]) -> Any:
    """Return the golden model of a part; `params` are the parameters of its top module.

    Raises:
        ValueError: a value is out of range.
        parts.UnknownPartError: the part has no model.
    """
    return parts.part(part).load("model")(**{name.lower(): value for name, value in params.items()})


class ModelRunner:
    """Model that receives its inputs in pieces.

    Args:
        model: any object with `pins(t, **levels)` and `run_until(t)`.
    """

    def __init__(self, model: Any) -> None:
        self.model = model
        self._fed, self._end = 0, -1

    def catch_up(self, stimulus: Sequence[Change], end: int) -> Any:
        """Pass the new changes of `stimulus` to the model and run it up to edge `end`.

        Returns:
            The model.
        """
        new = stimulus[self._fed :]
        self._fed = len(stimulus)
        for t, group in groupby(new, key=lambda change: change.t):
            self.model.pins(t, **{change.pin: change.value for change in group})
        if end > self._end:
            self._end = end
            self.model.run_until(end)
        return self.model


def expected_edges(
    part: str, params: Mapping[str, object], inputs: Iterable[tuple[int, str, int]], end: int
) -> list[Edge]:
    """Return the output edges of a golden model for these inputs, in order of time up to edge `end`.

    Args:
        inputs: (edge, pin, level) in order of time, with the pin names of the model.

    Raises:
        ValueError: a pin or level is unknown.
    """
    follower = ModelRunner(new_model(part, params))
    model = follower.catch_up([Change(*row) for row in inputs], end)
    return [Edge(*edge) for edge in model.edges if edge.t <= end]


def compare_recording(
    recording: Recording,
    initial: Mapping[str, int] | None = None,
    seen: str = "board",
    follower: ModelRunner | None = None,
    pins: Pinned | None = None,
) -> Comparison:
    """Replay the inputs of a recording into a golden model and compare every output.

    Args:
        initial: outputs to compare, with their levels before edge 0; by default all outputs of the model with
            their levels in reset.
        seen: source of the recording, for reports and pictures.
        follower: model that has already run with the inputs of this recording; `None` to create one.
        pins: pins of the part for reports; by default those of the model.
    """
    follower = follower or ModelRunner(new_model(recording.part, recording.params))
    if pins is None or initial is None:
        own = pins_of(follower.model)
        pins, initial = pins or own, own.outputs if initial is None else initial
    model = follower.catch_up(recording.stimulus, recording.end)
    edges = [Edge(edge.t, edge.signal, edge.value) for edge in model.edges]
    resets = [c.t for c in recording.stimulus if c.pin == "rst_n" and c.value == 0]
    sides = compare_edges(edges, recording.edges, initial, recording.end, resets)
    return Comparison(recording, initial, *sides, pins, seen)
