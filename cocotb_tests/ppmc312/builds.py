"""Builds of the PPMC-312 in addition to those that all parts share."""

from __future__ import annotations

from cocotb_tests.harness import Config

F27 = Config("f27m", clk_hz=27_000_000)
F27X12 = Config("odd27x12", clk_hz=27_000_000, xtal_hz=12_000_000)
CHARS = Config("chars", extra=(("SUM_MODE", "CHARS"),))
SLOW = Config("slow_driver", extra=(("SND_LEAD", 3), ("SND_WAIT", 2)))
SLOWEST = Config("slowest_driver", extra=(("SND_LEAD", 16), ("SND_WAIT", 8)))
F8V = Config("f8v34", clk_hz=8_000_000, extra=(("VERSION", 0x34),))
