"""Generated content of docs/stmc/."""

from __future__ import annotations

from scripts.pages.pictures.manual import Manual
from scripts.pages.stmc.plots import PLOTS
from scripts.pages.stmc.tables import moves_table, ramp_table, speed_table, times_table
from scripts.pages.stmc.waves import DIAGRAMS

MANUAL = Manual(
    {
        "speed-table": speed_table,
        "ramp-table": ramp_table,
        "moves-table": moves_table,
        "times-table": times_table,
    },
    PLOTS,
    DIAGRAMS,
)
