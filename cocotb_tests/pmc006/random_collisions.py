"""Random hosts of the PMC006 whose frames and pins arrive near the cycle of an event."""

from __future__ import annotations

from contextlib import suppress
from math import ceil, gcd

from .host import ACT
from .random_frames import DATA
from .random_motion import MotionHost

LIMIT_US = 6_000
"""Maximum time for which a motion is observed for events, in microseconds."""
NEAR = 4
"""Maximum distance between a frame and an event, in cycles."""
SIGNALS = ("mon_busy", "mon_busy", "mon_step", "m10")
EASY = (("I", 0), ("g", 0), ("b", 0), ("l", 0), ("o", 5))
MOVE = (("v", 3000), ("L", 3000), ("S", 3000))
RUN = (("v", 300), ("L", 300), ("S", 65))
"""Settings with which the part accepts most motions (moves and runs of the speed mode), which end soon."""

Course = tuple[tuple[str, int], ...]


class CollisionHost(MotionHost):
    """Random host that makes two events coincide."""

    async def collision(self) -> None:
        """Make a short motion, then repeat it with a frame or pin change near an edge of the first motion."""
        rng, host = self.rng, self.host
        course: Course = (("s", rng.choice((5, 6, 8, 12))),)
        if rng.random() < 0.5:
            course = (("N", 1), ("N", 0))
        for code, data in (*EASY, *(MOVE if len(course) == 1 else RUN)):
            if rng.random() < 0.9:
                await self.frame(code, data)
        await host.ignore_replies()
        begin, e = await self._start(course)
        # Between the reply and the edge there must be time for a complete frame.
        least = e + ceil(82 * host.bit) + e - host.frame_start + 2 * NEAR
        with suppress(TimeoutError):
            await host.until("mon_busy", 0, LIMIT_US)
        await host.go(max(host.t, host.bench.now))
        found = {name: [t - e for t, _ in host.edges(name, least)] for name in set(SIGNALS)}
        # After `period` cycles, the phase of `clk` to the start of a microsecond is the same again.
        period = host.clk_hz // gcd(host.clk_hz, 1_000_000)
        for _ in range(4):
            if await host.busy() or not found["mon_busy"]:
                return
            await host.pause(rng.choice((1, 2, 500)))
            await host.go(host.t + (begin - host.t) % period)
            times = found[rng.choice(SIGNALS)] or found["mon_busy"]
            await self._collide(course, rng.choice(times))

    async def _collide(self, course: Course, after: int) -> None:
        """Repeat the motion `course`, and send another frame whose effect is about `after` cycles after the
        end of the last frame of `course`.
        """
        rng, host = self.rng, self.host
        _, e = await self._start(course)
        at = e + after + rng.randint(-NEAR, NEAR)
        if rng.random() < 0.3:
            self._pins(at - 2 + rng.randint(-NEAR, NEAR))
        await host.go(max(host.t, at - ACT - (e - host.frame_start)))
        code = rng.choice("ssssNNNvvIgdicjmufbp")
        await host.send_frame(code, 8 if code == "s" else rng.choice(DATA.get(code, (1, 1, 0))))
        await self.await_reply()
        await host.ignore_replies()
        self.seen["collisions"] += 1
        self.left -= 1
        if await host.busy():
            await self.host.pause(rng.choice((0, 1_000, 4_000)))
            await self.frame("I")

    async def _start(self, course: Course) -> tuple[int, int]:
        """Start a motion and wait for the replies.

        Return the start of the first frame and the end of the last one.
        """
        host, begin = self.host, self.host.t
        for place, (code, data) in enumerate(course):
            await host.go(begin + place * ceil(175 * host.bit))
            await host.send_frame(code, data)
            await host.go(max(host.t, host.e + ceil(host.bit) + 9))
            await host.ignore_replies()
        return begin, host.e

    def _pins(self, t: int) -> None:
        """Add a change of a switch, comparator or back-EMF input at edge t."""
        pin = self.rng.choice(("ext1", "ext2", "cmp_a", "bemf_valid"))
        level = 1 - self.host.bench.pin(pin)
        self.background.add(t, **{pin: level})
        if pin == "bemf_valid":
            self.background.add(t + 1, bemf_valid=0)
