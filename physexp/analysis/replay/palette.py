"""What the names and colours of a replay stand for: a thing's colour is used for that thing alone."""

from collections.abc import Sequence
import re
from typing import Any

import numpy as np

from physexp.analysis.replay import recording

ACTION = (220, 40, 120)
"""The arrow of the action under way."""

ANSWERS = (255, 150, 220)
"""The probability that the agent answers."""

VALUE = (235, 235, 235)
"""The return that the agent expects."""

GLUE = (255, 255, 255)

_DARK = 90  # Darker colours than this one's grey are not seen on the viewer's dark ground.
_PALE = (170, 170, 180)
_FIRST_LABEL, _LAST_LABEL = np.array((0, 95, 110)), np.array((190, 250, 255))


def spoken(thing: str) -> str:
    """A thing's name in words."""
    return thing.replace("_", " ")


def of_thing(things: recording.Things, name: str) -> tuple[int, ...]:
    """The colour of a thing's curves, 0 to 255 (3,): its own, if that can be seen."""
    if name not in things.names:
        return _PALE
    color = tuple(int(255 * value) for value in things.colors[things.names.index(name)][:3])
    return color if max(color) >= _DARK else _PALE


def of_labels(labels: Sequence[str], things: recording.Things) -> list[tuple[int, ...]]:
    """The colours of labels: those of the things that they name, or shades of a colour that no thing has."""
    shades = np.linspace(_FIRST_LABEL, _LAST_LABEL, len(labels)).astype(int)
    named = [_named(label, things) for label in labels]
    return [
        of_thing(things, name) if name else tuple(map(int, shade)) for name, shade in zip(named, shades, strict=True)
    ]


def short(label: str, things: recording.Things) -> str:
    """A label in few words: the thing that it names, or itself."""
    name = _named(label, things)
    return spoken(name) if name else label


def _named(label: str, things: recording.Things) -> str | None:
    """The thing that a label names."""
    names = (name for name in things.names if re.search(rf"\b{re.escape(spoken(name))}\b", label))
    return next(names, None)


def sensed_things(task) -> dict[str, list[str]]:
    """The names of the things that the components of each feature tell of, in the order of its sensors."""
    return {name: [_owner(sensor) for sensor in reading.sensors] for name, reading in task.readings.items()}


def _owner(sensor: Any) -> str:
    """The thing that an MJCF sensor is attached to: the model that its joint or site belongs to."""
    for value in sensor.get_attributes().values():
        identifier = getattr(value, "full_identifier", None)
        if identifier is not None:
            return owner(identifier)
    return sensor.name


def owner(identifier: str) -> str:
    """The name of the innermost model in an identifier, as of `tower/block_0/center` or of the frame `block_0/`."""
    return next(part for part in reversed(identifier.rstrip("/").split("/")[:-1] or [identifier]) if part)
