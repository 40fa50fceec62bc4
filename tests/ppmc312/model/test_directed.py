"""The directed tests of the PPMC-312 RTL, run on the golden model."""

from __future__ import annotations

from cocotb_tests.harness.model_tests import model_tests
from cocotb_tests.ppmc312.test_part import MODULES

globals().update(model_tests(__name__, "cocotb_tests.ppmc312", *MODULES))
