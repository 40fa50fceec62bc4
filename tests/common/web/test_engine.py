"""The engine of the page under node: in each session, its edges are those of the golden model."""

from __future__ import annotations

import json
import shutil
import subprocess
from bisect import bisect_right
from itertools import pairwise
from typing import Any

import pytest

from cocotb_tests.harness.paths import ROOT
from openppmc.check.comparison import compare_edges
from openppmc.check.records import Edge, steps
from scripts.fpga.flow.plain_sim import words
from scripts.site.pages import playground
from scripts.site.sessions import sessions
from scripts.site.webparts import WEB_PARTS, Motor, WebPart
from tests.common.slow import slow_if
from tests.common.web.counters import add, left_out
from tests.common.web.moves import MOVES
from tests.common.web.players import player
from tests.common.web.script import Player

pytestmark = pytest.mark.skipif(shutil.which("node") is None, reason="node is not installed")
LONG = 22_000_000
"""Maximum length of a session here, in cycles; a longer one takes more than half a minute on an idle
computer.
"""
HERE = ROOT / "tests/common/web"


def played(*jobs: tuple[str, str], clk: int = 0) -> list[dict[str, Any]]:
    """Return the results of (part, text) pairs, on the builds of the page or on those with this clock."""
    folder = playground()
    done = subprocess.run(
        ["node", str(HERE / "play.mjs"), str(folder.parent / "engine/engine.js"), str(folder)],
        input=json.dumps([{"part": part, "text": text, "clk": clk} for part, text in jobs]),
        capture_output=True,
        text=True,
        check=True,
    )
    return [json.loads(line) for line in done.stdout.splitlines()]


def edges(part: WebPart, rows: list[list[int]]) -> list[Edge]:
    """Return the output edges; the 32-bit words of a wide output are combined into one level."""
    outputs, levels = words(part.part, part.part.watched), part.part.reset_levels(part.params)
    found = []
    for t, word, value in rows:
        pin, place = outputs[word]
        levels[pin] = levels[pin] & ~(0xFFFFFFFF << 32 * place) | value << 32 * place
        found.append(Edge(int(t), pin, levels[pin]))
    return found


@pytest.mark.parametrize("name", slow_if(lambda name: name.startswith("ppmc312"), WEB_PARTS))
def test_sessions(name):
    """If the page plays a session of the manual, every byte and every edge is correct."""
    part, count = WEB_PARTS[name], 0
    plays = [(session.text, player(part).play(session.text)) for session in sessions(name)]
    left = left_out(name, [recording.end for _, recording in plays], LONG, "they take too long")
    plays = [(text, recording) for text, recording in plays if recording.end < LONG]
    texts = [text for text, _ in plays]
    for (_, recording), got in zip(plays, played(*((name, text) for text in texts)), strict=True):
        levels = part.part.reset_levels(part.params)
        initial = {pin: levels[pin] for pin in part.part.watched}
        assert got.get("bad") == [], got
        _, actual, mismatch = compare_edges(recording.edges, edges(part, got["edges"]), initial, got["end"])
        assert mismatch is None, mismatch
        assert got["end"] == recording.end
        count += sum(map(len, actual.values()))
    add(f"{name}: {len(texts)} sessions by the page's engine, {count} edges as in the golden model{left}")


def step_times(play: Player, motor: Motor) -> list[int]:
    """Return the cycles of a motor's steps on the golden model; chopping of the phases is not a step."""
    edges = play.bench.edges(play.output(motor))
    if not motor.phases:
        return [t for t, level in edges if level == motor.edge]
    return steps(edges)


def speed_at(speeds: dict[str, list[float]], t: float) -> float:
    """Return the speed that is drawn at t, in seconds."""
    return speeds["v"][bisect_right(speeds["t"], t) - 1]


@pytest.mark.parametrize("name", WEB_PARTS)
def test_speed_plot(name):
    """The plotted speed is 0 before the first step, then the frequency of each interval, then 0 again."""
    part, hz = WEB_PARTS[name], WEB_PARTS[name].config.clk_hz
    play = player(part)
    play.play(MOVES[name])
    (got,) = played((name, MOVES[name]))
    every = [step_times(play, motor) for motor in part.motors]
    assert any(every) and "error" not in got
    for times, speeds in zip(every, got["speeds"], strict=True):
        assert speed_at(speeds, 0) == 0
        if not times:
            assert max(speeds["v"]) == 0
            continue
        assert speed_at(speeds, (times[0] - 1) / hz) == 0
        for before, after in pairwise(times):
            assert speed_at(speeds, (before + after) / 2 / hz) == pytest.approx(hz / (after - before))
        if got["end"] - times[-1] > 8 * (times[-1] - times[-2]):
            assert speeds["v"][-1] == 0


def test_times_on_a_build_with_another_clock():
    """A number of cycles in a text is the same time on every build."""
    jobs = [("ppmc104", text) for text in ("wait 16000", "@16000 wait 0", "wait 1ms")]
    for page, board in zip(played(*jobs), played(*jobs, clk=24_000_000), strict=True):
        assert page["end"] >= 15_999
        assert board["end"] == pytest.approx(1.5 * page["end"], abs=2)


WRONG = (
    ("c 4G", "line 1: 4G: not a byte"),
    ("c 0A\nc", "line 2: missing word: not a byte"),
    ("hello", "line 1: no such statement: hello"),
    ("set l9_n=0", "line 1: PPMC-104 has no input l9_n"),
    ("set l1_n=2", "line 1: l1_n has 1 bit(s): 2 is out of range"),
    ("set l1_n", "line 1: l1_n: not a level"),
    ("wait 5 parsec", "line 1: no such statement: parsec"),
    ("wait 5m", "line 1: 5m: not a time"),
    ("until smoke 1", "line 1: PPMC-104 has no output smoke"),
    ("pulse 3 2", "line 1: there is no axis 2"),
    ("machine on 1 2", "line 1: machine: write six positions"),
    ("@x set l1_n=0", "line 1: @x: not a number of cycles"),
    ("# " + "x" * 200_000, "200000 at most"),
)

WRONG_ON_A_LINE = (
    ("axis 16", "line 1: there is no station 16; write 0 to 15"),
    ("unplug x", "line 1: x: not a valid station"),
    ("> 4", "line 1: 4: not bytes"),
    (">", "line 1: no instruction; write its code and data"),
    ("m", "line 1: no characters; write their bytes"),
    ("unplug 7\naxis 7; idle", "line 2: station 7 does not reply; plug connects it to the line"),
)


@pytest.mark.parametrize(("part", "texts"), [("ppmc104", WRONG), ("ppmc312-serial", WRONG_ON_A_LINE)])
def test_bad_input(part, texts):
    """For an invalid text, one line states the place and the reason."""
    for (text, wrong), got in zip(texts, played(*((part, text) for text, _ in texts)), strict=True):
        assert wrong in got.get("error", ""), (text[:40], got)


def test_a_wrong_reply_is_marked():
    """A reply that differs from the text is marked, and the session continues."""
    (got,) = played(("ppmc312-serial", "? 80\naxis 3; > 41\n< A0 13\nunplug 3\n? 90\n> 41\n< -"))
    assert got["bad"] == [
        "< 90: station 1: ready (the text expects 80)",
        "< A0 12: station 3: version 18 (the text expects A0 13)",
        "< -: no station replies (the text expects 90)",
    ]


def test_the_machine_stops_the_motor():
    """If the motor of the machine model reaches a switch, the motion ends there."""
    text = "machine on 0 -300 -150 0 1850 50\nc 0A d 09 d 04 d 04 d 00\nc 45 d 63\nuntil int_n 0\n"
    text += "c 80 r 95\nwait 100"
    (got,) = played(("ppmc104", text))
    assert got["bad"] == [], got
    part = WEB_PARTS["ppmc104"]
    falls = [edge.t for edge in edges(part, got["edges"]) if edge.signal == "pout_n" and not edge.value]
    assert len(falls) == 50
