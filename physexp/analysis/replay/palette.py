"""Names and colours of a replay: a thing's colour means that thing alone."""

from collections.abc import Sequence
import re

import numpy as np

from physexp.analysis.data import readings
from physexp.analysis.replay import recording

ACTION = (220, 40, 120)  # The arrow of the action under way.
ANSWERS = (255, 150, 220)  # The probability that the agent answers.
VALUE = (235, 235, 235)  # The return that the agent expects.
MARK = (255, 255, 255)  # A text beside a thing that tells its hidden property.
JOINT = (255, 255, 255)  # A bar between two things of one body.

_DARK = 90  # Darker colours vanish on the viewer's dark ground.
_PALE = (170, 170, 180)
_FIRST_LABEL, _LAST_LABEL = (0, 95, 110), (190, 250, 255)


def of_thing(shapes: recording.Shapes, name: str) -> tuple[int, ...]:
    """Returns the colour of a thing's curves, 0 to 255 (3,): its own, unless it is dark."""
    if name not in shapes.names:
        return _PALE
    color = tuple(int(255 * value) for value in shapes.colors[shapes.names.index(name)][:3])
    return color if max(color) >= _DARK else _PALE


def of_labels(labels: Sequence[str], shapes: recording.Shapes) -> list[tuple[int, ...]]:
    """Returns colours of labels: those of the things that they name, or shades that no thing has."""
    if named := _named(labels, shapes):
        return [of_thing(shapes, name) for name in named]
    return [tuple(shade) for shade in np.linspace(_FIRST_LABEL, _LAST_LABEL, len(labels)).astype(int).tolist()]


def short(labels: Sequence[str], shapes: recording.Shapes) -> list[str]:
    """Returns short labels: the names of the things that they name, or the labels themselves."""
    return [readings.spoken(name) for name in _named(labels, shapes)] or list(labels)


def _named(labels: Sequence[str], shapes: recording.Shapes) -> list[str]:
    """Returns the thing that each label names; nothing unless each names a different one."""
    found: list[str] = []
    for label in labels:
        names = [name for name in shapes.names if re.search(rf"\b{re.escape(readings.spoken(name))}\b", label)]
        if len(names) != 1 or names[0] in found:
            return []
        found += names
    return found
