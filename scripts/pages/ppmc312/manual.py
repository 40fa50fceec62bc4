"""Generated content of docs/ppmc312/."""

from __future__ import annotations

from scripts.pages.pictures.manual import Manual
from scripts.pages.ppmc312 import diagram, plots
from scripts.pages.ppmc312.tables import moves_table, table_table, times_table
from scripts.pages.ppmc312.waves import DIAGRAMS

MANUAL = Manual(
    {"table-table": table_table, "moves-table": moves_table, "times-table": times_table},
    {**diagram.PLOTS, **plots.PLOTS},
    DIAGRAMS,
)
