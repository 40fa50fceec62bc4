"""All mutants of a file in one copy of it: +mutant=N chooses one when the simulation starts, 0 is none.

So a design is compiled once for all mutants of a file. Lines keep their numbers.
"""

from __future__ import annotations

from collections.abc import Sequence

from scripts.measure.mutants.made.faults import Fault
from scripts.measure.syntax import found, span, tree

CHOSEN = "openppmc_mutant"
DECLARED = f' int {CHOSEN} = 0; initial if (!$value$plusargs("mutant=%d", {CHOSEN})) {CHOSEN} = 0;'


def _heads(text: str) -> list[int]:
    """Where the headers of modules end."""
    return [span(node.header)[1] for node in found(tree(text), "ModuleDeclaration")]


def instrumented(text: str, faults: Sequence[Fault]) -> str:
    """The copy with these mutants."""
    places: dict[tuple[int, int, bool], list[Fault]] = {}
    for fault in faults:
        places.setdefault((fault.start, fault.end, fault.dropped), []).append(fault)
    # Outer places first; a statement that may be left out is outside of what it holds.
    order = sorted(places, key=lambda place: (place[0], -place[1], not place[2]))
    heads = _heads(text)

    def render(start: int, end: int, within: list[tuple[int, int, bool]]) -> str:
        """The text of [start, end) with all places in it, of which none is that of the caller."""
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
        """Unchanged text, with the declaration behind each header in it."""
        piece, at = [], start
        for head in heads:
            if start < head <= end:
                piece += [text[at:head], DECLARED]
                at = head
        return "".join([*piece, text[at:end]])

    def wrapped(place: tuple[int, int, bool], inside: str) -> str:
        for fault in places[place]:
            if fault.dropped:
                inside = f"begin if ({CHOSEN} != {fault.number}) {inside} end"
            else:
                inside = f"(({CHOSEN} == {fault.number}) ? ({_flat(fault.text)}) : ({inside}))"
        return inside

    return render(0, len(text), order)


def _flat(text: str) -> str:
    """On one line, without comments, so that all lines behind keep their numbers."""
    return " ".join(line.partition("//")[0].strip() for line in text.splitlines())
