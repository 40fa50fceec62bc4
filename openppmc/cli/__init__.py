"""The command line `openppmc`.

Exit status: 0 done, 1 error, 2 wrong usage, 128 + n after signal n, 141 if the reader of stdout has ended.

`app` has the table of commands; a command is imported when it is called. `common` has the commands that parts
share, and knows no part. A part's folder has what differs: the commands of parts on a line, and what columns
of `openppmc.parts` name. view: what it shows and forecasts, and what only it can do; without one it is as a
PPMC-104. words: those of its own in script files. A part behind the bridge with the ramp and the registers of
the PPMC-104 needs nothing here.
"""

from __future__ import annotations

import os
import sys

from .. import streams
from ..errors import PpmcError


def main(arguments: list[str] | None = None) -> int:
    """Run a command line. Errors become one line on stderr; OPENPPMC_DEBUG=1 adds the traceback."""
    with streams.wrapped() as ended:
        try:
            # Here, so that a signal while these are read is one line, too.
            import typer

            from ..host.stopping import Signalled, arrived, handled, name_of, say
            from .app import app
        except KeyboardInterrupt:
            print("interrupted", file=sys.stderr)
            return 130

        def end(number: int, frame: object) -> None:
            arrived.append(number)
            raise Signalled(number)

        arrived.clear()
        try:
            with handled(end):
                result = app(arguments, prog_name="openppmc", standalone_mode=False)
                sys.stdout.flush()
            ended.status = result if isinstance(result, int) else 0
        except typer.Exit as done:
            ended.status = done.exit_code
        except Signalled as stop:
            say(name_of(stop.number))
            ended.status = 128 + stop.number
        except (KeyboardInterrupt, typer.Abort):
            print("interrupted", file=sys.stderr)
            ended.status = 130
        except Exception as error:
            if os.environ.get("OPENPPMC_DEBUG"):
                raise
            ended.status = _complain(error)
    return ended.status


def _complain(error: Exception) -> int:
    """Print one line; returns the exit status."""
    from typer import BadParameter

    usage_error = BadParameter.__bases__[0]  # UsageError of the click that typer brings along
    if isinstance(error, usage_error.__bases__[0]):
        context = getattr(error, "ctx", None)
        where = context.command_path if context is not None else "openppmc"
        text = " ".join(error.format_message().split())  # type: ignore[attr-defined]
        if not text:
            return 2  # the help was shown
        print(f"error: {text.rstrip('.')} (see {where} --help)", file=sys.stderr)
        return 2
    if isinstance(error, PpmcError):
        print(f"error: {error}", file=sys.stderr)
        return 1
    kind = type(error).__name__
    print(f"error: a fault of this program ({kind}: {error}): OPENPPMC_DEBUG=1 shows where", file=sys.stderr)
    return 1
