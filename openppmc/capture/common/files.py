"""Opening of a capture file in any supported format."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from .csv_file import read_csv
from .errors import CaptureError
from .signals import Capture
from .sigrok_file import read_sr
from .vcd_file import read_vcd

READERS: dict[str, Callable[[Path], Capture]] = {".vcd": read_vcd, ".csv": read_csv, ".sr": read_sr}


_LOGIC_2 = "in Logic 2: File, Export Raw Data, CSV"
MENUS = {
    ".sal": _LOGIC_2,
    ".bin": _LOGIC_2,
    ".dsl": "in DSView: File, Export, CSV or VCD",
    ".kvdat": "in KingstVIS: File, Export, CSV",
    ".dwf3logic": "in WaveForms: File, Export, Acquisition, CSV",
}
"""Menu entries of the CSV export, for programs whose own file formats are not supported."""


def read_capture(path: Path) -> Capture:
    """Read a VCD file, a CSV file of Saleae or sigrok, or a .sr file. Raises CaptureError."""
    if not path.is_file():
        raise CaptureError(f"{path}: there is no such file")
    reader = READERS.get(path.suffix.lower())
    if reader is None:
        menu = MENUS.get(path.suffix.lower(), "")
        raise CaptureError(
            f"{path.name}: captures end in {', '.join(READERS)}: export it as one of these"
            f"{f' ({menu})' if menu else ''}"
        )
    capture = reader(path)
    if not any(channel.changes for channel in capture.channels.values()):
        raise CaptureError(f"{path.name}: no level ever changes: is the analyser wired, was it triggered?")
    return capture
