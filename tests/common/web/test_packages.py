"""The npm packages are installed once, even if two processes need them at the same time."""

from __future__ import annotations

import os
from concurrent.futures import ThreadPoolExecutor

from scripts.site.pages import packages

NPM = """#!/bin/sh
rm -rf node_modules; mkdir node_modules; sleep 0.3
test -d node_modules && echo made >> installed
"""


def test_two_at_once(tmp_path, monkeypatch):
    """If two processes request the packages at the same time, one installs them and the other waits."""
    folder = tmp_path / f"page{os.getpid()}"
    folder.mkdir()
    (folder / "package-lock.json").write_text("{}", encoding="utf-8")
    tool = tmp_path / "bin/npm"
    tool.parent.mkdir()
    tool.write_text(NPM, encoding="utf-8")
    tool.chmod(0o755)
    monkeypatch.setenv("PATH", f"{tool.parent}{os.pathsep}{os.environ['PATH']}")
    with ThreadPoolExecutor(2) as both:
        list(both.map(packages, [folder, folder]))
    assert (folder / "installed").read_text(encoding="utf-8") == "made\n"
    assert (folder / "node_modules/.openppmc").is_file()
