"""Timing diagrams and bit fields: WaveDrom JSON to a small, stand-alone SVG that is the same on each run."""

from __future__ import annotations

import json
import re
import xml.etree.ElementTree as ET
from pathlib import Path
from typing import Any

import wavedrom

SVG = "http://www.w3.org/2000/svg"
XLINK = "http://www.w3.org/1999/xlink"
FONTS = "Helvetica, Arial, 'DejaVu Sans', sans-serif"
# Pixels instead of points (not every viewer knows the dpi), larger labels, darker tick numbers.
STYLES = (
    ("font-family:Helvetica", f"font-family:{FONTS}"),
    ('font-family="sans-serif"', f'font-family="{FONTS}"'),
    ("text{font-size:11pt", "text{font-size:13px"),
    ("font-size:8px", "font-size:11px"),
    (".muted{fill:#aaa}", ".muted{fill:#444;font-size:12px}"),
)
REF = re.compile(r"url\(#([^)]+)\)")
LABEL_GROWTH = 1.5  # the white sheet below an arrow's label is measured for its size before STYLES


def _referenced(root: ET.Element) -> set[str]:
    """Every id that `root` points at, by use elements and by url(#id) markers in styles."""
    found: set[str] = set()
    for node in root.iter():
        for name, value in node.attrib.items():
            if name.endswith("href"):
                found.add(value.lstrip("#"))
            found.update(REF.findall(value))
    return found


def _tidy(svg: str) -> str:
    """Drop the unused bricks, put a white sheet below the drawing and name fonts that exist everywhere."""
    ET.register_namespace("", SVG)
    ET.register_namespace("xlink", XLINK)
    root = ET.fromstring(svg)
    wanted = _referenced(root)
    for defs in root.iter(f"{{{SVG}}}defs"):
        for brick in list(defs):
            if brick.get("id") not in wanted:
                defs.remove(brick)
    for plate in root.iter(f"{{{SVG}}}rect"):
        if plate.get("style") == "fill:#FFF;":
            width = float(plate.get("width", "0")) * LABEL_GROWTH
            plate.attrib |= {"width": f"{width:.1f}", "x": f"{-width / 2:.1f}", "height": "12", "y": "-6"}
    sheet = ET.Element(f"{{{SVG}}}rect", {"width": "100%", "height": "100%", "fill": "white"})
    root.insert(0, sheet)
    text = ET.tostring(root, encoding="unicode")
    for old, new in STYLES:
        text = text.replace(old, new)
    return re.sub(r">\s*<g ", ">\n<g ", text).rstrip() + "\n"


def draw(drawing: Any, name: str) -> bytes:
    """The SVG of a WaveDrom drawing; ValueError begins with `name` when it is not a valid one."""
    try:
        drawn = wavedrom.render(json.dumps(drawing))
    except (ValueError, KeyError, IndexError) as error:
        raise ValueError(f"{name}: {error}") from error
    if drawn is None:
        raise ValueError(f"{name}: neither a signal nor a reg diagram")
    return _tidy(drawn.tostring()).encode()


def render(source: Path) -> bytes:
    """The SVG of one WaveDrom JSON file; ValueError names the file when it is not a valid diagram."""
    try:
        drawing = json.loads(source.read_text(encoding="utf-8"))
    except ValueError as error:
        raise ValueError(f"{source.name}: {error}") from error
    return draw(drawing, source.name)
