"""The page docs/coverage.md."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator

from cocotb_tests.harness.crosses import Cross, Crosses
from openppmc import parts
from scripts.markdown import table
from scripts.measure.coverage.elaborated import left_out
from scripts.measure.coverage.points import BRANCH, LINE, TOGGLE
from scripts.measure.coverage.sums import LEFT_OUT, Sums, folder_of

KINDS = (LINE, BRANCH, TOGGLE)
HEAD = """# Coverage

`make coverage` writes this page: it runs all simulations of `make test` with builds in which Verilator \
counts.
A point (a line, one outcome of a branch, a rising or falling bit) is covered if any instance in any \
simulation reaches it.
The page [mutants](mutants.md) shows whether a test would detect a fault there.
A first figure includes all points; a figure "without … explained" excludes the points that cannot be \
covered for a known reason.

Counting builds have copies of the sources in which Verilator counts `return` and packages correctly \
([how](testing.md#coverage)).
Functions that only elaboration calls are listed below; they are not points.
"""


def percent(value: float) -> str:
    """Return a percentage with one decimal; it is 100 only if all points are covered."""
    return "100" if value == 100 else f"{min(value, 99.9):.1f}"


def cell(sums: Sums, place: str, kind: str) -> str:
    """Return the text of a cell: the percentage, and the numbers of explained and open points."""
    figure = sums.figure(place, kind)
    if not figure.all:
        return "–"
    text = f"{percent(figure.percent)} % of {figure.all}"
    left = figure.all - figure.reached - figure.known
    if kind != TOGGLE and figure.known:
        text += f"; {percent(figure.left)} % without {figure.known} explained"
    if kind != TOGGLE and left:
        text += f", **{left} open**"
    return text


def row(sums: Sums, place: str) -> list[str]:
    """Return the row of a folder or file."""
    return [place, *(cell(sums, place, kind) for kind in KINDS)]


def folders(sums: Sums) -> Iterator[str]:
    """Yield the table of folders."""
    yield table(("folder of rtl/", *KINDS), (row(sums, folder) for folder in sums.folders()))
    for folder, why in LEFT_OUT.items():
        yield f"\n`{folder}`: {why}."


def files(sums: Sums) -> str:
    """Return the table of files that are not fully covered."""
    every = (file for folder in sums.folders() for file in sums.files(folder))
    open_files = (f for f in every if any(sums.figure(f, kind).percent < 100 for kind in KINDS))
    return table(("file", *KINDS), (row(sums, file) for file in open_files))


def holes(sums: Sums) -> str:
    """Return the table of holes of lines and branches, with their reasons."""
    every = [hole for kind in (LINE, BRANCH) for hole in sums.holes(kind)]
    if not every:
        return "None."
    rows = []
    for hole in sorted(every, key=lambda hole: (hole.file, hole.line, hole.kind)):
        text = hole.text.replace("|", "\\|")
        what = f"{hole.kind} {hole.what}".strip()
        rows.append((hole.file, what, f"`{text}`", hole.why or "**open**"))
    return table(("place", "what", "source", "why"), rows)


def elaborated() -> str:
    """Return the table of functions that have no points, because only elaboration calls them."""
    names: dict[str, list[str]] = {}
    for function in left_out():
        if folder_of(function.file) not in LEFT_OUT:
            names.setdefault(function.file, []).append(function.name)
    return table(("file", "functions"), ((file, ", ".join(found)) for file, found in names.items()))


def cross(of: Cross, counts: Counter[tuple[str, str]]) -> Iterator[str]:
    """Yield the table of a cross. A cell contains **0** if its case was not seen, – if it is impossible."""
    reasons: dict[str, None] = {}
    rows = []
    for name in of.rows:
        shown = [name]
        for column in of.columns:
            number, why = counts[name, column], of.why_never(name, column)
            if number or not why:
                shown.append(f"{number:,}" if number else "**0**")
            else:
                shown.append("–")
                reasons[why] = None
        rows.append(shown)
    yield table((of.name, *of.columns), rows)
    if reasons:
        yield "\nReasons for –: " + "; ".join(reasons) + "."


def of_part(part: parts.Row, counts: Counter[str]) -> Iterator[str]:
    """Yield the crosses of a part."""
    found: Crosses = part.load("crosses")
    yield f"### {part.title}\n"
    if not any(key.startswith(f"{part.name}\t") for key in counts):
        yield "Nothing counted.\n"
        return
    for of in found.tables:
        own: Counter[tuple[str, str]] = Counter()
        for key, number in counts.items():
            name, title, at, column = key.split("\t")
            if (name, title) == (part.name, of.name):
                own[at, column] += number
        yield from cross(of, own)
        yield ""


def page(sums: Sums, counts: Counter[str], tests: int, all_tests: int, old: bool = False) -> str:
    """Return the whole page; its figures are from `tests` of `all_tests` tests.

    Args:
        old: True if some results may be from earlier versions of the sources.
    """
    much = f"{tests} tests." if tests == all_tests else f"**A sample: {tests} of {all_tests} tests.**"
    much += " They ran at different times, some possibly with earlier sources." if old else ""
    lines = [HEAD, f"{much}\n", "## The RTL\n", *folders(sums)]
    lines += ["\n### Files with holes\n", files(sums), "\n### Holes of lines and branches\n", holes(sums)]
    lines += ["\n### Left out: functions that only elaboration calls\n"]
    lines += [
        "Each call has only constants, or is in a parameter, a dimension, the head of a generate block or "
        "such a function.",
        "No simulation executes these functions.\n",
        elaborated(),
    ]
    lines += ["\n## Crosses of the data sheets\n"]
    lines += ["A cross is a table of combinations, such as an operation and the cause of its end."]
    lines += ["The golden models that follow the simulations count how often each combination occurs."]
    lines += ["A **0** was not observed; – cannot occur, for one of the reasons below the table.\n"]
    for part in parts.having("crosses"):
        lines += of_part(part, counts)
    return "\n".join(lines).rstrip() + "\n"
