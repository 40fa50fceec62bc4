"""Tables of docs/stmc/README.md, computed: speeds, ramps, worked moves, times of both timing modes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import groupby

from openppmc.model.stmc.commands import profile
from scripts.pages.stmc.bench import CLK_HZ, Bench, Outcome, little

INTERNAL_HZ, BOARD_HZ = 12_500, 48_675
DIVISORS = (1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 12, 15, 20, 25, 30, 40, 50, 59, 75, 100, 125, 141, 175, 200, 255)
ADVISED = 5  # smallest divisor that the data sheet recommends
RAMPS = ((20, 5, 8), (10, 5, 4), (40, 10, 6), (200, 20, 10), (10, 6, 16), (255, 5, 4), (50, 25, 1))
LONG_RAMP = (141, 59, 400)
STANDARD = (20, 5, 8)


def _speed(hz: int, divisor: int) -> str:
    text = f"{float(Fraction(hz, divisor)):,.2f}".replace(",", " ").rstrip("0").rstrip(".")
    return text if divisor >= ADVISED else f"({text})"


def speed_table() -> str:
    """Return a table of divisors and steps/s for both step clocks."""
    lines = ["| D | hex | internal, 12.5 kHz | board, 48.675 kHz |", "|---|---|---|---|"]
    for divisor in DIVISORS:
        cells = " | ".join(_speed(hz, divisor) for hz in (INTERNAL_HZ, BOARD_HZ))
        lines.append(f"| {divisor} | {divisor:02X} | {cells} |")
    return "\n".join(lines)


def divisors(slow: int, fast: int, ramp: int) -> list[int]:
    """Return x(0) .. x(PA) of the model."""
    of = profile(slow, fast, ramp)
    return [rate + 1 for rate in of.rates()]


def ramp_table() -> str:
    """Return a table of the divisors of all levels of some ramps."""
    lines = ["| D1 | D2 | PA | x(0), x(1), … x(PA) |", "|---|---|---|---|"]
    for ramp in RAMPS:
        lines.append(f"| {' | '.join(map(str, ramp))} | {' '.join(map(str, divisors(*ramp)))} |")
    values = divisors(*LONG_RAMP)
    some = ", ".join(f"x({k}) = {values[k]}" for k in (100, 200, 300, 390, 395, 400))
    lines.append(f"| {' | '.join(map(str, LONG_RAMP))} | {' '.join(map(str, values[:8]))} … {some} |")
    return "\n".join(lines)


@dataclass(frozen=True)
class Case:
    """One worked move: command and data, an event, its gap (-1: before step 0) and its description."""

    name: str
    ramp: tuple[int, int, int]
    code: int
    data: Sequence[int]
    gap: int | None = None
    act: Callable[[Bench], object] | None = None
    told: str = ""


def _stop(bench: Bench) -> None:
    bench.write(1, 0x41)


def _low(pin: str) -> Callable[[Bench], None]:
    def act(bench: Bench) -> None:
        bench.chip.pins(bench.t, **{pin: 0})
        bench.t += 1

    return act


def _ramped(name: str, sent: int, ramp: tuple[int, int, int] = STANDARD) -> Case:
    return Case(name, ramp, 0x43, little(sent))


def _stopped(name: str, gap: int, sent: int = 99, ramp: tuple[int, int, int] = STANDARD) -> Case:
    return Case(name, ramp, 0x43, little(sent), gap, _stop, f"command 1 in gap {gap}")


CASES = (
    _ramped("W1", 19),
    _ramped("W2", 11),
    _ramped("W3", 10),
    _ramped("W4", 16),
    _ramped("W5", 17),
    *(_ramped("W6", sent) for sent in range(4)),
    _ramped("W7", 11, (10, 5, 4)),
    _ramped("W8", 8, (50, 25, 3)),
    _ramped("W9", 800, LONG_RAMP),
    _ramped("W10", 1999, LONG_RAMP),
    _ramped("W11", 5, (12, 6, 0)),
    _ramped("W12", 5, (10, 10, 50)),
    Case("W13", STANDARD, 0x44, (7, *little(4))),
    _stopped("W14", 3),
    _stopped("W15", 10),
    _stopped("W16", 1),
    _stopped("W17", 0),
    *(_stopped("W18", gap, 11) for gap in (4, 5, 6)),
    *(Case("W19", STANDARD, 0x43, little(23), gap, _low("l3_n"), f"L3 in gap {gap}") for gap in (13, 14)),
    Case("W20", STANDARD, 0x43, little(99), 10, _low("l1_n"), "L1 in gap 10"),
    Case("W21", STANDARD, 0x43, little(99), -1, _low("l3_n"), "L3 low before the start"),
    _stopped("W22", 3, 5, (12, 6, 0)),
    _stopped("W23", 1, 99, (10, 6, 16)),
)


def play(case: Case) -> Outcome:
    """Run a case on the golden model with the internal clock."""
    bench = Bench()
    bench.init(0x0A, *case.ramp)
    if case.act and case.gap == -1:
        case.act(bench)
    bench.start(case.code, *case.data)
    if case.act and case.gap is not None and case.gap >= 0:
        bench.taken()
        bench.in_gap(case.gap)
        case.act(bench)
    return bench.end()


def _shortened(gaps: Sequence[int], limit: int = 30) -> str:
    """Return gaps as text: runs of more than three as 5×8, long lists without their middle."""
    words = []
    for value, group in groupby(gaps):
        count = len(list(group))
        words += [f"{value}×{count}"] if count > 3 else [str(value)] * count
    if len(words) > limit:
        words = [*words[:6], "…", *words[-6:]]
    return " ".join(words) or "none"


def moves_table() -> str:
    """Return a table of the worked moves of the golden model."""
    lines = [
        "| No. | D1/D2/PA | Sent | Disturbed by | Steps | Gaps in ticks | Sum | Finish | Remaining |",
        "|---|---|---|---|---|---|---|---|---|",
    ]
    for case in CASES:
        made = play(case)
        sent = " ".join(f"{byte:02X}" for byte in (case.code, *case.data))
        left = " ".join(f"{byte:02X}" for byte in little(made.remaining))
        ramp = "/".join(map(str, case.ramp))
        cells = [case.name, ramp, f"`{sent}`", case.told, f"{len(made.steps)}", _shortened(made.gaps)]
        cells += [f"{sum(made.gaps):,}".replace(",", " "), f"{made.finish:02X}", left]
        lines.append(f"| {' | '.join(cells)} |")
    return "\n".join(lines)


# ---------------------------------------------------------------------------------------------- times


def _time(clk: int) -> str:
    """Return a time in a suitable unit."""
    micros = Fraction(clk * 1_000_000, CLK_HZ)
    if micros < 1:
        return f"{clk} cycles" if clk else "same cycle"
    if micros >= 10_000:
        return f"{float(micros / 1000):.4g} ms"
    return f"{float(micros):.4g} µs"


@dataclass(frozen=True)
class Times:
    """Times of a motion in one mode: from the end of the last write, and from the last step or its cause."""

    start: int
    first: int
    end: int
    taken: int


def _motion(timing: str, code: int, data: Sequence[int], stop: bool = False) -> Times:
    bench = Bench(timing)
    bench.init(0x0A, *STANDARD)
    sent = bench.start(code, *data)
    log = bench.chip.log
    begin = bench.until(lambda: bool(log.of("hold", bench.mark)))
    first = bench.until(lambda: len(bench.steps()) > 0)
    if stop:
        bench.in_gap(2)
        cause = bench.write(1, 0x40)
        end = bench.until(lambda: not bench.chip.busy)
    else:
        end = bench.until(lambda: not bench.chip.busy)
        cause = bench.steps()[-1]
    bench.t = max(bench.t, end + 1)
    if timing == "FAST":
        bench.t = end + 20
        return Times(begin - sent, first - sent, end - cause, end - cause)
    bench.write(1, 0x80)
    return Times(begin - sent, first - sent, end - cause, bench.taken() - cause)


def _phases(timing: str) -> int:
    bench = Bench(timing)
    sent = bench.send(0x0A, 20, 5, 8, 0)
    return bench.until(lambda: bench.chip.outputs["s"] != 0) - sent


def _ready(timing: str, ramp: tuple[int, int, int]) -> int:
    bench = Bench(timing)
    sent = bench.send(0x0A, ramp[0], ramp[1], *little(ramp[2], 2))
    bench.taken()
    bench.write(1, 0x80)
    return bench.taken() - sent


ROWS: tuple[tuple[str, Callable[[str], int]], ...] = (
    ("first initialisation, last byte to phases", _phases),
    *(
        (f"initialisation {'/'.join(map(str, ramp))}, last byte until bytes are accepted again",
         lambda timing, ramp=ramp: _ready(timing, ramp))
        for ramp in (STANDARD, LONG_RAMP, (255, 1, 65535))
    ),
    ("commands 4, 5, 7: last byte to BUSY, `hold` = 0",
     lambda timing: _motion(timing, 0x45, (10,), True).start),
    ("commands 4, 5, 7: last byte to step 0", lambda timing: _motion(timing, 0x45, (10,), True).first),
    ("commands 3, 6: last byte to BUSY, `hold` = 0", lambda timing: _motion(timing, 0x43, little(9)).start),
    ("commands 3, 6: last byte to step 0", lambda timing: _motion(timing, 0x43, little(9)).first),
    ("command 2: byte to its step", lambda timing: _motion(timing, 0x42, ()).first),
    ("command 2: step to the end", lambda timing: _motion(timing, 0x42, ()).end),
    ("commands 3 … 7, normal end: last step to BUSY = 0, `int_n` = L",
     lambda timing: _motion(timing, 0x43, little(9)).end),
    ("commands 3 … 7, normal end: last step until bytes are accepted again",
     lambda timing: _motion(timing, 0x43, little(9)).taken),
    ("commands 3, 6, stop: cause to BUSY = 0 and bytes accepted",
     lambda timing: _motion(timing, 0x43, little(99), True).end),
    ("commands 4, 5, 7, stop: cause to BUSY = 0", lambda timing: _motion(timing, 0x45, (10,), True).end),
    ("commands 4, 5, 7, stop: cause until bytes are accepted again",
     lambda timing: _motion(timing, 0x45, (10,), True).taken),
)  # fmt: skip


def times_table() -> str:
    """Return a table of times of both modes of the golden model, at 16 MHz with the internal clock."""
    lines = ["| From … to | FAST | DATASHEET |", "|---|---|---|"]
    for text, measure in ROWS:
        lines.append(f"| {text} | {_time(measure('FAST'))} | {_time(measure('DATASHEET'))} |")
    return "\n".join(lines)
