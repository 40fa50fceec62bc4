"""Terminals and timers of the PPMC-312 at its pins (P312-OUT, P312-INP)."""

from __future__ import annotations

from typing import Any

from cocotb_tests.harness import D16, directed
from cocotb_tests.harness.bus import clean
from cocotb_tests.ppmc312.blocks import T1, TF
from cocotb_tests.ppmc312.builds import F27
from cocotb_tests.ppmc312.host import Host
from cocotb_tests.ppmc312.messages import message, stopped
from openppmc.model.ppmc312.codes import SPONTANEOUS, Answer, Code, Source

CLEAR = 393_216


@directed(
    "P312-CMD-20",
    "P312-CMD-21",
    "P312-CMD-23",
    "P312-CMD-25",
    "P312-CMD-26",
    "P312-CMD-27",
    "P312-CMD-40",
    "P312-CMD-4D",
)
async def p312_pins_and_reads(dut: Any) -> None:
    host = await Host.start(dut, *TF)
    for block, name, level in (
        (message(Code.EXCITATION_ON), "exon_n", 0),
        (message(Code.EXCITATION_ON), "exon_n", 0),
        (message(Code.EXCITATION_OFF), "exon_n", 1),
        (message(Code.ZERO_CLAMP), "zclmp_n", 0),
        *((message(Code.OUTPUT, f"{1 << n:02X}"), "auxo_n", 0x3F ^ 1 << n & 0x3F) for n in range(8)),
        (message(Code.OUTPUT, "3F"), "auxo_n", 0),
    ):
        assert await host.ask(block) == f"03 01 {block[6:8]}"
        assert host.out(name) == level
    for auxi in (0x01, 0x80, 0x5A, 0xFF):
        await host.pins(auxi=auxi)
        assert await host.ask(message(Code.INPUT)) == message(Code.INPUT, f"{auxi:02X}")
    first = ("alm_n", "end_n", "index_n", "org_n", "fhl_n", "bhl_n", "fl_n", "bl_n")
    for place, pin in enumerate(first[1:], 1):
        await host.pins(**{pin: 0})
        assert await host.ask(message(Code.TERMINALS)) == message(
            Code.TERMINALS, f"{0xFF & ~(0x80 >> place):02X} E0"
        ), pin
        await host.pins(**{pin: 1})
    for pin, value in (("evt1_n", "60"), ("evt0_n", "A0"), ("run", "C0")):
        await host.pins(**{pin: 0})
        assert await host.ask(message(Code.TERMINALS)) == message(Code.TERMINALS, f"FF {value}")
        await host.pins(**{pin: 1})
    await host.pins(alm_n=0)
    assert await host.response() == message(Answer.ALARM, "00", source=SPONTANEOUS)
    assert await host.ask(message(Code.TERMINALS)) == message(Code.TERMINALS, "7F E0")
    assert await host.ask(message(Code.VERSION)) == message(Code.VERSION, "12")
    # exon_n, zclmp_n and the outputs do not depend on pulses.
    assert (host.out("exon_n"), host.out("zclmp_n"), host.out("auxo_n")) == (1, 0, 0)


@directed("P312-CMD-22", "P312-CMD-24", "P312-INP-33", "P312-CHK-37")
async def p312_clear_pulses(dut: Any) -> None:
    host = await Host.start(dut, message(Code.COUNTER_CLEAR), message(Code.ALARM_CLEAR))
    first = {name: host.bench.falls(name)[0] for name in ("cclr_n", "aclr_n")}
    await host.pause(CLEAR + 100)
    for name, fall in first.items():
        assert host.bench.edges(name) == [(fall, 0), (fall + CLEAR, 1)]
    # The pulses of cclr_n and aclr_n are independent; another instruction 24 restarts only the time of
    # aclr_n.
    await host.ask(message(Code.ALARM_CLEAR))
    again = host.bench.falls("aclr_n")[-1]
    await host.pause(200_000)
    await host.ask(message(Code.COUNTER_CLEAR))
    await host.issue(message(Code.ALARM_CLEAR))
    restart = host.header
    await host.response()
    await host.pause(2 * CLEAR)
    assert host.bench.falls("aclr_n")[-1] == again
    assert 0 < host.bench.rises("aclr_n")[-1] - CLEAR - restart < 100
    fall, rise = host.bench.edges("cclr_n")[-2:]
    assert rise[0] - fall[0] == CLEAR


@directed(
    "P312-GEN-02", "P312-CMD-22", "P312-OUT-01", "P312-MOT-01", "P312-MOT-03", "P312-MON-10", builds=(F27,)
)
async def p312_times_of_the_crystal_at_another_clock(dut: Any) -> None:
    host = await Host.start(dut, *TF)
    await host.ask(message(Code.COUNTER_CLEAR))
    await host.ask(message(Code.MASK, "01 01"))
    await host.ask(message(Code.CONSTANT, "40 0190 00000002"))
    assert await host.response() == stopped(0x40, -2)
    turned = host.bench.rises("dir", host.mark)[0]
    assert host.pulses()[0] - turned in (135, 136, 137)
    changes = host.bench.edges("pout", host.mark)
    assert [b[0] - a[0] for a, b in zip(changes[::2], changes[1::2], strict=True)] == [135, 135]
    last = host.pulses()[-1]
    await host.pause(2_720_000)
    (fall, _), (rise, _) = host.bench.edges("cclr_n")
    assert rise - fall == CLEAR * 27 // 16
    assert abs(host.bench.falls("cd_n")[0] - last - 2_700_000 - 10_800) <= 5


@directed("P312-OUT-01", "P312-CHK-45", "P312-MOT-06")
async def p312_current_reduction_after_each_kind_of_end(dut: Any) -> None:
    # The time to the fall of cd_n is counted from the end of the pulse output, which an immediate stop ends
    # immediately.
    host = await Host.start(dut, *TF, message(Code.END_TERMINAL, "01"))
    await host.ask(message(Code.FOREVER_CONSTANT, "00 0190"))
    await host.pulse(2, 2000)
    await host.pins(fl_n=0)
    low = host.t
    await host.pause(1_600_200)
    (edge,) = host.bench.falls("cd_n")
    assert 0 <= edge - low - 1_600_000 < 10
    assert host.condition == 0x08  # the END wait does not delay the fall of cd_n
    await host.pins(end_n=0, fl_n=1)
    await host.response()
    # alm_n asserts cd_n (low) immediately in any state; t0 deasserts it.
    await host.pins(end_n=1)
    await host.ask(message(Code.END_TERMINAL, "00"))
    await host.ask(message(Code.STEP, "00"))
    assert host.out("cd_n") == 1
    await host.response()
    await host.pins(alm_n=0)
    low = host.t
    await host.pause(10)
    assert 0 < host.bench.falls("cd_n")[-1] - low < 8
    await host.response()
    await host.pins(alm_n=1)
    await host.pause(10)
    assert host.out("cd_n") == 0


@directed("P312-OUT-02", "P312-MON-06", "P312-CHK-47", "P312-CMD-23")
async def p312_zero_clamp(dut: Any) -> None:
    host = await Host.start(dut, *TF, message(Code.ZERO_CLAMP))
    await host.issue(message(Code.STEP, "40"))
    await host.response()
    turned = host.bench.rises("dir", host.mark)
    assert host.bench.rises("zclmp_n", host.mark) == turned
    await host.response()
    assert host.out("zclmp_n") == 1
    # With FO, the clamp is activated inside the window or by END, after the pulse output has ended. Without
    # EN it is not activated.
    for flags, distance, end_n, level in (
        (5, 3, 1, 0),
        (5, 2, 1, 1),
        (5, 2, 0, 0),
        (4, 9, 0, 1),
        (1, 9, 0, 1),
    ):
        host = await Host.start(dut, *TF, message(Code.IN_POSITION, f"{flags:02X} {distance:04X}"))
        await host.pins(end_n=end_n)
        await host.ask(message(Code.CONSTANT, "00 0190 00000003"))
        await host.pause(12_000)
        assert host.out("zclmp_n") == 1
        await host.pause(10_000)
        assert host.out("zclmp_n") == level, (flags, distance, end_n)


@directed(
    "P312-MOT-35", "P312-STA-02", "P312-CHK-44", "P312-CMD-06", "P312-BAD-18", "P312-BAD-19", "P312-CMD-45"
)
async def p312_end_wait(dut: Any) -> None:
    host = await Host.start(dut, *TF, message(Code.END_TERMINAL, "01"))
    assert await host.ask(message(Code.STATUS)) == message(Code.STATUS, "04 02 00")
    for stop, cause in ((message(Code.STOP, "00"), 0x04), (message(Code.SLOW_STOP, "00"), 0x10)):
        await host.ask(message(Code.FOREVER_CONSTANT, "00 0190"))
        mark = host.mark
        await host.pulse(2, 20)
        await host.ask(stop)
        await host.pause(7000)
        assert host.condition == 0x08 and await host.quiet(200)
        # In the END wait, these direct instructions are accepted without an effect, and an override is
        # registered.
        for block in (
            message(Code.CHANGE, "00 0064"),
            message(Code.RAMP_CHANGE, "00 00C8"),
            message(Code.STOP, "00"),
            message(Code.SLOW_STOP, "00"),
        ):
            assert await host.ask(block) == clean(f"03 01 {block[6:8]}")
        assert await host.ask(message(Code.CHANGE, "07 00C8")) == message(Answer.REGISTERED)
        assert (
            await host.ask(message(Code.FOREVER_CONSTANT, "00 0190"))
            == await host.ask(message(Code.STEP, "00"))
            == message(Answer.STATUS, "00 08")
        )
        await host.pins(fl_n=0, org_n=0, run=0)
        await host.pause(200)
        await host.pins(fl_n=1, org_n=1, run=1)
        host.mark = mark
        count = len(host.pulses())
        await host.pins(end_n=0)
        answer = await host.response()
        assert answer[:11] == f"23 06 E0 {cause:02X}" and count <= 3
        await host.pins(end_n=1)
    # If END is already low, there is no wait. Then instruction 06 00 and instruction FF are sent during an
    # END wait.
    await host.pins(end_n=0)
    await host.ask(message(Code.STEP, "00"))
    assert (await host.response())[:11] == "23 06 E0 40"
    await host.pins(end_n=1)
    await host.ask(message(Code.STEP, "00"))
    await host.pause(7000)
    assert host.condition == 0x08
    assert await host.ask(message(Code.END_TERMINAL, "00")) == message(Code.END_TERMINAL, "00")
    assert (await host.response())[:11] == "23 06 E0 40"
    await host.ask(message(Code.END_TERMINAL, "01"))
    await host.ask(message(Code.STEP, "00"))
    await host.pause(7000)
    assert (
        await host.ask(message(Code.RESET)) == message(Code.RESET)
        and host.condition == 0x01
        and await host.quiet()
    )


@directed("P312-INP-01", "P312-TIM-14", "P312-TIM-16", builds=(D16,))
async def p312_datasheet_recognition_times(dut: Any) -> None:
    host = await Host.start(dut, *TF, message(Code.END_TERMINAL, "01"))
    await host.ask(message(Code.STEP, "00"))
    await host.pause(16_000)
    assert host.condition == 0x08
    # Instruction 27 returns a low level of less than 200 us; no other function detects such a level.
    await host.pins(end_n=0, fl_n=0)
    assert await host.ask(message(Code.TERMINALS)) == message(Code.TERMINALS, "BD E0")
    await host.pins(end_n=1, fl_n=1)
    await host.pause(5000)
    assert host.condition == 0x08
    low = host.t
    await host.pins(end_n=0)
    await host.wait()
    assert 3200 <= host.t - low < 3300
    assert await host.response() == stopped(0x40, 1)
    for _ in range(3):
        await host.pins(alm_n=0)
        await host.pause(3190)
        await host.pins(alm_n=1)
        await host.pause(3)
    assert host.condition == 0x02 and await host.quiet(100)
    await host.pins(alm_n=0)
    low = host.t
    await host.wait()
    assert 3200 <= host.t - low < 3300 and host.condition == 0x10


@directed("P312-TIM-12", "P312-TIM-20", "P312-OVR-12", "P312-INP-31", builds=(D16,))
async def p312_datasheet_triggered_stop(dut: Any) -> None:
    """Instruction 80 takes effect 350 us after the filtered edge of EVT, and immediately if it is triggered
    by a position.
    """
    host = await Host.start(dut, *TF, message(Code.STOP, "05"))
    await host.ask(message(Code.FOREVER_CONSTANT, "00 0064"))
    mark = host.mark
    await host.pulse(3, 10)
    low = host.t
    await host.pins(evt0_n=0)
    assert await host.response() == message(Code.STOP, source=Source.OVERRIDE)
    host.mark = mark
    assert 400_000 + 5600 - 1700 <= host.pulses()[-1] - low <= 400_000 + 5620
    assert await host.response() == stopped(0x04, len(host.pulses()))
    assert (await host.ask(T1))[:5] == "03 01"


@directed(
    "P312-CMD-25",
    "P312-CMD-27",
    "P312-INP-01",
    "P312-EVT-01",
    exact="the pins must be sampled at the same edge",
)
async def p312_25_and_27_show_all_pins_at_one_clk(dut: Any) -> None:
    """Instructions 25 and 27 sample all pins in the same cycle, for every source of the instruction."""
    names = ("alm_n", "end_n", "index_n", "org_n", "fhl_n", "bhl_n", "fl_n", "bl_n", "evt1_n", "run")
    pins = dict.fromkeys(names, 0)
    for code, levels, shown in (
        ("27", pins, {"03": ("FF E0", "00 40"), "0B": ("FF A0", "00 00")}),
        ("25", {"auxi": 0x5A}, {"03": ("FF", "5A"), "0B": ("FF", "5A")}),
    ):
        for source, (before, after) in shown.items():
            seen = []
            for clk in range(14, 34):
                host = await Host.start(dut, *TF, message(Code.EVENT_SET, f"00 03 01 {code}"))
                await host.pins(auxi=0xFF)
                await host.pause(800)
                if source == "03":
                    await host.put(f"03 01 {code}")
                    await host.go(host.header + clk)
                else:
                    await host.pins(evt0_n=0)
                    await host.pause(clk - 1)
                await host.pins(**levels)
                while not (answer := await host.response()).startswith(source):
                    pass
                assert answer[6:8] == code and answer[9:] in (before, after), clk
                seen.append(answer[9:] == after)
            assert seen == sorted(seen, reverse=True) and len(set(seen)) == 2, source
