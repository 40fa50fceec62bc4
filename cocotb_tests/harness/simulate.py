"""Runs one simulator process for one or more tests of one build, and reads the outcome of each test."""

from __future__ import annotations

import os
import re
import shutil
import sys
import textwrap
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from xml.etree import ElementTree

from cocotb_tests.harness import watchdog

from .build import ICARUS, Design, build, from_root, sim_main, simulator
from .collect import Item
from .config import last_seed
from .jitter import jitters, stage_counts
from .paths import ROOT, RUNS
from .variants import keep_counts, mutant_plusargs

PASSED, FAILED, SKIPPED, XFAILED = "passed", "failed", "skipped", "xfailed"
CRASHED = "crashed"
"""The process ended within this test: crash, $fatal, or the wall-clock limit."""
MISSING = "did not run"
TIMEOUT = "not finished within the wall-clock limit"

_ENTRY = re.compile(r"^ *[-\d.]+ns [A-Z]+ +cocotb\.regression +(?P<text>.*)$", re.MULTILINE)
_FAILED_LINE = re.compile(r"\s*(\w+\.)*\w*(Error|Exception|Failed)\b")
_TABLE = re.compile(r"^[^\n]*\*{20,}", re.MULTILINE)


@dataclass(frozen=True)
class Outcome:
    """Outcome of one test: its `kind`; `text` is the failure, or the reason of a skip or expected failure."""

    kind: str
    text: str = ""

    @property
    def good(self) -> bool:
        """Whether there is nothing to report: passed, skipped or failed as expected."""
        return self.kind in (PASSED, SKIPPED, XFAILED)

    @property
    def headline(self) -> str:
        """The failure in one line: the first line that names an exception, else the first line."""
        rows = [row for row in self.text.splitlines() if row.strip()]
        errors = [row.strip() for row in rows if _FAILED_LINE.match(row)]
        return (errors or [row.strip() for row in rows] or [self.kind])[0]


def read_log(log: Path) -> str:
    """Return a log as text, with paths of the project relative to its root."""
    if not log.is_file():
        return ""
    return from_root(re.sub(r"\x1b\[[0-9;]*m", "", log.read_text(encoding="utf-8", errors="replace")))


def failure_text(text: str, lines: int = 100) -> str:
    """Return the exception or the RTL error in a test's part of the log, else the end of that part."""
    found = [text.find(word) for word in ("%Error", "%Fatal", "Fatal Python error", "Timeout (")]
    start = min((place for place in found if place >= 0), default=-1)
    if start < 0:
        start = text.rfind("Traceback (most recent call last)")
    chosen = text[max(0, text.rfind("\n", 0, start) + 1) :] if start >= 0 else text
    # The summary table of cocotb only repeats the message, so it is removed.
    chosen = _TABLE.split(chosen)[0]
    if chosen.lstrip().startswith("Traceback"):
        chosen = chosen.split("\n", 1)[-1]
    rows = [*last_seed(text), *textwrap.dedent(chosen.rstrip()).splitlines()]
    return "\n".join(rows if len(rows) <= lines else _abridged(rows, lines))


def _abridged(rows: list[str], lines: int) -> list[str]:
    """Return about `lines` rows of a text: its beginning, the failure, and its end."""
    what = next((n for n, row in enumerate(rows) if _FAILED_LINE.match(row)), 0)
    middle = range(max(6, what), min(max(6, what) + lines // 3, len(rows)))
    end = range(max(middle.stop, len(rows) - lines + lines // 3 + 8), len(rows))
    gaps = [["  ..."] if a < b else [] for a, b in ((6, middle.start), (middle.stop, end.start))]
    return [*rows[:6], *gaps[0], *(rows[n] for n in middle), *gaps[1], *(rows[n] for n in end)]


def _parts(text: str) -> Iterator[tuple[str, str]]:
    """Yield (full name, part of the log) of each test that was started.

    The text before the first start belongs to the first test.
    """
    begins = [
        (name.group(1), entry.start())
        for entry in _ENTRY.finditer(text)
        if (name := re.match(r"running (.+) \(\d+/\d+\)$", entry["text"]))
    ]
    places = [0, *(place for _, place in begins[1:]), len(text)]
    for number, (name, _) in enumerate(begins):
        yield name, text[places[number] : places[number + 1]]


def _outcome(name: str, part: str, end: str) -> Outcome:
    """Return the outcome of a test from its part of the log.

    Args:
        end: reason for the end of the process, if it ended within a test.
    """
    if "%Error" in part:
        return Outcome(FAILED, failure_text(part))
    for entry in _ENTRY.finditer(part):
        if entry["text"].startswith(f"skipping {name}: "):
            return Outcome(SKIPPED, entry["text"].partition(": ")[2])
        result = re.match(rf"{re.escape(name)} (passed|failed|xfailed)(?:: )?(.*)$", entry["text"])
        if result:
            kind, reason = result.groups()
            return Outcome(kind, failure_text(part) if kind == FAILED else reason)
    return Outcome(CRASHED, f"{end}\n{failure_text(part)}")


def named_in(results: Path) -> list[str] | None:
    """Return the full names of the tests in results.xml, sorted; None if the file does not exist."""
    if not results.is_file():
        return None
    cases = ElementTree.parse(results).getroot().iter("testcase")
    return sorted(f"{case.get('classname')}.{case.get('name')}" for case in cases)


def outcomes(items: Sequence[Item], log: Path, results: Path, trouble: str) -> dict[Item, Outcome]:
    """Return the outcome of each item of a process that has ended.

    A process that ended normally must have run exactly these items.

    Args:
        trouble: how the process ended, if it did not end normally.
    """
    text, names = read_log(log), named_in(results)
    want = sorted(item.full_name for item in items)
    if names is not None and names != want:
        outcome = Outcome(FAILED, f"expected exactly {', '.join(want)}, results.xml has {', '.join(names)}")
        return dict.fromkeys(items, outcome)
    if "Timeout (" in text:
        trouble = TIMEOUT
    end = trouble or "the simulation ended within the test"
    known = {name: _outcome(name, part, end) for name, part in _parts(text)}
    whole = f"{end}\n{failure_text(text)}"
    found = {item: known.get(item.full_name, Outcome(MISSING, whole)) for item in items}
    good = all(outcome.good for outcome in found.values())
    if trouble and good:
        return dict.fromkeys(items, Outcome(FAILED, whole))
    if good and jitters() and any(item.tolerant for item in items):
        late, prompt = stage_counts(text)
        if not late or not prompt:
            return dict.fromkeys(items, Outcome(FAILED, f"JITTER=1: {late} late, {prompt} prompt changes"))
    return found


REPRO = "OPENPPMC_REPRO"
"""Environment variable: command that repeats the simulation, for its messages."""
VCD = "dump.vcd"
"""Waveform file in the folder of a run."""
ERRORS = 1_000_000
"""Number of %Error lines (such as fired assertions of the RTL) after which Verilator ends the process."""


@dataclass(frozen=True)
class Job:
    """One run of a simulator process, which can be repeated. `env` contains environment variables for it."""

    design: Design
    items: tuple[Item, ...]
    seed: int
    waves: bool = False
    env: Mapping[str, str] = field(default_factory=dict)

    @property
    def repro(self) -> str:
        """Command that repeats the job."""
        return self.env.get(REPRO) or repro_line(self.items, self.seed)

    @property
    def folder(self) -> Path:
        """Scratch folder of the job; the process number separates parallel sessions."""
        more = f"+{len(self.items) - 1}" if len(self.items) > 1 else ""
        return RUNS / f"{safe(self.items[0].id)}{more}-s{self.seed}.{os.getpid()}"


def safe(name: str) -> str:
    """Return a name that is valid for a folder."""
    return re.sub(r"[^\w.=-]+", "_", name)


def repro_line(items: Sequence[Item], seed: int) -> str:
    """Return the command that repeats these tests; several tests are repeated in one process."""
    names = ",".join(item.id for item in items)
    main = {"own": "", ICARUS: " SIM=icarus"}.get(sim_main(), f" SIM_MAIN={sim_main()}")
    main += " JITTER=1" if jitters() else ""
    if items[0].target != "test":
        return f"make {items[0].target} T={names} SEED={seed}{main}"
    return f"make test T={names} SEED={seed} CLK_HZ={items[0].config.clk_hz}{main}"


def tried(job: Job) -> dict[Item, Outcome]:
    """Run a job as `simulate` does, remove the files of the run, and return the outcome of each item."""
    try:
        return simulate(job)
    finally:
        shutil.rmtree(job.folder, ignore_errors=True)


def simulate(job: Job, folder: Path | None = None) -> dict[Item, Outcome]:
    """Build if needed and run; return the outcome of each item. Raises SimError only if the build fails.

    `folder` (default: that of the job) receives log.txt, results.xml and the files of the tests.
    """
    built = build(job.design, job.waves)
    folder = folder or job.folder
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    if str(ROOT) not in sys.path:
        sys.path.insert(0, str(ROOT))
    log, results = folder / "log.txt", folder / "results.xml"
    trouble = ""
    try:
        simulator(job.design.main).test(
            test_module=[watchdog.__name__, *dict.fromkeys(item.module for item in job.items)],
            hdl_toplevel=job.design.top,
            hdl_toplevel_lang="verilog",
            build_dir=built,
            test_dir=folder,
            results_xml=str(results),
            log_file=log,
            seed=job.seed,
            test_filter=f"^({'|'.join(re.escape(item.full_name) for item in job.items)})$",
            waves=job.waves,
            plusargs=[
                "+verilator+rand+reset+2",
                f"+verilator+seed+{job.seed % 0x7FFFFFFF + 1}",
                f"+verilator+error+limit+{ERRORS}",
                *mutant_plusargs(),
            ],
            extra_env={
                "OPENPPMC_CONFIG": job.items[0].config.to_json(),
                "OPENPPMC_SEED": str(job.seed),
                "OPENPPMC_OUT": str(folder),
                REPRO: job.repro,
                "COCOTB_LOG_LEVEL": "INFO",
                "COCOTB_ANSI_OUTPUT": "0",
                "COCOTB_REWRITE_ASSERTION_FILES": "*.py",
                # To rewrite assertions, cocotb creates a pytest configuration, which would import every
                # plugin.
                "PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1",
                # Without this option, an expected failure would look like a pass.
                "COCOTB_PREVIEW": "xfail_in_results",
                **job.env,
            },
        )
    except RuntimeError as error:
        trouble = f"the simulator ended: {error}"
    except SystemExit:
        pass  # cocotb has ended the process after a failed test; the outcome of the test states the failure.
    keep_counts(folder)
    return outcomes(job.items, log, results, trouble)
