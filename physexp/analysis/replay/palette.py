"""The names and colours of a replay: a thing's colour is used for that thing alone."""

from collections.abc import Sequence
import re

import numpy as np

from physexp.analysis import readings
from physexp.analysis.replay import recording

ACTION = (220, 40, 120)
"""The arrow of the action under way."""

ANSWERS = (255, 150, 220)
"""The probability that the agent answers."""

VALUE = (235, 235, 235)
"""The return that the agent expects."""

MARK = (255, 255, 255)
"""A text beside a thing, which tells what is hidden."""

JOINT = (255, 255, 255)
"""What joins two things that are one."""

_DARK = 90  # Darker colours than this one's grey are not seen on the viewer's dark ground.
_PALE = (170, 170, 180)
_FIRST_LABEL, _LAST_LABEL = np.array((0, 95, 110)), np.array((190, 250, 255))


def of_thing(shapes: recording.Shapes, name: str) -> tuple[int, ...]:
    """Returns the colour of a thing's curves, 0 to 255 (3,): its own, if that can be seen."""
    if name not in shapes.names:
        return _PALE
    color = tuple(int(255 * value) for value in shapes.colors[shapes.names.index(name)][:3])
    return color if max(color) >= _DARK else _PALE


def of_labels(labels: Sequence[str], shapes: recording.Shapes) -> list[tuple[int, ...]]:
    """Returns the colours of labels: those of the things that they name, or shades of one that no thing has."""
    shades = np.linspace(_FIRST_LABEL, _LAST_LABEL, len(labels)).astype(int)
    named = [_named(label, shapes) for label in labels]
    return [
        of_thing(shapes, name) if name else tuple(map(int, shade)) for name, shade in zip(named, shades, strict=True)
    ]


def short(labels: Sequence[str], shapes: recording.Shapes) -> list[str]:
    """Returns labels in few words: the things that they name, where each names another one, or themselves."""
    named = [_named(label, shapes) for label in labels]
    are_told_apart = len({name for name in named if name}) == sum(name is not None for name in named)
    if not are_told_apart:
        return list(labels)
    return [readings.spoken(name) if name else label for name, label in zip(named, labels, strict=True)]


def _named(label: str, shapes: recording.Shapes) -> str | None:
    """Returns the name of the thing that a label names."""
    names = (name for name in shapes.names if re.search(rf"\b{re.escape(readings.spoken(name))}\b", label))
    return next(names, None)
