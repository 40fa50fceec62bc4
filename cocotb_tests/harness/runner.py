"""Runs cocotb tests: directed tests of a build share one process; each other test has a separate process.

All simulations of the project use this module. A process is accepted only if results.xml contains exactly the
requested tests (otherwise no test counts as run) and the exit code is 0. If an assertion of the RTL fires,
the test in whose part of the log it is printed fails (`simulate`).
"""

from __future__ import annotations

import math
import os
import re
import shutil
from collections.abc import Callable, Hashable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, TypeVar

import pytest

from .build import MAINS, Design, SimError, part_design
from .collect import Item
from .compare import DIGEST_FILE, DIGESTS
from .paths import FAILURES, RUNS, WAVES, relative
from .simulate import (
    MISSING,
    PASSED,
    REPRO,
    SKIPPED,
    TIMEOUT,
    VCD,
    XFAILED,
    Job,
    Outcome,
    repro_line,
    safe,
    simulate,
    tried,
)
from .variants import mutant_present

_VAR = re.compile(r"\$var \w+ +(\d+) \S+ (\S+)(?: (\[\S+\]))? \$end")

_UNKNOWN = re.compile(r"AttributeError: .*contains no (child )?object")
HINT = "hidden in this build: @probe(…) or PROBE=1"


def with_probes(design: Design, paths: tuple[str, ...], everything: bool = False) -> Design:
    """Return the design with these inner signals visible, or with all signals visible."""
    if everything:
        return replace(design, ports=())
    return replace(design, probes=paths) if paths and design.ports else design


def hint(text: str, design: Design) -> str:
    """Return a hint if a failure text names an unknown signal and the design has hidden signals; else ""."""
    return HINT if design.ports and _UNKNOWN.search(text) else ""


def _signals(vcd: Path, design: Design) -> tuple[list[tuple[str, str, int]], int]:
    """Return (scope, name with range, width) of each signal of the top in a VCD, and the last time stamp.

    If the ports are known, only the ports are returned.
    """
    scopes: list[str] = []
    found: list[tuple[str, str, int]] = []
    with vcd.open("rb") as file:
        for raw in file:
            line = raw.decode("ascii", "replace").strip()
            if line.startswith("$scope"):
                scopes.append(line.split()[2])
            elif line.startswith("$upscope"):
                scopes.pop()
            elif line.startswith("$enddefinitions"):
                break
            elif (var := _VAR.match(line)) and scopes and scopes[-1] == design.top:
                width, name, place = var.groups()
                if design.ports in ((), "*") or name in design.ports:
                    found.append((".".join(scopes), name + (place or ""), int(width)))
        file.seek(max(0, vcd.stat().st_size - 100_000))
        times = re.findall(rb"^#(\d+)", file.read(), re.MULTILINE)
    return found, int(times[-1]) if times else 0


def write_views(vcd: Path, design: Design) -> list[Path]:
    """Write a GTKWave save file and a Surfer command file next to a VCD.

    Return the paths of all three files; an empty list if the VCD does not exist.
    """
    if not vcd.is_file():
        return []
    signals, end = _signals(vcd, design)
    gtkw, sucl = vcd.with_suffix(".gtkw"), vcd.with_suffix(".sucl")
    # The zoom is minus log2 of the time between two grid lines; the window contains about five grid lines.
    lines = [f'[dumpfile] "{vcd.name}"', "[timestart] 0", "[size] 1500 900"]
    lines += [f"*-{math.log2(max(5, end) / 5):.6f} -1", "[sst_width] 200", "[signals_width] 180"]
    for scope, name, width in signals:
        lines += ["@22" if width > 1 else "@28", f"{scope}.{name}"]
    gtkw.write_text("\n".join([*lines, ""]), encoding="ascii")
    adds = [f"variable_add {scope}.{name.partition('[')[0]}" for scope, name, _ in signals]
    sucl.write_text("\n".join([*adds, "zoom_fit", ""]), encoding="ascii")
    return [vcd, gtkw, sucl]


MOST = 40
"""Maximum number of tests in one process. With this value two workers stay busy, and imports take little
time.
"""

T = TypeVar("T")


def groups_of(things: Iterable[T], key: Callable[[T], Hashable]) -> list[tuple[T, ...]]:
    """Return groups of at most MOST items with the same key, in order; an item with key None is alone."""
    found: dict[Hashable, list[T]] = {}
    for number, thing in enumerate(things):
        found.setdefault((number,) if (name := key(thing)) is None else (None, name), []).append(thing)
    return [
        tuple(members[k : k + size])
        for members in found.values()
        for size in [-(-len(members) // -(-len(members) // MOST))]
        for k in range(0, len(members), size)
    ]


def run_group(job: Job) -> dict[Item, tuple[Outcome, Job]]:
    """Return the outcome of each item of a job, and the process in which it ran.

    If a test crashes, the items that have not run yet run in a new process without this test. For a mutant,
    the first failure ends the job.
    """
    found: dict[Item, tuple[Outcome, Job]] = {}
    left: Sequence[Item] = job.items
    while left:
        now = replace(job, items=tuple(left))
        outcomes = tried(now)
        left = [item for item, outcome in outcomes.items() if outcome.kind == MISSING]
        nothing_ran = len(left) == len(outcomes)
        if nothing_ran or mutant_present():
            left = []
        found |= {item: (outcome, now) for item, outcome in outcomes.items() if item not in left}
    return found


def fails(job: Job, items: Sequence[Item]) -> bool:
    """Return whether the last of these items fails in a process that runs all of them."""
    outcome = tried(replace(job, items=tuple(items)))[items[-1]]
    return not outcome.good


def shortest_prefix(job: Job, before: Sequence[Item], item: Item) -> list[Item]:
    """Return a short list of tests out of `before` after which `item` fails.

    The list is halved as long as `item` fails after one of the halves.
    """
    culprits = list(before)
    while len(culprits) > 1:
        middle = len(culprits) // 2
        for half in (culprits[middle:], culprits[:middle]):
            if fails(job, [*half, item]):
                culprits = half
                break
        else:
            break
    return culprits


def failure_message(item: Item, first: Outcome, job: Job, waves: bool = True) -> str:
    """Return the message about an item that failed in `job`.

    The log (with `waves`, also a VCD) is kept in build/failures/.
    """
    if mutant_present():
        return first.text
    kept = FAILURES / f"{safe(item.id)}-s{job.seed}"
    shutil.rmtree(kept, ignore_errors=True)
    alone = replace(job, items=(item,))
    outcome = simulate(alone, kept)[item]
    if not outcome.good:
        text = _fails(item, outcome, alone, waves, kept)
    elif len(job.items) == 1:
        text = _message(item, first, alone, ["the same run, once more, passed: it is not deterministic"])
    else:
        text = _after_others(item, first, job, waves, kept)
    return text


def _message(
    item: Item, outcome: Outcome, job: Job, reasons: Sequence[str] = (), kept: Path | None = None
) -> str:
    """Return the message about a failure: its text, the results `reasons` of the other runs, the files."""
    lines = [f"{item.id}: {outcome.kind}", outcome.text, *(f"({line})" for line in reasons)]
    lines.append(f"seed {job.seed}" + (f", log {relative(kept / 'log.txt')}" if kept else ""))
    if kept and (kept / "waves" / VCD).is_file():
        lines.append(f"waves in {relative(kept / 'waves' / VCD)}")
    return "\n".join([*lines, f"repeat with: {job.repro}"])


def _fails(item: Item, outcome: Outcome, job: Job, waves: bool, kept: Path) -> str:
    """Return the message about a failure of the last item of `job`; it needs the other items of `job`."""
    reasons = [f"fails only after {_names(job.items[:-1])}; alone it passes"] if len(job.items) > 1 else []
    if unknown_name := hint(outcome.text, job.design):
        return _message(item, outcome, job, [*reasons, unknown_name], kept)
    if waves and outcome.kind != MISSING and not outcome.text.startswith(TIMEOUT):
        try:
            repeated = simulate(replace(job, waves=True), kept / "waves")[item]
        except SimError as error:
            repeated = Outcome(MISSING, str(error).splitlines()[0])
        if repeated.good:
            reasons.append(f"not reproduced with waves: there it {repeated.kind}")
        elif repeated.kind == MISSING:
            reasons.append(f"no waves: {repeated.text}")
        elif repeated.headline != outcome.headline:
            reasons.append(f"not reproduced with waves: there it says {repeated.headline}")
    return _message(item, outcome, job, reasons, kept)


def _after_others(item: Item, first: Outcome, job: Job, waves: bool, kept: Path) -> str:
    """Return the message about a test that passes alone but failed in a process with other tests."""
    again = tried(job)[item]
    if again.good:
        reasons = ["alone it passes, and in the same group, once more, too: it is not deterministic"]
        return _message(item, first, job, reasons)
    before = job.items[: job.items.index(item)]
    if not before:
        return _message(item, again, job, [f"alone it passes; fails only before {_names(job.items[1:])}"])
    culprits = (*shortest_prefix(job, before, item), item)
    return _fails(item, again, replace(job, items=culprits), waves, kept)


def _names(items: Sequence[Item]) -> str:
    return ", ".join(item.id for item in items)


WAVES_IN = "waves in "
"""First words of the line that a simulation with waves prints."""


def notes(item: Item | None) -> list[tuple[str, Any]]:
    """Return the user properties that `Summary` reads from the report of a test."""
    if item is None or item.uncompared is None:
        return []
    return [("directed", item.test), ("uncompared", item.uncompared)]


class Summary:
    """Collects the counts of all tests in the controlling process, to which xdist forwards every report."""

    def __init__(self) -> None:
        self._seen: dict[str, dict[str, Any]] = {}
        self._waves: list[str] = []

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        """Keep the properties of a test that ran."""
        known = dict(report.user_properties)
        if report.when == "call" and report.outcome != "skipped" and "directed" in known:
            self._seen[report.nodeid] = known
        if report.when == "call":
            self._waves += [line for line in report.capstdout.splitlines() if line.startswith(WAVES_IN)]

    def pytest_terminal_summary(self, terminalreporter: Any) -> None:
        """Write the counts, each reason (once), and the waveform files."""
        if self._waves:
            terminalreporter.section("waves")
            for line in sorted(self._waves):
                terminalreporter.line(line.removeprefix(WAVES_IN))
        if not self._seen:
            return
        reasons: dict[str, set[str]] = {}
        for known in self._seen.values():
            if known["uncompared"]:
                reasons.setdefault(known["uncompared"], set()).add(known["directed"])
        without = sum(bool(known["uncompared"]) for known in self._seen.values())
        compared = len(self._seen) - without
        terminalreporter.section("directed tests")
        terminalreporter.line(f"{compared} compared with the golden model edge by edge, {without} not")
        for reason, tests in sorted(reasons.items()):
            terminalreporter.line(f"  {', '.join(sorted(tests))}: {reason}")


@dataclass(frozen=True)
class SimOptions:
    """Options of the command line. If `seed` is None, each test uses its fixed default seed.

    `done` contains the outcomes of the groups that have run.

    Attributes:
        waves: True if a VCD of each test is kept, also of passing ones.
        probe: True if every signal is visible.
        group: items that share a simulator process with the item of the test, in order.
    """

    seed: int | None = None
    waves_on_failure: bool = True
    waves: bool = False
    probe: bool = False
    group: tuple[Item, ...] = ()
    done: dict[tuple[Item, ...], dict[Item, tuple[Outcome, Job]]] = field(default_factory=dict, compare=False)


def run_sim(
    design: Design,
    item: Item,
    seed: int,
    waves: bool = False,
    env: Mapping[str, str] | None = None,
    folder: Path | None = None,
    repro: str | None = None,
) -> Path:
    """Build if needed and run one cocotb test in one process; return the folder of the run.

    `folder` (default: below build/runs/) receives log.txt, results.xml and the files of the test. Raises
    SimError unless exactly this test ran and passed, and the process ended without an error.
    """
    job = Job(design, (item,), seed, waves, {**(env or {}), **({REPRO: repro} if repro else {})})
    folder = folder or job.folder
    outcome = simulate(job, folder)[item]
    if outcome.kind not in (PASSED, XFAILED):
        log = relative(folder / "log.txt")
        raise SimError(
            f"{item.id}: {outcome.kind}\n{outcome.text}\nseed {seed}, log {log}\nrepeat with: {job.repro}"
        )
    return folder


def _job(item: Item, options: SimOptions, env: Mapping[str, str], design: Design | None) -> Job:
    seed = item.seed if options.seed is None else options.seed
    design = with_probes(design or part_design(item.part, item.config), item.probes, options.probe)
    group = options.group if item in options.group else (item,)
    return Job(design, group, seed, options.waves, env)


def outcome_of(item: Item, options: SimOptions, env: Mapping[str, str], design: Design | None) -> Outcome:
    """Return the outcome of an item; the text of a failed one is the complete message.

    The first requested item of a group runs the whole group.
    """
    try:
        job = _job(item, options, env, design)
        if options.waves:
            return _with_waves(item, job)
        if job.items not in options.done:
            options.done[job.items] = run_group(job)
        outcome, ran = options.done[job.items][item]
        if outcome.good:
            return outcome
        return Outcome(outcome.kind, failure_message(item, outcome, ran, options.waves_on_failure))
    except SimError as error:
        repro = env.get(REPRO) or repro_line([item], item.seed if options.seed is None else options.seed)
        return Outcome("failed", f"{item.id}: {error}\nrepeat with: {repro}")


def _with_waves(item: Item, job: Job) -> Outcome:
    """Run one item with waveforms; keep them in build/waves/ with their view files."""
    folder = WAVES / safe(item.id)
    outcome = simulate(job, folder)[item]
    views = write_views(folder / VCD, job.design)
    print(WAVES_IN + ", ".join(relative(path) for path in views))
    if outcome.good:
        return outcome
    text = f"{item.id}: {outcome.kind}\n{outcome.text}\nrepeat with: {job.repro} WAVES=1"
    return Outcome(outcome.kind, text)


def attempt(
    item: Item,
    options: SimOptions | None = None,
    env: Mapping[str, str] | None = None,
    design: Design | None = None,
) -> str:
    """Run one item; return "" if it passed, else a short message with the command that repeats it.

    `design` (default: the device of the item) is simulated.
    """
    outcome = outcome_of(item, options or SimOptions(), env or {}, design)
    return "" if outcome.good else outcome.text


def run_item(
    item: Item,
    options: SimOptions | None = None,
    env: Mapping[str, str] | None = None,
    design: Design | None = None,
) -> None:
    """Run one collected item as a pytest test with the same result as the cocotb test."""
    __tracebackhide__ = True
    if item.skipped:
        pytest.skip(item.skipped)
    outcome = outcome_of(item, options or SimOptions(), env or {}, design)
    if outcome.kind == SKIPPED:
        pytest.skip(outcome.text)
    if outcome.kind == XFAILED:
        pytest.xfail(outcome.text)
    if not outcome.good:
        pytest.fail(outcome.text, pytrace=False)


def recorded(item: Item, main: str, env: Mapping[str, str], design: Design) -> list[str]:
    """Return the digests of the test's comparisons with the golden model, in order.

    A digest covers pins, host accesses and output edges. Raises SimError if the test does not pass.
    """
    folder = RUNS / f"{safe(item.id)}-{main}.{os.getpid()}"
    run_sim(replace(design, main=main), item, item.seed, env={**env, DIGESTS: "1"}, folder=folder)
    left = folder / DIGEST_FILE
    digests = left.read_text(encoding="ascii").split() if left.is_file() else []
    shutil.rmtree(folder, ignore_errors=True)
    return digests


def check_mains(item: Item, env: Mapping[str, str] | None = None, design: Design | None = None) -> int:
    """Return the number of recordings of the test; raise AssertionError if the main programs differ."""
    design = design or part_design(item.part, item.config)
    own, cocotb = (recorded(item, main, env or {}, design) for main in MAINS)
    assert own and own == cocotb, f"{item.id}: {own} with our main program, {cocotb} with cocotb's"
    return len(own)
