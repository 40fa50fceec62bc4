"""Script files: one command a line. Reading only; `player` carries them out."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import typer

from ...host import PpmcError
from ...textfile import NotTextError, read_text
from .reading import AXES, READERS, Numbered, Reader, none_left, read_axis, read_repeat
from .words import own_words

DEEPEST = 20


class ScriptError(PpmcError):
    """A line that cannot be understood or carried out; the message begins with file:line."""


@dataclass(frozen=True)
class Step:
    """One line. `body` belongs to repeat. axis: as written, None if it names none."""

    line: int
    word: str
    values: dict[str, Any]
    body: tuple[Step, ...] = ()
    axis: int | None = None


OF_AXES = ("init", "move", "goto", "step", "jog", "home", "stop", "zero", "off", "position")
"""Commands that may end with axis=N; without it they are about axis 1."""
OF_ALL_AXES = ("stop", "off", "position")
"""Those that are about all axes without it."""


def read_file(file: Path) -> tuple[str, str]:
    """Name and text of a script file; - is standard input. PpmcError."""
    name = "stdin" if str(file) == "-" else str(file)
    try:
        text = typer.get_text_stream("stdin").read() if name == "stdin" else read_text(file)
    except OSError as error:
        raise PpmcError(f"{file}: cannot be read ({error.strerror})") from error
    except NotTextError as error:
        raise PpmcError(f"{file}: not a text file in UTF-8 or UTF-16: {error}") from error
    except UnicodeDecodeError as error:
        raise PpmcError(f"{file}: not a text file in UTF-8") from error
    return name, text.removeprefix("\ufeff")


def read_program(
    text: str,
    name: str,
    readers: Mapping[str, Reader] | None = None,
    of_axes: Collection[str] = OF_AXES,
    numbered: Numbered = AXES,
) -> tuple[Step, ...]:
    """All steps of a script file. readers: its words, those of parts behind the bridge if there are none;
    of_axes: those that may end with axis=N, or as that is `numbered`. ScriptError for the first bad line."""
    if readers is None:
        readers = READERS | {word: own.read for word, own in own_words().items()}
    stack: list[tuple[int, dict[str, Any], list[Step]]] = [(0, {}, [])]
    for number, line in enumerate(text.splitlines(), 1):
        words = line.split("#", 1)[0].split()
        if not words:
            continue
        word, rest = words[0].lower(), words[1:]
        try:
            if word == "end":
                none_left(rest)
                if len(stack) == 1:
                    raise ValueError("end without repeat")
                start, values, body = stack.pop()
                if not body:
                    raise ValueError("nothing to repeat")
                stack[-1][2].append(Step(start, "repeat", values, tuple(body)))
            elif word == "repeat":
                if len(stack) > DEEPEST:
                    raise ValueError(f"repeat deeper than {DEEPEST}")
                stack.append((number, read_repeat(rest), []))
            elif word in readers:
                axis = read_axis(rest, numbered) if word in of_axes else None
                step = Step(number, word, readers[word](rest), axis=axis)
                if axis is not None and step.values.get("second") is not None:
                    raise ValueError("two numbers are for both axes: leave axis= out")
                stack[-1][2].append(step)
            else:
                known = ", ".join(sorted([*readers, "repeat", "end"]))
                raise ValueError(f"unknown command {words[0]!r} (there are {known})")
        except (ValueError, PpmcError) as error:
            raise ScriptError(f"{name}:{number}: {error}") from error
    if len(stack) > 1:
        raise ScriptError(f"{name}:{stack[-1][0]}: repeat without end")
    if not stack[0][2]:
        raise ScriptError(f"{name}:1: there is no command in this file")
    return tuple(stack[0][2])
