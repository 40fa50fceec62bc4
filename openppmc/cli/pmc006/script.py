"""User programs and script files of PMC006B4; in scripts, address=N selects a controller."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import Annotated, Any

import typer

from ...errors import PpmcError
from ...host.pmc006.part import Pmc006
from ...host.pmc006.settings import setting
from ...model.pmc006.program import BadImage, Program, assemble, disassemble
from ...textfile import NotTextError, read_text
from ..common import output
from ..common.script import Step, execute_steps, read_file, read_program
from ..common.script_parser import (
    Numbered,
    Reader,
    Values,
    check_no_more_words,
    first,
    number,
    read_speed,
    whole,
)
from .moves import Direction
from .session import Address, Session, end_line, opened, prefix

program = typer.Typer(
    help="pmc006: Load, run and read user programs.", no_args_is_help=True, add_completion=False
)
File = Annotated[Path, typer.Argument(metavar="FILE", help="text file, or image (.bin)")]
Out = Annotated[Path | None, typer.Option("--out", "-o", metavar="FILE", help="output file")]
Place = Annotated[int, typer.Option("--at", metavar="N", help="number of the instruction, 0 to 99")]


def _read(path: Path) -> Program:
    """Read a program from a file that contains its text or its image. Raise PpmcError."""
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
    """Write the text to a file; without a file, print it. Raise PpmcError."""
    try:
        if path is None:
            assert isinstance(text, str)
            output.print_line(text.rstrip("\n"))
        elif isinstance(text, bytes):
            path.write_bytes(text)
        else:
            path.write_text(text, encoding="utf-8")
    except OSError as error:
        raise PpmcError(f"{path}: {error.strerror}") from error


@program.command("assemble")
def assemble_file(file: File, out: Out = None) -> None:
    """Check a program; print its words or write its EEPROM image (803 bytes).

    No controller is needed.
    """
    made = _read(file)
    if out is not None:
        _write(out, made.image())
    else:
        for number, one in enumerate(made.used):
            first, second = one.words
            name = one.kind.name if one.kind is not None else "?"
            output.print_line(f"{number:3}  {first:08X} {second:08X}  {name}")
    output.note(f"{len(made.used)} instructions")


@program.command("disassemble")
def disassemble_file(file: File, out: Out = None) -> None:
    """Print or write the text of an image. No controller is needed."""
    _write(out, disassemble(_read(file), numbers=out is None))


@program.command()
def load(
    file: File,
    address: Address = None,
    burn: Annotated[bool, typer.Option("--burn", help="then burn it")] = False,
    run: Annotated[bool, typer.Option("--run", help="then run it")] = False,
) -> None:
    """Load a program into the buffer; it is lost at power-off unless it is burned."""
    made = _read(file)
    with opened() as session:
        for part in session.selected_axes(address):
            part.load_program(made, session.on_word_progress)
            session.guard.bar_off()
            output.print_line(f"{prefix(part)}{len(made.used)} instructions loaded and checked")
            if burn:
                part.burn_program()
                output.print_line(f"{prefix(part)}burned")
            if run:
                part.run_program()
                output.print_line(f"{prefix(part)}running")


@program.command("read")
def read_back(address: Address = None, out: Out = None) -> None:
    """Print the program in the buffer as text, or write an image (--out x.bin)."""
    with opened() as session:
        found = session.one(address).read_program(session.on_word_progress)
        session.guard.bar_off()
    if out is not None and out.suffix == ".bin":
        _write(out, found.image())
    else:
        _write(out, disassemble(found, numbers=out is None))


@program.command()
def burn(address: Address = None) -> None:
    """Store the program in the buffer for the next power-up.

    After `set offline=1` and `save` it then starts automatically.
    """
    with opened() as session:
        for part in session.selected_axes(address):
            part.burn_program()
            output.print_line(f"{prefix(part)}burned")


@program.command()
def run(address: Address = None, begin: Place = 0) -> None:
    """Start the program in the buffer."""
    with opened() as session:
        for part in session.selected_axes(address):
            part.run_program(begin)
            output.print_line(f"{prefix(part)}running")


@program.command()
def halt(address: Address = None) -> None:
    """Halt the program; a motion continues."""
    with opened() as session:
        for part in session.selected_axes(address):
            part.halt_program()
            output.print_line(f"{prefix(part)}halted")


@program.command("try")
def try_one(address: Address = None, begin: Place = 0) -> None:
    """Execute one instruction of the buffer."""
    with opened() as session:
        for part in session.selected_axes(address):
            part.try_instruction(begin)
            output.print_line(f"{prefix(part)}instruction {begin} executed")


@program.command()
def state(address: Address = None) -> None:
    """Print whether a program runs."""
    with opened() as session:
        for part in session.selected_axes(address):
            output.print_line(
                f"{prefix(part)}{'a program runs' if part.program_runs() else 'no program runs'}"
            )


MOST = (1 << 31) - 1
OF_CONTROLLERS = ("move", "goto", "jog", "home", "stop", "set", "out", "zero", "position")


def _way(words: list[str]) -> int:
    text = first(words, "direction (forward or backward)")
    if text not in ("forward", "backward"):
        raise ValueError(f"{text!r} is neither forward nor backward")
    return Direction(text).sign


def _speed(words: list[str]) -> int | None:
    pps = read_speed(words)
    if pps is not None and pps != int(pps):
        raise ValueError(f"speed {pps:g} is not a whole number")
    return None if pps is None else int(pps)


def _move(words: list[str]) -> Values:
    values = {"steps": whole(first(words, "number of steps"), "steps", -MOST, MOST), "speed": _speed(words)}
    check_no_more_words(words)
    return values


def _jog(words: list[str]) -> Values:
    values: Values = {"way": _way(words), "speed": _speed(words)}
    if first(words, "for SECONDS") != "for":
        raise ValueError("jog needs: jog forward|backward [speed=PPS] for SECONDS")
    values["seconds"] = number(first(words, "seconds"), "seconds", 0, 86_400)
    check_no_more_words(words)
    return values


def _home(words: list[str]) -> Values:
    values: Values = {"switch": 1, "way": Direction.BACKWARD.sign, "speed": 1000, "slow": 200, "off": 100}
    if words and words[0] in ("forward", "backward"):
        values["way"] = _way(words)
    for word in words:
        name, _, text = word.partition("=")
        if name not in ("switch", "speed", "slow", "off"):
            raise ValueError(f"{word!r} does not belong here")
        values[name] = whole(text, name, 1, 2 if name == "switch" else 1_000_000)
    return values


def _set(words: list[str]) -> Values:
    found = {}
    for word in words:
        name, equals, text = word.partition("=")
        if not equals:
            raise ValueError(f"{word!r} is not of the form name=value")
        found[setting(name).name] = whole(text, name, -MOST, MOST)
    if not found:
        raise ValueError("nothing to set")
    return {"settings": found}


def _out(words: list[str]) -> Values:
    levels = {}
    for word in words:
        name, _, level = word.lower().partition("=")
        if name not in {f"gpo{number}" for number in range(1, 6)} or level not in ("0", "1"):
            raise ValueError(f"{word!r}: not an output level; write gpo1=0 … gpo5=1")
        levels[int(name[3:])] = level == "1"
    if not levels:
        raise ValueError("output is missing; write gpo1=0 … gpo5=1")
    return {"levels": levels}


def _wait(words: list[str]) -> Values:
    values = {"seconds": number(first(words, "seconds"), "seconds", 0, 86_400)}
    check_no_more_words(words)
    return values


def _stop(words: list[str]) -> Values:
    now = bool(words) and words[0] == "now" and bool(words.pop(0))
    check_no_more_words(words)
    return {"now": now}


def _plain(words: list[str]) -> Values:
    check_no_more_words(words)
    return {}


READERS: dict[str, Reader] = {
    "move": _move,
    "goto": _move,
    "jog": _jog,
    "home": _home,
    "stop": _stop,
    "set": _set,
    "out": _out,
    "wait": _wait,
    "zero": _plain,
    "position": _plain,
}


class ScriptRunner:
    """Executes a script. Lines without address= apply to the first controller that replies."""

    def __init__(self, session: Session, name: str) -> None:
        self._session, self._name = session, name
        self._first: Pmc006 | None = None

    def run(self, steps: Iterable[Step]) -> None:
        """Execute all steps. Raise ScriptError with file:line if a controller rejects a step."""
        execute_steps(steps, self._name, self._session.guard, self._execute)

    def controller(self, address: int | None) -> Pmc006:
        """Return the controller with this address; for None, the first controller that replies."""
        if address is not None:
            return self._session.bus.axis(address)
        if self._first is None:
            self._first = self._session.selected_axes(None)[0]
        return self._first

    def _execute(self, step: Step) -> None:
        values, guard, bus = step.values, self._session.guard, self._session.bus
        if step.word == "wait":
            guard.pause(bus, values["seconds"])
            return
        part = self.controller(step.axis)
        if step.word in ("move", "goto"):
            (part.move if step.word == "move" else part.move_to)(
                values["steps"], values["speed"], guard.progress
            )
        elif step.word == "jog":
            motion = part.jog(values["way"], values["speed"])
            guard.pause(bus, values["seconds"])
            motion.wait() if motion.over else part.stop()
        elif step.word == "home":
            speeds = values["speed"], values["slow"]
            part.home(values["switch"], values["way"], *speeds, values["off"], guard.progress)
        elif step.word == "stop":
            for end in bus.stop([part.address], values["now"]):
                output.print_line(end_line(end))
        else:
            self._set(step, part)

    def _set(self, step: Step, part: Pmc006) -> None:
        """Execute a step that moves no motor."""
        values: dict[str, Any] = step.values
        if step.word == "set":
            for name, value in values["settings"].items():
                setattr(part, name, value)
        elif step.word == "out":
            for place, on in values["levels"].items():
                part.set_output(place, on)
        elif step.word == "zero":
            part.zero()
        else:
            output.print_line(f"{self._name}:{step.line}: {prefix(part)}position {part.position}")


def addresses(steps: Iterable[Step]) -> set[int | None]:
    """Return the addresses in a script; None represents the first controller that replies."""
    found: set[int | None] = set()
    for step in steps:
        found |= addresses(step.body)
        if step.word in OF_CONTROLLERS:
            found.add(step.axis)
    return found


def script(
    file: Annotated[Path, typer.Argument(help="text file, one command a line; - for standard input")],
) -> None:
    """Execute a file of commands."""
    name, text = read_file(file)
    steps = read_program(text, name, READERS, OF_CONTROLLERS, Numbered("address", 1, 255))
    used = addresses(steps)
    with opened() as session:
        named = sorted(one for one in used if one is not None)
        session.bus.check(named)
        player = ScriptRunner(session, name)
        for one in used:
            player.controller(one).alone = len(used) == 1
        player.run(steps)
        ends = [player.controller(one) for one in (*named, *([None] if None in used else []))]
        output.print_line("done" + "".join(f", {prefix(part)}position {part.position}" for part in ends))
