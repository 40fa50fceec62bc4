"""Generated content of docs/bank/."""

from __future__ import annotations

from scripts.pages.bank.diagrams import DIAGRAMS
from scripts.pages.bank.plots import PLOTS
from scripts.pages.bank.tables import TABLES
from scripts.pages.pictures.manual import Manual

MANUAL = Manual(TABLES, PLOTS, DIAGRAMS)
