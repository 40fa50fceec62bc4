"""One simulator process for one or more tests of one build."""

from __future__ import annotations

import os
import re
import shutil
import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from . import coverage, mutant, watchdog
from .build import Design, build, simulator
from .collect import Item
from .outcome import Outcome, outcomes
from .paths import ROOT, RUNS
from .verilate import ICARUS, sim_main

REPRO = "OPENPPMC_REPRO"
"""Tells a simulation the command that repeats it, for its messages."""
VCD = "dump.vcd"
"""Waveforms, in the folder of a run."""
ERRORS = 1_000_000
"""%Error lines, such as assertions of the RTL that fire, before Verilator ends the process."""


@dataclass(frozen=True)
class Job:
    """What a simulator process is to do; run again, it does the same. `env` goes to the simulation."""

    design: Design
    items: tuple[Item, ...]
    seed: int
    waves: bool = False
    env: Mapping[str, str] = field(default_factory=dict)

    @property
    def repro(self) -> str:
        """The line that repeats it."""
        return self.env.get(REPRO) or repro_line(self.items, self.seed)

    @property
    def folder(self) -> Path:
        """Scratch folder; the process number keeps parallel sessions apart."""
        more = f"+{len(self.items) - 1}" if len(self.items) > 1 else ""
        return RUNS / f"{safe(self.items[0].id)}{more}-s{self.seed}.{os.getpid()}"


def safe(name: str) -> str:
    """A name that can be a folder's."""
    return re.sub(r"[^\w.=-]+", "_", name)


def repro_line(items: Sequence[Item], seed: int) -> str:
    """The line that repeats these tests, in one process if there are several."""
    names = ",".join(item.id for item in items)
    main = {"own": "", ICARUS: " SIM=icarus"}.get(sim_main(), f" SIM_MAIN={sim_main()}")
    if items[0].target != "test":
        return f"make {items[0].target} T={names} SEED={seed}{main}"
    return f"make test T={names} SEED={seed} CLK_HZ={items[0].config.clk_hz}{main}"


def tried(job: Job) -> dict[Item, Outcome]:
    """As `simulate`; nothing of it is left."""
    try:
        return simulate(job)
    finally:
        shutil.rmtree(job.folder, ignore_errors=True)


def simulate(job: Job, folder: Path | None = None) -> dict[Item, Outcome]:
    """Build if needed and run; the outcome of each item. SimError only if the build fails.

    `folder` (default: the job's) receives log.txt, results.xml and what the tests write.
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
                *mutant.plusargs(),
            ],
            extra_env={
                "OPENPPMC_CONFIG": job.items[0].config.to_json(),
                "OPENPPMC_SEED": str(job.seed),
                "OPENPPMC_OUT": str(folder),
                REPRO: job.repro,
                "COCOTB_LOG_LEVEL": "INFO",
                "COCOTB_ANSI_OUTPUT": "0",
                "COCOTB_REWRITE_ASSERTION_FILES": "*.py",
                # cocotb makes a configuration of pytest for that, which would import every installed plugin.
                "PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1",
                # Without it an expected failure looks like a pass.
                "COCOTB_PREVIEW": "xfail_in_results",
                **job.env,
            },
        )
    except RuntimeError as error:
        trouble = f"the simulator ended: {error}"
    except SystemExit:
        pass  # some test failed, as its outcome says
    coverage.keep(folder)
    return outcomes(job.items, log, results, trouble)
