"""The examples of docs/stmc/examples.md and docs/stmc/replace.md have the printed results on the board's
model.
"""

from __future__ import annotations

import ctypes
import re
import subprocess
from collections.abc import Callable
from itertools import pairwise

import pytest

from cocotb_tests.harness.paths import ROOT
from cocotb_tests.harness.sessions import Sessions, Step
from openppmc.model.stmc.pc104_board import J105Stmc

EXAMPLES = Sessions("stmc", brief=())
REPLACE = ROOT / "docs/stmc/replace.md"
DATA, COMMAND = 0x3B0, 0x3B1
OBF, IBF, BUSY = 1, 2, 4
MOST = 40_000  # number of bus accesses after which the host counts as stuck
TICK = 16_000_000 / 48_675
CONIO = "int inp(unsigned short port); int outp(unsigned short port, int byte);\n"
STUBS = """
#include <conio.h>
int (*on_inp)(int); int (*on_outp)(int, int);
int inp(unsigned short port) { return on_inp(port); }
int outp(unsigned short port, int byte) { return on_outp(port, byte); }
"""


class Board:
    """The board, accessed by INP and OUT. `switches` lists (number of steps, levels): the levels of the
    switches change after this number of steps.
    """

    def __init__(self, **parameters: object) -> None:
        self.model = J105Stmc(**parameters)  # type: ignore[arg-type]
        self.t = 20
        self.switches: list[tuple[int, dict[str, int]]] = []
        self.mark = 0
        self.cycles = 0
        self._drv: list[int] = []
        self._looked = 0

    @property
    def steps(self) -> list[int]:
        """Edges of the steps since `mark`. Each change of the phases is a step, because no phases are chopped
        here; a change by an initialisation is included.
        """
        fresh = self.model.edges[self._looked :]
        self._looked += len(fresh)
        self._drv += [edge.t for edge in fresh if edge.signal == "drv"]
        return [t for t in self._drv if t >= self.mark]

    @property
    def lost(self) -> bool:
        """True if the host has made more than MOST bus accesses, so it polls indefinitely."""
        return self.cycles > MOST

    def cycle(self, strobe: str, port: int, **data: int) -> int:
        """Make one bus access of 560 ns; return sd_o at its end, or FF if the board does not drive
        the bus.
        """
        self.cycles += 1
        if self.lost:
            # the two values, returned in turn, end any loop of the host program
            return 0xFF * (self.cycles & 1)
        self.model.pins(self.t, sa=port, **data)
        self.model.pins(self.t + 1, **{strobe: 0})
        self.model.run_until(self.t + 9)
        driven = self.model.outputs["sd_o"] if self.model.outputs["sd_oe"] else 0xFF
        self.model.pins(self.t + 10, **{strobe: 1})
        self.t += 16
        while self.switches and len(self.steps) >= self.switches[0][0]:
            self.model.pins(self.t, **self.switches.pop(0)[1])
            self.t += 1
        return driven

    def inp(self, port: int) -> int:
        """Read a byte; after a status with BUSY = 1, half a millisecond passes."""
        value = self.cycle("ior_n", port)
        self.t += 8000 if port == COMMAND and value & BUSY else 0
        return value

    def outp(self, port: int, byte: int) -> int:
        """Write a byte."""
        self.cycle("iow_n", port, sd_i=byte)
        return 0

    def poll(self, mask: int, level: int) -> int:
        """Read the status until its bits in `mask` equal `level`."""
        while (status := self.inp(COMMAND)) & mask != level:
            assert not self.lost, f"the status never shows {level:02X}, it is {status:02X}"
        return status

    def play(self, block: list[Step], where: str) -> None:
        """Run one block of a session."""
        for number, step in enumerate(block, 1):
            at = f"{where}, line {number}: {step.kind} {step.byte:02X}"
            if step.kind == "r":
                self.poll(OBF, OBF)
                assert f"{self.inp(DATA):02X}" == f"{step.byte:02X}", at
            elif step.kind == "p":
                self.poll(0xFF, step.status)
            else:
                if step.kind != "s":
                    self.outp(COMMAND if step.kind == "c" else DATA, step.byte)
                assert f"{self.poll(IBF, 0):02X}" == f"{step.status:02X}", at

    def until(self, count: int) -> None:
        """Wait until this number of steps has been made."""
        while len(self.steps) < count:
            self.t += 100
            self.model.run_until(self.t)
        self.t += 100


@pytest.fixture
def board() -> Board:
    """A board after example 1."""
    made = Board()
    made.play(EXAMPLES.blocks(1)[0], "example 1")
    made.mark = made.t
    return made


def test_example_1_and_2(board):
    """With the speeds of the data sheet, 800 steps take the time that the page states."""
    board.play(EXAMPLES.blocks(2)[0], "example 2")
    steps = board.steps
    gaps = [round((b - a) / TICK) for a, b in pairwise(steps)]
    assert len(steps) == 800
    assert gaps[:4] == [141, 140, 139, 139] and gaps == gaps[::-1] and min(gaps) == 59
    assert sum(gaps) == 66_575
    assert (steps[-1] - steps[0]) / 16e6 == pytest.approx(1.3677, abs=5e-5)


def test_example_3(board):
    """After a stop at step 40, the printed bytes make the other 60 steps."""
    first, second = EXAMPLES.blocks(3)
    board.play(first, "example 3")
    board.until(40)
    board.play(second, "example 3b")
    assert len(board.steps) == 100


def test_example_4():
    """A decelerating stop in gap 10 ends the move after 20 steps."""
    board = Board()
    first, second = EXAMPLES.blocks(4)
    board.play(first, "example 4")
    board.until(1 + 11)
    board.play(second, "example 4b")
    assert len(board.steps) == 1 + 20


def test_example_5(board):
    """If L2 and CNP become active during the motion, the motor stops at its reference point."""
    board.switches = [(30, {"l2_n": 0}), (35, {"l2_n": 1}), (55, {"cnp_n": 0})]
    board.play(EXAMPLES.blocks(5)[0], "example 5")
    assert len(board.steps) == 55 and not board.switches


def test_example_6(board):
    """With L1 active, only the CCW step is made."""
    board.model.pins(board.t, l1_n=0)
    board.t += 4
    board.play(EXAMPLES.blocks(6)[0], "example 6")
    assert len(board.steps) == 1


def test_examples_without_motion(board):
    """In examples 7, 8 and 9, the model returns exactly the printed bytes."""
    board.play(EXAMPLES.blocks(7)[0], "example 7")
    Board().play(EXAMPLES.blocks(8)[0], "example 8")
    Board(read_map="SHEET").play(EXAMPLES.blocks(9)[0], "example 9")


def code(kind: str) -> str:
    """Return the program in this language from docs/stmc/replace.md."""
    (found,) = re.findall(rf"^```{kind}\n(.*?)^```$", REPLACE.read_text(encoding="utf-8"), re.S | re.M)
    return found


def test_c_program(tmp_path, capfd):
    """On the board, the C program finds L2 and the reference point, and prints the inputs."""
    (tmp_path / "conio.h").write_text(CONIO)
    (tmp_path / "stubs.c").write_text(STUBS)
    (tmp_path / "program.c").write_text(code("c"))
    command = ["gcc", "-std=c99", "-Wall", "-Wextra", "-Werror", "-shared", "-fPIC", "-Dmain=program"]
    command += [f"-I{tmp_path}", "-Wl,-Bsymbolic", "program.c", "stubs.c", "-o", "program.so"]
    done = subprocess.run(command, cwd=tmp_path, text=True, check=False, capture_output=True)
    assert not done.returncode, done.stderr
    library, board = ctypes.CDLL(str(tmp_path / "program.so")), Board()
    board.switches = [(1 + 8, {"l2_n": 0}), (1 + 12, {"l2_n": 1}), (1 + 15, {"cnp_n": 0})]
    kept: list[Callable[..., int]] = []
    for name, function, count in (("inp", board.inp, 1), ("outp", board.outp, 2)):
        callback = ctypes.CFUNCTYPE(ctypes.c_int, *[ctypes.c_int] * count)(function)
        ctypes.c_void_p.in_dll(library, f"on_{name}").value = ctypes.cast(callback, ctypes.c_void_p).value
        kept.append(callback)
    assert library.program() == 0 and not board.lost
    assert len(board.steps) == 1 + 15
    ctypes.CDLL(None).fflush(None)
    assert "home, inputs 4F" in capfd.readouterr().out


def test_basic_program():
    """The bytes of the QBasic program make 200 steps and lead to finish status 83."""
    text = code("basic")
    codes = [int(byte, 16) for byte in re.findall(r"OUT CMD, &H(\w+)", text)]
    first, second = ([int(n) for n in re.findall(r"\d+", line)]
                     for line in re.findall(r"^DATA ([\d, ]+)", text, re.M))  # fmt: skip
    board = Board()
    for command, data in zip(codes, (first, second, []), strict=True):
        for port, byte in [(COMMAND, command), *((DATA, byte) for byte in data)]:
            board.outp(port, byte)
            assert not board.poll(IBF, 0) & 0x80
        board.poll(BUSY, 0)
    assert board.inp(DATA) == 0x83
    assert len(board.steps) == 1 + 200
    assert text.count("NEXT") == 2 and "FOR i = 1 TO 4" in text and "FOR i = 1 TO 3" in text
