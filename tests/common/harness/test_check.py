"""Replay of recorded inputs on golden models with `openppmc.check`, as users of recordings call it."""

from __future__ import annotations

import pytest

from openppmc import parts
from openppmc.check.pins import pins_of
from openppmc.check.records import Change, Edge, Recording
from openppmc.check.replay import compare_recording, expected_edges, new_model

PARAMS = {"CLK_HZ": 24_000_000}
MODELS = [row.name for row in parts.folders()]


def accesses() -> list[Change]:
    """Return the pin changes of an initialisation and a move of 14 pulses."""
    rows, t = [], 100
    for register, byte in [(1, 0x0A), (0, 9), (0, 4), (0, 4), (0, 0), (1, 0x43), (0, 13), (0, 0), (0, 0)]:
        rows += [Change(t, "a0", register), Change(t, "d_i", byte), Change(t, "cs_n", 0)]
        rows += [Change(t + 1, "wr_n", 0), Change(t + 5, "wr_n", 1), Change(t + 6, "cs_n", 1)]
        t += 60_000 if byte == 0 and register == 0 else 40
    return rows


@pytest.mark.parametrize("reset", [False, True])
def test_a_move(reset: bool) -> None:
    """The replay of a move returns all edges in order, also if the recording contains a reset."""
    changes = accesses()
    if reset:
        changes = [Change(0, "rst_n", 0), Change(16, "rst_n", 1), *changes]
    edges = expected_edges("ppmc104", PARAMS, changes, 400_000)
    assert sum(edge.signal == "pout_n" and edge.value == 0 for edge in edges) == 14
    assert [edge.t for edge in edges] == sorted(edge.t for edge in edges)
    same = compare_recording(Recording("ppmc104", PARAMS, end=400_000, stimulus=changes, edges=edges))
    assert same.mismatch is None and same.edges_compared == len(edges) and same.pulses == 14


def test_a_late_edge_is_found() -> None:
    """If one edge is one cycle late, it is reported as the first difference."""
    changes = accesses()
    edges = expected_edges("ppmc104", PARAMS, changes, 400_000)
    place = next(n for n, edge in enumerate(edges) if edge.signal == "pout_n")
    late = edges[place]
    edges[place] = Edge(late.t + 1, *late[1:])
    found = compare_recording(Recording("ppmc104", PARAMS, end=400_000, stimulus=changes, edges=edges))
    assert found.mismatch is not None
    assert (found.mismatch.t, found.mismatch.signal) == (late.t, "pout_n")


@pytest.mark.parametrize("part", MODELS)
def test_pins_of_every_part(part: str) -> None:
    """The table has each pin of a golden model with its width and idle level."""
    pins = pins_of(new_model(part, {}))
    assert "rst_n" not in pins.inputs and pins.bus_pins <= set(pins.inputs) and pins.outputs
    assert all(0 <= level < 1 << pins.width(pin) for pin, level in {**pins.inputs, **pins.outputs}.items())


def test_bad_inputs() -> None:
    """A pin that does not exist, or a level that it cannot have, causes a ValueError that names the pin."""
    for row in (Change(5, "colour", 1), Change(5, "cs_n", 2)):
        with pytest.raises(ValueError, match=row.pin):
            expected_edges("ppmc104", PARAMS, [row], 10)
