"""Data sheets as PDF: Typst sets the manual of a device and its further pages with site/datasheet.typ."""

from __future__ import annotations

import json
import os
import time
from pathlib import Path
from typing import Any

import typst
from markdown_it import MarkdownIt
from markdown_it.tree import SyntaxTreeNode

from cocotb_tests.harness.project import ROOT, ProjectError
from openppmc import __version__, parts
from scripts.fpga.flow.boards import git_state

APPENDICES = ("instructions", "serial", "carrier", "spi", "replace", "isa", "examples", "rulings")
"""Pages that follow the manual of a device, in this order; a device may lack some of them."""
Node = dict[str, Any]


def _node(of: SyntaxTreeNode) -> Node:
    """Return a part of a Markdown page as a value for JSON."""
    found = {"type": of.type, "children": [_node(child) for child in of.children]}
    return found if of.is_root else found | {"tag": of.tag, "info": of.info, "text": of.content} | of.attrs


def tree(path: Path) -> list[Node]:
    """Return the blocks of a Markdown page."""
    parser = MarkdownIt("commonmark").enable("table")
    return _node(SyntaxTreeNode(parser.parse(path.read_text(encoding="utf-8"))))["children"]


def make(part: str, version: str = __version__) -> bytes:
    """Return the data sheet of a part as PDF.

    The date of the PDF is SOURCE_DATE_EPOCH, or else the current time. Raises ProjectError for a link without
    a target, a missing picture, or Markdown that the template does not support.
    """
    epoch = int(os.environ.get("SOURCE_DATE_EPOCH") or time.time())
    commit, changed = git_state()
    row, folder = parts.part(part), ROOT / "docs" / part
    names = ["README", *(name for name in APPENDICES if (folder / f"{name}.md").is_file())]
    data = {
        "part": part,
        "version": version,
        "commit": (commit.hex()[:10] or "unknown") + " with changes" * changed,
        "date": time.strftime("%Y-%m-%d", time.gmtime(epoch)),
        "pages": [{"name": name, "blocks": tree(folder / f"{name}.md")} for name in names],
        "names": "|".join([row.title.split()[-1], *(f"{rule}-" for rule in row.rules)]),
        "changelog": tree(ROOT / "CHANGELOG.md"),
    }
    try:
        return typst.compile(
            str(ROOT / "site/datasheet.typ"),
            root=str(ROOT),
            ignore_system_fonts=True,
            format="pdf",
            sys_inputs={"data": json.dumps(data)},
            timestamp=epoch,
        )
    except typst.TypstError as error:
        raise ProjectError(f"data sheet of {part}: {error.message}") from None
