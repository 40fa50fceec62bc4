"""Write the packages, compare them with what is there (--check), or use them (--try)."""

from __future__ import annotations

import argparse
import sys

from cocotb_tests.harness import project
from cocotb_tests.harness.project import ProjectError, console, relative
from scripts.fpga.packages.cores import core_files
from scripts.fpga.packages.lists import list_files


def main() -> int:
    """Write all files; exit code 1 when --check finds a stale one or --try something that does not work."""
    parser = argparse.ArgumentParser(prog="packages", description=__doc__)
    parser.add_argument(
        "--check", action="store_true", help="write nothing, name the files that are not fresh"
    )
    parser.add_argument(
        "--try", dest="trial", action="store_true", help="run FuseSoC, elaborate the templates"
    )
    parser.add_argument(
        "--verilator", metavar="PROGRAM", help="with --try: use them with this Verilator alone"
    )
    options = parser.parse_args()
    wanted = {**core_files(), **list_files()}
    stale = [path for path, text in wanted.items() if not path.is_file() or path.read_text() != text]
    if options.check:
        for path in stale:
            console.print(f"{relative(path)}: not as `make packages` writes it")
        return int(bool(stale))
    if options.trial:
        if stale:
            raise ProjectError(f"{relative(stale[0])} is not fresh: run `make packages`")
        # Here, so that the check needs no simulator.
        from scripts.fpga.packages.trial import try_all, try_other

        if options.verilator is None:
            try_all()
        else:
            try_other(options.verilator)
        return 0
    for path in stale:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(wanted[path])
        console.print(f"wrote {relative(path)}")
    console.print(f"packages: {len(wanted)} files, {len(stale)} of them new or changed")
    return 0


if __name__ == "__main__":
    sys.exit(project.run(main))
