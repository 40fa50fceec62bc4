"""Window of the bank: registers, strobes, positions and interrupt map (BANK-WIN), also before the bank is
ready (BANK-GEN-05).

V is the edge of a visit of the axis, and R the number of cycles in a round.
"""

from __future__ import annotations

from itertools import product

from cocotb_tests.harness import BUSY, IBF, OBF, directed

from .bench import B4, B8, B16, B32, B64, F100
from .env import CONFIG, DATA, GO, INFO, INIT_A, MAP, MASK, POSITION, STATUS, STOP, Axis, Env

NOWHERE = (0x3, 0xD, 0xE, 0xF)
REGISTERS = range(16)


@directed("BANK-WIN-03", builds=(B8, B32, B64, B4, F100))
async def bank_win_03_info(dut):
    """INFO at an axis returns the byte that a[6:4] of the axis selects: 42, version 1, AXES, zeros
    (BANK-WIN-03).
    """
    env = await Env.start(dut)
    for axis in range(env.size):
        want = (0x42, 1, env.size, 0, 0, 0, 0, 0)[axis % 8]
        env.check("BANK-WIN-03", f"INFO at axis {axis}", await env.host.read(axis << 4 | INFO), want)
    axis = await env.ready(env.size - 1)
    env.check("BANK-MOT-01", "pulses of the last axis", len(await axis.move(0x43, 14)), 14)


@directed("BANK-WIN-01", builds=(B4, B8, B32))
async def bank_win_01_addresses(dut):
    """Axes and registers that do not exist read as FF, and writes to them have no effect (BANK-WIN-01)."""
    env = await Env.start(dut)
    for axis in {env.size, env.size + 1, 2 * env.size - 1, 63}:
        for register in REGISTERS:
            got = await env.host.read(axis << 4 | register)
            env.check("BANK-WIN-01", f"axis {axis}, register {register}", got, 0xFF)
        await env.host.write(axis << 4 | MASK, 0xFF)
        await env.host.write(axis << 4 | CONFIG, 0)
        for register, byte in ((1, 0x0A), (0, 9), (0, 4), (0, 4), (0, 0), (1, 0x42)):
            await env.host.write(axis << 4 | register, byte)
            await env.bench.clocks(2 * env.round)
        await env.host.write(axis << 4 | GO, 0)
        await env.host.write(axis << 4 | STOP, 0)
    for axis in (0, env.size - 1):
        for register in NOWHERE:
            await env.host.write(axis << 4 | register, 0)
            got = await env.host.read(axis << 4 | register)
            env.check("BANK-WIN-01", f"register {register}", got, 0xFF)
        for register, want in ((MASK, 0), (CONFIG, 3), (STATUS, 0)):
            got = await env.host.read(axis << 4 | register)
            env.check("BANK-WIN-01", f"axis {axis}, register {register}", got, want)
    await env.bench.clocks(500)
    env.check("BANK-WIN-01", "edges of the motors", env.bench.edges("s") + env.bench.edges("pout_n"), [])


@directed("BANK-WIN-02", "BANK-GEN-04", builds=(B8, B32))
async def bank_win_02_registers_of_an_axis(dut):
    """Each axis has a separate CONFIG, which is 3 after reset and stores bits 0 and 1 (BANK-WIN-02,
    BANK-GEN-04).
    """
    env = await Env.start(dut)
    for axis in env.axes:
        env.check("BANK-GEN-04", "CONFIG after reset", await axis.host.read(CONFIG), 3)
        await axis.host.write(CONFIG, 0xFC | axis.n & 3)
    for axis in reversed(env.axes):
        env.check("BANK-WIN-02", f"CONFIG of {axis.n}", await axis.host.read(CONFIG), axis.n & 3)
        await axis.host.write(POSITION + axis.n % 4, 0xA5)
        env.check("BANK-WIN-02", f"position of {axis.n}", await axis.position(), 0)
        env.check("BANK-WIN-02", "data", await axis.host.read(DATA), 0)


@directed("BANK-WIN-03", builds=(B8, B4, B32, B64))
async def bank_win_03_registers_of_the_bank(dut):
    """Byte k of MASK, map and INFO is at k = a[6:4]; a write does not change a read-only register
    (BANK-WIN-03).
    """
    env = await Env.start(dut)
    count = max(1, env.size // 8)
    for k in range(count):
        await env.host.write(k << 4 | MASK, 0xA5 ^ 0x11 * k)
    for axis in range(env.size):
        k = axis % 8
        # Absent axes have no bit.
        want = (0xA5 ^ 0x11 * k) & (1 << min(8, env.size)) - 1 if k < count else 0
        env.check("BANK-WIN-03", f"MASK at {axis}", await env.host.read(axis << 4 | MASK), want)
        for register, byte in ((GO, 0), (STOP, 0), (MAP, 0)):
            env.check("BANK-WIN-03", f"{register} at {axis}", await env.host.read(axis << 4 | register), byte)
    await env.host.write(MAP, 0xFF)
    await env.host.write(INFO, 0xFF)
    env.check("BANK-WIN-03", "map, INFO", [await env.host.read(r) for r in (MAP, INFO)], [0, 0x42])
    env.check("BANK-WIN-03", "int_n", env.bench.level("int_n"), 1)


@directed("BANK-WIN-04", "BANK-HSK-04", builds=(B8, F100), exact="a strobe must be sampled for 1 or 2 cycles")
async def bank_win_04_short_reads(dut):
    """During read strobes of 1 and 2 cycles, d_o keeps the byte of the previous read, and no byte is
    consumed (BANK-WIN-04).
    """
    env = await Env.start(dut)
    axis = await env.ready(2)
    await axis.command(0x83)
    before = env.bench.level("d_o")
    for length in (1, 2, 1, 2, 2):
        await axis.host.read(DATA, strobe=length, gap=6)
        env.check("BANK-WIN-04", "d_o", env.bench.level("d_o"), before)
    await axis.host.read(CONFIG)
    for _ in range(3):
        env.check("BANK-WIN-04", "OBF", await axis.status() & OBF, OBF)
        await axis.host.read(DATA)
    env.check("BANK-WIN-04", "OBF", await axis.status() & OBF, 0)


@directed("BANK-WIN-04", "BANK-WIN-06", builds=(B8, B32), exact="a level of one cycle may not be sampled")
async def bank_win_04_irregular_strobes(dut):
    """Bytes of 1-cycle writes, of accesses with both strobes asserted and of strobes without cs_n are either
    written completely or not at all (BANK-WIN-04).
    """
    env = await Env.start(dut)
    host, bench = env.host, env.bench
    for byte in (1, 2, 0, 3):
        await host.write(CONFIG, byte, strobe=1)
        env.check("BANK-WIN-04", "CONFIG", await host.read(CONFIG), byte)
    for levels in ({"wr_n": 0}, {"rd_n": 0}, {"cs_n": 0}, {"cs_n": 0, "rd_n": 0, "wr_n": 0}):
        bench.set(a=CONFIG, d_i=0)
        await bench.clocks(1)
        await host.raw(8, **levels)
        await host.raw(4, cs_n=1, rd_n=1, wr_n=1)
        env.check("BANK-WIN-04", f"CONFIG after {levels}", await host.read(CONFIG), 3)


@directed("BANK-WIN-05", builds=(B8, B32, F100))
async def bank_win_05_read_to_the_clk(dut):
    """In a read, d_oe = 1 from edge 2 and d_o is valid from edge 4. On edge 2 after the strobe, d_oe becomes
    0 and d_o does not change (BANK-WIN-05).
    """
    env = await Env.start(dut)
    bench = env.bench
    for length in (6, 9):
        for register in (INFO, MAP):
            await bench.clocks(20)
            driven = bench.now + env.host.lead
            value = await env.host.read(register, strobe=length)
            await bench.clocks(20)
            start, end = (
                of(bench.pin_edges(pin, level, driven)[0] for pin in ("cs_n", "rd_n"))
                for level, of in ((0, max), (1, min))
            )
            want = [(start + 2, 1), (end + 2, 0)]
            env.check("BANK-WIN-05", "d_oe", bench.edges("d_oe", start), want)
            env.check("BANK-WIN-05", "d_o", bench.edges("d_o", start), [(start + 4, value)])


@directed(
    "BANK-WIN-05", "BANK-HSK-04", builds=(B8, B32, F100), exact="a register must be read in a given cycle"
)
async def bank_win_05_snapshot(dut):
    """A read returns the state after its edge 2 (BANK-WIN-05).

    The test reads at V - 1, V and V + 1, where visit V accepts an operation.
    """
    env = await Env.start(dut)
    for axis in {env.axes[0], env.axes[env.size - 1]}:
        await axis.init(*INIT_A)
        for offset, want in ((-1, IBF), (0, BUSY), (1, BUSY)):
            visit = axis.visit(env.bench.now + 40)
            await env.write_at(visit - 7, axis.n << 4 | STATUS, 0x42)
            axis.since = visit
            got = await env.as_of(visit + offset, axis.n << 4 | STATUS)
            env.check("BANK-WIN-05", f"status after V {offset:+}", got, want)
            await axis.idle()


@directed("BANK-WIN-06", "BANK-HSK-01", builds=(B8, F100), exact="the data change with the end of the strobe")
async def bank_win_06_last_sample(dut):
    """If d_i changes during the strobe, the value of the last sample with the strobe is written. The write
    event is on edge 2 after the first edge that samples the strobe inactive (BANK-WIN-06).
    """
    env = await Env.start(dut)
    bench = env.bench
    bench.set(a=CONFIG)
    await bench.clocks(1)
    for byte in (0, 3, 1):
        bench.set(cs_n=0, wr_n=0, d_i=byte)
        await bench.clocks(1)
    bench.set(cs_n=1, wr_n=1, d_i=2)
    await bench.clocks(8)
    env.check("BANK-WIN-06", "CONFIG", await env.host.read(CONFIG), 1)
    axis = await env.ready(3)
    edge0 = await axis.host.write(STATUS, 0x42)
    await bench.level_is("hold[3]", 0)
    env.check("BANK-HSK-01", "visit", bench.falls("hold[3]", edge0), [axis.visit(edge0 + 2 + 7)])


@directed("BANK-WIN-05", "BANK-WIN-06", "BANK-WIN-04", builds=(B8,))
async def bank_win_05_reset_in_an_access(dut):
    """A reset 1 to 7 cycles after the start of an access sets d_oe = 0 immediately, and the access has no
    effect (BANK-WIN-05, BANK-WIN-06).
    """
    env = await Env.start(dut)
    bench = env.bench
    for strobe, into in product(("rd_n", "wr_n"), range(1, 8)):
        bench.set(a=CONFIG, d_i=0, cs_n=0, **{strobe: 0})
        await bench.clocks(into)
        bench.set(rst_n=0)
        await bench.clocks(1)
        env.check("BANK-WIN-05", f"d_oe, {strobe} since {into} cycles", bench.level("d_oe"), 0)
        await bench.clocks(3)
        bench.set(cs_n=1, **{strobe: 1})
        await env.reset()
        env.check("BANK-WIN-06", f"CONFIG, {strobe} since {into} cycles", await env.host.read(CONFIG), 3)


@directed("BANK-WIN-07", builds=(B8, F100))
async def bank_win_07_position_counts(dut):
    """The position counts each pulse in both directions, also in POUT mode and below zero (BANK-WIN-07)."""
    env = await Env.start(dut)
    axis = await env.ready(5)
    want = 0
    for code, n in ((0x43, 14), (0x4B, 20), (0xC3, 3), (0xCB, 5), (0x4A, 1), (0x44, 300)):
        await axis.move(code, n, 0 if code == 0x44 else None)
        want += -n if code & 8 else n
        env.check("BANK-WIN-07", f"position after {code:02X}", await axis.position(), want)
        env.check("BANK-WIN-07", "that of another one", await env.axes[4].position(), 0)
    await env.reset()
    env.check("BANK-WIN-07", "position after reset", await axis.position(), 0)


@directed("BANK-WIN-07", builds=(B8, F100, B32), exact="a register must be read in a given cycle")
async def bank_win_07_counted_at_the_visit(dut):
    """The position register includes a pulse on edge e from the last visit at or before e on (BANK-WIN-07).

    The test reads the position one cycle before this visit, at this visit and one cycle after it.
    """
    env = await Env.start(dut)
    axis = await env.ready(env.size - 2)
    for number, offset in enumerate((-1, 0, 1)):
        # Each interval is 30 quanta longer, so that it is not a multiple of R at 100 MHz.
        await axis.set_config(1, 0)
        edge0 = await axis.go(0x44, 3, 20, poll=False)
        second = axis.accepting_visit(edge0) + env.cfg.w + env.cfg.quanta(21 * 8 + 30)
        ordered = axis.visit(second - env.round + 1)
        got = await env.as_of(ordered + offset, axis.n << 4 | POSITION)
        env.check("BANK-WIN-07", f"position at V {offset:+}", got, 3 * number + 1 + (offset >= 0))
        await axis.idle()
        env.check("BANK-MOT-01", "second pulse", axis.pulses[1], second)


@directed("BANK-WIN-07", "BANK-WIN-01", builds=(B8, B32))
async def bank_win_07_kept_bytes(dut):
    """A read of byte 0 latches bytes 1 to 3 for reads at any axis, until byte 0 is read again. A read
    of byte 0 of an absent axis latches nothing (BANK-WIN-07, BANK-WIN-01).
    """
    env = await Env.start(dut)
    one, other = await env.all_ready(1, 6)
    await one.move(0x4A)
    got = [await one.host.read(POSITION)]
    env.check("BANK-WIN-01", "no axis", await env.host.read((env.size + other.n) << 4 | POSITION), 0xFF)
    await one.move(0x44, 3, 0)
    got += [await other.host.read(POSITION + n) for n in (1, 2, 3)]
    env.check("BANK-WIN-07", "bytes", got, [0xFF] * 4)
    env.check("BANK-WIN-07", "position", await other.position(), 0)
    env.check("BANK-WIN-07", "kept of the other", await one.host.read(POSITION + 3), 0)
    env.check("BANK-WIN-07", "position", await one.position(), 2)


@directed("BANK-WIN-08", builds=(B4, B8, B32, B64))
async def bank_win_08_interrupts(dut):
    """The map has one bit per axis, which is set by an end with an interrupt; int_n is low while any bit is
    set (BANK-WIN-08).
    """
    env = await Env.start(dut)
    numbers = {0, 1, env.size // 2, env.size - 1}
    axes = await env.all_ready(*sorted(numbers))
    for axis in axes:
        await axis.move(0x52 if axis.n == 1 else 0x42)  # bit I = 1: the end causes no interrupt
    pending = sum(1 << n for n in numbers if n != 1)
    for axis in axes:
        env.check("BANK-WIN-08", "map", await env.map(), pending)
        env.check("BANK-WIN-08", "int_n", env.bench.level("int_n"), not pending)
        await axis.finish()
        pending &= ~(1 << axis.n)
    env.check("BANK-WIN-08", "map", await env.map(), 0)
    env.check("BANK-WIN-08", "int_n", env.bench.level("int_n"), 1)


@directed(
    "BANK-WIN-05",
    "BANK-WIN-08",
    builds=(B4, B8, B16, B32, B64),
    exact="a register must be read in a given cycle",
)
async def bank_win_08_map_to_the_cycle(dut):
    """A read of the map returns each bit as it is after edge 2 of the read. This holds at each address of the
    byte, and for each distance between the read and a visit that sets or clears bits (BANK-WIN-05,
    BANK-WIN-08).
    """
    env = await Env.start(dut)
    await env.all_ready()
    for k in range(max(1, env.size // 8)):
        axes = env.axes[8 * k : 8 * k + 8]
        await env.mask(*(axis.n for axis in axes))
        # Axis a is visited one cycle after axis a - 1. Therefore it is sufficient to read the byte at the
        # axes next to those whose bits it contains.
        for at in [n for n in range(k, env.size, 8) if env.size < 32 or -8 <= n - 8 * k <= 16]:
            for step in range(len(axes) + 6):
                await _map_near_visits(env, axes, at << 4 | MAP, step)


async def _map_near_visits(env: Env, axes: list[Axis], address: int, step: int) -> None:
    """Read the map `step` - 3 cycles after the first visit that sets a bit, then near each visit that clears
    a bit.
    """
    for axis in axes:
        await axis.command(0x42)
    g = await env.go()
    ends = [axis.visit(g + 4 + env.round + 2 * env.cfg.w + 1) for axis in axes]
    edge = min(ends) + step - 3
    want = sum(1 << axis.n % 8 for axis, end in zip(axes, ends, strict=True) if end <= edge)
    got = await env.as_of(edge, address)
    env.check("BANK-WIN-08", f"map at {address:03X}, {step - 3} after the first end", got, want)
    await env.bench.clocks(env.round)
    left = (1 << len(axes)) - 1
    for axis in axes:
        visit, offset = axis.visit(env.bench.now + 16), step % 7 - 3
        await env.write_at(visit - 7, axis.n << 4 | STATUS, 0x80)
        before, left = left, left & ~(1 << axis.n % 8)
        got = await env.as_of(visit + offset, address)
        what = f"map at {address:03X}, {offset} after axis {axis.n} was read"
        env.check("BANK-WIN-08", what, got, before if offset < 0 else left)


@directed("BANK-GEN-05", builds=(B8, B4, B32, B64), exact="a register must be read in a given cycle")
async def bank_gen_05_not_ready(dut):
    """From a reset until edge R + 7, status reads as 02, all other registers read as 00, and writes have no
    effect (BANK-GEN-05).
    """
    env = await Env.start(dut)
    env.check("BANK-GEN-05", "outputs", env.axes[0].outputs(), _resting(env))
    for register, busy, ready in ((STATUS, 2, 0), (CONFIG, 0, 3), (INFO, 0, 0x42), (MASK, 0, 0)):
        for offset in (-1, 0, 1):
            released = await env.bench.reset(settle=0)
            got = await env.as_of(released + env.round + 7 + offset, register)
            want = busy if offset < 0 else ready
            env.check("BANK-GEN-05", f"register {register} after R + 7 {offset:+}", got, want)
    for offset, want in ((0, 0), (1, 0x5A)):
        released = await env.bench.reset(settle=0)
        await env.write_at(released + env.round + 7 + offset, MASK, 0x5A)
        env.check("BANK-GEN-05", "MASK", await env.host.read(MASK), want & (1 << env.size) - 1)


@directed("BANK-GEN-05", builds=(B8, B32, B64))
async def bank_gen_05_reset_in_motion(dut):
    """A reset during motions of all axes sets all pins to their reset levels immediately and clears the
    bank (BANK-GEN-05).
    """
    env = await Env.start(dut)
    for init in (INIT_A, (0x29, 20, 0, 30)):
        await env.all_ready(init=init)
        for axis in env.axes:
            await axis.go(0x45 | axis.n % 2 << 3, rate=axis.n % 4)
        await env.axes[0].set_config(0, 0)
        await env.mask(*range(env.size))
        await env.bench.clocks(1_000 + 7 * env.size)
        await env.bench.set_between(rst_n=0)
        env.check("BANK-GEN-05", "outputs in reset", env.axes[0].outputs(), _resting(env))
        await env.bench.clocks(3)
        env.bench.set(rst_n=1)
        for axis in env.axes:
            axis.released = env.bench.now
        await env.bench.clocks(env.round + 8)
        for axis in env.axes:
            env.check("BANK-GEN-05", f"status of {axis.n}", await axis.status(), 0)
            env.check("BANK-WIN-07", f"position of {axis.n}", await axis.position(), 0)
            await axis.refused("BANK-GEN-05", "an operation", 2, 0x42)
        env.check("BANK-GEN-05", "CONFIG, MASK", [await env.host.read(r) for r in (CONFIG, MASK)], [3, 0])


def _resting(env: Env) -> dict[str, int]:
    levels = env.bench.part.reset_levels(env.bench.part.params(env.cfg))
    return {name: level for name, level in levels.items() if name not in ("d_o", "d_oe")}
