"""Latencies of the PPMC-312 of this project, and the times of the data sheet.

The latencies are within the bounds of the rules.
"""

from __future__ import annotations

from dataclasses import dataclass

from .stages import RIGHT_DOWN, TRIANGLE, Plan, Table
from .stages import TRAPEZOID as TRAPEZOID_KIND

US, WIDTH = 16, 80
"""Numbers of crystal cycles in a microsecond at 16 MHz, and in the pulse width TW."""


@dataclass(frozen=True)
class CoreTiming:
    """Constants of one core in cycles, except `early`.

    The methods return the times of plans and tables, which depend on the table.

    Attributes:
        arbitration: from the write event of the header, the trigger, or the end of the last instruction to
            the start of processing. In this time, the block is fetched at one byte per cycle and checked.
        check: from the start of processing to the checks.
        effect: from the start of processing to the effect of a short instruction.
        copy: additional time of an instruction that is registered.
        data: additional time of a data block of a free curve, without its bytes (one cycle each).
        limits: from the effect to the limit check of a start, which uses the levels at its edge.
        answer: from the effect to the stored response, without its bytes (one cycle each).
        result_lead: serial mode: time from the result of an event or override, which a poll can then report,
            to the stored response. The parallel mode needs this time to load the response.
        done: from the stored response to MWEF = 0.
        reset: from the start of processing to the reset by instruction FF.
        reboot: from the reset by instruction FF to its effect.
        reopen: from the reset by instruction FF to MWEF = 0.
        alarm: from a multiple occurrence to the alarm that it causes.
        halt: from the effect of instruction 80 to the stop of the pulses.
        next_response: from the read of a response to the store of the response that waited for it
            (P312-RSP-20, <= 4).
        load: from the store of a response to its load.
        show: from the load to MREF = 0.
        reload: from MREF = 1 to the next load (P312-PAR-08).
        rest: from the end of the pulses, or the falling edge of pout, to standstill.
        report: from standstill to report E0 (<= 64).
        turn_back: from the end of phase 1 of a zero return to t0 of phase 2 (<= 64).
        run_to_t0: from RUN to t0 of an operation that waits for RUN.
        count: from a pulse to the change of POS.
        compare: from a pulse to the actions that the position triggers (P312-MOT-05, P312-OVR-12).
        unlock: from a pulse to report E1.
        lead, slow_lead, change_lead, ramp_lead, origin_lead: shortest time from an event to an interval
            boundary that the event affects. The events are, in this order: a level of the high-speed limit,
            instruction 81, instruction 88, instruction 87, a level of the origin.
        drop_lead: shortest time from a newer instruction 87 or 88 to a boundary at which it replaces a
            waiting change.
        const_rate_lead: time for which the rate must be constant before instruction 87 takes effect.
        search: addition to const_rate_lead if the rate of a stage has become the constant rate, because its
            t(x) must be searched first.
        scan: one pass over the table.
        limit_from: from t0 to the first check of the high-speed limit.
        least: shortest interval (P312-MOT-04).
        armed: from a new head of the command FIFO to the first trigger that releases it (P312-OVR-02, <= 4).
        compare_lag: from a change of POS or ENC to the result of a monitor's comparison. The status bit
            follows one cycle later, the report two cycles later.
        standstill: from standstill to the first evaluation of the in-position monitor.
        character: from the middle of the stop bit to the character. This entry and the next five apply to the
            serial mode.
        frame: from the last character to the event that corresponds to the header write of the parallel mode.
        sampling: from the last character to the sampling of reports, state and counters.
        reply: from the sampling for a reply, or from the stored response, to the rising edge of snd.
        clear: shortest time from the middle of the stop bit to the rising edge of snd, minus one bit.
        silence: addition to the 20 ms without a character that end a frame.
        early: crystal cycles that are subtracted from a DATASHEET time, because they have already passed.
        proc_time: from the end of a DATASHEET time to the effect of the instruction.
        pins: from an internal level to irq_n and intlk_n.
        wrq_fast: T_WRQ with FAST timing.
        ready: from the first edge after a reset to out_oe, with FAST timing.
        start: addition to the DATASHEET time from a reset to out_oe.
    """

    arbitration: int = 1
    check: int = 22
    effect: int = 23
    copy: int = 19
    data: int = 3
    limits: int = 1
    answer: int = 3
    result_lead: int = 1
    done: int = 1
    reset: int = 20
    reboot: int = 2
    reopen: int = 4
    alarm: int = 1
    halt: int = 1
    next_response: int = 1
    load: int = 1
    show: int = 6
    reload: int = 10
    rest: int = 1
    report: int = 0
    turn_back: int = 1
    run_to_t0: int = 0
    count: int = 1
    compare: int = 2
    unlock: int = 3
    lead: int = 2
    slow_lead: int = 3
    change_lead: int = 5
    drop_lead: int = 3
    ramp_lead: int = 9
    const_rate_lead: int = 7
    search: int = 129
    origin_lead: int = 2
    scan: int = 131
    limit_from: int = 6
    least: int = 4
    armed: int = 2
    compare_lag: int = 3
    standstill: int = 4
    character: int = 1
    frame: int = 1
    sampling: int = 1
    reply: int = 1
    clear: int = 2
    silence: int = 1
    early: int = 8
    proc_time: int = 3
    pins: int = 1
    wrq_fast: int = 6
    ready: int = 3
    start: int = 2

    def look_up(self) -> int:
        """Return the duration of one look-up in the table in cycles.

        This is the time from the effect of instruction 87 or 88 to the change, or, for a start without a
        plan, to t0.
        """
        return self.scan + 4

    def starting(self, plan: Plan, single: bool = False, ramped: bool = False) -> int:
        """Return the number of cycles from the effect of a start to t0.

        The look-up of the rate also adds up the pulses of the ramps. If the deceleration does not begin with
        a full stage, another pass over the deceleration ramp is required. A triangular profile requires a
        multiplication and a division.

        Args:
            single: True for a single step, which requires no look-up.
            ramped: True if the operation has a plan with ramps.
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
        """Return the cycles from the effect of instruction 00 to the last word of the table.

        An arithmetic operation of n steps takes n + 4 cycles, a division one cycle more. The numbers in
        parentheses are numbers of steps. P312-TBL-01, -02 and -04 define the symbols, except that C = K Rs
        RH. First, K RH and K Rs are calculated (24 each). Then, for each stage, the speed D (24), D / 2 (1),
        C + D / 2 and C / D (16 each), and, for each ramp, S + D (24) are calculated. In a second pass, D is
        calculated again and, for each ramp that uses the stage, also P D and its share of S (24 each).
        """
        stages, speed, separate = 127, 28, int(table.separate)
        sides = (table.sa, table.sd) if separate else (table.sa,)
        shares = sum((127 - first) * (28 + 29 + 1) for first in sides) + separate * table.sa
        rates = speed + 5 + 20 + 21 + 2 + 28 * (1 + separate) + 1
        return 3 + 28 + 28 + stages * rates + stages * (speed + 1) + shares + 1

    def looking_up(self) -> int:
        """Return the cycles from the last word of a table to the valid table.

        During these cycles, the start-up rate is looked up.
        """
        return self.scan + 3

    def reading(self, block: bytes) -> int:
        """Return the cycles from the end of a block of a table read to the store of the next block.

        Each byte takes one cycle, and each stage takes three more cycles.
        """
        stages = (len(block) - 3) // (2 if block[2] == 1 else 3)
        return len(block) + 3 * stages


# Times of P312-TIM in crystal cycles from the write of the header, or from the trigger.
READY = 1600 * US
BUILD = {(False, False): 115_000 * US, (False, True): 200_000 * US}
BUILD |= {(True, False): 175_000 * US, (True, True): 260_000 * US}
"""Build time of a table, by (sigmoid, separate deceleration)."""
TRAPEZOID, OTHER_SHAPE, TRAPEZOID_RATE, OTHER_SHAPE_RATE = 100 * US, 700 * US, 900 * US, 1400 * US
CONSTANT, ENDLESS, ENDLESS_RATE, GENERAL = 400 * US, 60 * US, 400 * US, 500 * US
STOP, OUTPUT = 350 * US, 300 * US
PIN_LOW, EVT_LOW = 200 * US, 25_000 * US

# Functional times in crystal cycles; they are equal for FAST and DATASHEET.
CLEAR_PULSE, CURRENT_DOWN, SAMPLE, SILENCE = 393_216, 1_600_000, 800, 320_000
