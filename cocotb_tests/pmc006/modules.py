"""The script modules that are played on the RTL, by their import names, and the builds that simulate them.

A new module needs a row here; each build of a row is one simulation. Most run at 8 MHz and 115200 baud, where
they need the fewest clk; a few at the defaults, at a clock that is no multiple of 1 MHz, and in the other
timing mode with the other reply to s.
"""

from __future__ import annotations

from cocotb_tests.harness.config import F16, Config

from .builds import BLANK, D8E, F8B, ODD

MODULES: dict[str, tuple[Config, ...]] = {
    "tests.pmc006.model.test_checks_link": (F8B,),
    "tests.pmc006.model.test_checks_motion": (F8B,),
    "tests.pmc006.model.test_checks_guard": (F8B,),
    "tests.pmc006.model.test_checks_modes": (D8E,),
    "tests.pmc006.model.test_checks_program": (F8B,),
    "cocotb_tests.pmc006.script_tour": (F8B, F16, D8E),
    "cocotb_tests.pmc006.script_link": (F8B, ODD),
    "cocotb_tests.pmc006.script_codes": (F8B,),
    "cocotb_tests.pmc006.script_motion": (F8B,),
    "cocotb_tests.pmc006.script_angle": (F8B,),
    "cocotb_tests.pmc006.script_bridge": (F8B, ODD, BLANK),
    "cocotb_tests.pmc006.script_current": (F8B,),
    "cocotb_tests.pmc006.script_guard": (F8B,),
    "cocotb_tests.pmc006.script_analog": (F8B,),
    "cocotb_tests.pmc006.script_clock": (ODD,),
    "cocotb_tests.pmc006.script_states": (F8B,),
    "cocotb_tests.pmc006.script_keys": (F8B,),
    "cocotb_tests.pmc006.script_program": (F8B,),
    "cocotb_tests.pmc006.script_waits": (F8B,),
    "cocotb_tests.pmc006.script_eeprom": (F8B,),
    "cocotb_tests.pmc006.script_save": (F8B,),
    "cocotb_tests.pmc006.script_meetings": (F8B,),
}
