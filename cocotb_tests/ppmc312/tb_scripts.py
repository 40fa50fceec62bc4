"""Plays the scripts of each module on the RTL: one cocotb test a module (see `script_player`, `modules`)."""

from __future__ import annotations

from cocotb_tests.harness.script_player import module_tests

from .bench import PPMC312
from .modules import MODULES

globals().update(module_tests(PPMC312, MODULES, __name__))
