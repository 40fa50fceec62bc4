"""Generated content of docs/pmc006/."""

from __future__ import annotations

from scripts.pages.pictures.manual import Manual
from scripts.pages.pmc006 import currents, diagram, plots
from scripts.pages.pmc006.tables import moves_table, times_table

MANUAL = Manual(
    {"moves-table": moves_table, "currents-table": currents.currents_table, "times-table": times_table},
    {**diagram.PLOTS, **plots.PLOTS, **currents.PLOTS},
)
