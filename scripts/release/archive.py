"""Archives whose bytes depend only on their contents: order, times, owners and modes are fixed."""

from __future__ import annotations

import gzip
import io
import tarfile
import zipfile
from collections.abc import Mapping
from datetime import datetime, timezone
from pathlib import Path

MODE = 0o644


def files_below(folder: Path) -> dict[str, Path]:
    """Return all files below a folder, by their names in the archive."""
    found = (path for path in folder.rglob("*") if path.is_file())
    return {path.relative_to(folder).as_posix(): path for path in found}


def tar_gz(target: Path, files: Mapping[str, Path | bytes], epoch: int) -> None:
    """Write a .tar.gz with these names; executable files stay executable."""
    with target.open("wb") as raw, gzip.GzipFile("", "wb", 9, raw, mtime=0) as packed:
        with tarfile.open(fileobj=packed, mode="w", format=tarfile.PAX_FORMAT) as tar:
            for name, source in sorted(files.items()):
                data = source if isinstance(source, bytes) else source.read_bytes()
                info = tarfile.TarInfo(name)
                info.size, info.mtime = len(data), epoch
                info.mode = MODE | (
                    0o111 if isinstance(source, Path) and source.stat().st_mode & 0o100 else 0
                )
                tar.addfile(info, io.BytesIO(data))


def zipped(target: Path, files: Mapping[str, Path | bytes], epoch: int) -> None:
    """Write a .zip with these names."""
    when = datetime.fromtimestamp(epoch, timezone.utc).timetuple()[:6]
    with zipfile.ZipFile(target, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as packed:
        for name, source in sorted(files.items()):
            info = zipfile.ZipInfo(name, when)
            info.create_system, info.external_attr = 3, (0o100000 | MODE) << 16
            info.compress_type = zipfile.ZIP_DEFLATED
            packed.writestr(info, source if isinstance(source, bytes) else source.read_bytes())


def again(path: Path, epoch: int) -> None:
    """Repack a .tar.gz in place with fixed order, times, owners and modes."""
    with tarfile.open(path) as tar:
        members = [member for member in tar.getmembers() if member.isfile()]
        files = {member.name: tar.extractfile(member).read() for member in members}  # type: ignore[union-attr]
    tar_gz(path, files, epoch)
