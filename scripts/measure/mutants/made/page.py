"""The page docs/mutants.md: the score of each folder and module, and the survivors."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import yaml

from cocotb_tests.harness.project import ROOT, ProjectError
from scripts.markdown import table
from scripts.measure.mutants.made.chosen import folder_of, of_file
from scripts.measure.mutants.made.faults import Fault
from scripts.measure.mutants.made.work import ALIVE, BROKEN, ENDLESS, EQUAL, KILLED, PROOF

JUDGED = Path(__file__).with_name("judged.yml")
HEAD = """# Mutants

`make mutate` writes this page.
A mutant is the RTL with one small fault: an operator, a constant, a condition, an assignment \
([how they are made](testing.md#mutants-by-rule)).
It is killed if a proof or a test fails; the proofs of its block run first.
*No end*: the tests do not terminate with it; these mutants are counted separately.
*Equivalent*: a proof or a review found that it behaves like the RTL.
*Survived* does not include equivalent mutants.
The score is killed / (killed + survived).
"""
QUICK = "**Only the first tests of each mutant were run here: some survivors would be killed.**\n"
SCORES = ("made", "tried", "killed", "by a proof", "no end", "equivalent", "survived", "score")
RESULTS = (KILLED, EQUAL, ENDLESS, BROKEN)
SO_FAR = "The mutants ran at different times; for some survivors only the first tests were run.\n"


@dataclass(frozen=True)
class Tried:
    """A mutant and the result of its tests.

    Attributes:
        test: the test that killed the mutant.
    """

    file: str
    fault: Fault
    verdict: str
    test: str

    @property
    def source(self) -> str:
        """The source line of the fault."""
        return lines(self.file)[self.fault.line - 1].strip()

    @property
    def why(self) -> str:
        """The reason why the mutant is equivalent; "" if it has not been reviewed."""
        return judged().get((self.file, self.source, self.fault.what), "")


@cache
def lines(file: str) -> list[str]:
    """Return the lines of a file of the project."""
    return (ROOT / file).read_text(encoding="utf-8").splitlines()


@cache
def judged() -> Mapping[tuple[str, str, str], str]:
    """Return the entries of judged.yml; raise ProjectError if one names a line that no longer exists."""
    entries = yaml.safe_load(JUDGED.read_text(encoding="utf-8")) or []
    for entry in entries:
        if not any(entry["line"] == line.strip() for line in lines(entry["file"])):
            raise ProjectError(f"{JUDGED.name}: {entry['file']} has no line {entry['line']!r}")
    return {(entry["file"], entry["line"], entry["what"]): entry["why"] for entry in entries}


@dataclass(frozen=True)
class Score:
    """Numbers of mutants in a set, by result."""

    made: int
    killed: int
    proved: int
    endless: int
    equivalent: int
    alive: int
    broken: int

    @property
    def percent(self) -> float | None:
        """The score in %; None if no result is part of the score."""
        counted = self.killed + self.alive
        return 100 * self.killed / counted if counted else None


def score(tried: Sequence[Tried], made: int) -> Score:
    """Return the score of these mutants.

    Args:
        made: number of all mutants of the file or folder.
    """
    alive = [one for one in tried if one.verdict == ALIVE]
    judged_equal = sum(bool(one.why) for one in alive)
    count = {verdict: sum(one.verdict == verdict for one in tried) for verdict in RESULTS}
    proved = sum(one.test.startswith(PROOF) for one in tried)
    left = len(alive) - judged_equal
    equivalent = count[EQUAL] + judged_equal
    return Score(made, count[KILLED], proved, count[ENDLESS], equivalent, left, count[BROKEN])


def row(name: str, tried: Sequence[Tried], made: int) -> tuple[object, ...]:
    """Return a row of the tables."""
    found = score(tried, made)
    percent = "–" if found.percent is None else f"{found.percent:.1f} %"
    killed = (found.killed, found.proved, found.endless)
    return name, made, len(tried), *killed, found.equivalent, found.alive, percent


def folder_rows(tried: Sequence[Tried], files: Sequence[str]) -> Iterator[tuple[object, ...]]:
    """Yield one row for each folder, and the total."""
    for folder in sorted({folder_of(file) for file in files}):
        made = sum(len(of_file(file)) for file in files if folder_of(file) == folder)
        yield row(folder, [one for one in tried if folder_of(one.file) == folder], made)
    yield row("**all**", tried, sum(len(of_file(file)) for file in files))


def survivors(tried: Sequence[Tried]) -> Iterator[tuple[str, ...]]:
    """Yield the rows of mutants that survived or are endless."""
    for one in tried:
        if one.verdict in (ALIVE, ENDLESS):
            text = one.source.replace("|", "\\|")
            what = one.fault.what.replace("|", "\\|")
            said = (
                f"equivalent: {one.why}"
                if one.why
                else "no end"
                if one.verdict == ENDLESS
                else "**survived**"
            )
            yield one.file, f"`{text}`", what, said


def page(tried: Sequence[Tried], files: Sequence[str], note: str = "") -> str:
    """Return the whole page.

    Args:
        note: restriction of the tests (QUICK, SO_FAR).
    """
    modules = [
        row(file, mine, len(of_file(file)))
        for file in files
        if (mine := [t for t in tried if t.file == file])
    ]
    parts = [
        HEAD,
        *([note] if note else []),
        table(("folder of rtl/", *SCORES), folder_rows(tried, files)),
        "\n## Modules\n",
        table(("file", *SCORES), modules),
        "\n## Survivors\n",
        table(("place", "source", "mutant", ""), survivors(tried)),
    ]
    return "\n".join(parts) + "\n"
