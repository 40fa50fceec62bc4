"""UB-SEQ, UB-ANS, UB-MSG: sequence numbers, stored answers, events."""

from __future__ import annotations

import cocotb

from cocotb_tests.harness import configs
from openppmc.host.frames import encode

from .bench import Bench, same
from .settings import FAST, SLOW


@cocotb.test()
@configs(FAST)
async def messages_repeat(dut):
    """A repeated SEQ returns the stored answer, regardless of the new script; a script with SEQ 0 is always
    executed (UB-SEQ-01, UB-SEQ-02).
    """
    bench = await Bench.start(dut)
    scripts = ("12 33 22 24", "06", "0F", "32 FF 06", "24 61", "32 F0 32 F0")
    bench.slave.hold_obf = 0
    for n, text in enumerate(scripts):
        script = bytes.fromhex("04 00 00" + text)
        seq = (1, 127, 64, 2, 3, 4)[n]
        await bench.send(encode(bytes([seq]) + script))
        first = await bench.message()
        same("SEQ", first[0], seq)
        bench.accesses()
        for again in (script, b"\x12\x01", script + b"\x00", b""):
            # Faults and NAKs before a repeated request do not change the stored answer.
            await bench.send(b"\x7e\x01\x02\x03\x04\x7e")
            same("NAK", await bench.message(), b"\x81\x02")
            await bench.send(encode(b"\xff\x12\x01"))
            same("NAK", await bench.message(), b"\x81\x08")
            await bench.send(encode(bytes([seq]) + again))
            same("stored answer", await bench.message(), first)
            same("nothing twice", bench.accesses(), [])
    for _ in range(3):
        same("SEQ 0", await bench.ask("12 01", seq=0), b"\x00")
        same("executed", bench.accesses(), [("W", 2, 1)])
    for seq in (5, 6, 5):
        same("SEQ before the last", await bench.ask("12 01", seq=seq), b"\x00")
        same("executed", bench.accesses(), [("W", 2, 1)])
    # SEQ 0 is a request like any other: after it, a request with the previous SEQ is not a repetition.
    await bench.ask("12 02", seq=0)
    await bench.ask("12 03", seq=5)
    same("executed", bench.accesses(), [("W", 2, 2), ("W", 2, 3)])


@cocotb.test()
@configs(FAST)
async def messages_seq_limit(dut):
    """A request with SEQ 127 is executed; SEQ 128 to 255 cause NAK 8, and the request is not executed
    (UB-SEQ-03, UB-SEQ-01).
    """
    bench = await Bench.start(dut)
    for seq in (128, 129, 200, 253, 254, 255):
        await bench.send(encode(bytes([seq, 0x12, 0x01])))
        same(f"SEQ {seq}", await bench.message(), b"\x81\x08")
        await bench.silent("no answer")
    same("accesses", bench.accesses(), [])
    for seq in (0, 1, 100, 125, 126, 127):
        same(f"SEQ {seq}", await bench.ask("00", seq=seq), b"\x00")


@cocotb.test()
@configs(FAST)
async def messages_answer_form(dut):
    """An answer contains POS and LAST only after a fault; LAST is 00 if the script has read no byte
    (UB-ANS-01, UB-ANS-03, UB-ANS-04).
    """
    bench = await Bench.start(dut)
    bench.slave.registers[9] = 0xC3
    same("no fault", await bench.ask("29"), b"\x00\xc3")
    same("empty script", await bench.ask(""), b"\x00")
    same("no read in this script", await bench.ask("00 12 01 0F"), b"\x03\x03\x00")
    bench.slave.registers[9] = 0x3C
    same("read", await bench.ask("29 06 0F"), b"\x03\x02\x3c\x3c\xff")
    bench.slave.registers[9] = 0x77
    same("every op before", await bench.ask("06 29 06 07 FF 10"), b"\x03\x05\x77\xff\x77\xff")
    same("last access was a write", await bench.ask("06 12 00 0A"), b"\x03\x03\x00\xff")


@cocotb.test()
@configs(FAST)
async def messages_events(dut):
    """Events are disabled at first. While they are enabled, each fall of int_n causes an event; enabling
    while int_n is low also causes one. Disabling discards pending events (UB-MSG-01, UB-MSG-02).
    """
    bench = await Bench.start(dut)
    event = b"\x80\xff"

    async def pulses(n: int = 1) -> None:
        for _ in range(n):
            dut.int_ni.value = 0
            await bench.clocks(3)
            dut.int_ni.value = 1
            await bench.clocks(3)

    await pulses()
    await bench.silent("off after reset")
    await bench.done("03 01")
    await bench.silent("int_n is high")
    dut.pins_i.value = 0xFE
    dut.int_ni.value = 0
    same("event", await bench.message(), b"\x80\xfe")
    await bench.silent("once a fall", 200)
    dut.int_ni.value = 1
    dut.pins_i.value = 0xFF
    await bench.silent("a rise is no event")
    # PINS contains the levels at the time of sending; here its second byte is a flag.
    dut.pins_i.value = 0x7E
    await pulses()
    same("escaped", await bench.message(), b"\x80\x7e")
    dut.pins_i.value = 0xFF
    # During an answer, any number of falls of int_ni causes one event, which is sent after the answer and
    # before NAK 7.
    await bench.send(encode(b"\x11\x32\x20"))
    await bench.quiet(120)
    await pulses(5)
    await bench.send([0x00])
    same("answer whole", (await bench.message())[:2], b"\x11\x00")
    same("event", await bench.message(), event)
    same("NAK", await bench.message(), b"\x81\x07")
    await bench.silent("one for all")
    # An event that occurs during a script is not sent before the answer.
    await bench.send(encode(b"\x12" + b"\x05" * 60 + b"\x06"))
    await bench.clocks(300)
    await pulses(2)
    same("answer first", await bench.message(), b"\x12\x00\xff")
    same("event", await bench.message(), event)
    # Falls of int_ni while an event is being sent cause another event.
    await pulses()
    await bench.quiet(45)
    await pulses(3)
    same("events", [await bench.message() for _ in range(2)], [event, event])
    await bench.silent("two")
    # Enabling events with int_ni low causes an event; enabling them again does not. Disabling events discards
    # a fall of int_ni.
    await bench.done("03 00")
    dut.int_ni.value = 0
    await bench.silent("disabled")
    await bench.done("03 01")
    same("enabled while low", await bench.message(), event)
    await bench.done("03 01")
    await bench.silent("was enabled")
    dut.int_ni.value = 1
    await bench.quiet()
    await bench.send(encode(b"\x13" + b"\x05" * 60 + b"\x03\x00"))
    await bench.clocks(300)
    await pulses(2)
    same("answer", await bench.message(), b"\x13\x00")
    await bench.done("03 01")
    await bench.silent("forgotten")


@cocotb.test()
@configs(FAST)
async def messages_event_and_request(dut):
    """A request that arrives while an event or a NAK is being sent is executed and answered (UB-MSG-01)."""
    bench = await Bench.start(dut)
    await bench.done("03 01")
    line = encode(b"\x00\x12\x44")
    for early in range(2, 50, 5):
        dut.int_ni.value = 0
        await bench.quiet(early)
        dut.int_ni.value = 1
        await bench.send(line)
        same("both", [await bench.message() for _ in range(2)], [b"\x80\xff", b"\x00\x00"])
        await bench.send(b"\x01\x7e" + line)
        same("both", [await bench.message() for _ in range(2)], [b"\x81\x04", b"\x00\x00"])
        same("executed", bench.accesses(), [("W", 2, 0x44)] * 2)


@cocotb.test()
@configs(SLOW)
async def messages_reset(dut):
    """rst_ni restores the rate, disables events, clears the stored answer, and resets the part (UB-LIN-02,
    UB-SEQ-02, UB-MSG-01).
    """
    bench = await Bench.start(dut)
    await bench.ask("03 01 07 11 02 01", seq=9)
    bench.baud = 230_400
    await bench.ask("12 01", seq=10)
    same("part", int(dut.part_rst_no.value), 1)
    dut.rst_ni.value = 0
    await bench.clocks(3)
    same(
        "part, straps, line",
        (int(dut.part_rst_no.value), int(dut.straps_o.value), int(dut.txd_o.value)),
        (0, 0xFF, 1),
    )
    dut.rst_ni.value = 1
    await bench.clocks(3)
    same("part", int(dut.part_rst_no.value), 1)
    bench.baud = 115_200
    bench.accesses()
    dut.int_ni.value = 0
    await bench.silent("events are off")
    same("executed again", await bench.ask("12 01", seq=10), b"\x00")
    same("write", bench.accesses(), [("W", 2, 1)])


@cocotb.test()
@configs(FAST)
async def messages_order(dut):
    """A pending event is sent before a pending NAK; enabling events again discards no event (UB-MSG-01,
    UB-MSG-02).
    """
    bench = await Bench.start(dut)

    async def fall() -> None:
        dut.int_ni.value = 0
        await bench.clocks(3)
        dut.int_ni.value = 1
        await bench.clocks(3)

    await bench.done("03 01")
    # The second fault and the falling edge of int_ni occur while the first NAK is being sent.
    await bench.send(b"\x01\x7e")
    await bench.quiet(30)
    await bench.send(b"\x01\x7e")
    await fall()
    assert not bench.got, "the first NAK has already been sent"
    same("order", [await bench.message() for _ in range(3)], [b"\x81\x04", b"\x80\xff", b"\x81\x04"])
    # A fall of int_ni during a script that enables events again still causes an event.
    await bench.send(encode(b"\x21" + b"\x05" * 60 + b"\x03\x01"))
    await bench.clocks(300)
    await fall()
    same("answer", await bench.message(), b"\x21\x00")
    same("event", await bench.message(), b"\x80\xff")
    await bench.silent("one")
