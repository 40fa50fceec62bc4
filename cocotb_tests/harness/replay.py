"""Replays a recording on the RTL, compares it with the golden model, and shortens it (`shrink`)."""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import cocotb

from openppmc.check.comparison import Comparison
from openppmc.check.records import Change, Edge, Recording

from .compare import compare_recording, write_report
from .part import PARTS
from .rtl_bench import RtlBench
from .shrink import Shrinker, Transaction, changes_of, report_lines, transactions_of


async def rerun(bench: RtlBench, changes: Iterable[Change], end: int) -> list[Edge]:
    """Reset the device and make the changes; return all output edges up to edge `end`.

    The times of the edges have the same origin as those of `changes`.
    """
    await bench.align()
    bench.set(rst_n=0)
    await bench.clocks(1)
    bench.set(**bench.part.inputs)
    await bench.clocks(3)
    base = bench.set(rst_n=1)
    bench.forget()
    driven = bench.drive((base + t, {pin: value}) for t, pin, value in changes)
    await bench.until(base + end + 1)
    driven.cancel()  # changes after the end must not affect the next run
    return [edge._replace(t=edge.t - base) for edge in bench.recording().edges]


REPLAY = "OPENPPMC_REPLAY"
SECONDS = "OPENPPMC_SHRINK_S"
WORDS = "short.txt"
ROWS = 40
"""Maximum number of lines in the message; a line describes one group of transactions."""


async def compared(bench: RtlBench, recording: Recording) -> Comparison:
    """Compare RTL and golden model under the pin changes of a recording, both starting just after a reset."""
    edges = await rerun(bench, recording.stimulus, recording.end)
    return compare_recording(replace(recording, edges=edges))


class Search:
    """Searches for a short list of transactions that causes a difference on the same output as `first`.

    The best list so far is always in recording.json and short.txt in the bench's folder.
    """

    def __init__(self, bench: RtlBench, first: Comparison) -> None:
        assert first.mismatch is not None
        self.bench, self.signal = bench, first.mismatch.signal
        t, transactions = first.mismatch.t, transactions_of(first.recording)
        self.whole = len(transactions)
        self.end = first.recording.end
        self.store(first)
        seconds = float(os.environ.get(SECONDS, "60"))
        transactions = [txn for txn in transactions if txn.begin <= t]
        self.shrinker = Shrinker(transactions, self.fails, seconds=seconds, kept=self.keep)

    async def run(self) -> bool:
        """Search; return False if even all transactions together do not cause the difference."""
        if await self.fails(self.shrinker.transactions) is None:
            return False
        self.keep()
        await self.shrinker.run()
        write_report(self.last, self.bench.out, self.bench.repro)
        self.keep()
        return True

    def store(self, found: Comparison) -> None:
        """Store the best result so far; with a shorter list the difference may occur slightly later."""
        assert found.mismatch is not None
        self.last, t = found, found.mismatch.t
        self.end = min(self.end, t + t // 8 + 2_000)

    async def fails(self, transactions: Sequence[Transaction]) -> int | None:
        """Return the edge of the difference that these transactions cause.

        Return None if they do not cause it, or if another output differs first.
        """
        recording = replace(
            self.last.recording,
            end=self.end,
            stimulus=changes_of(self.bench.part, transactions),
            accesses=[txn.access for txn in transactions if txn.access],
        )
        try:
            found = await compared(self.bench, recording)
        except (AssertionError, ValueError):  # the transactions are not a legal stimulus for the golden model
            return None
        if found.mismatch is None or found.mismatch.signal != self.signal:
            return None
        self.store(found)
        return found.mismatch.t

    def keep(self) -> None:
        """Write recording.json and short.txt."""
        out, m, shrinker = self.bench.out, self.last.mismatch, self.shrinker
        assert m is not None
        short = replace(self.last.recording, end=min(self.end, m.t + 200))
        (out / "recording.json").write_text(short.to_json(), encoding="utf-8")
        transactions = shrinker.transactions
        rows = [f"  {line}" for line in report_lines(transactions)]
        (out / "transactions.txt").write_text("\n".join([*rows, ""]), encoding="utf-8")
        head = f"shrunk from {self.whole} transactions to {len(transactions)} in {shrinker.trials} trials"
        head += f", {len(rows)} lines" if len(rows) < len(transactions) else ""
        head += f", stopped {shrinker.stopped}" if shrinker.stopped else ""
        more = [f"  … and {len(rows) - ROWS} more in transactions.txt"] if len(rows) > ROWS else []
        expected, actual = (_edge_text(edge) for edge in (m.expected, m.actual))
        tail = f"then {m.signal} differs at edge {m.t}: expected {expected}, got {actual}"
        (out / WORDS).write_text("\n".join([f"{head}:", *rows[:ROWS], *more, tail]), encoding="utf-8")


def _edge_text(edge: tuple[int, int] | None) -> str:
    return "no further edge" if edge is None else f"{edge[1]:#x} at {edge[0]}"


async def _begun() -> tuple[RtlBench, Comparison]:
    recording = Recording.from_json(Path(os.environ[REPLAY]).read_text(encoding="utf-8"))
    bench = await RtlBench.start(cocotb.top, PARTS[recording.part], seed=recording.seed)
    return bench, await compared(bench, recording)


@cocotb.test()
async def replay(dut: Any) -> None:
    """When the RTL receives the pin changes of a recording, all outputs change as in the golden model."""
    bench, comparison = await _begun()
    if comparison.mismatch is not None:
        raise AssertionError(write_report(comparison, bench.out, bench.repro))


@cocotb.test()
async def shrink(dut: Any) -> None:
    """Omit transactions from a recording with a difference; write the shortest list found to a file."""
    bench, first = await _begun()
    if first.mismatch is None:
        why = "its pins show no difference from another reset"
    elif not await Search(bench, first).run():
        why = "taken apart into single transactions it shows no difference"
    else:
        return
    (bench.out / WORDS).write_text(f"not shrunk: {why}", encoding="utf-8")
