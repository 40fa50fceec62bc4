"""Motions of the serial mode: starts, origin searches, stops, changes, overrides."""

from __future__ import annotations

from typing import Any

import cocotb

from cocotb_tests.harness import directed

from .serial_frames import TS
from .serial_host import SerialHost

PARAMETER, STATE = "B0 42", "B0 43"
STOPPED = "A0 37"


@directed("P312-SER-40", "P312-CMD-82", "P312-CMD-83", "P312-CMD-84", "P312-CMD-85", "P312-CMD-86")
async def p312_serial_motions(dut: Any) -> None:
    host = await SerialHost.start(dut, TS)
    position = 0
    for code, data, count in (("82", "", 1), ("83", "0000 00000008", 8), ("84", "0190 00000005", 5)):
        for ccw in (0, 1):
            assert await host.ask(f"{int(code, 16) + 0x20 * ccw:02X} {data}") == "90"
            await host.at_rest()
            assert host.out("dir") == ccw and len(host.pulses()) == count
            assert await host.polls(2) == ["A0 38", "90"]
            position += -count if ccw else count
            assert await host.ask("42") == "A0 " + position.to_bytes(4, "big", signed=True).hex(" ").upper()
    for code, data, gaps in (("85", "0190", {800}), ("86", "01F4", {1000})):
        for ccw in (0, 1):
            assert await host.ask(f"{int(code, 16) + 0x20 * ccw:02X} {data}") == "90"
            assert await host.poll() == "80" and host.out("dir") == ccw
            assert set(host.gaps(1)) == gaps
            assert await host.ask("80") == "90"
            await host.at_rest()
            assert await host.poll() == STOPPED
    for bad in ("83 0000 00000000", "84 0063 00000005", "84 01F5 00000005", "85 00C7", "86 01F5", "89 0000"):
        assert await host.ask(bad) == (STATE if bad[0:2] == "89" else PARAMETER)


@cocotb.parametrize(index=[0, 1])
@cocotb.parametrize(ccw=[0, 1])
@directed("P312-CMD-10", "P312-CMD-11", "P312-SER-40")
async def p312_serial_origin(dut: Any, index: int, ccw: int) -> None:
    host = await SerialHost.start(dut, TS)
    assert await host.ask(f"{0x87 + 0x20 * ccw + 0x10 * index:02X} 0190") == "90"
    await host.pulse(5)
    await host.pins(org_n=0)
    if index:
        await host.pulse(8)
        await host.pins(index_n=0)
    await host.at_rest()
    assert len(host.pulses()) == (8 if index else 5) and host.out("dir") == ccw
    assert await host.poll() == "A0 32" and await host.ask("40") == "A0 32"
    await host.pins(org_n=1)
    await host.pins(index_n=1)
    assert await host.ask(f"{0x88 + 0x20 * ccw + 0x10 * index:02X} 0000") == "90"
    pin = "index_n" if index else "org_n"
    await host.pins(org_n=0)
    await host.pins(**{pin: 0})
    await host.pause(2_500)
    await host.pins(**{pin: 1})
    await host.bench.level_is("dir", 1 - ccw)
    assert await host.poll() == "80"
    await host.pins(**{pin: 0})
    await host.at_rest()
    assert await host.poll() == "A0 32"


@directed("P312-CMD-80", "P312-CMD-81", "P312-MOT-30", "P312-SER-30")
async def p312_serial_stops(dut: Any) -> None:
    host = await SerialHost.start(dut, TS)
    for start, stop, end in (("86 0000", "80", "37"), ("86 0000", "81", "36"), ("85 01F4", "81", "39")):
        assert await host.ask(start) == "90"
        await host.pulse(40)
        assert await host.ask(stop) == "90"
        await host.at_rest()
        assert await host.poll() == f"A0 {end}" and await host.ask("40") == f"A0 {end}"
    for instruction in ("80", "81", "89 00C8", "8A 00C8"):
        assert await host.ask(instruction) == STATE


@directed("P312-CMD-87", "P312-CMD-88", "P312-SER-40")
async def p312_serial_changes(dut: Any) -> None:
    host = await SerialHost.start(dut, TS)
    assert await host.ask("85 01F4") == "90"
    assert await host.ask("8A 0190") == "90"
    host.mark = host.t
    assert await host.poll() == "80" and host.gaps(1)[-1] == 800
    assert await host.ask("89 0188") == "90"
    await host.pause(120_000)
    host.mark = host.t
    assert await host.poll() == "80" and host.gaps(1)[-1] == 784
    assert await host.asks("8A 0000", "89 0063") == [PARAMETER, PARAMETER]
    assert await host.ask("80") == "90" and await host.settle() == [STOPPED]


@cocotb.parametrize(case=[(0x20, "evt0_n"), (0x30, "evt1_n")])
@directed("P312-OVR-01", "P312-OVR-02", "P312-SER-40", "P312-SER-22")
async def p312_serial_overrides_by_pins(dut: Any, case: Any) -> None:
    """Instructions 80, 81, 89 and 8A wait for their pin, one after the other."""
    bits, pin = case
    host = await SerialHost.start(dut, TS)
    for code, data in ((0x8A, "0190"), (0x89, "01F4"), (0x81, ""), (0x80, "")):
        assert await host.ask(f"{code + bits:02X} {data}") == "90"
    assert await host.status() == f"00 02 {'24' if bits == 0x30 else '14'}"
    assert await host.ask("85 01F4") == "90"
    await host.blip(pin)
    assert await host.poll() == "B0 28"
    host.mark = host.t
    assert await host.poll() == "80" and host.gaps(1)[-1] == 800
    await host.blip(pin)
    assert await host.poll() == "B0 28" and await host.ask("80") == "90"
    await host.at_rest()
    assert await host.poll() == STOPPED
    # Instructions 81 and 80 have no motion to stop: the first of them fails and empties the FIFO.
    await host.blip(pin)
    assert await host.polls(2) == ["B0 4B", "90"] and await host.status() == "00 02 00"


@directed("P312-OVR-01", "P312-OVR-12", "P312-SER-40")
async def p312_serial_overrides_at_positions(dut: Any) -> None:
    host = await SerialHost.start(dut, TS)
    for instruction in ("99 0190 00000005", "9A 01F4 00000008", "91 00000014", "90 00000019"):
        assert await host.ask(instruction) == "90"
    assert await host.status() == "00 02 04"
    assert await host.ask("85 01F4") == "90"
    await host.at_rest()
    # For instruction 91, the stop speed has already been reached; instruction 90 waits for the next motion.
    assert await host.ask("42") == "A0 00 00 00 14"
    assert await host.polls(3) == ["B0 28", "A0 39", "90"]
    assert await host.ask("85 01F4") == "90"
    await host.at_rest()
    assert await host.ask("42") == "A0 00 00 00 19" and await host.polls(2) == [
        "B0 28",
        "A0 37",
    ]
