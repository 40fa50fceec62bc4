"""Acts that belong together: they are left out together before single ones are, and told in one line."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import groupby

from .acts import Act

PAUSE = 20
"""clk between two acts whose pause is closed; every bus of ours has room in it."""


def messages(acts: Iterable[Act]) -> list[list[Act]]:
    """Runs of writes, or of reads, and bursts of other pins.

    A run ends where the direction changes, or where the register it began with comes again after others: a
    command and its data, all registers of a block, a response, polls.
    """
    found: list[list[Act]] = []
    run: list[Act] = []
    burst: list[Act] = []
    for act in acts:
        if act.access and _goes_on(run, act):
            run.append(act)
        elif act.access:
            found.append(run := [act])
        elif burst and act.begin - burst[-1].end < PAUSE:
            burst.append(act)
        else:
            found.append(burst := [act])
    return found


def exchanges(acts: Iterable[Act]) -> list[list[Act]]:
    """Messages to the part, each with all that is read before the next one; bursts of other pins."""
    found: list[list[Act]] = []
    exchange: list[Act] = []
    for message in messages(acts):
        if message[0].reads and exchange:
            exchange += message
            continue
        found.append(message)
        if message[0].access:
            exchange = message
    return found


def together(runs: Iterable[Sequence[Act]]) -> list[Act]:
    """The acts of some runs in order of time."""
    return sorted((act for run in runs for act in run), key=lambda act: (act.begin, act.end))


def told(acts: Iterable[Act]) -> list[str]:
    """A line for each message whose acts follow each other at once."""
    lines: list[list[Act]] = []
    for act in acts:
        last = lines[-1] if lines else []
        if act.access and last and _goes_on(last, act) and act.begin - last[-1].end <= PAUSE:
            last.append(act)
        else:
            lines.append([act])
    return [f"{', '.join(_words(line))} at {line[0].begin}" for line in lines]


def _goes_on(run: Sequence[Act], act: Act) -> bool:
    """Whether an access belongs to a run of them."""
    if not run or not run[-1].access or run[-1].reads != act.reads:
        return False
    return act.kind != run[0].kind or act.kind == run[-1].kind


def _words(line: Sequence[Act]) -> Iterator[str]:
    for _, same in groupby(line, key=lambda act: act.kind):
        first, *more = same
        if first.reads and more:
            yield f"{first.what} {1 + len(more)} times"
        else:
            yield " ".join([first.what, *(act.what.rpartition(" ")[2] for act in more)])
