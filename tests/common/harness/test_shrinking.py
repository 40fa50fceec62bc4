"""Shrinking of failing random runs: what an act is, and that a mutant is found with a handful of them."""

from __future__ import annotations

import asyncio
import random
from collections.abc import Sequence
from typing import Any

import pytest

from cocotb_tests.harness.acts import Act, acts_of, changes_of
from cocotb_tests.harness.bus import HostBus
from cocotb_tests.harness.compare import compare_recording
from cocotb_tests.harness.config import Config
from cocotb_tests.harness.follower import new_model
from cocotb_tests.harness.model_bench import ModelBench, OnModel, on_model
from cocotb_tests.harness.part import PARTS
from cocotb_tests.harness.replaying import REPLAY
from cocotb_tests.harness.running import running_test
from cocotb_tests.harness.shortened import replay_item, shortened
from cocotb_tests.harness.shrink import Shrinker
from cocotb_tests.harness.stimulus import Change, Recording
from cocotb_tests.pmc006 import random_host as talker
from cocotb_tests.ppmc104.bench import PPMC104
from cocotb_tests.ppmc312 import random_host, random_noise, random_serial
from scripts.replay import main as replay


def busy_run(seed: int = 1) -> Recording:
    """Sixty acts and more on a PPMC-104; somewhere between them the select pin, an alarm and a look at it."""

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
    """A PPMC-104 that does not see an alarm when csel is not as it was in the reset."""

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


def differs(recording: Recording, acts: Sequence[Act]) -> bool:
    """Whether the mutant is told from the golden model by these acts."""
    some = Recording(
        "ppmc104", recording.params, 1, recording.end, changes_of(PPMC104, acts), recording.edges
    )
    golden = new_model("ppmc104", some.params)
    for change in some.stimulus:
        golden.pins(change.t, **{change.pin: change.value})
    golden.run_until(some.end)
    some.edges = list(golden.edges)
    return compare_recording(some, Mutant(some)).mismatch is not None


def shrunk(recording: Recording, **limits: Any) -> Shrinker:
    async def fails(acts: Sequence[Act]) -> bool:
        return differs(recording, acts)

    shrinker = Shrinker(acts_of(recording), fails, **limits)
    asyncio.run(shrinker.run())
    return shrinker


def test_a_mutant_is_shrunk_to_a_handful() -> None:
    """Two of sixty acts set the trap, two look into it; the rest goes, and the pauses, too."""
    recording = busy_run()
    assert len(acts_of(recording)) >= 60 and differs(recording, acts_of(recording))
    shrinker = shrunk(recording)
    assert [act.what for act in shrinker.acts] == [
        f"csel = {1 - PPMC104.inputs['csel']}", "alm_n = 0", "write C 81", "read data",
    ]  # fmt: skip
    assert not shrinker.stopped and shrinker.trials < 200
    assert shrinker.acts[-1].end < 150 < acts_of(recording)[-1].begin
    assert shrunk(recording).acts == shrinker.acts


def test_limits_end_the_search_with_the_best_so_far() -> None:
    recording = busy_run()
    for limits, said in (({"trials_at_most": 12}, "after 12 trials"), ({"seconds": 0}, "after 0 s")):
        shrinker = shrunk(recording, **limits)
        assert shrinker.stopped == said and differs(recording, shrinker.acts)
    assert 4 < len(shrunk(recording, trials_at_most=12).acts) < len(acts_of(recording))


def normal(changes: Sequence[Change]) -> list[Change]:
    """Without the order of pins that change together."""
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
    """What a random host leaves on the golden model."""
    with running_test(None, seed) as running:
        on_model(play(OnModel(build, seed), seed))
        assert running.side
        return running.side.recording()


def test_all_acts_together_are_the_run() -> None:
    """No pin change is lost or moved, whatever the host: on a bus, on a line, noise, clocks, resets."""
    recordings = [busy_run(), *(played(play, seed, build(seed)) for play, build, seed in HOSTS)]
    for recording in recordings:
        acts = acts_of(recording)
        assert normal(changes_of(PARTS[recording.part], acts)) == normal(recording.stimulus)
        assert len(acts) < len(recording.stimulus)


def rows(part: str, *changes: tuple[int, str, int]) -> list[str]:
    acts = acts_of(Recording(part, {}, stimulus=[Change(*change) for change in changes]))
    return [str(act) for act in acts]


def test_acts_are_told_in_words() -> None:
    """Pins by their names, bits by their numbers, resets, bytes of a frame, groups of clock periods."""
    assert rows("ppmc104", (40, "alm_n", 0), (50, "rst_n", 0), (62, "rst_n", 1)) == [
        "alm_n = 0 at 40", "reset for 12 clk at 50",
    ]  # fmt: skip
    assert rows("ppmc2104", (7, "alm_n", 1)) == ["alm_n[2] = 0 at 7"]
    assert rows("ppmc104", (9, "auxi", 6)) == ["auxi = 0x6 at 9"]
    bits = [0, *(0x73 >> place & 1 for place in range(8)), 1]
    line = [(192 * k, "rxd", level) for k, level in enumerate(bits) if level != ([1, *bits])[k]]
    assert rows("pmc006", *line, *((t + 1920, pin, level) for t, pin, level in line)) == ["frame 73 73 at 0"]
    ticks = [(100 * k, "clock", (k + 1) % 2) for k in range(400)]
    clock = rows("ppmc104", *ticks)
    assert len(clock) == 50 and clock[1] == "clock: 4 periods of 200 clk at 800"


def test_what_is_left_out_takes_nothing_along() -> None:
    """The second access brings its address and data itself; the other bit of a port stays."""
    recording = busy_run()
    one = next(act for act in acts_of(recording) if act.what == "write C 81")
    wanted = {(change.pin, change.value) for change in changes_of(PPMC104, [one])}
    assert {("a0", 1), ("d_i", 0x81), ("wr_n", 0)} <= wanted
    moved = one.moved(5)
    assert (moved.begin, moved.end) == (one.begin + 5, one.end + 5)
    assert moved.access and one.access and moved.access.t == one.access.t + 5


def test_a_run_without_a_recording_says_so(tmp_path: Any) -> None:
    assert shortened(tmp_path) == "not shrunk: no difference from the golden model was recorded"


def test_replay_needs_a_recording(tmp_path: Any, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "recording.json").write_text("{}", encoding="utf-8")
    assert replay([str(tmp_path / "recording.json")]) == 2 and "no recording" in capsys.readouterr().out
    assert replay([]) == 2


def test_a_recording_is_replayed_in_its_own_build() -> None:
    recording = busy_run()
    recording.params["BAUD"] = 9600
    config = replay_item(recording).config
    assert config.params == recording.params and REPLAY == "OPENPPMC_REPLAY"
