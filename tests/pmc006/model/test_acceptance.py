"""Acceptance checks AC-01 to AC-67 on the golden model.

They are the tests of the RTL, here with the literal values of the manual (9600 baud, 16 MHz), and some checks
that last too long for the RTL.
"""

from __future__ import annotations

import importlib

import pytest

from cocotb_tests.harness import F16, Config, OnModel, on_model, verifies
from cocotb_tests.harness.collect import all_tests
from cocotb_tests.harness.model_tests import model_tests
from cocotb_tests.pmc006.builds import FAST_LINE
from cocotb_tests.pmc006.host import Host
from cocotb_tests.pmc006.moves import ready

PACKAGE = "cocotb_tests.pmc006"
SHORT = ("tb_acceptance_link", "tb_acceptance_motion", "tb_acceptance_guard", "tb_acceptance_program")
globals().update(model_tests(__name__, PACKAGE, *SHORT, "tb_acceptance_memory", builds=(F16,)))
globals().update(model_tests(__name__, PACKAGE, "tb_acceptance_modes", "tb_acceptance_long"))

OTHERS = (
    Config("datasheet", clk_hz=8_000_000, timing="DATASHEET", extra=(FAST_LINE,)),
    Config("echo", clk_hz=8_000_000, extra=(FAST_LINE, ("STEP_ACK", "ECHO"))),
)


@pytest.mark.parametrize("build", OTHERS, ids=[build.name for build in OTHERS])
@verifies("P006-AC-48", "P006-AC-53")
def test_ac_48(build: Config, monkeypatch: pytest.MonkeyPatch) -> None:
    """The checks without an EEPROM also pass with other parameters, in the short form in which the RTL runs
    them.
    """
    monkeypatch.setattr(Host, "literal", False)
    run = 0
    for name in SHORT:
        for test in all_tests(importlib.import_module(f"{PACKAGE}.{name}")):
            for case in test.generate_tests():
                on_model(case.func(OnModel(build), **case.kwargs))
                run += 1
    assert run > 40


@verifies("P006-AC-29", "P006-EXC-40")
def test_ac_29() -> None:
    """In 256 cycles, a bit stream that is not recorded has the number of ones that its reference states."""

    async def check() -> None:
        host = await ready(OnModel(F16))
        await host.ok(a=0)
        for current in (400, 1000, 4000):
            await host.ok(e=current)
            await host.pause(300)
            for phase in "ab":
                ones = 0
                for _ in range(256):
                    await host.pause(1)
                    ones += host.bench.golden.pwm(phase)
                assert ones == await host.out(f"phase_{phase}_ref")

    on_model(check())
