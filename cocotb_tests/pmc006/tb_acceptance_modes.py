"""Acceptance checks with other parameters, which select the other reply to instruction s."""

from __future__ import annotations

from typing import Any

from .builds import D8E, directed
from .moves import ready, wait_stopped


@directed("P006-AC-53", "P006-CMD-55", builds=(D8E,))
async def p006_ac_53(dut: Any) -> None:
    host = await ready(dut)
    assert await host.exchange("A5 FF 73 1F 01 00 00 37") == "A5 7A FF 1F 01 00 00 3E"
    mark = host.mark
    assert await host.ask("s", 5) == 0
    await wait_stopped(host)
    gaps = host.intervals(mark)
    assert len(gaps) == 286 and gaps[:3] == [1613, 1534, 1439] and sum(gaps) == 132_476 - 1659
    assert await host.ask("s", 0) == 0
