"""Command line `openppmc`.

Exit status: 0 = success, 1 = error, 2 = wrong usage, 128 + n = signal n, 141 = the reader of stdout has
ended.

`app` contains the table of commands; a command is imported when it is called. `common` contains the commands
that the parts share, and depends on no part. The folder of a part contains its commands if it is on a serial
line, and the objects for two columns of `openppmc.parts`. `presenter` defines the output, the forecasts and
the additional functions of a part; a part without this object uses the presenter of the PPMC-104.
`script_commands` defines additional commands of the part in script files. This package needs no code for a
part that is accessed through the UART bridge and has the ramp and the registers of the PPMC-104.
"""

from __future__ import annotations

import os
import sys

from .. import streams
from ..errors import PpmcError


def main(arguments: list[str] | None = None) -> int:
    """Run a command line and return its exit status.

    An error prints one line on stderr. With OPENPPMC_DEBUG=1, the exception is raised instead.
    """
    with streams.wrapped() as ended:
        try:
            # Import here, so that the program prints only one line also if a signal arrives during the
            # import.
            import typer

            from ..host.stopping import Signalled, arrived, handled, name_of, print_line
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
            print_line(name_of(stop.number))
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
    """Print an error as one line and return the exit status."""
    from typer import BadParameter

    usage_error = BadParameter.__bases__[0]  # UsageError of the copy of click that typer uses
    if isinstance(error, usage_error.__bases__[0]):
        context = getattr(error, "ctx", None)
        where = context.command_path if context is not None else "openppmc"
        text = " ".join(error.format_message().split())  # type: ignore[attr-defined]
        if not text:
            return 2  # the help has been printed
        print(f"error: {text.rstrip('.')} (see {where} --help)", file=sys.stderr)
        return 2
    if isinstance(error, PpmcError):
        print(f"error: {error}", file=sys.stderr)
        return 1
    kind = type(error).__name__
    print(
        f"error: fault of this program ({kind}: {error}); set OPENPPMC_DEBUG=1 to see where", file=sys.stderr
    )
    return 1
