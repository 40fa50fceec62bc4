"""The script modules that are played on the RTL, by their import names, and the builds that simulate them."""

from __future__ import annotations

from cocotb_tests.harness.config import Config

from .builds import F8B

MODULES: dict[str, tuple[Config, ...]] = {
    "cocotb_tests.pmc006.script_current": (F8B,),
}
