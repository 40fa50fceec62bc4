"""Window: registers, strobes, positions, interrupt map (BANK-WIN), and the bank before it is ready
(BANK-GEN-05).
"""

from __future__ import annotations

from itertools import product

from cocotb_tests.harness import BUSY, IBF, OBF, directed

from .bench import B4, B8, B16, B32, B64, F100
from .env import CONFIG, DATA, GO, INFO, INIT_A, MAP, MASK, POSITION, STATUS, STOP, Axis, Lab

NOWHERE = (0x3, 0xD, 0xE, 0xF)
REGISTERS = range(16)


@directed("BANK-WIN-03", builds=(B8, B32, B64, B4, F100))
async def bank_win_03_info(dut):
    """INFO returns the window and AXES at each axis with the same a[6:4] (BANK-WIN-03)."""
    lab = await Lab.start(dut)
    for axis in range(lab.size):
        want = (0x42, 1, lab.size, 0, 0, 0, 0, 0)[axis % 8]
        lab.check("BANK-WIN-03", f"INFO at axis {axis}", await lab.host.read(axis << 4 | INFO), want)
    axis = await lab.ready(lab.size - 1)
    lab.check("BANK-MOT-01", "pulses of the last axis", len(await axis.move(0x43, 14)), 14)


@directed("BANK-WIN-01", builds=(B4, B8, B32))
async def bank_win_01_addresses(dut):
    """Axes and registers that do not exist read as FF, and writes to them have no effect (BANK-WIN-01)."""
    lab = await Lab.start(dut)
    for axis in {lab.size, lab.size + 1, 2 * lab.size - 1, 63}:
        for register in REGISTERS:
            got = await lab.host.read(axis << 4 | register)
            lab.check("BANK-WIN-01", f"axis {axis}, register {register}", got, 0xFF)
        await lab.host.write(axis << 4 | MASK, 0xFF)
        await lab.host.write(axis << 4 | CONFIG, 0)
        for register, byte in ((1, 0x0A), (0, 9), (0, 4), (0, 4), (0, 0), (1, 0x42)):
            await lab.host.write(axis << 4 | register, byte)
            await lab.bench.clocks(2 * lab.round)
        await lab.host.write(axis << 4 | GO, 0)
        await lab.host.write(axis << 4 | STOP, 0)
    for axis in (0, lab.size - 1):
        for register in NOWHERE:
            await lab.host.write(axis << 4 | register, 0)
            got = await lab.host.read(axis << 4 | register)
            lab.check("BANK-WIN-01", f"register {register}", got, 0xFF)
        for register, want in ((MASK, 0), (CONFIG, 3), (STATUS, 0)):
            got = await lab.host.read(axis << 4 | register)
            lab.check("BANK-WIN-01", f"axis {axis}, register {register}", got, want)
    await lab.bench.clocks(500)
    lab.check("BANK-WIN-01", "edges of the motors", lab.bench.edges("s") + lab.bench.edges("pout_n"), [])


@directed("BANK-WIN-02", "BANK-GEN-04", builds=(B8, B32))
async def bank_win_02_registers_of_an_axis(dut):
    """Each axis has its own CONFIG: 3 after reset, of which bits 0 and 1 are stored (BANK-WIN-02,
    BANK-GEN-04).
    """
    lab = await Lab.start(dut)
    for axis in lab.axes:
        lab.check("BANK-GEN-04", "CONFIG after reset", await axis.host.read(CONFIG), 3)
        await axis.host.write(CONFIG, 0xFC | axis.n & 3)
    for axis in reversed(lab.axes):
        lab.check("BANK-WIN-02", f"CONFIG of {axis.n}", await axis.host.read(CONFIG), axis.n & 3)
        await axis.host.write(POSITION + axis.n % 4, 0xA5)
        lab.check("BANK-WIN-02", f"position of {axis.n}", await axis.position(), 0)
        lab.check("BANK-WIN-02", "data", await axis.host.read(DATA), 0)


@directed("BANK-WIN-03", builds=(B8, B4, B32, B64))
async def bank_win_03_registers_of_the_bank(dut):
    """Byte k of MASK, map and INFO is at k = a[6:4]; read-only registers keep their values
    (BANK-WIN-03).
    """
    lab = await Lab.start(dut)
    count = max(1, lab.size // 8)
    for k in range(count):
        await lab.host.write(k << 4 | MASK, 0xA5 ^ 0x11 * k)
    for axis in range(lab.size):
        k = axis % 8
        # Absent axes have no bit.
        want = (0xA5 ^ 0x11 * k) & (1 << min(8, lab.size)) - 1 if k < count else 0
        lab.check("BANK-WIN-03", f"MASK at {axis}", await lab.host.read(axis << 4 | MASK), want)
        for register, byte in ((GO, 0), (STOP, 0), (MAP, 0)):
            lab.check("BANK-WIN-03", f"{register} at {axis}", await lab.host.read(axis << 4 | register), byte)
    await lab.host.write(MAP, 0xFF)
    await lab.host.write(INFO, 0xFF)
    lab.check("BANK-WIN-03", "map, INFO", [await lab.host.read(r) for r in (MAP, INFO)], [0, 0x42])
    lab.check("BANK-WIN-03", "int_n", lab.bench.level("int_n"), 1)


@directed("BANK-WIN-04", "BANK-HSK-04", builds=(B8, F100))
async def bank_win_04_short_reads(dut):
    """During read strobes of 1 and 2 cycles, d_o keeps the byte of the previous read, and no byte is
    consumed (BANK-WIN-04).
    """
    lab = await Lab.start(dut)
    axis = await lab.ready(2)
    await axis.command(0x83)
    before = lab.bench.level("d_o")
    for length in (1, 2, 1, 2, 2):
        await axis.host.read(DATA, strobe=length, gap=6)
        lab.check("BANK-WIN-04", "d_o", lab.bench.level("d_o"), before)
    await axis.host.read(CONFIG)
    for _ in range(3):
        lab.check("BANK-WIN-04", "OBF", await axis.status() & OBF, OBF)
        await axis.host.read(DATA)
    lab.check("BANK-WIN-04", "OBF", await axis.status() & OBF, 0)


@directed("BANK-WIN-04", "BANK-WIN-06", builds=(B8, B32))
async def bank_win_04_strange_strobes(dut):
    """Bytes of 1-cycle writes, of both strobes together and of strobes without cs_n are written
    completely or not at all (BANK-WIN-04).
    """
    lab = await Lab.start(dut)
    host, bench = lab.host, lab.bench
    for byte in (1, 2, 0, 3):
        await host.write(CONFIG, byte, strobe=1)
        lab.check("BANK-WIN-04", "CONFIG", await host.read(CONFIG), byte)
    for levels in ({"wr_n": 0}, {"rd_n": 0}, {"cs_n": 0}, {"cs_n": 0, "rd_n": 0, "wr_n": 0}):
        bench.set(a=CONFIG, d_i=0)
        await bench.clocks(1)
        await host.raw(8, **levels)
        await host.raw(4, cs_n=1, rd_n=1, wr_n=1)
        lab.check("BANK-WIN-04", f"CONFIG after {levels}", await host.read(CONFIG), 3)


@directed("BANK-WIN-05", builds=(B8, B32, F100))
async def bank_win_05_read_to_the_clk(dut):
    """In a read, d_oe = 1 from edge 2 and d_o is valid from edge 4; d_oe = 0 on edge 2 after the
    strobe, and d_o does not change (BANK-WIN-05).
    """
    lab = await Lab.start(dut)
    bench = lab.bench
    for length in (6, 9):
        for register in (INFO, MAP):
            await bench.clocks(20)
            start = bench.now + 1
            value = await lab.host.read(register, strobe=length)
            await bench.clocks(20)
            want = [(start + 2, 1), (start + length + 2, 0)]
            lab.check("BANK-WIN-05", "d_oe", bench.edges("d_oe", start), want)
            lab.check("BANK-WIN-05", "d_o", bench.edges("d_o", start), [(start + 4, value)])


@directed("BANK-WIN-05", "BANK-HSK-04", builds=(B8, B32, F100))
async def bank_win_05_snapshot(dut):
    """A read returns the state after its edge 2: tried around the visit V that accepts an operation, at
    V - 1, V and V + 1 (BANK-WIN-05).
    """
    lab = await Lab.start(dut)
    for axis in {lab.axes[0], lab.axes[lab.size - 1]}:
        await axis.init(*INIT_A)
        for offset, want in ((-1, IBF), (0, BUSY), (1, BUSY)):
            visit = axis.visit(lab.bench.now + 40)
            await lab.write_at(visit - 7, axis.n << 4 | STATUS, 0x42)
            axis.since = visit
            got = await lab.as_of(visit + offset, axis.n << 4 | STATUS)
            lab.check("BANK-WIN-05", f"status after V {offset:+}", got, want)
            await axis.idle()


@directed("BANK-WIN-06", "BANK-HSK-01", builds=(B8, F100))
async def bank_win_06_last_sample(dut):
    """If d_i changes during the strobe, the last sample is written, with the write event on edge 2
    (BANK-WIN-06).
    """
    lab = await Lab.start(dut)
    bench = lab.bench
    bench.set(a=CONFIG)
    await bench.clocks(1)
    for byte in (0, 3, 1):
        bench.set(cs_n=0, wr_n=0, d_i=byte)
        await bench.clocks(1)
    bench.set(cs_n=1, wr_n=1, d_i=2)
    await bench.clocks(8)
    lab.check("BANK-WIN-06", "CONFIG", await lab.host.read(CONFIG), 1)
    axis = await lab.ready(3)
    edge0 = await axis.host.write(STATUS, 0x42)
    await bench.level_is("hold[3]", 0)
    lab.check("BANK-HSK-01", "visit", bench.falls("hold[3]", edge0), [axis.visit(edge0 + 2 + 7)])


@directed("BANK-WIN-05", "BANK-WIN-06", "BANK-WIN-04", builds=(B8,))
async def bank_win_05_reset_in_an_access(dut):
    """A reset 1 to 7 cycles after the begin of an access sets d_oe = 0 immediately, and the access has
    no effect (BANK-WIN-05, BANK-WIN-06).
    """
    lab = await Lab.start(dut)
    bench = lab.bench
    for strobe, into in product(("rd_n", "wr_n"), range(1, 8)):
        bench.set(a=CONFIG, d_i=0, cs_n=0, **{strobe: 0})
        await bench.clocks(into)
        bench.set(rst_n=0)
        await bench.clocks(1)
        lab.check("BANK-WIN-05", f"d_oe, {strobe} since {into} clk", bench.level("d_oe"), 0)
        await bench.clocks(3)
        bench.set(cs_n=1, **{strobe: 1})
        await lab.reset()
        lab.check("BANK-WIN-06", f"CONFIG, {strobe} since {into} clk", await lab.host.read(CONFIG), 3)


@directed("BANK-WIN-07", builds=(B8, F100))
async def bank_win_07_position_counts(dut):
    """The position counts each pulse in both directions, also in POUT mode and below zero (BANK-WIN-07)."""
    lab = await Lab.start(dut)
    axis = await lab.ready(5)
    want = 0
    for code, n in ((0x43, 14), (0x4B, 20), (0xC3, 3), (0xCB, 5), (0x4A, 1), (0x44, 300)):
        await axis.move(code, n, 0 if code == 0x44 else None)
        want += -n if code & 8 else n
        lab.check("BANK-WIN-07", f"position after {code:02X}", await axis.position(), want)
        lab.check("BANK-WIN-07", "that of another one", await lab.axes[4].position(), 0)
    await lab.reset()
    lab.check("BANK-WIN-07", "position after reset", await axis.position(), 0)


@directed("BANK-WIN-07", builds=(B8, F100, B32))
async def bank_win_07_counted_at_the_visit(dut):
    """A pulse on edge e is counted at the last visit at or before e: read at this visit -1, 0, +1
    cycles (BANK-WIN-07).
    """
    lab = await Lab.start(dut)
    axis = await lab.ready(lab.size - 2)
    for number, offset in enumerate((-1, 0, 1)):
        await axis.set_config(1, 0)  # 30 quanta more: not a multiple of R at 100 MHz
        edge0 = await axis.go(0x44, 3, 20, poll=False)
        second = axis.taken(edge0) + lab.cfg.w + lab.cfg.quanta(21 * 8 + 30)
        ordered = axis.visit(second - lab.round + 1)
        got = await lab.as_of(ordered + offset, axis.n << 4 | POSITION)
        lab.check("BANK-WIN-07", f"position at V {offset:+}", got, 3 * number + 1 + (offset >= 0))
        await axis.idle()
        lab.check("BANK-MOT-01", "second pulse", axis.pulses[1], second)


@directed("BANK-WIN-07", "BANK-WIN-01", builds=(B8, B32))
async def bank_win_07_kept_bytes(dut):
    """A read of byte 0 latches bytes 1 to 3 for reads at any axis, until byte 0 is read again. A read
    of byte 0 of an absent axis latches nothing (BANK-WIN-07, BANK-WIN-01).
    """
    lab = await Lab.start(dut)
    one, other = await lab.all_ready(1, 6)
    await one.move(0x4A)
    got = [await one.host.read(POSITION)]
    lab.check("BANK-WIN-01", "no axis", await lab.host.read((lab.size + other.n) << 4 | POSITION), 0xFF)
    await one.move(0x44, 3, 0)
    got += [await other.host.read(POSITION + n) for n in (1, 2, 3)]
    lab.check("BANK-WIN-07", "bytes", got, [0xFF] * 4)
    lab.check("BANK-WIN-07", "position", await other.position(), 0)
    lab.check("BANK-WIN-07", "kept of the other", await one.host.read(POSITION + 3), 0)
    lab.check("BANK-WIN-07", "position", await one.position(), 2)


@directed("BANK-WIN-08", builds=(B4, B8, B32, B64))
async def bank_win_08_interrupts(dut):
    """The map has one bit per axis, set by ends with an interrupt; int_n is low while any bit is set
    (BANK-WIN-08).
    """
    lab = await Lab.start(dut)
    numbers = {0, 1, lab.size // 2, lab.size - 1}
    axes = await lab.all_ready(*sorted(numbers))
    for axis in axes:
        await axis.move(0x52 if axis.n == 1 else 0x42)  # I = 1: the end causes no interrupt
    pending = sum(1 << n for n in numbers if n != 1)
    for axis in axes:
        lab.check("BANK-WIN-08", "map", await lab.map(), pending)
        lab.check("BANK-WIN-08", "int_n", lab.bench.level("int_n"), not pending)
        await axis.finish()
        pending &= ~(1 << axis.n)
    lab.check("BANK-WIN-08", "map", await lab.map(), 0)
    lab.check("BANK-WIN-08", "int_n", lab.bench.level("int_n"), 1)


@directed("BANK-WIN-05", "BANK-WIN-08", builds=(B4, B8, B16, B32, B64))
async def bank_win_08_map_to_the_cycle(dut):
    """A read of the map returns each bit as it is after edge 2 of the read. This holds for each phase
    between the read and the visits that set or clear bits, and at each address of the byte
    (BANK-WIN-05, BANK-WIN-08).
    """
    lab = await Lab.start(dut)
    await lab.all_ready()
    for k in range(max(1, lab.size // 8)):
        axes = lab.axes[8 * k : 8 * k + 8]
        await lab.mask(*(axis.n for axis in axes))
        # Axis a is visited one cycle after axis a - 1, so the addresses next to the byte are sufficient.
        for at in [n for n in range(k, lab.size, 8) if lab.size < 32 or -8 <= n - 8 * k <= 16]:
            for step in range(len(axes) + 6):
                await _map_near_visits(lab, axes, at << 4 | MAP, step)


async def _map_near_visits(lab: Lab, axes: list[Axis], address: int, step: int) -> None:
    """Read the map step - 3 cycles after the first visit that sets a bit, then near each visit that
    clears one.
    """
    for axis in axes:
        await axis.command(0x42)
    g = await lab.go()
    ends = [axis.visit(g + 4 + lab.round + 2 * lab.cfg.w + 1) for axis in axes]
    edge = min(ends) + step - 3
    want = sum(1 << axis.n % 8 for axis, end in zip(axes, ends, strict=True) if end <= edge)
    got = await lab.as_of(edge, address)
    lab.check("BANK-WIN-08", f"map at {address:03X}, {step - 3} after the first end", got, want)
    await lab.bench.clocks(lab.round)
    left = (1 << len(axes)) - 1
    for axis in axes:
        visit, offset = axis.visit(lab.bench.now + 16), step % 7 - 3
        await lab.write_at(visit - 7, axis.n << 4 | STATUS, 0x80)
        before, left = left, left & ~(1 << axis.n % 8)
        got = await lab.as_of(visit + offset, address)
        what = f"map at {address:03X}, {offset} after axis {axis.n} was read"
        lab.check("BANK-WIN-08", what, got, before if offset < 0 else left)


@directed("BANK-GEN-05", builds=(B8, B4, B32, B64))
async def bank_gen_05_not_ready(dut):
    """After a reset, until edge R + 7, status reads as 02 and all else as 00, and writes have no effect
    (BANK-GEN-05).
    """
    lab = await Lab.start(dut)
    lab.check("BANK-GEN-05", "outputs", lab.axes[0].outputs(), _resting(lab))
    for register, busy, ready in ((STATUS, 2, 0), (CONFIG, 0, 3), (INFO, 0, 0x42), (MASK, 0, 0)):
        for offset in (-1, 0, 1):
            released = await lab.bench.reset(settle=0)
            got = await lab.as_of(released + lab.round + 7 + offset, register)
            want = busy if offset < 0 else ready
            lab.check("BANK-GEN-05", f"register {register} after R + 7 {offset:+}", got, want)
    for offset, want in ((0, 0), (1, 0x5A)):
        released = await lab.bench.reset(settle=0)
        await lab.write_at(released + lab.round + 7 + offset, MASK, 0x5A)
        lab.check("BANK-GEN-05", "MASK", await lab.host.read(MASK), want & (1 << lab.size) - 1)


@directed("BANK-GEN-05", builds=(B8, B32, B64))
async def bank_gen_05_reset_in_motion(dut):
    """A reset during motions of all axes sets all pins to their reset levels immediately and clears the
    bank (BANK-GEN-05).
    """
    lab = await Lab.start(dut)
    for init in (INIT_A, (0x29, 20, 0, 30)):
        await lab.all_ready(init=init)
        for axis in lab.axes:
            await axis.go(0x45 | axis.n % 2 << 3, rate=axis.n % 4)
        await lab.axes[0].set_config(0, 0)
        await lab.mask(*range(lab.size))
        await lab.bench.clocks(1_000 + 7 * lab.size)
        await lab.bench.set_between(rst_n=0)
        lab.check("BANK-GEN-05", "outputs in reset", lab.axes[0].outputs(), _resting(lab))
        await lab.bench.clocks(3)
        lab.bench.set(rst_n=1)
        for axis in lab.axes:
            axis.released = lab.bench.now
        await lab.bench.clocks(lab.round + 8)
        for axis in lab.axes:
            lab.check("BANK-GEN-05", f"status of {axis.n}", await axis.status(), 0)
            lab.check("BANK-WIN-07", f"position of {axis.n}", await axis.position(), 0)
            await axis.refused("BANK-GEN-05", "an operation", 2, 0x42)
        lab.check("BANK-GEN-05", "CONFIG, MASK", [await lab.host.read(r) for r in (CONFIG, MASK)], [3, 0])


def _resting(lab: Lab) -> dict[str, int]:
    levels = lab.bench.part.reset_levels(lab.bench.part.params(lab.cfg))
    return {name: level for name, level in levels.items() if name not in ("d_o", "d_oe")}
