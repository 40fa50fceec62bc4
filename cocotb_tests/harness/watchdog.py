"""Imported first in each simulation: a wall-clock limit for every test, and where Python stood when it ended.

`simulate` names this module in front of those with tests; it holds none. The limit runs anew with each test,
and with each bench of a test that has many (a batch of seeds). What it ends says in the log which line was
waiting, and so does a crash. A simulation of a mutant ends with the first test that fails.
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
"""Environment: seconds of wall clock that a test may take (300)."""


def arm(least: int = 1) -> None:
    """From now on, this process has so many seconds until it is ended; Python need not be running then."""
    faulthandler.dump_traceback_later(max(least, int(os.environ.get(LIMIT, "300"))), exit=True)


class _EachTest(logging.Handler):
    """Follows cocotb from test to test by what it logs; there is no other hook."""

    failed = False

    def emit(self, record: logging.LogRecord) -> None:
        # What the simulator has printed so far belongs before this line.
        ctypes.CDLL(None).fflush(None)
        said = record.getMessage()
        if said.startswith("running "):
            if self.failed and mutant_present():  # that says all of it
                os._exit(1)
            arm()
        self.failed |= re.match(r"\S+ failed\b", said) is not None


def _watch() -> None:
    faulthandler.enable()
    arm(300)  # the imports of the tests, which are no test's time
    logging.getLogger("cocotb.regression").addHandler(_EachTest())
    warnings.filterwarnings("ignore", re.escape(f"No tests were discovered in module: {__name__}"))


if "COCOTB_TEST_MODULES" in os.environ:
    _watch()
