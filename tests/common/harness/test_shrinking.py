"""Shrinking of failing random runs: a recording is split into transactions, of which few are needed."""

from __future__ import annotations

import asyncio
import random
from collections.abc import Sequence
from typing import Any

import pytest

from cocotb_tests.harness import PARTS, Config, HostBus, ModelBench, OnModel, on_model
from cocotb_tests.harness.compare import compare_recording
from cocotb_tests.harness.dut_bench import new_model
from cocotb_tests.harness.random_items import replay_item, shrink_report
from cocotb_tests.harness.replay import REPLAY
from cocotb_tests.harness.run_context import running_test
from cocotb_tests.harness.shrink import (
    Shrinker,
    Step,
    Transaction,
    changes_of,
    exchanges,
    in_time_order,
    messages,
    report_lines,
    transactions_of,
)
from cocotb_tests.pmc006 import random_host as talker
from cocotb_tests.ppmc104.bench import PPMC104
from cocotb_tests.ppmc312 import random_host, random_noise, random_serial
from openppmc.check.records import Access, Change, Recording
from scripts.measure.replay import main as replay


def busy_run(seed: int = 1) -> Recording:
    """Return a run of over sixty transactions on a PPMC-104, among them a change of csel, an alarm and a read
    of the alarm.
    """

    async def run(bench: ModelBench) -> None:
        host, rng = HostBus(bench), random.Random(seed)
        await host.init(0x0A, 9, 4, 4)
        for number in range(20):
            bench.set(auxi=rng.getrandbits(4), l3_n=rng.getrandbits(1))
            await host.command(rng.choice((0x80, 0x83, 0xC1, 0xC2)), poll=False)
            await bench.clocks(rng.choice((30, 300, 3_000)))
            if number == 7:
                bench.set(csel=1 - bench.pins["csel"])
            if number == 14:
                bench.set(alm_n=0)
        await host.fetch(0x81)
        await bench.clocks(50)

    bench = ModelBench(PPMC104, OnModel())
    on_model(run(bench))
    return bench.recording()


class Mutant:
    """A PPMC-104 that ignores an alarm while csel differs from its level at reset."""

    def __init__(self, recording: Recording) -> None:
        self.model = new_model("ppmc104", recording.params)
        self.csel = first = PPMC104.inputs["csel"]
        self.first = first

    def pins(self, t: int, **levels: int) -> None:
        self.csel = levels.get("csel", self.csel)
        if self.csel != self.first:
            levels.pop("alm_n", None)
        self.model.pins(t, **levels)

    def run_until(self, t: int) -> None:
        self.model.run_until(t)

    @property
    def edges(self) -> Any:
        return self.model.edges


def difference(recording: Recording, transactions: Sequence[Transaction]) -> int | None:
    """Return the first edge that differs between mutant and golden model with these transactions; None
    without a difference.
    """
    some = Recording(
        "ppmc104", recording.params, 1, recording.end, changes_of(PPMC104, transactions), recording.edges
    )
    golden = new_model("ppmc104", some.params)
    for change in some.stimulus:
        golden.pins(change.t, **{change.pin: change.value})
    golden.run_until(some.end)
    some.edges = list(golden.edges)
    mismatch = compare_recording(some, Mutant(some)).mismatch
    return mismatch.t if mismatch else None


def shrunk(recording: Recording, **limits: Any) -> Shrinker:
    async def fails(transactions: Sequence[Transaction]) -> int | None:
        return difference(recording, transactions)

    shrinker = Shrinker(transactions_of(recording), fails, **limits)
    asyncio.run(shrinker.run())
    return shrinker


def test_a_mutant_is_shrunk_to_a_handful() -> None:
    """Of sixty transactions, four remain, without pauses: the two that cause the fault, and the two that read
    its effect.
    """
    recording = busy_run()
    assert len(transactions_of(recording)) >= 60 and difference(recording, transactions_of(recording))
    shrinker = shrunk(recording)
    assert [txn.what for txn in shrinker.transactions] == [
        f"csel = {1 - PPMC104.inputs['csel']}", "alm_n = 0", "write C 81", "read data",
    ]  # fmt: skip
    assert not shrinker.stopped and shrinker.trials < 200
    assert shrinker.transactions[-1].end < 150 < transactions_of(recording)[-1].begin
    assert shrunk(recording).transactions == shrinker.transactions


def test_limits_end_the_search_with_the_best_so_far() -> None:
    recording = busy_run()
    for limits, said in (({"trials_at_most": 12}, "after 12 trials"), ({"seconds": 0}, "after 0 s")):
        shrinker = shrunk(recording, **limits)
        assert shrinker.stopped == said and difference(recording, shrinker.transactions)
    assert 4 < len(shrunk(recording, trials_at_most=12).transactions) < len(transactions_of(recording))


def normal(changes: Sequence[Change]) -> list[Change]:
    """Return the changes in an order that does not depend on the order of simultaneous changes."""
    return sorted(changes)


HOSTS = (
    (random_host.play, random_host.build, 1),
    (random_host.play, random_host.build, 2),
    (random_noise.play, random_host.build, 1),
    (random_serial.play, random_serial.build, 1),
    (random_serial.play, random_serial.build, 2),
    (talker.play, talker.build, 1),
    (talker.play, talker.build, 2),
)


def played(play: Any, seed: int, build: Config) -> Recording:
    """Return the recording of a random host on the golden model."""
    with running_test(None, seed) as running:
        on_model(play(OnModel(build, seed), seed))
        assert running.bench
        return running.bench.recording()


def test_all_acts_together_are_the_run() -> None:
    """The transactions of a run contain every pin change; the messages contain every transaction.

    Checked for a bus, a line, noise, clocks and resets.
    """
    recordings = [busy_run(), *(played(play, seed, build(seed)) for play, build, seed in HOSTS)]
    for recording in recordings:
        transactions = transactions_of(recording)
        assert normal(changes_of(PARTS[recording.part], transactions)) == normal(recording.stimulus)
        assert len(transactions) < len(recording.stimulus)
        assert in_time_order(messages(transactions)) == in_time_order(exchanges(transactions)) == transactions


def place(words: Sequence[str], expected: Sequence[str], start: int = 0) -> int | None:
    """Return the index after the first occurrence of `expected` in `words`, or None."""
    size = len(expected)
    ends = range(start + size, len(words) + 1)
    return next((end for end in ends if words[end - size : end] == list(expected)), None)


def test_messages_are_left_out_together() -> None:
    """Two blocks that have an effect only as a whole, and a response, remain of a thousand transactions."""
    transactions = transactions_of(played(random_host.play, 1, random_host.build(1)))
    blocks = [run for run in messages(transactions) if run[0].what == "WCR := 20" and len(run) > 9]
    responses = [run for run in messages(transactions) if run[-1].kind.startswith("DRR")]
    table, motion = blocks[0], blocks[len(blocks) // 2]
    answer = next(run for run in responses if run[0].begin > motion[-1].end)
    expected = [
        [txn.what for txn in run] for run in (table, motion, [txn for txn in answer if "DRR" in txn.what])
    ]

    async def fails(some: Sequence[Transaction]) -> int | None:
        done = [txn for txn in some if txn.access and txn.access.kind != "CSR read"]
        words, end = [txn.what for txn in done], 0
        for run in expected:
            found = place(words, run, end)
            if found is None:
                return None
            end = found
        return done[end - 1].end

    shrinker = Shrinker(transactions, fails)
    asyncio.run(shrinker.run())
    assert [txn.what for txn in shrinker.transactions] == sum(expected, [])
    assert len(transactions) > 1_000 and len(report_lines(shrinker.transactions)) == 3
    assert not shrinker.stopped and shrinker.trials < 200


def access(t: int, kind: str, byte: int, reg: int = 0) -> Transaction:
    strobe = (Step(t, "rd_n", 1, 0), Step(t + 4, "rd_n", 1, 1))
    word = kind if kind.endswith("read") else f"{kind} {byte:02X}"
    return Transaction(word, strobe, Access(t, kind, reg, byte))


def test_a_message_is_described_in_a_line() -> None:
    """A block, a response and polls are each described as one item; an item after a pause is on a new
    line.
    """
    block = [access(20, "WCR :=", 0x20, 2), access(28, "WAR :=", 0x1E, 3)]
    block += [access(36, "DWR :=", 0x40, 5), access(44, "DWR :=", 0x03, 5)]
    polls = [access(60, "CSR read", 4), access(68, "CSR read", 0)]
    response = [access(90, "RAR read", 0x3E, 3), access(98, "DRR read", 1, 7), access(106, "DRR read", 2, 7)]
    reads = [*polls, *response, access(500, "CSR read", 4)]
    assert report_lines([*block, *reads]) == [
        "WCR := 20, WAR := 1E, DWR := 40 03 at 20",
        "CSR read 2 times, RAR read, DRR read 2 times at 60",
        "CSR read at 500",
    ]  # fmt: skip
    again = [txn.moved(900) for txn in block]
    assert [len(run) for run in messages([*block, *reads, *again])] == [4, 5, 1, 4]
    assert [len(run) for run in exchanges([*reads, *block, *reads, *again])] == [6, 10, 4]


def rows(part: str, *changes: tuple[int, str, int]) -> list[str]:
    transactions = transactions_of(Recording(part, {}, stimulus=[Change(*change) for change in changes]))
    return [str(txn) for txn in transactions]


def line(t: int, byte: int) -> list[tuple[int, str, int]]:
    """Return the level changes of a character whose bits have 192 cycles."""
    bits = [0, *(byte >> place & 1 for place in range(8)), 1]
    return [(t + 192 * k, "rxd", bit) for k, bit in enumerate(bits) if bit != [1, *bits][k]]


def test_transactions_are_described_as_text() -> None:
    """Transactions are described as text: pins, bits of pins, resets, frames, periods of a clock."""
    assert rows("ppmc104", (40, "alm_n", 0), (50, "rst_n", 0), (62, "rst_n", 1)) == [
        "alm_n = 0 at 40", "reset for 12 clk at 50",
    ]  # fmt: skip
    assert rows("ppmc2104", (7, "alm_n", 1)) == ["alm_n[2] = 0 at 7"]
    assert rows("ppmc104", (9, "auxi", 6)) == ["auxi = 0x6 at 9"]
    frames = [*line(0, 0x73), *line(1920, 0x73)]
    assert rows("pmc006", *frames) == ["frame 73 73 at 0"]
    # Most levels last two bits. The characters do not begin at exactly equal distances.
    frames = [change for k in range(4) for change in line(1957 * k + k % 2, 0x33)]
    assert rows("pmc006", *frames) == ["frame 33 33 33 33 at 0"]
    ticks = [(100 * k, "clock", (k + 1) % 2) for k in range(400)]
    clock = rows("ppmc104", *ticks)
    assert len(clock) == 50 and clock[1] == "clock: 4 periods of 200 clk at 800"


def test_what_is_left_out_takes_nothing_along() -> None:
    """Each access contains its address and data, so it is complete even if the access before it is
    removed.
    """
    recording = busy_run()
    one = next(txn for txn in transactions_of(recording) if txn.what == "write C 81")
    expected = {(change.pin, change.value) for change in changes_of(PPMC104, [one])}
    assert {("a0", 1), ("d_i", 0x81), ("wr_n", 0)} <= expected
    moved = one.moved(5)
    assert (moved.begin, moved.end) == (one.begin + 5, one.end + 5)
    assert moved.access and one.access and moved.access.t == one.access.t + 5


def test_a_run_without_a_recording_is_reported(tmp_path: Any) -> None:
    assert shrink_report(tmp_path) == "not shrunk: no difference from the golden model was recorded"


def test_replay_needs_a_recording(tmp_path: Any, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "recording.json").write_text("{}", encoding="utf-8")
    assert replay([str(tmp_path / "recording.json")]) == 2 and "not a recording" in capsys.readouterr().out
    assert replay([]) == 2


def test_a_recording_is_replayed_in_its_own_build() -> None:
    recording = busy_run()
    recording.params["BAUD"] = 9600
    config = replay_item(recording).config
    assert config.params == recording.params and REPLAY == "OPENPPMC_REPLAY"
