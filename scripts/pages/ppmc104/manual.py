"""Generated content of docs/ppmc104/."""

from __future__ import annotations

from scripts.pages.pictures.manual import Manual
from scripts.pages.ppmc104.plots import PLOTS
from scripts.pages.ppmc104.tables import TABLES

MANUAL = Manual(TABLES, PLOTS)
