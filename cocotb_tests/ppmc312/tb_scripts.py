"""Plays the scripts of each module on the RTL: one cocotb test a module (see `scripts`, `modules`).

OPENPPMC_SCRIPT in the environment picks scripts by a part of their names.
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import cocotb

from cocotb_tests.common.bench import Bench
from cocotb_tests.common.config import Config, configs
from cocotb_tests.common.part import PPMC312
from cocotb_tests.common.tape import play, taping
from cocotb_tests.common.verifies import verifies

from .modules import MODULES
from .scripts import cases, fits, rules


async def _play(dut: Any, path: str, builds: Sequence[Config]) -> None:
    bench = await Bench.start(dut, PPMC312)
    played, failed = 0, []
    for case in cases(path, os.environ.get("OPENPPMC_SCRIPT", "")):
        with taping() as tapes:
            try:
                case.call()
            except AssertionError as error:
                failed.append(f"{case.name}\non the golden model: {error!r}")
        for tape in tapes:
            assert any(fits(tape, build) for build in builds), f"{case.name}: no build with {tape.params}"
            if not fits(tape, bench.config):
                continue
            played += 1
            try:
                await play(bench, tape, case.name)
            except AssertionError as error:
                failed.append(str(error))
    assert played, f"{path}: nothing to play in {bench.config.name}"
    every = [f"  {text.splitlines()[0]}: {text.splitlines()[1]}" for text in failed]
    assert not failed, "\n".join(
        [f"{len(failed)} failures, {played} tapes played; the first one:", failed[0], "all of them:", *every]
    )


def _test(path: str, builds: tuple[Config, ...]) -> Any:
    async def run(dut: Any) -> None:
        await _play(dut, path, builds)

    run.__name__ = run.__qualname__ = name(path)
    run.__doc__ = f"Given the scripts of {path}, when the RTL gets their pins, then all outputs agree."
    return cocotb.test()(verifies(*rules(path))(configs(*builds)(run)))


def name(path: str) -> str:
    """Name of the cocotb test that plays a module."""
    return "p312_" + Path(path).stem.removeprefix("test_312_").removeprefix("script_")


for _path, _builds in MODULES.items():
    globals()[name(_path)] = _test(_path, _builds)
