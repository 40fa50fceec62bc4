"""The C driver of the bank, compiled as a library; its bus accesses go to the golden model."""

from __future__ import annotations

import ctypes
from collections.abc import Callable
from pathlib import Path

import pytest

from cocotb_tests.harness.paths import BUILD
from openppmc.model.bank.part import PpmcBank
from openppmc.model.single.codes import Error
from tests.common.packages.c_programs import C99, DRIVER, WARNINGS, run

OK, BAD_ARGUMENT, NO_PART = 0, 18, 17
AXES, CLK_HZ = 16, 16_000_000
INIT = {"motor": 4, "active_high": True, "rate_start": 100, "rate_high": 20, "ramp": 10}
CCW = 0x08


class Config(ctypes.Structure):
    """The structure ppmc104_config_t."""

    _fields_ = [
        ("motor", ctypes.c_uint8),
        *((name, ctypes.c_bool) for name in ("half_step", "active_high", "chop", "external_clock")),
        ("rate_start", ctypes.c_uint8),
        ("rate_high", ctypes.c_uint8),
        ("ramp", ctypes.c_uint16),
    ]


class Finish(ctypes.Structure):
    """The structure ppmc104_finish_t."""

    _fields_ = [
        *((name, ctypes.c_bool) for name in ("ended", "stopped", "alarm", "limit", "slow_limit")),
        ("operation", ctypes.c_uint8),
        ("raw", ctypes.c_uint8),
    ]


READ = ctypes.CFUNCTYPE(ctypes.c_uint8, ctypes.c_void_p, ctypes.c_uint)
WRITE = ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_uint, ctypes.c_uint8)


@pytest.fixture(scope="module")
def library() -> ctypes.CDLL:
    """Both C files, compiled with all warnings."""
    path = Path(BUILD) / "cdriver_bank" / "libbank.so"
    path.parent.mkdir(parents=True, exist_ok=True)
    sources = [DRIVER / "ppmc104.c", DRIVER / "ppmc_bank.c"]
    run(*C99, *WARNINGS, "-O1", "-shared", "-fPIC", *sources, "-o", path)
    lib = ctypes.CDLL(str(path))
    lib.ppmc_bank_hold.argtypes = [ctypes.c_void_p, ctypes.c_uint64]
    lib.ppmc_bank_pending.restype = lib.ppmc_bank_busy.restype = ctypes.c_uint64
    return lib


class Bench:
    """A model, its driver, and the axes of the driver. Methods have the names of the C functions."""

    def __init__(self, lib: ctypes.CDLL, axes: int = AXES) -> None:
        self.lib, self.model, self.t = lib, PpmcBank(axes, CLK_HZ), 200
        self._functions = (
            READ(lambda _, address: self.read(address)),
            WRITE(lambda _, address, byte: self.write(address, byte)),
        )
        # Memory for the structures of the driver, larger than necessary.
        self.bank = ctypes.create_string_buffer(256)
        self.parts = [ctypes.create_string_buffer(256) for _ in range(axes)]
        self.refused = ctypes.c_uint64()

    def _at(self, address: int) -> None:
        assert 0 <= address < 1024
        self.model.pins(self.t, a=address)
        self.t += 2

    def read(self, address: int) -> int:
        """Make a read access of 6 cycles, followed by a pause of 3."""
        self._at(address)
        byte = self.model.read(self.t, address, 6)
        self.t += 9
        return byte

    def write(self, address: int, byte: int) -> None:
        """Make a write access of 2 cycles, followed by a pause of 3."""
        self._at(address)
        self.model.write(self.t, address, byte, 2)
        self.t += 5

    def open(self) -> int:
        """Call ppmc_bank_open and, if it succeeds, ppmc_bank_axis for each axis."""
        result = self.lib.ppmc_bank_open(self.bank, *self._functions, None)
        for number, part in enumerate(self.parts if result == OK else ()):
            assert self.lib.ppmc_bank_axis(self.bank, number, part) == OK
        return result

    def init(self, *numbers: int) -> None:
        """Call ppmc104_init for each of these axes."""
        for number in numbers:
            assert self.lib.ppmc104_init(self.parts[number], ctypes.byref(Config(**INIT))) == OK

    def wait(self, number: int) -> Finish:
        """Call ppmc104_wait."""
        finish = Finish()
        assert self.lib.ppmc104_wait(self.parts[number], ctypes.byref(finish)) == OK
        return finish

    def position(self, number: int) -> int:
        """Call ppmc_bank_position."""
        value = ctypes.c_int32()
        assert self.lib.ppmc_bank_position(self.bank, number, ctypes.byref(value)) == OK
        return value.value

    def go(self) -> int:
        """Call ppmc_bank_go."""
        return self.lib.ppmc_bank_go(self.bank, ctypes.byref(self.refused))


@pytest.fixture
def bench(library: ctypes.CDLL) -> Bench:
    """An open bank, with axes 0, 3, 9 and 15 initialised."""
    made = Bench(library)
    assert made.open() == OK
    made.init(0, 3, 9, 15)
    return made


@pytest.mark.parametrize("axes", [4, 8, 16])
def test_opening(library: ctypes.CDLL, axes: int) -> None:
    """The driver finds the axes of a bank and empties a MASK that another program left."""
    bench = Bench(library, axes)
    bench.write(0x008, 0x0F)
    assert bench.open() == OK
    assert bench.read(0x008) == 0
    assert library.ppmc_bank_axis(bench.bank, axes, ctypes.create_string_buffer(256)) == BAD_ARGUMENT


@pytest.mark.parametrize("info", [(0xFF,) * 3, (0x42, 2, 8), (0x42, 1, 5), (0x42, 1, 0), (0, 1, 8)])
def test_what_is_no_bank(library: ctypes.CDLL, info: tuple[int, ...]) -> None:
    """If INFO is that of another device, the driver finds neither part nor axes."""
    bench = Bench(library)
    real: Callable[[int], int] = bench.read
    bench.read = lambda address: info[address >> 4] if address & 15 == 12 else real(address)  # type: ignore[method-assign]
    assert bench.open() == NO_PART
    assert library.ppmc_bank_axis(bench.bank, 0, bench.parts[0]) == BAD_ARGUMENT


def test_axes_are_parts(bench: Bench) -> None:
    """Moves by the functions of ppmc104.h change pulses, position, end and pending bit of their own axis
    only.
    """
    lib = bench.lib
    assert lib.ppmc104_move(bench.parts[9], 0, 25) == OK
    assert lib.ppmc_bank_busy(bench.bank) == 1 << 9
    finish = bench.wait(9)
    assert (finish.raw, finish.stopped) == (0x83, False)
    assert lib.ppmc104_move_constant(bench.parts[3], CCW, 30, 7) == OK
    while lib.ppmc_bank_busy(bench.bank):
        pass
    assert lib.ppmc_bank_pending(bench.bank) == 1 << 3
    assert bench.wait(3).raw == 0x84 and lib.ppmc_bank_pending(bench.bank) == 0
    assert (bench.position(9), bench.position(3), bench.position(0)) == (25, -7, 0)
    all_of_them = (ctypes.c_int32 * AXES)()
    lib.ppmc_bank_positions(bench.bank, all_of_them)
    assert list(all_of_them) == [0, 0, 0, -7, 0, 0, 0, 0, 0, 25, 0, 0, 0, 0, 0, 0]
    assert [len(bench.model.pulses(number)) for number in (0, 3, 9)] == [0, 7, 25]
    assert lib.ppmc104_move(bench.parts[1], 0, 5) == Error.NOT_INITIALISED + 1
    assert lib.ppmc_bank_position(bench.bank, AXES, ctypes.byref(ctypes.c_int32())) == BAD_ARGUMENT


def test_what_a_bank_does_not_have(bench: Bench) -> None:
    """An axis of a bank rejects an external clock and AUX as undefined commands."""
    config = Config(**INIT, external_clock=True)
    assert bench.lib.ppmc104_init(bench.parts[1], ctypes.byref(config)) == Error.UNDEFINED + 1
    assert bench.lib.ppmc104_aux(bench.parts[0], True) == Error.UNDEFINED + 1


def test_config(bench: Bench) -> None:
    """With the slow base clock for one axis, the intervals of its pulses are four times as long."""
    lib = bench.lib
    for number in (0, 3):
        assert lib.ppmc_bank_config(bench.bank, 3, number == 3, True) == OK
        assert lib.ppmc104_move_constant(bench.parts[3], 0, 9, 3) == OK
        bench.wait(3)
    clk = bench.model.pulses(3)
    assert [clk[n + 1] - clk[n] for n in (0, 1, 3, 4)] == [1280, 1280, 320, 320]
    assert lib.ppmc_bank_config(bench.bank, AXES, True, True) == BAD_ARGUMENT


def test_a_group_begins_on_one_clk(bench: Bench) -> None:
    """Three loaded motions do not move before GO, and begin in the same cycle after it."""
    lib = bench.lib
    assert lib.ppmc_bank_hold(bench.bank, 1 << 0 | 1 << 9 | 1 << 15) == OK
    assert lib.ppmc104_move(bench.parts[0], 0, 20) == OK
    assert lib.ppmc104_move_constant(bench.parts[9], CCW, 30, 5) == OK
    assert lib.ppmc104_move(bench.parts[15], 0, 3) == OK
    assert lib.ppmc_bank_busy(bench.bank) == 1 << 0 | 1 << 9 | 1 << 15
    bench.model.run_until(bench.t + 100_000)
    bench.t += 100_001
    assert not any(bench.model.pulses(number) for number in range(AXES))
    assert bench.go() == OK and bench.refused.value == 0
    for number in (0, 9, 15):
        bench.wait(number)
    first = {bench.model.pulses(number)[0] for number in (0, 9, 15)}
    assert len(first) == 1
    assert (bench.position(0), bench.position(9), bench.position(15)) == (20, -5, 3)
    assert bench.read(0x008) == bench.read(0x018) == 0
    assert lib.ppmc104_move(bench.parts[0], 0, 4) == OK
    assert not bench.wait(0).stopped


def test_who_was_not_ready(bench: Bench) -> None:
    """GO reports the axes that had no motion, one of them not initialised; the axis with a motion moves."""
    lib = bench.lib
    assert lib.ppmc_bank_hold(bench.bank, 1 << 0 | 1 << 1 | 1 << 3) == OK
    assert lib.ppmc104_move(bench.parts[3], 0, 5) == OK
    assert bench.go() == Error.UNDEFINED + 1
    assert bench.refused.value == 1 << 0 | 1 << 1
    bench.wait(3)
    assert bench.position(3) == 5
    assert lib.ppmc_bank_hold(bench.bank, 1 << 1) == OK
    assert bench.go() == Error.NOT_INITIALISED + 1


def test_groups_that_are_none(bench: Bench) -> None:
    """A group without axes, with an absent axis or with a moving axis is rejected, and so is the next GO."""
    lib = bench.lib
    hold = lib.ppmc_bank_hold
    assert hold(bench.bank, 0) == hold(bench.bank, 1 << AXES) == BAD_ARGUMENT
    assert lib.ppmc104_jog(bench.parts[3], 0, 30) == OK
    assert hold(bench.bank, 1 << 3 | 1) == Error.NOT_WHILE_BUSY + 1
    assert bench.go() == BAD_ARGUMENT
    assert bench.read(0x008) == 0


def test_a_group_called_off(bench: Bench) -> None:
    """If a loaded group is cancelled, its motions end without a pulse; other motions continue."""
    lib = bench.lib
    assert lib.ppmc104_jog(bench.parts[15], 0, 30) == OK
    assert lib.ppmc_bank_hold(bench.bank, 1 << 0 | 1 << 3) == OK
    assert lib.ppmc104_move(bench.parts[0], 0, 20) == OK
    lib.ppmc_bank_drop(bench.bank)
    finish = bench.wait(0)
    assert finish.stopped and bench.position(0) == 0
    assert lib.ppmc_bank_busy(bench.bank) == 1 << 15 and bench.read(0x008) == 0
    lib.ppmc_bank_stop_all(bench.bank)
    assert bench.wait(15).stopped and lib.ppmc_bank_busy(bench.bank) == 0
