"""The C program of docs/ppmc2104/isa.md, compiled, and run on two golden models at the register addresses."""

from __future__ import annotations

import ctypes
import re
import subprocess
from collections.abc import Callable

import pytest

from cocotb_tests.harness.paths import ROOT
from openppmc.model.ppmc2104.part import Ppmc2104

from .setting import BASE, SOURCE

PAGE = ROOT / "docs/ppmc2104/isa.md"
CONIO = "int inp(unsigned short port); int outp(unsigned short port, int byte);\n"
DOS = "void _disable(void); void _enable(void);\n"
STUBS = """
#include <conio.h>
#include <dos.h>
int (*on_enable)(int);
void _disable(void) { on_enable(0); }
void _enable(void) { on_enable(1); }
int (*on_inp)(int); int (*on_outp)(int, int); int (*on_run)(int);
int inp(unsigned short port) { return on_inp(port); }
int outp(unsigned short port, int byte) { return on_outp(port, byte); }
void run(int high) { on_run(high); }
"""
# Extensions of the DOS compilers. No function is static, so that the test can call all of them.
DEFINES = ("-Dinterrupt=", "-Dfar=", "-Dstatic=", "-Dmain=program")
LATEST = 10_000_000
STEP = 16  # cycles between samples of irq
ACCESS = 64  # cycles between two bus accesses


class Module:
    """Two golden models, which the program accesses by inp and outp from one base address on, and an
    interrupt controller.

    One input of the controller (8259) stores a rising edge of irq while irq stays high. `enabled` is the
    interrupt flag of the processor; `handler` is called when the processor would execute the interrupt.
    """

    def __init__(self) -> None:
        self.t = 100
        self.parts = [Ppmc2104(), Ppmc2104()]
        self.late = self.calls = 0
        self.enabled = True
        self.handler: Callable[[], None] | None = None
        self._irq = self._request = self._serving = False

    def source(self) -> int:
        """Return the bits of the parts that request an interrupt."""
        return sum((not part.outputs["int_n"]) << number for number, part in enumerate(self.parts))

    def pass_time(self, clk: int, rearm: bool = False) -> None:
        """Simulate this number of cycles; if `rearm` is set, the source register is written during these
        cycles.
        """
        for _ in range(0, clk, STEP):
            self.t += STEP
            for part in self.parts:
                part.run_until(self.t - 1)
            irq = bool(self.source()) and not rearm
            self._request = irq and (self._request or not self._irq)
            self._irq = irq

    def run_program(self, clk: int) -> None:
        """Let the processor run other code for this number of cycles; it executes interrupts during this
        time.
        """
        for _ in range(0, clk, ACCESS):
            self.pass_time(ACCESS)
            if self._request and self.enabled and not self._serving:
                assert self.handler is not None
                self._request, self._serving = False, True
                self.calls += 1
                self.handler()
                assert not self._serving, "no end of interrupt"

    def inp(self, port: int) -> int:
        """Return the byte of a read access."""
        self.pass_time(ACCESS)
        if self.t > LATEST:
            self.late += 1
            return 0xFF * (self.late & 1)  # ends each loop of the program that would not terminate otherwise
        if port == SOURCE:
            return self.source()
        number, reg = divmod(port - BASE, 2)
        return self.parts[number].read(self.t, reg)

    def outp(self, port: int, byte: int) -> int:
        """Make a write access, or end the interrupt."""
        self.pass_time(ACCESS, rearm=port == SOURCE)
        if port == 0x20:
            self._serving = False
        elif port != SOURCE:
            number, reg = divmod(port - BASE, 2)
            self.parts[number].write(self.t, reg, byte)
        return 0

    def run(self, high: int) -> int:
        """Set the level of all RUN pins."""
        self.pass_time(ACCESS)
        for part in self.parts:
            part.pins(self.t, run=0b11 * high)
        return 0

    def enable(self, on: int) -> int:
        """Set the interrupt flag of the processor."""
        self.enabled = bool(on)
        return 0


@pytest.fixture
def program(tmp_path) -> tuple[ctypes.CDLL, Module, list[Callable[..., int]]]:
    """The compiled program, the module that it accesses, and its callbacks (which must stay referenced)."""
    blocks = re.findall(r"^```c\n(.*?)^```$", PAGE.read_text(encoding="utf-8"), re.S | re.M)
    assert len(blocks) == 2
    (tmp_path / "conio.h").write_text(CONIO)
    (tmp_path / "dos.h").write_text(DOS)
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
    # The C library also has a function `send`.
    command += ["-Wl,-Bsymbolic", "program.c", "stubs.c", "-o", "program.so"]
    done = subprocess.run(command, cwd=tmp_path, text=True, check=False, capture_output=True)
    assert not done.returncode, done.stderr
    library, module = ctypes.CDLL(str(tmp_path / "program.so")), Module()
    callbacks = []
    for name, function, count in (
        ("inp", module.inp, 1),
        ("outp", module.outp, 2),
        ("run", module.run, 1),
        ("enable", module.enable, 1),
    ):
        callback = ctypes.CFUNCTYPE(ctypes.c_int, *[ctypes.c_int] * count)(function)
        ctypes.c_void_p.in_dll(library, f"on_{name}").value = ctypes.cast(callback, ctypes.c_void_p).value
        callbacks.append(callback)
    module.handler = library.handler
    return library, module, callbacks


def test_program_moves_all_axes(program):
    """The program moves axis 3 alone by 1000 pulses; then RUN starts all four axes in the same cycle."""
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


def steps(library: ctypes.CDLL, *axes: int) -> None:
    """Start a single step of each axis, with the interrupt enabled."""
    for axis in axes:
        library.send(axis, 0x42, None, 0)


def ends(library: ctypes.CDLL) -> list[int]:
    """Return the end statuses that the handler has found for axes 1 to 4."""
    return list((ctypes.c_ubyte * 5).in_dll(library, "ended"))[1:]


def left(library: ctypes.CDLL) -> int:
    """Return whether the handler has left a cause pending."""
    return ctypes.c_ubyte.in_dll(library, "left").value


def test_handler_serves_all_axes(program):
    """After the ends of all four axes, one call of the handler finds each end status once."""
    library, module, _ = program
    for axis in (1, 2, 3, 4):
        library.setup(axis)
    steps(library, 1, 2, 3, 4)
    module.run_program(3000)
    assert ends(library) == [0x82, 0x82, 0x82, 0x82]
    assert module.source() == left(library) == 0
    assert not module.late, "the handler polls for ever"


def test_handler_after_the_restart(program):
    """If an axis moves again, the handler neither waits for this axis nor misses the end of another axis."""
    library, module, _ = program
    for axis in (1, 2, 3, 4):
        library.setup(axis)
    module.enabled = False
    steps(library, 1, 2, 3, 4)
    module.pass_time(1000)
    assert library.move(1, 0x43, 1000, 0) == 0  # the host has not read the end status of this axis
    module.enabled = True
    since = module.t
    module.run_program(3000)
    assert not module.late, "the handler polls for ever"
    assert module.t - since < 20_000, "the handler waits for the move"
    assert ends(library) == [0, 0x82, 0x82, 0x82]
    assert left(library), "axis 1 has no status before it is idle"
    calls = module.calls
    library.move(3, 0x43, 20, 0)
    library.move(2, 0x43, 20, 0)
    module.run_program(200_000)
    assert module.calls == calls, "irq is high all the time: no edge"
    library.tick()
    module.run_program(3000)
    assert ends(library) == [0, 0x83, 0x83, 0x82]
    assert left(library) and module.calls <= calls + 3
    module.run_program(2_000_000)
    library.tick()
    module.run_program(3000)
    assert ends(library) == [0x83, 0x83, 0x83, 0x82]
    assert left(library) == module.source() == 0
    calls = module.calls
    library.tick()
    module.run_program(3000)
    assert module.calls == calls


def test_start_takes_the_end_before(program):
    """Each move that the program starts, at any time, ends with a separate edge of irq."""
    library, module, _ = program
    for axis in (1, 2, 3, 4):
        library.setup(axis)
    for turn in range(12):
        axis = turn % 4 + 1
        module.enabled = False  # the handler is called late
        steps(library, axis)
        module.pass_time(1000)
        assert library.start(axis, 5 + turn, turn & 1) == 0
        assert module.enabled
        assert library.start(axis, 5, 0) == 5, "BUSY"
        assert ends(library)[axis - 1] == 0x82
        module.run_program(100_000)
        assert ends(library)[axis - 1] == 0x83
        assert left(library) == module.source() == 0
    assert not module.late, "the handler polls for ever"
