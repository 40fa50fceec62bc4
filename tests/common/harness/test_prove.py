"""The table of proofs agrees with the tree (wrappers, rules, faults); each mistake of a user causes one line.

`make prove` runs the proofs themselves. They need yosys, which `make test` does not use.
"""

from __future__ import annotations

import re
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest

from cocotb_tests.harness.paths import ROOT
from cocotb_tests.harness.project import RTL, ProjectError
from scripts.measure.prove import engine, results
from scripts.measure.prove.check import Outcome
from scripts.measure.prove.page import ROOMS, text, unproved
from scripts.measure.prove.results import by_rule
from scripts.measure.prove.table import FORMAL, Proof, chosen, proofs

EVERY = list(proofs())
SOURCES = Proof.sources
each = pytest.mark.parametrize("proof", EVERY, ids=lambda proof: proof.name)


@each
def test_a_proof_fits_the_tree(proof: Proof) -> None:
    """Wrapper and block exist, the labels are in the wrapper, and the text that `breaks` changes is in the
    RTL.
    """
    text = proof.file.read_text(encoding="utf-8")
    included = re.findall(r'`include "(\w+/\w+\.svh)"', text)
    text = "\n".join([text, *((FORMAL / name).read_text(encoding="utf-8") for name in included)])
    assert f"module {proof.file.stem}" in text and re.search(rf"\b{proof.block}\b", text)
    assert list(RTL.rglob(f"{proof.block}.sv"))
    assert all(label.startswith("dut.") or label in text for label in proof.only)
    assert all((FORMAL / stub).is_file() for stub in proof.stubs)
    assert proof.says and proof.cover and bool(proof.bound) == bool(proof.why)
    for change in proof.broken():
        assert change.text != (ROOT / change.file).read_text(encoding="utf-8")
        assert ROOT / change.file in proof.sources() or proof.stubs
    assumed = set(re.findall(r"`FV_ASSUME\(\s*(\w+)", text))
    assert set(proof.assumes) == assumed


def test_every_wrapper_has_an_entry() -> None:
    """Each file of tb/formal is used, each proof has a unique name, and each assumption is documented."""
    names = [one.name for one in EVERY]
    assert len(names) == len(set(names))
    stubs = {FORMAL / stub for one in EVERY for stub in one.stubs}
    assert set(FORMAL.rglob("*.sv")) == {one.file for one in EVERY} | stubs


def test_every_block_has_a_proof() -> None:
    """Each block of the shared folders has a proof; packages, which have no state, are exempt."""
    assert set(unproved(EVERY)) == {
        path.stem for room in ROOMS for path in (RTL / room).glob("*.sv") if path.stem.endswith("_pkg")
    }


def test_packages_are_in_the_proofs_of_who_calls_them() -> None:
    """Each package of the shared folders is used by a proof, and the page lists the proof."""
    page = text()
    for package, by in unproved(EVERY).items():
        assert by, package
        assert f"| {package} |" in page


def test_rules_are_known() -> None:
    """Each rule that a proof names exists on a page of docs/."""
    pages = "".join(path.read_text(encoding="utf-8") for path in (ROOT / "docs").rglob("*.md"))
    assert [rule for rule in by_rule() if not re.search(rf"^\| *`?{rule}`? *\|", pages, re.M)] == []


def test_names_choose() -> None:
    """A full name selects one proof; a part of a name selects all proofs whose names contain it.

    Without a name, all quick proofs are selected. A word that matches no proof raises an error of one line.
    """
    assert [one.name for one in chosen(["ppmc_sync"], night=False)] == ["ppmc_sync"]
    assert {one.name for one in chosen(["ppmc_axis_"], night=False)} > {"ppmc_axis_stop"}
    assert chosen([], night=True) == EVERY
    assert chosen([], night=False) == [one for one in EVERY if not one.night]
    with pytest.raises(ProjectError, match=r"T=nosuch: no such proof \(known: "):
        chosen(["ppmc_sync", "nosuch"], night=False)


def test_unknown_proof_in_one_line() -> None:
    """An unknown name ends the command with a non-zero code and one line."""
    done = subprocess.run(
        [sys.executable, "-m", "scripts.measure.prove", "nosuch"],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=False,
    )
    said = (done.stdout + done.stderr).strip()
    assert done.returncode and "T=nosuch: no such proof" in said and said.count("\n") == 0


def test_missing_tool_in_one_line(monkeypatch: pytest.MonkeyPatch) -> None:
    """Without pyosys, the command prints one line that states what to do."""
    monkeypatch.setattr(engine, "find_spec", lambda name: None)
    with pytest.raises(ProjectError, match="yosys-abc: not found.*make setup"):
        engine.abc()


def test_messages_of_abc(monkeypatch: pytest.MonkeyPatch) -> None:
    """ABC's output is classified as proved, failed (with output and cycle) or open; never as proved by
    mistake.
    """
    answers: list[str] = []
    monkeypatch.setattr(engine, "ask", lambda folder, what, script: answers.pop(0) if answers else "")
    here = Path(".")
    answers[:] = ["Property proved.  Time =     0.25 sec"]
    assert engine.prove(here, 0, 10) == (engine.PROVED, {})
    undecided = "Reached timeout (5 seconds) in frame 9.\nProperty UNDECIDED."
    answers[:] = 3 * [undecided]
    assert engine.prove(here, 0, 10) == (engine.OPEN, {})
    answers[:] = [undecided, "Property proved."]
    assert engine.prove(here, 0, 10) == (engine.PROVED, {})
    answers[:] = [
        'Output 0 of miter "x" was asserted in frame 7.',
        'Output 3 of miter "x" was asserted in frame 7.',
    ]
    assert engine.prove(here, 0, 10) == (engine.FAILED, {3: 7})
    answers[:] = ["No output asserted in 40 frames. Resource limit reached (conf limit 0)."]
    assert engine.prove(here, 40, 10) == (engine.PROVED, {})
    answers[:] = ["No output asserted in 13 frames. Resource limit reached (timeout 10 sec)."]
    assert engine.prove(here, 40, 10) == (engine.OPEN, {})
    base, step = "No output asserted in 24 frames.", "Networks are equivalent.  Time =     7.52 sec"
    answers[:] = [base, step]
    assert engine.prove(here, 0, 10, induct=4) == (engine.PROVED, {})
    answers[:] = [base, "Networks are UNDECIDED.  Time =     0.02 sec"]
    assert engine.prove(here, 0, 10, induct=4) == (engine.OPEN, {})
    answers[:] = ["No output asserted in 9 frames. Resource limit reached (timeout 10 sec).", step]
    assert engine.prove(here, 0, 10, induct=4) == (engine.OPEN, {})
    answers[:] = ['Output 2 of miter "x" was asserted in frame 6.', step]
    assert engine.prove(here, 0, 10, induct=4) == (engine.FAILED, {2: 6})
    answers[:] = ["Output 1 was asserted in frame  5 (solved 1 out of 2 outputs)."]
    assert engine.covered(here, 40, 10) == {1: 5}
    answers[:] = [""]
    assert engine.prove(here, 0, 10) == (engine.OPEN, {})


def test_a_witness_gets_the_registers_back_that_the_search_has_thrown_away(tmp_path: Path) -> None:
    (tmp_path / "prove.aig").write_bytes(b"aig 9 2 5 0 2 1\n")
    (tmp_path / "prove.aiw").write_text("000\n01\n11")
    engine.fill(tmp_path)
    assert (tmp_path / "prove.aiw").read_text() == "00000\n01\n11"


def test_a_proof_is_skipped_only_if_nothing_has_changed(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """A proof that succeeded is skipped until its code, bound or result changes; a changed comment does not
    repeat it.
    """
    monkeypatch.setattr(results, "PROVED", tmp_path / "proved.json")
    monkeypatch.setattr(results, "RESULTS", tmp_path / "results.json")
    proof, other = EVERY[0], EVERY[1]
    assert results.changed([proof, other]) == [proof, other]
    results.keep(Outcome(proof.name, ""), proof)
    assert results.changed([proof, other]) == [other]
    assert results.changed([replace(proof, cover=proof.cover + 1)])

    file, text = proof.sources()[0], proof.sources()[0].read_text(encoding="utf-8")
    changed = tmp_path / file.name
    monkeypatch.setattr(Proof, "sources", lambda self: [changed, *SOURCES(self)[1:]])
    changed.write_text(text + "// a comment\n", encoding="utf-8")
    assert results.changed([proof]) == []
    changed.write_text(text + "module more;\nendmodule\n", encoding="utf-8")
    assert results.changed([proof]) == [proof]
    changed.write_text(text, encoding="utf-8")
    results.keep(Outcome(proof.name, "property fails"), proof)
    assert results.changed([proof]) == [proof]
