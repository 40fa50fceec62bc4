"""A part with an EEPROM on its link: frames during the boot, background jobs, another line rate.

Instructions are named by their letters; a number after the letter is the data.
"""

from __future__ import annotations

from itertools import pairwise
from math import ceil
from typing import Any

from .builds import F8B, ODD, directed
from .chip import Chip
from .host import Host
from .moves import DECAY, set_constant_speed, start, wait_stopped
from .programs import image, page


@directed("P006-FRM-07", "P006-EEP-01", "P006-BAD-06", builds=(F8B, ODD))
async def p006_frames_before_the_end_of_the_boot(dut: Any) -> None:
    """The part ignores frames until the end of the boot, with and without an EEPROM.

    A frame that begins before this end is discarded, too.
    """
    for chip, longest in ((Chip(image(), write_us=500), 60_000), (Chip(missing=True), 15_000)):
        up = (await Host.start(dut, chip=chip)).t
        chip = Chip(image(), missing=chip.missing)
        host = await Host.start(dut, chip=chip, boot=False)
        for begin in (host.us(500), up // 2, up - ceil(40 * host.bit)):
            await host.go(begin)
            await host.send_frame("y", 0xF8)
        assert host.t > await host.boot() and up <= host.us(longest)
        assert (
            await host.is_silent(ceil(30 * host.bit)) and not await host.out("gpo") and not host.edges("de")
        )
        await host.pause(ceil(200 * host.bit))
        assert await host.ask("y", 0x08) == 0x08 and await host.ask("j") == DECAY


@directed("P006-CMD-02", "P006-CMD-41", "P006-CMD-53", "P006-BAD-12")
async def p006_eeprom_codes(dut: Any) -> None:
    """Instructions t (save) and B (burn) reply immediately and are executed in the background; until a job
    ends, another one is rejected.
    """
    host = await Host.start(dut, chip=Chip(write_us=6_000))
    assert await host.ask("t", -1) == 1 and await host.ask("t") == 0 and await host.ask("B") == 0
    await host.ms(14)
    assert await host.ask("B", 7) == 1
    assert await host.ask("t") == 0
    assert await host.ask("B") == 0
    assert await host.ask("W", 1) == 0
    assert await host.ask("A", 0) == 0 and await host.ask("G") == 0
    await set_constant_speed(host, 3000)
    await start(host, 2)
    await wait_stopped(host)
    assert len(host.eeprom.writes) < 28
    await host.reset()
    await host.boot()


@directed("P006-PAR-01", "P006-EEP-01", "P006-EEP-10", builds=(ODD,))
async def p006_eeprom_at_another_rate_and_address(dut: Any) -> None:
    """The period of SCL is constant during the whole transfer, to within one cycle."""
    host = await Host.start(dut, chip=Chip(image(page(a04=32)), write_us=300))
    assert await host.ask("k") == 32
    hz = int(str(host.params["I2C_HZ"]))
    await host.ok(m=64)
    assert await host.ask("t") == 1
    await host.ms(3)
    assert host.eeprom.memory[4] == 64
    period = host.clk_hz / hz
    edges = host.edges("scl_oe", host.frame_start)
    falls = [t for t, level in edges if level]
    # Longer distances are not compared: they contain a START or a STOP.
    assert {abs(b - a - period) <= 1 for a, b in pairwise(falls) if b - a < 1.2 * period} == {True}
    lows = [b - a for (a, level), (b, _) in pairwise(edges) if level]
    assert len(lows) > 600 and all(0 <= low - 0.55 * period < 2 for low in lows)
