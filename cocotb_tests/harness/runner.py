"""Runs one cocotb test per simulator process.

All simulations of the project go through `run_item` / `run_sim`; the traps of the tool chain that shaped it:
one process a test (a failed assertion ends the whole process), results.xml must hold exactly the test
asked for (else nothing ran), exit codes count too, string parameters must be SystemVerilog literals.
"""

from __future__ import annotations

import os
import re
import shutil
import sys
import textwrap
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from xml.etree import ElementTree

import pytest

from .build import Design, SimError, build, from_root, part_design, simulator
from .collect import Item
from .config import CONFIGS, Config
from .paths import FAILURES, ROOT, RUNS, relative
from .seeds import last_seed

REPRO = "OPENPPMC_REPRO"
"""Tells a simulation the command that repeats it, for its messages."""


@dataclass(frozen=True)
class SimOptions:
    """What the user asked for on the command line; seed None = the fixed default of each test."""

    seed: int | None = None
    waves_on_failure: bool = True


def _failure_text(log: Path, lines: int = 100) -> str:
    """The exception of the test from the log if there is one, else the log's end."""
    if not log.is_file():
        return "(no log)"
    text = re.sub(r"\x1b\[[0-9;]*m", "", log.read_text(encoding="utf-8", errors="replace"))
    text = from_root(text)
    error = text.find("%Error")
    start = error if error >= 0 else text.rfind("Traceback (most recent call last)")
    chosen = text[max(0, text.rfind("\n", 0, start) + 1) :] if start >= 0 else text
    # The summary table of cocotb says nothing that the message does not.
    chosen = re.split(r"\n[^\n]*\*{20,}", chosen)[0]
    if chosen.lstrip().startswith("Traceback"):
        chosen = chosen.split("\n", 1)[-1]
    rows = [*last_seed(text), *textwrap.dedent(chosen.rstrip()).splitlines()]
    return "\n".join(rows if len(rows) <= lines else [*rows[:6], "  ...", *rows[-lines + 7 :]])


def run_folder(item: Item, seed: int) -> Path:
    """Scratch folder of one run; the process number keeps parallel sessions apart."""
    return RUNS / f"{_safe(item.id)}-s{seed}.{os.getpid()}"


def failure_folder(item: Item, seed: int) -> Path:
    """Where the files of a failing run are kept."""
    return FAILURES / f"{_safe(item.id)}-s{seed}"


def repro_line(item: Item, seed: int) -> str:
    """The line that repeats one test."""
    if item.target != "test":
        return f"make {item.target} T={item.id} SEED={seed}"
    return f"make test T={item.id} SEED={seed} CLK_HZ={item.config.clk_hz}"


def run_sim(
    design: Design,
    item: Item,
    seed: int,
    waves: bool = False,
    env: Mapping[str, str] | None = None,
    folder: Path | None = None,
    repro: str | None = None,
) -> Path:
    """Build if needed and run one cocotb test in one process; returns the folder of the run.

    `folder` (default below build/runs/) receives log.txt, results.xml and what the test writes.
    Raises SimError unless results.xml holds exactly this test, passed, and the process ended well.
    """
    built = build(design, waves)
    folder = folder or run_folder(item, seed)
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    if str(ROOT) not in sys.path:
        sys.path.insert(0, str(ROOT))
    repro = repro or repro_line(item, seed)
    log, results = folder / "log.txt", folder / "results.xml"
    trouble = ""
    try:
        simulator().test(
            test_module=item.module,
            hdl_toplevel=design.top,
            hdl_toplevel_lang="verilog",
            build_dir=built,
            test_dir=folder,
            results_xml=str(results),
            log_file=log,
            seed=seed,
            test_filter=rf"\.{re.escape(item.test)}$",
            waves=waves,
            plusargs=["+verilator+rand+reset+2", f"+verilator+seed+{seed % 0x7FFFFFFF + 1}"],
            extra_env={
                "OPENPPMC_CONFIG": item.config.to_json(),
                "OPENPPMC_SEED": str(seed),
                "OPENPPMC_OUT": str(folder),
                REPRO: repro,
                "COCOTB_LOG_LEVEL": "INFO",
                # Values of plain asserts cost a quarter of a second a process: only in the run with waves.
                "COCOTB_REWRITE_ASSERTION_FILES": "*.py" if waves else "",
                **(env or {}),
            },
        )
    except (RuntimeError, SystemExit) as error:
        trouble = f"simulator ended with {error.args[0] if error.args else 'no code'}"
    trouble = _judge(results, item.test) or trouble
    if trouble:
        raise SimError(
            f"{item.id}: {trouble}\n{_failure_text(log)}\n"
            f"seed {seed}, log {relative(log)}\nrepeat with: {repro}"
        )
    return folder


def _judge(results: Path, test: str) -> str:
    """Empty if results.xml holds exactly `test`, passed; else what is wrong."""
    if not results.is_file():
        return "the simulator left no results.xml (crash, $fatal, or wall-clock limit)"
    cases = list(ElementTree.parse(results).getroot().iter("testcase"))
    names = [case.get("name") for case in cases]
    if names != [test]:
        return f"expected exactly the test {test}, results.xml has {names}"
    for kind in ("failure", "error", "skipped"):
        if cases[0].find(kind) is not None:
            return "failed" if kind != "skipped" else "was skipped"
    return ""


def _safe(name: str) -> str:
    return re.sub(r"[^\w.=-]+", "_", name)


def attempt(
    item: Item,
    options: SimOptions | None = None,
    env: Mapping[str, str] | None = None,
    design: Design | None = None,
) -> str:
    """Run one item; "" if it passed, else a short message with the repro line.

    A failing test is run a second time with waves; its files go to build/failures/<test>/.
    `design` (default: the part of the item) is what is simulated.
    """
    options = options or SimOptions()
    seed = item.seed if options.seed is None else options.seed
    repro = (env or {}).get(REPRO) or repro_line(item, seed)
    kept, first = failure_folder(item, seed), run_folder(item, seed)
    shutil.rmtree(kept, ignore_errors=True)
    try:
        design = design or part_design(item.part, item.config)
        shutil.rmtree(run_sim(design, item, seed, env=env, repro=repro), ignore_errors=True)
        return ""
    except SimError as error:
        message = str(error)
    if not first.is_dir():
        return f"{item.id}: {message}\nrepeat with: {repro}"
    if options.waves_on_failure:
        try:
            run_sim(design, item, seed, True, env, kept, repro)
            message += "\n(a second run, with waves, passed: the test is not deterministic)"
        except SimError as error:
            if (kept / "dump.vcd").is_file():
                message = f"{error}\nwaves in {relative(kept / 'dump.vcd')}"
            else:
                message += f"\nno waves: {str(error).splitlines()[0]}"
        shutil.rmtree(first, ignore_errors=True)
    else:
        kept.parent.mkdir(parents=True, exist_ok=True)
        shutil.move(first, kept)
    return message.replace(relative(first), relative(kept))


def run_item(
    item: Item,
    options: SimOptions | None = None,
    env: Mapping[str, str] | None = None,
    design: Design | None = None,
) -> None:
    """Run one collected item as a pytest test: silent if it passes, else the message of `attempt`."""
    __tracebackhide__ = True
    if message := attempt(item, options, env, design):
        pytest.fail(message, pytrace=False)


def config_named(name: str) -> Config:
    """Shared configuration by name; KeyError lists what there is."""
    try:
        return CONFIGS[name]
    except KeyError:
        raise KeyError(f"no configuration {name!r}; there are {', '.join(CONFIGS)}") from None
