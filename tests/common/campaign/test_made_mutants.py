"""Generated mutants: which code of a module they change, and the copy of a file that contains all mutants."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from subprocess import CalledProcessError

import pytest

from cocotb_tests.harness.compare import new_model
from cocotb_tests.harness.compare import replay as edges_of
from cocotb_tests.harness.project import ROOT, ProjectError
from openppmc.check.records import Change, Edge, Recording
from scripts.measure.campaign.jobs import Done
from scripts.measure.campaign.store import Store
from scripts.measure.mutants.made import equal, killed, page, replay, work
from scripts.measure.mutants.made.chosen import of_file, rtl_files, sample
from scripts.measure.mutants.made.faults import alone, faults
from scripts.measure.mutants.made.page import Tried, score
from scripts.measure.mutants.made.proved import proofs_of
from scripts.measure.mutants.made.schema import CHOSEN, instrumented
from scripts.measure.mutants.made.work import ALIVE, ENDLESS, EQUAL, KILLED, PROOF, Bulk, Mutant, met
from scripts.measure.syntax import findings

TEXT = """module m #(parameter int W = 4 + 1) (input wire logic clk_i, rst_ni, a, b, output logic [W-1:0] q);
  localparam int N = W * 2 - 1;
  assign unused_b = &{1'b0, b && a};
  if (W > 3) begin : g_wide
    other #(.W(W + 1)) u_other (.clk_i(clk_i), .en_i(a && b), .q_o());
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) q <= '0;
    else if (a) q <= a == b ? q + 1'b1 : {W{b}};
  end
`ifndef SYNTHESIS
  `PPMC_ASSERT(m_rule, a || b)
`endif
endmodule
"""


def test_what_is_changed() -> None:
    """Only code that runs is changed: no width, parameter, generate condition or assertion."""
    found = [(fault.line, fault.what) for fault in faults(TEXT)]
    assert {line for line, _ in found} == {5, 8, 9}
    assert {what for line, what in found if line == 5} == {
        "&& replaced by ||",
        "only left of &&",
        "only right of &&",
    }
    assert {what for line, what in found if line == 8} == {
        "never",
        "without !",
        "removed",
        "all bits inverted",
    }
    assert {what for line, what in found if line == 9} == {
        *(
            "always",
            "never",
            "removed",
            "condition inverted",
            "== replaced by !=",
            "+ replaced by -",
            "lowest bit inverted",
        ),
    }


def test_the_slice_of_a_stream_is_a_width() -> None:
    text = "module m (input a, b, output logic [15:0] q);\n  assign q = {<<8{a & b}};\nendmodule\n"
    assert [fault.what for fault in faults(text)] == ["& replaced by |"]


def test_a_copy_holds_all_and_keeps_lines() -> None:
    """The copy of a file contains every mutant with its number, and has the same number of lines as
    the file.
    """
    every = faults(TEXT)
    copy = instrumented(TEXT, every)
    assert copy.count("\n") == TEXT.count("\n")
    assert all(f"{CHOSEN} == {f.number})" in copy or f"{CHOSEN} != {f.number})" in copy for f in every)
    plain = instrumented(TEXT, [])
    assert plain.replace(plain[plain.index(f" int {CHOSEN}") : plain.index("\n")], "") == TEXT


def test_recordings_kill_mutants(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """A recording without inputs kills mutants of the idle level, but not those of a pulse. A recording with
    which the RTL does not agree kills none.
    """
    right = Recording("ppmc104", PARAMS, end=100)
    wrong = replace(right, end=90, edges=[Edge(50, "pout_n", 0)])
    found = _replayed(monkeypatch, tmp_path, "rtl/motion/ppmc_pulse_shaper.sv", right=right, wrong=wrong)
    assert set(found.values()) == {"recording right"}
    assert 0 < len(found) < len(of_file("rtl/motion/ppmc_pulse_shaper.sv")) // 2


def test_power_up_differs_between_recordings(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """Registers have other random values at power-up in each recording, also if the recordings are equal."""
    copies = {f"copy{n}": Recording("ppmc104", PARAMS, end=100) for n in range(20)}
    found = _replayed(monkeypatch, tmp_path, "rtl/motion/ppmc_hold_timer.sv", **copies)
    assert len(set(found.values())) > 1


def test_a_mutant_that_differs_late(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """A mutant that first differs from the RTL at a read, long after the reset, is killed."""
    file = "rtl/host/ppmc_strobe_bus.sv"
    found = _replayed(monkeypatch, tmp_path, file, access=_access())
    here = [one for one in of_file(file) if "d_o <= a0_i" in page.lines(file)[one.line - 1]]
    assert {"never", "condition inverted"} <= {one.what for one in here if f"{file} {one.number}" in found}


def test_missing_registers_end_the_replay(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    """A replay that does not know some registers would drop mutants that differ only in these registers."""
    every = replay.registers
    monkeypatch.setattr(replay, "registers", lambda *files: [*every(*files)][:1])
    with pytest.raises(CalledProcessError):
        _replayed(monkeypatch, tmp_path, "rtl/host/ppmc_strobe_bus.sv", access=_access())
    assert "a register is missing" in capfd.readouterr().err


def _access() -> Recording:
    """Return the recording of a write access and a read access to a PPMC-104."""
    write = [(30, "cs_n", 0), (30, "wr_n", 0), (30, "d_i", 0xF9), (40, "wr_n", 1), (40, "cs_n", 1)]
    read = [(70, "cs_n", 0), (70, "rd_n", 0), (70, "a0", 1), (80, "rd_n", 1), (80, "cs_n", 1)]
    recording = Recording("ppmc104", PARAMS, end=100, stimulus=[Change(*row) for row in write + read])
    recording.edges = edges_of(recording, new_model("ppmc104", PARAMS))
    return recording


PARAMS: dict[str, object] = {"CLK_HZ": 16_000_000, "XTAL_HZ": 16_000_000, "TIMING": "FAST"}


def _replayed(
    monkeypatch: pytest.MonkeyPatch, folder: Path, file: str, **recordings: Recording
) -> dict[str, str]:
    """Replay the recordings into all mutants of a file; return the killed mutants, which must be stored."""
    monkeypatch.setattr(replay, "folder", lambda: folder)
    monkeypatch.setattr(killed, "Store", lambda: Store(folder / "results.sqlite"))
    monkeypatch.setattr(replay, "FEWEST", 1)
    for name, recording in recordings.items():
        (folder / f"{name}.json").write_text(recording.to_json(), encoding="ascii")
    replay.designs.cache_clear()
    done = replay.replayed(Bulk(tuple((file, fault.number) for fault in of_file(file))))
    replay.designs.cache_clear()
    found: dict[str, str] = done.data["found"]
    with Store(folder / "results.sqlite") as store:
        assert set(killed.known(store)) == set(found)
    return found


def test_equal_mutants(monkeypatch: pytest.MonkeyPatch) -> None:
    """A comparison that is used only after a strobe may be stored in every cycle. The other conditions of the
    block cannot always be true. A mutant that no part contains is not equal.
    """
    monkeypatch.setattr(equal, "settings", lambda _row: [("", {})])
    monkeypatch.setattr(equal, "LONGEST", 10)
    file, other = "rtl/pmc006/drive/pmc006_stall.sv", "rtl/ppmc104/ppmc104_proc_time.sv"
    always = {fault.number: fault.line for fault in of_file(file) if fault.what == "always"}
    found = equal.equal(Bulk(tuple((file, number) for number in always))).data["found"]
    assert [page.lines(file)[always[int(key.split()[1])] - 1].split("(")[1] for key in found] == [
        "sample_i.valid) low_q <= sample_i.level < {1'b0, limit_i};"
    ]
    assert len(always) == 3
    assert not equal.equal(Bulk(tuple((other, fault.number) for fault in of_file(other)))).data["found"]


def test_another_machine_continues(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """A machine without results reads the killed mutants from docs/killed.json, but only those of unchanged
    files.
    """
    monkeypatch.setattr(killed, "PAGE", tmp_path / "killed.json")
    monkeypatch.setattr(killed, "Store", lambda: Store(tmp_path / "results.sqlite"))
    killed.load()
    files = ("rtl/motion/ppmc_pulse_shaper.sv", "rtl/common/ppmc_sync.sv", "rtl/common/ppmc_timer.sv")
    with Store(tmp_path / "results.sqlite") as store:
        for file, number, verdict, test in (
            (files[0], 1, KILLED, "a test"),
            (files[0], 2, KILLED, f"{PROOF}p"),
            (files[0], 3, ALIVE, ""),
            (files[0], 4, KILLED, "a test"),
            (files[0], 5, EQUAL, ""),
            (files[1], 1, KILLED, "a test"),
            (files[2], 1, ALIVE, ""),
        ):
            data = {"verdict": verdict, "test": test, "file": work.digest(file)}
            store.note(killed.NAME, "now", Done(f"{file} {number}", True, data, 1.0))
    killed.save()
    text = killed.PAGE.read_text(encoding="ascii")
    killed.PAGE.write_text(text.replace(work.digest(files[1]), "of another file"), encoding="ascii")
    (tmp_path / "results.sqlite").unlink()
    killed.load()
    with Store(tmp_path / "results.sqlite") as store:
        done = [done for _, done in killed.known(store).values()]
    assert {(one.key, one.data["verdict"], one.data["test"].startswith(PROOF)) for one in done} == {
        (f"{files[0]} 1", KILLED, False),
        (f"{files[0]} 2", KILLED, True),
        (f"{files[0]} 4", KILLED, False),
        (f"{files[0]} 5", EQUAL, False),
    }


def test_one_alone() -> None:
    """The file of a single mutant is valid SystemVerilog, and no two mutants have the same file."""
    texts = [alone(TEXT, fault) for fault in faults(TEXT)]
    assert len({*texts, TEXT}) == len(texts) + 1
    assert all(findings(text) == findings(TEXT) for text in texts)
    assert any("else if (a) begin end" in text for text in texts)
    assert any("en_i(((a) || (b)))" in text for text in texts)


def test_proofs_of_a_file() -> None:
    """Proofs of the block in a file are listed separately from proofs of blocks that contain this block.

    If it has no proof of its own, the proofs of blocks in its folder that contain it take their place.
    """
    own, others = proofs_of("rtl/motion/ppmc_stop_monitor.sv")
    assert {one.block for one in own} == {"ppmc_stop_monitor"}
    assert {"ppmc_axis", "ppmc_proc_time"} & {one.block for one in others}
    assert "ppmc_uart_rx" not in {one.block for one in others}
    own, others = proofs_of("rtl/ppmc312/front/ppmc312_serial_poll.sv")
    assert {one.block for one in own} == {"ppmc312_serial_reply", "ppmc312_serial"}
    assert {one.block for one in others} == {"ppmc312"}
    assert proofs_of("rtl/ppmc312/stages/ppmc312_stage_unit.sv")[0] == []
    assert proofs_of("rtl/pmc006/pmc006_carrier.sv") == ([], [])


@pytest.mark.parametrize(
    "proof, group, wanted",
    [
        ("ppmc_stop_monitor", None, ["own"]),
        (None, "a", ["own", "a"]),
        (None, "b", ["own", "a", "b"]),
        ("ppmc_axis_stop", None, ["own", "a", "b", "others"]),
        (None, None, ["own", "a", "b", "others"]),
    ],
)
def test_order_of_what_a_mutant_meets(
    monkeypatch: pytest.MonkeyPatch, proof: str | None, group: str | None, wanted: list[str]
) -> None:
    """After the first check that a mutant fails, no further check runs, and the result names this check."""
    file, tried = "rtl/motion/ppmc_stop_monitor.sv", []
    own = proofs_of(file)[0]

    def failing(_file: str, _fault: object, chosen: list[object]) -> str:
        tried.append("own" if chosen == own else "others")
        return next((one.name for one in chosen if one.name == proof), "")  # type: ignore[attr-defined]

    def pytest_of(_mutant: Mutant, tests: tuple[str, ...]) -> tuple[str, str]:
        tried.append(tests[0])
        return (KILLED, "a test") if tests[0] == group else (ALIVE, "")

    monkeypatch.setattr(work, "failing", failing)
    monkeypatch.setattr(work, "pytest", pytest_of)
    mutant = Mutant(file, faults(TEXT)[0], (("a",), ("b",)))
    by = PROOF + proof if proof else "a test" if group else ""
    assert met(mutant) == (KILLED if by else ALIVE, by) and tried == wanted
    tried.clear()
    met(Mutant(file, mutant.fault, mutant.groups, briefly=True))
    assert tried == [one for one in wanted if one != "others"]


def test_letters_of_several_bytes() -> None:
    """Multi-byte characters in comments do not change the mutants or their places."""
    text = TEXT.replace("begin\n", "begin  // 0 µs, 1 …\n")
    assert [text[fault.start : fault.end] for fault in faults(text)] == [
        TEXT[fault.start : fault.end] for fault in faults(TEXT)
    ]


def test_every_file_can_be_changed() -> None:
    """The copy of each file of rtl/ is valid SystemVerilog with the same number of lines.

    There are more than 10 000 mutants in all.
    """
    count = 0
    for file in rtl_files():
        text = (ROOT / file).read_text(encoding="utf-8")
        every = faults(text)
        count += len(every)
        copy = instrumented(text, every)
        assert copy.count("\n") == text.count("\n"), file
        assert findings(copy) == findings(text), file
    assert count > 10_000


def test_a_sample_keeps_what_it_has() -> None:
    """A sample contains `count` mutants of each folder; a larger sample contains each smaller one."""
    files = [*rtl_files("motion"), *rtl_files("common")]
    few, more = ({(file, fault.number) for file, fault in sample(files, n)} for n in (5, 20))
    assert len(few) == 10 and len(more) == 40 and few < more
    with pytest.raises(ProjectError, match="T=nowhere: no such folder or file"):
        rtl_files("nowhere")


def test_scores(monkeypatch: pytest.MonkeyPatch) -> None:
    """Mutants whose tests do not end, and equivalent mutants, are counted separately from survivors."""
    file = "rtl/common/ppmc_sync.sv"
    fault = faults(TEXT)[0]
    tried = [Tried(file, fault, verdict, "") for verdict in (KILLED, KILLED, ENDLESS, ALIVE)]
    tried += [Tried(file, fault, KILLED, f"{PROOF}ppmc_sync"), Tried(file, fault, EQUAL, "")]
    found = score(tried, 9)
    assert (found.percent, found.killed, found.proved, found.endless, found.alive) == (75, 3, 1, 1, 1)
    assert found.equivalent == 1
    monkeypatch.setattr(page, "judged", lambda: {(file, tried[0].source, fault.what): "the same"})
    assert (found := score(tried, 9)).percent == 100 and found.equivalent == 2 and found.alive == 0
    assert "equivalent: the same" in page.page(tried, [file], page.QUICK)


def test_judged_mutants_fit_the_tree() -> None:
    """Each entry of judged.yml names a line that the source file still contains, and gives a reason."""
    assert all(page.judged().values())
