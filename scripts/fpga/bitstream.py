"""`make bitstream BOARD=… HOST=… [PART=…] [SEED=…]`: build the bitstream and the report of a board."""

from __future__ import annotations

import argparse
import sys

from rich.progress import Progress, SpinnerColumn, TextColumn, TimeElapsedColumn
from rich.table import Table

from cocotb_tests.harness import project
from cocotb_tests.harness.project import ProjectError, console
from scripts.fpga.flow.boards import BOARDS, BY_PART, HOSTS, build_board


def arguments() -> argparse.Namespace:
    """Parse the command line."""
    parser = argparse.ArgumentParser(prog="bitstream.py", description=__doc__)
    parser.add_argument("board", help=", ".join(BOARDS))
    parser.add_argument("--host", default="uart", help=" or ".join(HOSTS))
    parser.add_argument("--part", default="ppmc104", help=" or ".join(BY_PART))
    parser.add_argument("--seed", type=int, help="one place-and-route seed instead of trying 1 to 8")
    parser.add_argument(
        "-G",
        metavar="NAME=VALUE",
        action="append",
        default=[],
        help="parameter of the top: PHASE_IDLE or PHASE_ON, TIMING, READ_MAP, XTAL_HZ, BAUD, RECORD",
    )
    return parser.parse_args()


def parameters(texts: list[str]) -> dict[str, int | str]:
    """Return the parameters from texts NAME=VALUE; raise ProjectError for a text in another form."""
    params: dict[str, int | str] = {}
    for text in texts:
        name, equals, value = text.partition("=")
        if not equals or not name.isidentifier() or not value:
            raise ProjectError(f"-G {text}: expected NAME=VALUE, such as PHASE_IDLE=1")
        params[name] = int(value) if value.isdigit() else value
    return params


def share(used: int, total: int) -> str:
    """Return the used part of a total as text, such as '1257 of 5280 (23.8 %)'."""
    return f"{used} of {total} ({100 * used / total:.1f} %)" if total else str(used)


def show(figures: dict) -> None:
    """Print the report of a finished build."""
    table = Table(
        title=f"{figures['title']}, {figures['part']}, HOST={figures['host']}",
        title_justify="left",
        show_header=False,
    )
    required = figures["clk_hz"] / 1e6
    rows = [
        ("device", figures["device"]),
        (figures["lut_name"], share(figures["lut"], figures["lut_total"])),
        ("flip-flops", str(figures["ff"])),
        ("block RAM", share(figures["ram"], figures["ram_total"])),
        *(
            (f"clock {name}", f"{mhz:.1f} MHz reached, {required:g} MHz required")
            for name, mhz in figures["clocks"].items()
        ),
        ("goal", f"≥ {figures['goal_mhz']:g} MHz: reached"),
        ("seed", str(figures["seed"])),
        ("bitstream", f"{figures['file']}, {figures['bytes']} bytes"),
    ]
    for row in rows:
        table.add_row(*row)
    console.print(table)


def main() -> int:
    """Run the command line."""
    args = arguments()
    params = parameters(args.G)
    columns = (SpinnerColumn(), TextColumn("{task.description}"), TimeElapsedColumn())
    with Progress(*columns, console=console, disable=not console.is_terminal, transient=True) as progress:
        task = progress.add_task(args.board, total=None)

        def notify(text: str) -> None:
            progress.update(task, description=f"{args.board}: {text}")
            if not console.is_terminal:
                console.print(f"{args.board}: {text}")

        figures = build_board(args.board, args.host, args.seed, params, notify, args.part)
    show(figures)
    return 0


if __name__ == "__main__":
    sys.exit(project.run(main))
