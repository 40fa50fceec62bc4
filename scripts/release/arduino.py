"""The Arduino library: the C drivers and drivers/arduino in the layout that the Arduino IDE reads (D-133).

`python -m scripts.release.arduino` writes it to build/arduino/OpenPPMC, `make release` to an archive.
"""

from __future__ import annotations

import shutil
from pathlib import Path

from cocotb_tests.harness import project
from cocotb_tests.harness.project import BUILD, ROOT, console, relative
from openppmc import __version__
from scripts.release.archive import zipped
from scripts.release.state import Release

NAME = "OpenPPMC"
OWN, DRIVERS = ROOT / "drivers" / "arduino", ROOT / "drivers" / "c"
NOT_HERE = ("stmc_ports.h",)
"""Files of the C drivers that only a PC can use."""


def files(version: str = __version__) -> dict[str, Path | bytes]:
    """Return each file of the library, or its content, by the name below the folder of the library."""
    found: dict[str, Path | bytes] = {
        path.relative_to(OWN).as_posix(): path
        for pattern in ("src/*", "examples/*/*.ino")
        for path in sorted(OWN.glob(pattern))
    }
    drivers = [path for path in sorted(DRIVERS.glob("*.[ch]")) if path.name not in NOT_HERE]
    found |= {f"src/{path.name}": path for path in drivers}
    properties = (OWN / "library.properties").read_text(encoding="utf-8")
    found["library.properties"] = f"{properties}version={version}\n".encode()
    return {**found, "LICENSE": ROOT / "LICENSE"}


def write(folder: Path = BUILD / "arduino") -> Path:
    """Write the library into a folder; return the path of the library."""
    library = folder / NAME
    shutil.rmtree(library, ignore_errors=True)
    for name, source in files().items():
        target = library / name
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_bytes(source if isinstance(source, bytes) else source.read_bytes())
    return library


def make(release: Release, out: Path, scratch: Path) -> None:
    """Write the archive to `out`, for *Add .ZIP Library* of the Arduino IDE."""
    version = release.version.partition("+")[0]
    packed = {f"{NAME}/{name}": source for name, source in files(version).items()}
    zipped(out / release.name("arduino", ".zip"), packed, release.epoch)


def main() -> int:
    """Write the library; print its path."""
    console.print(relative(write()))
    return 0


if __name__ == "__main__":
    raise SystemExit(project.run(main, ""))
