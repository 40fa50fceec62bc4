"""The command that a name means: parts on a line have commands of their own (column `commands`)."""

from __future__ import annotations

from typing import Any

import typer
from typer.core import TyperGroup

from ... import parts

_UsageError: Any = typer.BadParameter.__bases__[0]
LINES = tuple(row.name for row in parts.having("commands"))
"""Parts with commands of their own. They name the shared ones that they have, too: these open no board."""


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
            return _line_commands(part, ctx).get(name) or own
        lines = (_line_commands(part, ctx).get(name) for part in LINES)
        return own or next(filter(None, lines), None)

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


def _part(ctx: Any) -> str | None:
    """The part that was named, if it has commands of its own."""
    named = ctx.params.get("part")
    return next((part for part in LINES if part == named), None)


def _line_commands(part: str, ctx: Any) -> dict[str, Any]:
    group: Any = typer.main.get_command(parts.part(part).load("commands"))
    return {name: group.get_command(ctx, name) for name in group.list_commands(ctx)}
