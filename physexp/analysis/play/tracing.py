"""Traces functions of arrays into rules, which the page evaluates without Python.

A rule is a number, a list of numbers, the name of a given value, or a list of an operation's name and its arguments,
which are rules: `["add", "ctrl", 1]`. Values of one environment are flat: the axis of environments, whose length is 1,
is left out. All operations are exact or rounded correctly, so that every program computes the same bits.
"""

from collections.abc import Callable, Sequence
import math
from typing import Any

import numpy as np

Rule = Any
"""A rule, as above."""

_BITWISE = {"bitwise_and", "bitwise_or", "bitwise_xor", "left_shift", "right_shift"}
_OPERATIONS = _BITWISE | {
    "absolute", "add", "divide", "equal", "floor", "floor_divide", "greater", "greater_equal", "less", "less_equal",
    "maximum", "minimum", "multiply", "negative", "not_equal", "rint", "sign", "sqrt", "subtract", "trunc",
}  # fmt: skip
_LONGEST_SUM = 7  # From eight numbers on, NumPy adds them in an order of its own.


class NotTraced(TypeError):  # noqa: N818  # It says what happened.
    """A function is no expression of arrays that can be traced."""


class Traced(np.lib.mixins.NDArrayOperatorsMixin):
    """An array, [1, ...], that keeps the rule by which it was computed.

    Attributes:
      value: the array.
      rule: its rule.
    """

    def __init__(self, value: Any, rule: Rule):
        self.value, self.rule = np.asarray(value), rule

    shape = property(lambda self: self.value.shape)
    ndim = property(lambda self: self.value.ndim)
    dtype = property(lambda self: self.value.dtype)

    def __len__(self) -> int:
        return len(self.value)

    def __array__(self, *args: Any, **kwargs: Any) -> np.ndarray:
        raise NotTraced("it needs the values of an array")

    def __bool__(self) -> bool:
        raise NotTraced("it asks whether an array is true; np.where chooses by arrays")

    def __setitem__(self, key: Any, value: Any) -> None:
        raise NotTraced("it writes into an array; np.where and np.concatenate make new ones")

    def __array_ufunc__(self, ufunc: Any, method: str, *inputs: Any, **kwargs: Any) -> "Traced":
        if kwargs.pop("out", (inputs[0],)) != (inputs[0],) or kwargs or method != "__call__":
            raise NotTraced(f"np.{ufunc.__name__} is given more than arrays")
        with np.errstate(all="ignore"):
            value = ufunc(*map(_value, inputs))
        kinds = {np.asarray(_value(each)).dtype.kind for each in inputs}
        name = ufunc.__name__
        is_known = name in _OPERATIONS and value.dtype.kind in "biuf" and not (name == "floor_divide" and "f" in kinds)
        if not is_known or (name in _BITWISE and "i" in kinds):
            raise NotTraced(f"np.{name} of these numbers is none of the operations that give the same bits everywhere")
        return Traced(value, [name, *map(_rule, inputs)])

    def __array_function__(self, function: Any, types: Any, args: tuple, kwargs: dict) -> Any:
        name, values = function.__name__, _each(_value, args)
        with np.errstate(all="ignore"):
            value = function(*values, **kwargs)
        if name == "zeros_like":
            return value
        if name == "split" and kwargs == {"axis": 1}:
            ends = np.cumsum([part.shape[1] for part in value]).tolist()
            return [self._part(part, end - part.shape[1], end) for part, end in zip(value, ends, strict=True)]
        if name in ("concatenate", "stack") and kwargs == {"axis": 1}:
            return Traced(value, ["concatenate", *map(_rule, args[0])])
        if name in ("where", "clip") and not kwargs:
            return Traced(value, [name, *map(_rule, args)])
        if name == "round" and len(args) == 1 and not kwargs:
            return Traced(value, ["rint", self.rule])
        raise NotTraced(f"np.{name} is not traced with these arguments")

    def __getitem__(self, key: Any) -> "Traced":
        if isinstance(key, Traced):
            return Traced(self.value[key.value], ["row", self.rule, key.rule])
        if not (isinstance(key, tuple) and len(key) == 2 and key[0] == slice(None)):
            raise NotTraced(f"it takes the part {key} of an array; [:, a:b], [:, a] and [:, None] are traced")
        value = self.value[key]
        if key[1] is None:
            return Traced(value, self.rule)
        chosen = np.arange(self.value.shape[1])[key[1]]
        if np.ndim(chosen) and np.any(np.diff(chosen) != 1):
            raise NotTraced(f"it takes the part {key} of an array, which is not contiguous")
        places = np.atleast_1d(chosen)
        return self._part(value, *((int(places[0]), int(places[-1]) + 1) if len(places) else (0, 0)))

    @property
    def T(self) -> "list[Traced]":  # noqa: N802  # NumPy's name.
        """The columns of [1, K], each [1]."""
        return [self._part(column, k, k + 1) for k, column in enumerate(self.value.T)]

    def astype(self, dtype: Any) -> "Traced":
        """Returns the values as another type; float64, int64 and uint64 are traced."""
        value, old = self.value.astype(dtype), self.value.dtype
        if value.dtype not in (np.float64, np.int64, np.uint64):
            raise NotTraced(f"{value.dtype} is not traced")
        if np.uint64 in (old, value.dtype):
            return Traced(value, ["to_uint64" if value.dtype == np.uint64 else "from_uint64", self.rule])
        return Traced(value, ["trunc", self.rule] if (old.kind, value.dtype.kind) == ("f", "i") else self.rule)

    def sum(self, axis: int, keepdims: bool = False) -> "Traced":
        """Returns the sum along the last axis."""
        if self.value.shape[1] > _LONGEST_SUM and self.value.dtype.kind == "f":
            raise NotTraced(f"it sums more than {_LONGEST_SUM} numbers, whose order is not known")
        return self._reduced("sum", axis, keepdims)

    def max(self, axis: int, keepdims: bool = False) -> "Traced":
        """Returns the maximum along the last axis."""
        return self._reduced("max", axis, keepdims)

    def any(self, axis: int, keepdims: bool = False) -> "Traced":
        """Returns whether any value along the last axis is not 0."""
        return self._reduced("any", axis, keepdims)

    def _reduced(self, name: str, axis: int, keepdims: bool) -> "Traced":
        if axis not in (1, -1) or self.value.ndim != 2:
            raise NotTraced(f"{name} along axis {axis} of {self.value.ndim} is not traced")
        return Traced(getattr(self.value, name)(axis=axis, keepdims=keepdims), [name, self.rule])

    def _part(self, value: np.ndarray, first: int, end: int) -> "Traced":
        return Traced(value, ["slice", self.rule, first, end])


def trace(function: Callable[..., Any], **given: np.ndarray) -> Rule:
    """Returns the rule of a function of arrays, by the names that the rule gives them.

    Raises NotTraced if it is no expression of arrays.
    """
    try:
        result = function(*(Traced(value, name) for name, value in given.items()))
    except (AttributeError, IndexError, TypeError, ValueError) as error:
        raise NotTraced(str(error)) from error
    if np.shape(_value(result))[0] != 1:
        raise NotTraced(f"it returns {np.shape(_value(result))} for one environment")
    return _rule(result)


def _value(given: Any) -> Any:
    return given.value if isinstance(given, Traced) else given


def _rule(given: Any) -> Rule:
    if isinstance(given, Traced):
        return given.rule
    constant = np.asarray(given)
    if constant.size != math.prod(constant.shape[-1:]):
        raise NotTraced(f"it computes with a table of shape {constant.shape}")
    if constant.dtype == np.uint64:  # Too large for numbers of JSON.
        return ["uint64", *map(str, constant.ravel().tolist())]
    numbers = constant.astype(float).ravel().tolist()
    return numbers if constant.ndim else numbers[0]


def _each(function: Callable[[Any], Any], given: Sequence[Any]) -> tuple[Any, ...]:
    return tuple(_each(function, each) if isinstance(each, (tuple, list)) else function(each) for each in given)
