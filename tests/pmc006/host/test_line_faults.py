"""Frames and replies of PMC006B4 that are lost, cut, damaged, doubled, merged or late.

Replies of another station are also tested.
"""

from __future__ import annotations

import random
from collections.abc import Callable

import pytest

from openppmc.host import BACKWARD, FORWARD, Cause, Disconnected, NoAnswer, Pmc006, Pmc006Bus, PpmcError
from openppmc.host.line import CorruptReply, LostReply, StationNotResponding
from openppmc.host.pmc006.station_link import Line
from openppmc.host.pmc006.wire import (
    ExtStopActive,
    Flags,
    ProgramRuns,
    ProgramVerifyFailed,
    Receiver,
    Reply,
    StorageBusy,
    command,
    reply,
)
from openppmc.model.pmc006.program import Program, assemble
from tests.common.host.line_ports import Played
from tests.pmc006.host.line_ports import (
    CHANGED_REPLY,
    CUT_FRAME,
    CUT_REPLY,
    DOUBLE_REPLY,
    FATES,
    HARMLESS,
    HEARD,
    LATE_REPLY,
    LOSE_FRAME,
    LOSE_REPLY,
    UNHEARD,
    SpoiledLine,
    once,
    one,
)


def quick(text: str = "eeprom=none", address: int = 255) -> tuple[SpoiledLine, Pmc006]:
    """Return a controller with fast steps."""
    port, part = one(text, address)
    for name in ("max_speed", "start_speed", "stop_speed"):
        setattr(part, name, 2000)
    port.frames.clear()
    return port, part


def count(port: SpoiledLine, letter: str) -> int:
    return sum(frame[2] == ord(letter) for frame in port.frames)


# ---------------------------------------------------------------------- starts


@pytest.mark.parametrize("fate", FATES)
@pytest.mark.parametrize("steps", [40, -3, 300])
def test_a_start_with_a_fault_moves_once(steps: int, fate: str) -> None:
    """For any fault of a start or of its reply, the motor moves exactly the commanded distance."""
    port, part = quick()
    with part:
        port.plan = once("s", fate)
        assert part.move(steps).position == steps == part.position == port.node().position - 4000
        assert count(port, "s") == 1 + (fate in UNHEARD)
        assert part.counters.faults == (fate not in HARMLESS)


@pytest.mark.parametrize("fate", FATES)
def test_a_free_run_with_a_fault_runs_once(fate: str) -> None:
    port, part = quick()
    with part:
        port.plan = once("N", fate)
        motion = part.jog(BACKWARD)
        assert count(port, "N") == 1 + (fate in UNHEARD) and motion.poll() is not None
        port.plan = once("N", fate)
        end = part.stop()
        assert end is not None and end.cause is Cause.STOP and end.position == part.position < 0


@pytest.mark.parametrize("letter", ["j", "c"])
def test_a_start_is_settled_in_spite_of_more_faults(letter: str) -> None:
    """If the replies to a start and to the next reads are lost, the driver still confirms the start."""
    port, part = quick()
    with part:
        plans = [once("s", LOSE_REPLY), once(letter, LOSE_REPLY, 3, skip=1)]
        port.plan = lambda frame: next(filter(None, [plan(frame) for plan in plans]), None)
        assert part.move(5).position == 5 and count(port, "s") == 1


def test_a_controller_that_falls_silent_after_a_start() -> None:
    port, part = quick()
    with part:
        port.plan = lambda frame: LOSE_REPLY if frame[2] == ord("s") or count(port, "s") else None
        with pytest.raises(
            LostReply, match="the reply to an instruction was lost, so it may have been executed"
        ):
            part.move(5)


@pytest.mark.parametrize("steps", [3, -90])
def test_a_controller_that_was_reset_after_a_start(steps: int) -> None:
    """If the controller loses its power during a move from position 0, the start is not sent again.

    The position reads 0 again, as before the start, but the motor has moved.
    """
    port, part = quick()
    with part:

        def plan(frame: bytes) -> str | None:
            if frame[2] == ord("j") and count(port, "s"):
                port.plan = lambda frame: None
                port.node().reset()
            return LOSE_REPLY if frame[2] == ord("s") else None

        port.plan = plan
        with pytest.raises(LostReply, match="the controller was reset since"):
            part.move(steps)
        assert count(port, "s") == 1 and part.motion is None


def test_a_locked_start_is_no_start() -> None:
    """A start that EXT locks raises ExtStopActive, even if the reply to the start is lost."""
    port, part = quick("eeprom=none,low=3995")
    with part:
        part.stops = 1
        part.jog(BACKWARD).wait()
        port.plan = once("s", LOSE_REPLY)
        with pytest.raises(ExtStopActive):
            part.move(40)
        assert port.node().position == 3995


def test_an_implausible_reply_to_a_start_is_looked_into() -> None:
    port, part = quick()
    with part:
        port.plan = once("s", CHANGED_REPLY)  # the check byte of this reply is wrong
        assert part.move(5).position == 5
    played = Played(*[reply(255, value).hex() for value in (8, 1, 7)], reply(255, 77).hex())
    played.replies += [reply(255, value) for value in (9, 8, 12)]
    with Pmc006(Line(played)) as part:
        assert part.start_move(5).wait().pulses == 5
    assert [frame[2] for frame in played.frames] == [ord(letter) for letter in "jdcsjjc"]


# ---------------------------------------------------------------------- all other instructions


@pytest.mark.parametrize("fate", FATES)
def test_what_may_be_repeated_is(fate: str) -> None:
    port, part = quick("eeprom=new")
    steps: dict[str, Callable[[], object]] = {
        "e": lambda: setattr(part, "current", 1200),
        "v": lambda: setattr(part, "max_speed", 2400),
        "L": lambda: part.start_speed,
        "m": lambda: setattr(part, "microsteps", 8),
        "f": lambda: part.enable_stops(),
        "b": lambda: part.clear_stops((1,)),
        "p": lambda: part.clear_stall(),
        "c": lambda: part.position,
        "R": lambda: part.version(),
        "i": lambda: part.set_position(-7),
        "y": lambda: setattr(part, "outputs", 21),
        "t": lambda: part.save(),
        "w": lambda: part.set_address(44),
    }
    with part:
        for letter, step in steps.items():
            port.frames.clear()
            port.plan = once(letter, fate)
            step()
            repeats = 1 + (fate not in HARMLESS)
            if letter == "w":
                repeats = 1 + (fate in UNHEARD)
            assert count(port, letter) == repeats, letter
        port.plan = lambda frame: None
        assert (part.current, part.max_speed, part.microsteps, part.stops) == (1200, 2400, 8, 3)
        assert (part.position, part.outputs, part.address) == (-7, 21, 44)


@pytest.mark.parametrize("fate", [LOSE_FRAME, LOSE_REPLY, CHANGED_REPLY, LATE_REPLY, DOUBLE_REPLY])
def test_a_program_arrives_whole(fate: str) -> None:
    """A program is loaded completely: if the reply to a word is lost, the driver knows that the pointer has
    advanced.
    """
    program = assemble("again: CNTI\nCMP counter, 7\nJNE again\nOUT gpo2, 1")
    port, part = quick()
    with part:
        plans = [once(letter, fate, 2, skip) for letter, skip in (("A", 1), ("W", 3), ("G", 5))]
        port.plan = lambda frame: next(filter(None, [plan(frame) for plan in plans]), None)
        part.load_program(program)
        assert tuple(port.node().part.context.program.words) == program.words
        assert part.counters.faults == 0 if fate in HARMLESS else part.counters.faults >= 5


@pytest.mark.parametrize("fate", [LOSE_REPLY, CHANGED_REPLY])
def test_a_program_is_read_in_spite_of_faults(fate: str) -> None:
    port, part = quick()
    with part:
        port.node().part.context.program.words[:] = range(1, 201)
        port.plan = once("G", fate, 2, skip=7)
        assert (
            part.read_program().words == tuple(range(1, 201))
            and part.counters.garbled + part.counters.silent == 2
        )


def test_a_program_that_does_not_stay() -> None:
    """A program word that the part does not store correctly is detected."""
    port, part = quick()

    def plan(frame: bytes) -> None:
        if frame[2] == ord("G") and count(port, "W"):
            port.node().part.context.program.words[0] |= 0x100

    with part:
        port.plan = plan
        with pytest.raises(ProgramVerifyFailed, match="word 0 of the program reads 00000101, not 00000001"):
            part.load_program(assemble("ROT 5"))


def test_half_a_frame_is_forgotten_before_the_next() -> None:
    """After an incomplete frame, the driver sends the next frame only when the controller has discarded the
    bytes that it received.

    At 1200 bit/s, a controller waits longer for the rest of a frame than the master waits for a reply.
    """
    port = SpoiledLine("eeprom=none", 1200)
    with Pmc006(Line(port, 1200, patience=0.03)) as part:
        port.plan = once("n", CUT_FRAME)
        assert part.current == 800 and part.counters.faults == 1


def test_a_program_starts_once() -> None:
    """If the reply to `z` is lost but the program runs, the driver detects this and does not start it again.

    If no program runs, a short program may already have ended, so LostReply is raised.
    """
    port, part = quick()
    with part:
        part.load_program(assemble("WAIT gpi1, 0"))
        for fate in HEARD:
            port.plan = once("z", fate)
            part.run_program()
            assert count(port, "z") == 1
            part.halt_program()
            port.frames.clear()
        port.plan = once("z", LOSE_FRAME)
        with pytest.raises(LostReply, match="no program runs now, but a short one may have run"):
            part.run_program()
        port.plan = once("E", LOSE_REPLY)
        with pytest.raises(LostReply, match="it is unknown whether"):
            part.try_instruction(0)


def test_programs_are_not_disturbed() -> None:
    port, part = quick()
    with part:
        part.load_program(assemble("OUT 1, 1\nhere: WAIT gpi1, 0\nOUT 2, 1\nROT 30\nJMP here"))
        part.run_program()
        assert part.program_runs() and part.outputs == 1
        for call in (lambda: part.load_program(Program()), part.run_program, lambda: part.try_instruction(3)):
            with pytest.raises(ProgramRuns, match="a user program runs: halt it first"):
                call()
        part.offline = 1
        part.halt_program()
        assert part.offline == 1 and not part.program_runs()
        port.node().set_pins(gpi=0x1E)
        part.try_instruction(3)
        part.line.pause(0.05)
        assert part.outputs == 1 and part.position == 30
        part.run_program(2)
        part.line.pause(0.001)
        assert part.outputs == 3


def test_the_eeprom_takes_its_time() -> None:
    with Pmc006(Line(Played(reply(5, 0).hex())), 5) as part:
        with pytest.raises(StorageBusy, match="the EEPROM is still being written"):
            part.burn_program()
    with Pmc006(Line(Played(*[reply(5, 1).hex()] * 11)), 5) as part:
        with pytest.raises(StorageBusy, match="the EEPROM is still being written"):
            part.save()


# ---------------------------------------------------------------------- causes of errors


@pytest.mark.parametrize(
    ("replies", "error", "text"),
    [
        ([], StationNotResponding, r"played: controller 5: no reply to 5 frames: is it there and powered"),
        (
            ["A5 7A 05 03"] * 5,
            CorruptReply,
            "only garbled replies, 5 times: noise, another baud rate, or two",
        ),
        (["00 FF 13"] * 5, CorruptReply, "only garbled replies"),
        (
            [reply(6, 0).hex()] * 5,
            CorruptReply,
            "another station replied, 5 times: check for a second master",
        ),
        ([reply(5, 99).hex()] * 5, CorruptReply, "only garbled replies"),
    ],
)
def test_what_is_told(replies: list[str], error: type[Exception], text: str) -> None:
    with pytest.raises(error, match=text), Pmc006(Line(Played(*replies)), 5) as part:
        part.flags()


def test_replies_are_found_among_others() -> None:
    """A reply is found after noise, after a reply of another station, after the master's own echo, and after
    a cut reply.
    """
    mine, other = reply(5, -2), reply(6, 77)
    sent = command(5, ord("c"))
    for before in (
        b"",
        b"\x00\xa5",
        other,
        sent,
        sent + other,
        mine[:5],
        other[:7],
        b"\xa5\x7a\xa5",
        sent[:4],
    ):
        receiver = Receiver(5, sent)
        got = [receiver.feed(byte) for byte in before + mine]
        assert got[-1] == Reply(5, -2) and set(got[:-1]) <= {None}, before
    receiver = Receiver(5, sent)
    assert [receiver.feed(byte) for byte in sent] == [None] * 8 and receiver.fault is None


def test_two_with_one_address() -> None:
    """Two controllers with one address send equal replies without an error; different replies are garbled."""
    with Pmc006Bus.open("model:speed=max,address=3,twin=3") as bus:
        assert bus.scan([3])[0].problem == ""
        for number, board in enumerate(bus.line.port.line.stations):  # type: ignore[attr-defined]
            board.part.context.settings.exten = 1 + number
        found = bus.scan([3, 4])
        assert len(found) == 1 and "two controllers with this address" in found[0].problem


def test_late_replies_do_not_answer_the_next_question() -> None:
    """A late reply is never accepted as the reply to the next frame.

    If all replies are late, the controller counts as not responding; when they are in time again, they are
    accepted.
    """
    port, part = quick()
    with part:
        port.plan = lambda frame: LATE_REPLY
        with pytest.raises(StationNotResponding):
            part.flags()
        port.plan = once("j", LATE_REPLY)
        assert part.flags() == Flags.parse(8) and part.position == 0
        port.frames.clear()
        port.plan = lambda frame: LATE_REPLY if count(port, "A") < 2 else None
        assert part.flags() == Flags.parse(8) and count(port, "A") == 3


def test_the_port_goes_away() -> None:
    with Pmc006Bus.open("model:speed=max,address=3,unplug=0.05") as bus, pytest.raises(Disconnected):
        bus.axis(3).jog(FORWARD).wait()
    with Pmc006(Line(Played()), 3) as part:
        part.line.close()
        with pytest.raises(Disconnected, match="the line is closed"):
            part.flags()


@pytest.mark.parametrize("seed", range(3))
def test_noise(seed: int) -> None:
    """With one character in 60 damaged in both directions, the motor makes the right number of steps.

    If the driver cannot determine the result, it raises an error; a later read of the position is correct.
    """
    part = Pmc006.open(f"model:speed=max,eeprom=none,noise=60,seed={seed}", 255)
    generator = random.Random(seed)
    with part:
        for name in ("max_speed", "start_speed", "stop_speed"):
            setattr(part, name, 3000)
        wanted = 0
        for _ in range(12):
            steps = generator.choice([-1, 1]) * generator.randrange(1, 80)
            try:
                part.move(steps)
            except NoAnswer as error:
                raise AssertionError(f"seed {seed}") from error
            except PpmcError as error:
                print(f"seed {seed}: {error}")
                part.line.pause(0.1)
                wanted = part.position
                continue
            wanted += steps
            assert part.position == wanted == part.line.port.line.stations[0].part.position  # type: ignore[attr-defined]
        assert part.counters.faults


def test_cut_replies_of_reads() -> None:
    port, part = quick()
    with part:
        port.plan = once("x", CUT_REPLY, 4)
        assert part.ports().inputs == 31 and part.counters.garbled == 4
        port.plan = once("x", CUT_REPLY, 5)
        with pytest.raises(CorruptReply):
            part.ports()
