"""`AxisDriver`: one axis as a host uses it: operations, pulses, results, and checks of a pulse train.

A device with one axis has one `AxisDriver`; a device with two axes has one for each axis, on one `HostBus`.
Times are in cycles.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from math import isqrt

from .bus import BUSY, COMMAND, DATA, HostBus
from .config import Config
from .dut_bench import DutBench

Ramp = tuple[int, int, int]

# Maximum number of pulses of an operation without a pulse count (P104-OPR-03).
NO_PULSES_DONE = 1 << 24

STEPS = {
    "3 full": "00011 00110 00101",
    "3 half": "00011 00010 00110 00100 00101 00001",
    "4 full": "00011 00110 01100 01001",
    "4 half": "00011 00010 00110 00100 01100 01000 01001 00001",
    "5 full": "00011 00110 01100 11000 10001",
    "5 half": "00011 00111 00110 01110 01100 11100 11000 11001 10001 10011",
}


def steps(name: str, positive: bool = True) -> list[int]:
    """Return the pin vectors [5:1] of a step list of P104-PHS-01, index 0 first."""
    mask = 0 if positive else 0x1F
    return [int(word, 2) ^ mask for word in STEPS[name].split()]


def rate(rl: int, rh: int, pa: int, k: int) -> int:
    """Return the rate of ramp index k, rounded half up from its exact value (P104-RMP-01).

    x(k)^2 = A·B·PA / (B·PA + (A - B)·k) with A = (RL + 1)^2 and B = (RH + 1)^2; the rate plus one is the
    largest n with n - 1/2 <= x.
    """
    a, b = (rl + 1) ** 2, (rh + 1) ** 2
    four_x2 = 4 * a * b * pa // (b * pa + (a - b) * k)
    return (isqrt(four_x2) + 1) // 2 - 1


def indices(n: int, pa: int) -> list[int]:
    """Return the ramp index of each interval of an undisturbed move of n pulses (P104-PRO-01)."""
    return [min(j - 1, n - 1 - j, pa) for j in range(1, n)]


def forced(n: int, pa: int, j: int) -> list[int]:
    """Return the interval indices of a move of n pulses that decelerates after pulse j (P104-FDC-02/03)."""
    done = indices(n, pa)[:j]
    return done + list(range(done[-1] - 1, -1, -1)) if done else []


def rates(ramp: Ramp, which: Iterable[int]) -> list[int]:
    """Return the rates of ramp (RL, RH, PA) at the given indices."""
    return [rate(*ramp, k) for k in which]


def quanta(r: int, csel: int = 1, vsel: int = 1) -> int:
    """Return the interval at rate r in quanta of the internal base clock (P104-INT-01/02).

    For a device without a vsel pin, use vsel = H.
    """
    return (r + 1) * (8 if csel else 32) + (0 if vsel else 30)


def offsets(config: Config, rate_list: Iterable[int], csel: int = 1, vsel: int = 1) -> list[int]:
    """Return the cycles from pulse 1 to each pulse, with cumulative rounding (P104-BCK-03)."""
    out, total = [0], 0
    for r in rate_list:
        total += quanta(r, csel, vsel)
        out.append(config.quanta(total))
    return out


def low_times(config: Config, rate_list: Sequence[int], csel: int = 1, vsel: int = 1) -> list[int]:
    """Return the low time of each pulse of a complete move on the internal clock (P104-TIM-05)."""
    fast = csel and vsel
    return [config.cyc(16 * (r + 1)) if fast and r <= 2 else config.w for r in rate_list] + [config.w]


def differences(values: Sequence[int]) -> list[int]:
    """Return the differences of neighbouring values."""
    return [b - a for a, b in zip(values, values[1:], strict=False)]


def bytes_of(value: int) -> list[int]:
    """Return the three bytes of a 24-bit value, low byte first."""
    return [value & 0xFF, value >> 8 & 0xFF, value >> 16 & 0xFF]


class AxisDriver:
    """An axis: pins `pout`, `phases`, `clock`; BUSY bit `busy`; `axis_bit`, which is ORed into every code.

    Pulses on or after edge `since` count as pulses of the present operation.
    """

    def __init__(
        self,
        bench: DutBench,
        host: HostBus,
        pout: str = "pout_n",
        phases: str = "s",
        clock: str = "clock",
        busy: int = BUSY,
        axis_bit: int = 0,
    ) -> None:
        self.bench = bench
        self.host = host
        self.pout = pout
        self.phases = phases
        self.clock = clock
        self.busy = busy
        self.axis_bit = axis_bit
        self.cfg: Config = bench.config
        self.check = bench.check
        self.window = bench.check_window
        self.since = 0

    # ---------------------------------------------------------------- operations

    async def go(self, code: int, n: int | None = None, rate: int | None = None, poll: bool = True) -> int:
        """Send an operation of n pulses (None: an operation without a pulse count).

        Return the status after the last byte, or edge 0 of the write of this byte if `poll` is False. The
        method sets `since`: pulses on this edge or later count for the operation.
        """
        self.since = self.bench.now
        data = ([] if rate is None else [rate]) + ([] if n is None else bytes_of(n - 1))
        code |= self.axis_bit
        if not data:
            return await self.host.command(code, poll)
        await self.host.send(code, data[:-1])
        return await self.host.data(data[-1], poll)

    async def move(self, code: int, n: int | None = None, rate: int | None = None) -> list[int]:
        """Start an operation with `go`, wait for its end, and return its pulses."""
        await self.go(code, n, rate)
        await self.idle()
        return self.pulses

    async def idle(self, timeout: int | None = None) -> int:
        """Poll until BUSY = 0; return the status that was read last."""
        return await self.host.wait_idle(timeout, self.busy)

    async def command(self, code: int, poll: bool = True) -> int:
        """Send a code to this axis, poll until IBF = 0, and return the status that was read last.

        Without `poll`, return edge 0 of the write.
        """
        return await self.host.command(code | self.axis_bit, poll)

    @property
    def pulses(self) -> list[int]:
        """Pulses since the last `go`."""
        return self.bench.pulses(self.since, self.pout)

    @property
    def intervals(self) -> list[int]:
        """Intervals since the last `go`."""
        return differences(self.pulses)

    @property
    def low_times(self) -> list[int]:
        """Low times of the complete pulses since the last `go`."""
        return self.bench.low_times(self.since, self.pout)

    async def pulse(self, n: int, plus: int = 0) -> int:
        """Wait for the n-th pulse of the last `go`, then for `plus` cycles; return the edge of the pulse."""
        fall = await self.bench.nth_fall(n, self.since, self.pout)
        if plus:
            await self.bench.until(fall + plus)
        return fall

    async def wait_end(self, timeout: int = 1_000_000) -> int:
        """Wait until int_n falls after the last `go`; return that edge.

        The operation must enable the interrupt (I = 0), and no interrupt may be pending.
        """
        if falls := self.bench.falls("int_n", self.since):
            await self.bench.align()
            return falls[0]
        return await self.bench.edge("int_n", 0, timeout)

    async def busy_until(self, end: Callable[[], bool], rule: str) -> int:
        """Read status until `end()` is true; every read must return BUSY = 1. Return the number of reads."""
        count = 0
        while not end():
            status = await self.host.status()
            if end():
                break
            self.check(rule, "BUSY while the operation runs", status & self.busy, self.busy)
            count += 1
        return count

    # ---------------------------------------------------------------- results

    async def fetch(self, code: int, count: int = 1) -> list[int]:
        """Send a read command for this axis, then read `count` data bytes."""
        return await self.host.fetch(code | self.axis_bit, count)

    async def finish(self) -> int:
        """Read the finish (end) status (0x80)."""
        return (await self.fetch(0x80))[0]

    async def remaining(self) -> int:
        """Read the number of remaining pulses (0x83)."""
        low, middle, high = await self.fetch(0x83, 3)
        return low | middle << 8 | high << 16

    async def result(self, rule: str, pulses: int | None, finish: int, remaining: int | None = None) -> None:
        """Wait for the end of the operation and check its pulse count, finish status and remaining value."""
        await self.idle()
        if pulses is not None:
            self.check(rule, "number of pulses", len(self.pulses), pulses)
        self.check(rule, "finish status", await self.finish(), finish)
        if remaining is not None:
            self.check(rule, "remaining value", await self.remaining(), remaining)

    def check_train(self, rule: str, rates: Sequence[int], csel: int = 1, vsel: int = 1) -> None:
        """Check that each pulse of the last `go` occurs in the cycle that `rates` implies (P104-BCK-03)."""
        pulses = self.pulses
        got = [t - pulses[0] for t in pulses]
        expected = offsets(self.cfg, rates, csel, vsel)
        if got == expected:
            return
        self.check(rule, "number of pulses", len(got), len(expected))
        j = next(j for j, pair in enumerate(zip(got, expected, strict=True), 1) if pair[0] != pair[1])
        self.check(rule, f"cycles from pulse 1 to pulse {j}", got[j - 1], expected[j - 1])

    def check_lows(self, rule: str, rates: Sequence[int], csel: int = 1, vsel: int = 1) -> None:
        """Check each low time of a complete move (P104-TIM-05)."""
        self.check(rule, "low times", self.low_times, low_times(self.cfg, rates, csel, vsel))

    def stretches(self, since: int) -> list[tuple[int, int]]:
        """Return (pattern, cycles) of each phase pattern that began at `since` or later and has ended."""
        edges = self.bench.edges(self.phases, since)
        return [(value, b - a) for (a, value), (b, _) in zip(edges, edges[1:], strict=False)]

    def outputs(self) -> dict[str, int]:
        """Return the present levels of all outputs except the host bus and free-running outputs."""
        return {
            name: self.bench.level(name) for name in self.bench.part.watched if name not in ("d_o", "d_oe")
        }

    # ---------------------------------------------------------------- external clock by hand

    async def ticks(self, n: int, period: int = 24) -> None:
        """Drive n rising edges of the external clock, with half of each period high."""
        for _ in range(n):
            self.bench.set(**{self.clock: 1})
            await self.bench.clocks(period // 2)
            self.bench.set(**{self.clock: 0})
            await self.bench.clocks(period - period // 2)

    async def tick_until(self, pulses: int, limit: int = 2000) -> None:
        """Drive edges of the external clock until the last `go` has output `pulses` pulses."""
        for _ in range(limit):
            if len(self.pulses) >= pulses:
                break
            await self.ticks(1)
        self.check("TIM-03", "pulses made by external clock edges", len(self.pulses), pulses)
        await self.bench.level_is(self.pout, 1)

    def clock_edges(self, since: int = 0) -> list[int]:
        """Return the rising edges of the external clock pin, see `DutBench.pin_edges`."""
        return self.bench.pin_edges(self.clock, 1, since)

    # ---------------------------------------------------------------- byte by byte

    async def reaction(self, output: str, byte: int, register: int = COMMAND) -> int:
        """Write one byte and wait for an output to change; return the cycles from edge 0 to that change."""
        edge0 = await self.host.write(register, byte)
        if changes := self.bench.edges(output, edge0):
            return changes[0][0] - edge0
        return await self.bench.edge(output) - edge0

    async def status_after(self, byte: int, register: int = COMMAND) -> int:
        """Write one byte and poll until IBF = 0; return the status that was read last."""
        return await (self.host.command(byte) if register == COMMAND else self.host.data(byte))

    async def statuses(self, script: str) -> list[int]:
        """Write the bytes of a script such as "c 0A d 09" with polling; return the status after each byte."""
        words = script.split()
        pairs = zip(words[::2], words[1::2], strict=True)
        return [
            await self.status_after(int(byte, 16), COMMAND if kind == "c" else DATA) for kind, byte in pairs
        ]
