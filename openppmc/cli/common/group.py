"""The command that a name means: parts on a line have commands of their own (column `commands`)."""

from __future__ import annotations

import textwrap
from functools import partial
from typing import Any

import typer
from typer.core import TyperGroup

from ... import parts
from . import output

_UsageError: Any = typer.BadParameter.__bases__[0]
LINES = tuple(row.name for row in parts.having("commands"))
"""Parts with commands of their own. They name the shared ones that they have, too: these open no board."""
NARROW = 80
"""Columns of a console below which help is text instead of tables, whose cells would lose words."""


class PartGroup(TyperGroup):
    """With --part the commands are those of that part, if it has commands of its own."""

    def list_commands(self, ctx: Any) -> list[str]:
        """All, those that only lines have at the end."""
        names = super().list_commands(ctx)
        for part in LINES:
            names += [name for name in _line_commands(part, ctx) if name not in names]
        return names

    def get_command(self, ctx: Any, name: str) -> Any:
        """By name, for the part that was named."""
        own, part = super().get_command(ctx, name), _part(ctx)
        if part is not None:
            return _fitted(_line_commands(part, ctx).get(name) or own)
        lines = (_line_commands(part, ctx).get(name) for part in LINES)
        return _fitted(own or next(filter(None, lines), None))

    def format_help(self, ctx: Any, formatter: Any) -> None:
        """Print the help."""
        if output.console.width < NARROW:
            _print_help(self, ctx)
        else:
            super().format_help(ctx, formatter)

    def resolve_command(self, ctx: Any, args: list[str]) -> Any:
        """The command of a command line. UsageError for one that belongs to other parts."""
        name, part = args[0], _part(ctx)
        own = super().get_command(ctx, name)
        have = [one for one in LINES if name in _line_commands(one, ctx)]
        if part is not None and part not in have and (own or have):
            raise _UsageError(f"{name}: not with --part {part}", ctx)
        if part is None and own is None and have:
            raise _UsageError(f"{name}: only with --part {' or '.join(have)}", ctx)
        return super().resolve_command(ctx, args)


def _fitted(command: Any) -> Any:
    """The same command, with help that fits the console."""
    if command is not None and output.console.width < NARROW:
        command.format_help = partial(_print_help, command)
        for one in getattr(command, "commands", {}).values():
            _fitted(one)
    return command


def _print_help(command: Any, ctx: Any, formatter: Any = None) -> None:
    """Print the help of a command as text: a name a line, its explanation indented below."""

    def wrap(text: str, indent: int = 0, more: int = 0) -> None:
        for line in text.split("\n\n"):
            width = max(output.console.width, indent + more + 10)
            first, rest = " " * indent, " " * (indent + more)
            output.say(
                textwrap.fill(
                    line, width, initial_indent=first, subsequent_indent=rest, break_on_hyphens=False
                )
            )

    wrap(f"Usage: {ctx.command_path} {' '.join(command.collect_usage_pieces(ctx))}", more=4)
    wrap(command.help or "")
    records = [record for one in command.get_params(ctx) if (record := one.get_help_record(ctx))]
    names = command.list_commands(ctx) if hasattr(command, "list_commands") else []
    commands = [(name, command.get_command(ctx, name).help or "") for name in names]
    for title, rows in (("Arguments and options:", records), ("Commands:", commands)):
        if rows:
            output.say(f"\n{title}")
        for name, text in rows:
            wrap(name, 2, 4)
            wrap(text.split("\n\n")[0], 6)


def _part(ctx: Any) -> str | None:
    """The part that was named, if it has commands of its own."""
    named = ctx.params.get("part")
    return next((part for part in LINES if part == named), None)


def _line_commands(part: str, ctx: Any) -> dict[str, Any]:
    group: Any = typer.main.get_command(parts.part(part).load("commands"))
    return {name: group.get_command(ctx, name) for name in group.list_commands(ctx)}
