"""Reader of docs/<folder>/figures.yml, which describes the tables and pictures of the pages of a folder.

An entry of `tables` has the name of its marker in README.md; an entry of `pictures` has the name of the
picture's file in img/. The `kind` of an entry is a function below scripts.pages, which is called with the
other values of the entry. The function returns Markdown for a table, and a matplotlib figure or a WaveDrom
drawing for a picture.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import yaml

from cocotb_tests.harness.project import DOCS, ProjectError, relative, replace_between
from scripts.pages.pictures import plots, waves
from scripts.pages.pictures.kinds import made


def entries(folder: str) -> dict[str, dict[str, Any]]:
    """Return the sections of a folder's figures.yml."""
    found: dict[str, Any] = yaml.safe_load((DOCS / folder / "figures.yml").read_text(encoding="utf-8"))
    return found


def drawn(entry: dict[str, Any], name: str) -> bytes:
    """Return the SVG of an entry of `pictures`."""
    with plots.style():
        picture = made(entry)
        return waves.draw(picture, name) if isinstance(picture, dict) else plots.svg(picture)


def pages(folder: str) -> dict[Path, bytes]:
    """Return path and content of the files that a figures.yml describes; raise ProjectError for a mistake."""
    files: dict[Path, bytes] = {}
    place = DOCS / folder
    name = "file"
    try:
        found = entries(folder)
        for name, entry in found.get("pictures", {}).items():
            files[place / "img" / f"{name}.svg"] = drawn(entry, name)
        if "tables" in found:
            text = (place / "README.md").read_text(encoding="utf-8")
            for name, entry in found["tables"].items():
                text = replace_between(text, name, made(entry))
            files[place / "README.md"] = text.encode()
    except (yaml.YAMLError, AttributeError, ImportError, KeyError, TypeError, ValueError) as error:
        text = " ".join(str(error).split())
        raise ProjectError(f"{relative(place)}/figures.yml: {name}: {text}") from error
    return files
