"""Picture of docs/boards.md: the connections of a board."""

from __future__ import annotations

from scripts.pages.pictures.blocks import Arrow, Box, draw
from scripts.pages.pictures.plots import svg

BOXES = {
    "pc": Box(0.4, 1.45, "PC", "host", 0.7, 0.5),
    "board": Box(2.1, 1.45, "board\nFPGA with the part,\npins of 3.3 V", "part", 1.4, 1.3),
    "driver": Box(5.2, 0.2, "step driver\npulse and direction", "motion", 1.7, 0.55),
    "bridge": Box(5.2, 1.0, "ULN2003 or bridge\nphases", "motion", 1.7, 0.55),
    "motor": Box(7.1, 0.6, "motor", "pin", 0.7, 0.4),
    "contacts": Box(
        5.6,
        1.97,
        "limits, origin, alarm\nnormally closed contacts to 3.3 V;\n"
        "1 kΩ to GND, 1 kΩ in series,\n10 nF to GND at the pin",
        "plain",
        2.5,
        0.9,
    ),
    "shifters": Box(5.2, 2.85, "level shifters\n3.3 V and 5 V", "plain", 1.7, 0.55),
    "old": Box(7.1, 2.85, "old host", "pin", 0.7, 0.4),
}
ARROWS = (
    Arrow("pc", "board", "USB", both=True),
    Arrow("board", "driver", "pout_n, dir, hold", via=((2.1, 0.2),)),
    Arrow("board", "bridge", "s[1] … s[5]"),
    Arrow("driver", "motor", via=((7.1, 0.2),)),
    Arrow("bridge", "motor", via=((7.1, 1.0),)),
    Arrow("contacts", "board", "l1_n … l4_n, alm_n"),
    Arrow("board", "shifters", "d[7:0], a0, cs_n, rd_n, wr_n, int_n", via=((2.1, 2.85),), both=True),
    Arrow("shifters", "old", both=True),
)


def board() -> bytes:
    """Draw a board between PC, motor, switches and an old host."""
    return svg(draw(BOXES, ARROWS, (7.4, 3.2)))
