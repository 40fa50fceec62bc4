"""Motions of several axes of a bank that begin in the same cycle, on the modelled board."""

from __future__ import annotations

import pytest

from openppmc.host import (
    CW,
    AxisBusy,
    Cause,
    GroupRefused,
    LimitReached,
    NotCalledError,
    NotInitialised,
    OutOfRange,
    PpmcBank,
)
from openppmc.host.script import Script
from tests.bank.host.bench import SETUP, SPEC, at, frames, model, opened, pulses


def mask(bank: PpmcBank) -> int:
    """Return byte 0 of MASK."""
    return bank.link.execute(Script().write(3, 0).read(8)).byte(0)


def test_a_group_begins_on_one_clk() -> None:
    with opened() as bank:
        seen = pulses(bank)
        with bank.group((1, 2, 4)):
            first = bank.axis[1].start_move(400)
            bank.axis[2].start_constant(-30, 1000)
            bank.axis[4].jog(CW, high=True)
            bank.link.pause(0.05)
            assert bank.status().busy == (1, 2, 4) and not any(seen.values())
        assert first.wait().position == 400
        assert seen[1][0] == seen[2][0] == seen[4][0] > 0
        assert mask(bank) == 0
        end = bank.axis[4].stop()
        assert end is not None and end.cause is Cause.STOP
        bank.axis[3].move(5)
        assert len(seen[3]) == 5


def test_start_together_and_together() -> None:
    with opened() as bank:
        seen = pulses(bank)
        motions = bank.start_moves({2: 50, 1: -70})
        assert list(motions) == [1, 2]
        assert [motion.wait().position for motion in motions.values()] == [-70, 50]
        assert seen[1][0] == seen[2][0]
        ends = bank.move_together({3: 10, 4: 0, 1: 70}, pps=1000)
        assert {number: end.position for number, end in ends.items()} == {1: 0, 3: 10, 4: 0}
        assert seen[3][0] == seen[1][70] and seen[3][1] - seen[3][0] == 16_000
        assert {number: end.pulses for number, end in bank.move_together({1: 0}).items()} == {1: 0}
        made: list[int] = []
        bank.move_together({1: 4000, 2: 4000}, progress=lambda now: made.append(now.done))
        assert made and max(made) <= 4000


def test_16_axes_are_loaded_in_two_frames() -> None:
    """The start of 16 moves uses six frames: one reads BUSY, one writes MASK, two load the moves, one writes
    GO, one reads the result.
    """
    with opened(axes=16) as bank:
        before = frames(bank)
        seen = pulses(bank)
        motions = bank.start_moves({number: 10 * number for number in bank.axis})
        assert frames(bank) - before == 6
        assert [motion.wait().position for motion in motions.values()] == [10 * n for n in bank.axis]
        assert len({clk[0] for clk in seen.values()}) == 1


def test_a_refused_load_moves_nothing() -> None:
    with opened() as bank:
        bank.axis[3].excitation_off()
        with pytest.raises(NotInitialised, match="axis 3: the part is not initialised"):
            bank.start_moves({1: 100, 3: 100, 4: 100})
        assert (mask(bank), bank.status().busy, bank.pending()) == (0, (), ())
        assert set(bank.positions().values()) == {0}
        assert bank.axis[1].move(5).complete


def test_an_exception_inside_moves_nothing() -> None:
    with opened() as bank:
        seen = pulses(bank)
        with pytest.raises(ZeroDivisionError), bank.group((1, 2)):
            motion = bank.axis[1].start_move(100)
            _ = 1 / 0
        assert not any(seen.values()) and mask(bank) == 0
        assert motion.result is not None and motion.result.cause is Cause.STOP and motion.result.pulses == 0
        assert bank.pending() == () and bank.axis[1].move(3).position == 3


def test_go_refused_by_an_axis() -> None:
    """An axis whose MASK bit another program cleared runs immediately and then rejects GO."""
    with opened() as bank:
        with pytest.raises(GroupRefused, match="^axis 2: the part is busy with a motion") as told:  # noqa: PT012
            with bank.group((1, 2)):
                bank.axis[1].start_move(30)
                at(bank.link, 1, Script().write(8, 0x01))
                bank.axis[2].start_move(3000)
        assert list(told.value.refusals) == [2]
        assert isinstance(told.value.refusals[2], AxisBusy)
        assert bank.axis[1].motion is not None and bank.axis[1].motion.wait().position == 30


def test_go_finds_nothing_held() -> None:
    """If the MASK bit of an axis is 0 and the motion of this axis is complete before GO, the axis rejects GO,
    and the error states this.
    """
    with opened() as bank:
        with pytest.raises(GroupRefused, match="axis 2: GO found no waiting motion"):  # noqa: PT012
            with bank.group((2,)):
                at(bank.link, 1, Script().write(8, 0))
                bank.axis[2].start_move(3)
                bank.link.pause(0.1)


def test_a_held_motion_that_a_stop_ended_is_no_refusal() -> None:
    with opened() as bank:
        with bank.group((1, 2)):
            bank.axis[1].start_move(30)
            bank.axis[2].start_move(30)
            bank.axis[2].halt(wait=False)
        first, second = (bank.axis[number].motion for number in (1, 2))
        assert first is not None and first.wait().position == 30
        assert second is not None and second.result is not None and second.result.cause is Cause.STOP


def test_the_early_end_of_one_stops_the_others() -> None:
    with opened("cw2=4300,slow_cw2=4200") as bank:
        with pytest.raises(LimitReached, match="axis 2: "):
            bank.move_together({1: 20_000, 2: 20_000, 4: -3000})
        assert bank.status().busy == ()
        assert 0 < bank.position(1) < 5000 and -3000 < bank.position(4) < 0


def test_waiting_inside_would_never_end() -> None:
    with opened() as bank:
        with pytest.raises(
            NotCalledError, match="axis 1: its group holds this motion until the end of the with block"
        ):
            with bank.group((1,)):
                bank.axis[1].move(10)
        assert model(bank).positions[0] == 4000
        with bank.group((1,)):
            assert bank.axis[2].move(10).position == 10
        assert mask(bank) == 0


@pytest.mark.parametrize(
    ("axes", "text"),
    [
        ((), "a group without axes"),
        ((1, 1), "axis 1 is in the group twice"),
        ((1, 5), "axis 5: a PPMC bank has axes 1 to 4"),
        ((0,), "axis 0: a PPMC bank has axes 1 to 4"),
        (("1",), "axis '1' is not a whole number"),
        ("12", "axes '12': a group needs the numbers"),
        (3, "axes 3: a group needs the numbers"),
        (None, "axes None: a group needs the numbers"),
    ],
)
def test_groups_that_are_none(axes: object, text: str) -> None:
    with opened() as bank, pytest.raises(OutOfRange, match=text):
        bank.group(axes)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("moves", "text"),
    [
        ({}, "a group without axes"),
        ({1: 10, 9: 5}, "axis 9: a PPMC bank has axes 1 to 4"),
        ({1: 10, 2: 0}, "axis 2: 0 pulses: a move has 1 to"),
        ({1: "x"}, "axis 1: pulses 'x' is not a whole number"),
        ([10, 20], r"moves \[10, 20\]: expected pulses by axis"),
        (7, "moves 7: expected pulses by axis"),
    ],
)
def test_moves_that_are_none(moves: object, text: str) -> None:
    with opened() as bank:
        with pytest.raises(OutOfRange, match=text):
            bank.start_moves(moves)  # type: ignore[arg-type]
        with pytest.raises(OutOfRange, match="outside"):
            bank.start_moves({1: 5}, pps=1)
        assert mask(bank) == 0 and bank.status().busy == ()


def test_groups_of_moving_axes_and_in_groups() -> None:
    with opened() as bank:
        bank.axis[2].jog(CW, 2000)
        with pytest.raises(AxisBusy, match="axis 2: "), bank.group((1, 2)):
            raise AssertionError("not entered")
        assert bank.status().busy == (2,) and mask(bank) == 0
        with pytest.raises(OutOfRange, match="a group is open already, of axes 1, 3"), bank.group((3, 1)):
            bank.start_moves({4: 10})
        assert bank.status().busy == (2,)
        bank.axis[2].halt()


def test_a_group_survives_a_new_driver() -> None:
    """If a program ended inside the context of a group, the next program clears MASK and can stop the held
    motions.
    """
    with PpmcBank.open(SPEC) as first:
        first.axis[1].initialise(**SETUP)  # type: ignore[arg-type]
        first.group((1,)).__enter__()
        first.axis[1].start_move(10)
        bank = PpmcBank.on(first.link)
        assert mask(bank) == 0 and bank.status().busy == (1,)
        assert list(bank.stop_all()) == [1]
