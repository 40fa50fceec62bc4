"""`make fire`: its sessions, executed as jobs of a campaign."""

from __future__ import annotations

from pathlib import Path

import pytest

from scripts.measure.campaign import run, store
from scripts.measure.fire import __main__ as fire
from scripts.measure.fire.boards import TARGETS


def test_a_small_campaign(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture
) -> None:
    """Each board has the same number of sessions, and a second run repeats none of them."""
    monkeypatch.setattr(run, "RESULTS", tmp_path / "results.sqlite")
    words = ["--seed", "700", "--count", str(2 * len(TARGETS)), "-n", "1"]
    for _ in range(2):
        assert fire.main(words) == 0
        told = capsys.readouterr().out
        assert f"{2 * len(TARGETS)} sessions, " in told and "0 wrong statements" in told
    with store.Store(tmp_path / "results.sqlite") as file:
        assert file.good("fire", "pmc006 700+2", run.tree()) is not None


def test_a_block_with_a_wrong_statement(monkeypatch: pytest.MonkeyPatch) -> None:
    def play(name: str, seed: int) -> fire.Played:
        return fire.Played((), "as requested", "position 0 is stated" if seed == 5 else "", float(seed))

    monkeypatch.setattr(fire, "play", play)
    done = fire.block(("stmc", 3, 4))
    assert not done.good and done.data["failures"] == ["stmc, seed 5: position 0 is stated"]
    assert done.data["outcomes"] == {"as requested": 4} and done.data["longest"] == 6.0
