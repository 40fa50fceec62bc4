"""Measurements of the DATASHEET timing model (P2104-DS).

The C-event of a byte is the edge on which the core consumes it.
"""

from __future__ import annotations

from math import ceil

from cocotb_tests.harness import IBF

from .env import C_EVENT_LATEST, WRITE_EVENT, Axis, Env

# TOLERANCE: cycles by which a documented time may be exceeded. PIN: cycles by which a pin may follow the
# internal event.
TOLERANCE = 16
PIN = 2
# Maximum number of cycles from the fall of a status bit to the end of the read that returns it.
READ = 12
# Default ON phase in units of 2 quanta.
ON = 0x53

REGULAR, SETTING, CONSTANT = 35, 71_000, 38
"""Times in us: polling cycle, processing of an initial setting, processing of a pulse at constant speed."""


def detection(processing: int, first: int, second: int, period: int = 0) -> int:
    """Return T_max, the maximum time to detect a limit, in us (polling formula of the data sheet).

    Args:
        processing: Ti, the processing time that delays the polling cycle, in us.
        first: T1 of the first axis in us.
        second: T2 of the second axis in us.
        period: period of the pulses in us; 0: no pulses.
    """
    cycle = REGULAR + processing
    interrupts = ceil(cycle / (period - (first + second))) if period else 0
    return interrupts * (first + second) + cycle


def after(env: Env, rule: str, what: str, got: int, edge0: int, micros: int, extra: int = 0) -> None:
    """Check that `got` is `micros` us plus `extra` cycles after the C-event of the byte with `edge0`."""
    nominal = env.cfg.us(micros) + extra
    env.window(rule, what, got - edge0, WRITE_EVENT + nominal, C_EVENT_LATEST + nominal + TOLERANCE + PIN)


async def opens(env: Env, rule: str, edge0: int, micros: int) -> None:
    """Write a byte now; check that it waits until `micros` us after the C-event of the byte written at
    `edge0`.
    """
    nominal = edge0 + WRITE_EVENT + env.cfg.us(micros)
    # An undefined code is rejected without a processing window.
    await env.host.command(0x87, poll=False)
    await env.bench.until(max(env.bench.now, nominal - 60))
    while env.bench.now < nominal - 2:
        env.check(rule, "IBF in the window", await env.host.status() & IBF, IBF)
    await env.host.poll(IBF, 0, dense=100)
    latest = C_EVENT_LATEST - WRITE_EVENT + TOLERANCE + READ
    env.window(
        rule, f"cycles beyond {micros} us until the next byte is taken", env.bench.now - nominal, 0, latest
    )


async def last_byte(axis: Axis, code: int, *data: int) -> int:
    """Send an instruction; return edge 0 of its last byte without waiting for its C-event."""
    axis.since = axis.bench.now
    if not data:
        return await axis.command(code, poll=False)
    await axis.send(code, data[:-1])
    return await axis.host.data(data[-1], poll=False)


async def rest(env: Env) -> None:
    """Wait until no window is open and both axes are at standstill; then clear errors and interrupts."""
    await env.host.poll(IBF | 0x3C, 0)
    for axis in env.axes:
        await axis.finish()
        await axis.error()
    # Wait until the windows of these reads are over.
    await env.bench.clocks(env.cfg.us(60))
