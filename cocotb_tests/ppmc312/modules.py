"""The script modules that are played on the RTL, by their import names, and the builds that hosts ask for.

A new module needs a row here; each build of a row is one simulation.
"""

from __future__ import annotations

from cocotb_tests.harness.config import D16, F16, Config

from .builds import CHARS, F8V, F27, F27X12

MODULES: dict[str, tuple[Config, ...]] = {
    "cocotb_tests.ppmc312.script_serial_tour": (F16,),
    "tests.ppmc312.model.test_serial_checks": (F16, CHARS),
    "tests.ppmc312.model.test_serial_transactions": (F16,),
    "cocotb_tests.ppmc312.script_serial_line": (F16, F27, F27X12),
    "cocotb_tests.ppmc312.script_serial_frames": (F16, CHARS, F8V),
    "cocotb_tests.ppmc312.script_serial_codes": (F16,),
    "cocotb_tests.ppmc312.script_serial_polls": (F16,),
    "cocotb_tests.ppmc312.script_serial_resets": (F16, D16),
}
