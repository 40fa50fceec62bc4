"""Generated content of docs/ppmc2104/."""

from __future__ import annotations

from scripts.pages.pictures.manual import Manual
from scripts.pages.ppmc2104 import flow, plots
from scripts.pages.ppmc2104.tables import TABLES

MANUAL = Manual(TABLES, {**plots.PLOTS, **flow.PLOTS})
