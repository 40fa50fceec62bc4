"""What users hand to a driver, checked in one place: numbers, flags, names, forgotten parentheses. Pure.

Classes of drivers and motions derive from `Checked`: each public method checks its arguments by their
annotations before it begins.

>>> whole(100.0, "pulses"), exact(0.5, "speed"), flag(1, "on")
(100, Fraction(1, 2), True)
>>> whole(2.5, "pulses")
Traceback (most recent call last):
openppmc.host.errors.OutOfRange: pulses 2.5 is not a whole number
"""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping, Sequence
from difflib import get_close_matches
from fractions import Fraction
from functools import update_wrapper, wraps
from math import inf
from numbers import Real
from operator import index
from types import FunctionType
from typing import Any, NamedTuple, TypeAlias

from .errors import Misused, NoSuchName, OutOfRange

Number: TypeAlias = int | float | Fraction


# ---------------------------------------------------------------------- values


def exact(value: Any, what: str) -> Fraction:
    """A finite real number of any kind as a fraction. OutOfRange, also for text, bool and None."""
    try:
        if not isinstance(value, bool):
            top, bottom = (value, 1) if _is_index(value) else value.as_integer_ratio()
            return Fraction(int(top), int(bottom))
    except (AttributeError, TypeError, ValueError, OverflowError):
        pass  # text, None, a list; nan; infinite
    raise OutOfRange(f"{what} {value!r} is not a number")


def whole(value: Any, what: str) -> int:
    """An integer of any kind, also as a float without a fraction. OutOfRange, for text, bool, None, too."""
    if type(value) is int:
        return value
    try:
        number = exact(value, what)
    except OutOfRange:
        number = Fraction(1, 2)
    if number.denominator != 1:
        raise OutOfRange(f"{what} {value!r} is not a whole number")
    return int(number)


def within(value: Any, what: str, low: int, high: int, unit: str = "") -> int:
    """A whole number from low to high. OutOfRange."""
    number = whole(value, what)
    if not low <= number <= high:
        raise OutOfRange(f"{what} {number} is outside {low} to {high}{unit and ' ' + unit}")
    return number


def flag(value: Any, what: str) -> bool:
    """True or False, 1 or 0; OutOfRange for words, None and other numbers, which Python would take."""
    try:
        if value in (False, True):
            return bool(value)
    except ValueError:
        pass  # an array
    raise OutOfRange(f"{what} {value!r} is neither True nor False")


def side(direction: Any) -> int:
    """A direction of pulses: 0 (CW) or 1 (CCW). OutOfRange."""
    number = whole(direction, "direction")
    if number not in (0, 1):
        raise OutOfRange(f"direction {number} is neither 0 (CW) nor 1 (CCW)")
    return number


def _is_index(value: Any) -> bool:
    try:
        index(value)
    except TypeError:
        return False
    return True


def _usual(value: Any, what: str) -> Number:
    """A number as it is where the package can count with it."""
    number = exact(value, what)
    return value if isinstance(value, int | float | Fraction) else number


def _seconds(value: Any, what: str) -> float:
    """A time, which may be without end."""
    return value if isinstance(value, float) and value == inf else float(exact(value, what))


# ---------------------------------------------------------------------- methods


class Kind(NamedTuple):
    """What an argument must be. optional: None will do, too."""

    name: str
    check: Callable[[Any, str], Any]
    optional: bool = False


_CHECKS = {"int": whole, "Number": _usual, "float": _seconds, "bool": flag}


def _kind(annotation: Any) -> Kind | None:
    """By annotation, such as `int` or `units.Number | None`; None for what is not checked here."""
    first, *more = str(getattr(annotation, "__name__", annotation)).split(" | ")
    name = first.removeprefix("units.")
    return Kind(name, _CHECKS[name], more == ["None"]) if name in _CHECKS and more in ([], ["None"]) else None


class Entry:
    """A method of a class that checks its arguments; objects have it as a `Bound`. kinds: by parameter."""

    def __init__(self, function: Callable[..., Any]) -> None:
        update_wrapper(self, function)
        self.function = function
        parameters = inspect.signature(function).parameters
        self._names = tuple(parameters)[1:]
        kinds = {name: _kind(one.annotation) for name, one in parameters.items()}
        self.kinds = {name: kind for name, kind in kinds.items() if kind is not None}

    def __get__(self, instance: object, owner: type | None = None) -> Any:
        return self if instance is None else Bound(self, instance)

    def __call__(self, instance: object, /, *values: Any, **words: Any) -> Any:
        values, words = self.checked(values, words)
        return self.function(instance, *values, **words)

    def checked(self, values: Sequence[Any], words: Mapping[str, Any]) -> tuple[Any, Any]:
        """The arguments as the function gets them. OutOfRange."""
        if self.kinds:
            known = [self._one(name, value) for name, value in zip(self._names, values, strict=False)]
            values = (*known, *values[len(known) :])
            words = {name: self._one(name, value) for name, value in words.items()}
        return values, words

    def _one(self, name: str, value: Any) -> Any:
        kind = self.kinds.get(name)
        return value if kind is None or (value is None and kind.optional) else kind.check(value, name)


def _of_class(function: Callable[..., Any]) -> Callable[..., Any]:
    """The checking function of a class method. Python 3.10 binds only functions to the class."""
    entry = Entry(function)

    @wraps(function)
    def checking(owner: type, /, *values: Any, **words: Any) -> Any:
        return entry(owner, *values, **words)

    return checking


def _value(bound: Bound, *others: object) -> Any:
    raise bound._misused()


class Bound:
    # A method of an object, as true, equal and hashable as those of Python. Arithmetic with it is an error,
    # and so is a comparison with a number. Help and names are those of the function.

    def __init__(self, entry: Entry, instance: object) -> None:
        self._entry, self.__self__ = entry, instance

    __doc__ = property(lambda self: self._entry.__doc__)

    @property
    def __signature__(self) -> inspect.Signature:
        first, *rest = inspect.signature(self._entry).parameters.values()
        return inspect.Signature(rest)

    def __call__(self, /, *values: Any, **words: Any) -> Any:
        values, words = self._entry.checked(values, words)
        return self._entry.function(self.__self__, *values, **words)

    def __get__(self, instance: object, owner: type | None = None) -> Bound:
        return self

    def _misused(self) -> Misused:
        name = self.__name__
        return Misused(f"'{name}' is a method: write {name}{inspect.signature(self)}")

    def __eq__(self, other: object) -> bool:
        if isinstance(other, Bound):
            return self._entry is other._entry and self.__self__ is other.__self__
        if isinstance(other, Real) and not isinstance(other, bool):
            raise self._misused()
        return NotImplemented

    def __hash__(self) -> int:
        return hash((id(self._entry), id(self.__self__)))

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            return getattr(vars(self).get("_entry"), name)
        raise self._misused()

    for _name in "lt le gt ge neg abs add sub mul truediv floordiv mod and or".split():
        vars()[f"__{_name}__"] = vars()[f"__r{_name}__"] = _value

    def __repr__(self) -> str:
        return f"<method {self.__qualname__}{inspect.signature(self)}>"


# ---------------------------------------------------------------------- classes


class Checked:
    """Base of what users hold. Public methods check their arguments. Names that can be set are those that the
    class declares (property, class attribute or annotation in its body) and those that begin with _."""

    _declared: frozenset[str] = frozenset()

    def __init_subclass__(cls, **words: Any) -> None:
        super().__init_subclass__(**words)
        cls._declared = frozenset(name for one in cls.__mro__ for name in inspect.get_annotations(one))
        for name, member in list(vars(cls).items()):
            if name.startswith("_"):
                continue
            if isinstance(member, FunctionType):
                setattr(cls, name, Entry(member))
            elif isinstance(member, classmethod):
                setattr(cls, name, classmethod(_of_class(member.__func__)))

    def __setattr__(self, name: str, value: object) -> None:
        if not name.startswith("_"):
            known = getattr(type(self), name, None)
            if isinstance(known, Entry) and not callable(value):
                raise NoSuchName(f"{type(self).__name__}: {name!r} is a method, nothing to set")
            if name not in self._declared and not hasattr(type(self), name):
                raise NoSuchName(f"{type(self).__name__} has no attribute {name!r}{_guess(name, self)}")
        super().__setattr__(name, value)


def _guess(name: str, of: Checked) -> str:
    """The nearest name that exists."""
    names = [one for one in {*dir(of), *of._declared} if not one.startswith("_")]
    near = get_close_matches(name, names, 1)
    return f": do you mean {near[0]!r}?" if near else ""
