"""The C program of docs/isa_4axis.md, compiled and run against two golden models behind the registers."""

from __future__ import annotations

import ctypes
import re
import subprocess
from collections.abc import Callable

import pytest

from cocotb_tests.common.paths import ROOT
from openppmc.model.ppmc2104 import Ppmc2104

from .setting import BASE, SOURCE

PAGE = ROOT / "docs" / "isa_4axis.md"
CONIO = "int inp(unsigned short port); int outp(unsigned short port, int byte);\n"
STUBS = """
#include <conio.h>
int (*on_inp)(int); int (*on_outp)(int, int); int (*on_run)(int);
int inp(unsigned short port) { return on_inp(port); }
int outp(unsigned short port, int byte) { return on_outp(port, byte); }
void run(int high) { on_run(high); }
"""
# Extensions of the DOS compilers; nothing is static, so that the test can call it.
DEFINES = ("-Dinterrupt=", "-Dfar=", "-Dstatic=", "-Dmain=program")
LATEST = 10_000_000
ACCESS = 64  # clk from one access of the bus to the next


class Module:
    """Two golden models behind one base address, as the program's inp and outp see them."""

    def __init__(self) -> None:
        self.t = 100
        self.parts = [Ppmc2104(), Ppmc2104()]
        self.late = 0

    def inp(self, port: int) -> int:
        """A read cycle."""
        self.t += ACCESS
        if self.t > LATEST:
            self.late += 1
            return 0xFF * (self.late & 1)  # ends every loop of the program that would not end by itself
        if port == SOURCE:
            for part in self.parts:
                part.run_until(self.t)
            return sum((not part.outputs["int_n"]) << number for number, part in enumerate(self.parts))
        number, reg = divmod(port - BASE, 2)
        return self.parts[number].read(self.t, reg)

    def outp(self, port: int, byte: int) -> int:
        """A write cycle, or the end of interrupt."""
        self.t += ACCESS
        if port != 0x20:
            number, reg = divmod(port - BASE, 2)
            self.parts[number].write(self.t, reg, byte)
        return 0

    def run(self, high: int) -> int:
        """All RUN pins."""
        self.t += ACCESS
        for part in self.parts:
            part.pins(self.t, run=0b11 * high)
        return 0


@pytest.fixture
def program(tmp_path) -> tuple[ctypes.CDLL, Module, list[Callable[..., int]]]:
    """The compiled program, what it talks to, and its callbacks (which must stay alive)."""
    blocks = re.findall(r"^```c\n(.*?)^```$", PAGE.read_text(encoding="utf-8"), re.S | re.M)
    assert len(blocks) == 2
    (tmp_path / "conio.h").write_text(CONIO)
    (tmp_path / "stubs.c").write_text(STUBS)
    (tmp_path / "program.c").write_text("\n".join(blocks))
    command = [
        "gcc",
        "-std=c99",
        "-Wall",
        "-Wextra",
        "-Werror",
        "-shared",
        "-fPIC",
        *DEFINES,
        f"-I{tmp_path}",
    ]
    # The C library has a `send` of its own.
    command += ["-Wl,-Bsymbolic", "program.c", "stubs.c", "-o", "program.so"]
    done = subprocess.run(command, cwd=tmp_path, text=True, check=False, capture_output=True)
    assert not done.returncode, done.stderr
    library, module = ctypes.CDLL(str(tmp_path / "program.so")), Module()
    callbacks = []
    for name, function, count in (
        ("inp", module.inp, 1),
        ("outp", module.outp, 2),
        ("run", module.run, 1),
    ):
        callback = ctypes.CFUNCTYPE(ctypes.c_int, *[ctypes.c_int] * count)(function)
        ctypes.c_void_p.in_dll(library, f"on_{name}").value = ctypes.cast(callback, ctypes.c_void_p).value
        callbacks.append(callback)
    return library, module, callbacks


def test_program_moves_all_axes(program):
    """Given the program, then axis 3 moves 1000 pulses alone, and after RUN all four start on one clk."""
    library, module, _ = program
    assert library.program() == 0
    assert not module.late, "the program polls for ever"
    a, b = module.parts
    counts = [len(part.pulses(axis)) for part in (a, b) for axis in (1, 2)]
    assert counts == [1000, 1000, 2000, 1000]
    starts = [part.pulses(axis)[-1000] for part in (a, b) for axis in (1, 2)]
    assert len(set(starts)) == 1, f"first falls at {starts}"
    assert [part.outputs["dir"] for part in (a, b)] == [0b01, 0b01]
    assert all(part.outputs["int_n"] for part in (a, b)), "the moves have I = 1"


def test_handler_serves_all_axes(program):
    """Given ends of all four axes, when the handler is called, then each end status is there once."""
    library, module, _ = program
    for axis in (1, 2, 3, 4):
        library.setup(axis)
        library.send(axis, 0x42, None, 0)
    module.t += 1000
    assert module.inp(SOURCE) == 3
    ended = (ctypes.c_ubyte * 5).in_dll(library, "ended")
    for _ in range(4):  # the second axis of a part calls again after 5 us
        library.handler()
        module.t += 200
        if not module.inp(SOURCE):
            break
    assert list(ended) == [0, 0x82, 0x82, 0x82, 0x82]
    assert module.inp(SOURCE) == 0
    assert not module.late, "the handler polls for ever"
