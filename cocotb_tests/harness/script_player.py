"""Plays the scripts of a module on the RTL: makes one cocotb test of each module (see `scripts`).

OPENPPMC_SCRIPT in the environment picks scripts by a part of their names.
"""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import Any

import cocotb

from openppmc import parts

from .bench import Bench
from .config import Config, configs
from .part import Part
from .scripts import building, cases, fits, rules
from .tape import play, taping
from .verifies import verifies


async def play_module(dut: Any, part: Part, script: str, builds: Sequence[Config]) -> None:
    """Run all scripts of a module on the model and play their tapes; AssertionError tells all failures."""
    bench = await Bench.start(dut, part)
    played, failed = 0, []
    for case in cases(script, os.environ.get("OPENPPMC_SCRIPT", "")):
        with taping() as tapes, building(bench.config):
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
    assert played, f"{script}: nothing to play in {bench.config.name}"
    every = [f"  {text.splitlines()[0]}: {text.splitlines()[1]}" for text in failed]
    assert not failed, "\n".join(
        [f"{len(failed)} failures, {played} tapes played; the first one:", failed[0], "all of them:", *every]
    )


def _test(part: Part, script: str, builds: tuple[Config, ...], name: str, module: str) -> Any:
    async def run(dut: Any) -> None:
        await play_module(dut, part, script, builds)

    # cocotb notes the module when it makes a test of it, and the runner asks for the test by both.
    run.__name__, run.__qualname__, run.__module__ = name, name, module
    run.__doc__ = f"Given the scripts of {script}, when the RTL gets their pins, then all outputs agree."
    return cocotb.test()(verifies(*rules(script))(configs(*builds)(run)))


def module_tests(part: Part, modules: Mapping[str, tuple[Config, ...]], module: str) -> dict[str, Any]:
    """The cocotb tests of all script modules, by name, as globals of the Python module called `module`."""
    tests = {}
    for script, builds in modules.items():
        stem = script.rpartition(".")[2].removeprefix("test_").removeprefix("script_")
        name = f"{parts.part(part.name).rules[0].lower()}_{stem}"
        assert name not in tests, f"{script}: second module called {name}"
        tests[name] = _test(part, script, builds, name, module)
    return tests
