"""Flow chart of docs/ppmc2104/README.md: a stop while a code is pending."""

from __future__ import annotations

from scripts.pages.pictures.blocks import Arrow, Box, draw
from scripts.pages.pictures.plots import svg

WIDE = 2.3
BOXES = {
    "wanted": Box(1.2, 0, "axis n must stop", "pin", WIDE, 0.35),
    "busy": Box(1.2, 0.75, "BUSYn = 1?", "part", WIDE, 0.45),
    "starts": Box(4.15, 0.75, "is a code pending\nthat would start axis n\n(IBF = 1)?", "part", 1.9, 0.75),
    "rest": Box(7.0, 0.35, "done: the axis is stopped\na stop would be error 6", "plain", 1.9, 0.6),
    "over": Box(
        7.0,
        1.25,
        "overwrite the code\nwith the stop, no waiting;\nerror 6, start discarded",
        "host",
        1.9,
        0.75,
    ),
    "full": Box(1.2, 1.65, "IBF = 0?", "part", WIDE, 0.45),
    "write": Box(4.15, 1.65, "write the stop", "host", 1.9, 0.45),
    "still": Box(1.2, 2.6, "IBF still 1 after 20 cycles?\na code waits for a table", "part", WIDE, 0.6),
    "replace": Box(
        1.2,
        3.7,
        "write the stop without waiting\nit replaces the pending code\nand is accepted immediately",
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
    """Draw the actions of a host that must stop an axis immediately."""
    return svg(draw(BOXES, ARROWS, (7.6, 4.0)))


PLOTS = {"stop": stop}
