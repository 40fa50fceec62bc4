"""Error of a capture or its pin map. Its message is one line that states what to do."""

from __future__ import annotations

from ...errors import PpmcError


class CaptureError(PpmcError):
    """The file, the pin map or the levels of the pins are invalid."""
