"""Instruction unit of the PPMC-312: arbitration, checks, execution, responses.

Rules: P312-BLK-01, P312-RSP-20, P312-OVR-10. One instruction is processed at a time. Blocks of the host,
released entries of the command FIFO and stored event edges wait in this unit.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

from ...chip import Phase
from ..codes import Alarm, Code, Source, Trigger
from ..front.responses import ANSWER, Report
from ..timing import WIDTH
from .overrides import Core
from .starts import check, is_reset
from .work import Refusal, Work, refusal_block


class Job(NamedTuple):
    """Instruction to process.

    Attributes:
        block: block in logical order.
        source: source of the instruction.
        since: edge that the DATASHEET times count from.
        buffer: number of the event buffer.
        at_position: True if a position has released it.
    """

    block: bytes
    source: Source
    since: int
    buffer: int = 0
    at_position: bool = False


class Unit:
    """Instruction unit.

    Args:
        core: all blocks and state that instructions act on.

    Attributes:
        holding: True if a response is about to be stored; reports of classes 3 to 8 follow it.
    """

    def __init__(self, core: Core) -> None:
        self._core = core
        self._busy = False
        self._free = 0
        self._host: Job | None = None
        self._host_next = False
        self._source = Source.HOST
        self._answered = True
        self._job: Job | None = None
        self._storing = False
        self._late: bytes | None = None
        self._open_from = 0
        """Edge from which the place of the response that was read last may be used."""
        self._alarming = False
        self._rest: list[bytes] = []
        self.holding = False

    # ------------------------------------------------------------------ requests

    def host_block(self, t: int, block: bytes) -> None:
        """Process a complete block that was written; the write event of its header is at edge t."""
        self._host = Job(block, Source.HOST, t)
        self._answered = False
        self.kick(t)

    def kick(self, t: int) -> None:
        """Schedule an arbitration, because an instruction may wait."""
        self._at(t + self._core.pace.turn, self._turn)

    def event(self, t: int, trigger: Trigger) -> None:
        """Process a falling edge of an event pin (P312-EVT-01, -04, P312-OVR-10)."""
        buffer = self._core.events[trigger - 1]
        if buffer.entries:
            if buffer.edge is None:
                buffer.edge = t
        elif not self._core.fifo.event(t, trigger):
            return
        self.kick(t)

    @property
    def settled(self) -> bool:
        """True if all released entries of the command FIFO are processed.

        In addition, no alarm may be pending.
        """
        busy = self._busy and self._source is Source.OVERRIDE
        return not self._core.fifo.triggered and not self._alarming and not busy

    def _at(self, t: int, action: Callable[[int], None]) -> None:
        """Schedule an action before other events of edge t.

        Instructions see the state before an edge.
        """
        self._core.context.queue.at(t, Phase.BUS, action)

    # ------------------------------------------------------------------ arbitration

    def _turn(self, t: int) -> None:
        if self._busy or t < self._free:
            return
        waits, host = self._next(t), self._host is not None and self._seen(self._host.since, t)
        if waits is not None and not (self._host_next and host):
            if not self._core.responses.serial and self._unread():
                self._lost(t, waits)
            else:
                self._host_next = True
                self._begin(t, self._take(waits))
        elif host:
            job, self._host = self._host, None
            assert job
            self._host_next = False
            self._begin(t, job)

    def _unread(self) -> bool:
        """Return True if a response has not been read, or is about to be stored."""
        occupied = bool(self._core.responses.answer) or self._storing
        return occupied or (not self._answered and self._host is None)

    def _seen(self, since: int, t: int) -> bool:
        """Return True if an instruction that arrived at edge `since` can begin at edge t."""
        return since + self._core.pace.turn <= t

    def _next(self, t: int) -> tuple[Source, int] | None:
        """Return the first of the triggered instructions, with the number of its buffer (P312-OVR-10).

        The priority is position, evt0, evt1.
        """
        fifo, events = self._core.fifo, self._core.events
        waits = [
            (n + 1, 0, (Source.EVENT, n))
            for n, buffer in enumerate(events)
            if buffer.edge is not None and self._seen(buffer.edge, t)
        ]
        if fifo.triggered and self._seen(fifo.triggered[0].t, t):
            waits.append((fifo.triggered[0].entry.trigger, 1, (Source.OVERRIDE, 0)))
        return min(waits)[-1] if waits else None

    def _take(self, waits: tuple[Source, int]) -> Job:
        source, number = waits
        if source is Source.OVERRIDE:
            first = self._core.fifo.triggered.popleft()
            at_position = first.entry.trigger is Trigger.POSITION
            return Job(first.entry.block, source, first.t, at_position=at_position)
        buffer = self._core.events[number]
        since, buffer.edge = buffer.edge, None
        assert since is not None
        return Job(buffer.take(), source, since, number)

    def _lost(self, t: int, waits: tuple[Source, int]) -> None:
        """Process a multiple occurrence (P312-RSP-20).

        The instruction is not executed, and the instructions that wait with it are discarded.
        """
        source, number = waits
        if source is Source.EVENT:
            self._core.events[number].clear()
        else:
            self._core.drop_overrides(t)
        self._alarm_soon(t)
        self.kick(t)

    def _alarm_soon(self, t: int) -> None:
        """Schedule the alarm of a multiple occurrence at edge t."""
        self._alarming = True
        self._at(t + self._core.pace.alarm, self._alarm)

    def _alarm(self, t: int) -> None:
        self._alarming = False
        self._core.alarm(t, Alarm.HOST)
        self._core.operation.motion.look_at_rest_soon(t)

    # ------------------------------------------------------------------ processing

    def _begin(self, t: int, job: Job) -> None:
        pace = self._core.pace
        self._busy, self._source, self._job, self._began = True, job.source, job, t
        if is_reset(job.block):
            self._at(t + pace.reset, lambda now: self._core.reset(now, job.source))
            return
        if job.source is Source.HOST:
            self._at(t + pace.reset, lambda now: self._look_at_store(now, job))
        self._at(t + pace.judge, lambda now: self._judge(now, t, job))

    def _look_at_store(self, t: int, job: Job) -> None:
        """Reject an instruction of a host that has not read its last response.

        The instruction is not executed (P312-RSP-20).
        """
        answer = self._core.responses.answer
        if answer and answer.source is Source.HOST:
            self._idle(t)
            self._answered = True
            self._alarm_soon(t)
            self._core.host.done(t)
            self.kick(t)

    def _judge(self, t: int, begun: int, job: Job) -> None:
        if self._job is not job:
            return
        act = begun + self._core.pace.effect
        try:
            work = check(self._core, job.block, job.source, job.at_position)
        except Refusal as refusal:
            found = refusal
            self.holding = not refusal.clk
            self._at(act + refusal.clk, lambda now: self._refuse(now, job, found))
            return
        at = act
        if work.cycles is not None and not work.clk:
            at = self._paced(act, work)
        self.holding = at == act
        if at != act:
            self._at(at - 1, self._hold)
        self._at(at, lambda now: self._act(now, job, work))

    def _hold(self, t: int) -> None:
        self.holding = True

    def _paced(self, t: int, work: Work) -> int:
        """Return the edge that the original chip's time defines (P312-TIM-20).

        The time counts from the begin of processing.
        """
        core = self._core
        if not core.context.datasheet or work.cycles is None:
            return t
        timebase, pace = core.context.timebase, core.pace
        cycles = work.cycles - pace.early - (WIDTH if work.starts else 0)
        return max(t, self._began + timebase.cyc(cycles) + (pace.paced if work.starts or not work.clk else 2))

    def _act(self, t: int, job: Job, work: Work) -> None:
        """Execute the effect of a short instruction."""
        if work.begin:
            work.begin(t)
        due = self._paced(t + work.clk, work) if work.clk else t
        if due == t:
            self._finish(t, job, work)
            return
        self.holding = False
        self._core.host.offer(t)
        if work.check:
            # The check uses the levels of that edge.
            look = t + self._core.pace.limits
            self._core.context.queue.at(look, Phase.COMMAND, lambda now: self._check(now, job, work, due))
        else:
            self._at(due, lambda now: self._finish(now, job, work))

    def _check(self, t: int, job: Job, work: Work, due: int) -> None:
        assert work.check
        try:
            work.check(t)
        except Refusal as refusal:
            found = refusal
            self._at(t + 1, lambda now: self._refuse(now, job, found))
            return
        self._at(due, lambda now: self._finish(now, job, work))

    def _finish(self, t: int, job: Job, work: Work) -> None:
        try:
            answer = work.finish(t)
        except Refusal as refusal:
            self._refuse(t, job, refusal)
            return
        blocks = answer if isinstance(answer, list) else [bytes([job.source, len(answer)]) + answer]
        self._answer(t, job.source, blocks)

    def _refuse(self, t: int, job: Job, refusal: Refusal) -> None:
        core = self._core
        self._answer(t, job.source, [refusal_block(refusal, job.source, core.state, job.block[2:])])
        if job.source is Source.EVENT:
            core.events[job.buffer].clear()
        elif job.source is Source.OVERRIDE:
            core.drop_overrides(t)

    # ------------------------------------------------------------------ responses

    def _answer(self, t: int, source: Source, blocks: list[bytes]) -> None:
        """Write the response to an instruction whose effect was at edge t, one byte per cycle."""
        self.holding, self._rest = True, blocks[1:]
        self._write(t + self._core.pace.answer + len(blocks[0]), blocks[0], source)

    def _write(self, stored: int, block: bytes, source: Source) -> None:
        self._storing = True
        self._at(stored - 1, self._over)
        self._core.context.queue.at(stored, Phase.STORE, lambda now: self._store(now, block, source))

    def _over(self, t: int) -> None:
        """Enable the next instruction."""
        self._idle(t)
        # While a response has to wait, other reports may be sent before it.
        self.holding = self._core.responses.answer is None
        self._core.operation.motion.look_at_rest_soon(t)
        self.kick(t)

    def _idle(self, t: int) -> None:
        self._busy, self._job, self._free = False, None, t + self._core.pace.turn

    def answer_reset(self, t: int) -> None:
        """Write the response to a reset by FF, the first one after it."""
        self._busy = True
        self._answer(t, Source.HOST, [bytes([Source.HOST, 1, Code.RESET])])

    def _store(self, t: int, block: bytes, source: Source) -> None:
        if self._core.responses.serial:
            self._storing = self.holding = False
            self._answered = True
            self._core.host.answer(t, source, block)
            return
        if t < self._open_from:
            self._core.context.queue.at(
                self._open_from, Phase.STORE, lambda now: self._store(now, block, source)
            )
            return
        if not self._core.responses.post(t, ANSWER, [block], source):
            # The response follows one to an event or an override, and the mailbox stays closed (P312-RSP-20).
            self._late = block
            return
        self._late, self._storing, self.holding = None, False, bool(self._rest)
        if source is Source.HOST and not self._rest:
            self._at(t + self._core.pace.done, self._done)

    def _done(self, t: int) -> None:
        self._answered = True
        self._core.host.done(t)

    def was_read(self, t: int, report: Report) -> None:
        """Process the read of a response; the waiting response, or its next block, follows."""
        if report.kind != ANSWER:
            return
        pace, queue, late = self._core.pace, self._core.context.queue, self._late
        self._open_from = t + pace.late
        if late is not None:
            queue.at(self._open_from, Phase.STORE, lambda now: self._store(now, late, Source.HOST))
        elif self._rest:
            following = self._rest.pop(0)
            self._at(t + 1, self._fetch)
            self._write(t + pace.reading(following), following, Source.HOST)

    def _fetch(self, t: int) -> None:
        """Assemble the next block of a table read.

        Instructions that are discarded at the same edge are processed before it.
        """
        if waits := self._next(t):
            self._lost(t, waits)
        self._busy, self._source = True, Source.HOST
