"""Convert timing diagrams and bit fields from WaveDrom JSON to a small, reproducible SVG."""

from __future__ import annotations

import json
import math
import re
import xml.etree.ElementTree as ET
from pathlib import Path
from typing import Any

import wavedrom
from wavedrom.waveskin import WaveSkin

from scripts.pages.pictures.diagram_breaks import SVG, step_aside
from scripts.pages.pictures.diagram_width import EDGE, MOST, fitted, names, step_of, text_width
from scripts.pages.pictures.diagram_width import width as lines

XLINK = "http://www.w3.org/1999/xlink"
FONTS = "Helvetica, Arial, 'DejaVu Sans', sans-serif"
# Labels are larger and numbers darker. Sizes are in px, because some viewers do not know the dpi.
STYLES = (
    ("font-family:Helvetica", f"font-family:{FONTS}"),
    ('font-family="sans-serif"', f'font-family="{FONTS}"'),
    ("text{font-size:11pt", "text{font-size:13px"),
    ("font-size:8px", "font-size:11px"),
    (".muted{fill:#aaa}", ".muted{fill:#444;font-size:12px}"),
)
REF = re.compile(r"url\(#([^)]+)\)")
LABEL_GROWTH = 1.5  # growth of the white area below a label: WaveDrom's area fits labels without STYLES


def _referenced(root: ET.Element) -> set[str]:
    """Return all ids that `root` uses, in use elements and in url(#id) markers of styles."""
    found: set[str] = set()
    for node in root.iter():
        for name, value in node.attrib.items():
            if name.endswith("href"):
                found.add(value.lstrip("#"))
            found.update(REF.findall(value))
    return found


def _style(root: ET.Element) -> None:
    """Set the colours of the default skin; pieces of waveforms have the same numbers in the narrow skin."""
    for style in root.iter(f"{{{SVG}}}style"):
        style.text = WaveSkin["default"][2][2]


def _texts_whole(root: ET.Element, drawing: dict[str, Any]) -> None:
    """Enlarge the picture if its names, head or foot are wider than WaveDrom assumes."""
    (lanes,) = (node for node in root.iter() if node.get("id") == "lanes_0")
    (marks,) = (node for node in root.iter() if node.get("id") == "gmarks_0")
    _, _, y = lanes.get("transform", "").rstrip(")").partition(",")
    before = names(drawing)
    lanes.set("transform", f"translate({before:g},{y})")
    titles = [node for node in marks if node.tag.endswith("text") and node.get("class") is None]
    needed = [text_width("".join(node.itertext())) + EDGE for node in titles]
    width = max([lines(drawing, step_of(drawing)), *needed])
    if width > MOST:
        raise ValueError(f"{width:.0f} px wide with head and foot, at most {MOST}")
    for node, long in zip(titles, needed, strict=True):
        middle = float(node.get("x", "0")) + before
        node.set("x", f"{min(max(middle, long / 2), width - long / 2) - before:.1f}")
    root.set("width", f"{math.ceil(width)}")
    root.set("viewBox", f"0,0,{math.ceil(width)},{root.get('height')}")


def _tidy(svg: str, drawing: dict[str, Any]) -> str:
    """Remove unused pieces of waveforms, add a white background, use fonts that exist everywhere."""
    ET.register_namespace("", SVG)
    ET.register_namespace("xlink", XLINK)
    root = ET.fromstring(svg)
    if "signal" in drawing:
        _style(root)
        _texts_whole(root, drawing)
        step_aside(root, drawing["signal"], step_of(drawing))
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


def draw(drawing: dict[str, Any], name: str) -> bytes:
    """Return the SVG of a WaveDrom drawing; raise ValueError with `name` if it is not valid or too wide."""
    try:
        drawing = fitted(drawing)
        drawn = wavedrom.render(json.dumps(drawing))
        if drawn is None:
            raise ValueError("neither a signal nor a reg diagram")
        return _tidy(drawn.tostring(), drawing).encode()
    except (ValueError, KeyError, IndexError) as error:
        raise ValueError(f"{name}: {error}") from error


def render(source: Path) -> bytes:
    """Return the SVG of one WaveDrom JSON file; raise ValueError with its name if it is not valid."""
    try:
        drawing = json.loads(source.read_text(encoding="utf-8"))
    except ValueError as error:
        raise ValueError(f"{source.name}: {error}") from error
    return draw(drawing, source.name)
