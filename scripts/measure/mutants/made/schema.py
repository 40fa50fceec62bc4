"""All mutants of a file in one copy.

The argument +mutant=N selects a mutant when the simulation starts; 0 selects none. Thus, a design is compiled
only once for all mutants of a file. Line numbers do not change.

In a copy with notes, +mutant=EVERY selects none either, but calls openppmc_note with the number of each
mutant whose expression has another value than the RTL, or whose removed statement is executed.
"""

from __future__ import annotations

from collections.abc import Sequence

from scripts.measure.mutants.made.faults import Fault
from scripts.measure.syntax import found, span, tree

CHOSEN = "openppmc_mutant"
DECLARED = f' int {CHOSEN} = 0; initial if (!$value$plusargs("mutant=%d", {CHOSEN})) {CHOSEN} = 0;'
EVERY = 99_999
NOTE = '$c32("[] {{ extern int openppmc_note(int); return openppmc_note({}); }}()") != 0'


def _heads(text: str) -> list[int]:
    """Return the index in the text at which each module header ends."""
    return [span(node.header)[1] for node in found(tree(text), "ModuleDeclaration")]


def instrumented(text: str, faults: Sequence[Fault], declared: str = DECLARED, notes: bool = False) -> str:
    """Return the copy with these mutants, with or without notes.

    Args:
        declared: declaration of the selection.
    """
    places: dict[tuple[int, int, bool], list[Fault]] = {}
    for fault in faults:
        places.setdefault((fault.start, fault.end, fault.dropped), []).append(fault)
    # Outer places precede inner ones; a statement that may be removed precedes the places within it.
    order = sorted(places, key=lambda place: (place[0], -place[1], not place[2]))
    heads = _heads(text)

    def render(start: int, end: int, within: list[tuple[int, int, bool]]) -> str:
        """Return the text of [start, end) with the mutants whose places are `within` this range."""
        parts, at, rest = [], start, within
        while rest:
            place = rest[0]
            inner = [p for p in rest[1:] if p[0] >= place[0] and p[1] <= place[1]]
            parts.append(plain(at, place[0]))
            parts.append(wrapped(place, render(place[0], place[1], inner)))
            at = place[1]
            rest = [p for p in rest[1:] if p not in inner]
        return "".join([*parts, plain(at, end)])

    def plain(start: int, end: int) -> str:
        """Return the unchanged text, but with the declaration of the selection after each module header."""
        piece, at = [], start
        for head in heads:
            if start < head <= end:
                piece += [text[at:head], declared]
                at = head
        return "".join([*piece, text[at:end]])

    def wrapped(place: tuple[int, int, bool], inside: str) -> str:
        for fault in places[place]:
            every, note = f"{CHOSEN} == {EVERY}", NOTE.format(fault.number)
            if fault.dropped:
                executed = f"if ({every} && {note}) begin end " * notes
                inside = f"begin {executed}if ({CHOSEN} != {fault.number}) {inside} end"
            else:
                new, old = _flat(fault.text), _flat(text[place[0] : place[1]])
                differs = f" || ({every} && ({new}) !== ({old}) && {note})" * notes
                inside = f"(({CHOSEN} == {fault.number}{differs}) ? ({new}) : ({inside}))"
        return inside

    return render(0, len(text), order)


def _flat(text: str) -> str:
    """Return a text on one line without comments, so that the line numbers after it do not change."""
    return " ".join(line.partition("//")[0].strip() for line in text.splitlines())
