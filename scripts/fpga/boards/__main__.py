"""`make boards`: write tops, constraint files and tables from board descriptions; --check compares."""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path

from cocotb_tests.harness import project
from cocotb_tests.harness.project import relative
from scripts import generated
from scripts.fpga.boards import carrier, constraints, tables, top
from scripts.fpga.boards.description import FOLDER, Description, load_all
from scripts.fpga.boards.pads import Fitted, fit
from scripts.fpga.boards.verilog import laid_out


def fitted_parts(boards: tuple[Description, ...]) -> list[Fitted]:
    """Return every combination of a board and a part that it supports."""
    return [
        fit(board, on, carrier.read(carrier.path_of(on.row), on.set))
        for board in boards
        for on in board.parts
    ]


def own_files(one: Fitted, layout: Callable[[str], str]) -> dict[Path, str]:
    """Return the top, formatted by `layout`, and the constraint files of a board with a part."""
    tops = {project.RTL / name: layout(text) for name, text in top.file(one.board, one).items()}
    return {**tops, **{FOLDER / name: text for name, text in constraints.files(one).items()}}


def all_files(layout: Callable[[str], str] = laid_out) -> dict[Path, str]:
    """Return all files that the descriptions determine, with tops formatted by `layout`."""
    boards = load_all()
    every = fitted_parts(boards)
    found = {path: text for one in every for path, text in own_files(one, layout).items()}
    found |= tables.pages(boards, every)
    sources = project.RTL / "files.yml"
    found[sources] = tables.listing(boards, every, sources.read_text(encoding="utf-8"))
    return found


def left_over(expected: dict[Path, str]) -> list[Path]:
    """Return the existing tops and constraint files that no description determines."""
    there = [*(project.RTL / "boards").glob("*/board_*.sv"), *FOLDER.glob("*/*/*")]
    return sorted(path for path in there if path.is_file() and path not in expected)


def main() -> int:
    """Write all files; return 1 if --check finds an outdated file, or if a file belongs to no description."""
    check = generated.parser("boards", __doc__).parse_args().check
    expected = all_files()
    code = generated.update("boards", expected, check)
    for path in left_over(expected):
        code = project.fail(f"{relative(path)}: belongs to no part of a board.yml; remove it")
    return code


if __name__ == "__main__":
    sys.exit(project.run(main))
