"""`openppmc --part pmc006 program …`: user programs of PMC006B4."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from ...errors import PpmcError
from ...model.pmc006.program import BadImage, Program, assemble, disassemble
from ...textfile import NotTextError, read_text
from ..common import output
from .session import Address, opened

program = typer.Typer(help="pmc006: user programs.", no_args_is_help=True, add_completion=False)
File = Annotated[Path, typer.Argument(metavar="FILE", help="a text, or an image (.bin)")]
Out = Annotated[Path | None, typer.Option("--out", "-o", metavar="FILE", help="into this file")]
Place = Annotated[int, typer.Option("--at", metavar="N", help="number of the instruction, 0 to 99")]


def _read(path: Path) -> Program:
    """A program from a text or an image. PpmcError."""
    try:
        if path.suffix == ".bin":
            return Program.from_image(path.read_bytes())
        return assemble(read_text(path), str(path))
    except BadImage as error:
        raise PpmcError(f"{path}: {error}") from None
    except NotTextError as error:
        raise PpmcError(f"{path}: not a text; images end in .bin ({error})") from None
    except OSError as error:
        raise PpmcError(f"{path}: {error.strerror}") from error


def _write(path: Path | None, text: str | bytes) -> None:
    """Into a file, a text without one to standard output. PpmcError."""
    try:
        if path is None:
            assert isinstance(text, str)
            output.say(text.rstrip("\n"))
        elif isinstance(text, bytes):
            path.write_bytes(text)
        else:
            path.write_text(text, encoding="utf-8")
    except OSError as error:
        raise PpmcError(f"{path}: {error.strerror}") from error


@program.command("assemble")
def assemble_file(file: File, out: Out = None) -> None:
    """Check a program, print its words, or write its EEPROM image (803 bytes). Needs no controller."""
    made = _read(file)
    if out is not None:
        _write(out, made.image())
    else:
        for number, one in enumerate(made.used):
            first, second = one.words
            name = one.kind.name if one.kind is not None else "?"
            output.say(f"{number:3}  {first:08X} {second:08X}  {name}")
    output.note(f"{len(made.used)} instructions")


@program.command("disassemble")
def disassemble_file(file: File, out: Out = None) -> None:
    """The text of an image. Needs no controller."""
    _write(out, disassemble(_read(file), numbers=out is None))


@program.command()
def load(
    file: File,
    address: Address = None,
    burn: Annotated[bool, typer.Option("--burn", help="and burn it")] = False,
    run: Annotated[bool, typer.Option("--run", help="and run it")] = False,
) -> None:
    """Load a program into the buffer; it is lost at power-off unless it is burned."""
    made = _read(file)
    with opened() as session:
        for part in session.chosen(address):
            part.load_program(made, session.counting)
            session.guard.bar_off()
            output.say(f"{part.who}{len(made.used)} instructions loaded and checked")
            if burn:
                part.burn_program()
                output.say(f"{part.who}burned")
            if run:
                part.run_program()
                output.say(f"{part.who}running")


@program.command("read")
def read_back(address: Address = None, out: Out = None) -> None:
    """The program in the buffer as a text, or as an image (--out x.bin)."""
    with opened() as session:
        found = session.one(address).read_program(session.counting)
        session.guard.bar_off()
    if out is not None and out.suffix == ".bin":
        _write(out, found.image())
    else:
        _write(out, disassemble(found, numbers=out is None))


@program.command()
def burn(address: Address = None) -> None:
    """Keep the buffer's program for the next power-up; `set offline=1` and `save` let it start by itself."""
    with opened() as session:
        for part in session.chosen(address):
            part.burn_program()
            output.say(f"{part.who}burned")


@program.command()
def run(address: Address = None, begin: Place = 0) -> None:
    """Start the program in the buffer."""
    with opened() as session:
        for part in session.chosen(address):
            part.run_program(begin)
            output.say(f"{part.who}running")


@program.command()
def halt(address: Address = None) -> None:
    """Halt the program; a motion goes on."""
    with opened() as session:
        for part in session.chosen(address):
            part.halt_program()
            output.say(f"{part.who}halted")


@program.command("try")
def try_one(address: Address = None, begin: Place = 0) -> None:
    """Carry out one instruction of the buffer."""
    with opened() as session:
        for part in session.chosen(address):
            part.try_instruction(begin)
            output.say(f"{part.who}instruction {begin} carried out")


@program.command()
def state(address: Address = None) -> None:
    """Whether a program runs."""
    with opened() as session:
        for part in session.chosen(address):
            output.say(f"{part.who}{'a program runs' if part.program_runs() else 'no program runs'}")
