"""Contracts of the clocks, counters and timers in rtl/motion."""

from __future__ import annotations

from fractions import Fraction
from math import ceil

import cocotb

from openppmc.model.motion.excitation import step_list

from ..harness import Block, BlockDriver, rng, same

BASES = [(8, 32, 30), (1, 5, 7), (2, 3, 1)]  # fast, slow and extra time in quanta; fast is at most slow
EXTERNAL = [(136, 128), (20, 13), (9, 9), (940, 885)]
LAGS = [120, 83, 5]
SHAPES = [  # ClkHz, XtalHz, WidthXtal, HalfXtal, HalfRates
    (16_000_000, 16_000_000, 80, 16, 3),
    (11_059_200, 16_000_000, 80, 16, 3),
    (8_000_000, 16_000_000, 80, 16, 3),
    (25_000_000, 8_000_000, 40, 4, 5),
]
HOLDS = [(1, 0), (5, 0), (8, 0), (13, 0), (0, 3), (6, 1), (7, 9)]  # quanta, additional cycles
HOLD_UNITS = [(2, 8), (16, 4), (512, 2)]  # quanta per unit, number of bits of units_i
CHOPS = [(12, 9), (3, 6), (1, 9)]
BLOCKS = {
    **{
        f"base{i}": Block(
            "ppmc_base_clock",
            "restart_i quantum_i slow_i extra_i tick_o",
            {"FastQuanta": fast, "SlowQuanta": slow, "ExtraQuanta": extra},
        )
        for i, (fast, slow, extra) in enumerate(BASES)
    },
    **{
        f"rate{bits}": Block(
            "ppmc_rate_counter",
            f"restart_i tick_i rate_i:{bits} wait_i rising_i hit_o half_o",
            {"RateBits": bits},
        )
        for bits in (8, 10)
    },
    **{
        f"ext{i}": Block(
            "ppmc_ext_clock",
            "pin_i rise_o fall_o long_period_o short_period_o",
            {"LongPeriodCycles": long, "ShortPeriodCycles": short},
        )
        for i, (long, short) in enumerate(EXTERNAL)
    },
    **{
        f"lag{lag}": Block(
            "ppmc_ext_extra_time",
            "en_i restart_i edge_i long_period_i hit_i count_o fire_o",
            {"ExtraCycles": lag},
        )
        for lag in LAGS
    },
    **{
        f"shape{i}": Block(
            "ppmc_pulse_shaper",
            "arm_i pulse_i full_i halve_i rate_i:8 cut_i low_o past_o",
            {"ClkHz": clk, "XtalHz": xtal, "WidthXtal": width, "HalfXtal": half, "HalfRates": rates},
        )
        for i, (clk, xtal, width, half, rates) in enumerate(SHAPES)
    },
    **{
        f"hold{quanta}": Block(
            "ppmc_hold_timer", "busy_i quantum_i units_i hold_o", {"Quanta": quanta, "RestCycles": rest}
        )
        for quanta, rest in HOLDS
    },
    **{
        f"units{quanta}": Block(
            "ppmc_hold_timer", f"busy_i quantum_i units_i:{bits} hold_o", {"Quanta": quanta, "UnitBits": bits}
        )
        for quanta, bits in HOLD_UNITS
    },
    **{
        f"chop{unit}": Block(
            "ppmc_chopper",
            f"run_i restart_i quantum_i on_base_i:{bits} off_base_i:{bits} on_units_i:8 off_units_i:8 on_o",
            {"UnitQuanta": unit, "BaseBits": bits},
        )
        for unit, bits in CHOPS
    },
    "count": Block("ppmc_pulse_counter", "clear_i pout_ni dir_i count_o:4", {"Width": 4}),
    "excitation": Block(
        "ppmc_excitation",
        "motor_i:2:ppmc_motion_pkg::motor_e half_i phase_init_i off_i step_i ccw_i pattern_o:5",
    ),
    **{
        f"port{idle}": Block(
            "ppmc_motor_port",
            "busy_i low_i step_i ccw_i quantum_i motor_i:2:ppmc_motion_pkg::motor_e half_i positive_i"
            " phase_init_i off_i chop_i chop_restart_i on_base_i:9 off_base_i:9 on_units_i:8 off_units_i:8"
            " hold_units_i levels_o:5 s_o:5 hold_o pout_no dir_o",
            {"HoldQuanta": 6, "PhaseIdle": idle},
        )
        for idle in (0, 1)
    },
    **{
        f"guard{variant}": Block(
            "ppmc_stop_monitor",
            "clear_i complete_i armed_i op_i:5 switches_i:6 top_i at_start_rate_i dec_i halt_i decel_i slow_i"
            " slow_seen_o stop_o forced_o flagged_o cause_o:4",
            {"StopAtSlow": min(variant, 1), "SlowAlways": min(variant, 1), "SlowOrigin": variant // 2},
        )
        for variant in (0, 1, 2)
    },
}


@cocotb.test()
async def base_clock_quanta(dut):
    """After a restart at any time, each period ends on the correct quantum; the extra time is added before
    the first period.
    """
    rand = rng()
    for i, (fast, slow, extra) in enumerate(BASES):
        u = BlockDriver(dut, f"base{i}", BLOCKS, "tick_o")
        await u.reset()
        for _ in range(40):
            is_slow, has_extra = rand.randrange(2), rand.randrange(2)
            period, before = slow if is_slow else fast, extra if has_extra else 0
            # A quantum in the cycle of the restart belongs to the previous interval.
            await u.clk(restart_i=1, quantum_i=rand.randrange(2), slow_i=is_slow, extra_i=has_extra)
            count = 0
            for _ in range(rand.randint(1, 4 * (before + 3 * period))):
                quantum = rand.random() < 0.5
                count += quantum
                due = quantum and count > before and (count - before) % period == 0
                got = await u.clk(restart_i=0, quantum_i=quantum)
                same(f"{BASES[i]}, slow {is_slow}, extra {has_extra}, quantum {count}", got, due)


@cocotb.test()
async def rate_counter_hit(dut):
    """From the restart, hit_o is asserted at base clock number rate + 1, and half_o from base clock number
    floor((rate + 1) / 2) on.
    """
    rand = rng()
    for bits in (8, 10):
        u = BlockDriver(dut, f"rate{bits}", BLOCKS, "hit_o half_o")
        await u.reset()
        top = 2**bits - 1
        rates = [*range(10), 127, 128, top - 1, top, *(rand.randint(10, top) for _ in range(6))]
        for rate in rates:
            await u.clk(restart_i=1, rate_i=rate, tick_i=1)
            middle = (rate + 1) // 2
            for number in range(1, rate + 3):
                await u.clk(restart_i=0, tick_i=0)
                await u.clk()
                for _ in range(rand.choice((0, 0, 1, 2))):
                    same(f"rate {rate}, no base clock {number}", await u.clk(), (0, number > middle))
                hit, half = await u.clk(tick_i=1)
                same(
                    f"rate {rate}, base clock {number}: hit, half",
                    (hit, half),
                    (number > rate, number >= middle),
                )


@cocotb.test()
async def rate_counter_wait(dut):
    """While the rate is still rising, neither hit_o nor half_o is asserted. The base clocks during this time
    are counted; the count does not exceed the rate of that moment.
    """
    rand = rng()
    u = BlockDriver(dut, "rate8", BLOCKS, "hit_o half_o")
    await u.reset()
    for _ in range(60):
        rate, passed = rand.randint(0, 6), rand.randint(0, 9)
        await u.clk(restart_i=1, rate_i=rate, tick_i=0, wait_i=1, rising_i=1)
        count = 0
        for _ in range(passed):
            for _ in range(3):
                await u.clk(restart_i=0, tick_i=0)
            same("passed over, no half", await u.clk(tick_i=1), (0, 0))
            count = min(count + 1, rate)
            if rand.random() < 0.3:
                rate += 1
                await u.clk(rate_i=rate, tick_i=0)
        for number in range(count, rate + 1):
            await u.clk(restart_i=0, tick_i=0, wait_i=0, rising_i=0)
            for _ in range(2):
                # If enough base clocks for half of the interval have already occurred, half_o is asserted
                # immediately.
                same("no tick", await u.clk(), (0, 2 * number >= rate))
            hit, _ = await u.clk(tick_i=1)
            same(f"rate {rate}, {passed} passed over, {number + 1} counted: hit", hit, number == rate)


@cocotb.test()
async def rate_counter_final_rate(dut):
    """If the rate is final but wait_i = 1, half_o is asserted at its base clock, and hit_o is delayed until
    wait_i = 0.
    """
    u = BlockDriver(dut, "rate8", BLOCKS, "hit_o half_o")
    await u.reset()
    for rate in range(9):
        await u.clk(restart_i=1, rate_i=rate, tick_i=0, wait_i=1)
        for number in range(1, rate + 4):
            for _ in range(3):
                await u.clk(restart_i=0, tick_i=0)
            got = await u.clk(tick_i=1)
            same(f"rate {rate}, base clock {number}: hit, half", got, (0, number >= (rate + 1) // 2))
        for _ in range(3):
            await u.clk(wait_i=0, tick_i=0)
        same(f"rate {rate}: hit as soon as allowed", (await u.clk(tick_i=1))[0], 1)


@cocotb.test()
async def ext_clock_thresholds(dut):
    """For periods near both thresholds, long_period_o and short_period_o switch in the exact cycle; fall_o is
    at least 2 cycles after rise_o.
    """
    rand = rng()
    for i, (long, short) in enumerate(EXTERNAL):
        u = BlockDriver(dut, f"ext{i}", BLOCKS, "rise_o fall_o long_period_o short_period_o")
        for rest in (0, 1):
            await u.reset(pin_i=rest)
            for n in range(6):
                rise, fall, *_ = await u.clk()
                same(f"rest {rest}, cycle {n}", (rise, fall), (0, rest == 0 and n == 2))
            await u.clk(pin_i=0)
            await u.clk()
            await u.clk()
            edges = [short - 1, short, short + 1, long - 1, long, long + 1, 2 * long, 3 * long + 7, 2, 3, 5]
            levels, last = [0] * 5, None
            periods = [*edges, *rand.sample(edges, len(edges)), *edges]
            wave = [
                level
                for p in periods
                for high in [rand.randint(1, p - 1)]
                for level in [1] * high + [0] * (p - high)
            ]
            for t, level in enumerate([*wave, 1, 1, 1]):
                rise, fall, is_long, is_short = await u.clk(pin_i=level)
                ended = levels[-4:-1] == [1, 1, 0] or levels[-5:-1] == [0, 1, 0, 0]
                same(f"cycle {t}: rise, fall", (rise, fall), (levels[-3:-1] == [0, 1], ended))
                if rise:
                    period = 10**9 if last is None else t - last
                    where = f"{EXTERNAL[i]}, period {period}: long, short"
                    same(where, (is_long, is_short), (period > long, period < short))
                    last = t
                levels.append(level)


@cocotb.test()
async def ext_lag_sum(dut):
    """If the first edge of the base clock is d cycles after the pulse, the interval ends ExtraCycles - d
    cycles after hit_i.
    """
    rand = rng()
    for lag in LAGS:
        u = BlockDriver(dut, f"lag{lag}", BLOCKS, "count_o fire_o")
        await u.reset()
        for d in [0, 1, 2, lag - 1, lag, lag + 1, 3 * lag, *(rand.randint(0, lag) for _ in range(25))]:
            enabled, long, wait = rand.random() < 0.8, rand.random() < 0.2, rand.randint(1, lag + 20)
            where = f"lag {lag}, d {d}, enabled {enabled}, long {long}, hit {wait} later"
            await u.clk(en_i=enabled, restart_i=1, edge_i=d == 0, hit_i=0, long_period_i=0)
            hit = d + wait
            due = hit + (max(lag - d, 0) if enabled and not long else 0)
            for t in range(1, due + 1):
                is_edge = t in (d, hit)
                got = await u.clk(restart_i=0, edge_i=is_edge, hit_i=t == hit, long_period_i=is_edge and long)
                same(f"{where}, cycle {t}: count, fire", got, (t > d or not enabled, t == due))


@cocotb.test()
async def pulse_shaper_width(dut):
    """For all kinds of pulses the low time is exact: the full time, half an interval, or a time that cut_i
    ends.
    """
    rand = rng()
    for i, (clk, xtal, width, half, rates) in enumerate(SHAPES):
        u = BlockDriver(dut, f"shape{i}", BLOCKS, "low_o past_o")
        whole = ceil(Fraction(width * clk, xtal))
        await u.reset()
        for n in range(60):
            armed = n % 6 == 5
            full, halve, rate = rand.random() < 0.3, rand.random() < 0.7, rand.choice((*range(7), 255))
            cut = rand.choice((0, 1, 2, whole // 2, whole - 1, whole))
            low = whole
            if halve and rate < rates:
                low = min(low, ceil(Fraction(half * (rate + 1) * clk, xtal)))
            low = min(low, cut) if cut else low
            low = 0 if armed else whole if full else low
            where = f"{SHAPES[i]}, rate {rate}, halve {halve}, full {full}, cut {cut}"
            await u.clk(
                arm_i=armed, pulse_i=not armed, full_i=full, halve_i=halve, rate_i=rate, cut_i=cut == 0
            )
            u.put(arm_i=0, pulse_i=0, full_i=not full)
            for t in range(1, whole + rand.randint(1, 150)):
                got = await u.clk(cut_i=t == cut)
                same(f"{where}, cycle {t}: low, up", got, (t <= low, t >= whole))


@cocotb.test()
async def hold_timer_quanta(dut):
    """hold_o falls one cycle after busy_i rises. It rises one cycle after the end of the hold time, which
    follows the motion.
    """
    rand = rng()
    for quanta, rest in HOLDS:
        u = BlockDriver(dut, f"hold{quanta}", BLOCKS, "hold_o")
        await u.reset()
        for _ in range(5):
            same("1 after reset", await u.clk(quantum_i=1), 1)
        hold = 1
        for _ in range(30):
            for t in range(rand.randint(1, 5)):
                same("busy", await u.clk(busy_i=1, quantum_i=rand.randrange(2)), t == 0 and hold)
            count, hold, rested = 0, 0, 0
            for t in range(rand.randint(0, 8 * quanta + rest + 4)):
                # No quantum tick occurs in the additional cycles, which are fewer than a quantum.
                quantum = t > 0 and rand.random() < 0.5 and (not rest or count < quanta or hold)
                same(
                    f"{quanta} quanta, {count} passed, cycle {t}",
                    await u.clk(busy_i=0, quantum_i=quantum),
                    hold,
                )
                if count >= quanta:
                    hold = hold or rested >= rest
                    rested += 1
                count += quantum


@cocotb.test()
async def hold_timer_units(dut):
    """The value of units_i at the end of the motion sets the hold time, exact to the quantum, although
    units_i changes at random.
    """
    rand = rng()
    for quanta, bits in HOLD_UNITS:
        u = BlockDriver(dut, f"units{quanta}", BLOCKS, "hold_o")
        await u.reset()
        for _ in range(5):
            same("1 after reset", await u.clk(quantum_i=1), 1)
        top = 2**bits - 1
        hold = 1
        for units in [0, 1, top, *(rand.randint(0, top) for _ in range(5))]:
            busy = rand.randint(1, 5)
            for t in range(busy):
                chosen = units if t == busy - 1 else rand.randint(0, top)
                got = await u.clk(busy_i=1, quantum_i=rand.randrange(2), units_i=chosen)
                same("busy", got, t == 0 and hold)
            count, hold, whole = 0, 0, quanta * (units + 1)
            for t in range(whole * 3 // 2 if rand.random() < 0.3 else 2 * whole + 4):
                quantum = t > 0 and rand.random() < 0.8
                got = await u.clk(busy_i=0, quantum_i=quantum, units_i=rand.randint(0, top))
                same(f"{units} units of {quanta}, {count} passed, cycle {t}", got, hold)
                hold = hold or count >= whole
                count += quantum


@cocotb.test()
async def chopper_phases(dut):
    """Although the set times change at random, each phase has the length that was set when it began."""
    rand = rng()
    for unit, _ in CHOPS:
        u = BlockDriver(dut, f"chop{unit}", BLOCKS, "on_o")
        await u.reset()
        on, left, phases = True, 0, 0
        for n in range(6000):
            times = {}
            if n == 0 or rand.random() < 0.02:
                times = {
                    "on_base_i": rand.choice((1, 2, rand.randint(1, 40))),
                    "off_base_i": rand.choice((1, 2, rand.randint(1, 40))),
                    "on_units_i": rand.choice((0, 0, 1, rand.randint(0, 9))),
                    "off_units_i": rand.choice((0, 0, 1, rand.randint(0, 9))),
                }
                now = times
            run, restart = n > 3 and rand.random() < 0.998, rand.random() < 0.002
            quantum = rand.random() < 0.6
            got = await u.clk(run_i=run, restart_i=restart, quantum_i=quantum, **times)
            same(f"unit {unit}, cycle {n}", got, on or not run)
            left -= quantum
            if restart or not run or left == 0:
                on = not on if run and not restart else True
                phases += 1
                kind = "on" if on else "off"
                left = now[f"{kind}_base_i"] + unit * now[f"{kind}_units_i"]
        assert phases > 50, f"only {phases} phases"


@cocotb.test()
async def chopper_longest(dut):
    """With the maximum times that the port widths allow, both phases are exact to the quantum."""
    u = BlockDriver(dut, "chop12", BLOCKS, "on_o")
    await u.reset(on_base_i=511, off_base_i=260, on_units_i=255, off_units_i=255, quantum_i=1)
    await u.clk(run_i=0)
    for on, length in ((1, 511 + 12 * 255), (0, 260 + 12 * 255), (1, 1)):
        for n in range(length):
            same(f"on {on}, quantum {n + 1} of {length}", await u.clk(run_i=1), on)


@cocotb.test()
async def excitation_walks(dut):
    """For random steps of every motor, in full and half step, the phases are those of the model."""
    rand = rng()
    u = BlockDriver(dut, "excitation", BLOCKS, "pattern_o")
    for phases in (3, 4, 5):
        for half in (False, True):
            steps = step_list(phases, half)
            await u.reset(motor_i=phases - 2, half_i=half)
            same("reset: nothing on", await u.clk(), 0)
            index, on = 0, False
            await u.clk(phase_init_i=1)
            on = True
            u.put(phase_init_i=0)
            ccw = 0
            for n in range(400):
                ccw ^= rand.random() < 0.15
                step, off, home = rand.random() < 0.7, rand.random() < 0.01, rand.random() < 0.02
                step = step and on
                got = await u.clk(step_i=step, off_i=off, phase_init_i=home and not off, ccw_i=ccw)
                same(
                    f"{phases} phases, half {half}, cycle {n}, index {index}", got, steps[index] if on else 0
                )
                if off or home:
                    index, on = 0, not off
                elif step:
                    index = (index + (-1 if ccw else 1)) % len(steps)


@cocotb.test()
async def excitation_off_steps(dut):
    """After the phases were switched off, full steps do not energise a phase before phase_init_i."""
    u = BlockDriver(dut, "excitation", BLOCKS, "pattern_o")
    for motor in (1, 2, 3):
        await u.reset(motor_i=motor)
        await u.clk(phase_init_i=1)
        await u.clk(phase_init_i=0, off_i=1)
        for _ in range(7):
            same("off", await u.clk(off_i=0, step_i=1), 0)
        await u.clk(phase_init_i=1, step_i=0)
        same("home", await u.clk(phase_init_i=0), 3)


@cocotb.test()
@cocotb.parametrize(idle=[0, 1])
async def motor_port_pins(dut, idle):
    """During steps, pulses and chopping, every pin follows the axis by one cycle and has the correct
    polarity.
    """
    rand, steps = rng(), step_list(5, True)
    u = BlockDriver(dut, f"port{idle}", BLOCKS, "s_o pout_no dir_o levels_o")
    off = 0 if (positive := 1 - idle) else 31
    await u.reset(motor_i=3, half_i=1, positive_i=positive, on_base_i=3, off_base_i=2, quantum_i=1)
    same("hold_o after reset", u.get("hold_o"), 1)
    for _ in range(4):
        same("idle levels", await u.clk(), (off, 1, 0, off))
    await u.clk(phase_init_i=1, chop_restart_i=1, chop_i=1)
    index, before = 0, (off, 1, 0)
    for n in range(300):
        busy = 100 <= n < 200
        step, low, ccw = busy and rand.random() < 0.3, rand.randrange(2), rand.randrange(2)
        got = await u.clk(
            phase_init_i=0, chop_restart_i=0, busy_i=busy, step_i=step, low_i=low, ccw_i=ccw, off_i=n == 299
        )
        same(f"cycle {n}: pins, levels", got, (*before, steps[index] ^ off))
        # Phases are on during a motion; otherwise they are on for 3 quanta and off for 2. The first ON phase
        # begins at the restart.
        on = busy or (n if n < 100 else n - 200) % 5 < 3
        before = ((steps[index] if on else 0) ^ off, 1 - low, ccw)
        index = (index + (-1 if ccw else 1) * step) % len(steps)
    await u.clk(off_i=0)
    for _ in range(3):
        same("off", (await u.clk())[0], off)


def guard(
    p: dict[str, int], flagged: int, variant: int = 0
) -> tuple[int, int, int, tuple[int, int, int, int]]:
    """Return slow_seen, stop, forced and the causes (stop, alarm, limit, slow) that one cycle of levels `p`
    sets.

    Variant 1: slow-down limits always count, and a deceleration at the start-up rate ends immediately.
    Variant 2: as variant 1, and a slow-down limit ends an origin search.
    """
    limit = p["limit_ccw"] if p["ccw"] else p["limit_cw"]
    slow = p["slow_ccw"] if p["ccw"] else p["slow_cw"]
    if not p["armed"]:
        return 0, 0, flagged, (0, 0, 0, 0)
    halted = p["halt"] or (p["decel"] and not p["ramp"])
    blocked = int(variant == 2 and bool(p["origin"]) and bool(slow))
    if limit or p["alarm"] or halted or blocked or (p["home"] and p["origin"]):
        return 0, 1, flagged, (int(bool(halted)), p["alarm"], limit, blocked)
    if flagged or p["dec"] or not p["ramp"]:
        return 0, 0, flagged, (0, 0, 0, 0)
    seen = int(bool(slow and (variant or p["top"] or not p["pout_only"])))
    forced = int(p["slow"] or p["decel"])
    return seen, int(bool(variant and p["at_start_rate"] and forced)), forced, (p["decel"], 0, 0, p["slow"])


OP = ("ramp", "single", "origin", "pout_only", "ccw")
SWITCHES = ("limit_cw", "limit_ccw", "slow_cw", "slow_ccw", "home", "alarm")
PLAIN = ("armed", "top", "at_start_rate", "dec", "halt", "decel", "slow")


def guard_pins(p: dict[str, int], name: str) -> dict[str, int]:
    """Return the input port that contains the level `name`, with the value of the whole port (structures are
    packed).
    """
    for pin, names in (("op_i", OP), ("switches_i", SWITCHES)):
        if name in names:
            return {pin: sum(p[key] << (len(names) - 1 - n) for n, key in enumerate(names))}
    return {f"{name}_i": p[name]}


@cocotb.test()
@cocotb.parametrize(flagged=[0, 1], variant=[0, 1, 2])
async def stop_guard_truth_table(dut, flagged, variant):
    """For every combination of levels, stop, forced and slow_seen equal those of a plain function.

    In a cycle in which stop is 1, forced and slow_seen are not checked, because no pulse can use them. The
    test stop_guard_causes checks the stored values.
    """
    u = BlockDriver(dut, f"guard{variant}", BLOCKS, "slow_seen_o stop_o forced_o")
    await u.reset()
    if flagged:
        await u.clk(armed_i=1, op_i=0b10000, decel_i=1)
    without = ("single",) if variant else ("single", "at_start_rate")
    names = [name for name in (*OP, *SWITCHES, *PLAIN) if name not in without]
    p = dict.fromkeys((*OP, *SWITCHES, *PLAIN), 0)
    await u.settle(armed_i=0, op_i=0, decel_i=0)
    same("flagged", u.get("flagged_o"), flagged)
    # One level changes at a time (Gray code), so one write per combination is sufficient.
    for n in range(1, 2 ** len(names) + 1):
        got, want = await u.settle(), guard(p, flagged, variant)[:3]
        if got[1] != want[1] or (not want[1] and got != want):
            same(f"{[name for name in p if p[name]]}: seen, stop, forced", got, want)
        bit = (n & -n).bit_length() - 1
        if bit < len(names):
            p[names[bit]] ^= 1
            u.put(**guard_pins(p, names[bit]))


@cocotb.test()
@cocotb.parametrize(variant=[0, 1, 2])
async def stop_guard_causes(dut, variant):
    """With random levels in every cycle, the causes and the deceleration request are kept until they are
    cleared.
    """
    rand = rng()
    u = BlockDriver(dut, f"guard{variant}", BLOCKS, "flagged_o cause_o")
    await u.reset()
    rare = {"armed": 0.8, "ramp": 0.8, "slow_cw": 0.4, "slow_ccw": 0.4, "top": 0.5, "ccw": 0.5, "single": 0.5}
    flagged, causes, stopped = 0, [0] * 4, False
    p = dict.fromkeys((*OP, *SWITCHES, *PLAIN), 0)
    for n in range(6000):
        for name in p:
            p[name] = int(rand.random() < rare.get(name, 0.05))
        p["armed"] &= not stopped
        clear, complete = rand.random() < 0.08, rand.random() < 0.02
        p["slow"] &= guard(p, flagged, variant)[0]
        pins = {key: value for name in p for key, value in guard_pins(p, name).items()}
        got = await u.clk(clear_i=clear, complete_i=complete, **pins)
        same(f"cycle {n}: flagged, causes", got, (flagged, int("".join(map(str, causes)), 2)))
        _, stop, forced, new = guard(p, flagged, variant)
        flagged, causes = forced, [old | more for old, more in zip(causes, new, strict=True)]
        stopped = (stopped or bool(stop)) and not clear
        if clear or complete:
            flagged, causes = 0, [0] * 4


@cocotb.test()
async def pulse_counter(dut):
    """The counter counts the falling edges of pout_n in both directions, modulo 16, between random clears."""
    rand = rng()
    u = BlockDriver(dut, "count", BLOCKS, "count_o")
    await u.reset(pout_ni=1)
    count, was = 0, 1
    for n in range(2000):
        clear, level, ccw = rand.random() < 0.02, rand.randrange(2), rand.randrange(2)
        if clear:
            count = 0
        elif was and not level:
            count = (count + (-1 if ccw else 1)) % 16
        was = level
        await u.clk(clear_i=clear, pout_ni=level, dir_i=ccw)
        same(f"cycle {n}", await u.settle(), count)
