"""Acceptance checks AC-01 to AC-52 on the golden model: the same code as for the RTL."""

from __future__ import annotations

from cocotb_tests.harness.model_tests import model_tests

MODULES = ("tb_acceptance_moves", "tb_acceptance_stops", "tb_acceptance_registers")
globals().update(model_tests(__name__, "cocotb_tests.stmc", *MODULES))
