"""Captures of sigrok and PulseView: a zip file with `metadata` and the samples."""

from __future__ import annotations

import configparser
import re
import zipfile
import zlib
from pathlib import Path
from typing import Any

from ...errors import needs
from ...textfile import decode_text
from .errors import CaptureError
from .rates import hertz
from .signals import SECOND, Capture, Channel

_PIECE = 1 << 20


def read_sr(path: Path) -> Capture:
    """Read a capture. Raises CaptureError if the file is damaged or has no logic channels."""
    needs("decode", f"{path.name}: a capture of sigrok", "numpy")
    try:
        with zipfile.ZipFile(path) as archive:
            return _read(path.name, archive)
    except (zipfile.BadZipFile, zlib.error, EOFError, OSError, NotImplementedError, RuntimeError) as error:
        raise CaptureError(
            f"{path.name}: cut off or no sigrok file ({_short(error)}): save it again"
        ) from None
    except (KeyError, configparser.Error, ValueError, StopIteration) as error:
        raise CaptureError(
            f"{path.name}: no sigrok capture of logic channels ({_short(error)}): save it again from "
            "PulseView"
        ) from None


def _short(error: Exception) -> str:
    return " ".join(str(error).split())[:100]


def _read(name: str, archive: zipfile.ZipFile) -> Capture:
    import numpy as np

    head = configparser.ConfigParser(interpolation=None, strict=False)
    head.read_string(decode_text(archive.read("metadata")))
    device = next((head[one] for one in head.sections() if one.startswith("device")), None)
    if device is None:
        raise ValueError("metadata without a device")
    rate = hertz(device["samplerate"])
    if rate is None:
        raise ValueError(f"samplerate={device['samplerate']}")
    step = SECOND / rate
    size = int(device["unitsize"])
    names = {int(key[5:]) - 1: value for key, value in device.items() if re.fullmatch(r"probe\d+", key)}
    if not names or size < 1 or max(names) >= 8 * size or min(names) < 0:
        raise ValueError(f"{len(names)} probes in {size} bytes")
    twice = next((one for one in names.values() if list(names.values()).count(one) > 1), None)
    if twice is not None:
        raise ValueError(f"two channels of the same name, {twice!r}; rename one")
    first = device["capturefile"]
    pieces = sorted(
        (one for one in archive.namelist() if re.fullmatch(rf"{re.escape(first)}(-\d+)?", one)),
        key=lambda one: int(one.rpartition("-")[2]) if one != first else 0,
    )
    if not pieces:
        raise ValueError("no samples")
    numbers = [int(one.rpartition("-")[2]) for one in pieces if one != first]
    if numbers and numbers != list(range(1, len(numbers) + 1)):
        lost = next(n for n, one in enumerate(numbers, 1) if n != one)
        raise ValueError(f"piece {first}-{lost} is missing")
    changes: dict[int, list[tuple[Any, Any]]] = {place: [] for place in names}
    start: Any = None
    before: Any = None
    at = 0
    for piece in pieces:
        with archive.open(piece) as file:
            rest = b""
            while data := file.read(_PIECE):
                data = rest + data
                cut = len(data) // size * size
                rest = data[cut:]
                units = np.frombuffer(data[:cut], np.uint8).reshape(-1, size)
                if not len(units):
                    continue
                if before is None:
                    start = before = units[0]
                whole = np.concatenate((before[None], units))
                for place, found in changes.items():
                    wire = whole[:, place >> 3] >> (place & 7) & 1
                    rows = np.flatnonzero(wire[1:] != wire[:-1])
                    if len(rows):
                        found.append((_ps(rows + at, step), wire[rows + 1]))
                before, at = units[-1].copy(), at + len(units)
            if rest:
                raise ValueError(f"{piece}: {len(rest)} bytes too many")
    if start is None:
        raise ValueError("no samples")
    channels = {}
    for place, text in names.items():
        times = np.concatenate([np.zeros(0, np.int64), *(one[0] for one in changes[place])])
        levels = np.concatenate([np.zeros(0, np.uint8), *(one[1] for one in changes[place])])
        changes[place] = []
        channels[text] = Channel.of(int(start[place >> 3] >> (place & 7) & 1), times, levels)
    return Capture(name, channels, int(_ps(np.array([at]), step)[0]), round(step))


def _ps(samples: Any, step: Any) -> Any:
    import numpy as np

    up, down = step.numerator, step.denominator
    if int(samples[-1]) < (1 << 62) // up:
        return (samples.astype(np.int64) * up + down // 2) // down
    return np.array([round(int(one) * step) for one in samples], np.int64)
