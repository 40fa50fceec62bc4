"""Carriers with their bridge: during reads the data pins are not driven, straps drive their pins, and the
STMC has its step clock.
"""

from __future__ import annotations

from typing import Any

import cocotb
from cocotb.triggers import ValueChange

from cocotb_tests.harness import PARTS, configs

from .bench import Bench, same
from .settings import FAST, RECORDING

STRAPS = {
    "ppmc104": {"csel": (0,), "vsel": (1,)},
    "ppmc2104": {"csel": (0, 1), "run": (2, 3), "errint_n": (4,)},
    "ppmc312": {"run": (0,), "evt0_n": (1,), "evt1_n": (2,)},
}
"""Pins that straps can pull to 0, with the number of the strap for each bit."""


async def start(dut: Any, part: str) -> Bench:
    """Start the carrier with idle pins and release reset."""
    idle = {"rs485_rxd": 1, **PARTS[part].inputs}
    return await Bench.of_carrier(dut, {pin: level for pin, level in idle.items() if hasattr(dut, pin)})


@cocotb.test()
@cocotb.parametrize(part=["ppmc104", "ppmc2104", "stmc", "ppmc312"])
@configs(FAST)
async def carrier_keeps_its_reads(dut: Any, part: str) -> None:
    """During reads through the bridge, d_oe stays 0."""
    bench = await start(dut, part)
    moves = []

    async def watch() -> None:
        while True:
            await ValueChange(dut.d_oe)
            moves.append(int(dut.d_oe.value))

    cocotb.start_soon(watch())
    for register in range(2):
        assert len(await bench.done(f"2{register}")) == 1
    same("d_oe", (int(dut.d_oe.value), moves), (0, []))


@cocotb.test()
@cocotb.parametrize(part=list(STRAPS))
@configs(FAST)
async def carrier_straps(dut: Any, part: str) -> None:
    """Each strap with the value 0 pulls exactly one bit of one pin to 0; a pin that is already 0 stays 0."""
    bench = await start(dut, part)

    def levels() -> dict[str, int]:
        return {pin: int(getattr(dut, f"part_{pin}").value) for pin in STRAPS[part]}

    ones = {pin: (1 << len(bits)) - 1 for pin, bits in STRAPS[part].items()}
    for pin, level in ones.items():
        getattr(dut, pin).value = level
    for strap in (*range(8), None):
        await bench.done(f"07 {0xFF & ~(1 << strap) if strap is not None else 0xFF:02X}")
        await bench.clocks(8)
        expected = {
            pin: ones[pin] & ~(1 << bits.index(strap) if strap in bits else 0)
            for pin, bits in STRAPS[part].items()
        }
        same(f"strap {strap} at 0", levels(), expected)
    for pin in ones:
        getattr(dut, pin).value = 0
        await bench.clocks(8)
        same(f"{pin} at 0", levels(), {**ones, pin: 0})
        getattr(dut, pin).value = ones[pin]


@cocotb.test()
@cocotb.parametrize(part=["stmc"])
@configs(FAST, RECORDING)
async def carrier_step_clock(dut: Any, part: str) -> None:
    """Strap 0 stops an STMC on its external clock only if the carrier has a recorder."""
    bench = await start(dut, part)
    stops = "Record" in dict(bench.config.extra)
    await bench.done("55 1A 05 05 00 00")
    for straps, moves in (("FF", True), ("FE", not stops), ("01", True)):
        await bench.done(f"07 {straps}")
        before = int(dut.s.value)
        await bench.done("54 43 FF 00 00")
        await bench.ms(1)
        same(f"steps with straps {straps}", int(dut.s.value) != before, moves)
        same(f"hold with straps {straps}", int(dut.hold.value), 0)
        await bench.done("51 40")
