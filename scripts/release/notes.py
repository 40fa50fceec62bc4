"""The release notes (section of CHANGELOG.md, missing files, descriptions of files), and file digests."""

from __future__ import annotations

import hashlib
from pathlib import Path

from scripts.release.state import Release

NOTES = "RELEASE_NOTES.md"
SUMS = "SHA256SUMS"
WHAT = (
    ("-py3-none-any.whl", "Python package: `pip install` this file"),
    ("-verilog-", "each part, bridge and board as one file of plain Verilog-2005, with default parameters"),
    ("-rtl-", "SystemVerilog with FuseSoC cores, Bender manifest, lists for vendor tools, C drivers"),
    ("-arduino-", "library for the Arduino IDE: Sketch → Include Library → Add .ZIP Library"),
    ("-bitstreams-", "bitstreams of the boards, each with its report"),
    ("-site-", "all documents and the playground, for use as local files"),
    (".pdf", "data sheet"),
    (".cdx.json", "bill of materials (CycloneDX)"),
    (".tar.gz", "Python package as sources"),
)


def notes(release: Release, names: list[str]) -> str:
    """Return the notes of a release with these files."""
    rows = [(name, next((text for word, text in WHAT if word in name), "")) for name in names]
    lines = [f"# OpenPPMC {release.version}", ""]
    if release.trial:
        lines += ["**Trial, not a release.** Do not publish it.", ""]
    lines += [release.notes, ""]
    if release.missing:
        lines += ["## Not in this release", "", *(f"- {text}" for text in release.missing), ""]
    lines += ["## Files", "", *(f"- `{name}`: {text}" for name, text in rows), ""]
    how = (
        "The same commit gives the same bytes: `make release`, then "
        f"compare with `{SUMS}` (`sha256sum -c {SUMS}`)."
    )
    lines += [f"Made from commit {release.commit}." + ("" if release.trial else f" {how}"), ""]
    return "\n".join(lines)


def make(release: Release, out: Path, scratch: Path) -> None:
    """Write notes and digests of all files in `out`."""
    names = sorted(path.name for path in out.iterdir())
    (out / NOTES).write_text(notes(release, names), encoding="utf-8")
    rows = [
        f"{hashlib.sha256((out / name).read_bytes()).hexdigest()}  {name}" for name in sorted([*names, NOTES])
    ]
    (out / SUMS).write_text("\n".join([*rows, ""]), encoding="ascii")
