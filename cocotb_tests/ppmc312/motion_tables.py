"""Tables for operations of the PPMC-312, and functions that their tests share."""

from __future__ import annotations

from cocotb_tests.ppmc312.directed_host import TICK
from cocotb_tests.ppmc312.host import Host
from cocotb_tests.ppmc312.messages import message, rates, stopped
from openppmc.model.ppmc312.codes import Code

STOP, SLOW_STOP = message(Code.STOP, "00"), message(Code.SLOW_STOP, "00")
ALWAYS = "03 04 86 00"
# Rates that are not monotonic, separate tables for both ramps: R[124..126] = 200 300 100. These three stages
# have 3, 4 and 5 pulses in the acceleration; in the deceleration, stage 124 is unused, and the others have 7
# and 6 pulses.
ODD = ("02 04 01 11 03 02", "00 06 0064 012C 00C8", "00 09 000005 000004 000003", "01 06 000006 000007")


def change(code: int, rate: int) -> str:
    return message(code, f"00 {rate:04X}")


async def run_out(host: Host, mark: int, cause: int, pulses: str, sign: int = 1) -> None:
    """Wait for the end of a motion; check the stop report, all intervals except the last, and the time of the
    report.

    The report follows the end of the last interval by less than 200 cycles.
    """
    expected = rates(pulses)
    await host.wait()
    seen = host.t
    assert await host.response() == stopped(cause, sign * len(expected))
    host.mark = mark
    assert host.gaps() == expected[:-1] and len(host.pulses()) == len(expected)
    assert 0 <= seen - host.pulses()[-1] - expected[-1] * TICK < 200
