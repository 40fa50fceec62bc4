"""PMC006 acceptance checks under other parameters: the other reply to s, the other timing mode."""

from __future__ import annotations

from typing import Any

import pytest

from cocotb_tests.harness.config import Config
from cocotb_tests.harness.directed import directed
from cocotb_tests.harness.scripts import building, cases, model_only
from cocotb_tests.harness.tape import taping
from cocotb_tests.harness.verifies import verifies
from cocotb_tests.pmc006.moves import ready, rest

MODULES = [f"tests.pmc006.model.test_checks_{name}" for name in ("link", "motion", "guard", "program")]
COSTLY = ("35", "36", "37", "38", "41", "66", "nothing")
"""Those with an EEPROM, which knows nothing of these parameters."""


@directed("P006-AC-53", "P006-CMD-55")
async def p006_ac_53(dut: Any) -> None:
    host = await ready(dut, step_ack="ECHO")
    assert await host.swap("A5 FF 73 1F 01 00 00 37") == "A5 7A FF 1F 01 00 00 3E"
    mark = host.mark
    assert await host.ask("s", 5) == 0
    await rest(host)
    gaps = host.intervals(mark)
    assert len(gaps) == 286 and gaps[:3] == [1613, 1534, 1439] and sum(gaps) == 132_476 - 1659
    assert await host.ask("s", 0) == 0


@model_only("all the other checks under other parameters")
@pytest.mark.parametrize(
    "build",
    [
        Config("datasheet", clk_hz=8_000_000, timing="DATASHEET", extra=(("BAUD", 115_200),)),
        Config("echo", clk_hz=8_000_000, extra=(("STEP_ACK", "ECHO"), ("BAUD", 115_200))),
    ],
)
@verifies("P006-AC-48", "P006-AC-53")
def test_ac_48(build: Config) -> None:
    """The checks that are played on the RTL, too, in their short form."""
    run = 0
    for module in MODULES:
        for case in cases(module):
            if not case.name.endswith(COSTLY):
                with building(build), taping():
                    case.call()
                run += 1
    assert run > 40
