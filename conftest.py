"""Root conftest: loads the harness plugin for every test of the project."""

import os

# A simulator process, in which cocotb reads this file, needs no plugin.
pytest_plugins = [] if "OPENPPMC_OUT" in os.environ else ["cocotb_tests.harness.plugin"]
