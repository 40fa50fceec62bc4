"""Driver of the PMC006B4 on the golden model, without faults on the line."""

from __future__ import annotations

import doctest
from collections.abc import Iterator
from pathlib import Path

import pytest

from openppmc.host import (
    BACKWARD,
    FORWARD,
    AlarmStop,
    AxisBusy,
    Cause,
    EndUnknown,
    LimitReached,
    NothingToStop,
    OriginNotFound,
    OutOfRange,
    Pmc006,
    Pmc006Bus,
    PortError,
    StoppedByCommand,
    Timeout,
)
from openppmc.host.line import DuplicateAddress, StationNotResponding
from openppmc.host.pmc006 import settings, wire
from openppmc.host.pmc006 import wire as codes
from openppmc.host.pmc006 import wire as errors
from openppmc.host.pmc006.settings import SETTINGS, drive_current, setting
from openppmc.host.pmc006.wire import (
    ExtStopActive,
    MotorDisabled,
    SettingRefused,
    SpeedRefused,
    StorageFailed,
)
from openppmc.model.pmc006.program import Instruction, Program, assemble
from openppmc.model.pmc006.settings import LEGAL, PLACES
from tests.pmc006.host.line_ports import SpoiledLine, one, several

FACTORY = {
    "microsteps": 16,
    "current": 800,
    "max_speed": 1000,
    "start_speed": 600,
    "stop_speed": 600,
    "acceleration": 0,
    "deceleration": 0,
    "auto_decay": 1,
    "attenuation": 1,
    "current_compensation": 300,
    "speed_compensation": 1250,
    "trigger": 0,
    "offline": 0,
    "stops": 0,
    "direction": 1,
    "free": 0,
    "stall_length": 64,
    "stall_config": 0,
    "stall_level": 0,
}
OTHERS = {
    "microsteps": 1,
    "current": 1500,
    "max_speed": 16_000,
    "start_speed": 65,
    "stop_speed": 3000,
    "acceleration": 5,
    "deceleration": 4,
    "auto_decay": 0,
    "attenuation": 4,
    "current_compensation": 1200,
    "speed_compensation": 2000,
    "trigger": 3,
    "offline": 1,
    "stops": 2,
    "direction": 0,
    "free": 1,
    "stall_length": 63,
    "stall_config": 7,
    "stall_level": 511,
}
QUICK = {"start_speed": 2000, "stop_speed": 2000, "max_speed": 2000}


@pytest.fixture
def motor() -> Iterator[tuple[SpoiledLine, Pmc006]]:
    """Provide a controller whose motor is at 4000, with EXT1 at 3800 and EXT2 at 4400; its steps are fast."""
    port, part = one("low=3800,high=4400,eeprom=none")
    with part:
        for name, value in QUICK.items():
            setattr(part, name, value)
        port.frames.clear()
        yield port, part


def test_factory_values_and_settings(motor: tuple[SpoiledLine, Pmc006]) -> None:
    port, _ = motor
    with one()[1] as part:
        assert {name: getattr(part, name) for name in SETTINGS} == FACTORY
        for name, value in OTHERS.items():
            setattr(part, name, value)
        assert {name: getattr(part, name) for name in SETTINGS} == OTHERS
        assert part.counters.faults == 0


@pytest.mark.parametrize("name", SETTINGS)
def test_what_is_out_of_range_is_not_sent(motor: tuple[SpoiledLine, Pmc006], name: str) -> None:
    port, part = motor
    for value in (-1, 3 << 20, -2):
        with pytest.raises(OutOfRange, match=f"{name} .*: there are {SETTINGS[name].span}"):
            setattr(part, name, value)
    for wrong in (2.5, "1", None, *([] if SETTINGS[name].accepts == range(2) else [True])):
        with pytest.raises(OutOfRange, match=f"{name} .* is not a whole number"):
            setattr(part, name, wrong)
    assert port.frames == []


def test_full_steps_are_called_1(motor: tuple[SpoiledLine, Pmc006]) -> None:
    _, part = motor
    with pytest.raises(OutOfRange, match=r"^microsteps 0: there are 1, 2, 4, .*, 128; 1 is the full step$"):
        part.microsteps = 0
    part.microsteps = 1
    assert part.microsteps == 1 and part.execute(codes.Code.READ_MICROSTEPS) == 0


def test_settings_explain_themselves() -> None:
    assert setting("Max-Speed").unit == "steps/s" and "1 to 16000 steps/s" in (
        SETTINGS["max_speed"].__doc__ or ""
    )
    with pytest.raises(OutOfRange, match="no setting 'speed': there are microsteps, current, max_speed"):
        setting("speed")
    assert [drive_current(current) for current in (400, 474, 475, 3924, 3925, 4000)] == [
        400,
        400,
        550,
        3850,
        4000,
        4000,
    ]


def test_a_value_that_the_part_refuses_is_told(motor: tuple[SpoiledLine, Pmc006]) -> None:
    """If the part rejects a setting, the driver raises an error: builds may have other ranges, so the reply
    decides.
    """
    _, part = motor
    node = settings.SETTINGS["current"]
    odd = settings.Setting(node.write, node.read, range(10_000), "0 to 9999", "")
    object.__setattr__(odd, "name", "current")
    with pytest.raises(SettingRefused, match="current 4321 was rejected; it is still 800"):
        odd.__set__(part, 4321)


def test_read_outs(motor: tuple[SpoiledLine, Pmc006]) -> None:
    port, part = motor
    assert (
        part.version() == "V0.1.35"
        and part._location.endswith("controller 255")
        and part._message_prefix == ""
    )
    assert part.flags() == codes.Flags(False, False, False, True, False)
    assert part.modes() == codes.Modes(False, False, False, False, True, False)
    port.node().set_pins(gpi=0b10001)
    assert part.ports() == codes.Ports(0b10001, 0, True, True)
    part.outputs = 0b01010
    part.set_output(1, True)
    part.set_output(4, False)
    assert part.outputs == port.node().part.outputs["gpo"] == 0b00011
    for call in (lambda: part.set_output(6, True), lambda: setattr(part, "outputs", 32)):
        with pytest.raises(OutOfRange, match=r"there are|outputs 32 is outside 0 to 31"):
            call()


def test_moves(motor: tuple[SpoiledLine, Pmc006]) -> None:
    port, part = motor
    seen: list[int] = []
    assert part.move(300, progress=lambda now: seen.append(now.done)) == part.motion.result  # type: ignore[union-attr]
    assert part.position == 300 and port.node().position == 4300 and seen
    end = part.move_to(-100, speed=2500)
    assert (end.cause, end.pulses, end.position, end.complete) == (Cause.COMPLETE, -400, -100, True)
    assert part.max_speed == 2500
    assert part.move(0).position == -100 and part.move_to(-100).pulses == 0
    part.zero()
    assert part.position == 0
    part.set_position(-(1 << 31))
    assert part.move(-1).position == (1 << 31) - 1  # the position overflows
    for call in (lambda: part.start_move(1 << 31), lambda: part.set_position(1 << 31), lambda: part.jog(0)):
        with pytest.raises(OutOfRange):
            call()


def test_what_may_not_be_done_in_a_motion(motor: tuple[SpoiledLine, Pmc006]) -> None:
    _, part = motor
    motion = part.start_move(300)
    assert motion.poll() is not None and part.motion is motion
    for call in (lambda: part.move(1), lambda: part.jog(FORWARD), part.zero):
        with pytest.raises(AxisBusy, match="the motor is moving"):
            call()
    with pytest.raises(Timeout):
        motion.wait(timeout=0.01)
    assert motion.wait().complete and motion.poll() is None


def test_free_runs(motor: tuple[SpoiledLine, Pmc006]) -> None:
    _, part = motor
    part.start_speed = part.stop_speed = 500
    motion = part.jog(FORWARD, speed=600)
    assert part.modes().running and part.flags().busy
    part.change_speed(800)
    part.line.pause(0.05)
    end = part.stop()
    assert (
        end is motion.result
        and end is not None
        and end.cause is Cause.STOP
        and end.position == part.position > 30
    )
    assert not part.modes().running
    motion = part.jog(BACKWARD)
    part.halt()
    assert motion.result is not None and motion.result.cause_text == "stop command"
    with pytest.raises(StoppedByCommand, match="stop command ended the motion at position .*: start again"):
        motion.result.check()
    for stop in (part.stop, part.halt):
        with pytest.raises(NothingToStop, match="nothing to stop: the motor is at standstill"):
            stop()


def test_a_move_is_stopped_with_its_ramp(motor: tuple[SpoiledLine, Pmc006]) -> None:
    """A stop of a move reduces the maximum speed, waits for the end at the stop speed, and restores the
    setting.
    """
    port, part = motor
    part.acceleration = part.deceleration = 5
    part.start_speed = part.stop_speed = 300
    speeds: list[int] = []

    def look(frame: bytes) -> None:
        if frame[2] == ord("I"):
            speeds.append(port.node().part.motion.engine.speed)

    port.plan = look
    part.max_speed = 4000
    motion = part.start_move(100_000)
    part.line.pause(0.12)
    end = part.stop()
    assert end is not None and end.cause is Cause.STOP and 300 < end.position == part.position < 900
    assert part.max_speed == 4000 and motion.result is end and speeds == [300]
    with pytest.raises(StoppedByCommand, match=rf"after {end.position} of 100000 steps"):
        end.check(motion.requested)
    part.max_speed = 300
    part.start_move(1000)
    assert part.stop() is not None and part.max_speed == 300


def test_motions_of_other_programs(motor: tuple[SpoiledLine, Pmc006]) -> None:
    port, part = motor
    other = Pmc006(part.line, 255)
    other.jog(FORWARD)
    end = part.stop()
    assert end is not None and end.pulses is None and end.cause is Cause.STOP
    other.start_move(1000)
    end = part.halt()
    assert end is not None and end.position == other.position
    motion = other.start_move(1000)
    part.halt()
    with pytest.raises(EndUnknown, match="of 1000 steps counted"):
        motion.wait()


def test_emergency_stops(motor: tuple[SpoiledLine, Pmc006]) -> None:
    port, part = motor
    assert part.move(410).complete  # the stop is not enabled, so the motor passes the switch
    assert part.move(-410).complete
    part.enable_stops()
    with pytest.raises(
        LimitReached, match="EXT2 ended the motion at position 400 after 400 of 900 steps: clear"
    ):
        part.move(900)
    assert part.flags().stops == (2,) and part.on_switch(2) and not part.on_switch(1)
    for call in (lambda: part.move(-5), lambda: part.jog(BACKWARD)):
        with pytest.raises(ExtStopActive, match="EXT2 has stopped the motor: clear the flag"):
            call()
    part.clear_stops((2,))
    assert part.move(-100).complete
    motion = part.jog(BACKWARD)
    assert motion.wait().cause_text == "EXT1"
    part.clear_stops()
    part.stops = 0
    assert part.move(50).complete
    port.node().set_pins(ext1=1, ext2=1)
    part.trigger = 3
    assert part.on_switch(1)
    with pytest.raises(OutOfRange, match="EXT3: there are EXT1 and EXT2"):
        part.on_switch(3)


def test_refusals_say_why(motor: tuple[SpoiledLine, Pmc006]) -> None:
    port, part = motor
    part.free = 1
    with pytest.raises(MotorDisabled, match="the motor is off-line"):
        part.move(5)
    part.free = 0
    with pytest.raises(SpeedRefused, match=r"maximum speed of 100 steps/s is below the start speed \(2000\)"):
        part.move(5, speed=100)
    motion = part.jog(FORWARD, speed=100)  # the start speed does not limit a free run
    part.halt()
    assert motion.result is not None
    port.node().part.context.settings.vmax = 0  # only a program can set this value
    with pytest.raises(SpeedRefused, match="the maximum speed is 0"):
        part.jog(FORWARD)


def test_stalls(motor: tuple[SpoiledLine, Pmc006]) -> None:
    port, part = motor
    part.watch_stall(256, 2, output=True)
    motion = part.jog(FORWARD)
    node = port.node()
    for _ in range(3):
        node.set_pins(bemf_level=100, bemf_valid=1)
        node.set_pins(bemf_valid=0)
        part.line.pause(0.002)
    end = motion.wait()
    assert end.cause_text == "stall" and end.position == part.stall_position and part.outputs == 0b10000
    with pytest.raises(
        AlarmStop, match="stall ended the motion at position .*: remove what blocks the motor"
    ):
        end.check()
    part.clear_stall()
    assert part.outputs == 0 and not part.flags().stall


@pytest.mark.parametrize("start", [4000, 3790])
@pytest.mark.parametrize("microsteps", [16, 32])
def test_homing_on_ext1(start: int, microsteps: int) -> None:
    """Homing on EXT1 ends at the same position, even if the motor starts on the switch."""
    port, part = one(f"low=3800,high=4400,start={start},eeprom=none")
    with part:
        part.microsteps = microsteps
        part.acceleration = 2
        before = {name: getattr(part, name) for name in SETTINGS}
        end = part.home(1, BACKWARD, speed=1500, slow=400, off=60)
        assert end.position == part.position == 0 and part.flags().stops == ()
        assert port.node().position == 3800 + 60 * 16 // microsteps
        assert {name: getattr(part, name) for name in SETTINGS} == before


def test_homing_on_ext2_and_wrong_ways(motor: tuple[SpoiledLine, Pmc006]) -> None:
    port, part = motor
    part.enable_stops()
    part.home(2, FORWARD, speed=2000, slow=500, off=30)
    assert port.node().position == 4370 and part.stops == 3
    with pytest.raises(OriginNotFound, match="EXT1 ended the search for EXT2: home in the other direction"):
        part.home(2, BACKWARD, speed=2000)
    for wrong in ({"speed": 64}, {"slow": 3001}, {"off": 0}, {"switch": 3}):
        with pytest.raises(OutOfRange):
            part.home(**wrong)


def test_homing_with_a_dead_switch(
    motor: tuple[SpoiledLine, Pmc006], monkeypatch: pytest.MonkeyPatch
) -> None:
    _, part = motor
    monkeypatch.setattr("openppmc.host.pmc006.axis.LONGEST_WAY_OFF", 200)
    monkeypatch.setattr(Pmc006, "on_switch", lambda self, number: True)
    with pytest.raises(OriginNotFound, match="EXT1 is still active after a move of 300 steps away"):
        part.home(1, off=100, slow=2000)


def test_what_is_saved_comes_back(tmp_path: Path) -> None:
    text = f"eeprom={tmp_path / 'ee.bin'}"
    with one(text)[1] as part:
        part.set_address(7)
        part.current, part.start_speed, part.max_speed = 1750, 700, 900
        part.save()
        part.current = 400
    with one(text, address=7)[1] as part:
        assert (part.current, part.start_speed, part.max_speed, part.position) == (1750, 700, 1000, 0)


def test_a_save_that_fails_is_an_error() -> None:
    """After a failed save, a read of V makes the driver raise an error; with a working EEPROM a later save
    succeeds.
    """
    port, part = one("eeprom=none")
    with part:
        for call in (part.save, part.burn_program):
            with pytest.raises(StorageFailed, match="the EEPROM did not respond, so nothing was stored"):
                call()
        port.node().eeprom.missing = False
        part.save()
        part.burn_program()


def test_the_example_program_of_the_rules() -> None:
    """Program P1 makes three moves of 200 steps, then sets GPO1, as in P006-AC-39 and P006-AC-40."""
    port, part = one()
    with part:
        words = [(3, 1), (8, 3200), (12, 0), (1, 200), (0x810, 0), (11, 0), (0x812, 3), (14, 3), (0x111, 1)]
        made = assemble(
            "DIR 1\nVSET 0, 3200\nCNTC\ngo: ROT 200\nWAIT 8, 0\nCNTI\nCMP 8, 3\nJNE go\nOUT 1, 1\nEND"
        )
        assert made == Program.of(Instruction.of(*pair) for pair in words)
        part.load_program(made)
        assert tuple(port.node().part.context.program.words) == made.words and part.read_program() == made
        part.run_program()
        part.process_reports(0.8)
        assert part.program_runs() and part.outputs == 0
        part.process_reports(0.3)
        assert not part.program_runs() and (part.position, part.outputs, part.max_speed) == (600, 1, 3200)


def test_ranges_are_those_of_the_part() -> None:
    """The driver accepts exactly those values that the model accepts."""
    names = {
        "microsteps": "mstep",
        "current": "cur",
        "max_speed": "vmax",
        "start_speed": "vstart",
        "stop_speed": "vstop",
        "acceleration": "acc",
        "deceleration": "dec",
        "auto_decay": "autodec",
        "attenuation": "att",
        "current_compensation": "ccomp",
        "speed_compensation": "scomp",
        "trigger": "trigm",
        "offline": "offline",
        "stops": "exten",
        "direction": "dir",
        "free": "free",
        "stall_length": "stlen",
        "stall_config": "stcfg",
        "stall_level": "stlvl",
    }
    assert set(names) == set(SETTINGS)
    for name, register in names.items():
        one_setting, legal = SETTINGS[name], LEGAL[register]
        ours = {one_setting.data(value) for value in range(-2, 17_000) if value in one_setting.accepts}
        assert ours == {value for value in range(-2, 17_000) if value in legal}, name
        assert one_setting.saved is (register in PLACES), name


def test_addresses() -> None:
    port, bus = several("address=1..2")
    with bus:
        x, y = bus.axis(1), bus.axis(2)
        with pytest.raises(DuplicateAddress, match="address 2 is taken"):
            x.set_address(2)
        x.set_address(1)
        for wrong in (0, 121, 255):
            with pytest.raises(OutOfRange, match="outside 1 to 120"):
                x.set_address(wrong)
        x.set_address(3)
        assert x.address == x.number == 3 and x.version() == "V0.1.35" and y.version()
        with pytest.raises(OutOfRange, match="controllers have 1 to 120, factory-new ones 255"):
            bus.axis(122)


def test_a_line_with_several() -> None:
    port, bus = several("address=5+9+255")
    with bus:
        seen: list[int] = []
        found = bus.scan(progress=seen.append)
        assert [one.address for one in found] == [255, 5, 9] and seen[:2] == [255, 1] and len(seen) == 121
        assert {one.version for one in found} == {"V0.1.35"} and not found[0].problem
        bus.check([5, 9])
        with pytest.raises(StationNotResponding, match="controller 6: no reply to 4 frames: is it there"):
            bus.check([6])
        five, nine = bus.axis(5), bus.axis(9)
        ends = bus.wait([five.start_move(60), nine.start_move(-90)])
        assert [end.position for end in ends] == [60, -90]
        five.jog(FORWARD)
        nine.start_move(300)
        bus.process_reports(0.05)
        ends = bus.stop([5, 9])
        assert [end.cause_text for end in ends] == ["stop command"] * 2 and bus.axis(255).position == 0
        with pytest.raises(AxisBusy, match="controller 9: the motor is moving"):
            nine.jog(FORWARD)
            nine.jog(FORWARD)
        nine.halt()
        with pytest.raises(OutOfRange, match="no motion to wait for"):
            bus.wait([bus.axis(255)])


def test_the_first_that_answers() -> None:
    with Pmc006.open("model:speed=max,address=3+8") as part:
        assert part.address == 3 and part.axes == (part,) and part.link is part.line
    with pytest.raises(StationNotResponding, match="no controller replies: are they powered"):
        Pmc006.open("model:speed=max,baud=19200")


def test_other_builds_and_adapters() -> None:
    """Moves also work if the reply to instruction s echoes its data, at another baud rate, and if the adapter
    receives its own bytes.
    """
    for text, baud in (("ack=echo", 9600), ("echo=on", 9600), ("ack=echo,echo=on,clk=25000000", 115_200)):
        with Pmc006.open(f"model:speed=max,eeprom=none,{text}", 255, baud) as part:
            part.max_speed = part.start_speed = part.stop_speed = 3000
            assert part.move(3).complete and part.move(-70).position == -67
            assert part.counters.faults == 0
    with Pmc006Bus.open("model:speed=max,echo=on,address=5") as bus, pytest.raises(StationNotResponding):
        bus.axis(6).version()


def test_an_error_leaves_nothing_running() -> None:
    for begin in (lambda part: part.jog(FORWARD), lambda part: part.start_move(10_000)):
        port, part = one()
        with pytest.raises(RuntimeError), part:
            begin(part)
            raise RuntimeError
        port.line.run_seconds(0.2)
        assert not port.node().part.outputs["mon_busy"]


@pytest.mark.parametrize(
    ("options", "error", "text"),
    [
        ({"baud": 300}, PortError, "300 bit/s is outside 1200 to 115200"),
        ({"patience": 0}, OutOfRange, "patience 0 s"),
        ({"spec": "model:adress=5"}, PortError, r"unknown word 'adress' \(there are start\[N\]"),
        ({"spec": "/dev/none"}, PortError, "no such port"),
    ],
)
def test_wrong_options(options: dict[str, object], error: type[Exception], text: str) -> None:
    with pytest.raises(error, match=text):
        Pmc006Bus.open(**{"spec": "model:", **options})  # type: ignore[arg-type]


@pytest.mark.parametrize("module", [codes, errors, settings, wire])
def test_examples_in_the_code(module: object) -> None:
    failed, attempted = doctest.testmod(module)  # type: ignore[arg-type]
    assert attempted and not failed
