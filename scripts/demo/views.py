"""Saved views of the demo's VCD: a GTKWave save file and a Surfer command file, made from the VCD's own names."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path

# Groups of the view: title, signals of the part (as in its port list), and how GTKWave shows vectors.
GROUPS: tuple[tuple[str, tuple[str, ...]], ...] = (
    ("host bus", ("cs_n", "a0", "wr_n", "rd_n", "d_i", "d_o", "d_oe")),
    ("interrupt", ("int_n",)),
    ("motor", ("pout_n", "dir", "s", "hold")),
    ("switches", ("l1_n", "l3_n", "cnp_n", "alm_n")),
    ("clock, reset", ("clk", "rst_n")),
)
HEX, BIN, COMMENT = "@22", "@28", "@200"


def declared(vcd: Path, top: str) -> dict[str, tuple[str, str]]:
    """Signals of scope `top` in a VCD: name -> (full dotted path, range such as '[7:0]' or '')."""
    scope: list[str] = []
    found: dict[str, tuple[str, str]] = {}
    with vcd.open(errors="replace") as file:
        for line in file:
            words = line.split()
            if not words:
                continue
            if words[0] == "$scope":
                scope.append(words[2])
            elif words[0] == "$upscope":
                scope.pop()
            elif words[0] == "$var" and scope and scope[-1] == top:
                name, rng = words[4], words[5] if words[5].startswith("[") else ""
                match = re.match(r"(\w+)(\[.*\])?$", name)
                if match:
                    found.setdefault(match[1], (".".join([*scope, match[1]]), match[2] or rng))
            elif words[0] == "$enddefinitions":
                break
    return found


def gtkwave(vcd: Path, target: Path, top: str, start_ps: int, end_ps: int) -> None:
    """Write a GTKWave save file that shows the groups, zoomed to a stretch of time."""
    signals = declared(vcd, top)
    # GTKWave keeps the zoom as minus the power of two of time units in a pixel; the view is some 1200 pixels wide.
    exponent = max((end_ps - start_ps) // 1200, 1).bit_length()
    lines = [
        f'[dumpfile] "{vcd.name}"', f'[savefile] "{target.name}"', f"[timestart] {start_ps}", "[size] 1500 800",
        f"*-{exponent:.6f} {start_ps} -1 -1 -1", "[sst_expanded] 1",
    ]  # fmt: skip
    for title, names in GROUPS:
        lines += [COMMENT, f"-{title}"]
        for name in names:
            if name not in signals:
                continue
            path, rng = signals[name]
            lines += [BIN if not rng or name == "s" else HEX, path + rng]
    target.write_text("\n".join(lines) + "\n")


def surfer(vcd: Path, target: Path, top: str) -> None:
    """Write a Surfer command file with the same signals."""
    signals = declared(vcd, top)
    lines = []
    for title, names in GROUPS:
        lines.append(f"divider_add {title}")
        lines += [f"variable_add {signals[name][0]}" for name in names if name in signals]
    lines += ["zoom_fit"]
    target.write_text("\n".join(lines) + "\n")


def missing(vcd: Path, top: str) -> Sequence[str]:
    """Signals of the view that the VCD does not have."""
    signals = declared(vcd, top)
    return [name for _, names in GROUPS for name in names if name not in signals]
