"""What is drawn and computed for docs/ppmc104/."""

from __future__ import annotations

from scripts.pictures.manual import Manual
from scripts.ppmc104.plots import PLOTS
from scripts.ppmc104.tables import TABLES

MANUAL = Manual(TABLES, PLOTS)
