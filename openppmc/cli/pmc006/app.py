"""The commands for PMC006B4: `openppmc --part pmc006 …`."""

from __future__ import annotations

import typer

from ..common.boards import ports
from ..common.decode import decode_capture
from ..common.options import NUMBERS
from . import looks, moves
from .program import program
from .script import script

app = typer.Typer(add_completion=False)
app.command(context_settings=NUMBERS)(moves.move)
app.command()(moves.jog)
app.command(context_settings=NUMBERS)(moves.speed)
app.command()(moves.stop)
app.command()(moves.home)
app.add_typer(program, name="program")
app.command()(looks.scan)
app.command()(looks.info)
app.command()(looks.status)
app.command()(looks.monitor)
app.command()(script)
app.command("set")(looks.set_values)
app.command()(looks.io)
app.command()(looks.address)
app.command()(looks.save)
app.command("reset-flags")(looks.reset_flags)
app.command()(ports)  # shared: it opens no board
app.command("decode")(decode_capture)
