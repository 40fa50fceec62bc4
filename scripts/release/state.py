"""Version, commit and time of a release, and the checks of the checkout."""

from __future__ import annotations

import re
import subprocess
from dataclasses import dataclass, field
from pathlib import Path

from cocotb_tests.harness.project import ROOT, ProjectError
from openppmc import __version__

CHANGELOG = ROOT / "CHANGELOG.md"
_HEADING = re.compile(r"^## \[([^\]\n]+)\].*$", re.M)


@dataclass
class Release:
    """A release.

    Attributes:
        version: version number without the letter v.
        commit: hexadecimal hash of the commit.
        epoch: time of the commit in s; every file of the release has this time.
        missing: one sentence for each missing file, for the notes.
        only: names of the built bitstreams; all bitstreams if it is empty.
        trial: True if the release must not be published; its version ends in +trial.
    """

    version: str
    commit: str
    epoch: int
    notes: str
    only: tuple[str, ...] = ()
    missing: list[str] = field(default_factory=list)
    trial: bool = False

    def name(self, what: str, suffix: str) -> str:
        """Return the file name of an item of the release, such as openppmc-site-1.2.3.tar.gz."""
        return f"openppmc-{what}-{self.version}{suffix}"


def git(*words: str) -> str:
    """Return the output of git; raise ProjectError with its last line if it fails or is not installed."""
    try:
        done = subprocess.run(["git", *words], cwd=ROOT, capture_output=True, text=True, check=False)
    except FileNotFoundError:
        raise ProjectError("git is not installed") from None
    if done.returncode:
        raise ProjectError(f"git {words[0]}: {(done.stderr.strip().splitlines() or ['failed'])[-1]}")
    return done.stdout.strip()


def section(changelog: str, version: str, trial: bool = False) -> str:
    """Return the text below the newest heading of a changelog.

    The call raises ProjectError unless this heading names the version.

    A section [Unreleased] without text may precede it. In a trial, this section may have text, which is
    returned.
    """
    found = list(_HEADING.finditer(changelog))
    ends = [match.start() for match in found[1:]] + [len(changelog)] * bool(found)
    parts = [(match[1], changelog[match.end() : end].strip()) for match, end in zip(found, ends, strict=True)]
    if parts and parts[0][0] == "Unreleased":
        if parts[0][1]:
            if trial:
                return parts[0][1]
            raise ProjectError(
                f"CHANGELOG.md: give what is below [Unreleased] the heading [{version}]; "
                "a trial needs SKIP= or ONLY="
            )
        del parts[0]
    newest = parts[0][0] if parts else "none"
    if newest != version:
        raise ProjectError(f"version {version}, but the newest heading of CHANGELOG.md is [{newest}]")
    if not parts[0][1]:
        raise ProjectError(f"CHANGELOG.md has no text below [{version}]")
    return parts[0][1]


def check_tag(version: str, commit: str, tagged: str) -> None:
    """Raise ProjectError if the git tag of this version is on another commit.

    Args:
        tagged: commit that has the tag of this version, or "".
    """
    if tagged and tagged != commit:
        raise ProjectError(f"v{version} exists already, on {tagged[:10]}, and this is {commit[:10]}")


def current_release(only: tuple[str, ...] = (), trial: bool = False) -> Release:
    """Return the release of this checkout; raise ProjectError if the checkout cannot be released.

    A trial only needs a commit: text below [Unreleased] and a tag of the version on another commit are
    permitted.
    """
    changed = git("status", "--porcelain").splitlines()
    if changed:
        raise ProjectError(f"{changed[0][2:].strip()} is not committed; a release needs a clean commit")
    commit = git("rev-parse", "HEAD")
    name = f"refs/tags/v{__version__}"
    if not trial:
        tagged = git("rev-parse", f"{name}^{{commit}}") if git("tag", "-l", name[10:]) else ""
        check_tag(__version__, commit, tagged)
    notes = section(CHANGELOG.read_text(encoding="utf-8"), __version__, trial)
    # This is a local version (PEP 440), which PyPI rejects.
    version = f"{__version__}+trial" if trial else __version__
    return Release(version, commit, int(git("log", "-1", "--format=%ct")), notes, only, trial=trial)


def tracked(*below: str) -> list[Path]:
    """Return the files in git below these names, sorted, relative to the root."""
    return sorted(Path(name) for name in git("ls-files", "--", *below).splitlines())
