"""Tables of the PPMC-312 with stages of 2 pulses, which is the legal minimum (P312-TBL-05, R-16)."""

from __future__ import annotations

from itertools import repeat
from typing import Any

import cocotb

from cocotb_tests.harness import directed
from cocotb_tests.ppmc312.host import Host
from cocotb_tests.ppmc312.messages import message, stopped
from cocotb_tests.ppmc312.motion_tables import SLOW_STOP, change
from cocotb_tests.ppmc312.serial_host import SerialHost
from cocotb_tests.ppmc312.table_read import read_table
from openppmc.model.ppmc312.codes import Answer, Code, Source

from .serial_frames import T_INIT

# A row contains flags and rates before NA, the minimum of NA, and the bytes after NA. By P312-TBL-04 the
# minimum of NA is about 2 * 8001 * (Rs + RH) / (126 * RH).
LEAST = [
    ("01 03E8 00C8", 762, ""),
    ("09 03E8 00C8", 762, ""),
    ("01 FFFF FF7F", 255, ""),
    ("09 FFFF FF7F", 255, ""),
    ("00 0084 0004", 4318, ""),
    ("11 03E8 03E8 00C8", 762, "0007D0"),
    ("11 03E8 03E8 00C8 0007D0", 762, ""),
    ("19 03E8 03E8 00C8 0007D0", 762, ""),
]
FAST = message(Code.INITIAL, "00 0084 0004 0010DE")
"""8 MHz, linear, 132 to 4 (2 Mpps), 4318 pulses, which is the minimum."""
TICK = 2
"""Cycles per tick at 8 MHz and a clock of 16 MHz."""
STEEP = (
    "02 03 01 00 7F",
    *(
        f"00 {len(block) * 2:02X} {''.join(f'{rate:04X}' for rate in block)}"
        for block in (range(4 + k, min(4 + k + 15, 131)) for k in range(0, 127, 15))
    ),
    *(
        f"{int(k + 10 >= 127):02X} {3 * min(10, 127 - k):02X} {'000002' * min(10, 127 - k)}"
        for k in range(0, 127, 10)
    ),
)
"""A free curve at 8 MHz: 127 stages of 2 pulses each, rates 4 (2 Mpps) to 130."""


def doubled(rates: range) -> list[int]:
    """Return two intervals of each rate."""
    return [rate for each in rates for rate in (each, each)]


@cocotb.parametrize(case=LEAST)
@directed("P312-TBL-05", "P312-CHK-08", "P312-CMD-00", "P312-CMD-41")
async def p312_least_pulses_of_a_table(dut: Any, case: Any) -> None:
    """With the minimum number of pulses or one more, a table is built; one pulse less is error 05."""
    head, least, tail = case
    for pulses in (least - 1, least, least + 1):
        data = bytes.fromhex(f"{head}{pulses:06X}{tail}")
        host = await Host.start(dut)
        answer = await host.ask(message(Code.INITIAL, data.hex()))
        if pulses < least:
            assert answer == f"03 {len(data) + 3:02X} F0 05 00 {data.hex(' ').upper()}"
            assert host.condition == 0x01
            continue
        assert answer == message(Code.INITIAL)
        assert await host.ask(message(Code.STATUS)) == message(Code.STATUS, "00 02 00")
        _, (rates, up, down) = await read_table(host)
        side = down if data[0] & 0x10 and not tail else up
        assert len(rates) == 127 and sum(side) == pulses and min(side) == 2


@cocotb.parametrize(case=[case for case in LEAST if not case[0].startswith("1")])
@directed("P312-TBL-05", "P312-CHK-08", "P312-SER-41", "P312-SER-47")
async def p312_serial_least_pulses_of_a_table(dut: Any, case: Any) -> None:
    """The serial line has the same limits as the bus; the reply is 42 (parameter error) or ready."""
    head, least, _ = case
    host = await SerialHost.start(dut)
    for pulses, reply in ((least - 1, "B0 42"), (least, "90"), (least + 1, "90")):
        assert await host.ask(f"00 {head} {pulses:06X}", T_INIT) == reply
        assert await host.state() == (0x01 if reply == "B0 42" else 0x02)


@directed("P312-TBL-05", "P312-CMD-49", "P312-EVT-01")
async def p312_least_table_from_an_event(dut: Any) -> None:
    """An initial setting that an event pin triggers has the same limits as one that the host sends."""
    for pulses in (761, 762):
        data = f"01 03E8 00C8 {pulses:06X}"
        host = await Host.start(dut, message(Code.INITIAL, "01 03E8 00C8 0007D0"))
        await host.ask(message(Code.EVENT_SET, "00", message(Code.INITIAL, data)))
        await host.pins(evt0_n=0)
        refused = message(Answer.EVENT_FAILED, "00", source=Source.EVENT)
        assert await host.response() == (
            refused if pulses == 761 else message(Code.INITIAL, source=Source.EVENT)
        )
        assert host.condition == (0x01 if pulses == 761 else 0x02)


@cocotb.parametrize(direction=[0, 0x40])
@directed("P312-TBL-05", "P312-MOT-01", "P312-MOT-12", "P312-MOT-20", "P312-MOT-30", "P312-GEN-06")
async def p312_motions_along_least_stages(dut: Any, direction: int) -> None:
    """If the table has stages of 2 pulses, no interval is missing in moves with ramps, in a triangular
    profile and in a deceleration stop.
    """
    sign = -1 if direction else 1
    host = await Host.start(dut, FAST)
    _, (rates, up, _) = await read_table(host)
    ramp = [rate for rate, count in zip(rates[::-1], up[::-1], strict=True) for rate in repeat(rate, count)]
    assert min(up) == 2 and ramp[:5] == [132, 132, 105, 105, 88]
    position = 0
    for number, constant in ((2 * len(ramp) + 7, 7), (2 * len(ramp), 0)):
        kind = await host.ask(message(Code.RAMP, f"{direction:02X} 0000 {number:08X}"))
        assert kind == message(Code.RAMP, "00")
        position += sign * number
        assert await host.response() == stopped(0x40, position)
        assert host.gaps(TICK) == (ramp + [4] * constant + ramp[::-1])[:-1]
    # In a triangular profile, each ramp has half of the pulses.
    assert await host.ask(message(Code.RAMP, f"{direction:02X} 0000 0000000B")) == message(Code.RAMP, "10")
    position += sign * 11
    assert await host.response() == stopped(0x40, position)
    assert host.gaps(TICK) == [*ramp[:5], *ramp[:6][::-1]][:-1]
    # Instruction 81 stops a motion at 2 Mpps.
    await host.ask(message(Code.FOREVER_CONSTANT, f"{direction:02X} 0004"))
    mark = host.mark
    await host.pulse(20)
    await host.ask(SLOW_STOP)
    await host.wait()
    host.mark = mark
    gaps = host.gaps(TICK)
    assert gaps[-len(ramp) + 1 :] == ramp[::-1][:-1] and set(gaps[: -len(ramp) + 1]) == {4}
    assert await host.response() == stopped(0x08, position + sign * (len(gaps) + 1))


@cocotb.parametrize(direction=[0, 0x40])
@directed("P312-CMD-FC-4", "P312-MOT-12", "P312-MOT-30", "P312-MOT-32", "P312-OVR-11", "P312-MOT-31")
async def p312_a_stage_every_two_pulses_up_to_2_mpps(dut: Any, direction: int) -> None:
    """With stages of 2 pulses at 130 to 4 ticks of 125 ns, ramps and instructions 81, 87 and 88 take effect
    at the correct pulse.
    """
    sign = -1 if direction else 1
    host = await Host.start(dut, *STEEP)
    climb, fall = doubled(range(130, 3, -1)), doubled(range(4, 131))
    assert await host.ask(message(Code.RAMP, f"{direction:02X} 0000 {512:08X}")) == message(Code.RAMP, "00")
    assert await host.response() == stopped(0x40, sign * 512)
    assert host.gaps(TICK) == (climb + [4] * 4 + fall)[:-1]
    # Instruction 81 is registered for a position in the acceleration: the deceleration begins at the stage
    # that has been reached.
    await host.ask(message(Code.POSITION_SET, "00 00000000"))
    at = (sign * 100) & 0xFFFFFFFF
    assert await host.ask(message(Code.SLOW_STOP, f"04 {at:08X}")) == message(Answer.REGISTERED)
    await host.ask(message(Code.FOREVER_RAMP, f"{direction:02X} 0000"))
    assert await host.response() == message(Code.SLOW_STOP, source=Source.OVERRIDE)
    await host.wait()
    gaps = host.gaps(TICK)
    top = min(gaps)
    turn = len(gaps) - len(doubled(range(top, 131))) + 1
    assert gaps[turn:] == doubled(range(top, 131))[:-1] and gaps[:turn] == climb[:turn]
    assert 100 <= turn < 140
    assert await host.response() == stopped(0x08, sign * (len(gaps) + 1))
    # Instruction 87 changes to a higher and to a lower speed, each time from one constant rate to another.
    await host.ask(message(Code.FOREVER_CONSTANT, f"{direction:02X} 0082"))
    mark = host.mark
    await host.pulse(4)
    assert await host.ask(change(Code.RAMP_CHANGE, 4)) == message(Code.RAMP_CHANGE)
    while host.condition == 0x08:
        await host.step()
    while host.condition != 0x08:
        await host.step()
    await host.pause(400)
    assert await host.ask(change(Code.RAMP_CHANGE, 130)) == message(Code.RAMP_CHANGE)
    while host.condition == 0x08:
        await host.step()
    while host.condition != 0x08:
        await host.step()
    await host.pause(2_000)
    host.mark = mark
    gaps = host.gaps(TICK)
    first, last = gaps.index(129), len(gaps) - gaps[::-1].index(129)
    assert set(gaps[:first]) == {130} == set(gaps[last:])
    top = gaps[first:last]
    up, down = doubled(range(129, 3, -1)), doubled(range(5, 130))
    assert top[: len(up)] == up and top[-len(down) :] == down
    assert set(top[len(up) : -len(down)]) == {4}
