"""Old name of `env.py`; it is removed after the next release."""

from cocotb_tests.harness.deprecated import with_old_names

__getattr__ = with_old_names(__name__, {"Lab": "cocotb_tests.ppmc2104.env:Env"})
