"""Program of `make demo PART=ppmc312-serial`.

Sixteen axes on one line are set up, started one after the other, polled until each has stopped, and read
back. All axes stop at about the same time.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from contextlib import AbstractContextManager, nullcontext
from typing import Any

import cocotb

from cocotb_tests.harness import RtlBench
from cocotb_tests.harness.sessions import DemoLog
from cocotb_tests.ppmc312.line.master import Master, RtlPort
from cocotb_tests.ppmc312.line.setting import LINE, STATIONS

SETTING = "00 00 0140 00A0 000360"
"""Base clock 8 MHz, rates 320 to 160 (25 to 50 kpps), ramp of 864 pulses."""
PULSES = [2080 - 112 * number for number in range(STATIONS)]
"""Number of pulses of each axis. An axis that starts later makes fewer pulses."""
EVERY = range(STATIONS)
ROUNDS = 12


def ccw(station: int) -> bool:
    """Return whether an axis moves counterclockwise, as every second axis does."""
    return bool(station & 1)


Chapter = Callable[[str, str], AbstractContextManager[None]]


def no_chapter(key: str, title: str) -> AbstractContextManager[None]:
    """Return a context that does nothing: replacement of `DemoLog.chapter` in a run without a log."""
    return nullcontext()


async def program(master: Master, chapter: Chapter = no_chapter) -> list[int]:
    """Run the program of the master, on RTL or models; return the position of each axis that the master reads
    at the end.
    """
    with chapter("scan", "who is there"):
        for station in EVERY:
            reply = await master.poll(station)
            assert reply is not None and reply.kind == "ready", f"station {station}: {reply}"
    with chapter("set", "build sixteen tables"):
        for station in EVERY:
            await master.ask(station, SETTING)
    with chapter("start", "start sixteen axes"):
        for station in EVERY:
            await master.ask(station, f"{0xA3 if ccw(station) else 0x83:02x} 0000 {PULSES[station]:08x}")
    with chapter("poll", "poll until all have stopped"):
        moving = set(EVERY)
        for _ in range(ROUNDS):
            for station in sorted(moving):
                reply = await master.poll(station)
                assert reply is not None, f"station {station} is lost"
                if reply.kind == "data":
                    moving.discard(station)
        assert not moving, f"{moving} still move"
    with chapter("read", "read sixteen positions"):
        replies = [await master.ask(station, "42") for station in EVERY]
    return [int.from_bytes(reply.data, "big", signed=True) for reply in replies]


@cocotb.test()
async def demo_line(dut: Any) -> None:
    """The master's program runs on sixteen stations that were just powered up; the run is recorded."""
    bench = await RtlBench.start(dut, LINE, settle=8)
    master, demo_log = Master(RtlPort(bench)), DemoLog(bench)
    found = await program(master, demo_log.chapter)
    expected = [-pulses if ccw(station) else pulses for station, pulses in enumerate(PULSES)]
    bench.check("P312-SER-20", "positions read back", found, expected)
    await bench.clocks(400)
    demo_log.save()
    talk = [
        *((said.begin, said.end, "master", said.data.hex()) for said in master.said),
        *((said.begin, said.end, "station", said.data.hex()) for said in master.heard),
    ]
    (bench.out / "talk.json").write_text(json.dumps({"talk": sorted(talk), "positions": found}))
