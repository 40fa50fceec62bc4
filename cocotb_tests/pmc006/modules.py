"""The script modules that are played on the RTL, by their import names, and the builds that simulate them.

A new module needs a row here; each build of a row is one simulation. Most run at 8 MHz and 115200 baud, where
they need the fewest clk; a few at the defaults, at a clock that is no multiple of 1 MHz, and in the other
timing mode with the other reply to s.
"""

from __future__ import annotations

from cocotb_tests.harness.config import F16, Config

FAST_LINE = ("BAUD", 115_200)
F8B = Config("f8b", clk_hz=8_000_000, extra=(FAST_LINE,))
ODD = Config(
    "odd11",
    clk_hz=11_059_200,
    extra=(FAST_LINE, ("I2C_HZ", 300_000), ("T_OFF_NS", 7_300), ("T_BLANK_NS", 730), ("EE_DEV", 0x57)),
)
BLANK = Config("blank8", clk_hz=8_000_000, extra=(FAST_LINE, ("T_OFF_NS", 5_900), ("T_BLANK_NS", 3_600)))
"""The blanking is longer than half the off time: so long is FAST at most (P006-CHP-03)."""
D8E = Config("d8echo", clk_hz=8_000_000, timing="DATASHEET", extra=(FAST_LINE, ("STEP_ACK", "ECHO")))

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
