"""Print the shell text of a make target: ``python -m scripts.run GOAL GOAL … NAME=VALUE …``.

The text belongs to the first goal; the other words are all goals and variables of this `make`. If a word is
wrong, only the first fault is printed, as a line that begins with "error:". The module imports only the
standard library.
"""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from collections.abc import Iterable, Mapping
from difflib import get_close_matches
from importlib.util import find_spec
from shlex import quote

from scripts import env
from scripts.targets import OLD, OLD_VARIABLES, ROOT, TARGETS, VARIABLES, fault

MARK = re.compile(r"\{([A-Z_]+)(/or)?(?::([^}]*))?\}")
OF_MAKE = ("MAKEFLAGS", "MAKEOVERRIDES", "MAKELEVEL")


class WrongError(Exception):
    """A goal or a variable is invalid, or this computer lacks something that is required.

    The message is one line that states what is wrong and what to do.
    """


def nearest(word: str, known: Iterable[str]) -> str:
    """Return a hint with the most similar known name, or an empty text."""
    near = get_close_matches(word, list(known), 1, 0.7)
    return f"; nearest: {OLD.get(near[0], near[0])}" if near else ""


class Goal:
    """A goal with its row of the table and the values of its variables.

    If the goal does not exist, WrongError is raised. Variables of the environment are also used, if the
    target has them.

    Args:
        given: variables of the command line.
    """

    def __init__(self, word: str, given: Mapping[str, str]) -> None:
        if word not in TARGETS and word not in OLD:
            near = nearest(word, [*TARGETS, *OLD])
            raise WrongError(f"{word}: there is no such target{near} (`make help' lists all)")
        self.name, self.old = OLD.get(word, word), word in OLD
        self.switches: set[str] = set()
        for other in TARGETS:
            first, _, switch = other.partition(" ")
            name, _, value = switch.partition("=")
            if first == word and switch:
                self.switches.add(name)
                if given.get(name) and value in ("", given[name]):
                    self.name = other
        self.target = TARGETS[self.name]
        self.known = {"PYTHON", *self.switches, *self.target.defaults}
        self.given = {name: given.get(name, os.environ.get(name) or None) for name in self.known}
        self.old_variables = []
        for old, new in OLD_VARIABLES.items():
            old_value = given[old] if old in given else os.environ.get(old) or None
            if new in self.known and self.given[new] is None and old_value is not None:
                self.given[new] = old_value
                self.old_variables.append(old)

    def check(self) -> None:
        """Raise WrongError for the first wrong value."""
        given = {name: value for name, value in self.given.items() if value is not None}
        values = {**self.target.defaults, **given}
        for name in VARIABLES:
            if name in given and (text := fault(name, values, self.name)):
                raise WrongError(f"{name}={values[name]}: {text}")

    def command(self) -> str:
        """Return the shell text of the goal."""

        def optional(part: re.Match[str]) -> str:
            marks = MARK.findall(part[0])
            flags = [name for name, *_ in marks if VARIABLES[name].flag]
            if not all(self.given[name] == "1" if name in flags else self.given[name] for name, *_ in marks):
                return ""
            return MARK.sub("", part[1]) if flags else part[1]

        def value(mark: re.Match[str]) -> str:
            name, alternatives, default = mark.groups()
            text = self.given[name] or ""
            return quote(text.replace(",", " or ") if alternatives else text) if text else default or "''"

        text = re.sub(r"\[([^][]*\{[A-Z][^][]*)\]", optional, self.target.command)
        text = MARK.sub(value, " ".join(text.split()).replace("{python}", quote(sys.executable)))
        if todo := env.missing(self.target.groups):
            text = f"{quote(sys.executable)} -m scripts.env {' '.join(todo)} || exit; {text}"
        for old in self.old_variables:
            note = f"note: use {OLD_VARIABLES[old]} for {old}; the old name is removed in version 1.1.0"
            text = f"echo {quote(note)} >&2; {text}"
        if self.old:
            note = f"note: use `make {self.name}'; the old name is removed in version 1.1.0"
            text = f"echo {quote(note)} >&2; {text}"
        return text


def check_machine(python: str | None) -> None:
    """Raise WrongError if the environment cannot be made in this folder with these tools and this Python."""
    # The path must not contain these characters, which end a name in PATH or in the scripts of pip.
    if re.search(r"[:\"$`\\\x00-\x1f\x7f]", str(ROOT)):
        shown = re.sub(r"[\x00-\x1f\x7f]", "?", str(ROOT))
        raise WrongError(f"the project's folder must not have : \" $ ` or \\ in its path: {shown}")
    for tool in ("git", "g++", "perl"):
        if shutil.which(tool) is None:
            text = f"install it with the package manager (Debian: apt install {tool})"
            raise WrongError(f"{tool} is not installed: {text}")
    if sys.prefix == sys.base_prefix and not (find_spec("venv") and find_spec("ensurepip")):
        text = "install it (Debian: apt install python3-venv)"
        raise WrongError(f"{sys.executable} has no venv module: {text}")
    if python and sys.prefix != sys.base_prefix:
        script = "import sys; print(*sys.version_info[:2], sep='.')"
        try:
            version = subprocess.run(
                [python, "-c", script], capture_output=True, text=True, check=False
            ).stdout
        except OSError:
            raise WrongError(f"PYTHON={python}: there is no such program") from None
        there = f"{sys.version_info.major}.{sys.version_info.minor}"
        if version.strip() != there:
            raise WrongError(f"PYTHON={python}: .venv has Python {there}; `make distclean' removes it")


def plan(words: list[str]) -> str:
    """Return the shell text of the first word, a goal; raise WrongError for a fault in any word."""
    given = dict(word.split("=", 1) for word in words if "=" in word)
    goals = [Goal(word, given) for word in words if "=" not in word]
    known = set().union(*(goal.known for goal in goals))
    for name in given:
        if OLD_VARIABLES.get(name, name) not in known and name not in OF_MAKE:
            near, has = nearest(name, known), " ".join(sorted(known))
            raise WrongError(f"{name}: `make {goals[0].name}' has no such variable{near} (it has: {has})")
    for goal in goals:
        goal.check()
    if goals[0].target.groups:
        check_machine(given.get("PYTHON"))
    return goals[0].command()


if __name__ == "__main__":
    try:
        print(plan(sys.argv[1:]))
    except WrongError as error:
        print("error:", error)
