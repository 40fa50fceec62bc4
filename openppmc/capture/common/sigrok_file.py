"""Captures of sigrok and PulseView: a zip with `metadata` and the samples, so many bytes each."""

from __future__ import annotations

import configparser
import re
import zipfile
from fractions import Fraction
from pathlib import Path

from ...errors import needs
from .errors import CaptureError
from .signals import SECOND, Capture, Channel

_RATE = re.compile(r"([\d.]+)\s*([kMG]?)Hz")
_PREFIX = {"": 1, "k": 10**3, "M": 10**6, "G": 10**9}


def read_sr(path: Path) -> Capture:
    """CaptureError for a damaged file or one without logic channels."""
    needs("decode", f"{path.name}: a capture of sigrok", "numpy")
    try:
        with zipfile.ZipFile(path) as archive:
            return _read(path.name, archive)
    except (zipfile.BadZipFile, EOFError, OSError) as error:
        raise CaptureError(f"{path.name}: cut off or no sigrok file ({error}): save it again") from None
    except (KeyError, configparser.Error, ValueError, StopIteration) as error:
        raise CaptureError(f"{path.name}: no sigrok capture of logic channels ({error})") from None


def _read(name: str, archive: zipfile.ZipFile) -> Capture:
    import numpy as np

    head = configparser.ConfigParser(interpolation=None)
    head.read_string(archive.read("metadata").decode())
    device = next(head[section] for section in head.sections() if section.startswith("device"))
    match = _RATE.search(device["samplerate"])
    if match is None:
        raise ValueError("no sample rate")
    step = SECOND / (Fraction(match[1]) * _PREFIX[match[2]])
    size = int(device["unitsize"])
    names = {int(key[5:]) - 1: value for key, value in device.items() if re.fullmatch(r"probe\d+", key)}
    first = device["capturefile"]
    pieces = sorted(
        (one for one in archive.namelist() if re.fullmatch(rf"{re.escape(first)}(-\d+)?", one)),
        key=lambda one: int(one.rpartition("-")[2]) if one != first else 0,
    )
    if not pieces:
        raise ValueError("no samples")
    channels = {value: Channel() for value in names.values()}
    before, at = -1, 0
    for piece in pieces:
        data = archive.read(piece)
        units = np.frombuffer(data[: len(data) // size * size], np.uint8).reshape(-1, size)
        changed = np.flatnonzero((units[1:] != units[:-1]).any(axis=1)) + 1
        for place in (0, *changed.tolist()) if len(units) else ():
            value = int.from_bytes(units[place].tobytes(), "little")
            if value != before:
                _change(channels, names, before, value, round((at + place) * step))
                before = value
        at += len(units)
    return Capture(name, channels, round(at * step), round(step))


def _change(channels: dict[str, Channel], names: dict[int, str], before: int, value: int, t: int) -> None:
    for place, name in names.items():
        level = value >> place & 1
        if before < 0:
            channels[name].initial = level
        else:
            channels[name].add(t, level)
