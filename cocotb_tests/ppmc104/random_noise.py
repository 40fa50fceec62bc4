"""Noise on every input pin of the PPMC-104."""

from __future__ import annotations

from cocotb_tests.harness import RtlBench
from cocotb_tests.harness.random_host import PinNoise

STROBES = ("wr_n", "wr_n", "wr_n", "rd_n", "cs_n")
CODES = (
    0x0A, 0x1A, 0x2A, 0x1E, 0x40, 0x41, 0x42, 0x43, 0x44, 0x4D, 0x46, 0x47, 0xC0, 0xC3, 0xC6, 0x84, 0x86,
    0x80,
)  # fmt: skip


def noise(bench: RtlBench) -> PinNoise:
    """Return the noise for the seed of this test bench."""
    return PinNoise(bench, STROBES, CODES)
