"""Runs a test on both main programs, ours and cocotb's: what is recorded on them has to be the same."""

from __future__ import annotations

import os
import shutil
from collections.abc import Mapping
from dataclasses import replace

from .build import Design, part_design
from .collect import Item
from .compare import DIGEST_FILE, DIGESTS
from .paths import RUNS
from .runner import run_sim
from .simulate import safe
from .verilate import MAINS


def recorded(item: Item, main: str, env: Mapping[str, str], design: Design) -> list[str]:
    """Digests of what the test compares with the golden model, in order: pins, host's accesses, output edges.

    Raises SimError if the test does not pass.
    """
    folder = RUNS / f"{safe(item.id)}-{main}.{os.getpid()}"
    run_sim(replace(design, main=main), item, item.seed, env={**env, DIGESTS: "1"}, folder=folder)
    left = folder / DIGEST_FILE
    digests = left.read_text(encoding="ascii").split() if left.is_file() else []
    shutil.rmtree(folder, ignore_errors=True)
    return digests


def check_mains(item: Item, env: Mapping[str, str] | None = None, design: Design | None = None) -> int:
    """Number of recordings that the test makes; AssertionError if they are not the same on both mains."""
    design = design or part_design(item.part, item.config)
    own, cocotb = (recorded(item, main, env or {}, design) for main in MAINS)
    assert own and own == cocotb, f"{item.id}: {own} with our main program, {cocotb} with cocotb's"
    return len(own)
