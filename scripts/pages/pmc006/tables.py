"""Computed tables of docs/pmc006/README.md: times of moves, latencies of the golden model."""

from __future__ import annotations

from collections.abc import Awaitable, Callable

from cocotb_tests.harness.model_bench import on_model
from scripts.pages.pmc006.plots import CLK_HZ, FAST, finish, new, steps

MOVES = (
    (255, 600, 600, 3200, 3),
    (256, 600, 600, 3200, 3),
    (1000, 600, 600, 3200, 3),
    (4000, 600, 600, 3200, 3),
    (255, 3000, 65, 16_000, 3),
    (4000, 600, 600, 16_000, 5),
    (8000, 600, 600, 16_000, 5),
    (8000, 600, 600, 16_000, 0),
)


def _number(value: int) -> str:
    return f"{value:,}".replace(",", " ") if value > 9999 else str(value)


def moves_table() -> str:
    """Return a table of moves with their times and highest speeds."""
    lines = ["| Steps | Start, stop, maximum pps | u, o | Time / ms | Fastest pps |", "|---|---|---|---|---|"]
    for count, start, stop, top, coefficient in MOVES:
        edges = steps(count, L=start, S=stop, v=top, u=coefficient, o=coefficient)
        # Two intervals together, because a single interval is rounded to 1 µs.
        shortest = min(b - a for a, b in zip(edges, edges[2:], strict=False))
        fastest = _number(round(2 * CLK_HZ / shortest))
        passed = (edges[-1] - edges[0]) * 1000 / CLK_HZ
        lines.append(
            f"| {_number(count)} | {start}, {stop}, {_number(top)} | {coefficient}, {coefficient} |"
            f" {passed:.1f} | {fastest} |"
        )
    return "\n".join([*lines, "", "Time from the first step to the last."])


async def _start() -> tuple[str, int]:
    host = await new(FAST)
    await host.ask("s", 300)
    e = host.e
    return "`s` to `mon_busy`", next(t for t in host.bench.golden.log.rises("mon_busy", e)) - e


async def _first_step() -> tuple[str, int]:
    host = await new(FAST | {"L": 2000, "S": 2000})
    await host.ask("s", 200)
    e = host.e
    edges = await finish(host)
    return "`s` to the start of the engine", round(edges[0] - e - CLK_HZ / 2000)


async def _stop() -> tuple[str, int]:
    host = await new(FAST | {"f": 1})
    await host.ask("s", 300)
    await host.ms(20)
    await host.pins(ext1=0)
    t = host.t - 1
    await host.ms(1)
    return "EXT1 to `mon_busy` low", next(edge for edge in host.bench.golden.log.falls("mon_busy", t)) - t


async def _output() -> tuple[str, int]:
    host = await new({})
    await host.ask("y", 8)
    return "`y` to `gpo`", host.bench.golden.log.of("gpo", host.e)[0][0] - host.e


CASES: tuple[Callable[[], Awaitable[tuple[str, int]]], ...] = (_start, _first_step, _stop, _output)


def times_table() -> str:
    """Return a table of latencies of this core, in cycles after the last stop-bit sample or the pin."""
    rows = "\n".join(f"| {text} | {clk} |" for text, clk in (on_model(case()) for case in CASES))
    head = f"This core, at {CLK_HZ // 1_000_000} MHz, in cycles (from the stop bit or the pin):"
    return f"{head}\n\n| | cycles |\n|---|---|\n{rows}"
