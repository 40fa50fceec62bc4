"""Random hosts on the PPMC-312 model: with any input, the part answers, counts, and never hangs."""

from __future__ import annotations

import os
import random

import pytest

from cocotb_tests.harness import D16, F16, OnModel, on_model
from cocotb_tests.harness.bus import CSR, MREF, MWEF
from cocotb_tests.ppmc312.blocks import TF, TG, TH
from cocotb_tests.ppmc312.host import Host
from cocotb_tests.ppmc312.messages import message
from openppmc.model.ppmc312.codes import LENGTHS, Code, State

FIRST = int(os.environ.get("OPENPPMC_SEED", "0"))
SEEDS = range(FIRST, FIRST + 40)
PINS = ("evt0_n", "evt1_n", "fl_n", "bl_n", "fhl_n", "bhl_n", "org_n", "index_n", "end_n")


def instruction(rng: random.Random) -> bytes:
    """Return an instruction block: usually a legal one, sometimes random bytes."""
    if rng.random() < 0.08:
        return bytes(rng.randrange(256) for _ in range(rng.randint(1, 32)))
    code = rng.choice([*LENGTHS, 0x82, 0x82, 0x83, 0x80, 0x81, 0x87, 0x88, 0x10, 0x11, 0x46])
    while code == 0xFF:
        code = rng.choice(list(LENGTHS))
    length = rng.choice(LENGTHS.get(code, (1,)))
    data = bytearray(rng.choice((0, 0, 1, 2, 4, 5, 7, 0x40, 0x44, 0x50)) for _ in range(length - 1))
    if code in (0x82, 0x83, 0x85, 0x86, 0x87, 0x88, 0x10, 0x11) and length >= 4 and code:
        rate = rng.choice((0, 100, 100, 150, 200, 300, 400, 401))
        if not (code == 0x82 and length == 6):
            data[1:3] = rate.to_bytes(2, "big")
    if length >= 6:
        data[-4:] = rng.choice((1, 7, 23, 30, 60)).to_bytes(4, "big")
    if code == 0x49:
        inner = instruction(rng)[2:16] or b"\x40"
        data = bytearray([rng.choice((0, 1, 2)), 3, len(inner)]) + inner
    return bytes([3, len(data) + 1, code]) + bytes(data)


@pytest.mark.parametrize("seed", SEEDS)
def test_random_host(seed: int) -> None:
    print(f"seed {seed}: OPENPPMC_SEED={seed} repeats it")
    on_model(play(random.Random(seed)))


async def play(rng: random.Random) -> None:
    """Play a random host, and check that the part still works afterwards."""
    setting, build = rng.choice((TF, TG, TH)), rng.choice((F16, F16, D16))
    host = await Host.start(OnModel(build), *setting)
    model, reads = host.bench.golden, rng.choice((0.2, 0.9, 1.0))
    for _ in range(60):
        if not await host.read(CSR) & MWEF:
            await host.put(instruction(rng)[:32].hex())
        await host.pause(rng.choice((50, 500, 5_000, 30_000)))
        if rng.random() < 0.3:
            await host.blip(rng.choice(PINS), rng.choice((10, 100, 5_000)), rng.choice((10, 1_000)))
        if rng.random() < 0.1:
            await host.pins(run=rng.randrange(2), auxi=rng.randrange(256), epin=rng.randrange(2))
        if rng.random() < 0.03:
            await host.blip("alm_n", 4_000)
        while rng.random() < reads and not await host.read(CSR) & MREF:
            response = (await host.response()).split()
            assert int(response[1], 16) == len(response) - 2 and response[0] in (
                "00",
                "01",
                "02",
                "03",
                "0B",
                "1B",
                "23",
            )
        if model.state is State.ABN and rng.random() < 0.5 and not await host.read(CSR) & MWEF:
            await host.put(message(Code.ALARM_CLEAR))
            await host.pause(200)
    # When the host has read everything and reset the part, the part must work.
    for _ in range(2500):
        await host.pause(2000)
        if not await host.read(CSR) & MREF:
            await host.response()
        elif not await host.read(CSR) & MWEF:
            break
    assert await host.ask(message(Code.RESET)) == message(Code.RESET) and host.condition == State.INI
    edges = host.bench.edges("pout")
    highs = [b - a for (a, level), (b, _) in zip(edges, edges[1:], strict=False) if level]
    assert all(high == 80 for high in highs[:-1])
    assert await host.ask(message(Code.VERSION)) == message(Code.VERSION, "12")
