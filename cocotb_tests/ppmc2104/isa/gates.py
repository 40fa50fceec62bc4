"""Tests that `make test-verilog` runs for the four axes on an ISA bus, and the tests that it omits, with the
reason.
"""

from __future__ import annotations

from cocotb_tests.harness.gate_tests import PARAMETERS, PartTests

from . import test_isa
from .setting import BASE, ISA_4AXIS

PART = PartTests(
    test_isa,
    frozenset({"test_isa_4axis"}),
    builds=frozenset({"f16"}),
    not_applicable={
        "test_isa_4axis_random": "further seeds of one of the directed tests",
        "test_isa_slave": "the slave alone; it is part of what is tested",
        "test_bad_base_address": PARAMETERS,
    },
    quick=frozenset({"tb_bus"}),
    four_state=frozenset({"isa_source_register"}),
    netlists=False,
    pins=ISA_4AXIS,
    params={"BASE_ADDR": BASE},
    probes=("d", "d_oe", "int_n"),
)
