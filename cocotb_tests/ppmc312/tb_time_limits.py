"""Upper bounds of times in the rules of the PPMC-312 for FAST, and a check of the ports."""

from __future__ import annotations

from typing import Any

from cocotb_tests.harness import directed
from cocotb_tests.harness.bus import clean
from cocotb_tests.ppmc312.blocks import T3, TF
from cocotb_tests.ppmc312.host import Host
from cocotb_tests.ppmc312.messages import message
from openppmc.model.ppmc312.codes import INPUTS, OUTPUTS, SPONTANEOUS, WIDTHS, Answer, Code, Source

BRISK = ("02 03 01 00 03", "00 06 0004 0190 0320", "01 09 000005 000005 000005")
"""Rates 4, 400 and 800 at F = 8 MHz: intervals of 8, 800 and 1600 cycles."""
T_INIT, T_EXEC, T_TRIG, T_STOP, T_PIN = 65_536, 4_096, 512, 64, 4
POLL = 40
"""Number of cycles that polling by the host adds to a measured time."""


@directed("P312-GEN-11", "P312-GEN-10", "P312-CHK-01")
async def p312_ports(dut: Any) -> None:
    """The device has exactly the ports of its manual (chapter 2); the RTL build connects the ports by
    name.
    """
    inputs = (
        "mode d_i rs cs_n we_n oe_n rxd hsp mod adr evt0_n evt1_n auxi epin epdir index_n org_n alm_n end_n"
    )
    inputs += " fl_n bl_n fhl_n bhl_n extck run"
    outputs = "d_o d_oe wrq_n irq_n txd snd auxo_n exon_n cclr_n aclr_n zclmp_n cd_n pout dir intlk_n out_oe"
    assert set(INPUTS) - {"rst_n"} == set(inputs.split())
    assert {"d_i": 8, "rs": 3, "mod": 3, "adr": 4, "auxi": 8}.items() <= dict(WIDTHS).items()
    high = {"wrq_n", "irq_n", "txd", "exon_n", "cclr_n", "aclr_n", "zclmp_n", "cd_n", "intlk_n"}
    assert OUTPUTS == {name: 0x3F if name == "auxo_n" else int(name in high) for name in outputs.split()}
    assert (await Host.start(dut)).bench.initial == OUTPUTS


@directed("P312-PRT-04", "P312-MOT-01", "P312-CMD-00")
async def p312_answers_within_their_limits(dut: Any) -> None:
    host = await Host.start(dut)
    for setting in (T3, T3.replace("00 11", "00 19")):
        await host.issue(setting)
        await host.wait()
        assert host.t - host.header <= T_INIT + POLL
        assert await host.response() == message(Code.INITIAL)
    for block in (
        message(Code.RAMP, "00 0000 00000FA1"),
        message(Code.RAMP, "00 0000 00000065"),
        message(Code.RAMP, "40 00C9 00000BB8"),
        message(Code.FOREVER_RAMP, "00 0000"),
        message(Code.ZERO_RETURN, "00 01F4"),
    ):
        await host.issue(block)
        await host.wait()
        assert host.t - host.header <= T_EXEC + POLL
        await host.response()
        # t0 is at most 64 cycles before the answer, and pulse 1 follows t0 by TW.
        await host.pulse(1)
        await host.ask(message(Code.STOP, "00"))
        await host.response()


@directed("P312-PRT-04", "P312-MOT-34", "P312-MOT-41", "P312-INP-12", "P312-INP-30")
async def p312_stops_within_their_limits(dut: Any) -> None:
    for pin in ("fl_n", "alm_n", "org_n"):
        host = await Host.start(dut, *BRISK)
        await host.ask(message(Code.ORIGIN_SEARCH, "00 0004"))
        for phase in range(3):
            await host.pulse(20 + phase)
        low = host.t + 3
        await host.go(low)
        await host.pins(**{pin: 0})
        await host.pause(400)
        assert host.pulses() and low - 16 < host.pulses()[-1] <= low + T_PIN
    host = await Host.start(dut, *BRISK)
    await host.ask(message(Code.FOREVER_CONSTANT, "00 0004"))
    await host.issue(message(Code.STOP, "00"))
    header = host.header
    await host.pause(400)
    assert header - 16 < host.pulses()[-1] <= header + T_STOP
    host = await Host.start(dut, *BRISK, message(Code.STOP, "07"))
    await host.ask(message(Code.FOREVER_CONSTANT, "00 0004"))
    low = host.t
    await host.pins(evt1_n=0)
    await host.pause(400)
    assert low - 16 < host.pulses()[-1] <= low + T_STOP


@directed("P312-PRT-04", "P312-OVR-10", "P312-RSP-20", "P312-EVT-02")
async def p312_a_stop_by_an_event_during_an_88(dut: Any) -> None:
    """An instruction 88 in progress is completed before an event executes a stop.

    The stop then takes more than 64 cycles, and the motion stops regardless of the reads of the host.
    """
    longest = 0
    for after in range(1, 260, 6):
        host = await Host.start(dut, *BRISK, message(Code.STOP, "07"))
        await host.ask(message(Code.FOREVER_CONSTANT, "00 0004"))
        await host.put(message(Code.CHANGE, "00 0005"), gap=0)
        await host.go(host.header + after)
        low = host.t
        await host.pins(evt1_n=0)
        await host.pause(1000)
        took = host.pulses()[-1] - low
        longest = max(longest, took)
        assert took <= T_TRIG, after
        answers = [await host.response() for _ in range(3)]
        position = f"{host.bench.golden.position:08X}"
        if answers[0] == message(
            Code.STOP, source=Source.OVERRIDE
        ):  # the event was executed first, so there is no motion to change
            assert (
                answers[1:]
                == [
                    message(Answer.STATUS, "00 02"),
                    clean(message(Answer.STOPPED, f"04 {position}", source=SPONTANEOUS)),
                ]
                and took <= T_STOP
            )
        else:
            # The answer of instruction 88 is unread, so the stop immediately becomes an alarm.
            assert sorted(answers) == [
                message(Code.CHANGE),
                message(Answer.ALARM, "01", source=SPONTANEOUS),
                clean(message(Answer.STOPPED, f"80 {position}", source=SPONTANEOUS)),
            ]
    assert T_STOP < longest <= 200
    # If the host reads the answer in time, the stop is executed.
    host = await Host.start(dut, *BRISK, message(Code.STOP, "07"))
    await host.ask(message(Code.FOREVER_CONSTANT, "00 0004"))
    assert await host.ask(message(Code.CHANGE, "00 0005")) == message(Code.CHANGE)
    low = host.t
    await host.pins(evt1_n=0)
    assert (
        await host.response() == message(Code.STOP, source=Source.OVERRIDE)
        and (await host.response())[:11] == "23 06 E0 04"
    )
    assert host.pulses()[-1] <= low + T_STOP


@directed("P312-PRT-04", "P312-OVR-11", "P312-OVR-02", "P312-CMD-88", "P312-CMD-87", "P312-CMD-81")
async def p312_changes_within_their_limits(dut: Any) -> None:
    """A direct or triggered change takes effect on the next intervals within 512 cycles."""
    for code, rest in (("88", "0320"), ("87", "0320"), ("81", "")):
        for trigger in ("direct", "pin", "position"):
            flags, place = {"direct": ("00", ""), "pin": ("05", ""), "position": ("04", "0000000A")}[trigger]
            data = bytes.fromhex(code + flags + rest + place)
            block = f"03 {len(data):02X} {data.hex()}"
            host = await Host.start(dut, *BRISK, *(() if trigger == "direct" else (block,)))
            await host.ask(message(Code.FOREVER_CONSTANT, "00 0004"))
            mark = host.mark
            if trigger == "direct":
                await host.issue(block)
                since = host.header
            elif trigger == "pin":
                since = host.t
                await host.pins(evt0_n=0)
            else:
                host.mark = mark
                since = await host.pulse(10)
            await host.pause(3000)
            host.mark = mark
            edges = host.pulses()
            slow = [a for a, b in zip(edges, edges[1:], strict=False) if b - a > 8]
            assert slow and since < slow[0] <= since + T_TRIG + 60


@directed("P312-OVR-11", "P312-MOT-33", "P312-MOT-31")
async def p312_a_position_acts_on_the_next_interval(dut: Any) -> None:
    host = await Host.start(
        dut, *TF, message(Code.CHANGE, "04 00C8 00000012"), message(Code.CHANGE, "04 0190 00000013")
    )
    await host.ask(message(Code.RAMP, "00 0000 0000001E"))
    for _ in range(2):
        assert await host.response() == message(Code.CHANGE, source=Source.OVERRIDE)
    assert await host.response() == message(Answer.STOPPED, "40 00 00 00 1E", source=SPONTANEOUS)
    # At the first change, 12 pulses are left, and the final deceleration begins at rate 200. The second
    # change sets the constant rate 400 for the remaining pulses.
    assert host.gaps() == [400] * 3 + [200] * 4 + [100] * 11 + [200] + [400] * 10
