"""`Follower`: a golden model that gets the pin changes which a side has seen, and is never ahead of it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import groupby
from typing import Any

from openppmc import parts

from .stimulus import Change


def new_model(part: str, params: Mapping[str, object]) -> Any:
    """Golden model of a part with these parameters of its top module."""
    model = parts.part(part).load("model")
    return model(**{name.lower(): value for name, value in params.items()})


class Follower:
    """`model`: whatever follows; it needs pins(t, **levels) and run_until(t)."""

    def __init__(self, model: Any) -> None:
        self.model = model
        self._fed, self._end = 0, -1

    def catch_up(self, stimulus: Sequence[Change], end: int) -> Any:
        """Feed what has been added to `stimulus` since the last call, run up to edge `end`; the model."""
        new = stimulus[self._fed :]
        self._fed = len(stimulus)
        for t, group in groupby(new, key=lambda change: change.t):
            self.model.pins(t, **{change.pin: change.value for change in group})
        if end > self._end:
            self._end = end
            self.model.run_until(end)
        return self.model
