"""The command that a name means: a line of PPMC-312 has its own ones."""

from __future__ import annotations

from typing import Any

import typer
from typer.core import TyperGroup

from .session import PartName

_UsageError: Any = typer.BadParameter.__bases__[0]
SHARED = ("ports", "plan")
"""Commands that open no board."""


class PartGroup(TyperGroup):
    """With --part ppmc312-serial the commands are those of `bus_app`."""

    def list_commands(self, ctx: Any) -> list[str]:
        """All, those that only a line has at the end."""
        own = super().list_commands(ctx)
        return own + [name for name in _line_commands(ctx) if name not in own]

    def get_command(self, ctx: Any, name: str) -> Any:
        """By name, for the part that was named."""
        own, line = super().get_command(ctx, name), _line_commands(ctx).get(name)
        first, second = (line, own) if _on_line(ctx) else (own, line)
        return first or second

    def resolve_command(self, ctx: Any, args: list[str]) -> Any:
        """The command of a command line. UsageError for one that belongs to other parts."""
        own, line = super().get_command(ctx, args[0]), _line_commands(ctx).get(args[0])
        if _on_line(ctx) and own is not None and line is None and args[0] not in SHARED:
            raise _UsageError(f"{args[0]}: not with --part {PartName.PPMC312_SERIAL.value}", ctx)
        if not _on_line(ctx) and own is None and line is not None:
            raise _UsageError(f"{args[0]}: only with --part {PartName.PPMC312_SERIAL.value}", ctx)
        return super().resolve_command(ctx, args)


def _on_line(ctx: Any) -> bool:
    return ctx.params.get("part") is PartName.PPMC312_SERIAL


def _line_commands(ctx: Any) -> dict[str, Any]:
    from .bus_app import bus

    group: Any = typer.main.get_command(bus)
    return {name: group.get_command(ctx, name) for name in group.list_commands(ctx)}
