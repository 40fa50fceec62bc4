"""How long the PMC006B4 of this project takes inside the windows of its rules, all in clk."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Pace:
    """Constants of one core.

    Reset. reset: first edge with rst_n = 1 to the first one that the inside works on.

    Line. answer: e to the origin of the reply's bit times (<= 8).

    Executor. frame: e to the first edge that may take it; effect: from there to the effect, after: from there
    to the first edge that may take anything else (<= 64 together). fetch: begin of a program instruction to
    its effect, slot: to the next one (<= 64).

    Keys. key_ticks: µs ticks of a filter beyond those of the time.

    EEPROM. job: last tick to the end of a job; fact: event to the first edge whose tick may begin a restore.
    Boot, from one clk after the last tick: wiped, kept: the program is cleared, or stays; fields: those of
    the parameters are looked at, and the same again for their storing, of which trigm is TRIGM.

    Pins. gpo: registers to their pins.

    Motion. plan: rise of BUSY to the end of planning. step: us tick to mon_step; move_end: from there to the
    fall of BUSY after the last step (<= 2); run_end: us tick to the fall of BUSY at the end of speed mode.
    Drive. grid: clk between two looks at what the references depend on, grid_from: first of them after the
    first edge inside; refs: look to the four references (grid + refs <= 64). enable: end of BOOT or change
    of FREE to the bridges. idle: us tick to the end of the idle time. force: change of a reference to OFF.
    cmp: sampled level of a comparator to its effect (<= 4).
    """

    reset: int = 2
    answer: int = 0
    frame: int = 2
    effect: int = 2
    after: int = 2
    fetch: int = 5
    slot: int = 48
    key_ticks: int = 1
    job: int = 2
    fact: int = 2
    wiped: int = 800
    kept: int = 1
    fields: int = 152
    trigm: int = 62
    gpo: int = 1
    plan: int = 800
    step: int = 2
    move_end: int = 0
    run_end: int = 0
    grid: int = 32
    grid_from: int = 0
    refs: int = 24
    enable: int = 1
    idle: int = 1
    force: int = 1
    cmp: int = 2
