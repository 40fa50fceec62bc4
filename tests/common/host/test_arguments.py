"""Wrong arguments in Python, for all devices: each raises one clear error, and no byte is sent."""

from __future__ import annotations

import copy
import pydoc
import sys
import threading
import traceback
from collections.abc import Callable, Iterable, Iterator, Sized
from fractions import Fraction
from typing import Any

import pytest

from openppmc.host import (
    CCW,
    OutOfRange,
    Pmc006,
    Pmc006Bus,
    Ppmc104,
    Ppmc312,
    Ppmc312Bus,
    Ppmc2104,
    PpmcError,
    Stmc,
    check,
)
from openppmc.host.check import exact, flag, whole, within
from tests.common.host.line_ports import Spoiled

FAST = "model:speed=max"
BRIDGED = {"ppmc104": Ppmc104, "ppmc2104": Ppmc2104, "stmc": Stmc, "ppmc312": Ppmc312}
WRONG = {
    "int": (2.5, "5", None, True, float("nan"), float("inf"), [1], 1j),
    "Number": ("5", None, True, float("nan"), float("inf"), [1], 1j),
    "float": ("5", None, True, float("nan"), [1]),
    "bool": ("no", None, 2, 0.5, []),
}
HARMLESS: dict[str, Any] = {"block": b"", "path": "", "baud": 9600}


class Index:
    """An integer of another library, such as numpy."""

    def __init__(self, value: int) -> None:
        self.value = value

    def __index__(self) -> int:
        return self.value


class Single:
    """A real number of another library, such as float32 of numpy."""

    def __init__(self, value: float) -> None:
        self.value = value

    def as_integer_ratio(self) -> tuple[int, int]:
        return self.value.as_integer_ratio()


@pytest.fixture(params=[*BRIDGED, "ppmc312-serial", "pmc006"])
def axis(request: pytest.FixtureRequest) -> Iterator[Any]:
    """Open an initialised axis of each device."""
    if request.param == "pmc006":
        with Pmc006.open(Spoiled("speed=max,eeprom=none", 9600, "pmc006"), 255) as motor:
            motor.start_speed = motor.stop_speed = motor.max_speed = 2000
            yield motor
    elif request.param == "ppmc312-serial":
        with Ppmc312Bus.open(f"{FAST},stations=2", 83_333) as bus:
            bus.axis(0).initialise(4000, 8000, 600)
            yield bus.axis(0)
    else:
        with BRIDGED[request.param].open(f"{FAST},part={request.param}") as part:
            one_axis = part.x if request.param == "ppmc2104" else part
            if request.param == "ppmc312":
                one_axis.initialise(4000, 8000, 600)
            else:
                one_axis.initialise(1000, 2000, 100)
            yield one_axis


# ---------------------------------------------------------------------- numbers


def test_whole_numbers_of_any_kind_are_taken() -> None:
    for value in (100, 100.0, Fraction(100), Index(100), Single(100.0)):
        assert type(whole(value, "pulses")) is int and whole(value, "pulses") == 100
    assert whole(-1e6, "pulses") == -1_000_000
    for value in WRONG["int"]:
        with pytest.raises(OutOfRange, match=r"^pulses .* is not a whole number$"):
            whole(value, "pulses")


def test_numbers_and_flags() -> None:
    assert exact(0.1, "speed") == Fraction(0.1) and exact(Single(0.5), "speed") == Fraction(1, 2)
    for value in WRONG["Number"]:
        with pytest.raises(OutOfRange, match=r"^speed .* is not a number$"):
            exact(value, "speed")
    assert [flag(value, "on") for value in (True, False, 1, 0)] == [True, False, True, False]
    for value in WRONG["bool"]:
        with pytest.raises(OutOfRange, match=r"^on .* is neither True nor False$"):
            flag(value, "on")
    assert within(5.0, "outputs", 0, 5) == 5
    with pytest.raises(OutOfRange, match=r"^outputs 6 is outside 0 to 5 V$"):
        within(6, "outputs", 0, 5, "V")


def test_a_whole_number_of_pulses_may_come_as_a_float(axis: Any) -> None:
    assert axis.move(100.0).pulses == 100
    axis.move(Index(-50))
    assert axis.position == 50
    axis.move_to(20.0)
    assert axis.position == 20


@pytest.mark.parametrize("value", [2.5, "5", None, True, float("nan")])
def test_no_part_moves_by_what_is_no_whole_number(axis: Any, value: Any) -> None:
    with pytest.raises(OutOfRange, match=r"(pulses|steps) .* is not a whole number"):
        axis.move(value)
    with pytest.raises(OutOfRange, match="position .* is not a whole number"):
        axis.move_to(value)
    with pytest.raises(OutOfRange, match="direction .* is not a whole number"):
        axis.jog(value)
    assert axis.position == 0 and axis.motion is None


def _quiet(part: Any) -> list[bytes]:
    """Return a list to which all data written from now on is appended."""
    port, sent = part.link.port, []
    write = port.write
    port.write = lambda data: (sent.append(data), write(data))
    return sent


def _wrong_calls(part: Any) -> Iterator[tuple[str, str, dict[str, Any]]]:
    """Yield calls of each public method in which one parameter is wrong; the others are omitted or
    harmless.
    """
    for name in dir(type(part)):
        entry = getattr(type(part), name)
        if name.startswith("_") or not isinstance(entry, check.CheckedMethod):
            continue
        for parameter, kind in entry.kinds.items():
            for value in WRONG[kind.name]:
                if value is not None or not kind.optional:
                    yield name, parameter, {parameter: value}


def test_each_argument_of_each_method_is_checked_before_anything_is_sent(axis: Any) -> None:
    sent, tried = _quiet(axis), set()
    for name, parameter, words in _wrong_calls(axis):
        tried.add((name, parameter))
        with pytest.raises(OutOfRange, match=f"^{parameter} .* is (not|neither)"):
            getattr(axis, name)(**words)
    assert sent == []
    assert {("move", "pulses"), ("move", "steps")} & tried and {
        ("jog", "direction"),
        ("stop", "wait"),
    } <= tried
    assert len(tried) > 20


def test_opening_a_port_checks_numbers_too() -> None:
    for make in (Ppmc104, Ppmc2104, Stmc, Ppmc312, Pmc006, Pmc006Bus):
        with pytest.raises(OutOfRange, match="baud '115200' is not a whole number"):
            make.open(FAST, baud="115200")
    with pytest.raises(OutOfRange, match="speed 19200.5 is not a whole number"):
        Ppmc312Bus.open(FAST, speed=19200.5)
    with pytest.raises(OutOfRange, match="patience nan is not a number"):
        Pmc006Bus.open(FAST, patience=float("nan"))


def test_one_station_whatever_kind_of_number() -> None:
    with Ppmc312Bus.open(f"{FAST},stations=2") as bus:
        assert bus.axis(1.0) is bus.axis(1) is bus.axis(Index(1)) and len(bus.axes) == 1
        for wrong in ("1", 1.5, None, True):
            with pytest.raises(OutOfRange, match="station .* is not a whole number"):
                bus.axis(wrong)
    with Pmc006Bus.open(f"{FAST},address=1..2,eeprom=none") as lines:
        assert lines.axis(2.0) is lines.axis(2) and lines.axis(2.0).address == 2
    with Ppmc2104.open(f"{FAST},part=ppmc2104") as part:
        assert part.axis[1.0] is part.x
        with pytest.raises(OutOfRange, match="axis 3: a PPMC-2104 has axes 1 to 2"):
            part.axis[3]


def test_settings_of_the_pmc006() -> None:
    with Pmc006.open(Spoiled("speed=max,eeprom=none", 9600, "pmc006"), 255) as motor:
        motor.current, motor.free, motor.outputs = 1500.0, True, 3.0
        assert (motor.current, motor.free, motor.outputs) == (1500, 1, 3)
        for wrong in (1500.5, "1500", None, True):
            with pytest.raises(OutOfRange, match="current .* is not a whole number"):
                motor.current = wrong
        with pytest.raises(OutOfRange, match="outputs '3' is not a whole number"):
            motor.outputs = "3"  # type: ignore[assignment]


@pytest.mark.parametrize("mode", ["binary", "chars", "foo", None, 0])
def test_a_checksum_rule_is_a_sum_mode(mode: Any) -> None:
    with pytest.raises(OutOfRange, match=r"there are SumMode\.BINARY and SumMode\.CHARS"):
        Ppmc312Bus.open(f"{FAST},stations=1", sum_mode=mode)


# ---------------------------------------------------------------------- names and parentheses


def test_a_mistyped_name_is_refused(axis: Any) -> None:
    with pytest.raises(PpmcError, match="has no attribute 'positoin': do you mean 'position'") as caught:
        axis.positoin = 0
    assert isinstance(caught.value, AttributeError)
    with pytest.raises(PpmcError, match="'move' is a method"):
        axis.move = 100
    if isinstance(axis, Pmc006):
        with pytest.raises(PpmcError, match="has no attribute 'curent': do you mean 'current'"):
            axis.curent = 1500


class Lamp(check.Checked):
    """A class with one name of each kind: attribute, annotation, property, method, class method."""

    on = False
    watts: float
    """A name that is declared only by its annotation."""
    _spare = 0

    def __init__(self, watts: float) -> None:
        self.watts = watts

    @property
    def dimmed(self) -> bool:
        return self.watts < 5

    @dimmed.setter
    def dimmed(self, value: bool) -> None:
        self.watts = 4 if value else 60

    def blink(self, times: int = 1, self_test: bool = False) -> list[str]:
        """Return the names of the functions on the call stack, this one first."""
        return [frame.f_code.co_name for frame, _ in traceback.walk_stack(sys._getframe())]

    @classmethod
    def large(cls, watts: int) -> Lamp:
        """A class method, which receives the class through which it was called."""
        return cls(watts)


class Lantern(Lamp):
    """A class that declares one more name."""

    handle: str


def test_names_that_a_class_declares_can_be_set() -> None:
    """Properties, class attributes and annotations, also those of bases, can be set in and after
    construction.
    """
    lamp = Lantern(3)
    assert lamp.dimmed
    lamp.on, lamp.watts, lamp.dimmed, lamp.handle, lamp._spare, lamp._new = True, 9.5, False, "brass", 1, 2
    assert (lamp.on, lamp.watts, lamp.handle, lamp._new) == (True, 60, "brass", 2)
    with pytest.raises(AttributeError, match="'Lantern' object has no attribute 'handle'"):
        _ = Lantern(3).handle


def test_names_that_a_class_does_not_declare_are_refused() -> None:
    """Undeclared names are rejected, also in a constructor; the hint may name an attribute without a
    value.
    """
    lamp = Lantern(3)
    for wrong, near in (("handel", "handle"), ("wats", "watts"), ("dimed", "dimmed")):
        with pytest.raises(PpmcError, match=f"^Lantern has no attribute '{wrong}': do you mean '{near}'\\?$"):
            setattr(lamp, wrong, 1)
    with pytest.raises(PpmcError, match="^Lamp has no attribute 'handle'$"):
        Lamp(3).handle = "brass"  # type: ignore[attr-defined]

    class Bad(Lamp):
        def __init__(self) -> None:
            self.shade = 1

    with pytest.raises(PpmcError, match="^Bad has no attribute 'shade'"):
        Bad()


def test_a_checked_call_passes_one_frame() -> None:
    """Between the caller and the method there is only one frame, that of the argument check."""
    lamp = Lamp(3)
    here = "test_a_checked_call_passes_one_frame"
    for called in (lamp.blink(), lamp.blink(2.0), lamp.blink(times=2, self_test=True), Lamp.blink(lamp, 3)):  # type: ignore[arg-type]
        assert called[:3] == ["blink", "__call__", here]


def test_a_class_method_gets_the_class_that_it_was_called_by() -> None:
    """Class methods also check their arguments and keep their docstring."""
    assert type(Lantern.large(60.0)) is Lantern and Lamp(1).large(60).watts == 60  # type: ignore[arg-type]
    with pytest.raises(OutOfRange, match="^watts 'much' is not a whole number$"):
        Lantern.large("much")  # type: ignore[arg-type]
    assert "A class method, which receives the class" in pydoc.plain(pydoc.render_doc(Lantern.large))
    assert "open(spec: 'str | Port', baud: 'int'" in pydoc.plain(pydoc.render_doc(Ppmc104.open))


USES: list[Callable[[Any], object]] = [
    lambda method: method == 0,
    lambda method: method != 1.5,
    lambda method: Fraction(1, 2) == method,
    lambda method: method < 3,
    lambda method: 3 >= method,
    lambda method: method + 1,
    lambda method: 1.5 - method,
    lambda method: method * 2,
    lambda method: method & 1,
    lambda method: -method,
    abs,
]


def test_a_method_is_true_and_comparable_as_those_of_python(axis: Any) -> None:
    """A bound method without a call is true, hashable and equal only to itself, as in Python."""
    motion = axis.start_move(40)
    for thing in (axis, motion):
        names = [
            name for name in dir(type(thing)) if isinstance(getattr(type(thing), name), check.CheckedMethod)
        ]
        assert names
        for name in names:
            method = getattr(thing, name)
            assert method and bool(method) is True and not (not method)
            assert (getattr(thing, name, None) or print) == method and (method and 5) == 5
            assert hasattr(thing, name) and callable(method) and method == getattr(thing, name)
            assert method in [None, "text", True, False, print, method]
            for other in (None, "text", True, False, print, object(), [], {}, (), axis):
                assert method != other and other != method
            assert all([method]) and any([method]) and {method: 1}[method] == 1
            assert not isinstance(method, Iterable | Sized) and not hasattr(method, "__index__")
            assert f"{method}" and [1 if method else 0] == [1]
    motion.wait()


def test_a_method_used_as_a_value_is_reported(axis: Any) -> None:
    names = [name for name in dir(type(axis)) if isinstance(getattr(type(axis), name), check.CheckedMethod)]
    assert {"inputs", "status"} & {*names} or {"flags", "ports", "program_runs", "on_switch"} <= {*names}
    for name in names:
        for use in USES:
            with pytest.raises(TypeError, match=rf"'{name}' is a method: write {name}\("):
                use(getattr(axis, name))
        with pytest.raises(PpmcError, match=rf"'{name}' is a method: write {name}\("):
            _ = getattr(axis, name).busy
    if isinstance(axis, Pmc006):
        assert not axis.program_runs()


def test_motions_are_alike(axis: Any) -> None:
    motion = axis.start_move(40)
    with pytest.raises(TypeError, match=r"'poll' is a method: write poll\("):
        assert motion.poll > 0
    with pytest.raises(OutOfRange, match="timeout 'soon' is not a number"):
        motion.wait(timeout="soon")
    assert motion.wait(timeout=5).complete


def test_methods_are_good_callbacks() -> None:
    with Ppmc104.open(FAST) as axis:
        axis.initialise(1000, 2000, 100)
        thread = threading.Thread(target=axis.move, args=(30.0,))
        thread.start()
        thread.join()
        assert axis.position == 30 and callable(axis.move)
        assert axis.move == axis.move and axis.move not in (None, print, axis.stop)
        assert {axis.move, axis.move} == {axis.move}
        assert copy.copy(axis.move) == axis.move


def test_help_still_shows_what_a_method_takes() -> None:
    text = pydoc.plain(pydoc.render_doc(Ppmc104))
    assert "move(self, pulses: 'int'" in text and "Move with ramps and wait" in text
    with Ppmc104.open(FAST) as axis:
        assert "pulses: 'int'" in pydoc.plain(pydoc.render_doc(axis.move))
        assert "move" in repr(axis.move)
    text = pydoc.plain(pydoc.render_doc(Ppmc104.open))
    assert "open(spec: 'str | Port', baud: 'int'" in text and "check which part is connected" in text


# ---------------------------------------------------------------------- text of a set-up


def test_a_set_up_prints_its_speeds_and_no_table(axis: Any) -> None:
    if isinstance(axis, Pmc006):
        assert not hasattr(axis, "initialise")
        return
    setup = axis.initialise(4000, 8000, 600) if axis.kind.usual_ramp == 2000 else axis.initialise()
    for text in (str(setup), repr(setup)):
        assert len(text) < 400 and "\n" not in text
    assert "start" in str(setup) and " pps" in str(setup) and "ramp" in str(setup)


def test_jogging_the_wrong_way_is_told() -> None:
    with Ppmc104.open(FAST) as axis:
        axis.initialise()
        with pytest.raises(OutOfRange, match=r"direction 2 is neither 0 \(CW\) nor 1 \(CCW\)"):
            axis.jog(2)
        assert axis.jog(float(CCW)).direction == 1  # type: ignore[arg-type]
