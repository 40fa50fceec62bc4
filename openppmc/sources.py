"""Reader of rtl/files.yml, the list of all RTL sources. It does not require a YAML package.

Every line of the file must have one of these forms:

    group:
      about: description, one line
      needs: [groups whose modules and packages its files use]
      files:
        - path below rtl/
"""

from __future__ import annotations

import hashlib
import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from openppmc.errors import PpmcError

LIST = "rtl/files.yml"
_COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/|\"(?:\\.|[^\"\\\n])*\"", re.S)
_OWN = re.compile(r"^\s*(?:module|package|interface)\s+(?:automatic\s+|static\s+)?(\w+)", re.M)

# The name of a package is followed by `::`, the name of a module by its parameters or its instance name.
_USED = re.compile(r"\b(\w+)(?=\s*::|\s*#\s*\(|\s+\w+\s*\()")


class SourcesError(PpmcError):
    """Error in rtl/files.yml: it is missing or malformed, or names a group or file that does not exist.

    The message is one line.
    """


@dataclass(frozen=True)
class Group:
    """One group of the list.

    It has a description, the groups that its files use, and its files in compile order.
    """

    name: str
    about: str
    needs: tuple[str, ...]
    files: tuple[Path, ...]


def groups(root: Path) -> dict[str, Group]:
    """Return all groups of the checkout `root`, in compile order; paths are absolute.

    Raises:
        SourcesError: the list is missing, or a line has another form.
    """
    listing = root / LIST
    if not listing.is_file():
        raise SourcesError(f"{LIST} is missing: there is no list of RTL sources")
    found: dict[str, Group] = {}
    name, about, needs = "", "", tuple[str, ...]()
    files: list[Path] = []
    for number, line in enumerate(listing.read_text(encoding="utf-8").splitlines(), 1):
        if not line.strip() or line.lstrip().startswith("#"):
            continue
        if match := re.fullmatch(r"(\w+):", line):
            name, about, needs, files = match[1], "", (), []
        elif name and (match := re.fullmatch(r"  about: (\S.*)", line)):
            about = match[1]
        elif name and (match := re.fullmatch(r"  needs: \[([\w, ]*)\]", line)):
            needs = tuple(match[1].replace(",", " ").split())
        elif name and (match := re.fullmatch(r"    - (\S+)", line)):
            files.append(root / "rtl" / match[1])
        elif not (name and line == "  files:"):
            raise SourcesError(f"{LIST}:{number}: not in the form of this list: {line.strip()}")
        found[name] = Group(name, about, needs, tuple(files))
    for group in found.values():
        if strange := [need for need in group.needs if need not in found]:
            raise SourcesError(f"{LIST}: {group.name} needs {strange[0]}, which is no group")
    return found


def needed(listed: Mapping[str, Group], *names: str) -> list[str]:
    """Return these groups and all groups that they need, in compile order. Raises SourcesError."""
    found, todo = set[str](), list(names)
    while todo:
        name = todo.pop()
        if name not in listed:
            raise SourcesError(f"{LIST} has no group {name}")
        if name not in found:
            found.add(name)
            todo += listed[name].needs
    return [name for name in listed if name in found]


def files(listed: Mapping[str, Group], *names: str) -> list[Path]:
    """Return the files of these groups and of all groups that they need, in compile order.

    Raises:
        SourcesError: a file is missing.
    """
    found = [path for name in needed(listed, *names) for path in listed[name].files]
    if missing := [path.name for path in found if not path.is_file()]:
        raise SourcesError(f"{LIST} lists files that do not exist: {', '.join(missing)}")
    return found


DIGEST_BYTES = 4


def digest(root: Path, *names: str) -> bytes:
    """Return the digest (4 bytes) of the sources of these groups and of all groups that they need.

    Raises:
        SourcesError: a file is missing.
    """
    sha = hashlib.sha256()
    for path in [*files(groups(root), *names), *sorted((root / "rtl/common").glob("*.svh"))]:
        sha.update(path.name.encode() + b"\0" + path.read_bytes().replace(b"\r", b"") + b"\0")
    return sha.digest()[:DIGEST_BYTES]


def build_id(
    version: str, source: bytes, commit: bytes = b"", changed: bool = False, board: str = ""
) -> bytes:
    """Return the build ID of a bitstream, 16 bytes (UB-VER-01).

    Args:
        source: digest of the sources.
        commit: first bytes of the commit.
        changed: True if the sources have uncommitted changes.
        board: 4 letters.
    """
    numbers = bytes(int(word) for word in version.split(".")[:3])
    words = (numbers + bytes([changed]), source, commit[:DIGEST_BYTES], board.encode("ascii"))
    return b"".join(word.ljust(4, b"\0")[:4] for word in words)


def build_define(build: bytes) -> str:
    """Return the macro with these bytes for the RTL (ppmc_build_pkg)."""
    return f"PPMC_BUILD=128'h{int.from_bytes(build, 'little'):032x}"


def walls(listed: Mapping[str, Group]) -> list[str]:
    """Return the errors in the lists `needs` of the groups, one line for each error.

    It is an error if a file uses a module or package of a group that is not in `needs`, or if a group in
    `needs` is not used.
    """
    texts = {
        path: _COMMENT.sub(" ", path.read_text(encoding="utf-8"))
        for group in listed.values()
        for path in group.files
        if path.is_file()
    }
    owner = {
        name: group.name
        for group in listed.values()
        for path in group.files
        for name in _OWN.findall(texts.get(path, ""))
    }
    wrong = []
    for group in listed.values():
        used = set[str]()
        for path in group.files:
            for name in sorted(set(_USED.findall(texts.get(path, ""))) & owner.keys()):
                used.add(owner[name])
                if owner[name] not in (group.name, *group.needs):
                    wrong.append(
                        f"rtl/{_below(path)}: {name} is in {owner[name]}, which {group.name} does not need"
                    )
        for need in group.needs:
            if need not in used:
                wrong.append(f"{LIST}: {group.name} names nothing of {need}, which it needs")
    return wrong


def _below(path: Path) -> str:
    """Return the path below rtl/, with slashes, as the list of sources contains it."""
    parts = path.parts
    return "/".join(parts[len(parts) - parts[::-1].index("rtl") :])
