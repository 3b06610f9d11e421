"""Checks of values that users give. An error is one line: what was given, and what is allowed. Imports nothing heavy.

A dataclass declares an option with its default, its check and its help text in one place::

    @dataclasses.dataclass(frozen=True)
    class Options:
        difficulty: float = checks.checked(1.0, checks.at_least(1), help="the larger, the easier")

        def __post_init__(self):
            checks.check_fields(self)
"""

from collections.abc import Callable, Mapping
import dataclasses
import math
import numbers
import sys
from typing import Any, TypeGuard

LARGEST = 2**63 - 1
"""The largest integer that files, checkpoints and arrays can hold."""

Check = Callable[[str, Any], Any]
"""Takes the name and the value of an option; returns the value as a plain Python value, or raises ValueError."""

_LONGEST = 120  # Characters of a value in a message.


def checked(default: Any = dataclasses.MISSING, check: Check | None = None, help: str = "") -> Any:
    """Returns a dataclass field with a check and a help text; a subclass that changes its default keeps both."""
    metadata: dict[str, Any] = {"check": check, "help": help}
    return dataclasses.field(default=default, metadata=metadata)


def check_fields(instance: Any) -> None:
    """Checks the fields of a dataclass that `checked` made, and stores the values that the checks return.

    Raises:
      ValueError: if a value is not allowed.
    """
    for name, metadata in _declared(type(instance)).items():
        if check := metadata["check"]:
            object.__setattr__(instance, name, check(name, getattr(instance, name)))


def help_of(kind: type) -> dict[str, str]:
    """Returns the help texts of the fields of a dataclass that `checked` made, by name."""
    return {name: metadata["help"] for name, metadata in _declared(kind).items()}


def _declared(kind: type) -> dict[str, Mapping[str, Any]]:
    """Returns the metadata of the fields that `checked` made, in this class or in its bases."""
    found: dict[str, Mapping[str, Any]] = {}
    for base in reversed(kind.__mro__):
        fields: Mapping[str, dataclasses.Field[Any]] = vars(base).get("__dataclass_fields__", {})
        found |= {name: field.metadata for name, field in fields.items() if "check" in field.metadata}
    return found


# Values in messages.


def shown(value: Any) -> str:
    """Returns how a value looks in a message: its `repr`, in one line and cut short."""
    try:
        text = " ".join(repr(value).split())
    except (ValueError, RecursionError):  # Python spells no integer of more than 4300 digits, and no deep list.
        text = f"a huge {type(value).__name__}"
    return text if len(text) <= _LONGEST else f"{text[:_LONGEST]}..."


# Kinds of values, Python's or NumPy's.


def is_integer(value: Any) -> TypeGuard[int]:
    """Whether a value is an integer; booleans and time differences are not."""
    return isinstance(value, numbers.Integral) and hasattr(value, "__index__") and not isinstance(value, bool)


def is_float(value: Any) -> bool:
    """Whether a value is a floating-point number."""
    return isinstance(value, numbers.Real) and not isinstance(value, numbers.Rational)


def is_flag(value: Any) -> bool:
    """Whether a value is a boolean."""
    return type(value).__name__ == "bool"


def is_number(value: Any) -> TypeGuard[float]:
    """Whether a value is a number that a float can hold."""
    if is_integer(value):
        return abs(value) <= sys.float_info.max
    return is_float(value) and math.isfinite(value)


# Checks, and makers of checks. A check raises ValueError for a value that is not allowed.


def flag(name: str, value: Any) -> bool:
    """Returns a boolean as a bool."""
    if is_flag(value):
        return bool(value)
    raise ValueError(f"{name} is {shown(value)}; give True or False")


def integer(name: str, value: Any, minimum: int, maximum: int = LARGEST) -> int:
    """Returns an integer from `minimum` to `maximum` as an int."""
    if is_integer(value) and minimum <= value <= maximum:
        return int(value)
    most = f"<= {maximum}" if maximum < 2**32 else f"< 2**{maximum.bit_length()}"
    raise ValueError(f"{name} is {shown(value)}; give an integer >= {minimum} and {most}")


def whole(minimum: int, maximum: int = LARGEST) -> Check:
    """Returns a check for integers from a minimum to a maximum."""
    return lambda name, value: integer(name, value, minimum, maximum)


def _number(allowed: str, is_allowed: Callable[[float], bool]) -> Check:
    """Returns a check for some finite numbers, which `allowed` describes."""

    def check(name: str, value: Any) -> float:
        if is_number(value) and is_allowed(value):
            return float(value)
        raise ValueError(f"{name} is {shown(value)}; give {allowed}")

    return check


def at_least(minimum: float, unit: str = "") -> Check:
    """Returns a check for finite numbers from a minimum up."""
    return _number(f"a finite number >= {minimum}" + (f" ({unit})" if unit else ""), lambda value: value >= minimum)


def above(minimum: float, unit: str = "") -> Check:
    """Returns a check for finite numbers above a minimum."""
    return _number(f"a finite number > {minimum}" + (f" ({unit})" if unit else ""), lambda value: value > minimum)


def within(minimum: float, maximum: float, unit: str = "", without: float | None = None) -> Check:
    """Returns a check for numbers from a minimum to a maximum, of which one may be excluded."""
    limits = f"{minimum:g} to {f'{maximum:g} {unit}'.strip()}" + ("" if without is None else f" but not {without:g}")
    return _number(f"a number from {limits}", lambda value: minimum <= value <= maximum and value != without)


discount = within(0, 1, without=0)
"""The check of a discount factor."""


def among(*choices: float) -> Check:
    """Returns a check for a number that is one of two or more."""
    *others, last = (f"{choice:g}" for choice in choices)
    return _number(f"{', '.join(others)} or {last}", lambda value: value in choices)


def word(*choices: str) -> Check:
    """Returns a check for one of some words."""

    def check(name: str, value: Any) -> str:
        if isinstance(value, str) and value in choices:
            return value
        raise ValueError(f"{name} is {shown(value)}; choose from {', '.join(choices)}")

    return check


def optional(check: Check) -> Check:
    """Returns a check that accepts None as well."""
    return lambda name, value: None if value is None else check(name, value)
