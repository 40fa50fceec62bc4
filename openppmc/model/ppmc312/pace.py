"""How long the PPMC-312 of this project takes inside the windows of its rules, and the sheet's times."""

from __future__ import annotations

from dataclasses import dataclass

from .stages import RIGHT_DOWN, TRIANGLE, Plan, Table
from .stages import TRAPEZOID as TRAPEZOID_KIND

US, WIDTH = 16, 80
"""XTAL cycles of a microsecond at 16 MHz, and of TW."""


@dataclass(frozen=True)
class Pace:
    """Constants of one core, all in clk; the times of plans and tables depend on the table.

    Instructions. turn: header write event, trigger, or end of the last one to the begin of processing (the
    block is fetched at one byte a clk and judged). judge, effect: from there to the checks, and to the effect
    of anything short. copy: more for what is registered. limits: effect to the limit check of a start, which
    sees the levels of its edge. answer: effect to the stored answer, without its bytes (one clk each). done:
    stored to MWEF = 0. reset: begin of processing to the reset by FF, reboot: from there to its effect,
    reopen: to MWEF = 0. alarm: multiple occurrence to its alarm. halt: effect of 80 to its stop. found:
    further block of a table read after the one before has been read, without its bytes, three more for each
    of its stages.

    Responses. late: an earlier answer read to the one that waited for it (P312-RSP-20, <= 4). load: store to
    load; show: load to MREF = 0; reload: MREF = 1 to the next load (P312-PAR-08).

    Motion. report: rest to E0 (<= 64). rest: end of pulses, or fall of pout, to rest. turn_back: phase 1
    of a zero return to t0 of phase 2 (<= 64). held: RUN to t0 of a held operation. count: pulse to POS,
    compare: to what the position triggers (P312-MOT-05, P312-OVR-12), unlock: to E1. lead, slow_lead,
    change_lead, ramp_lead, origin_lead: the high-speed limit, 81, 88, 87, the level of the origin counts
    for a boundary that comes at least this much later; drop_lead: the same for what a newer 87 or 88
    replaces; flat_lead: 87 needs a constant rate for so long. search: so much longer after a stage has
    become the constant rate, whose t(x) must be found first. scan: one pass over the table. young: t0 to
    the first look at the high-speed limit. least: shortest interval (P312-MOT-04). armed: a new head of
    the command FIFO to its trigger (P312-OVR-02, <= 4).

    Monitors. compare_lag: POS or ENC to inside or outside, one clk more to the status bit, two to the report.
    quiet: rest to the first look at the in-position monitor.

    Serial mode. heard: middle of the stop bit to the character. frame: last character to what is a header
    write in parallel mode. look: the same to the look at reports, state and counters. reply: that look, or
    the stored answer, to the rise of snd, which clear, clk beyond a bit from the middle of the stop bit, may
    put off. silence: clk beyond the 20 ms.

    DATASHEET. early: XTAL cycles that a time is shortened by, for what has passed on the way; paced: its end
    to the effect.

    Pins. pins: internal level to irq_n and intlk_n. wrq_fast: T_WRQ in FAST. ready: first edge after reset
    to out_oe in FAST, start: the same beyond the time of DATASHEET.
    """

    turn: int = 1
    judge: int = 22
    effect: int = 23
    copy: int = 19
    data: int = 3
    limits: int = 1
    answer: int = 3
    done: int = 1
    reset: int = 20
    reboot: int = 2
    reopen: int = 4
    alarm: int = 1
    halt: int = 1
    late: int = 1
    load: int = 1
    show: int = 6
    reload: int = 10
    rest: int = 1
    report: int = 0
    turn_back: int = 1
    held: int = 0
    count: int = 1
    compare: int = 2
    unlock: int = 3
    lead: int = 2
    slow_lead: int = 3
    change_lead: int = 5
    drop_lead: int = 3
    ramp_lead: int = 9
    flat_lead: int = 7
    search: int = 129
    origin_lead: int = 2
    scan: int = 131
    young: int = 6
    least: int = 4
    armed: int = 2
    compare_lag: int = 3
    quiet: int = 4
    heard: int = 1
    frame: int = 1
    look: int = 1
    reply: int = 1
    clear: int = 2
    silence: int = 1
    early: int = 8
    paced: int = 3
    pins: int = 1
    wrq_fast: int = 6
    ready: int = 3
    start: int = 2

    def look_up(self) -> int:
        """clk from the effect of 87, 88 to the change, or to t0 without a plan: one pass over the table."""
        return self.scan + 4

    def starting(self, plan: Plan, single: bool = False, ramped: bool = False) -> int:
        """clk from the effect to t0. single: single step, which needs no look-up. ramped: planned.

        The look-up sums the sides, too. It takes another pass over the deceleration side where that does not
        begin with a full stage; a triangle multiplies and divides.
        """
        if single:
            return 3
        clk = self.look_up()
        if not ramped or plan.n is None:
            return clk
        table, end = plan.table, plan.table.stage(plan.rate) + 1
        if end - 1 <= table.sa:
            clk, part = clk + 3, plan.n < sum(table.pd[table.sd : end])
        else:
            clk += {TRAPEZOID_KIND: 7, TRIANGLE: 61}.get(plan.kind, 4)
            part = plan.kind in (TRIANGLE, RIGHT_DOWN)
        return clk + part * (5 + max(0, end - table.sd))

    def filling(self, table: Table) -> int:
        """clk from the effect of 00 to the last word of the table.

        One operation of n steps takes n + 4 clk, a division one more: K RH, K Rs (24 steps each); then for
        each stage its speed D (24), D / 2 (1), C + D / 2 and C / D (16 each), and S + D for each side (24);
        then again D, and for each side that uses the stage P D and its share of S (24 each).
        """
        stages, speed, separate = 127, 28, int(table.separate)
        sides = (table.sa, table.sd) if separate else (table.sa,)
        shares = sum((127 - first) * (28 + 29 + 1) for first in sides) + separate * table.sa
        rates = speed + 5 + 20 + 21 + 2 + 28 * (1 + separate) + 1
        return 3 + 28 + 28 + stages * rates + stages * (speed + 1) + shares + 1

    def looking_up(self) -> int:
        """clk from the last word of a table to the valid one: the start-up rate is looked up."""
        return self.scan + 3

    def reading(self, block: bytes) -> int:
        """clk from a read block of a table read to the next one in its store."""
        stages = (len(block) - 3) // (2 if block[2] == 1 else 3)
        return len(block) + 3 * stages


# Section 8, in XTAL cycles from the header write or the trigger.
READY = 1600 * US
BUILD = {(False, False): 115_000 * US, (False, True): 200_000 * US}
BUILD |= {(True, False): 175_000 * US, (True, True): 260_000 * US}
"""By (sigmoid, separate deceleration)."""
TRAPEZOID, OTHER_SHAPE, TRAPEZOID_RATE, OTHER_SHAPE_RATE = 100 * US, 700 * US, 900 * US, 1400 * US
CONSTANT, ENDLESS, ENDLESS_RATE, GENERAL = 400 * US, 60 * US, 400 * US, 500 * US
STOP, OUTPUT = 350 * US, 300 * US
PIN_LOW, EVT_LOW = 200 * US, 25_000 * US

# Functional times, in XTAL cycles, the same in both modes.
CLEAR_PULSE, CURRENT_DOWN, SAMPLE, SILENCE = 393_216, 1_600_000, 800, 320_000
