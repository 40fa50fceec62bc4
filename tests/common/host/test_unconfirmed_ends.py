"""The end of a motion is reported only if the device confirms it.

The status of the device must name this motion, and the pulse count must agree. Otherwise the driver raises
EndUnknown (P104-RD-03, P104-END-05, P2104-END-05, STMC-FIN-01).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

import pytest

from openppmc.cli import main
from openppmc.host import (
    CCW,
    CW,
    AxisBusy,
    Cause,
    EndUnknown,
    MotionError,
    MotionResult,
    NothingToStop,
    NotInitialised,
    Pmc006,
    Ppmc104,
    Ppmc312,
    Ppmc312Bus,
    Ppmc2104,
    PpmcBank,
    ProtocolError,
    Stmc,
    Timeout,
)
from openppmc.host.bank.axis import BankAxis
from openppmc.host.model_port import ModelPort
from openppmc.host.motion_result import decode_end
from openppmc.host.script import Script
from tests.common.host.line_ports import Spoiled

SLOW = 115_200
"""Baud rate of a bridge after a reset. The tests use it because a replaced bridge responds only at
this rate.
"""
ENDLESS = 1 << 24
KINDS: dict[str, tuple[Any, str, Callable[[Any], Any]]] = {
    "ppmc104": (Ppmc104, "part=ppmc104", lambda part: part),
    "ppmc104-datasheet": (Ppmc104, "part=ppmc104,timing=DATASHEET", lambda part: part),
    "ppmc2104-x": (Ppmc2104, "part=ppmc2104", lambda part: part.x),
    "ppmc2104-y": (Ppmc2104, "part=ppmc2104", lambda part: part.y),
    "stmc": (Stmc, "part=stmc", lambda part: part),
    "stmc-family": (Stmc, "part=stmc,read_map=FAMILY", lambda part: part),
    "bank": (PpmcBank, "part=bank,axes=4", lambda part: part.axis[3]),
}


@contextmanager
def opened(kind: str, words: str = "") -> Iterator[Any]:
    """Open an initialised axis with 1000 to 5000 pulses/s."""
    driver, text, chosen = KINDS[kind]
    with driver.open(f"model:speed=max,{text},{words}", SLOW) as part:
        axis = chosen(part)
        axis.initialise(1000, 5000, 100)
        yield axis


@pytest.fixture(params=KINDS)
def axis(request: pytest.FixtureRequest) -> Iterator[Any]:
    with opened(request.param) as ready:
        yield ready


def port_of(axis: Any) -> ModelPort:
    """Return the modelled board's port."""
    link = getattr(axis.link, "_link", axis.link)
    assert isinstance(link.port, ModelPort)
    return link.port


def reset_part(axis: Any) -> None:
    """Reset the device, but not the bridge and its pulse counter."""
    port_of(axis).board.reset()


def replace_board(axis: Any) -> None:
    """Replace the board at the port by a fresh board of the same kind."""
    port = port_of(axis)
    fresh = ModelPort(port.name.removeprefix("model:"))
    fresh.board.t = port.board.t
    fresh.board.part.run_until(port.board.t)
    port.board, port.bridge = fresh.board, fresh.bridge


def jump(axis: Any) -> None:
    """Decrease the pulse counter by 40 pulses, as a glitch would; a bank has its own counter."""
    if hasattr(axis, "_in_open_group"):
        axis.motion.begin += 40
    else:
        port_of(axis).board.counts[axis.number - 1] -= 40


def another_program(axis: Any) -> None:
    """Reset the device and make a shorter move of the same kind, as another program could."""
    reset_part(axis)
    axis.apply(axis.setup)
    order = axis._move_request(30)
    axis.link.execute(Script().call(order.code | axis._code_bits, *order.data))
    axis.link.pause(1)


FAULTS = [reset_part, replace_board, another_program]


@pytest.mark.parametrize("fault", FAULTS)
@pytest.mark.parametrize("seconds", [0.1, 0.0, 0.2])
def test_a_reset_during_a_move_is_no_end(axis: Any, fault: Callable[[Any], None], seconds: float) -> None:
    motion = axis.start_move(1000)
    axis.link.pause(seconds)
    fault(axis)
    for _ in range(2):
        with pytest.raises(EndUnknown, match="the end of the motion is not confirmed") as caught:
            motion.wait(5)
    assert isinstance(caught.value, ProtocolError)
    assert caught.value.requested == 1000 and "\n" not in str(caught.value)
    assert motion.over and motion.result is None
    with pytest.raises(EndUnknown):
        motion.poll()


@pytest.mark.parametrize("fault", FAULTS[:2])
def test_a_reset_during_a_waited_call(axis: Any, fault: Callable[[Any], None]) -> None:
    """Calls that wait raise the error for any motion."""
    calls: list[Callable[[Callable[[Any], None]], Any]] = [
        lambda look: axis.move(-3000, progress=look),
        lambda look: axis.move_to(axis.position + 3000, progress=look),
        lambda look: axis.move_constant(2000, 1500, progress=look),
        lambda look: axis.home(CCW, progress=look),
        lambda look: axis.home(CCW, fast=True, progress=look),
        lambda look: axis.home(CCW, to_limit=True, progress=look),
    ]
    for call in calls:
        axis.initialise(1000, 5000, 100)
        done = []

        def look(now: Any, done: list[int] = done) -> None:
            if not done and now.done > 20:
                done.append(1)
                fault(axis)

        with pytest.raises(EndUnknown):
            call(look)
        assert done


@pytest.mark.parametrize("pulses", [1, 2, 1000, -700])
def test_a_reset_after_the_last_pulse_is_no_end_although_the_count_agrees(axis: Any, pulses: int) -> None:
    motion = axis.start_move(pulses)
    axis.link.pause(2)
    reset_part(axis)
    with pytest.raises(EndUnknown):
        motion.wait(5)


@pytest.mark.parametrize("way", ["jog", "search", "constant"])
def test_a_reset_of_other_motions(axis: Any, way: str) -> None:
    motion = {
        "jog": lambda: axis.jog(CW, high=True),
        "search": lambda: axis.search(CCW),
        "constant": lambda: axis.start_constant(500, 1200),
    }[way]()
    axis.link.pause(0.1)
    reset_part(axis)
    with pytest.raises(EndUnknown) as caught:
        motion.wait(5)
    assert caught.value.requested == (500 if way == "constant" else None)


def test_a_stop_of_a_motion_that_a_reset_ended(axis: Any) -> None:
    axis.jog(CW)
    axis.link.pause(0.1)
    reset_part(axis)
    with pytest.raises(EndUnknown):
        axis.stop()
    with pytest.raises((NothingToStop, NotInitialised)):
        axis.stop()
    axis.initialise(1000, 5000, 100)
    assert axis.move(50).complete


def test_a_reset_between_two_moves_is_refused_by_the_part(axis: Any) -> None:
    assert axis.move(300).complete
    reset_part(axis)
    with pytest.raises(ProtocolError if isinstance(axis, BankAxis) else NotInitialised):
        axis.move_to(600)  # a bank counts in the part, so the reset has cleared its counter


def test_a_counter_that_jumped_contradicts_the_status(axis: Any) -> None:
    motion = axis.start_move(1000)
    axis.link.pause(0.1)
    jump(axis)
    with pytest.raises(EndUnknown, match=r"finish status 0x83 says 1000 pulses, 960 of 1000 pulses counted"):
        motion.wait(5)


def test_a_stop_with_a_wrong_count_is_not_confirmed_either(axis: Any) -> None:
    motion = axis.start_move(1000)
    axis.link.pause(0.1)
    jump(axis)
    with pytest.raises(EndUnknown, match="finish status 0xC3 says"):
        axis.stop()
    assert motion.over


def test_the_counter_is_not_cleared_during_a_motion(axis: Any) -> None:
    """`zero` is rejected during a motion, because the counter is compared at its end.

    A bank stores the offset in the program, so `zero` is allowed there.
    """
    motion = axis.start_move(1000)
    axis.link.pause(0.1)
    if hasattr(axis, "_in_open_group"):
        axis.zero()
    else:
        with pytest.raises(AxisBusy):
            axis.zero()
    axis.link.pause(2)
    axis.zero()
    assert motion.wait().complete and axis.position == 0


@pytest.mark.parametrize("value", [0xFF, 0x7F, 0x4C, 0xF8])
def test_a_floating_bus_is_no_motion_without_end(
    axis: Any, value: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """If status bits that a device always returns as 0 are read as 1, no device drives the bus.

    The driver reports this as an error, not as the end of a motion (P104-STA-05, P2104-STA-07).
    """
    motion = axis.start_move(1000)
    monkeypatch.setattr(port_of(axis).board, "read", lambda a: value)
    with pytest.raises(ProtocolError, match=f"status 0x{value:02X} does not exist"):
        motion.wait(5)
    assert not motion.over
    monkeypatch.undo()
    assert motion.wait(5).complete


def test_a_bus_that_reads_0_confirms_no_end(axis: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    """If every read returns 0, as on a bus that is stuck low, BUSY = 0 is not reported as the end."""
    motion = axis.start_move(1000)
    board = port_of(axis).board
    read = board.read
    # the original read is called, so the access takes its time
    monkeypatch.setattr(board, "read", lambda a: read(a) & 0)
    with pytest.raises(Timeout, match="the part did not react in time"):
        motion.wait(5)
    assert not motion.over and motion.result is None


# ---------------------------------------------------------------------- several axes


@pytest.mark.parametrize("fault", [reset_part, replace_board])
def test_axes_that_move_together(fault: Callable[[Any], None]) -> None:
    with opened("ppmc2104-x") as x:
        part = x.part
        part.y.initialise(1000, 5000, 100)
        motions = part.start_moves(3000, -2000)
        x.link.pause(0.1)
        fault(x)
        for motion in motions:
            with pytest.raises(EndUnknown, match=r"axis [12]: the end"):
                motion.wait(5)
        part.x.initialise(1000, 5000, 100)
        part.y.initialise(1000, 5000, 100)
        with pytest.raises(EndUnknown):
            part.move_together(3000, -2000, progress=lambda now: fault(x))


@pytest.mark.parametrize("fault", [reset_part, replace_board])
def test_a_group_of_a_bank(fault: Callable[[Any], None]) -> None:
    with opened("bank") as third:
        bank = third._bank
        for one in bank.axes:
            one.initialise(1000, 5000, 100)
        motions = bank.start_moves({1: 1000, 2: -500, 4: 30})
        third.link.pause(0.1)
        fault(third)
        for motion in motions.values():
            with pytest.raises(EndUnknown, match=r"axis [124]: the end"):
                motion.wait(5)
        for one in bank.axes:
            one.initialise(1000, 5000, 100)
        with pytest.raises(EndUnknown):
            bank.move_together({1: 3000, 2: -500}, progress=lambda now: fault(third))


def test_one_axis_of_a_group_without_a_confirmed_end_stops_the_others() -> None:
    with opened("bank") as third:
        bank = third._bank
        for one in bank.axes:
            one.initialise(1000, 5000, 100)
        changed = []

        def look(now: Any) -> None:
            if not changed:
                changed.append(1)
                bank.axis[1].motion.begin += 7

        with pytest.raises(EndUnknown, match="axis 1: "):
            bank.move_together({1: 600, 2: 90_000}, progress=look)
        assert bank.axis[2].motion.result.cause is Cause.STOP
        assert not bank.status().busy


def test_a_bank_that_was_reset_while_a_group_was_held() -> None:
    with opened("bank") as third:
        bank = third._bank
        with bank.group((3,)):
            motion = third.start_move(100)
            reset_part(third)
        with pytest.raises(EndUnknown):
            motion.wait(5)


def test_one_axis_of_a_ppmc2104_without_a_confirmed_end_stops_the_other() -> None:
    with opened("ppmc2104-x") as x:
        part = x.part
        part.y.initialise(1000, 5000, 100)

        def look(now: Any) -> None:
            x.motion.begin = 7

        with pytest.raises(EndUnknown, match="axis 1: "):
            part.move_together(600, 90_000, progress=look)
        assert part.y.motion.result.cause is Cause.STOP


def test_stop_all_of_a_bank_that_was_reset() -> None:
    with opened("bank") as third:
        third.jog(CW)
        reset_part(third)
        with pytest.raises(EndUnknown):
            third._bank.stop_all()


@contextmanager
def free_part() -> Iterator[Any]:
    with Ppmc312.open("model:speed=max,part=ppmc312", SLOW) as part:
        part.initialise(4000, 8000, 600)
        yield part


@contextmanager
def station() -> Iterator[Any]:
    with Ppmc312Bus.open("model:speed=max,stations=2", 83_333) as bus:
        bus.axis(1).initialise(4000, 8000, 600)
        yield bus.axis(1)


@contextmanager
def controller() -> Iterator[Any]:
    with Pmc006.open(Spoiled("speed=max,eeprom=none", 9600, "pmc006"), 255) as motor:
        motor.start_speed = motor.stop_speed = motor.max_speed = 2000
        yield motor


def reset_other(axis: Any) -> None:
    """Reset the device, which is connected to a bridge or to a line, through its reset pin."""
    port = getattr(axis.link, "port", None) or axis.link._port
    board = port.board if hasattr(port, "board") else port.line.stations[-1]
    board.reset()
    axis.link.pause(0.05)
    while getattr(board.part, "booting", False):
        axis.link.pause(0.01)


OTHERS = {"ppmc312": free_part, "ppmc312-serial": station, "pmc006": controller}


@pytest.fixture(params=OTHERS)
def other(request: pytest.FixtureRequest) -> Iterator[Any]:
    with OTHERS[request.param]() as ready:
        yield ready


LOST = r"the position was -?\d+ and now reads 0, because the part was reset or lost its power"


@pytest.mark.parametrize("way", ["position", "initialise"])
def test_a_restart_after_a_move_loses_the_position(axis: Any, way: str) -> None:
    """At 115 200 baud, a board that was off for a short time responds as before.

    A position of 0 is then an error, not the position of the motor.
    """
    assert axis.move(300).complete
    replace_board(axis)
    with pytest.raises(ProtocolError, match=LOST):
        if way == "position":
            axis.position  # noqa: B018
        else:
            axis.initialise(1000, 5000, 100)
    axis.initialise(1000, 5000, 100)
    assert axis.position == 0
    assert axis.move(-20).position == -20 == axis.position


def test_a_restart_clears_the_origin_of_a_bank(axis: Any) -> None:
    """The error states the position that the object reported. Afterwards the position is 0."""
    axis.move(200)
    axis.zero()
    axis.move(30)
    replace_board(axis)
    with pytest.raises(ProtocolError, match=r"the position was 30 and now reads 0"):
        axis.position  # noqa: B018
    assert axis.position == 0 and axis.setup is None


def test_a_position_of_0_is_no_restart(axis: Any) -> None:
    """A position of 0 is returned without an error if motions, or `zero`, have caused it."""
    for way in (300, -300):
        assert axis.move(way).complete
        axis.initialise(1000, 5000, 100)
    assert axis.position == 0
    motion = axis.start_move(40)
    axis.link.pause(1)
    assert axis.position == 40 and motion.wait().complete
    axis.zero()
    assert axis.position == 0
    axis.move(5)
    axis.part.reset() if hasattr(axis, "part") else getattr(axis, "_bank", axis).reset()
    assert axis.position == (0 if isinstance(axis, BankAxis) else 5)


def test_a_restart_of_the_other_parts_loses_the_position(other: Any) -> None:
    if isinstance(other, Pmc006):
        other.max_speed = 2000
    assert other.move(300).complete
    reset_other(other)
    with pytest.raises(ProtocolError, match=LOST):
        other.position  # noqa: B018
    assert other.position == 0
    other.set_position(70)
    other.zero()
    assert other.position == 0
    other.set_position(70)
    reset_other(other)
    with pytest.raises(ProtocolError, match=LOST):
        other.start_move(30) if isinstance(other, Pmc006) else other.initialise(4000, 8000, 600)


@pytest.mark.parametrize("begin", [0, 500])
@pytest.mark.parametrize("way", ["wait", "poll", "progress"])
def test_a_reset_of_the_other_parts(other: Any, begin: int, way: str) -> None:
    """A reset is detected even in a move to position 0, which is also the value of the counter after a reset
    (P006-POS-01).
    """
    if begin:
        other.set_position(4000)
    motion = other.start_move(-4000)
    other.link.pause(0.1)
    reset_other(other)
    with pytest.raises(EndUnknown, match="the end of the motion is not confirmed") as caught:
        if way == "wait":
            motion.wait(5)
        elif way == "progress":
            motion.wait(5, progress=lambda now: None)
        else:
            while motion.poll() is not None:
                pass
    assert motion.over and motion.result is None and caught.value.requested == 4000
    with pytest.raises(EndUnknown):
        motion.wait(5)


@pytest.mark.parametrize("forward", [False, True])
def test_a_reset_of_other_motions_of_the_other_parts(other: Any, forward: bool) -> None:
    signs = isinstance(other, Pmc006)
    motion = other.jog((1 if forward else -1) if signs else (CW if forward else CCW))
    other.link.pause(0.1)
    reset_other(other)
    with pytest.raises(EndUnknown):
        motion.wait(5)


def test_a_move_forward_to_0_that_a_reset_ended() -> None:
    """A reset in a move to position 0 is detected although the counter is 0, because the speed has its
    factory value again.
    """
    with controller() as motor:
        motor.set_position(-4000)
        motion = motor.start_move(4000)
        motor.link.pause(0.1)
        reset_other(motor)
        with pytest.raises(EndUnknown, match="4000 of 4000 steps counted, position 0"):
            motion.wait(5)
        motor.start_speed = motor.stop_speed = motor.max_speed = 2000
        motor.set_position(-4000)
        assert motor.move(4000).complete and motor.position == 0


@pytest.mark.parametrize("part", ["ppmc104", "ppmc2104", "stmc", "bank", "ppmc312"])
@pytest.mark.parametrize("words", [["move", "3000"], ["move", "--speed", "2000", "3000"], ["jog", "cw"]])
def test_a_command_whose_motion_a_reset_ends(
    part: str, words: list[str], monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    write, done = ModelPort.write, []

    def and_reset(port: ModelPort, data: bytes) -> None:
        if not done and port.board.positions[0] > 4200:
            done.append(1)
            port.board.reset()
        write(port, data)

    monkeypatch.setattr(ModelPort, "write", and_reset)
    assert main(["--part", part, "--port", "model:speed=max", *words]) == 1 and done
    told = capsys.readouterr().err
    assert told.startswith("error: ") and "is not confirmed" in told and told.count("\n") == 1


# ---------------------------------------------------------------------- values


@pytest.mark.parametrize("operation", range(8))
@pytest.mark.parametrize("finish", range(256))
def test_each_finish_status(finish: int, operation: int) -> None:
    """Bit 7 and the operation confirm the end (P104-RD-03, STMC-FIN-01); if a cause bit is set, pulses must
    remain.
    """
    good = finish & 0x80 and finish & 7 == operation >= 2
    for remaining, moved in ((0, 10), (0, 9), (3, 6), (9, 0), (10, -1), (3, 7), (0, 0), (0xFFFFFF, 10)):
        cause = finish & 0x78
        if not cause and operation == 7 and moved != 10:
            fits = remaining < 10 and remaining + 1 == 10 - moved
        elif cause:
            fits = remaining < 10 and remaining + 1 == 10 - moved
        else:
            fits = remaining == 0 and moved == 10
        if good and fits:
            end = decode_end(finish, remaining, 10, 0, 77, operation, moved)
            assert end.pulses == moved and end.remaining == 10 - moved
            assert end.complete is (moved == 10) and bool(end.cause) is not end.complete
        else:
            with pytest.raises(EndUnknown):
                decode_end(finish, remaining, 10, 0, 77, operation, moved)


@pytest.mark.parametrize("finish", [0x00, 0x03, 0x80, 0x81, 0xFF & ~0x80])
def test_a_status_of_no_motion(finish: int) -> None:
    """A status that belongs to no motion does not confirm an end.

    This also holds for another program's motion, and without a pulse counter.
    """
    with pytest.raises(EndUnknown, match="finish status 0x"):
        decode_end(finish, 0, None, CW, None)
    with pytest.raises(EndUnknown):
        decode_end(finish, 0, 1000, CW, 247)


def test_a_search_through_all_pulses_is_no_origin() -> None:
    """A search that ends after all its pulses is reported as complete, not as ended at the origin.

    The status and the remaining pulses are the same if the origin ends the search one pulse earlier.
    """
    assert decode_end(0x87, 0, ENDLESS, CW, None, 7).cause is Cause.ORIGIN
    assert decode_end(0x87, 0, ENDLESS, CCW, -5, 7, 1 - ENDLESS).cause is Cause.ORIGIN
    assert decode_end(0x87, 0, ENDLESS, CCW, -5, 7, -ENDLESS).complete


def test_the_counter_wraps() -> None:
    assert decode_end(0x83, 0, ENDLESS, CW, -1, 3, ENDLESS).complete
    assert decode_end(0x83, 0, 10, CW, -1, 3, 10 - (1 << 32)).complete


def test_an_end_that_contradicts_itself_is_not_complete() -> None:
    assert MotionResult(Cause.COMPLETE, 5, 0, 5, 0x83).check(5).complete
    for end, asked in (
        (MotionResult(Cause.COMPLETE, 3, 2, 3, 0), 5),
        (MotionResult(Cause.COMPLETE, 3, 0, 3, 0), 5),
    ):
        with pytest.raises(EndUnknown, match="3 of 5 pulses counted, position 3"):
            end.check(asked)
    assert not MotionResult(Cause.COMPLETE, 3, 2, 3, 0).complete
    assert not issubclass(EndUnknown, MotionError)
