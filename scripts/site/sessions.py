"""The sessions in the manuals, as texts for the playground.

A chapter of docs/<part>/examples.md that can be run has a comment after its title:

    <!-- run: after 1; @; until int_n 0; @ -->

`@` represents the next block of the chapter, or the rest of a block; `@2` represents the next two lines of
the block, and `after N` the statements of chapter N. All other words are statements (`script`).
"""

from __future__ import annotations

import importlib
import re
from dataclasses import dataclass

from cocotb_tests.harness.paths import ROOT

CHAPTER = re.compile(r"^## (\d+) (.*?)\n(.*?)(?=^## |\Z)", re.M | re.S)
RUN = re.compile(r"^<!-- run: (.*?) -->$", re.M | re.S)
BLOCK = re.compile(r"```\n(.*?)```", re.S)
LINE = re.compile(r"((?:[cdw] [0-9A-F]{2} +st [0-9A-F]{2}|r [0-9A-F]{2}|p? +st [0-9A-F]{2}))\b\s*(.*)")


@dataclass(frozen=True)
class Session:
    """A session: `name` in links (the chapter), title and text."""

    name: str
    title: str
    text: str


def _line(line: str) -> str:
    """Return a line of the manual as statements. The explanation in the line becomes a comment."""
    if re.match(r"[wr] \d |[<>=] |(?:pin|at|ms) ", line):
        return _block_line(line)
    found = LINE.fullmatch(line.rstrip())
    if not found:
        raise ValueError(f"cannot read {line!r}")
    words = re.sub(r" +", " ", found[1].strip())
    words = re.sub(r"^p st", "p", words)
    # A single step may end before a slow host has read the status.
    words = re.sub(r"^(c [4-7][2A]) st ..", r"\1 st", words)
    return f"{words:<12}  # {found[2]}" if found[2] else words


def _block_line(line: str) -> str:
    """Return a line of the PPMC-312's page as statements; its explanation follows two spaces."""
    words, _, comment = line.strip().partition("  ")
    kind, _, rest = words.partition(" ")
    if kind == "pin":
        pin, *levels = rest.split()
        words = "; ".join(f"set {pin}={level}; wait 20" for level in levels)
    elif kind in ("at", "ms", "="):
        words = {"at": f"pulse {rest}", "ms": f"wait {rest}ms", "=": f"count {rest}"}[kind]
    return f"{words:<12}  # {comment.strip()}" if comment.strip() else words


def sessions(part: str) -> list[Session]:
    """Return the sessions of a part in the order of its page; raise ValueError for an invalid line."""
    page = ROOT / "docs" / part / "examples.md"
    if not page.is_file():
        return own_sessions(part)
    texts: dict[str, str] = {}
    found = []
    for number, title, body in CHAPTER.findall(page.read_text(encoding="utf-8")):
        run = RUN.search(body)
        if not run:
            continue
        blocks = iter([block.splitlines() for block in BLOCK.findall(body)])
        left: list[str] = []
        lines: list[str] = []
        for step in re.split(r"\s*;\s*", re.sub(r"\s+", " ", run[1])):
            if step.startswith("@"):
                left = left or next(blocks)
                count = int(step[1:] or len(left))
                lines += [_line(line) for line in left[:count]]
                left = left[count:]
            elif step.startswith("after "):
                lines += [texts[step.split()[1]], f"# {number} {title}"]
            elif step:
                lines.append(step)
        texts[number] = "\n".join(lines)
        found.append(Session(number, f"{number} {title}", texts[number]))
    return found


def own_sessions(part: str) -> list[Session]:
    """Return the sessions that scripts/site/<part>.py defines for a part whose manual has no sessions."""
    module = importlib.import_module(f"scripts.site.{part.replace('-', '_')}")
    return [
        Session(str(number), f"{number} {title}", text.strip())
        for number, (title, text) in enumerate(module.SESSIONS.items(), 1)
    ]
