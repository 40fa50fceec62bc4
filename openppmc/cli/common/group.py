"""The command group: the table of the commands, and their help texts.

A command is imported when it is called. On a narrow terminal, the help is plain text, because the cells of a
table would cut words off.
"""

from __future__ import annotations

import sys
from dataclasses import dataclass
from functools import partial
from importlib import import_module
from shutil import get_terminal_size
from types import ModuleType
from typing import Any, ClassVar

import typer
from typer.core import TyperCommand, TyperGroup

from ...streams import is_narrow


def fitted(command: Any) -> Any:
    """Make a command print its help without tables; return the command."""
    command.format_help = partial(write, command)
    for one in getattr(command, "commands", {}).values():
        fitted(one)
    return command


def write(command: Any, ctx: Any, formatter: Any) -> None:
    """Write the help as text: each explanation is indented below its command or option."""

    def write_rows(rows: Any, *_: Any) -> None:
        for name, text in rows:
            formatter.write_text(name)
            with formatter.indentation(), formatter.indentation():
                formatter.write_text(text)

    formatter.width, formatter.write_dl = get_terminal_size().columns, write_rows
    command.rich_markup_mode = None
    for one in getattr(command, "commands", {}).values():
        one.short_help = one.help  # the list of commands contains the complete sentences
    mode = TyperGroup if isinstance(command, TyperGroup) else TyperCommand
    mode.format_help(command, ctx, formatter)
    # click would write UTF-8 to an ASCII stdout.
    print(formatter.getvalue().rstrip("\n"), flush=True)
    formatter.buffer.clear()


_UsageError: Any = typer.BadParameter.__bases__[0]
BRIDGE = ""
"""Represents all parts that are accessed through the UART bridge. They have the same commands."""


@dataclass(frozen=True)
class Command:
    """Row of the table.

    Attributes:
        place: "module:function" below `openppmc.cli`; a Typer is a group of commands.
        help: docstring of the function for `--help`; only in the first row of a name.
        parts: the parts that have this command.
        numbers: True if arguments such as -200 are numbers and not options.
    """

    name: str
    place: str
    help: str = ""
    parts: tuple[str, ...] = (BRIDGE,)
    numbers: bool = False

    def load(self) -> Any:
        """Import and return the function or the Typer."""
        module, _, name = self.place.partition(":")
        return getattr(import_module(f"openppmc.cli.{module}"), name)

    def build(self) -> Any:
        """Return the command in the form that the parser uses."""
        group, found = typer.Typer(add_completion=False), self.load()
        if isinstance(found, typer.Typer):
            group.add_typer(found, name=self.name)
        else:
            group.command(self.name, context_settings={"ignore_unknown_options": self.numbers})(found)
        command = typer.main.get_group(group).commands[self.name]
        if not is_narrow():
            return command
        pass

        return fitted(command)


class PartGroup(TyperGroup):
    """Commands of all parts.

    Attributes:
        rows: rows of the table. If several rows have the same name, a row for BRIDGE is the first of them.
    """

    rows: ClassVar[tuple[Command, ...]] = ()

    def __init__(self, **settings: Any) -> None:
        super().__init__(**settings)
        # These commands are only for help and suggestions; `resolve_command` builds the command that is
        # called.
        self.commands = {
            row.name: TyperCommand(row.name, help=row.help, rich_markup_mode="rich")
            for row in reversed(self.rows)
        }

    def list_commands(self, ctx: Any) -> list[str]:
        """Return the names in the order of the rows."""
        return list(dict.fromkeys(row.name for row in self.rows))

    def resolve_command(self, ctx: Any, args: list[str]) -> Any:
        """Return the command of a command line. Raise UsageError if the part does not have this command."""
        name, _, rest = super().resolve_command(ctx, args)
        rows = [row for row in self.rows if row.name == name]
        others = list(dict.fromkeys(part for row in rows for part in row.parts))
        part = next(
            (part for row in self.rows for part in row.parts if part == ctx.params.get("part")), BRIDGE
        )
        if part in others:
            return name, next(row for row in rows if part in row.parts).build(), rest
        if part != BRIDGE:
            raise _UsageError(f"{name}: not with --part {part}", ctx)
        raise _UsageError(f"{name}: only with --part {' or '.join(others)}", ctx)

    def format_help(self, ctx: Any, formatter: Any) -> None:
        """Write the help of `openppmc` itself."""
        _import_formatter()
        if is_narrow():
            pass

            write(self, ctx, formatter)
        else:
            super().format_help(ctx, formatter)


def _import_formatter() -> None:
    """Import the formatter of typer without two modules of rich.

    The import of the modules for Markdown and for coloured tracebacks would take 0.1 s; they are not used
    here.
    """
    unused = {"rich.markdown": "Markdown", "rich.traceback": "Traceback"}
    missing = [name for name in unused if name not in sys.modules and "typer.rich_utils" not in sys.modules]
    for name in missing:
        sys.modules[name] = ModuleType(name)
        setattr(sys.modules[name], unused[name], object)
    try:
        import_module("typer.rich_utils")
    finally:
        for name in missing:
            del sys.modules[name]
