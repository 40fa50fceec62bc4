"""The script modules that are played on the RTL, and the builds that their hosts ask for.

A new module needs a row here; each build of a row is one simulation.
"""

from __future__ import annotations

from cocotb_tests.harness.config import D16, F16, F50, Config

F27 = Config("f27m", clk_hz=27_000_000)
F27X12 = Config("odd27x12", clk_hz=27_000_000, xtal_hz=12_000_000)
CHARS = Config("chars", extra=(("SUM_MODE", "CHARS"),))
F8V = Config("f8v34", clk_hz=8_000_000, extra=(("VERSION", 0x34),))

MODULES: dict[str, tuple[Config, ...]] = {
    "tests/ppmc312/model/test_checks_host.py": (F16, D16),
    "tests/ppmc312/model/test_checks_events.py": (F16, D16),
    "tests/ppmc312/model/test_checks_motion.py": (F16,),
    "tests/ppmc312/model/test_searches.py": (F16,),
    "tests/ppmc312/model/test_monitors.py": (F16,),
    "tests/ppmc312/model/test_transactions.py": (F16,),
    "tests/ppmc312/model/test_accept.py": (F16,),
    "tests/ppmc312/model/test_edges.py": (F16, D16, F8V),
    "tests/ppmc312/model/test_meetings.py": (F16, D16),
    "tests/ppmc312/model/test_clock.py": (F16, F27, F8V),
    "tests/ppmc312/model/test_datasheet.py": (D16,),
    "cocotb_tests/ppmc312/script_bounds.py": (F16,),
    "cocotb_tests/ppmc312/script_bus.py": (F16, D16),
    "cocotb_tests/ppmc312/script_goals.py": (F50,),
    "cocotb_tests/ppmc312/script_settings.py": (F16,),
    "cocotb_tests/ppmc312/script_motion.py": (F16,),
    "cocotb_tests/ppmc312/script_abnormal.py": (F16,),
    "cocotb_tests/ppmc312/script_terminals.py": (F16, F27, D16),
    "cocotb_tests/ppmc312/script_serial_tour.py": (F16,),
    "tests/ppmc312/model/test_serial_checks.py": (F16, CHARS),
    "tests/ppmc312/model/test_serial_transactions.py": (F16,),
    "cocotb_tests/ppmc312/script_serial_line.py": (F16, F27, F27X12),
    "cocotb_tests/ppmc312/script_serial_frames.py": (F16, CHARS, F8V),
    "cocotb_tests/ppmc312/script_serial_codes.py": (F16,),
    "cocotb_tests/ppmc312/script_serial_polls.py": (F16,),
    "cocotb_tests/ppmc312/script_serial_resets.py": (F16, D16),
}
