"""Run a virtual board: `python -m openppmc.sim [TEXT]` or `make board SIM=TEXT`."""

from __future__ import annotations

import shutil
import signal
import sys
import time
from pathlib import Path

from ..streams import guarded
from .common.board import AxisStatus, SimBoard, Status, start
from .common.build import SimError
from .common.lines import SimLine, line_kind, line_parts, part_of, start_line
from .common.machine import machine_kind
from .common.spec import SpecError, known_words

USAGE = (
    f"usage: python -m openppmc.sim [word=value,…,link=PATH]\nwords: {known_words()}; docs/virtual_board.md\n"
    + "\n".join(f"part={part}: {line_kind(part).known}" for part in line_parts())
)
LIVE, PLAIN = 0.2, 30.0
SWITCHES = (("L1", "l1"), ("L2", "l2"), ("L3", "l3"), ("L4", "l4"), ("CNP", "cnp"))


def split_link(text: str) -> tuple[str, Path | None]:
    """Return the text without `link=PATH`, and the path.

    Raise SpecError if the path is empty, or if a file with this name exists that is not a link.
    """
    words = text.split(",")
    links = [word.partition("=")[2].strip() for word in words if word.strip().startswith("link=")]
    rest = ",".join(word for word in words if not word.strip().startswith("link="))
    if links and (not links[-1] or (Path(links[-1]).exists() and not Path(links[-1]).is_symlink())):
        raise SpecError(f"link={links[-1]}: a file with this name exists; use another name")
    return rest, Path(links[-1]) if links else None


def line(now: Status, alarm: str) -> str:
    """Return the status as one line.

    Args:
        alarm: name of the alarm switch of the part.
    """
    host = f"{now.rate} baud" if now.open else "no host"
    pace = "asleep" if now.asleep else f"{now.factor:.2f} x real time"
    axes = "  ".join(motor(axis, alarm) for axis in (now, now.second) if axis is not None)
    return f"{now.seconds:9.1f} s  {pace:16}  {axes}{'  INT' if now.interrupt else ''}  [{host}]"


def motor(axis: AxisStatus, alarm: str) -> str:
    """Return position, state and switches of an axis as text."""
    switches = " ".join(name for name, field in (*SWITCHES, (alarm, "alm")) if getattr(axis, field)) or "none"
    return f"position {axis.position:8}  {'at rest' if axis.hold else 'moving':7}  active: {switches}"


def show(board: SimBoard | SimLine) -> None:
    """Print the status until the board ends.

    On a terminal, one line is updated; any other output receives a line every PLAIN seconds.
    """
    live = sys.stdout.isatty()
    while True:
        text = (
            board.status().text()
            if isinstance(board, SimLine)
            else line(board.status(), machine_kind(board.spec.part).alarm)
        )
        if live:
            columns = shutil.get_terminal_size().columns
            print(f"\r{text[: columns - 1]:{columns - 1}}", end="", flush=True)
        else:
            print(text, flush=True)
        time.sleep(LIVE if live else PLAIN)


def main(arguments: list[str]) -> int:
    """Run a board until Ctrl-C, and return the exit status, which is 1 after an error."""
    if any(word in ("-h", "--help") for word in arguments):
        print(USAGE)
        return 0
    link: Path | None = None
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        text, link = split_link(",".join(arguments))
        part = part_of(text)
        with start(text) if part is None else start_line(text) as board:
            name = board.port
            if link is not None:
                link.unlink(missing_ok=True)
                link.symlink_to(board.port)
                name = str(link)
            try_this = f"--port {name} info" if part is None else f"--part {part} --port {name} scan"
            print(f"virtual board at {name}; try: openppmc {try_this}")
            print("Ctrl-C ends it", flush=True)
            show(board)
    except (SimError, SpecError, OSError) as error:
        print(f"error: {error}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print()
    finally:
        if link is not None and link.is_symlink():
            link.unlink()
    return 0


if __name__ == "__main__":
    sys.exit(guarded(lambda: main(sys.argv[1:])))
