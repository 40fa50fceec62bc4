"""Checks of arguments: numbers, flags, names of attributes, missing parentheses of calls. Pure.

Classes of drivers and motions derive from `Checked`: each public method checks its arguments against their
annotations before it begins.

>>> whole(100.0, "pulses"), exact(0.5, "speed"), flag(1, "on")
(100, Fraction(1, 2), True)
>>> whole(2.5, "pulses")
Traceback (most recent call last):
openppmc.host.errors.OutOfRange: pulses 2.5 is not a whole number
"""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from difflib import get_close_matches
from fractions import Fraction
from functools import update_wrapper, wraps
from math import inf
from numbers import Real
from operator import index
from types import FunctionType
from typing import Any, NamedTuple, TypeAlias

from ..lazy import Renamed
from .errors import NotCalledError, OutOfRange, UnknownAttributeError

Number: TypeAlias = int | float | Fraction


# ---------------------------------------------------------------------- values


def exact(value: Any, what: str) -> Fraction:
    """Return a finite real number, which may have any numeric type, as a fraction.

    Raises:
        OutOfRange: the value is not a finite number; also for text, bool and `None`.
    """
    try:
        if not isinstance(value, bool):
            top, bottom = (value, 1) if _is_index(value) else value.as_integer_ratio()
            return Fraction(int(top), int(bottom))
    except (AttributeError, TypeError, ValueError, OverflowError):
        pass  # text, `None`, a list, nan, or an infinite value
    raise OutOfRange(f"{what} {value!r} is not a number")


def whole(value: Any, what: str) -> int:
    """Return a whole number as an integer; it may have any numeric type, also float.

    Raises:
        OutOfRange: the value is not a whole number; also for text, bool and `None`.
    """
    if type(value) is int:
        return value
    try:
        number = exact(value, what)
    except OutOfRange:
        number = Fraction(1, 2)
    if number.denominator != 1:
        raise OutOfRange(f"{what} {value!r} is not a whole number")
    return int(number)


def wholes(values: Any, what: str) -> Iterator[int]:
    """Return an iterator over whole numbers, which checks each number when it is read. Raises OutOfRange."""
    if not isinstance(values, Iterable):
        raise OutOfRange(f"{what} {values!r}: wants several numbers, as in (100, -50)")
    return (whole(one, what) for one in values)


def within(value: Any, what: str, low: int, high: int, unit: str = "") -> int:
    """Return a whole number from low to high. Raises OutOfRange."""
    number = whole(value, what)
    if not low <= number <= high:
        raise OutOfRange(f"{what} {number} is outside {low} to {high}{unit and ' ' + unit}")
    return number


def flag(value: Any, what: str) -> bool:
    """Return a flag given as True, False, 1 or 0.

    Raises:
        OutOfRange: the value is anything else, such as text, `None` or another number, although Python
            accepts such values as flags.
    """
    try:
        if value in (False, True):
            return bool(value)
    except ValueError:
        pass  # an array
    raise OutOfRange(f"{what} {value!r} is neither True nor False")


def side(direction: Any) -> int:
    """Return a direction of pulses: 0 (CW) or 1 (CCW). Raises OutOfRange."""
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
    """Return a number unchanged if the package can calculate with its type, otherwise as a fraction."""
    number = exact(value, what)
    return value if isinstance(value, int | float | Fraction) else number


def _seconds(value: Any, what: str) -> float:
    """Return a time in s, which may be infinite, after a check."""
    return value if isinstance(value, float) and value == inf else float(exact(value, what))


# ---------------------------------------------------------------------- methods


class ArgumentType(NamedTuple):
    """Type of an argument.

    Attributes:
        optional: True if `None` is accepted as well.
    """

    name: str
    check: Callable[[Any, str], Any]
    optional: bool = False


_CHECKS = {"int": whole, "Number": _usual, "float": _seconds, "bool": flag}


def _argument_type(annotation: Any) -> ArgumentType | None:
    """Return the type for an annotation such as `int` or `units.Number | None`.

    The result is `None` for any other annotation; such arguments are not checked.
    """
    first, *more = str(getattr(annotation, "__name__", annotation)).split(" | ")
    name = first.removeprefix("units.")
    return (
        ArgumentType(name, _CHECKS[name], more == ["None"])
        if name in _CHECKS and more in ([], ["None"])
        else None
    )


class CheckedMethod:
    """Method of a class that checks its arguments. Access through an instance returns a `BoundMethod`.

    Attributes:
        kinds: type of each parameter that is checked.
    """

    def __init__(self, function: Callable[..., Any]) -> None:
        update_wrapper(self, function)
        self.function = function
        parameters = inspect.signature(function).parameters
        self._names = tuple(parameters)[1:]
        kinds = {name: _argument_type(one.annotation) for name, one in parameters.items()}
        self.kinds = {name: kind for name, kind in kinds.items() if kind is not None}

    def __get__(self, instance: object, owner: type | None = None) -> Any:
        return self if instance is None else BoundMethod(self, instance)

    def __call__(self, instance: object, /, *values: Any, **words: Any) -> Any:
        values, words = self.checked(values, words)
        return self.function(instance, *values, **words)

    def checked(self, values: Sequence[Any], words: Mapping[str, Any]) -> tuple[Any, Any]:
        """Check the arguments; return them in the form that the function receives. Raises OutOfRange."""
        if self.kinds:
            known = [self._one(name, value) for name, value in zip(self._names, values, strict=False)]
            values = (*known, *values[len(known) :])
            words = {name: self._one(name, value) for name, value in words.items()}
        return values, words

    def _one(self, name: str, value: Any) -> Any:
        kind = self.kinds.get(name)
        return value if kind is None or (value is None and kind.optional) else kind.check(value, name)


def _of_class(function: Callable[..., Any]) -> Callable[..., Any]:
    """Return a class method that checks its arguments.

    The result is a plain function, because Python 3.10 binds nothing else to the class.
    """
    entry = CheckedMethod(function)

    @wraps(function)
    def checking(owner: type, /, *values: Any, **words: Any) -> Any:
        return entry(owner, *values, **words)

    return checking


def _value(bound: BoundMethod, *others: object) -> Any:
    raise bound._not_called()


class BoundMethod:  # noqa: D101 - help() shows the docstring of the function
    # Method of an object. Truth value, equality, hash, help and names are the same as for a Python method.
    # Arithmetic, a comparison with a number, and the read of any other attribute raise an error, because the
    # parentheses of the call are missing.

    def __init__(self, entry: CheckedMethod, instance: object) -> None:
        self._entry, self.__self__ = entry, instance

    __doc__ = property(lambda self: self._entry.__doc__)

    @property
    def __signature__(self) -> inspect.Signature:
        first, *rest = inspect.signature(self._entry).parameters.values()
        return inspect.Signature(rest)

    def __call__(self, /, *values: Any, **words: Any) -> Any:
        values, words = self._entry.checked(values, words)
        return self._entry.function(self.__self__, *values, **words)

    def __get__(self, instance: object, owner: type | None = None) -> BoundMethod:
        return self

    def _not_called(self) -> NotCalledError:
        name = self.__name__
        return NotCalledError(f"'{name}' is a method: write {name}{inspect.signature(self)}")

    def __eq__(self, other: object) -> bool:
        if isinstance(other, BoundMethod):
            return self._entry is other._entry and self.__self__ is other.__self__
        if isinstance(other, Real) and not isinstance(other, bool):
            raise self._not_called()
        return NotImplemented

    def __hash__(self) -> int:
        return hash((id(self._entry), id(self.__self__)))

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            return getattr(vars(self).get("_entry"), name)
        raise self._not_called()

    for _name in "lt le gt ge neg abs add sub mul truediv floordiv mod and or".split():
        vars()[f"__{_name}__"] = vars()[f"__r{_name}__"] = _value

    def __repr__(self) -> str:
        return f"<method {self.__qualname__}{inspect.signature(self)}>"


# ---------------------------------------------------------------------- classes


class Checked:
    """Base class of all objects that users hold.

    Public methods check their arguments. Only these attributes can be set: those that the class declares
    (property, class attribute or annotation in its body), and those that begin with _.
    """

    _declared: frozenset[str] = frozenset()

    def __init_subclass__(cls, **words: Any) -> None:
        super().__init_subclass__(**words)
        cls._declared = frozenset(name for one in cls.__mro__ for name in inspect.get_annotations(one))
        for name, member in list(vars(cls).items()):
            if name.startswith("_"):
                continue
            if isinstance(member, FunctionType):
                setattr(cls, name, CheckedMethod(member))
            elif isinstance(member, classmethod):
                setattr(cls, name, classmethod(_of_class(member.__func__)))

    def __setattr__(self, name: str, value: object) -> None:
        if not name.startswith("_"):
            known = getattr(type(self), name, None)
            if isinstance(known, Renamed):
                raise UnknownAttributeError(f"{type(self).__name__}: {name!r} is now {known.name!r}")
            if isinstance(known, CheckedMethod) and not callable(value):
                raise UnknownAttributeError(f"{type(self).__name__}: {name!r} is a method, nothing to set")
            if name not in self._declared and not hasattr(type(self), name):
                raise UnknownAttributeError(
                    f"{type(self).__name__} has no attribute {name!r}{_guess(name, self)}"
                )
        super().__setattr__(name, value)


def _guess(name: str, of: Checked) -> str:
    """Return a hint with the existing name that is most similar, or an empty text."""
    names = [
        one
        for one in {*dir(of), *of._declared}
        if not one.startswith("_") and not isinstance(getattr(type(of), one, None), Renamed)
    ]
    near = get_close_matches(name, names, 1)
    return f": do you mean {near[0]!r}?" if near else ""
