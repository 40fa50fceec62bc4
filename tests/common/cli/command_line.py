"""Types that the tests of the command line share; the fixture `run` is in conftest."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple


class Outcome(NamedTuple):
    code: int
    out: str
    err: str

    @property
    def only_line(self) -> str:
        """The line on stderr; fails unless there is exactly one."""
        assert self.code and self.err.startswith("error: ") and self.err.count("\n") == 1, self
        return self.err


Run = Callable[..., Outcome]
