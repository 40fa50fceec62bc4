"""Computed tables of docs/ppmc312/README.md: tables of settings, shapes of moves, times."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import groupby

from cocotb_tests.harness.bus import CSR
from cocotb_tests.harness.config import D16, F16, F50, Config
from cocotb_tests.harness.model_bench import OnModel, on_model
from cocotb_tests.ppmc312.blocks import T1, T2, T3
from cocotb_tests.ppmc312.host import Host
from openppmc.model.ppmc312.stages import Step, Table, build, constant, curve, ramped

F_HZ = 1_000_000
HEAD, TAIL = 6, 6
LINEAR = build(1000, 0, 200, 2000, 0, separate=False)
SEPARATE = build(1000, 500, 200, 2000, 1500)
MIRROR = build(500, 1000, 200, 1500, 2000)
SETTINGS = (
    ("T1", "linear, RS 1000, RH 200, NA 2000", LINEAR),
    ("T2", "the same, sigmoid", build(1000, 0, 200, 2000, 0, sigmoid=True, separate=False)),
    ("T3", "linear, RS 1000, RP 500, RH 200, NA 2000, ND 1500", SEPARATE),
    ("T5", "sigmoid, RS 8192, RH 64, NA 60 000",
     build(8192, 0, 64, 60_000, 0, sigmoid=True, separate=False)),
)  # fmt: skip
TF = curve([100, 200, 400], [5, 4, 3])
TG = curve([100, 200, 400], [5, 4, 3], [6, 4])
TH = curve([100, 200, 400], [6, 4], [5, 4, 3])
MOVES = (
    ("TF, 82, N = 30", ramped(TF, 100, 30)),
    ("TF, 82, N = 24", ramped(TF, 100, 24)),
    ("TF, 82, N = 23", ramped(TF, 100, 23)),
    ("TF, 82, N = 7", ramped(TF, 100, 7)),
    ("TF, 82, N = 2", ramped(TF, 100, 2)),
    ("TF, 82, rate 150, N = 20", ramped(TF, 150, 20)),
    ("TF, 82, rate 300, N = 10", ramped(TF, 300, 10)),
    ("TF, 83, rate 200, N = 5", constant(TF, 200, 5)),
    ("TG (down 6 4), N = 30", ramped(TG, 100, 30)),
    ("TG, N = 3", ramped(TG, 100, 3)),
    ("TH (up 6 4), N = 2", ramped(TH, 100, 2)),
    ("T1, N = 5000", ramped(LINEAR, 200, 5000)),
    ("T1, N = 101", ramped(LINEAR, 200, 101)),
    ("T3, N = 3000", ramped(SEPARATE, 200, 3000)),
    ("T4, N = 700", ramped(MIRROR, 200, 700)),
)


def _ends(values: Sequence[int]) -> str:
    return f"{' '.join(map(str, values[:HEAD]))} … {' '.join(map(str, values[-TAIL:]))}"


def _side(table: Table) -> str:
    first = "" if table.sa == 0 else f" from stage {table.sa}"
    text = _ends(table.pa[table.sa :]) + first
    if table.separate:
        text += f"; down {_ends(table.pd[table.sd :])} from stage {table.sd}, rate {table.rates[table.sd]}"
    return text


def table_table() -> str:
    """Return a table of settings with rates and pulses of the first and last stages."""
    lines = ["| | Setting | Rates R[0] … R[126] | Pulses of the stages |", "|---|---|---|---|"]
    lines += [f"| {name} | {text} | {_ends(of.rates)} | {_side(of)} |" for name, text, of in SETTINGS]
    return "\n".join(lines)


def _runs(steps: Sequence[Step]) -> str:
    """Return pulses as rate×count; the middle of a long list is omitted."""
    groups = [(rate, len(list(group))) for rate, group in groupby(step.rate for step in steps)]
    words = [f"{rate}×{count}" for rate, count in groups]
    return " ".join(words if len(words) <= 8 else [*words[:4], "…", *words[-3:]])


def moves_table() -> str:
    """Return a table of moves with shape, pulses, and the time from pulse 1 to the end."""
    lines = ["| Move | Answer | Up, constant, down | Rate × pulses | Ticks |", "|---|---|---|---|---|"]
    for text, plan in MOVES:
        steps = plan.steps()
        parts = f"{plan.up}, {len(steps) - plan.up - plan.down}, {plan.down}"
        ticks = sum(step.rate for step in steps)
        lines.append(f"| {text} | {plan.kind:02X} | {parts} | {_runs(steps)} | {ticks} |")
    return "\n".join(lines)


T3_SIGMOID = "03 0E 00 19 03E8 01F4 00C8 0007D0 0005DC"
SETUPS = (
    ("00 linear, LE = 0, to the answer", T1),
    ("00 linear, LE = 1", T3),
    ("00 sigmoid, LE = 0", T2),
    ("00 sigmoid, LE = 1", T3_SIGMOID),
)
STARTS = (
    ("82 trapezoid, high speed, to pulse 1", "03 08 82 00 0000 00001388"),
    ("82 other shapes, high speed", "03 08 82 00 0000 00000065"),
    ("82 trapezoid, with a rate", "03 08 82 00 01F4 00001388"),
    ("82 other shapes, with a rate", "03 08 82 00 01F4 00000065"),
    ("83, 86", "03 08 83 00 01F4 00000064"),
    ("85, 11, high speed", "03 04 85 00 0000"),
    ("85, 11, with a rate", "03 04 85 00 01F4"),
    ("10, 84", "03 02 84 00"),
)


MODES: tuple[tuple[str, Config], ...] = (("FAST, 16 MHz", F16), ("FAST, 50 MHz", F50), ("DATASHEET", D16))


def _us(clk: int, mode: Config) -> str:
    """Return a time in a suitable unit."""
    us = clk * 1e6 / mode.clk_hz
    return f"{us / 1000:.3g} ms" if us >= 999 else f"{us:.3g} µs"


async def _set_up(mode: Config, block: str) -> int:
    """Return the cycles from the header to the answer."""
    host = await Host.start(OnModel(mode))
    await host.write(CSR, 0x10)
    await host.issue(block)
    await host.response()
    return host.bench.falls("irq_n", host.header)[0] - host.header


async def _start(mode: Config, block: str) -> int:
    """Return the cycles from the header to pulse 1."""
    host = await Host.start(OnModel(mode), T1)
    await host.issue(block)
    return await host.pulse(1) - host.header


async def _ready(mode: Config, _: str) -> int:
    """Return the cycles from the release of rst_n to out_oe."""
    host = await Host.start(OnModel(mode))
    return host.bench.rises("out_oe")[0]


async def _stop(mode: Config, block: str) -> int:
    """Return the cycles from the header to the answer at a constant rate; no pulse begins after it."""
    host = await Host.start(OnModel(mode), T1, "03 04 86 00 03E8")
    await host.write(CSR, 0x10)
    await host.pulse(2)
    await host.issue(block)
    await host.response()
    return host.bench.falls("irq_n", host.header)[0] - host.header


async def _output(mode: Config, block: str) -> int:
    """Return the cycles from the header to the auxiliary output."""
    host = await Host.start(OnModel(mode))
    await host.issue(block)
    await host.wait()
    return host.bench.edges("auxo_n")[0][0] - host.header


TIMES = (
    (SETUPS, _set_up),
    (STARTS, _start),
    ((("80 to the answer; no pulse begins after it", "03 02 80 00"),), _stop),
    ((("26 to the pins", "03 02 26 01"),), _output),
    ((("`rst_n` to `out_oe`", ""),), _ready),
)


def times_table() -> str:
    """Return a table of instructions with their times in this core, FAST and DATASHEET."""
    lines = [f"| Event | {' | '.join(name for name, _ in MODES)} |", "|---|---|---|---|"]
    for rows, measure in TIMES:
        for text, block in rows:
            times = [_us(on_model(measure(mode, block)), mode) for _, mode in MODES]
            lines.append(f"| {text} | {' | '.join(times)} |")
    return "\n".join(lines)
