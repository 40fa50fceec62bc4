"""What a PMC006B4 allows. Pure."""

from __future__ import annotations

from ...parts import part
from ..basis.kind import Kind

KIND = Kind(part("pmc006"), outputs=31)
