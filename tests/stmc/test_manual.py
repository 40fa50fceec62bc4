"""What docs/stmc/examples.md and docs/stmc/replace.md print, on the golden model of the board."""

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
MOST = 40_000  # bus cycles of a host that is not lost
TICK = 16_000_000 / 48_675
CONIO = "int inp(unsigned short port); int outp(unsigned short port, int byte);\n"
STUBS = """
#include <conio.h>
int (*on_inp)(int); int (*on_outp)(int, int);
int inp(unsigned short port) { return on_inp(port); }
int outp(unsigned short port, int byte) { return on_outp(port, byte); }
"""


class Board:
    """The board behind INP and OUT; `switches` are (steps made from now on, levels)."""

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
        """Edges of the steps since `mark`, and of the initialisation if it is later (never chopped here)."""
        fresh = self.model.edges[self._looked :]
        self._looked += len(fresh)
        self._drv += [edge.t for edge in fresh if edge.signal == "drv"]
        return [t for t in self._drv if t >= self.mark]

    @property
    def lost(self) -> bool:
        """The host polls for ever."""
        return self.cycles > MOST

    def cycle(self, strobe: str, port: int, **data: int) -> int:
        """One bus cycle of 560 ns; sd_o at its end, FF if the board does not drive."""
        self.cycles += 1
        if self.lost:
            return 0xFF * (self.cycles & 1)  # ends every loop of a program that would not end by itself
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
        """A read; a host that polls a running motor looks again after 0.5 ms."""
        value = self.cycle("ior_n", port)
        self.t += 8000 if port == COMMAND and value & BUSY else 0
        return value

    def outp(self, port: int, byte: int) -> int:
        """A write."""
        self.cycle("iow_n", port, sd_i=byte)
        return 0

    def poll(self, mask: int, level: int) -> int:
        """Read the status until the bits are so."""
        while (status := self.inp(COMMAND)) & mask != level:
            assert not self.lost, f"the status never shows {level:02X}, it is {status:02X}"
        return status

    def play(self, block: list[Step], where: str) -> None:
        """One block of a session."""
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
        """Let so many steps be made."""
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
    """Given the data sheet's speeds, then 800 steps take what the page says."""
    board.play(EXAMPLES.blocks(2)[0], "example 2")
    steps = board.steps
    gaps = [round((b - a) / TICK) for a, b in pairwise(steps)]
    assert len(steps) == 800
    assert gaps[:4] == [141, 140, 139, 139] and gaps == gaps[::-1] and min(gaps) == 59
    assert sum(gaps) == 66_575
    assert (steps[-1] - steps[0]) / 16e6 == pytest.approx(1.3677, abs=5e-5)


def test_example_3(board):
    """Given a stop after 40 steps, then the remaining bytes make the other 60."""
    first, second = EXAMPLES.blocks(3)
    board.play(first, "example 3")
    board.until(40)
    board.play(second, "example 3b")
    assert len(board.steps) == 100


def test_example_4():
    """Given a decelerating stop in gap 10, then 20 steps."""
    board = Board()
    first, second = EXAMPLES.blocks(4)
    board.play(first, "example 4")
    board.until(1 + 11)
    board.play(second, "example 4b")
    assert len(board.steps) == 1 + 20


def test_example_5(board):
    """Given L2 and CNP on the way, then the motor finds its reference point."""
    board.switches = [(30, {"l2_n": 0}), (35, {"l2_n": 1}), (55, {"cnp_n": 0})]
    board.play(EXAMPLES.blocks(5)[0], "example 5")
    assert len(board.steps) == 55 and not board.switches


def test_example_6(board):
    """Given L1 closed, then only ccw steps."""
    board.model.pins(board.t, l1_n=0)
    board.t += 4
    board.play(EXAMPLES.blocks(6)[0], "example 6")
    assert len(board.steps) == 1


def test_examples_without_motion(board):
    """Given examples 7, 8 and 9, then every byte is the printed one."""
    board.play(EXAMPLES.blocks(7)[0], "example 7")
    Board().play(EXAMPLES.blocks(8)[0], "example 8")
    Board(read_map="SHEET").play(EXAMPLES.blocks(9)[0], "example 9")


def code(kind: str) -> str:
    """The program of that language in docs/stmc/replace.md."""
    (found,) = re.findall(rf"^```{kind}\n(.*?)^```$", REPLACE.read_text(encoding="utf-8"), re.S | re.M)
    return found


def test_c_program(tmp_path, capfd):
    """Given the C program, when it runs on the board, then it finds L2, the reference point, and says so."""
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
    """Given the QBasic program, when its OUT and DATA are played, then 200 steps, finish status 83."""
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
