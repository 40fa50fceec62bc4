"""`make site` prints a line for each stage and each WebAssembly module as soon as it begins."""

from __future__ import annotations

import os
import subprocess
import sys

import pytest

from cocotb_tests.harness.paths import ROOT
from scripts.site import __main__ as site
from scripts.site import export, pages
from scripts.site.webparts import BUILDS


@pytest.fixture
def quick(monkeypatch, tmp_path):
    """Replace all slow steps."""
    monkeypatch.setattr(pages, "node", lambda *words, folder=None: None)
    monkeypatch.setattr(pages, "packages", lambda folder: None)
    monkeypatch.setattr(pages.shutil, "copy", lambda source, to: None)
    monkeypatch.setattr(export, "export", lambda name: None)
    monkeypatch.setattr(site.wasm, "make", lambda *words: None)
    monkeypatch.setattr(export, "PLAYGROUND", tmp_path)
    monkeypatch.setattr(site, "stage", pages._made)
    monkeypatch.setattr(site.sheets, "make", lambda part: b"")
    monkeypatch.setattr(site.wasm, "OUT", tmp_path)
    done = subprocess.CompletedProcess([], 0, "", "")
    monkeypatch.setattr(site.subprocess, "run", lambda *words, **options: done)
    (tmp_path / "html").mkdir()
    return tmp_path


def test_each_stage_has_a_line(quick, capsys):
    """A build of the site announces each stage in order, and each module; two modules are built at a time."""
    site.build(out=quick / "html")
    lines = capsys.readouterr().out.splitlines()
    modules = [f"site: WebAssembly of {name}, {n} of {len(BUILDS)}" for n, name in enumerate(BUILDS, 1)]
    first = lines.index(modules[0])
    assert sorted(lines[first : first + len(modules)]) == sorted(modules)
    words = ["packages", "script", "WebAssembly", "MkDocs", "data sheet of ppmc104, 1 of 6"]
    at = [next((n for n, line in enumerate(lines) if word in line), -1) for word in words]
    assert -1 not in at and at == sorted(at), lines
    assert all(line.startswith("site: ") for line in lines)


def test_lines_arrive_through_a_pipe(tmp_path):
    """Through a pipe, a line arrives while the program still runs, so it is not held in a buffer."""
    ended = tmp_path / "ended"
    program = "import pathlib, sys, time; from scripts.site.progress import say; say('one'); time.sleep(5); "
    program += "pathlib.Path(sys.argv[1]).touch()"
    env = {name: value for name, value in os.environ.items() if name != "PYTHONUNBUFFERED"}
    command = [sys.executable, "-c", program, str(ended)]
    with subprocess.Popen(command, cwd=ROOT, env=env, stdout=subprocess.PIPE, text=True) as running:
        assert running.stdout is not None and running.stdout.readline() == "site: one\n"
        assert not ended.exists()
        running.kill()
