"""Captures in VCD: of sigrok, PulseView, GTKWave, our own simulations.

Ours say in a comment which core made them, so that the model beside them gets the same clock and parameters:

    $comment openppmc {"part": "pmc006", "parameters": {"CLK_HZ": 8000000, "TIMING": "FAST"}} $end
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from ...errors import needs
from .errors import CaptureError
from .signals import Capture, Channel

_UNITS = {"s": 10**12, "ms": 10**9, "us": 10**6, "ns": 10**3, "ps": 1, "fs": 0}


_MARK = "openppmc "


def core_comment(part: str, parameters: Mapping[str, object]) -> str:
    """Comment of a VCD that tells which core made it: part and parameters of its top module."""
    return _MARK + json.dumps({"part": part, "parameters": dict(parameters)})


def _core(comment: str, name: str) -> tuple[str, dict[str, object]]:
    """What `core_comment` has written; nothing for anybody else's comment. CaptureError."""
    text = comment.strip()
    if not text.startswith(_MARK):
        return "", {}
    try:
        told = json.loads(text[len(_MARK) :])
        part, parameters = told["part"], told["parameters"]
        if not isinstance(part, str) or not isinstance(parameters.get("XTAL_HZ", 16_000_000), int):
            raise ValueError
        if parameters.get("TIMING", "FAST") not in ("FAST", "DATASHEET"):
            raise ValueError
    except (ValueError, KeyError, TypeError, AttributeError):
        raise CaptureError(
            f"{name}: its comment `openppmc …` is damaged: take it out, and name part and clock in a map"
        ) from None
    return part, parameters


def read_vcd(path: Path) -> Capture:
    """All variables; one that stands in several scopes by its name in the outermost, and if there are more as
    deep by the first one's and each as `scope.name`. CaptureError."""
    needs("decode", f"{path.name}: a capture in VCD", "vcd")
    from vcd.reader import TokenKind, VCDParseError, tokenize

    names: dict[str, list[str]] = {}
    channels: dict[str, Channel] = {}
    depths: dict[str, int] = {}
    homes: dict[str, tuple[str, str]] = {}
    scopes: list[str] = []
    part, parameters = "", dict[str, object]()
    scale, now, started, whole = 1.0, 0, set[str](), False
    try:
        with path.open("rb") as file:
            for token in tokenize(file):
                kind = token.kind
                if kind is TokenKind.CHANGE_SCALAR or kind is TokenKind.CHANGE_VECTOR:
                    change: Any = token.data
                    _take(channels, names, change.id_code, change.value, now, started)
                elif kind is TokenKind.CHANGE_TIME:
                    now = round(token.time_change * scale)
                elif kind is TokenKind.SCOPE:
                    scopes.append(str(token.scope.ident))
                elif kind is TokenKind.UPSCOPE:
                    scopes.pop()
                elif kind is TokenKind.COMMENT:
                    part, parameters = _core(token.comment, path.name) if not part else (part, parameters)
                elif kind is TokenKind.TIMESCALE:
                    unit = str(token.timescale.unit.value)
                    scale = int(token.timescale.magnitude) * (_UNITS[unit] or 1e-3)
                elif kind is TokenKind.VAR:
                    var = token.var
                    name = str(var.reference)
                    if var.size == 1 and var.bit_index is not None:
                        name = f"{name}[{var.bit_index}]"
                    depth, home = len(scopes), ".".join(scopes)
                    if name not in depths or depth < depths[name]:
                        depths[name], homes[name] = depth, (home, var.id_code)
                        channels[name] = Channel(width=var.size)
                        for known in names.values():
                            if name in known:
                                known.remove(name)
                        names.setdefault(var.id_code, []).append(name)
                    elif depth == depths[name]:
                        for where, code in (homes[name], (home, var.id_code)):
                            full = f"{where}.{name}"
                            if full not in channels:
                                channels[full] = Channel(width=var.size)
                                names.setdefault(code, []).append(full)
                elif kind is TokenKind.ENDDEFINITIONS:
                    whole = True
    except VCDParseError as error:
        where = f" at line {error.loc.line}" if hasattr(error, "loc") else ""
        what = f"cut off or damaged{where}: export it again" if whole else f"no VCD{where}"
        raise CaptureError(f"{path.name}: {what}") from None
    except (OSError, ValueError, KeyError, AttributeError, IndexError) as error:
        raise CaptureError(f"{path.name}: cannot be read as VCD ({error})") from None
    if not whole:
        raise CaptureError(f"{path.name}: cut off in its head: export it again")
    return Capture(path.name, channels, now, part=part, parameters=parameters)


def _take(
    channels: dict[str, Channel],
    names: dict[str, list[str]],
    code: str,
    value: int | str,
    t: int,
    started: set[str],
) -> None:
    """A change; unknown and floating levels are as before."""
    if isinstance(value, str):
        if not value.strip("01"):
            value = int(value, 2)
        else:
            return
    for name in names.get(code, ()):
        if name in started:
            channels[name].add(t, value)
        else:
            channels[name].initial = value
            started.add(name)
