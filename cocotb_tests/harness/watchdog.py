"""Limits the wall-clock time of every test of a simulation; prints a Python trace when the limit expires.

This module contains no tests; each simulation imports it before the modules with tests (`simulate`). Each
test restarts the limit. In a test with many benches (a batch of seeds), each bench restarts it, too. When the
limit ends the process or the process crashes, the log states which line was waiting. A simulation of a mutant
ends with the first test that fails.
"""

from __future__ import annotations

import ctypes
import faulthandler
import logging
import os
import re
import warnings

from .variants import mutant_present

LIMIT = "OPENPPMC_WALL_S"
"""Environment variable: maximum wall-clock time of a test in seconds (default 300)."""


def arm(least: int = 1) -> None:
    """Restart the limit: the process ends after `least` seconds or more, even if Python is not running."""
    faulthandler.dump_traceback_later(max(least, int(os.environ.get(LIMIT, "300"))), exit=True)


class _EachTest(logging.Handler):
    """Follows cocotb from test to test by its log messages, because there is no other hook."""

    failed = False

    def emit(self, record: logging.LogRecord) -> None:
        # Print the output of the simulator before this line.
        ctypes.CDLL(None).fflush(None)
        said = record.getMessage()
        if said.startswith("running "):
            if self.failed and mutant_present():  # one failure is sufficient for a mutant
                os._exit(1)
            arm()
        self.failed |= re.match(r"\S+ failed\b", said) is not None


def _watch() -> None:
    faulthandler.enable()
    arm(300)  # This limit applies to the imports of the tests, which are not part of any test.
    logging.getLogger("cocotb.regression").addHandler(_EachTest())
    warnings.filterwarnings("ignore", re.escape(f"No tests were discovered in module: {__name__}"))


if "COCOTB_TEST_MODULES" in os.environ:
    _watch()
