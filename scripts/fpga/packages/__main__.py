"""Write the packages, compare them with the existing files (--check), or use them (--try)."""

from __future__ import annotations

import argparse
import sys

from cocotb_tests.harness import project
from cocotb_tests.harness.project import ProjectError, console, relative
from scripts.fpga.packages.cores import core_files
from scripts.fpga.packages.lists import list_files
from scripts.fpga.packages.registers import register_files
from scripts.fpga.packages.vendors import vendor_files


def main() -> int:
    """Write all files; return 1 if --check finds an outdated file or a trial of --try fails."""
    parser = argparse.ArgumentParser(prog="packages", description=__doc__)
    parser.add_argument(
        "--check", action="store_true", help="write nothing, list the files that are outdated"
    )
    parser.add_argument(
        "--try", dest="trial", action="store_true", help="run FuseSoC, elaborate the templates"
    )
    parser.add_argument("--verilator", metavar="PROGRAM", help="with --try: use only this Verilator")
    options = parser.parse_args()
    expected = {**core_files(), **list_files(), **register_files(), **vendor_files()}
    stale = [path for path, text in expected.items() if not path.is_file() or path.read_text() != text]
    if options.check:
        for path in stale:
            console.print(f"{relative(path)}: outdated; run `make packages`")
        return int(bool(stale))
    if options.trial:
        if stale:
            raise ProjectError(f"{relative(stale[0])} is outdated; run `make packages`")
        # Imported here, so that --check needs no simulator.
        from scripts.fpga.packages.trial import try_all, try_other

        if options.verilator is None:
            try_all()
        else:
            try_other(options.verilator)
        return 0
    for path in stale:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(expected[path])
        console.print(f"wrote {relative(path)}")
    console.print(f"packages: {len(expected)} files, {len(stale)} of them new or changed")
    return 0


if __name__ == "__main__":
    sys.exit(project.run(main))
