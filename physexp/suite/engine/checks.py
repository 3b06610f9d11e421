"""Checks of what users give. An error is one line: what was given, and what is allowed."""

from collections.abc import Sequence
import math

import numpy as np

_LONGEST = 120  # Characters of a value in a message.


def shown(value) -> str:
    """Returns how a value looks in a message: its `repr`, in one line and cut short."""
    try:
        text = " ".join(repr(value).split())
    except ValueError:  # Python spells no integer of more than 4300 digits.
        text = f"a huge {type(value).__name__}"
    return text if len(text) <= _LONGEST else f"{text[:_LONGEST]}..."


def is_integer(value) -> bool:
    """Whether a value is an integer, Python's or NumPy's; booleans and time differences are none."""
    return isinstance(value, (int, np.integer)) and not isinstance(value, (bool, np.timedelta64))


def _is_number(value) -> bool:
    return is_integer(value) or isinstance(value, (float, np.floating))


def integer(name: str, value, minimum: int, maximum: int) -> int:
    """Returns `value` as an int.

    Raises:
      ValueError: if it is no integer from `minimum` to `maximum`.
    """
    if is_integer(value) and minimum <= value <= maximum:
        return int(value)
    most = f"<= {maximum}" if maximum < 2**32 else f"< 2**{maximum.bit_length()}"
    raise ValueError(f"{name} is {shown(value)}; give an integer >= {minimum} and {most}")


def number(name: str, value, minimum: float, unit: str, strictly: bool = False) -> float:
    """Returns `value` as a float.

    Raises:
      ValueError: if it is no finite number of at least (strictly: above) `minimum`.
    """
    if _is_number(value):
        try:
            converted = float(value)
        except OverflowError:
            converted = math.inf
        if minimum <= converted < math.inf and not (strictly and converted == minimum):
            return converted
    sign = ">" if strictly else ">="
    raise ValueError(f"{name} is {shown(value)}; give a finite number {sign} {minimum} ({unit})")


def between(name: str, value, minimum: float, maximum: float, unit: str = "") -> float:
    """Returns `value` as a float.

    Raises:
      ValueError: if it is no number from `minimum` to `maximum`.
    """
    if _is_number(value) and minimum <= value <= maximum:
        return float(value)
    raise ValueError(f"{name} is {shown(value)}; give a number from {minimum:g} to {f'{maximum:g} {unit}'.strip()}")


def one_of(name: str, value, choices: Sequence[float]) -> float:
    """Returns `value` as a float.

    Raises:
      ValueError: if it is none of the choices, two or more numbers.
    """
    if _is_number(value) and value in choices:
        return float(value)
    *others, last = (f"{choice:g}" for choice in choices)
    raise ValueError(f"{name} is {shown(value)}; give {', '.join(others)} or {last}")


def flag(name: str, value) -> bool:
    """Returns `value` as a bool.

    Raises:
      ValueError: if it is neither true nor false.
    """
    if isinstance(value, (bool, np.bool_)):
        return bool(value)
    raise ValueError(f"{name} is {shown(value)}; give True or False")
