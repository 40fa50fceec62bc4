"""Opening a capture, whatever wrote it."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from .csv_file import read_csv
from .errors import CaptureError
from .signals import Capture
from .sigrok_file import read_sr
from .vcd_file import read_vcd

READERS: dict[str, Callable[[Path], Capture]] = {".vcd": read_vcd, ".csv": read_csv, ".sr": read_sr}


def read_capture(path: Path) -> Capture:
    """A VCD, a CSV of Saleae or sigrok, a .sr. CaptureError."""
    if not path.is_file():
        raise CaptureError(f"{path}: there is no such file")
    reader = READERS.get(path.suffix.lower())
    if reader is None:
        raise CaptureError(f"{path.name}: captures end in {', '.join(READERS)}: export it as one of these")
    capture = reader(path)
    if not any(channel.changes for channel in capture.channels.values()):
        raise CaptureError(f"{path.name}: no level ever changes: is the analyser wired, was it triggered?")
    return capture
