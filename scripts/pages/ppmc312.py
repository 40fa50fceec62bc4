"""Kinds of tables and pictures for docs/ppmc312/figures.yml, from the golden model of the PPMC-312."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import accumulate, groupby, pairwise
from typing import Any

import matplotlib.pyplot as plt
from matplotlib.figure import Figure

from cocotb_tests.harness.bus import CSR, DRR, DWR, RAR, WAR, WCR
from cocotb_tests.harness.config import D16, F16, F50, Config
from cocotb_tests.harness.model_bench import OnModel, on_model
from cocotb_tests.ppmc312 import blocks
from cocotb_tests.ppmc312.host import Host
from openppmc.model.ppmc312.stages import LAST, Table, build, constant, curve, ramped
from scripts.markdown import table
from scripts.pages.pictures.moves import Train, speeds
from scripts.pages.pictures.plots import BLUE, COLOURS, GREEN, GREY, RED
from scripts.pages.pictures.recorded import Levels, Row, Schedule, Start, columns_of, record, wave

F_HZ = 1_000_000
CLK = 16  # number of cycles of a tick
ANSWERS = 0x10  # CSR: irq_n reports answers
REGISTERS: dict[object, int] = {"CSR": CSR, "RAR": RAR, "DRR": DRR, "WCR": WCR, "WAR": WAR, "DWR": DWR}
BUILDS = {"F16": F16, "F50": F50, "D16": D16}


def _block(text: str) -> Sequence[str]:
    """Return the blocks of a set-up. The argument is a name in `blocks`, or one block as a text of bytes."""
    found = getattr(blocks, text, text)
    return (found,) if isinstance(found, str) else found


# ------------------------------------------------------------------------------------- tables and moves


def _table(build_or_curve: Mapping[str, Any]) -> Table:
    """Return the ramp table of an entry: `curve` or `build`, with the arguments of this function."""
    if "curve" in build_or_curve:
        return curve(*build_or_curve["curve"])
    rest = {name: value for name, value in build_or_curve.items() if name != "build"}
    return build(*build_or_curve["build"], **rest)


def _ends(values: Sequence[int]) -> str:
    return f"{' '.join(map(str, values[:6]))} … {' '.join(map(str, values[-6:]))}"


def _side(of: Table) -> str:
    first = "" if of.sa == 0 else f" from stage {of.sa}"
    text = _ends(of.pa[of.sa :]) + first
    if of.separate:
        text += f"; down {_ends(of.pd[of.sd :])} from stage {of.sd}, rate {of.rates[of.sd]}"
    return text


def settings(rows: Sequence[Sequence[Any]]) -> str:
    """Return a table of settings (name, text, table), with rates and pulses of the first and last stages."""
    found = [(name, text, _table(of)) for name, text, of in rows]
    heads = ["", "Setting", "Rates R[0] … R[126]", "Pulses of the stages"]
    return table(heads, [[name, text, _ends(of.rates), _side(of)] for name, text, of in found])


def moves(tables: Mapping[str, Any], rows: Sequence[Sequence[Any]]) -> str:
    """Return a table of moves with shape, pulses, and the time from pulse 1 to the end.

    Args:
        rows: text, table, instruction (82 or 83), rate, pulses.
    """
    found = []
    for text, name, instruction, rate, pulses in rows:
        plan = {82: ramped, 83: constant}[instruction](_table(tables[name]), rate, pulses)
        steps = plan.steps()
        groups = [(rate, len(list(group))) for rate, group in groupby(step.rate for step in steps)]
        words = [f"{rate}×{count}" for rate, count in groups]
        runs = " ".join(words if len(words) <= 8 else [*words[:4], "…", *words[-3:]])
        shape = f"{plan.up}, {len(steps) - plan.up - plan.down}, {plan.down}"
        found.append([text, f"{plan.kind:02X}", shape, runs, sum(step.rate for step in steps)])
    return table(["Move", "Answer", "Up, constant, down", "Rate × pulses", "Ticks"], found)


def planned(table: Mapping[str, Any], rate: int, pulses: int) -> Train:
    """Return an undisturbed move as the golden model plans it."""
    return Train([step.rate for step in ramped(_table(table), rate, pulses).steps()], F_HZ)


SHOWN = 46  # number of pulses of a continuous motion that are shown


async def _changed(block: str, number: int, change: str) -> list[int]:
    host = await Host.start(OnModel(), *blocks.TF)
    await host.ask(block)
    if change:
        await host.pulse(number, 40)
        await host.issue(change)
    for _ in range(2000):
        if host.bench.golden.next_event is None or len(host.bench.rises("pout")) >= SHOWN:
            break
        await host.step()
    return [(b - a) // CLK for a, b in pairwise(host.bench.rises("pout")[:SHOWN])]


def changed(block: str, number: int = 0, change: str = "") -> Train:
    """Return a move with the table TF during which `change` is sent after pulse `number`."""
    intervals = on_model(_changed(block, number, change))
    return Train(intervals, F_HZ, cause=number - 1 if change else None)


def curves(curves: Sequence[Mapping[str, Any]]) -> Figure:
    """Draw accelerations: speed over time, and, except for free curves, pulses of each stage."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(9.2, 3.3), layout="constrained")
    for entry in curves:
        of = _table(entry["table"])
        up = [rate for rate, count in zip(of.rates, of.pa, strict=True) for _ in range(count)]
        speeds(left, Train(up, F_HZ), entry, "time", 1000, False)
        if "build" in entry["table"]:
            colour = COLOURS[entry["colour"]]
            right.step(range(LAST + 1), of.pa, where="mid", color=colour, lw=1.2, label=entry["label"])
    left.set(title="2000 pulses from 1000 to 5000 pulses/s", xlabel="ms after pulse 1", ylabel="kpps")
    left.set_ylim(0, 5.5)
    left.legend(loc="lower right")
    right.set(title="Pulses of each stage", xlabel="stage", ylabel="pulses", ylim=(0, 30))
    right.legend(loc="lower right")
    return figure


async def _returned(switch: int, free: int, out: int) -> list[int]:
    """Return the pulses of a zero return with `out` pulses in phase 1; see also `zero_return`."""
    host = await Host.start(OnModel(), *blocks.TF)
    await host.ask("03 04 11 00 0000")
    await host.pulse(switch)
    await host.pins(org_n=0)
    await host.pulse(switch + free)
    await host.pins(org_n=1)
    await host.pulse(out + out - switch - free)
    await host.pins(org_n=0)
    await host.response()
    return host.bench.rises("pout")


def zero_return() -> Figure:
    """Draw a zero return: speed and position over time."""
    switch, free = 24, 4  # number of pulses until the switch closes; width of the switch in pulses
    out = switch + 12
    edges = on_model(_returned(switch, free, out))
    figure, (left, right) = plt.subplots(1, 2, figsize=(9.2, 3.0), layout="constrained")
    there, back = edges[:out], edges[out:]
    for part, sign, colour, label in ((there, 1, BLUE, "out"), (back, -1, RED, "back")):
        rates = [(b - a) // CLK for a, b in pairwise(part)]
        begin = (part[0] - edges[0]) / CLK / 1000
        times = [begin + ticks / 1000 for ticks in accumulate(rates, initial=0)]
        speed = [sign * 1000 / rate for rate in rates]
        left.stairs(speed, times, baseline=None, color=colour, lw=1.5, label=label)
    where = [*range(1, out + 1), *range(out - 1, out - 1 - len(back), -1)]
    right.plot([(edge - edges[0]) / CLK / 1000 for edge in edges], where, ".", color=GREY, ms=5)
    right.axhspan(switch, switch + free, color=GREEN, alpha=0.25, label="org_n = L")
    left.axhline(0, color=GREY, lw=0.8)
    left.set(title="Speed", xlabel="ms after pulse 1", ylabel="kpps", ylim=(-5, 13))
    left.legend(loc="upper right")
    right.set(title="Position", xlabel="ms after pulse 1", ylabel="POS", ylim=(0, 40))
    right.legend(loc="lower center")
    return figure


# ------------------------------------------------------------------------------------------------ times


async def _to_answer(mode: Config, block: str, *setting: str) -> int:
    """Return the cycles from a block's header to its answer. With `setting`, the block is sent at pulse 2."""
    host = await Host.start(OnModel(mode), *setting)
    await host.write(CSR, ANSWERS)
    if setting:
        await host.pulse(2)
    await host.issue(block)
    await host.response()
    return host.bench.falls("irq_n", host.header)[0] - host.header


async def _to_pulse(mode: Config, block: str, *setting: str) -> int:
    """Return the number of cycles from the header of a block to pulse 1."""
    host = await Host.start(OnModel(mode), *setting)
    await host.issue(block)
    return await host.pulse(1) - host.header


async def _to_out_oe(mode: Config) -> int:
    """Return the number of cycles from the release of rst_n to the rising edge of out_oe."""
    host = await Host.start(OnModel(mode))
    return host.bench.rises("out_oe")[0]


async def _to_output(mode: Config, block: str) -> int:
    """Return the number of cycles from the header of a block to the change of the auxiliary output."""
    host = await Host.start(OnModel(mode))
    await host.issue(block)
    await host.wait()
    return host.bench.edges("auxo_n")[0][0] - host.header


MEASURES = {"answer": _to_answer, "pulse": _to_pulse, "out_oe": _to_out_oe, "output": _to_output}


def times(modes: Mapping[str, str], rows: Sequence[Sequence[str]]) -> str:
    """Return a table of events with their times in several builds of the part.

    Args:
        rows: name of the event, key in MEASURES of the event that ends the time, the measured block, then the
            blocks that are sent before it.
    """
    found = []
    for text, end, *blocks_ in rows:
        cells = []
        for name in modes:
            mode = BUILDS[name]
            texts = [one for block in blocks_ for one in _block(block)]
            us = on_model(MEASURES[end](mode, *texts)) * 1e6 / mode.clk_hz
            cells.append(f"{us / 1000:.3g} ms" if us >= 999 else f"{us:.3g} µs")
        found.append([text, *cells])
    return table(["Event", *modes.values()], found)


# --------------------------------------------------------------------------------------------- diagrams


def flags(chip: Any) -> Levels:
    """Return the flags MWEF and MREF of CSR."""
    return {"mwef": chip.csr >> 3 & 1, "mref": chip.csr >> 2 & 1}


@dataclass(frozen=True)
class BlockStart(Start):
    """The model at the start of a diagram; at the edge of its action `block`, a block's header ends."""

    def action(self, edge: int, what: str, *values: Any) -> Schedule:
        """Return the pin changes of an action, whose registers may be given by name."""
        if what != "block":
            return super().action(edge, what, *(_number(value) for value in values))
        data = bytes.fromhex(values[0])[::-1]
        accesses = [(WCR, 0x20), (WAR, 0x20 - len(data)), *((DWR, byte) for byte in data)]
        begin = edge + 3 - 6 * len(accesses)
        writes = [self.action(begin + 6 * n, "write", *access) for n, access in enumerate(accesses)]
        return [change for write in writes for change in write]


def _number(value: Any) -> Any:
    return REGISTERS.get(value, value) if isinstance(value, str) else value


def _start(host: Host, base: int) -> BlockStart:
    model = host.bench.golden
    return BlockStart(model, base, model.inputs, "we_n", "oe_n", "rs", flags=flags)


async def _ready(setting: str, build: str, then: Sequence[Sequence[Any]]) -> Host:
    host = await Host.start(OnModel(BUILDS[build]), *(_block(setting) if setting else ()))
    await host.write(CSR, ANSWERS)
    await host.pause(40)
    for name, *values in then:
        if name == "pins":
            await host.pins(**values[0])
        else:
            await getattr(host, name)(*(_number(value) for value in values))
    return host


def ready(
    setting: str = "", build: str = "F16", then: Sequence[Sequence[Any]] = (), ahead: int = 0
) -> BlockStart:
    """Return the model after a set-up in which irq_n reports answers.

    Args:
        then: methods of Host with their arguments, called after the set-up.
        ahead: number of cycles from the end of the calls to the base of the diagram.
    """
    host = on_model(_ready(setting, build, then))
    return _start(host, host.t + ahead)


async def _before(number: int, block: str, origin: int) -> tuple[Host, int]:
    edge = 0
    while True:
        host = await _ready("TF", "F16", [["ask", block]])
        if origin:
            await host.pulse(origin)
            await host.pins(org_n=0)
            await host.pulse(origin + 5)
            await host.pins(org_n=1)
        if edge:
            await host.go(edge - 20)
            return host, edge
        edge = await host.pulse(number)


def before(pulse: int, block: str, early: int = 0, origin: int = 0) -> BlockStart:
    """Return the model shortly before a pulse of a motion.

    The base of the diagram is `early` cycles before this pulse.

    Args:
        origin: the pulse after which the origin switch closes; it opens again five pulses later.
    """
    host, edge = on_model(_before(pulse, block, origin))
    return _start(host, edge - early)


def accesses(title: str, write: str, reads: Sequence[str], columns: str) -> dict[str, Any]:
    """Draw all accesses of a block and of its answer, with a column for each access.

    Args:
        write: the block. Its header ends at edge 0.
        reads: registers that are read from edge 100 on, every 10 cycles.
    """
    start = ready(ahead=31)
    schedule = [*start.action(0, "block", write)]
    for n, register in enumerate(reads):
        schedule += start.action(100 + 10 * n, "read", register)
    writes, read = {WCR: "WCR", WAR: "WAR", DWR: "DWR"}, {RAR: "RAR", DRR: "DRR"}

    def access(levels: Levels) -> int | None:
        if not levels["we_n"]:
            return levels["rs"] << 8 | levels["d_i"] | 1 << 12
        return None if levels["oe_n"] else levels["rs"] << 8 | levels["d_o"]

    def text(value: int) -> str:
        return f"{(writes if value >> 12 else read)[value >> 8 & 7]} {value & 0xFF:02X}"

    at = [None if edge is None else start.base + edge for edge in columns_of(columns)]
    samples = record(start.model, start.inputs, schedule, at, flags)
    rows = (
        Row("access", access, text),
        Row("MWEF", "mwef"),
        Row("MREF", "mref"),
        Row("irq_n (ERIRQ = 1)", "irq_n"),
    )
    signal = [wave(row, samples) for row in rows]
    return {"signal": signal, "config": {"hscale": 2}, "head": {"text": title}}
