"""Random hosts of the PMC006 whose frames and pins come about the clk on which something happens."""

from __future__ import annotations

from math import ceil, gcd

from .random_frames import DATA
from .random_motion import Motions
from .script_meetings import ACT

LIMIT_US = 6_000
"""So long a motion is watched for something to meet."""
SIGNALS = ("mon_busy", "mon_busy", "mon_step", "m10")
NEAR = 6
"""How far frame and event are apart at most, in clk."""


class Meetings(Motions):
    """Two things at a time."""

    def meeting(self) -> None:
        """A short motion, then the same where something comes about an edge that the first has shown."""
        rng, host = self.rng, self.host
        for code, data in (("I", 0), ("g", 0), ("b", 0), ("l", 0), ("v", 3000), ("L", 3000)):
            if rng.random() < 0.8:
                self.frame(code, data)
        host.forget()
        count = rng.choice((5, 6, 8, 12))
        begin, e = self._start(count)
        # Behind the reply a whole frame must have room.
        least = e + ceil(82 * host.bit) + (e - begin) + 2 * NEAR
        while host.busy and host.t < e + host.us(LIMIT_US):
            host.step()
        found = {
            name: [t - e for t, _ in host.edges(name, least)] for name in ("mon_busy", "mon_step", "m10")
        }
        period = host.clk_hz // gcd(host.clk_hz, 1_000_000)  # of the clk on which µs begin
        for _ in range(3):
            if host.busy or not found["mon_busy"]:
                return
            host.pause(rng.choice((1, 2, 500)))
            host.go(host.t + (begin - host.t) % period)
            times = found[rng.choice(SIGNALS)] or found["mon_busy"]
            self._meet(count, rng.choice(times))

    def _meet(self, count: int, after: int) -> None:
        """The motion again, and what comes so many clk after the end of its frame, more or less."""
        rng, host = self.rng, self.host
        begin, e = self._start(count)
        at = e + after + rng.randint(-NEAR, NEAR)
        if rng.random() < 0.4:
            self._pins(at - 2 + rng.randint(-NEAR, NEAR))
        host.go(max(host.t, at - ACT - (e - begin)))
        code = rng.choice("ssssNNNvvIgdicjmufbp")
        host.say(code, count if code == "s" else rng.choice(DATA.get(code, (0, 1))))
        self.await_reply()
        host.forget()
        self.seen["met"] += 1
        self.left -= 1
        if host.busy and rng.random() < 0.9:
            self.frame("I")

    def _start(self, count: int) -> tuple[int, int]:
        """A motion, and its reply; returns the edges of the frame's begin and end."""
        host = self.host
        host.say("s", count)
        begin, e = host.said, host.e
        host.go(max(host.t, e + ceil(host.bit) + 9))
        host.forget()
        return begin, e

    def _pins(self, t: int) -> None:
        """What comes from the machine at edge t."""
        pin = self.rng.choice(("ext1", "ext2", "cmp_a", "bemf_valid"))
        level = 1 - self.model.inputs[pin]
        self.background.add(t, **{pin: level})
        if pin == "bemf_valid":
            self.background.add(t + 1, bemf_valid=0)
