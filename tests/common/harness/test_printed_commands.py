"""Every command on a page is accepted: by make, by the parser of `openppmc`, or by that of a script."""

from __future__ import annotations

import argparse
import importlib
import importlib.util
import os
import re
import shlex
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
import typer

from cocotb_tests.harness.paths import ROOT
from openppmc.cli.app import app

PAGES = [
    path
    for below in (".", "docs", "drivers", "examples", "openppmc")
    for path in sorted((ROOT / below).glob("*.md" if below == "." else "**/*.md"))
    # The changelog and the decision records contain commands of earlier versions.
    if path.name not in ("CHANGELOG.md", "decisions.md") and path.parent.name != "decisions"
]
COMMAND = re.compile(
    r"(?:\$ )?(?:[A-Z_]+=\S+ )*(?P<what>make|(?:\.venv/bin/)?openppmc|(?:\.venv/bin/)?python3? -m)"
    r"(?= |$)(?P<rest>.*)"
)
PLACEHOLDERS = {
    "make": {
        "…": "",
        "BOARD=…": "BOARD=icebreaker",
        "PART=…": "PART=ppmc104",
        "RECORD=…": "RECORD=12",
        "COUNT=…": "COUNT=1",
        "COUNT=n": "COUNT=1",
        "SEED=n": "SEED=1",
        "SEED=first": "SEED=1",
        "SEED=<seed>": "SEED=1",
        "T=<name>": "T=name",
        "TOP=…": "TOP=ppmc104",
        "PARAMS=…": "PARAMS=CLK_HZ=50000000",
        "PARAMS=CLK_HZ=…": "PARAMS=CLK_HZ=50000000",
    },
    "openppmc": {},
    "python -m": {"[WORD…]": "word"},
}
"""Words in a command that the reader must replace -> a valid replacement."""
SYNTAX = ("openppmc COMMAND --help", "openppmc [--port PORT]")
"""Beginnings of texts that describe the syntax of commands."""


def _blocks(text: str) -> Iterator[tuple[str, bool]]:
    """Yield the lines of code blocks (with True) and the pieces of inline code (with False) of a page."""
    fenced = False
    for line in text.replace("\\\n", " ").splitlines():
        if line.lstrip().startswith("```"):
            fenced = not fenced
        elif fenced or line.startswith("    "):
            yield line.strip(), True
        else:
            yield from ((piece, False) for piece in re.findall(r"`([^`]+)`", line))


def printed() -> dict[tuple[str, str, bool], str]:
    """Return (kind of command, arguments, True if it is a whole line) -> the first page that contains the
    command.
    """
    found: dict[tuple[str, str, bool], str] = {}
    for page in PAGES:
        for text, whole in _blocks(page.read_text(encoding="utf-8")):
            match = COMMAND.fullmatch(re.sub(r"(^|\s+)#(\s.*|$)", "", text))
            if match and not text.startswith(SYNTAX):
                what = match["what"].removeprefix(".venv/bin/").replace("python3", "python")
                rest = re.split(r"\s(?:&&|\||>|;)(?=\s|$)", match["rest"].strip())[0]
                found.setdefault((what, rest.strip(), whole), page.relative_to(ROOT).as_posix())
    return found


PRINTED = printed()


def of(what: str) -> list[Any]:
    """Return the arguments of each command of a kind as words, and whether the command is a whole line."""
    known = PLACEHOLDERS[what]
    rows = {}
    for kind, rest, whole in PRINTED:
        if kind == what:
            words = tuple(filter(None, (known.get(word, word) for word in shlex.split(rest))))
            rows[words, whole] = (PRINTED[kind, rest, whole], f"{what} {rest}")
    return [
        pytest.param(list(words), whole, page, id=f"{page}: {text}")
        for (words, whole), (page, text) in rows.items()
    ]


def test_the_pages_have_commands() -> None:
    """The search for commands on the pages finds enough of them for the tests below."""
    assert [len(of(what)) > least for what, least in (("make", 60), ("openppmc", 60), ("python -m", 5))] == [
        True
    ] * 3
    assert ("make", "bitstream BOARD=ulx3s-25f PART=bank HOST=spi", True) in PRINTED


@pytest.mark.parametrize("words, whole, page", of("make"))
def test_make(words: list[str], whole: bool, page: str) -> None:
    """`make -n` accepts the command; a command of a cocotb makefile has only variables of the example's
    Makefile.
    """
    own = (ROOT / page).parent / "Makefile"
    if own.parent != ROOT and own.exists() and all("=" in word for word in words):
        assert all(word.split("=")[0] in own.read_text(encoding="utf-8") for word in words)
        return
    # MAKEFLAGS of a surrounding `make test T=…` would pass the variables of that make on.
    env = {name: value for name, value in os.environ.items() if name != "MAKEFLAGS"}
    done = subprocess.run(
        ["make", "-n", *words], cwd=ROOT, env=env, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr


def parse(command: Any, words: list[str], parent: Any = None, name: str = "openppmc") -> None:
    """Parse a command line without calling the command; errors of the parser are raised."""
    context = command.make_context(name, list(words), parent=parent)
    if hasattr(command, "commands"):
        rest = [*getattr(context, "_protected_args", getattr(context, "protected_args", [])), *context.args]
        if not rest:
            raise typer.BadParameter("Missing command", context)
        name, below, rest = command.resolve_command(context, rest)
        parse(below, rest, context, name)


@pytest.mark.parametrize("words, whole, page", of("openppmc"))
def test_openppmc(words: list[str], whole: bool, page: str, capsys: pytest.CaptureFixture[str]) -> None:
    """The parser accepts options and arguments; a command within a sentence may lack its arguments."""
    usage_error: Any = typer.BadParameter.__bases__[0]
    try:
        parse(typer.main.get_command(app), words)
    except usage_error as error:
        missing = type(error).__name__ in ("MissingParameter", "NoArgsIsHelpError")
        alone = not whole and (missing or "Missing command" in str(error))
        assert alone, error.format_message()


class AcceptedError(Exception):
    """Raised when the parser has accepted the arguments."""


@pytest.mark.parametrize("words, whole, page", of("python -m"))
def test_python(words: list[str], whole: bool, page: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """The module of each printed command exists, and its parser accepts the arguments."""
    module, *arguments = words
    spec = importlib.util.find_spec(module)
    assert spec is not None, module
    if spec.submodule_search_locations is not None:
        spec = importlib.util.find_spec(f"{module}.__main__")
        assert spec is not None, f"{module} is a package without __main__"
    assert spec.origin is not None
    if "ArgumentParser" not in Path(spec.origin).read_text(encoding="utf-8"):
        return
    real = argparse.ArgumentParser.parse_args

    def accept(parser: argparse.ArgumentParser, *given: Any) -> Any:
        real(parser, *given)
        raise AcceptedError

    monkeypatch.setattr(argparse.ArgumentParser, "parse_args", accept)
    monkeypatch.setattr(sys, "argv", [module, *arguments])
    with pytest.raises(AcceptedError):
        importlib.import_module(spec.name).main()


HELPS = re.compile(r'ArgumentParser|run\(main, "|generated\.parser')
WITHOUT_HELP = {
    "scripts/env.py": "prints one line, and needs only the standard library",
    "scripts/measure/mains.py": "old name of sim_mains, whose parser it uses",
    "scripts/measure/prove/model.py": "a proof starts it, and a change of the file invalidates all proofs",
    "scripts/measure/replay.py": "prints one line",
    "scripts/run.py": "prints one line for `make`",
    "scripts/targets.py": "prints the targets",
}


def test_help_of_scripts() -> None:
    """Each script that can be started has a parser, so --help prints its usage; for each exception, this file
    states a reason.
    """
    found = {
        str(path.relative_to(ROOT)): text
        for path in sorted((ROOT / "scripts").rglob("*.py"))
        if 'if __name__ == "__main__":' in (text := path.read_text(encoding="utf-8"))
    }
    assert len(found) > 30
    assert {name for name, text in found.items() if not HELPS.search(text)} == set(WITHOUT_HELP)


def test_arguments_of_a_script() -> None:
    """A script without a parser of its own prints its usage, and rejects other arguments in one line."""
    for module, words, code, text in (
        ("scripts.measure.bench.captures", ["--help"], 0, "[-h] [CAPTURE]"),
        ("scripts.release.arduino", ["more"], 2, "unrecognized arguments: more"),
        ("scripts.env", ["--help"], 2, "error: --help: no group"),
    ):
        done = subprocess.run(
            [sys.executable, "-m", module, *words], cwd=ROOT, text=True, capture_output=True, check=False
        )
        assert done.returncode == code and text in done.stdout + done.stderr
        assert "Traceback" not in done.stderr
