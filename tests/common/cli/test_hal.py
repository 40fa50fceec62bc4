"""`openppmc hal` with a module `hal` of this test: pins, motions, faults and stops, on the golden models."""

from __future__ import annotations

import math
import os
import re
import signal
import sys
from collections.abc import Callable, Iterator
from functools import partial
from types import ModuleType
from typing import Any

import pytest

from cocotb_tests.harness.paths import ROOT
from openppmc import host, linuxcnc
from openppmc.cli import main
from openppmc.cli.common import hal as command

PARTS = ("ppmc104", "ppmc2104", "stmc", "ppmc312", "bank", "ppmc312-serial", "pmc006")
EXAMPLE = ROOT / "examples" / "linuxcnc"
LINES = ("ppmc312-serial", "pmc006")
MOST_CYCLES = 5000
Run = Callable[..., str]
Story = Callable[["Component"], Iterator[Callable[[], object]]]
"""Generator that acts as LinuxCNC: it writes pins, and yields the conditions for which it waits."""


class Component(dict[str, Any]):
    """Replacement for a HAL component. After each cycle it continues the story if the awaited condition is
    true; at the end of the story, it sends SIGTERM.
    """

    def __init__(self, story: Story) -> None:
        self.story, self.steps = story, 0
        self.exits = 0

    def newpin(self, name: str, kind: str, side: str) -> None:
        self[name] = {"FLOAT": 0.0, "BIT": False, "S32": 0}[kind]

    def newparam(self, name: str, kind: str, access: str) -> None:
        assert (kind, access) == ("FLOAT", "RW")
        self[name] = 0.0

    def ready(self) -> None:
        self.running = self.story(self)
        self.condition = next(self.running)

    def exit(self) -> None:
        self.exits += 1

    def __setitem__(self, name: str, value: Any) -> None:
        super().__setitem__(name, value)
        if name == "group-done" and hasattr(self, "condition"):
            self.steps += 1
            assert self.steps < MOST_CYCLES, dict(self)
            if self.condition():
                try:
                    self.condition, self.steps = next(self.running), 0
                except StopIteration:
                    self.condition = lambda: False
                    os.kill(os.getpid(), signal.SIGTERM)
                    os.kill(os.getpid(), signal.SIGTERM)


@pytest.fixture
def hal(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Run:
    """Run `openppmc hal` with a story; return the text on stderr."""

    def run(story: Story, port: str, *words: str) -> str:
        module, made = ModuleType("hal"), []
        vars(module).update({f"HAL_{word}": word for word in ("FLOAT", "BIT", "S32", "IN", "OUT", "RW")})
        vars(module)["component"] = lambda name: made.append(Component(story)) or made[0]
        monkeypatch.setitem(sys.modules, "hal", module)
        before, _, after = " ".join(words).rpartition("|")
        code = main(["--port", port, *before.split(), "hal", *after.split()])
        error = capsys.readouterr().err
        assert code == 143 and made[0].exits == 1, error
        return error

    return run


@pytest.fixture
def devices(monkeypatch: pytest.MonkeyPatch) -> list[Any]:
    """Collect the devices that the command opens."""
    found: list[Any] = []

    def collect(connect: Any, *words: Any, **options: Any) -> Any:
        found.append(connect(*words, **options))
        return found[-1]

    for owner, name in ((command, "open_board"), (host.Pmc006Bus, "open")):
        monkeypatch.setattr(owner, name, partial(collect, getattr(owner, name)))
    return found


class Axis:
    """Pins of one axis as attributes: without the prefix of the axis, and with _ in place of -."""

    def __init__(self, pins: Component, number: int) -> None:
        vars(self).update(pins=pins, number=number, prefix=f"{number}.")

    def __getattr__(self, name: str) -> Any:
        return self.pins[self.prefix + name.replace("_", "-")]

    def __setattr__(self, name: str, value: Any) -> None:
        self.pins[self.prefix + name.replace("_", "-")] = value


def cycles(count: int) -> Callable[[], bool]:
    """Return a condition that is true after this number of cycles."""
    left = [True] * count
    return lambda: not left.pop() if left else True


@pytest.mark.parametrize("part", PARTS)
def test_axis_of_every_part(part: str, hal: Run) -> None:
    """An axis moves and homes in its units; a change during a move is executed after the move."""
    number = {"ppmc2104": 2, "bank": 3}.get(part, 1)

    def story(pins: Component) -> Iterator[Callable[[], object]]:
        axis = Axis(pins, number)
        axis.scale = -10.0
        axis.position_cmd = 5.0
        yield cycles(3)
        assert not (axis.busy or axis.in_position or axis.homed or axis.fault) and axis.position_fb == 0
        axis.position_cmd = 0.0
        yield cycles(1)
        axis.enable = True
        yield cycles(3)
        assert not axis.busy and not axis.in_position and axis.position_fb == 0
        axis.position_cmd = -20.0
        yield lambda: axis.in_position
        assert axis.position_fb == -20 and not axis.busy and not axis.homed
        axis.position_cmd = -50.0
        yield lambda: axis.busy and axis.position_fb < -21
        axis.position_cmd = 30.0
        axis.position_cmd = -30.0
        yield lambda: axis.position_fb == -50
        assert axis.busy and not axis.in_position
        yield lambda: axis.in_position
        assert axis.position_fb == -30 and not axis.fault
        axis.home = True
        yield lambda: axis.busy
        axis.position_cmd = 7.0
        yield lambda: axis.homed or axis.fault
        yield cycles(2)
        assert axis.position_fb == 0 and not axis.busy and not axis.in_position and not axis.fault
        axis.position_cmd = -3.04
        yield lambda: axis.in_position
        assert axis.position_fb == -3

    words = ",address=1" if part == "pmc006" else ""
    error = hal(story, f"model:speed=max{words}", f"--part {part} | --axes {number}")
    assert "SIGTERM: nothing was moving, " in error and "position 30" in error


@pytest.mark.parametrize("part", PARTS)
def test_enable_falls(part: str, hal: Run) -> None:
    """When `enable` falls, the motor decelerates without a fault. It moves again only when `enable` is set
    and `position-cmd` changes.
    """
    seen = []

    def story(pins: Component) -> Iterator[Callable[[], object]]:
        axis = Axis(pins, 1)
        axis.enable, axis.velocity = True, 2000.0
        yield cycles(1)
        axis.position_cmd = 20_000.0
        yield lambda: axis.position_fb > 1000
        axis.enable, begin = False, axis.position_fb
        yield lambda: not axis.busy
        assert not axis.in_position and not axis.fault
        seen.append(axis.position_fb - begin)
        axis.enable, begin = True, axis.position_fb
        yield cycles(5)
        assert not axis.busy and not axis.in_position and axis.position_fb == begin < 20_000
        axis.position_cmd = begin - 10
        yield lambda: axis.in_position
        axis.position_cmd = 20_000.0
        yield lambda: axis.position_fb > begin + 100

    words = ",address=1" if part == "pmc006" else ""
    error = hal(story, f"model:speed=max{words}", f"--part {part} | --axes 1")
    assert "SIGTERM: stopped, " in error and error.count("\n") == 1
    assert 20 < seen[0] < 3000


@pytest.mark.parametrize(
    ("words", "position", "code", "positive", "homed"),
    (
        ("cw=500,slow_cw=9000", 600.0, 3, True, False),
        ("slow_cw=500", 1200.0, 3, False, True),
        ("alarm=300..9000", 600.0, 4, False, False),
        ("", math.nan, 6, False, True),
        ("", 1e9, 6, False, True),
    ),
)
def test_faults(words: str, position: float, code: int, positive: bool, homed: bool, hal: Run) -> None:
    """A motion that ends early and an impossible value are faults; after `reset` the axis moves again."""

    def story(pins: Component) -> Iterator[Callable[[], object]]:
        axis = Axis(pins, 1)
        axis.enable = axis.home = True
        yield lambda: axis.homed
        axis.position_cmd = position
        yield lambda: axis.fault
        yield cycles(2)
        assert (axis.fault_code, axis.limit_pos, axis.homed, axis.busy) == (code, positive, homed, False)
        axis.scale = -1.0
        yield cycles(1)
        assert (axis.limit_neg, axis.limit_pos) == (positive, False)
        axis.scale = 1.0
        axis.position_cmd = 7.0
        yield cycles(3)
        assert axis.fault and not axis.busy and not axis.in_position
        axis.reset = True
        yield lambda: not axis.fault
        assert not axis.busy and not axis.in_position
        axis.position_cmd = 10.0
        yield lambda: axis.in_position or axis.fault_code == code == 4

    error = hal(story, f"model:speed=max,start=100,slow_ccw=-300,{words}", "|")
    assert error.startswith(f"openppmc: axis 1: fault {code}: ")


def test_alarm_state(hal: Run, devices: list[Any]) -> None:
    """A PPMC-312 keeps its alarm state after the alarm; `reset` ends it."""

    def story(pins: Component) -> Iterator[Callable[[], object]]:
        axis = Axis(pins, 1)
        axis.enable = True
        yield cycles(1)
        axis.position_cmd = 9000.0
        yield lambda: axis.position_fb > 100
        devices[0].link.port.board.set_pins(alm_n=0)
        yield lambda: axis.fault
        assert (axis.fault_code, axis.homed, axis.in_position) == (4, False, False)
        axis.reset = True
        yield lambda: axis.fault_code == 8
        devices[0].link.port.board.set_pins(alm_n=1)
        axis.reset = False
        yield cycles(1)
        axis.reset = True
        yield lambda: not axis.fault
        axis.position_cmd = 1000.0
        yield lambda: axis.in_position

    hal(story, "model:speed=max", "--part ppmc312 |")


def test_parameters(hal: Run, devices: list[Any]) -> None:
    """Velocities and accelerations, which HAL states in units of length, determine the set-up of the axis; an
    impossible value is a fault.
    """

    def story(pins: Component) -> Iterator[Callable[[], object]]:
        axis = Axis(pins, 1)
        axis.scale, axis.velocity, axis.acceleration, axis.enable = -10.0, 800.0, 20_000.0, True
        yield cycles(1)
        setup = devices[0].setup
        assert (setup.high.requested, setup.start.requested, setup.ramp_pulses) == (8000, 1500, 155)
        axis.velocity, axis.start_velocity, axis.acceleration = 100.0, 70.0, 0.0
        axis.position_cmd = 3.0
        yield lambda: axis.in_position
        setup = devices[0].setup
        assert (setup.high.requested, setup.start.requested, setup.ramp_pulses) == (1000, 700, 300)
        axis.velocity, axis.position_cmd = 60.0, 2.0
        yield lambda: axis.in_position
        assert devices[0].setup.start.requested == devices[0].setup.high.requested == 600
        axis.velocity, axis.position_cmd = 1e6, 4.0
        yield lambda: axis.fault_code == 6

    assert "high speed 1e+07 pps is outside" in hal(story, "model:speed=max", "| --start 1500 --ramp 300")


def test_unconfirmed_end(hal: Run, devices: list[Any]) -> None:
    """After a reset of the part during a move, the axis is neither in position nor homed."""

    def story(pins: Component) -> Iterator[Callable[[], object]]:
        axis = Axis(pins, 1)
        axis.enable = axis.home = True
        yield lambda: axis.homed
        axis.position_cmd = 9000.0
        yield lambda: axis.position_fb > 100
        devices[0].link.port.board.reset()
        yield lambda: axis.fault
        assert (axis.fault_code, axis.in_position, axis.homed) == (1, False, False)
        axis.reset = True
        yield lambda: not axis.fault
        axis.position_cmd = 50.0
        yield lambda: axis.in_position

    hal(story, "model:speed=max,slow_ccw=-300", "|")


def test_unplugged_port(hal: Run, devices: list[Any]) -> None:
    """A lost port is a fault, after which the component continues; `reset` opens the port again."""

    def story(pins: Component) -> Iterator[Callable[[], object]]:
        axis = Axis(pins, 2)
        axis.enable = axis.home = True
        yield lambda: axis.homed
        axis.position_cmd = 39_000.0
        yield lambda: axis.fault
        assert (axis.fault_code, axis.in_position, axis.homed, axis.busy) == (2, False, False, False)
        assert axis.position_fb > 1000 and pins["1.fault"] and len(devices) == 1
        yield cycles(3)
        axis.reset = True
        yield lambda: not axis.fault
        assert len(devices) == 2 and not axis.busy and not axis.homed and not pins["1.fault"]
        axis.position_cmd = 5.0
        yield lambda: axis.in_position

    error = hal(story, "model:speed=max,unplug=8", "--part ppmc2104 |")
    assert error.startswith("openppmc: axis 1: fault 2: ") and error.count("the port went away") == 1


def test_homing_of_two_axes(hal: Run) -> None:
    """Axes home one after the other; others move at the same time. Without `enable`, homing is abandoned."""

    def story(pins: Component) -> Iterator[Callable[[], object]]:
        one, two, three = (Axis(pins, number) for number in (1, 2, 3))
        one.enable = two.enable = three.enable = one.home = two.home = True
        one.home_velocity = -600.0
        yield lambda: one.busy and two.busy
        three.home = True
        yield lambda: three.busy
        three.enable = False
        yield lambda: not three.busy
        three.enable, three.home = True, False
        yield cycles(1)
        three.position_cmd = 100.0
        yield lambda: three.in_position
        assert one.busy and two.busy and not (one.homed or two.homed) and one.position_fb < 0
        yield lambda: one.homed
        assert two.busy and not two.homed
        yield lambda: two.homed
        two.home = False
        two.position_cmd = 3000.0
        yield lambda: two.in_position
        two.home = True
        yield lambda: two.busy and two.position_fb < 2900
        two.enable = False
        yield lambda: not two.busy
        assert not two.homed and not two.fault and (begin := two.position_fb) > 1000 and not three.homed
        yield cycles(10)
        assert two.position_fb == begin
        three.home, three.home_velocity = True, 500.0
        yield lambda: three.fault
        assert (three.fault_code, three.homed) == (7, False)
        one.position_cmd, one.home = 1000.0, False
        yield lambda: one.in_position
        one.home = True
        yield lambda: one.busy and one.position_fb < 990

    error = hal(story, "model:speed=max,start=1000,cw=4000,slow_cw=3500", "--part bank | --axes 1-3")
    assert "SIGTERM: stopped, axis 1: position " in error


@pytest.mark.parametrize("part", ("ppmc2104", "bank", *LINES))
def test_group(part: str, hal: Run, devices: list[Any], monkeypatch: pytest.MonkeyPatch) -> None:
    """Armed axes start together. No axis moves if one of them cannot start, and an early end of one motion
    stops all.
    """

    def story(pins: Component) -> Iterator[Callable[[], object]]:
        one, two = Axis(pins, 1), Axis(pins, 2)
        one.arm = two.arm = one.enable = two.enable = True
        one.velocity = two.velocity = 2000.0
        one.position_cmd, two.position_cmd = 300.0, -200.0
        yield cycles(3)
        assert not one.busy and not two.busy
        pins["group-start"] = True
        yield lambda: pins["group-done"]
        assert (one.position_fb, two.position_fb) == (300, -200) and one.in_position and two.in_position
        pins["group-start"] = False
        yield lambda: not pins["group-done"]
        two.enable, one.position_cmd = False, 400.0
        yield cycles(1)
        pins["group-start"] = True
        yield lambda: one.fault
        assert (one.fault_code, two.fault_code, pins["group-done"]) == (9, 9, False)
        assert one.position_fb == 300 and not one.busy
        pins["group-start"], two.enable, one.reset, two.reset = False, True, True, True
        yield lambda: not one.fault and not two.fault
        one.position_cmd, two.position_cmd = 20_000.0, 30_000.0
        pins["group-start"] = True
        yield lambda: one.position_fb > 700
        assert two.position_fb > 0
        two.enable = False
        yield lambda: not one.busy and not two.busy
        assert (one.fault_code, two.fault_code, pins["group-done"]) == (9, 0, False)
        assert one.position_fb < 20_000 and two.position_fb < 30_000

    words = ",address=1..2" if part == "pmc006" else ""
    hal(story, f"model:speed=max{words}", f"--part {part} | --axes 1,2")


def test_group_waits(hal: Run) -> None:
    """A group starts only after running motions of its members have ended."""

    def story(pins: Component) -> Iterator[Callable[[], object]]:
        one, two = Axis(pins, 1), Axis(pins, 2)
        one.enable = two.enable = two.arm = True
        yield cycles(1)
        one.position_cmd, two.position_cmd = 2000.0, 300.0
        yield lambda: one.position_fb > 100
        one.arm = True
        one.position_cmd = 2100.0
        pins["group-start"] = True
        yield lambda: two.position_fb > 0
        assert 2000 <= one.position_fb < 2100 and two.busy and not one.fault
        yield lambda: pins["group-done"]
        assert (one.position_fb, two.position_fb) == (2100, 300)

    hal(story, "model:speed=max", "--part ppmc2104 |")


def test_pmc006(hal: Run, devices: list[Any]) -> None:
    """EXT1 and EXT2 are the limits, `reset` clears their flags, and an abandoned homing restores speeds."""

    def story(pins: Component) -> Iterator[Callable[[], object]]:
        axis = Axis(pins, 1)
        axis.enable, axis.velocity, axis.start_velocity, axis.acceleration = True, 1500.0, 700.0, 4000.0
        yield cycles(1)
        axis.position_cmd = 9000.0
        yield lambda: axis.fault
        assert (axis.fault_code, axis.limit_pos, axis.limit_neg) == (3, True, False)
        axis.reset = True
        yield lambda: not axis.fault
        axis.position_cmd = 2800.0
        yield lambda: axis.in_position
        axis.home = True
        yield lambda: axis.position_fb < 2500
        axis.enable = axis.home = False
        yield lambda: not axis.busy
        axis.enable = True
        yield cycles(1)
        motor = devices[0].axis(1)
        speeds = motor.max_speed, motor.start_speed, motor.stop_speed, motor.acceleration, motor.stops
        assert speeds == (1500, 700, 700, 1, 3)
        axis.position_cmd = 400.0
        yield lambda: axis.in_position
        axis.acceleration, axis.position_cmd = 1000.0, 500.0
        yield lambda: axis.fault_code == 6

    hal(story, "model:speed=max,address=1,low=0,high=3000,start=100", "--part pmc006 |")


def test_group_start_fails(hal: Run, devices: list[Any]) -> None:
    """If a station of a group rejects its start, those that have started are stopped."""

    def story(pins: Component) -> Iterator[Callable[[], object]]:
        one, two = Axis(pins, 1), Axis(pins, 2)
        one.enable = two.enable = one.arm = two.arm = True
        one.position_cmd = two.position_cmd = 9000.0
        yield cycles(1)
        devices[0].axis(2).free = 1
        pins["group-start"] = True
        yield lambda: one.fault and two.fault and not one.busy
        assert (one.fault_code, two.fault_code, two.position_fb) == (8, 8, 0)
        begin = one.position_fb
        yield cycles(10)
        assert one.position_fb == begin < 9000

    hal(story, "model:speed=max,address=1..2", "--part pmc006 |")


def test_group_of_64_axes(hal: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    """One call of the library starts all axes of the largest bank, so that they start in the same cycle
    (BANK-GRP-02).
    """
    groups: list[dict[int, int]] = []
    start_moves = host.PpmcBank.start_moves.function
    monkeypatch.setattr(
        host.PpmcBank,
        "start_moves",
        lambda bank, moves: groups.append(dict(moves)) or start_moves(bank, moves),
    )

    def story(pins: Component) -> Iterator[Callable[[], object]]:
        axes = [Axis(pins, number) for number in range(1, 65)]
        for axis in axes:
            axis.arm = axis.enable = True
            axis.position_cmd = 10.0 * (axis.number - 32)
        yield cycles(2)
        pins["group-start"] = True
        yield lambda: pins["group-done"]
        assert [axis.position_fb for axis in axes] == [10 * (number - 32) for number in range(1, 65)]

    hal(story, "model:speed=max,axes=64,clk=64000000", "--part bank | --ramp 100")
    assert groups == [{number: 10 * (number - 32) for number in range(1, 65) if number != 32}]


@pytest.mark.parametrize(
    ("part", "message"),
    (("ppmc104", "axis 5: a PPMC-104 has one axis"), ("pmc006", "controller 5: no reply")),
)
def test_no_such_axis(
    part: str, message: str, hal: Run, devices: list[Any], capsys: pytest.CaptureFixture[str]
) -> None:
    """A missing axis is reported in one line, and the port is closed, so that it can be opened again."""
    with pytest.raises(AssertionError, match=message):
        hal(lambda pins: iter(()), "model:speed=max", f"--part {part} | --axes 5")
    with pytest.raises(host.Disconnected):
        devices[0].link.port.read(0)


def test_without_linuxcnc(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    """Without the module `hal`, the command prints one line."""
    monkeypatch.setitem(sys.modules, "hal", None)
    assert main(["--port", "model:", "hal"]) == 1
    error = capsys.readouterr().err
    assert error.startswith("error: LinuxCNC's Python module hal cannot") and error.count("\n") == 1


@pytest.mark.parametrize("name", ("indexer.hal", "index.ngc"))
def test_page_quotes_the_example(name: str) -> None:
    """docs/coming_from.md contains the files of the example, which `make test WITH=linuxcnc` runs."""
    page = (ROOT / "docs/coming_from.md").read_text(encoding="utf-8")
    assert page.split(f"```text {name}\n")[1].split("```")[0] == (EXAMPLE / name).read_text(encoding="utf-8")


def test_page_names_every_pin() -> None:
    """The tables of the page have all pins, parameters and fault codes."""
    page = (ROOT / "docs/coming_from.md").read_text(encoding="utf-8")
    rows = " ".join(re.findall(r"^\| (.*?) \|", page, re.M))
    names = {*linuxcnc.INPUTS, *linuxcnc.OUTPUTS, *linuxcnc.PARAMETERS, "group-start", "group-done"}
    assert {name for name in names if f"`{name}`" not in rows} == set()
    assert re.findall(r"^\| ([\d, ]+) \|", page, re.M) == ["1", "2", "3, 4", "5", "6", "7", "8", "9", "10"]
    assert len(linuxcnc.FAULTS) == 10
