"""Random hosts and noise on all pins, compared with the golden model in every cycle."""

from __future__ import annotations

from typing import Any

from cocotb_tests.harness import random_test

from . import random_host, random_noise, random_serial


@random_test(
    "P312-GEN-01",
    "P312-GEN-12",
    "P312-PAR-05",
    "P312-PAR-08",
    "P312-RSP-11",
    "P312-RSP-20",
    "P312-BLK-01",
    "P312-OVR-02",
    "P312-OVR-10",
    "P312-OVR-11",
    "P312-MOT-01",
    "P312-MOT-02",
    "P312-MOT-30",
    "P312-MOT-33",
    "P312-MOT-34",
    "P312-INP-12",
    "P312-BAD-09",
    least=200,
)
async def p312_random_host(dut: Any, seed: int) -> None:
    """With the pin changes of random hosts, all outputs change as in the golden model."""
    await random_host.play(dut, seed)


@random_test("P312-BAD-15", "P312-MOT-20", "P312-MOT-30", "P312-MOT-32", "P312-MOT-33", least=200)
async def p312_random_changes(dut: Any, seed: int) -> None:
    """As with random hosts, but in tables that are not monotonic, and with many changes of the speed."""
    await random_host.play_changes(dut, seed)


@random_test(
    "P312-BAD-01", "P312-BAD-02", "P312-BAD-09", "P312-PAR-09", "P312-PAR-10", "P312-GEN-01", least=1
)
async def p312_random_noise(dut: Any, seed: int) -> None:
    """With noise on all pins, all outputs change as in the golden model."""
    await random_noise.play(dut, seed)


@random_test(
    "P312-SER-01",
    "P312-SER-10",
    "P312-SER-11",
    "P312-SER-12",
    "P312-SER-14",
    "P312-SER-15",
    "P312-SER-16",
    "P312-SER-18",
    "P312-SER-19",
    "P312-SER-21",
    "P312-SER-22",
    "P312-SER-30",
    "P312-BAD-16",
    "P312-PRT-01",
    least=200,
)
async def p312_random_serial(dut: Any, seed: int) -> None:
    """With the pin changes of random hosts on the line, all outputs change as in the golden model."""
    await random_serial.play(dut, seed)
