"""What can be read of a PPMC-312 at any time, as dataclasses (P312-CMD-4D, -27, -47). Pure."""

from __future__ import annotations

from dataclasses import dataclass

from ...model.ppmc312.codes import State


@dataclass(frozen=True)
class Status:
    """Answer of 4D. raw: its condition byte.

    run_monitored: starts wait for RUN. interlock: its control runs. encoder_watched, position_watched: the
    monitors are on; encoder_outside, position_outside: what they see. overrides: registered ones, 0 to 8;
    override_events: the event inputs 1, 2 that some of them wait for. events: event buffers that hold
    something.
    """

    raw: int
    state: State
    run_monitored: bool
    interlock: bool
    encoder_watched: bool
    position_watched: bool
    end_monitored: bool
    encoder_outside: bool
    position_outside: bool
    overrides: int
    override_events: tuple[int, ...]
    events: tuple[int, ...]

    @classmethod
    def parse(cls, data: bytes) -> Status:
        """From operation, condition and buffer byte.

        >>> Status.parse(bytes.fromhex("00 02 00")).state.name
        'NOR'
        """
        operation, condition, buffers = data
        return cls(
            condition,
            State(condition),
            run_monitored=not operation & 0x80,
            interlock=bool(operation & 0x40),
            encoder_watched=bool(operation & 0x10),
            position_watched=bool(operation & 0x08),
            end_monitored=bool(operation & 0x04),
            encoder_outside=bool(operation & 0x02),
            position_outside=bool(operation & 0x01),
            overrides=buffers & 15,
            override_events=tuple(n for n, bit in ((1, 0x10), (2, 0x20)) if buffers & bit),
            events=tuple(n for n, bit in ((1, 0x40), (2, 0x80)) if buffers & bit),
        )

    @property
    def busy(self) -> bool:
        """A motion is under way, or held."""
        return self.state in (State.ACC, State.FIX, State.WRN)

    @property
    def in_alarm(self) -> bool:
        """State ABN."""
        return self.state is State.ABN


@dataclass(frozen=True)
class Inputs:
    """Switches and other inputs; True: active (pin low), run: True = starts are permitted."""

    limit_cw: bool
    limit_ccw: bool
    slow_cw: bool
    slow_ccw: bool
    origin: bool
    index: bool
    end: bool
    alarm: bool
    run: bool
    event1: bool
    event2: bool

    @classmethod
    def parse(cls, data: bytes) -> Inputs:
        """From the two bytes of 27; the part gives levels.

        >>> Inputs.parse(bytes.fromhex("FD E0")).active
        ['limit cw', 'run']
        """
        levels, other = data
        low = [not levels >> bit & 1 for bit in range(8)]
        return cls(
            limit_cw=low[1],
            limit_ccw=low[0],
            slow_cw=low[3],
            slow_ccw=low[2],
            origin=low[4],
            index=low[5],
            end=low[6],
            alarm=low[7],
            run=bool(other & 0x20),
            event1=not other & 0x40,
            event2=not other & 0x80,
        )

    @property
    def active(self) -> list[str]:
        """Names of the active ones."""
        return [name.replace("_", " ") for name, on in vars(self).items() if on]


@dataclass(frozen=True)
class EventBuffer:
    """Answer of 47. following: number of the instruction that the next event runs, 0 to 3. codes: of the
    instructions in it."""

    following: int
    codes: tuple[int, ...]

    @classmethod
    def parse(cls, data: bytes) -> EventBuffer:
        """From count, next and four codes."""
        return cls(data[1], tuple(data[2 : 2 + data[0]]))
