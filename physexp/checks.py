"""Checks of what users give. An error is one line: what was given, and what is allowed. Imports nothing heavy."""

from collections.abc import Sequence
import math
import numbers
import sys
from typing import TypeGuard

LARGEST = 2**63 - 1
"""The largest integer that files, checkpoints and arrays can hold."""

_LONGEST = 120  # Characters of a value in a message.


def shown(value) -> str:
    """Returns how a value looks in a message: its `repr`, in one line and cut short."""
    try:
        text = " ".join(repr(value).split())
    except ValueError:  # Python spells no integer of more than 4300 digits.
        text = f"a huge {type(value).__name__}"
    return text if len(text) <= _LONGEST else f"{text[:_LONGEST]}..."


def is_integer(value) -> TypeGuard[int]:
    """Whether a value is an integer, Python's or NumPy's; booleans and time differences are none."""
    return isinstance(value, numbers.Integral) and hasattr(value, "__index__") and not isinstance(value, bool)


def is_float(value) -> bool:
    """Whether a value is a floating-point number, Python's or NumPy's."""
    return isinstance(value, numbers.Real) and not isinstance(value, numbers.Rational)


def is_flag(value) -> bool:
    """Whether a value is a boolean, Python's or NumPy's."""
    return type(value).__name__ == "bool"


def is_number(value) -> TypeGuard[float]:
    """Whether a value is a number that a float can hold, Python's or NumPy's."""
    if is_integer(value):
        return abs(value) <= sys.float_info.max
    return is_float(value) and math.isfinite(value)


def integer(name: str, value, minimum: int, maximum: int = LARGEST) -> int:
    """Returns `value` as an int.

    Raises:
      ValueError: if it is no integer from `minimum` to `maximum`.
    """
    if is_integer(value) and minimum <= value <= maximum:
        return int(value)
    most = f"<= {maximum}" if maximum < 2**32 else f"< 2**{maximum.bit_length()}"
    raise ValueError(f"{name} is {shown(value)}; give an integer >= {minimum} and {most}")


def number(name: str, value, minimum: float, unit: str = "", strictly: bool = False) -> float:
    """Returns `value` as a float.

    Raises:
      ValueError: if it is no finite number of at least (strictly: above) `minimum`.
    """
    if is_number(value) and value >= minimum and not (strictly and value == minimum):
        return float(value)
    sign, unit = ">" if strictly else ">=", unit and f" ({unit})"
    raise ValueError(f"{name} is {shown(value)}; give a finite number {sign} {minimum}{unit}")


def between(name: str, value, minimum: float, maximum: float, unit: str = "", without: float | None = None) -> float:
    """Returns `value` as a float.

    Raises:
      ValueError: if it is no number from `minimum` to `maximum`, or the one number among them that is not allowed.
    """
    if is_number(value) and minimum <= value <= maximum and value != without:
        return float(value)
    allowed = f"{minimum:g} to {f'{maximum:g} {unit}'.strip()}" + ("" if without is None else f" but not {without:g}")
    raise ValueError(f"{name} is {shown(value)}; give a number from {allowed}")


def discount(name: str, value) -> float:
    """Returns a discount factor as a float.

    Raises:
      ValueError: if it is no number above 0 and at most 1.
    """
    return between(name, value, 0, 1, without=0)


def one_of(name: str, value, choices: Sequence[float]) -> float:
    """Returns `value` as a float.

    Raises:
      ValueError: if it is none of the choices, two or more numbers.
    """
    if is_number(value) and value in choices:
        return float(value)
    *others, last = (f"{choice:g}" for choice in choices)
    raise ValueError(f"{name} is {shown(value)}; give {', '.join(others)} or {last}")


def flag(name: str, value) -> bool:
    """Returns `value` as a bool.

    Raises:
      ValueError: if it is neither true nor false, Python's or NumPy's.
    """
    if is_flag(value):
        return bool(value)
    raise ValueError(f"{name} is {shown(value)}; give True or False")
