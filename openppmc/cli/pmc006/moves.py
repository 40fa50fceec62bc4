"""Commands that move motors with PMC006B4."""

from __future__ import annotations

from enum import Enum
from typing import Annotated

import typer

from ...host import BACKWARD, FORWARD, Pmc006
from ...host.axis import OnProgress
from ...host.pmc006.motion import Motion
from ..common import output
from ..common.line_session import ending_after
from ..common.options import check_seconds
from . import show
from .session import Address, Session, opened

Speed = Annotated[int | None, typer.Option(metavar="PPS", help="max_speed from now on, in steps/s")]


class Way(str, Enum):
    """Directions as users type them."""

    FORWARD = "forward"
    BACKWARD = "backward"

    @property
    def sign(self) -> int:
        """1 or -1."""
        return FORWARD if self is Way.FORWARD else BACKWARD


def move(
    steps: Annotated[int, typer.Argument(help="steps, forward positive; with --to a position")],
    address: Address = None,
    to: Annotated[bool, typer.Option("--to", help="move to this position")] = False,
    speed: Speed = None,
) -> None:
    """Move controllers so many steps, all at the same time."""
    with opened() as session:
        motions = []
        for part in session.chosen(address):
            session.guard.check()
            away = steps - part.position if to else steps
            if away:
                motions.append(part.start_move(away, speed))
            else:
                output.say(show.end_line(part.move(0)))
        _finish(session, motions, True)


def jog(
    direction: Annotated[Way, typer.Argument(help="where to")],
    address: Address = None,
    speed: Speed = None,
    seconds: Annotated[float | None, typer.Option(metavar="S", help="stop after so long")] = None,
) -> None:
    """Run until Ctrl-C, an EXT stop or a stall."""
    check_seconds(seconds)
    with opened() as session:
        parts = session.chosen(address)
        motions = [part.jog(direction.sign, speed) for part in parts]
        _finish(session, motions, False, ending_after(seconds, session.bus, session.guard, parts))


def _finish(session: Session, motions: list[Motion], judge: bool, look: OnProgress | None = None) -> None:
    """Wait for all, print where they stand, tell the first that ended early."""
    ends = session.bus.wait(motions, progress=look or session.guard.progress)
    session.guard.bar_off()
    for end in ends:
        output.say(show.end_line(end))
    for motion, end in zip(motions, ends, strict=True):
        if judge:
            end.check(motion.asked)


def speed(
    pps: Annotated[int, typer.Argument(help="steps/s, forward positive; 0 stops")], address: Address = None
) -> None:
    """Let motors run at this speed, and leave them running; `stop` stops them."""
    with opened() as session:
        for part in session.chosen(address):
            session.guard.check()
            if pps == 0 or not _goes(part, pps):
                if part.flags().busy:
                    part.stop()
                if pps:
                    part.jog(FORWARD if pps > 0 else BACKWARD, abs(pps))
            state = f"runs at {pps} steps/s" if pps else f"position {part.position}: stopped"
            output.say(part.who + state)


def _goes(part: Pmc006, pps: int) -> bool:
    """Change the speed of a motor that runs this way already."""
    modes = part.modes()
    if not modes.running or modes.forward != (pps > 0):
        return False
    part.change_speed(abs(pps))
    return True


def stop(
    address: Address = None,
    now: Annotated[bool, typer.Option("--now", help="at once, without a ramp")] = False,
) -> None:
    """Stop motors that were left running."""
    with opened() as session:
        ends = session.bus.stop([part.address for part in session.chosen(address)], now)
        for end in ends:
            output.say(show.end_line(end))
        if not ends:
            output.say("nothing was moving")


def home(
    address: Address = None,
    switch: Annotated[int, typer.Option(min=1, max=2, metavar="N", help="EXT1 or EXT2")] = 1,
    direction: Annotated[Way, typer.Option(help="towards the switch")] = Way.BACKWARD,
    speed: Annotated[int, typer.Option(metavar="PPS", help="until the switch stops the motor")] = 1000,
    slow: Annotated[int, typer.Option(metavar="PPS", help="for the second approach")] = 200,
    off: Annotated[int, typer.Option(metavar="STEPS", help="from the switch to position 0")] = 100,
) -> None:
    """Find a switch, move off it, and call that place position 0; one controller after the other."""
    with opened() as session:
        for part in session.chosen(address):
            part.home(switch, direction.sign, speed, slow, off, session.guard.progress)
            session.guard.bar_off()
            output.say(f"{part.who}position {part.position}: {off} steps from the edge of EXT{switch}")
