"""Golden models that follow a side; those of the tests are watched where coverage is wanted."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from openppmc.check import replay
from openppmc.check.replay import Follower

from . import crosses

__all__ = ["Follower", "new_model"]


def new_model(part: str, params: Mapping[str, object]) -> Any:
    """As `openppmc.check.replay.new_model`."""
    crosses.watch(part)
    return replay.new_model(part, params)
