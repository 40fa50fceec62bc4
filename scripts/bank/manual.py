"""What is drawn and computed for docs/bank/."""

from __future__ import annotations

from scripts.bank.diagrams import DIAGRAMS
from scripts.bank.plots import PLOTS
from scripts.bank.tables import TABLES
from scripts.pictures.manual import Manual

MANUAL = Manual(TABLES, PLOTS, DIAGRAMS)
