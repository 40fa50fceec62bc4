"""Flow chart of docs/ppmc2104/README.md: a stop while a code waits."""

from __future__ import annotations

from scripts.pages.pictures.blocks import Arrow, Box, draw
from scripts.pages.pictures.plots import svg

WIDE = 2.3
BOXES = {
    "wanted": Box(1.2, 0, "a stop is wanted for axis n", "pin", WIDE, 0.35),
    "busy": Box(1.2, 0.75, "BUSYn = 1?", "part", WIDE, 0.45),
    "starts": Box(4.15, 0.75, "does a code wait\nthat would start axis n\n(IBF = 1)?", "part", 1.9, 0.75),
    "rest": Box(7.0, 0.35, "done: it is at rest\na stop would be error 6", "plain", 1.9, 0.6),
    "over": Box(
        7.0, 1.25, "write the stop over it\nno waiting; error 6,\nand the start is gone", "host", 1.9, 0.75
    ),
    "full": Box(1.2, 1.65, "IBF = 0?", "part", WIDE, 0.45),
    "write": Box(4.15, 1.65, "write the stop", "host", 1.9, 0.45),
    "still": Box(1.2, 2.6, "IBF still 1 after 20 clk?\na code waits for a table", "part", WIDE, 0.6),
    "replace": Box(
        1.2,
        3.7,
        "write the stop, no waiting\nit replaces the waiting code\nand is taken at once",
        "host",
        WIDE,
        0.75,
    ),
    "check": Box(4.15, 3.7, "wait for IBF = 0,\nthen read ERROR", "part", 1.9, 0.6),
    "again": Box(7.0, 3.7, "once CMNDm = 0: send\nthe replaced code again", "host", 1.9, 0.6),
}
ARROWS = (
    Arrow("wanted", "busy"),
    Arrow("busy", "starts", "no"),
    Arrow("starts", "rest", "no", via=((5.6, 0.75), (5.6, 0.35))),
    Arrow("starts", "over", "yes", via=((5.6, 0.75), (5.6, 1.25))),
    Arrow("busy", "full", "yes"),
    Arrow("full", "write", "yes"),
    Arrow("full", "still", "no"),
    Arrow("still", "write", "no: an ordinary byte", via=((4.15, 2.6),)),
    Arrow("still", "replace", "yes"),
    Arrow("write", "check", via=((5.6, 1.65), (5.6, 3.0), (4.15, 3.0))),
    Arrow("replace", "check"),
    Arrow("check", "again"),
)


def stop() -> bytes:
    """What a host does that must stop an axis now."""
    return svg(draw(BOXES, ARROWS, (7.6, 4.0)))


PLOTS = {"stop": stop}
