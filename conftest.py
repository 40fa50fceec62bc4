"""Root conftest: loads the harness plugin for every test of the project."""

pytest_plugins = ["cocotb_tests.harness.plugin"]
