"""The comparator: equal runs pass, each wrong edge is reported, and the files show where it is."""

from __future__ import annotations

import random
from pathlib import Path
from time import process_time

import pytest

from cocotb_tests.harness.compare import compare_recording, write_report
from cocotb_tests.ppmc104.bench import PPMC104
from openppmc import errors
from openppmc.check.comparison import compare_edges, differing_spans
from openppmc.check.records import Access, Change, Edge, Recording
from openppmc.check.report import report

INITIAL = PPMC104.reset_levels()


def move(n: int = 14, start: int = 400, interval: int = 320, low: int = 80) -> list[Edge]:
    """Return the output edges of a move of n pulses in 4-phase full step, with a status read during
    the move.
    """
    rows = [Edge(start - 81, "hold", 0), Edge(start - 300, "s", 0b00011)]
    for j in range(n):
        t = start + j * interval
        rows.append(Edge(t, "pout_n", 0))
        rows.append(Edge(t, "s", (0b00110, 0b01100, 0b01001, 0b00011)[j % 4]))
        rows.append(Edge(t + low, "pout_n", 1))
    end = start + (n - 1) * interval + low
    rows += [Edge(end, "int_n", 0), Edge(1000, "d_oe", 1), Edge(1001, "d_o", 0x04), Edge(1004, "d_oe", 0)]
    return sorted(rows)


class Scripted:
    """Replacement for a model: it records the changes of its pins and returns a fixed list of edges."""

    def __init__(self, edges: list[Edge]) -> None:
        self.edges = edges
        self.seen: list[tuple[int, dict[str, int]]] = []
        self.end = -1

    def pins(self, t: int, **levels: int) -> None:
        self.seen.append((t, levels))

    def run_until(self, t: int) -> None:
        self.end = t


def recording(edges: list[Edge], end: int = 6000) -> Recording:
    stimulus = [
        Change(300, "cs_n", 0),
        Change(300, "wr_n", 0),
        Change(302, "cs_n", 1),
        Change(302, "wr_n", 1),
    ]
    stimulus += [Change(1700, "l3_n", 0), Change(2300, "l3_n", 1)]
    accesses = [Access(302, "write", 1, 0x43), Access(1000, "read", 1, 0x04), Access(1010, "read", 1, 0x04)]
    accesses += [Access(1790, "write", 1, 0x41), Access(1800, "write", 0, 0x11)]
    params = {"CLK_HZ": 16_000_000, "XTAL_HZ": 16_000_000, "TIMING": "FAST", "PHASE_IDLE": 1}
    return Recording("ppmc104", params, 7, end, stimulus, edges, accesses)


def test_equal_runs_have_no_mismatch() -> None:
    result = compare_recording(recording(move()), Scripted(move()))
    assert result.mismatch is None
    assert result.edges_compared == 14 * 3 + 6
    assert "no difference" in report(result)


def test_replay_groups_pins_by_edge_and_runs_to_the_end() -> None:
    model = Scripted(move())
    compare_recording(recording(move(), end=5555), model)
    assert model.seen[0] == (300, {"cs_n": 0, "wr_n": 0})
    assert [t for t, _ in model.seen] == [300, 302, 1700, 2300]
    assert model.end == 5555


@pytest.mark.parametrize("seed", range(40))
def test_any_single_wrong_edge_is_found(seed: int) -> None:
    rng = random.Random(seed)
    edges = move()
    place = rng.randrange(len(edges))
    old = edges[place]
    kind = rng.choice(("moved", "dropped", "value", "added"))
    if kind == "moved":
        edges[place] = old._replace(t=old.t + rng.choice((-1, 1)))
    elif kind == "dropped":
        del edges[place]
    elif kind == "value":
        if old.signal in ("s", "d_o"):
            edges[place] = old._replace(value=old.value ^ 0x10)
        else:
            del edges[place]
    else:
        edges.append(Edge(rng.randrange(10, 5000), "aux_n", 0))
    result = compare_recording(recording(sorted(edges)), Scripted(move()))
    assert result.mismatch is not None, kind
    wrong = "aux_n" if kind == "added" else old.signal
    assert result.mismatch.signal == wrong
    assert wrong in result.mismatch.differing


def test_first_difference_in_time_wins_over_signal_order() -> None:
    edges = [e._replace(t=e.t + 3) if e.t == 400 + 320 * 5 and e.signal == "s" else e for e in move()]
    edges = [e._replace(t=e.t + 1) if e.t == 400 + 320 * 9 and e.signal == "pout_n" else e for e in edges]
    found = compare_recording(recording(sorted(edges)), Scripted(move())).mismatch
    assert found is not None
    assert (found.t, found.signal) == (2000, "s")
    assert found.differing == ("s", "pout_n")
    assert found.expected is not None and found.actual is not None
    assert (found.expected[0], found.actual[0]) == (2000, 2003)


def test_edges_after_the_end_do_not_count() -> None:
    late = [*move(), Edge(5001, "aux_n", 0)]
    assert compare_recording(recording(late, end=5000), Scripted(move())).mismatch is None
    assert compare_recording(recording(late, end=5001), Scripted(move())).mismatch is not None


def test_repeated_levels_are_not_edges() -> None:
    doubled = sorted([*move(), Edge(5100, "hold", 0), Edge(5200, "aux_n", 1)])
    assert compare_recording(recording(doubled), Scripted(move())).mismatch is None


def test_asynchronous_reset_edges_have_one_clk_of_tolerance_and_no_more() -> None:
    want = [Edge(100, "hold", 0), Edge(150, "hold", 1)]

    def differs(t: int, resets: list[int]) -> bool:
        got = [Edge(100, "hold", 0), Edge(t, "hold", 1)]
        return compare_edges(want, got, INITIAL, 1000, resets)[2] is not None

    assert not differs(149, [150])
    assert not differs(150, [150])
    assert differs(148, [150])
    assert differs(151, [150])
    assert differs(149, [])


def test_report_without_the_extra(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """If the packages of the extra are missing, text and recording are written, and the error names a
    package.
    """
    edges = [e._replace(t=e.t + 2) if e.t == 2000 else e for e in move()]
    result = compare_recording(recording(sorted(edges)), Scripted(move()))
    monkeypatch.setattr(errors, "find_spec", lambda module: None)
    with pytest.raises(errors.MissingExtraError, match=r"openppmc\[plot\]"):
        write_report(result, tmp_path)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["compare.txt", "recording.json"]


def test_report_and_files(tmp_path: Path) -> None:
    edges = sorted(
        [e._replace(t=e.t + 2) if e.t in (2000, 2640) and e.signal in ("s", "pout_n") else e for e in move()]
    )
    result = compare_recording(recording(edges), Scripted(move()))
    text = write_report(result, tmp_path, "make test T=x SEED=7 CLK_HZ=16000000")
    for piece in (
        "first difference at edge 2000",
        "s: expected 0xc at 2000, got 0xc at 2002",
        "golden model:",
        "RTL:",
        "l3_n = 0x0",
        "command 41",
        "status  04  (x2)",
        "seed 7",
        "make test T=x SEED=7 CLK_HZ=16000000",
    ):
        assert piece in text, f"{piece!r} is not in the report:\n{text}"
    neighbours = text.split("golden model:")[1].split("RTL:")[0]
    assert len(neighbours.strip().splitlines()) == 16
    assert (tmp_path / "compare.txt").read_text(encoding="utf-8").strip() == text
    assert (tmp_path / "compare.png").read_bytes().startswith(b"\x89PNG")
    assert (tmp_path / "compare.png").stat().st_size > 10_000
    vcd = (tmp_path / "compare.vcd").read_text(encoding="ascii")
    for scope in ("expected", "actual", "differs", "pins"):
        assert f"$scope module {scope} $end" in vcd
    assert f"#{2000 * 62500}\n" in vcd and f"#{2002 * 62500}\n" in vcd
    again = Recording.from_json((tmp_path / "recording.json").read_text(encoding="utf-8"))
    assert again == recording(edges)


def test_differing_spans_cover_exactly_the_wrong_time() -> None:
    edges = sorted([e._replace(t=e.t + 2) if (e.t, e.signal) == (2000, "pout_n") else e for e in move()])
    result = compare_recording(recording(edges), Scripted(move()))
    assert differing_spans(result, "pout_n") == [(2000, 1), (2002, 0)]
    assert differing_spans(result, "s") == []


def test_a_long_recording_is_reported_in_seconds(tmp_path: Path) -> None:
    """A report about 60 000 edges takes a few seconds of CPU time; with a linear search for each edge it
    would take minutes.
    """
    long = move(20_000)
    edges = sorted([*long[:-1], long[-1]._replace(t=long[-1].t + 2)])
    result = compare_recording(recording(edges, edges[-1].t + 10), Scripted(long))
    begin = process_time()
    write_report(result, tmp_path)
    assert process_time() - begin < 30


def test_missing_and_extra_tail_edges_are_drawn_too(tmp_path: Path) -> None:
    for number, edges in enumerate((move(13), move(15))):
        result = compare_recording(recording(edges), Scripted(move()))
        assert result.mismatch is not None
        write_report(result, tmp_path / str(number))
        assert (tmp_path / str(number) / "compare.png").stat().st_size > 10_000
