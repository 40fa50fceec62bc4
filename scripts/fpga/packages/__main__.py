"""Write the packages, compare them with the existing files (--check), or try their use (--try)."""

from __future__ import annotations

import sys

from cocotb_tests.harness import project
from scripts import generated
from scripts.fpga.packages.cores import core_files
from scripts.fpga.packages.lists import list_files
from scripts.fpga.packages.registers import register_files
from scripts.fpga.packages.vendors import vendor_files


def main() -> int:
    """Write all files; return 1 if --check finds an outdated file or a trial of --try fails."""
    parser = generated.parser("packages", __doc__)
    parser.add_argument(
        "--try", dest="trial", action="store_true", help="run FuseSoC, elaborate the templates"
    )
    parser.add_argument("--verilator", metavar="PROGRAM", help="with --try: use only this Verilator")
    options = parser.parse_args()
    expected = {**core_files(), **list_files(), **register_files(), **vendor_files()}
    if not options.trial:
        return generated.update("packages", expected, options.check)
    generated.current("packages", expected)
    # This module is imported here, so that --check needs no simulator.
    from scripts.fpga.packages.trial import try_all, try_other

    if options.verilator is None:
        try_all()
    else:
        try_other(options.verilator)
    return 0


if __name__ == "__main__":
    sys.exit(project.run(main))
