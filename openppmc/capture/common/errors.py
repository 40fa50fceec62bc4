"""What can be wrong with a capture or its pin map. One line that says what to do."""

from __future__ import annotations

from ...errors import PpmcError


class CaptureError(PpmcError):
    """The file, the pin map, or what the pins did."""
