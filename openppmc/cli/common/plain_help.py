"""Help on a narrow terminal: text, because the cells of tables would lose words."""

from __future__ import annotations

from functools import partial
from shutil import get_terminal_size
from typing import Any

from typer.core import TyperCommand, TyperGroup


def fitted(command: Any) -> Any:
    """The same command; its help has no tables."""
    command.format_help = partial(write, command)
    for one in getattr(command, "commands", {}).values():
        fitted(one)
    return command


def write(command: Any, ctx: Any, formatter: Any) -> None:
    """Write the help as text: explanations are indented below what they explain."""

    def write_rows(rows: Any, *_: Any) -> None:
        for name, text in rows:
            formatter.write_text(name)
            with formatter.indentation(), formatter.indentation():
                formatter.write_text(text)

    formatter.width, formatter.write_dl = get_terminal_size().columns, write_rows
    command.rich_markup_mode = None
    for one in getattr(command, "commands", {}).values():
        one.short_help = one.help  # whole sentences in the list of commands
    mode = TyperGroup if isinstance(command, TyperGroup) else TyperCommand
    mode.format_help(command, ctx, formatter)
    # click would write UTF-8 to an ASCII stdout.
    print(formatter.getvalue().rstrip("\n"), flush=True)
    formatter.buffer.clear()
