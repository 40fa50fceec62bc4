"""Builds in which the tests of the PMC006B4 run, and the decorator `directed` with the usual build as its
default.

Most tests run at 8 MHz and 115200 baud, which needs the fewest cycles. A few tests use another build: the
default parameters, a clock that is not a multiple of 1 MHz, or the other timing mode together with the other
reply to instruction s.
"""

from __future__ import annotations

from functools import partial

from cocotb_tests.harness import Config, directed

FAST_LINE = ("BAUD", 115_200)
F8B = Config("f8b", clk_hz=8_000_000, extra=(FAST_LINE,))
ODD = Config(
    "odd11",
    clk_hz=11_059_200,
    extra=(FAST_LINE, ("I2C_HZ", 300_000), ("T_OFF_NS", 7_300), ("T_BLANK_NS", 730), ("EE_DEV", 0x57)),
)
BLANK = Config("blank8", clk_hz=8_000_000, extra=(FAST_LINE, ("T_OFF_NS", 5_900), ("T_BLANK_NS", 3_600)))
"""A build whose T_BLANK is longer than half of T_OFF, so that T_BLANK limits the fast decay (P006-CHP-03)."""
D8E = Config("d8echo", clk_hz=8_000_000, timing="DATASHEET", extra=(FAST_LINE, ("STEP_ACK", "ECHO")))

directed = partial(directed, builds=(F8B,))
"""`harness.run_context.directed` with build `F8B` as the default."""
