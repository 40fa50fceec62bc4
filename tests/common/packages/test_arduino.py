"""The Arduino library: its layout, and its examples on the Verilated part with stubs of Arduino."""

from __future__ import annotations

import re
import shutil
import zipfile
from pathlib import Path

import pytest

from cocotb_tests.harness.build import Design
from cocotb_tests.harness.paths import BUILD, ROOT
from cocotb_tests.harness.project import files, include_dirs
from openppmc import __version__
from openppmc.model.single.predict import predict_move
from scripts.release import arduino
from tests.common.packages.c_programs import DRIVER, WARNINGS, Lines, pulses, run, simulate
from tests.common.packages.test_installed import PROJECT
from tests.common.packages.test_release import release

pytestmark = pytest.mark.xdist_group("arduino")  # one worker writes the library and builds the programs

STUB = ROOT / "tb" / "arduino"
CXX = ["g++", "-std=c++11", *WARNINGS, "-fsyntax-only", "-x", "c++"]
INIT = bytes([59, 39, 6, 0])
# Rules of Arduino's library specification.
CATEGORIES = {
    *("Display", "Communication", "Signal Input/Output", "Sensors", "Device Control", "Timing"),
    *("Data Storage", "Data Processing", "Other"),
}
FIELDS = {"name", "version", "author", "maintainer", "sentence", "paragraph", "category", "architectures"}
EXAMPLES = {"BankSpi": ("bank_spi.cpp", "ppmc_bank_carrier"), "ParallelBus": ("parallel_bus.cpp", "ppmc104")}


@pytest.fixture(scope="module")
def library() -> Path:
    """Write the library."""
    return arduino.write(BUILD / "test" / "arduino")


def test_properties(library):
    """The properties follow the specification; the address is missing while the project has no address."""
    lines = (library / "library.properties").read_text(encoding="utf-8").splitlines()
    found = dict(line.split("=", 1) for line in lines)
    assert len(found) == len(lines) and all(found.values())
    assert FIELDS <= found.keys() <= FIELDS | {"url", "license", "includes"}
    assert ("url" in found) == ("urls" in PROJECT)
    assert re.fullmatch(r"[A-Za-z][\w .-]{0,62}", found["name"]) and found["name"] == library.name
    assert "arduino" not in (found["name"] + found["author"] + found["maintainer"]).lower()
    assert found["version"] == __version__ and re.fullmatch(r"\d+\.\d+\.\d+", found["version"])
    assert found["category"] in CATEGORIES and found["architectures"] == "*"
    assert found["license"] == PROJECT["license"]
    assert not found["paragraph"].startswith(found["sentence"])
    assert all((library / "src" / name).is_file() for name in found["includes"].split(","))


def test_layout(library):
    """The library has sources only in src/, a folder with one sketch for each example, and no old layout."""
    assert {path.name for path in library.iterdir()} == {"library.properties", "LICENSE", "src", "examples"}
    names = {path.name for path in (library / "src").iterdir()}
    assert names == {path.name for path in DRIVER.glob("*.[ch]")} - {"stmc_ports.h"} | {"OpenPPMC.h"}
    for path in (library / "src").iterdir():
        included = set(re.findall(r'^#include "(.+)"', path.read_text(), re.M))
        assert included <= names, path.name
    sketches = [path.relative_to(library / "examples") for path in library.glob("examples/**/*.*")]
    assert {path.as_posix() for path in sketches} == {f"{name}/{name}.ino" for name in EXAMPLES}


def test_archive(tmp_path):
    """The archive of a release contains the library as one folder, without the mark of a trial."""
    arduino.make(release(version="1.2.0+trial"), tmp_path, tmp_path)
    with zipfile.ZipFile(tmp_path / "openppmc-arduino-1.2.0+trial.zip") as packed:
        names = packed.namelist()
        properties = packed.read("OpenPPMC/library.properties").decode()
    assert set(names) == {f"OpenPPMC/{name}" for name in arduino.files()}
    assert properties.endswith("\nversion=1.2.0\n")


@pytest.mark.parametrize("name", EXAMPLES)
def test_no_warning(library, name):
    """Library and example compile as C++11 without a warning."""
    sketch = library / "examples" / name / f"{name}.ino"
    assert run(*CXX, f"-I{library / 'src'}", f"-I{STUB}", sketch) == ""


@pytest.mark.skipif(
    not shutil.which("avr-gcc"), reason="avr-gcc is not installed (gcc-avr and avr-libc of Debian)"
)
def test_with_16_bits(library, tmp_path):
    """The drivers compile for a controller whose int has 16 bits."""
    options = ["-mmcu=atmega328p", "-Os", "-Wall", "-Wextra", "-Werror", f"-I{library / 'src'}", "-c"]
    for source in sorted((library / "src").glob("*.c")):
        run("avr-gcc", "-std=gnu11", *options, source, "-o", tmp_path / "out.o")


def lines(library: Path, name: str, *words: str) -> Lines:
    """Return the output of an example on the simulated part."""
    program, top = EXAMPLES[name]
    group = "ppmc_bank_carrier" if name == "BankSpi" else "ppmc104"
    sources = sorted((library / "src").glob("ppmc104.c")) + sorted((library / "src").glob("ppmc_bank.c"))
    params = {"BankSpi": ("-GAXES=4", "-GCLK_HZ=16000000", '-GHOST="SPI"'), "ParallelBus": ()}[name]
    folders = (library / "src", library / "examples" / name, STUB)
    design = Design(top, files(group), include_dirs())
    return simulate(f"arduino_{name}", top, design, [*sources, STUB / program], params, folders, words)


def test_bank_on_spi(library):
    """Two axes start together and move to and fro; pulses and positions are those of the golden model."""
    found = lines(library, "BankSpi")
    assert [(line["x"], line["y"]) for line in found["position"]] == [("200", "50"), ("0", "0")]
    for axis, count in (("x", 200), ("y", 50)):
        there, back = found[axis]
        assert (there["cw"], there["ccw"], back["cw"], back["ccw"]) == (str(count), "0", "0", str(count))
        for way in (there, back):
            assert pulses({axis: [way]}, axis)[2] == predict_move(INIT, count).intervals
    first = [[line["at"].split()[0] for line in found[axis]] for axis in "xy"]
    assert first[0] == first[1]


def test_part_on_a_bus(library):
    """The part moves with the pulses of the golden model, and the data lines never have two drivers."""
    found = lines(library, "ParallelBus")
    assert [line["left"] for line in found["moved"]] == ["0", "0"]
    there, back = found["axis"]
    assert (there["cw"], there["ccw"], back["cw"], back["ccw"]) == ("200", "0", "0", "200")
    for way in (there, back):
        assert pulses({"axis": [way]}, "axis")[2] == predict_move(INIT, 200).intervals


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("BankSpi", "SPI: no bridge; check the wires, and select sck <= clk / 8"),
        ("ParallelBus", "part: time-out: no part answers, check address, wiring and reset"),
    ],
)
def test_nothing_is_connected(library, name, said):
    """If no part responds, the example reports it in one line and moves no motor."""
    found = lines(library, name, "absent")
    assert said in found and "stopped" in found and not {"x", "axis"} & found.keys()
