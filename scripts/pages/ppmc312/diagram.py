"""Block diagram of docs/ppmc312/design.md."""

from __future__ import annotations

from scripts.pages.pictures.blocks import Arrow, Box, draw
from scripts.pages.pictures.plots import svg

BOXES = {
    "bus": Box(0.3, 0, "bus pins", "pin", 0.7, 0.4),
    "port": Box(1.85, 0, "ppmc312_bus, _mailbox\nregisters, /WRQ", "host", 1.75),
    "line": Box(0.3, 0.9, "rxd, txd,\nsnd", "pin", 0.7, 0.5),
    "serial": Box(1.85, 0.9, "ppmc312_serial\nframes into blocks", "host", 1.75),
    "instr": Box(4.35, 0.45, "ppmc312_instr_unit\nfetch, check,\nexecute, answer", "part", 1.55, 1.0),
    "reports": Box(1.85, 1.9, "ppmc312_report_queue\nqueues of 8 classes", "host", 1.75),
    "store": Box(4.35, 1.9, "ppmc312_instr_queue\noverride, events", "part", 1.55),
    "setup": Box(6.7, 0, "ppmc312_setup\n_free_curve\n00, 01, 41", "part", 1.65),
    "unit": Box(9.1, 0, "ppmc312_stage_unit\nbuilder, table, plan", "motion", 1.75),
    "move": Box(6.7, 0.95, "ppmc312_move\nlimits, start, change", "motion", 1.65),
    "seq": Box(9.1, 0.95, "ppmc312_stage_seq\nstage boundaries", "motion", 1.75),
    "interval": Box(9.1, 1.9, "ppmc312_interval\nticks, width of a pulse", "motion", 1.75),
    "motion": Box(6.7, 1.9, "ppmc312_motion\nstates, causes", "motion", 1.65),
    "switches": Box(0.3, 2.85, "switches", "pin", 0.7, 0.4),
    "pins": Box(1.85, 2.85, "ppmc312_pins\n_aux_monitor", "plain", 1.75),
    "position": Box(6.7, 2.85, "ppmc312_position\ncounters, monitors", "motion", 1.65),
    "outputs": Box(9.1, 2.85, "ppmc312_outputs\npins of the drive", "motion", 1.75),
    "pout": Box(10.75, 1.9, "pout, dir", "pin", 0.7, 0.4),
    "drive": Box(10.75, 2.85, "cclr_n, …", "pin", 0.7, 0.4),
}
ARROWS = (
    Arrow("bus", "port", both=True),
    Arrow("line", "serial", both=True),
    Arrow("port", "instr", "block", via=((3.45, 0), (3.45, 0.3))),
    Arrow("serial", "instr", "block", via=((3.45, 0.9), (3.45, 0.6))),
    Arrow("instr", "reports", "answers", via=((3.9, 1.42), (2.3, 1.42))),
    Arrow("instr", "store", "entries"),
    Arrow("instr", "setup", "tables", via=((5.72, 0.3), (5.72, 0))),
    Arrow("instr", "move", "moves", via=((5.72, 0.6), (5.72, 0.95))),
    Arrow("setup", "unit"),
    Arrow("unit", "seq", "stages"),
    Arrow("move", "seq", "order"),
    Arrow("seq", "interval", "rate"),
    Arrow("interval", "motion", "pulses"),
    Arrow("motion", "store", "events"),
    Arrow("motion", "position", "counts"),
    Arrow("position", "outputs"),
    Arrow("interval", "pout"),
    Arrow("outputs", "drive"),
    Arrow("switches", "pins"),
    Arrow("pins", "motion", "stops", via=((5.6, 2.85), (5.6, 2.05))),
)


def inside() -> bytes:
    """Draw the blocks of the PPMC-312, from its host to the drive."""
    return svg(draw(BOXES, ARROWS, (10.4, 3.3)))


PLOTS = {"inside": inside}
