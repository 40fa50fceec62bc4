"""The pages docs/boards/<board>.md: drawings, levels, order lists."""

from __future__ import annotations

from pathlib import Path

from cocotb_tests.harness.project import DOCS
from scripts.fpga.boards.__main__ import fitted_parts
from scripts.fpga.boards.description import load_all
from scripts.fpga.boards.pads import Fitted
from scripts.markdown import table
from scripts.pages.wiring.circuits import Use, order, uses
from scripts.pages.wiring.draw import draw

FOLDER = DOCS / "boards"
HEAD = """\
# Wiring of the {title}

This page is for {revisions} ([revisions](../boards.md#revisions)).

`make docs` writes this page from `constraints/{name}/board.yml` and `scripts/pages/wiring`; change these \
files, not this page.
For each part that the board carries, the page has a drawing, the levels and an order list.
[boards.md](../boards.md#4-power-and-levels) explains the circuits, other drivers and other switches.
Before you connect a winding, read [Before the motor turns](../boards.md#10-before-the-motor-turns).
These circuits were not built or tested.

{levels}
- Build only the circuits that your machine needs; omit the components of other circuits from the order list.
  With `HOST=uart` nothing is connected to the bus pins.
- Order numbers are examples of components that were sold when this page was written.
  Any component of the same type and case is suitable.

Contents: {contents}
"""

DIRECT = """\
- **Every pin of a header is 3.3 V and must never carry more**: not 5 V, not the motor's supply, not through \
a pull-up.
  5 V and more are allowed only on the right side of the drawings, on the far side of the shifter, buffer, \
optocoupler or driver.
- A resistor of {resistor} at a wire connects the wire to GND or 3.3 V, on the FPGA's side of the circuit.
  It holds the wire at a fixed level while the FPGA is not configured."""
BUFFERED = """\
- **Each header pin has a buffer, powered with {level}.** As sold, all header pins are outputs. \
Never connect a voltage to an output.
  The buffers always drive: before the FPGA is configured, the outputs have no defined level, and a resistor \
does not change this.
  Switch the motor's supply on only after the bitstream is loaded.
- **The inputs work only after a change of the board**: {inputs}.
  Without this change, an input reads as inactive. **No limit switch stops the motor then.**
- A resistor of {resistor} at an input connects it to 3.3 V."""


def pages() -> dict[Path, bytes]:
    """Return path and content of every page and drawing."""
    files: dict[Path, bytes] = {}
    fitted = fitted_parts(load_all())
    for board in dict.fromkeys(one.board.name for one in fitted):
        mine = [one for one in fitted if one.board.name == board]
        files[FOLDER / f"{board}.md"] = _page(mine).encode()
        for one in mine:
            files[FOLDER / "img" / f"{board}-{one.on.name}.svg"] = draw(one)
    return files


def _page(fitted: list[Fitted]) -> str:
    board = fitted[0].board
    names = [one.on.name for one in fitted]
    resistor = uses(fitted[0])[0].resistor
    contents = " · ".join(f"[{_title(one)}](#{one.on.name})" for one in fitted)
    levels = (BUFFERED if board.buffers else DIRECT).format(resistor=resistor, **board.buffers)
    head = HEAD.format(
        title=board.title, revisions=board.revisions, name=board.name, levels=levels, contents=contents
    )
    assert len(set(names)) == len(names)
    return "\n".join([head, *(_section(one) for one in fitted)])


def _title(one: Fitted) -> str:
    return one.on.row.title + (", bus host" if one.on.hosts == ("bus",) else "")


def _section(one: Fitted) -> str:
    found = uses(one)
    rows = [f'<a id="{one.on.name}"></a>', "", f"## {_title(one)}", ""]
    rows += [f"![Wiring](img/{one.board.name}-{one.on.name}.svg)", ""]
    rows += [table(("circuit", "header pins", "far side of the circuit"), map(_levels, found))]
    parts = table(("quantity", "component", "order number"), order(found)).replace("|---", "|---:", 1)
    return "\n".join([*rows, "", "Order list for all circuits:", "", parts, ""])


def _levels(use: Use) -> tuple[str, ...]:
    pins = ", ".join(f"`{pad.where.split(',')[0]}`" for pad in use.pads)
    level = use.level(use.pads[0])
    far = use.circuit.level if use.circuit.level != "3.3 V" else level
    never = "" if far.startswith((level, "3.3 V", "GND")) else f" **{far}**: never to the header"
    here = "no voltage (see the drawing)" if use.circuit.key == "straps" else level
    return use.circuit.title, f"{pins}: {here}", never.strip() or far
