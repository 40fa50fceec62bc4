"""The driver of the bank, for one axis and for all axes, on the modelled board."""

from __future__ import annotations

import pytest

from openppmc.host import (
    CCW,
    CW,
    AxisBusy,
    Cause,
    LimitReached,
    NothingToStop,
    NotInitialised,
    OutOfRange,
    Ppmc104,
    PpmcBank,
    WrongDevice,
    open_part,
)
from openppmc.host.bank.registers import Config, bit_bytes, members
from openppmc.host.model_port import ModelPort
from openppmc.host.script import Script
from tests.bank.host.bench import SETUP, SPEC, at, frames, model, opened

# ---------------------------------------------------------------------- opening


def test_open_part_takes_the_driver_of_what_is_there() -> None:
    with open_part(SPEC) as bank:
        assert isinstance(bank, PpmcBank)
        assert bank.info() == (1, 4)
        assert [axis.number for axis in bank.axes] == [1, 2, 3, 4]
        assert bank.axis[2] is bank.axes[1]
    with pytest.raises(WrongDevice, match="the part is a PPMC-104, not a PPMC bank"):
        PpmcBank.open("model:speed=max")
    with pytest.raises(WrongDevice, match="the part is a PPMC bank, not a PPMC-104"):
        Ppmc104.open(SPEC)


@pytest.mark.parametrize(
    ("info", "text"),
    [
        ((0xFF, 0xFF, 0xFF), r"INFO of the bank begins with 0xff, not with 0x42 \(B\): there is no bank"),
        ((0x42, 2, 4), "window is of version 2, this package knows 1: renew this package"),
        ((0x42, 0, 4), "window is of version 0, this package knows 1: renew the board's bitstream"),
        ((0x42, 1, 5), "the bank reports 5 axes; expected one of 4, 8, 16, 32, 64"),
    ],
)
def test_info_that_is_none_of_ours(info: tuple[int, ...], text: str) -> None:
    port = ModelPort(SPEC.removeprefix("model:"))
    board, real = port.board, port.board.read

    def read(a: int) -> int:
        return info[real(3)] if a == 0xC else real(a)

    board.read = read  # type: ignore[method-assign]
    with pytest.raises(WrongDevice, match=text):
        PpmcBank.open(port)


def test_opening_takes_what_others_left() -> None:
    """A new driver works even if another program has left finish statuses unread and bits in MASK set."""
    with opened() as first:
        first.axis[2].start_move(10)
        first.axis[4].start_move(10)
        first.link.pause(0.1)
        at(first.link, 1, Script().write(8, 0x0F))
        assert first.pending() == (2, 4)
        bank = PpmcBank.on(first.link)
        assert bank.pending() == ()
        bank.axis[1].initialise(**SETUP)  # type: ignore[arg-type]
        assert bank.axis[1].move(20).position == 20


def test_a_motion_of_another_program_goes_on() -> None:
    with opened() as first:
        first.axis[3].jog(CW, 2000)
        bank = PpmcBank.on(first.link)
        bank.link.pause(0.1)
        assert bank.status().busy == (3,)
        end = bank.axis[3].halt()
        assert (
            end is not None
            and end.cause is Cause.STOP
            and end.pulses is None
            and end.message_prefix == "axis 3: "
        )


# ---------------------------------------------------------------------- one axis


def test_axes_are_apart() -> None:
    with opened() as bank:
        assert bank.axis[1].move(300).position == 300
        assert bank.axis[4].move_constant(-40, 900).position == -40
        assert bank.positions() == {1: 300, 2: 0, 3: 0, 4: -40}
        assert [bank.position(number) for number in bank.axis] == [300, 0, 0, -40]
        assert model(bank).positions == [4300, 4000, 4000, 3960]
        with pytest.raises(NothingToStop, match="axis 2: nothing to stop"):
            bank.axis[2].stop()
        with pytest.raises(NotInitialised, match="axis 3: "):
            bank.axis[3].excitation_off()
            bank.axis[3].move(5)


@pytest.mark.parametrize("number", [0, 5, -1, 64, "2", None, 1.5, 2.0001])
def test_axes_that_are_not_there(number: object) -> None:
    with opened() as bank:
        with pytest.raises(OutOfRange, match="axis"):
            bank.axis[number]  # type: ignore[index]
        with pytest.raises(OutOfRange, match="ax[ie]s"):
            bank.position(number)  # type: ignore[arg-type]


def test_another_program_selects_an_axis_meanwhile() -> None:
    with opened() as bank:
        for number in bank.axis:
            at(bank.link, 1 + number % 4, Script().nop())
            assert bank.axis[number].move(10 * number).position == 10 * number


def test_zero_and_home_are_of_this_object() -> None:
    with opened() as bank:
        axis = bank.axis[2]
        axis.move(-100)
        axis.zero()
        end = axis.move(30)
        assert (end.position, end.pulses, axis.position) == (30, 30, 30)
        assert bank.positions()[2] == bank.snapshot((2,))[2].position == 30
        seen: list[int] = []
        axis.move(2000, progress=lambda now: seen.append(now.position))
        assert all(30 < position <= 2030 for position in seen)
        home = axis.home(CCW)
        assert home.position == axis.position == 0
        assert model(bank).positions[1] == 0
        assert PpmcBank.on(bank.link).positions()[2] == -4000


def test_positions_wrap_as_32_bits() -> None:
    with opened() as bank:
        axis = bank.axis[1]
        assert axis._position_of(-5) == -5
        axis._origin = (1 << 31) - 10
        assert axis._position_of(-(1 << 31) + 10) == 20
        axis._origin = -(1 << 31) + 10
        assert axis._position_of((1 << 31) - 10) == -20


def test_limits_and_looks() -> None:
    with opened("cw3=4100,slow_cw3=4099") as bank:
        with pytest.raises(LimitReached, match="axis 3: .*limit.* ended the motion at position"):
            bank.axis[3].move(3000)
        seen = bank.snapshot()
        assert list(seen) == [1, 2, 3, 4]
        assert seen[3].inputs.limit_cw and not seen[1].inputs.limit_cw
        assert seen[3].position == bank.position(3) and not seen[3].status.busy
        assert bank.axis[3].inputs() == seen[3].inputs
        bank.axis[2].jog(CW, 2000)
        assert [number for number, one in bank.snapshot().items() if one.status.busy] == [2]
        assert bank.status().raw == bank.axis[2].status().raw << 8 == 0x0400
        with pytest.raises(AxisBusy, match="axis 2: "):
            bank.axis[2].start_move(5)


def test_config_and_set_ups() -> None:
    with opened() as bank:
        axis = bank.axis[3]
        assert axis.config() == Config(csel=1, vsel=1)
        axis.configure(csel=0)
        assert axis.config() == Config(0, 1) and bank.axis[2].config() == Config(1, 1)
        axis.initialise(start_pps=600, high_pps=900, long_intervals=True)
        assert axis.config().vsel == 0
        axis.move_constant(3, 100_000)
        assert axis.config() == Config(1, 0)
        for wrong in (2, -1, "1", 0.5):
            with pytest.raises(OutOfRange, match="csel"):
                axis.configure(csel=wrong)  # type: ignore[arg-type]
        with pytest.raises(OutOfRange, match="external clock: a PPMC bank does not have that"):
            axis.initialise(external_clock=100_000)
        assert not hasattr(axis, "aux") and not hasattr(axis, "auxi")


def test_chopper_times_are_those_of_this_axis() -> None:
    with opened() as bank:
        bank.axis[1].initialise(**SETUP, long_intervals=True)  # type: ignore[arg-type]
        assert bank.axis[1].switching(25, 28.75) == (25, 28.75)
        assert bank.axis[2].switching(27, 33) == (27, 33)
        with pytest.raises(OutOfRange, match="on time 25 us is outside 27 to 792"):
            bank.axis[2].switching(25, 33)


# ---------------------------------------------------------------------- all axes


def test_looks_at_64_axes_take_few_frames() -> None:
    """With 64 axes, `positions` uses two frames (the first with 252 bytes for 42 axes), `snapshot` three,
    `status` and `pending` one each.
    """
    with PpmcBank.open(SPEC.replace("axes=4", "axes=64,clk=64000000")) as bank:
        assert len(bank.axes) == 64 and bank.info().axes == 64
        for what, most in ((bank.positions, 2), (bank.snapshot, 3), (bank.status, 1), (bank.pending, 1)):
            before = frames(bank)
            what()
            assert frames(bank) - before == most
        bank.axis[64].initialise(**SETUP)  # type: ignore[arg-type]
        assert bank.axis[64].move(7).position == 7
        assert {number: at for number, at in bank.positions().items() if at} == {64: 7}


def test_stop_all() -> None:
    with opened() as bank:
        assert bank.stop_all() == {}
        bank.axis[1].jog(CW, 2000)
        bank.axis[3].jog(CCW, 3000)
        bank.link.pause(0.1)
        ends = bank.stop_all()
        assert {number: end.cause for number, end in ends.items()} == {1: Cause.STOP, 3: Cause.STOP}
        assert ends[1].position == bank.position(1) > 100 and ends[3].position == bank.position(3) < -200
        assert bank.pending() == ()
        bank.axis[2].jog(CW, 2000)
        bank.axis[4].jog(CW, 2000)
        assert bank.stop_all(wait=False) == {}
        motion = bank.axis[4].motion
        assert motion is not None and motion.wait().cause is Cause.STOP


def test_stop_all_of_another_program() -> None:
    with opened() as first:
        first.axis[2].jog(CW, 2000)
        bank = PpmcBank.on(first.link)
        ends = bank.stop_all()
        assert list(ends) == [2] and ends[2].pulses is None and ends[2].cause is Cause.STOP


def test_ends_of_several_axes_hide_no_other() -> None:
    """If axes end one by one, the wait for the last one returns without another poll of BUSY after
    its end.
    """
    with opened() as bank:
        motions = [bank.axis[number].start_constant(200 * number, 2000) for number in (1, 2, 3)]
        begin = bank.link.clock()
        assert motions[2].wait().complete
        assert bank.link.clock() - begin < 0.33
        assert [motion.result is not None and motion.result.complete for motion in motions] == [True] * 3
        assert bank.pending() == ()


def test_reset() -> None:
    with opened() as bank:
        bank.axis[2].move(50)
        bank.axis[2].zero()
        bank.axis[1].jog(CW, 2000)
        bank.reset()
        assert set(bank.positions().values()) == {0} and bank.status().raw == 0
        with pytest.raises(NotInitialised):
            bank.axis[2].start_move(5)


def test_leaving_by_an_exception_stops_what_was_started() -> None:
    port = ModelPort(SPEC.removeprefix("model:"))
    with pytest.raises(ZeroDivisionError), PpmcBank.open(port) as bank:
        bank.axis[4].initialise(**SETUP)  # type: ignore[arg-type]
        bank.axis[4].jog(CW, high=True)
        bank.link.pause(0.05)
        _ = 1 / 0
    port.board.run_until(port.board.t + 16_000_000)
    before = port.board.positions[:]
    port.board.run_until(port.board.t + 16_000_000)
    assert port.board.positions == before and before[3] > 4000


def test_registers_of_a_bit_an_axis() -> None:
    assert members(bytes([0x81, 0x02])) == (1, 8, 10)
    assert bit_bytes((1, 8, 10), 16) == bytes([0x81, 0x02])
    assert bit_bytes((4,), 4) == bytes([8]) and len(bit_bytes((), 64)) == 8
