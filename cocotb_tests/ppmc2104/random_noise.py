"""Noise on every input pin of the PPMC-2104AFP except the selection of the bus style."""

from __future__ import annotations

from cocotb_tests.harness import RtlBench
from cocotb_tests.harness.random_host import PinNoise

STROBES = ("ds_wrs_n", "ds_wrs_n", "rw_rds_n", "rw_rds_n", "cs_n")
_ONE_AXIS = (
    0x02,
    0x12,
    0x0A,
    0x40,
    0x41,
    0x42,
    0x43,
    0x44,
    0x4D,
    0x46,
    0x47,
    0xC0,
    0xC3,
    0xC6,
    0x84,
    0x85,
    0x80,
)
CODES = (*_ONE_AXIS, *(code | 0x20 for code in _ONE_AXIS), 0xC1, 0xC2)


def noise(bench: RtlBench) -> PinNoise:
    """Return the noise for the seed of this test bench."""
    return PinNoise(bench, STROBES, CODES, still=("busc",))
