"""Unit tests of RTL blocks under pytest: one item per cocotb test, one build per area of the RTL."""

from __future__ import annotations

import importlib
from collections.abc import Mapping, Sequence

from .block_driver import Block, wrapper_text
from .build import Design, locked
from .collect import Item
from .part import Part
from .paths import BUILD, ROOT
from .project import files
from .runner import SimOptions, run_item

BLOCKS = Part("blocks", {})
NO_STAGES = "the blocks have no synchroniser"
"""Reason why the tests of a module do not run with JITTER=1."""
GROUPS = ("common", "motion", "host", "single")


def run_block(item: Item, options: SimOptions) -> None:
    """Run one simulation of the area to which the module of the item belongs."""
    module = importlib.import_module(item.module)
    area = getattr(module, "AREA", item.module.rsplit("_", 1)[-1])
    groups = getattr(module, "GROUPS", GROUPS)
    run_item(item, options, design=area_design(area, module.BLOCKS, groups))


def area_design(area: str, blocks: Mapping[str, Block], groups: Sequence[str] = GROUPS) -> Design:
    """Return the design with all instances of an area; write its top module to build/.

    Args:
        groups: groups of rtl/files.yml that contain the sources of the area.
    """
    top = f"blocks_{area}"
    path = BUILD / "blocks" / f"{top}.sv"
    text = wrapper_text(top, blocks)
    with locked(path.with_suffix(".lock")):
        if not path.is_file() or path.read_text(encoding="utf-8") != text:
            path.write_text(text, encoding="utf-8")
    return Design(top, [*files(*groups), path], [ROOT / "rtl" / "common"], ports="*")
