"""Instruction unit of the PPMC-312: arbitration, checks, execution, responses.

Rules: P312-BLK-01, P312-RSP-20, P312-OVR-10. One instruction is processed at a time. This unit selects among
blocks of the host, released entries of the command FIFO, and stored event edges.
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
from .work import Rejection, Work, rejection_block


class Job(NamedTuple):
    """Instruction to process.

    Attributes:
        block: block in logical order.
        source: source of the instruction.
        since: edge from which the DATASHEET times are counted.
        buffer: number of the event buffer.
        at_position: True if a position has released the instruction.
    """

    block: bytes
    source: Source
    since: int
    buffer: int = 0
    at_position: bool = False


class Unit:
    """Instruction unit.

    Args:
        core: blocks and state that instructions use.

    Attributes:
        response_pending: True if a response is about to be stored; reports of classes 3 to 8 wait for it.
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
        self._waiting_block: bytes | None = None
        self._open_from = 0
        """First edge at which the response store may accept a response after the previous one was read."""
        self._alarming = False
        self._next_blocks: list[bytes] = []
        self.response_pending = False

    # ------------------------------------------------------------------ requests

    def host_block(self, t: int, block: bytes) -> None:
        """Process a complete block that was written; the write event of its header is at edge t."""
        self._host = Job(block, Source.HOST, t)
        self._answered = False
        self.schedule(t)

    def schedule(self, t: int) -> None:
        """Schedule an arbitration, because an instruction may be waiting."""
        self._at(t + self._core.core_timing.arbitration, self._arbitrate)

    def event(self, t: int, trigger: Trigger) -> None:
        """Process a falling edge of an event pin (P312-EVT-01, -04, P312-OVR-10)."""
        buffer = self._core.events[trigger - 1]
        if buffer.entries:
            if buffer.edge is None:
                buffer.edge = t
        elif not self._core.fifo.event(t, trigger):
            return
        self.schedule(t)

    @property
    def overrides_done(self) -> bool:
        """True if all released entries of the command FIFO are processed, and no alarm is pending."""
        busy = self._busy and self._source is Source.OVERRIDE
        return not self._core.fifo.triggered and not self._alarming and not busy

    def _at(self, t: int, action: Callable[[int], None]) -> None:
        """Schedule an action that precedes the other events of edge t.

        Thus, instructions use the state that was valid before this edge.
        """
        self._core.context.queue.at(t, Phase.BUS, action)

    # ------------------------------------------------------------------ arbitration

    def _arbitrate(self, t: int) -> None:
        if self._busy or t < self._free:
            return
        waiting, host = (
            self._first_waiting(t),
            self._host is not None and self._has_arrived(self._host.since, t),
        )
        if waiting is not None and not (self._host_next and host):
            if not self._core.responses.serial and self._unread():
                self._multiple_occurrence(t, waiting)
            else:
                self._host_next = True
                self._begin(t, self._next_job(waiting))
        elif host:
            job, self._host = self._host, None
            assert job
            self._host_next = False
            self._begin(t, job)

    def _unread(self) -> bool:
        """Return True if a response is unread, or is about to be stored."""
        occupied = bool(self._core.responses.answer) or self._storing
        return occupied or (not self._answered and self._host is None)

    def _has_arrived(self, since: int, t: int) -> bool:
        """Return True if an instruction that arrived at edge `since` can begin at edge t."""
        return since + self._core.core_timing.arbitration <= t

    def _first_waiting(self, t: int) -> tuple[Source, int] | None:
        """Return source and buffer number of the first triggered instruction (P312-OVR-10).

        The priority is: position, evt0, evt1.
        """
        fifo, events = self._core.fifo, self._core.events
        waiting = [
            (n + 1, 0, (Source.EVENT, n))
            for n, buffer in enumerate(events)
            if buffer.edge is not None and self._has_arrived(buffer.edge, t)
        ]
        if fifo.triggered and self._has_arrived(fifo.triggered[0].t, t):
            waiting.append((fifo.triggered[0].entry.trigger, 1, (Source.OVERRIDE, 0)))
        return min(waiting)[-1] if waiting else None

    def _next_job(self, waiting: tuple[Source, int]) -> Job:
        source, number = waiting
        if source is Source.OVERRIDE:
            first = self._core.fifo.triggered.popleft()
            at_position = first.entry.trigger is Trigger.POSITION
            return Job(first.entry.block, source, first.t, at_position=at_position)
        buffer = self._core.events[number]
        since, buffer.edge = buffer.edge, None
        assert since is not None
        return Job(buffer.take(), source, since, number)

    def _multiple_occurrence(self, t: int, waiting: tuple[Source, int]) -> None:
        """Process a multiple occurrence (P312-RSP-20).

        The instruction is not executed, and all instructions in the same buffer are discarded.
        """
        source, number = waiting
        if source is Source.EVENT:
            self._core.events[number].clear()
        else:
            self._core.drop_overrides(t)
        self._schedule_alarm(t)
        self.schedule(t)

    def _schedule_alarm(self, t: int) -> None:
        """Schedule the alarm of a multiple occurrence at edge t."""
        self._alarming = True
        self._at(t + self._core.core_timing.alarm, self._alarm)

    def _alarm(self, t: int) -> None:
        self._alarming = False
        self._core.alarm(t, Alarm.HOST)
        self._core.operation.motion.schedule_standstill_check(t)

    # ------------------------------------------------------------------ processing

    def _begin(self, t: int, job: Job) -> None:
        core_timing = self._core.core_timing
        self._busy, self._source, self._job, self._began = True, job.source, job, t
        if is_reset(job.block):
            self._at(t + core_timing.reset, lambda now: self._core.reset(now, job.source))
            return
        if job.source is Source.HOST:
            self._at(t + core_timing.reset, lambda now: self._check_response_store(now, job))
        self._at(t + core_timing.check, lambda now: self._check(now, t, job))

    def _check_response_store(self, t: int, job: Job) -> None:
        """Do not execute an instruction if the host has not read the last response (P312-RSP-20)."""
        answer = self._core.responses.answer
        if answer and answer.source is Source.HOST:
            self._idle(t)
            self._answered = True
            self._schedule_alarm(t)
            self._core.host.done(t)
            self.schedule(t)

    def _check(self, t: int, begun: int, job: Job) -> None:
        if self._job is not job:
            return
        effect_at = begun + self._core.core_timing.effect
        try:
            work = check(self._core, job.block, job.source, job.at_position)
        except Rejection as rejection:
            rejected = rejection
            self.response_pending = not rejection.clk
            self._at(effect_at + rejection.clk, lambda now: self._reject(now, job, rejected))
            return
        at = effect_at
        if work.cycles is not None and not work.clk:
            at = self._proc_time_edge(effect_at, work)
        self.response_pending = at == effect_at
        if at != effect_at:
            self._at(at - 1, self._set_response_pending)
        self._at(at, lambda now: self._execute(now, job, work))

    def _set_response_pending(self, t: int) -> None:
        self.response_pending = True

    def _proc_time_edge(self, t: int, work: Work) -> int:
        """Return the edge at which the processing time of the original chip ends (P312-TIM-20).

        This time is counted from the start of processing.
        """
        core = self._core
        if not core.context.datasheet or work.cycles is None:
            return t
        timebase, core_timing = core.context.timebase, core.core_timing
        cycles = work.cycles - core_timing.early - (WIDTH if work.starts else 0)
        return max(
            t,
            self._began
            + timebase.cyc(cycles)
            + (core_timing.proc_time if work.starts or not work.clk else 2),
        )

    def _execute(self, t: int, job: Job, work: Work) -> None:
        """Process the edge at which a short instruction takes effect."""
        if work.begin:
            work.begin(t)
        finish_at = self._proc_time_edge(t + work.clk, work) if work.clk else t
        if finish_at == t:
            self._finish(t, job, work)
            return
        self.response_pending = False
        self._core.host.notify_response(t)
        if work.check:
            # The check uses the levels at its own edge, not at the current edge.
            check_at = t + self._core.core_timing.limits
            self._core.context.queue.at(
                check_at, Phase.COMMAND, lambda now: self._check_limits(now, job, work, finish_at)
            )
        else:
            self._at(finish_at, lambda now: self._finish(now, job, work))

    def _check_limits(self, t: int, job: Job, work: Work, finish_at: int) -> None:
        assert work.check
        try:
            work.check(t)
        except Rejection as rejection:
            rejected = rejection
            self._at(t + 1, lambda now: self._reject(now, job, rejected))
            return
        self._at(finish_at, lambda now: self._finish(now, job, work))

    def _finish(self, t: int, job: Job, work: Work) -> None:
        try:
            answer = work.finish(t)
        except Rejection as rejection:
            self._reject(t, job, rejection)
            return
        blocks = answer if isinstance(answer, list) else [bytes([job.source, len(answer)]) + answer]
        self._answer(t, job.source, blocks)

    def _reject(self, t: int, job: Job, rejection: Rejection) -> None:
        core = self._core
        self._answer(t, job.source, [rejection_block(rejection, job.source, core.state, job.block[2:])])
        if job.source is Source.EVENT:
            core.events[job.buffer].clear()
        elif job.source is Source.OVERRIDE:
            core.drop_overrides(t)

    # ------------------------------------------------------------------ responses

    def _answer(self, t: int, source: Source, blocks: list[bytes]) -> None:
        """Write the response to an instruction whose effect was at edge t, one byte per cycle."""
        self.response_pending, self._next_blocks = True, blocks[1:]
        self._write(t + self._core.core_timing.answer + len(blocks[0]), blocks[0], source)

    def _write(self, stored: int, block: bytes, source: Source) -> None:
        self._storing = True
        self._at(stored - 1, self._enable_next)
        core, queue = self._core, self._core.context.queue
        if core.responses.serial and source is not Source.HOST:
            shown = stored - core.core_timing.result_lead
            queue.at(shown, Phase.STORE, lambda now: core.host.answer(now, source, block))
        queue.at(stored, Phase.STORE, lambda now: self._store(now, block, source))

    def _enable_next(self, t: int) -> None:
        """End the processing of an instruction, so that the next one can begin."""
        self._idle(t)
        # While a response must wait because another response is unread, reports may be stored before it.
        self.response_pending = self._core.responses.answer is None
        self._core.operation.motion.schedule_standstill_check(t)
        self.schedule(t)

    def _idle(self, t: int) -> None:
        self._busy, self._job, self._free = False, None, t + self._core.core_timing.arbitration

    def answer_reset(self, t: int) -> None:
        """Write the response to instruction FF, the first response after the reset."""
        self._busy = True
        self._answer(t, Source.HOST, [bytes([Source.HOST, 1, Code.RESET])])

    def _store(self, t: int, block: bytes, source: Source) -> None:
        if self._core.responses.serial:
            self._storing = self.response_pending = False
            self._answered = True
            if source is Source.HOST:
                self._core.host.answer(t, source, block)
            return
        if t < self._open_from:
            self._core.context.queue.at(
                self._open_from, Phase.STORE, lambda now: self._store(now, block, source)
            )
            return
        if not self._core.responses.post(t, ANSWER, [block], source):
            # The store holds a response to an event or an override, so this response waits, and the mailbox
            # stays closed (P312-RSP-20).
            self._waiting_block = block
            return
        self._waiting_block, self._storing, self.response_pending = None, False, bool(self._next_blocks)
        if source is Source.HOST and not self._next_blocks:
            self._at(t + self._core.core_timing.done, self._done)

    def _done(self, t: int) -> None:
        self._answered = True
        self._core.host.done(t)

    def was_read(self, t: int, report: Report) -> None:
        """Process the end of a read of a response; then store the waiting response or the next block."""
        if report.kind != ANSWER:
            return
        core_timing, queue, late = self._core.core_timing, self._core.context.queue, self._waiting_block
        self._open_from = t + core_timing.next_response
        if late is not None:
            queue.at(self._open_from, Phase.STORE, lambda now: self._store(now, late, Source.HOST))
        elif self._next_blocks:
            following = self._next_blocks.pop(0)
            self._at(t + 1, self._fetch)
            self._write(t + core_timing.reading(following), following, Source.HOST)

    def _fetch(self, t: int) -> None:
        """Begin to assemble the next block of a table read.

        If a triggered instruction is waiting at this edge, this is a multiple occurrence, which is processed
        first.
        """
        if waiting := self._first_waiting(t):
            self._multiple_occurrence(t, waiting)
        self._busy, self._source = True, Source.HOST
