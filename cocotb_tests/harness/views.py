"""Saved views of a run's VCD for GTKWave and Surfer: the ports of the top module, inputs first."""

from __future__ import annotations

import math
import re
from pathlib import Path

from .build import Design

_VAR = re.compile(r"\$var \w+ +(\d+) \S+ (\S+)(?: (\[\S+\]))? \$end")


def _signals(vcd: Path, design: Design) -> tuple[list[tuple[str, str, int]], int]:
    """(scope, name with range, width) of the signals of the top, its ports if known; the last time."""
    scopes: list[str] = []
    found: list[tuple[str, str, int]] = []
    with vcd.open("rb") as file:
        for raw in file:
            line = raw.decode("ascii", "replace").strip()
            if line.startswith("$scope"):
                scopes.append(line.split()[2])
            elif line.startswith("$upscope"):
                scopes.pop()
            elif line.startswith("$enddefinitions"):
                break
            elif (var := _VAR.match(line)) and scopes and scopes[-1] == design.top:
                width, name, place = var.groups()
                if design.ports in ((), "*") or name in design.ports:
                    found.append((".".join(scopes), name + (place or ""), int(width)))
        file.seek(max(0, vcd.stat().st_size - 100_000))
        times = re.findall(rb"^#(\d+)", file.read(), re.MULTILINE)
    return found, int(times[-1]) if times else 0


def write_views(vcd: Path, design: Design) -> list[Path]:
    """Write a GTKWave save file and a Surfer command file beside a VCD; [] without a VCD."""
    if not vcd.is_file():
        return []
    signals, end = _signals(vcd, design)
    gtkw, sucl = vcd.with_suffix(".gtkw"), vcd.with_suffix(".sucl")
    # The zoom is minus log2 of the time between two grid lines, of which the window shows some five.
    lines = [f'[dumpfile] "{vcd.name}"', "[timestart] 0", "[size] 1500 900"]
    lines += [f"*-{math.log2(max(5, end) / 5):.6f} -1", "[sst_width] 200", "[signals_width] 180"]
    for scope, name, width in signals:
        lines += ["@22" if width > 1 else "@28", f"{scope}.{name}"]
    gtkw.write_text("\n".join([*lines, ""]), encoding="ascii")
    adds = [f"variable_add {scope}.{name.partition('[')[0]}" for scope, name, _ in signals]
    sucl.write_text("\n".join([*adds, "zoom_fit", ""]), encoding="ascii")
    return [vcd, gtkw, sucl]
