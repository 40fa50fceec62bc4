"""Check the wording of comments, docstrings, messages and Markdown against lint/prose.txt.

`python -m scripts.measure.prose` prints each finding and the counts per 1000 lines. `make lint` fails if
there is an error. `--sample 60 --seed N` draws passages for a reader.
"""

from __future__ import annotations

import argparse
import ast
import io
import random
import re
import subprocess
import sys
import tokenize
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from cocotb_tests.harness.project import ROOT, console, run

WORDS = ROOT / "lint" / "prose.txt"
NEUTRAL = "X"
"""Word that represents code within a sentence."""
SLASHES = {".sv", ".svh", ".c", ".h", ".cpp", ".ts", ".tsx", ".mjs", ".css"}
HASHES = {".yml", ".toml", ".sh", ".txt"}
LONGEST = 30
"""Maximum number of words in a sentence."""
SHARES = {
    "markdown": 15,
    "header": 10,
    "comment": 10,
    "docstring": 10,
    "help": 3,
    "message": 4,
    "changelog": 4,
    "commit": 4,
}
"""Number of passages of each kind in a sample of 60."""


@dataclass(frozen=True)
class Item:
    """A passage: kind (a key of SHARES), file, number of its first line, lines."""

    kind: str
    file: str
    line: int
    lines: tuple[str, ...]


@dataclass(frozen=True)
class Row:
    """A row of lint/prose.txt."""

    level: str
    pattern: re.Pattern[str]
    instead: str


@cache
def rows() -> tuple[Row, ...]:
    """Return the rows of the word list."""
    found = []
    for line in WORDS.read_text(encoding="utf-8").splitlines():
        if line and not line.startswith("#"):
            level, rest = line.split(" | ", 1)
            pattern, instead = rest.rsplit(" | ", 1)
            found.append(Row(level, re.compile(pattern, re.IGNORECASE), instead))
    return tuple(found)


def _blocks(kind: str, file: str, lines: list[tuple[int, str]]) -> Iterator[Item]:
    """Yield an item for each group of lines with consecutive numbers; an empty line ends a group."""
    group: list[tuple[int, str]] = []
    for number, text in [*lines, (-1, "")]:
        if group and (number != group[-1][0] + 1 or not text.strip()):
            yield Item(kind, file, group[0][0], tuple(line for _, line in group))
            group = []
        if text.strip():
            group.append((number, text))


def markdown(file: str, text: str) -> Iterator[Item]:
    """Yield paragraphs, list items and table rows without code and without generated blocks."""
    kind = "changelog" if file == "CHANGELOG.md" else "markdown"
    lines: list[tuple[int, str]] = []
    fenced, marker = False, ""
    for number, line in enumerate(text.splitlines(), 1):
        if mark := re.fullmatch(r"<!-- (/?)([\w-]+( [\w-]+)?) -->", line.strip()):
            marker = "" if mark[1] or f"<!-- /{mark[2]} -->" not in text else mark[2]
        elif line.strip().startswith("```"):
            fenced = not fenced
            lines.append((number, ""))
        elif not fenced and not marker:
            line = re.sub(r"<!--.*?-->|`[^`]*`", lambda found: NEUTRAL if found[0][0] == "`" else "", line)
            line = re.sub(r"\]\([^)]*\)", "]", line)
            if re.match(r"\s*([-*|#>]|\d+\.)", line):
                lines.append((number - 1, ""))
            lines.append((number, line))
    yield from _blocks(kind, file, lines)


def slashed(file: str, text: str) -> Iterator[Item]:
    """Yield the comments of SystemVerilog, C and TypeScript; the first block of a file is its header."""
    lines: list[tuple[int, str]] = []
    inside = False
    for number, line in enumerate(text.splitlines(), 1):
        found = re.search(r"(?<![:\"'])//+(.*)", line)
        if inside or "/*" in line:
            part = line if inside else line.split("/*", 1)[1]
            inside = "*/" not in part
            lines.append((number, part.split("*/")[0].strip(" *")))
        elif found and "SPDX" not in line:
            # A comment after code never continues the sentence of the line before.
            if line.strip()[:2] != "//":
                lines.append((number - 1, ""))
            lines.append((number, found[1]))
    for at, item in enumerate(_blocks("comment", file, lines)):
        header = at == 0 and item.line < 4
        yield Item("header" if header else "comment", file, item.line, item.lines)


def hashed(file: str, text: str) -> Iterator[Item]:
    """Yield the comments of YAML, TOML and shell."""
    rows = enumerate(text.splitlines(), 1)
    found = [(number, match[1]) for number, line in rows if (match := re.search(r"(?:^|\s)# (.*)", line))]
    yield from _blocks("comment", file, found)


def _documented(tree: ast.AST) -> Iterator[ast.Constant]:
    """Yield docstrings, including the docstrings of constants."""
    for node in ast.walk(tree):
        if (
            isinstance(node, ast.Expr)
            and isinstance(node.value, ast.Constant)
            and isinstance(node.value.value, str)
        ):
            yield node.value


def python(file: str, text: str) -> Iterator[Item]:
    """Yield docstrings and comments; in the package also strings of four words or more (help, messages)."""
    tree = ast.parse(text)
    documented = {(node.lineno, node.col_offset): node for node in _documented(tree)}
    source = text.splitlines()
    for node in documented.values():
        lines = [(at, source[at - 1]) for at in range(node.lineno, (node.end_lineno or node.lineno) + 1)]
        # Code in a docstring is indented by four or begins with >>>.
        own = len(source[node.lineno - 1]) - len(source[node.lineno - 1].lstrip())
        lines = [
            (at, "" if re.match(rf"\s{{{own + 4}}}|\s*(>>>|\.\.\.)", line) else line) for at, line in lines
        ]
        yield from _blocks(
            "docstring", file, [(at, re.sub(r"`+[^`]*`+", NEUTRAL, line)) for at, line in lines]
        )
    tokens = tokenize.generate_tokens(io.StringIO(text).readline)
    comments = [
        (token.start[0], token.string.lstrip("#: ")) for token in tokens if token.type == tokenize.COMMENT
    ]
    yield from _blocks("comment", file, comments)
    if file.startswith("openppmc/"):
        kind = "help" if file.startswith("openppmc/cli/") else "message"
        for node in ast.walk(tree):
            if isinstance(node, ast.Constant) and isinstance(node.value, str):
                words = re.sub(r"`[^`]*`", NEUTRAL, node.value)
                if (node.lineno, node.col_offset) not in documented and len(words.split()) > 3:
                    yield Item(kind, file, node.lineno, tuple(words.splitlines()))


def items_of(path: Path) -> list[Item]:
    """Return the passages of a file, without lines that are marked `prose: ok`."""
    file = path.relative_to(ROOT).as_posix()
    if path.name == "traceability.md" or path.suffix not in {".md", ".py", *SLASHES, *HASHES}:
        return []
    if file.startswith(("packages/", "lint/prose")) or path.name == "requirements.lock":
        return []
    read = {".md": markdown, ".py": python}.get(path.suffix, slashed if path.suffix in SLASHES else hashed)
    text = path.read_text(encoding="utf-8")
    source = text.splitlines()
    found = []
    for item in read(file, text):
        kept = [
            line
            for at, line in enumerate(item.lines, item.line)
            if "prose: ok" not in "".join(source[at - 1 : at])
        ]
        if kept:
            found.append(Item(item.kind, file, item.line, tuple(kept)))
    return found


def all_items() -> list[Item]:
    """Return the passages of all files that git tracks."""
    listing = subprocess.run(["git", "ls-files"], cwd=ROOT, text=True, capture_output=True, check=True)
    return [item for name in listing.stdout.splitlines() for item in items_of(ROOT / name)]


def findings(item: Item) -> Iterator[tuple[str, str]]:
    """Yield each finding in a passage as (level, line of text for the user)."""
    for at, line in enumerate(item.lines):
        for row in rows():
            for match in row.pattern.finditer(line):
                yield row.level, f"{item.file}:{item.line + at}: {match[0].strip()}: {row.instead}"
    for sentence in re.split(r"(?<=[.:;?!])\s+|\|", " ".join(item.lines)):
        if item.kind == "markdown" and len(sentence.split()) > LONGEST:
            yield "warn", f"{item.file}:{item.line}: {len(sentence.split())} words in a sentence"


def errors() -> str:
    """Return all errors, one per line."""
    found = (finding for item in all_items() for finding in findings(item))
    return "\n".join(text for level, text in found if level == "error")


def commits() -> list[Item]:
    """Return the last 300 commit messages."""
    log = subprocess.run(
        ["git", "log", "-300", "--format=%h%n%B%x00"], cwd=ROOT, text=True, capture_output=True, check=True
    )
    texts = [text.strip().splitlines() for text in log.stdout.split("\0") if text.strip()]
    return [Item("commit", text[0], 0, tuple(text[1:])) for text in texts]


def sample(number: int, seed: int) -> list[Item]:
    """Draw random passages; SHARES defines the number of each kind."""
    rng = random.Random(seed)
    every = all_items() + commits()
    drawn = []
    for kind, share in SHARES.items():
        of_kind = [item for item in every if item.kind == kind and len(" ".join(item.lines).split()) > 3]
        drawn += rng.sample(of_kind, min(len(of_kind), round(share * number / 60)))
    return drawn


def main() -> int:
    """Run the command line."""
    parser = argparse.ArgumentParser(
        prog="python -m scripts.measure.prose", description=(__doc__ or "").split("\n")[0]
    )
    parser.add_argument("paths", nargs="*", type=Path, help="files to check (default: all)")
    parser.add_argument("--warn", action="store_true", help="print warnings, too")
    parser.add_argument("--sample", type=int, metavar="NUMBER", help="print passages drawn at random")
    parser.add_argument("--seed", type=int, default=1, help="seed of the sample")
    args = parser.parse_args()
    if args.sample:
        for number, item in enumerate(sample(args.sample, args.seed), 1):
            print(f"{number}. [{item.kind}] {item.file}:{item.line}", *item.lines, "", sep="\n")
        return 0
    items = [item for path in args.paths for item in items_of(path.resolve())] if args.paths else all_items()
    every = [finding for item in items for finding in findings(item)]
    lines = sum(len(item.lines) for item in items)
    for level, text in every:
        if level == "error" or args.warn:
            print(f"{level}: {text}")
    counts = Counter(level for level, _ in every)
    console.print(
        f"{lines} lines of prose; per 1000 lines: {1000 * counts['error'] / max(lines, 1):.1f} errors"
        f" ({counts['error']}), {1000 * counts['warn'] / max(lines, 1):.1f} warnings",
        highlight=False,
    )
    return int(bool(counts["error"]))


if __name__ == "__main__":
    sys.exit(run(main))
