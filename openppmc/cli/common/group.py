"""The command that a name means: parts on a line have their own ones."""

from __future__ import annotations

from typing import Any

import typer
from typer.core import TyperGroup

from .session import PartName

_UsageError: Any = typer.BadParameter.__bases__[0]
LINES = {PartName.PPMC312_SERIAL: ("ports", "plan"), PartName.PMC006: ("ports",)}
"""Parts with commands of their own, and the others that they share: these open no board."""


class PartGroup(TyperGroup):
    """With --part ppmc312-serial the commands are those of `bus_app`, with pmc006 those of `app006`."""

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
        if part is not None and part not in have and name not in LINES[part] and (own or have):
            raise _UsageError(f"{name}: not with --part {part.value}", ctx)
        if part is None and own is None and have:
            words = " or ".join(one.value for one in have)
            raise _UsageError(f"{name}: only with --part {words}", ctx)
        return super().resolve_command(ctx, args)


def _part(ctx: Any) -> PartName | None:
    """The part that was named, if it has commands of its own."""
    part = ctx.params.get("part")
    return part if part in LINES else None


def _line_commands(part: PartName, ctx: Any) -> dict[str, Any]:
    if part is PartName.PMC006:
        from ..pmc006.app import app006 as app
    else:
        from ..ppmc312.line.app import bus as app
    group: Any = typer.main.get_command(app)
    return {name: group.get_command(ctx, name) for name in group.list_commands(ctx)}
