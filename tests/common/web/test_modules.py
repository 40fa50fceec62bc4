"""Every module of the playground against the golden model: sessions of the manuals, random hosts, size."""

from __future__ import annotations

import time
from functools import cache
from itertools import islice

import pytest

from cocotb_tests.harness.paths import ROOT
from openppmc.check.comparison import compare_edges
from openppmc.check.records import Recording
from scripts.site import wasm
from scripts.site.sessions import sessions
from scripts.site.webparts import BUILDS, WEB_PARTS, WebPart
from tests.common.slow import slow_if
from tests.common.web import hosts
from tests.common.web.counters import add, left_out
from tests.common.web.module import Module
from tests.common.web.moves import MOVES
from tests.common.web.players import player
from tests.common.web.script import ScriptError

HOSTS = 50
LINE_HOSTS = 12  # a run of sixteen stations takes ten times as long
LONG = 10_000_000
"""Maximum length of a session here, in cycles. Longer ones are played by test_engine.py, except those that
take minutes.
"""
SLOWEST = 0.3
"""Minimum speed of a WebAssembly module, relative to native code."""
every = pytest.mark.parametrize("name", WEB_PARTS)
lines_slow = pytest.mark.parametrize("name", slow_if(lambda name: bool(WEB_PARTS[name].stations), WEB_PARTS))


@cache
def module(name: str) -> Module:
    """Return the module of a build."""
    return Module(BUILDS[name], wasm.build(name))


def compared(name: str, recording: Recording) -> int:
    """Compare a module with a recording of the golden model; return the number of equal edges.

    Raises AssertionError at a difference.
    """
    part = BUILDS[name]
    levels = part.part.reset_levels(recording.params)
    initial = {pin: levels[pin] for pin in part.part.watched}
    resets = [change.t for change in recording.stimulus if change.pin == "rst_n" and not change.value]
    edges = module(name).play(recording)
    _, actual, mismatch = compare_edges(recording.edges, edges, initial, recording.end, resets)
    assert mismatch is None, f"seed {recording.seed}: {mismatch}"
    return sum(map(len, actual.values()))


@lines_slow
def test_sessions_of_the_manual(name):
    """In each session of the manual, every byte is the printed one, and every edge is that of the golden
    model.
    """
    part, counts, ends = WEB_PARTS[name], [], []
    for session in sessions(name):
        recording = player(part).play(session.text)
        ends.append(recording.end)
        if recording.end < LONG:
            counts.append(compared(name, recording))
    left = left_out(name, ends, LONG, "left to the page's engine")
    add(f"{name}: {len(counts)} sessions of the manual, {sum(counts)} edges as in the golden model{left}")
    assert sum(counts) > 1000


@lines_slow
def test_random_hosts(name):
    """With random hosts, the module changes every output on the same edges as the golden model."""
    part = WEB_PARTS[name]
    number = LINE_HOSTS if part.stations else HOSTS
    counts = [compared(name, hosts.recorded(part, seed)) for seed in islice(hosts.seeds(part), number)]
    add(f"{name}: {number} random hosts, {sum(counts)} edges as in the golden model")
    assert len(counts) == number and min(counts) > 10


@pytest.mark.parametrize("name", sorted(BUILDS.keys() - WEB_PARTS.keys()))
def test_a_move_on_the_builds_for_boards(name):
    """With the parameters of a board, every edge of a move is that of the golden model."""
    build = BUILDS[name]
    count = compared(name, player(build).play(MOVES[build.name]))
    add(f"{name}: {count} edges of a move as in the golden model")
    assert count > 100


@pytest.mark.parametrize("name", BUILDS)
def test_size(name):
    """A web server sends less than 200 KB for each module."""
    size = wasm.packed(wasm.build(name))
    add(f"{name}: {size / 1024:.0f} KB packed")
    assert size < wasm.MOST


@every
def test_no_path_of_this_machine(name):
    """A module contains no path of this computer, so another checkout produces the same bytes."""
    assert str(ROOT).encode() not in wasm.build(name).read_bytes()


def test_a_wrong_edge_is_found():
    """If one edge of a recording is one cycle late, the comparison names this edge."""
    part = WEB_PARTS["ppmc104"]
    recording = player(part).play("c 0A d 09 d 04 d 04 d 00 c 43 d 0D d 00 d 00 pulse 14 1")
    place = next(n for n, edge in enumerate(recording.edges) if edge.signal == "pout_n")
    recording.edges[place] = recording.edges[place]._replace(t=recording.edges[place].t + 1)
    with pytest.raises(AssertionError, match="pout_n"):
        compared("ppmc104", recording)


def test_a_wrong_byte_is_found():
    """A session with a wrong byte or an invalid line is rejected with the number of the line."""
    part = WEB_PARTS["ppmc104"]
    for text, wrong in (
        ("c 82\nr FD", "line 2: r FD: data is FC"),
        ("c 82\nq", "line 2: no such statement: q"),
    ):
        with pytest.raises(ScriptError, match=wrong):
            player(part).play(text)


def speed(part: WebPart, native: bool) -> float:
    """Return the speed in million cycles per second, with pulses running."""
    made = Module(part, wasm.build(part.name, native))
    made.play(player(part).play("c 0A d 09 d 04 d 04 d 00 c 43 d FF d FF d 7F wait 2000"))
    clk, begin = 4_000_000, time.process_time()
    for _ in range(4):
        made.call["run"](clk / 4, 0)
        made.call["take"]()
    return clk / (time.process_time() - begin) / 1e6


def test_speed():
    """With pulses running, WebAssembly reaches at least 0.3 of the speed of native code."""
    part = WEB_PARTS["ppmc104"]
    native, module_speed = speed(part, native=True), speed(part, native=False)
    add(
        f"ppmc104: {module_speed:.1f} million cycles/s as WebAssembly, {native:.1f} native: "
        f"{module_speed / native:.2f} of it"
    )
    assert module_speed / native > SLOWEST
