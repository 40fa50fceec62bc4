"""Old name of `scripts.measure.sim_mains`; it is removed after the next release."""

from __future__ import annotations

import sys
import warnings

from cocotb_tests.harness.project import run
from scripts.measure.sim_mains import main

if __name__ == "__main__":
    warnings.warn("use python -m scripts.measure.sim_mains", DeprecationWarning, stacklevel=1)
    sys.exit(run(main))
