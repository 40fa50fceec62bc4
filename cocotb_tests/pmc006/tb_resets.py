"""Resets during all activities, and a factory restore, for a part without an EEPROM."""

from __future__ import annotations

from typing import Any

from cocotb_tests.harness import probe

from .builds import directed
from .host import Host
from .moves import DECAY, constant_speed_host, start
from .programs import FACTORY_PAGE
from .tb_boot import FACTORY, values
from .tb_save import FSET_US


@directed("P006-BAD-24", "P006-PORT-01", "P006-PRG-01", "P006-IO-03")
async def p006_reset_in_the_middle_of_everything(dut: Any) -> None:
    """A reset immediately sets all outputs to their reset levels, and restores registers, flags and words."""
    host = await constant_speed_host(dut)
    await host.ok(f=3, y=0xF8)
    await host.ok(A=0)
    assert await host.ask("W", 77) == 77
    await start(host, 100_000)
    await host.pins(ext2=0)
    await host.pause(30)
    await host.send_frame("c")
    await host.pause(int(host.bit * 20))
    await host.pins(rst_n=0)
    await host.sync()
    expected = host.bench.part.reset_levels()
    assert {pin: host.bench.level(pin) for pin in expected} == expected
    await host.pause(10)
    await host.pins(rst_n=1, ext2=1)
    await host.ignore_replies()
    await host.boot()
    assert await values(host) == FACTORY and await host.status() == DECAY and await host.ask("O") == 0x10
    assert await host.ask("G") == 0
    assert await host.ask("c") == 0
    assert await host.ask("x") == 0xF07
    assert FACTORY_PAGE[3] == 0xFF


@directed("P006-BAD-24", "P006-CMD-15")
@probe("u_control.u_settings.u_reply_ram.count_q")
async def p006_reset_restores_any_state(dut: Any) -> None:
    """After a reset the replies are correct, regardless of the power-up value of the counter that fills the
    RAM of the reply values.
    """
    host = await Host.start(dut)
    if host.bench.simulated:
        for state in range(64):
            await host.pins(rst_n=0)
            await host.pause(4)
            dut.u_control.u_settings.u_reply_ram.count_q.value = state
            await host.pause(4)
            await host.pins(rst_n=1)
    await host.pause(4)
    await host.ignore_replies()
    await host.boot()
    assert await host.ask("R") == 0x123 and not await host.busy()
    assert await values(host) == FACTORY


@directed("P006-EEP-21", "P006-EEP-22")
async def p006_restore_without_a_device(dut: Any) -> None:
    """A factory restore without a device ends and has no permanent effect."""
    host = await Host.start(dut, levels={"sda_i": 0, "fset_n": 0}, boot=False)
    await host.boot()
    assert host.us(FSET_US) <= host.t <= host.us(FSET_US + 2_500)
    await host.pins(fset_n=1)
    assert await values(host) == FACTORY and await host.status() == DECAY
    host = await constant_speed_host(dut)
    # With sda_i = 1, no device acknowledges.
    await host.pins(fset_n=0, sda_i=1)
    await host.wait_us(FSET_US + 100)
    assert await host.ask("V") == 2 and await host.ask("t") == 1
    await host.ms(12)
    assert await host.ask("V") == 2 and await host.ask("t") == 1
