"""Observations as text that fits the terminal."""

from collections.abc import Collection, Mapping, Sequence
import string

import numpy as np

from physexp.analysis.data import readings as readings_lib
from physexp.suite.engine import declarations

Readings = Mapping[str, declarations.Reading]

_WIDTH, _HEIGHT = 48, 14  # Characters of the largest drawing.
_LONGEST_BAR = 60  # Characters.
_ROOM = np.array([(-0.6, 0.6), (-0.6, 0.6), (0.0, 0.6)])  # m; the bounds of readings that declare none.
_SYMBOLS = "OX" + string.ascii_uppercase.replace("O", "").replace("X", "")  # For things without a number.
_SMALLEST_IMAGE = 16  # Pixels; smaller images are unreadable.
_OTHER_LINES = 3  # Of the terminal, below an image.


def legend(observation: Collection[str], readings: Readings) -> str:
    """Returns a legend of the drawings of an observation, whose arrays have these names, in a task with readings."""
    seen = [reading for reading in readings_lib.shown(readings) if reading.name in observation]
    sentences = ["You see what the agent sees, an image."] if set(observation) - set(readings) else []
    places = [reading for reading in seen if reading.is_position]
    if places:
        sentences.append(_legend_of_places(places))
    for reading in seen:
        if not reading.is_position:
            unit = f", in {'cm' if reading.unit == 'm' else reading.unit}" if reading.unit else ""
            sentences.append(f"You see {readings_lib.spoken(reading.name)}: {readings[reading.name].meaning}{unit}.")
    return "\n".join(sentences)


def drawing(observation: Mapping[str, np.ndarray], readings: Readings, columns: int = 80, lines: int = 24) -> str:
    """Returns an observation as text: things from the side, values as bars, and images in coloured half blocks."""
    seen = [reading for reading in readings_lib.shown(readings) if reading.name in observation]
    places = [reading for reading in seen if reading.is_position]
    rows = _rows([reading for reading in seen if not reading.is_position], observation, columns)
    parts = [_image(observation[name], columns, lines - len(rows)) for name in observation if name not in readings]
    if places:
        size = max(12, min(_WIDTH, columns)), max(6, min(_HEIGHT, lines - _OTHER_LINES - len(rows)))
        parts.append(_side(places, observation, *size))
    return "\n".join([*parts, *rows])


def _legend_of_places(places: Sequence[readings_lib.Shown]) -> str:
    symbols = _symbols(places)
    numbered = {thing.rpartition("_")[0] for thing, symbol in symbols.items() if symbol.isdecimal()}
    plurals = " and ".join(f"{readings_lib.spoken(name)}s" for name in sorted(numbered))
    digits = f", the digits are the {plurals}" if numbered else ""
    others = [f" {s} is the {readings_lib.spoken(thing)}." for thing, s in symbols.items() if not s.isdecimal()]
    return f"You see the room from the side: +x is to the right, +y away from you{digits}.{''.join(others)}"


def _symbols(places: Sequence[readings_lib.Shown]) -> dict[str, str]:
    """Returns a character for each thing: its number if that is one unused digit, or a letter."""
    letters, symbols = iter(_SYMBOLS), dict[str, str]()
    for thing in dict.fromkeys(thing for reading in places for thing in reading.things):
        number = thing.rpartition("_")[2]
        is_digit = number != thing and len(number) == 1 and number.isdecimal() and number not in symbols.values()
        symbols[thing] = number if is_digit else next(letters, "?")
    return symbols


def _side(places: Sequence[readings_lib.Shown], observation, width: int, height: int) -> str:
    """Returns a side view of positions, with the distances along y below it."""
    canvas = np.full((height, width), " ")
    rooms = np.array([_ROOM if reading.limits is None else reading.limits for reading in places])
    (left, _, bottom), (right, _, top) = rooms[..., 0].min(axis=0), rooms[..., 1].max(axis=0)
    symbols, aside = _symbols(places), []
    for reading in places:
        for thing, (x, y, z) in zip(reading.things, reading.values(observation[reading.name])[0], strict=True):
            column = round((x - left) / (right - left) * (width - 1))
            row = height - 1 - round((z - bottom) / (top - bottom) * (height - 1))
            if 0 <= column < width and 0 <= row < height:
                canvas[row, column] = symbols[thing]
            aside.append(f"{symbols[thing]}: y {100 * y:+.1f} cm")
    return "\n".join(["".join(row).rstrip() for row in canvas] + ["-" * width, "  ".join(aside)])


def _rows(seen: Sequence[readings_lib.Shown], observation, columns: int) -> list[str]:
    """Returns a line for each value: its name, a bar if its bounds are known and it has a unit, and the number."""
    found = []
    for reading in seen:
        limits = [0.0] * len(reading.components) if reading.limits is None else np.abs(reading.limits).max(axis=1)
        for name, of_thing in zip(reading.names, reading.values(observation[reading.name])[0], strict=True):
            for component, value, largest in zip(reading.components, of_thing, limits, strict=True):
                found.append((_label(reading, name, component, len(seen) > 1), float(value), largest, reading.unit))
    width = max((len(label) for label, *_ in found), default=0)
    room = max(1, min(_LONGEST_BAR, columns - width - 11))
    return [
        f"{label:{width}} {_bar(value, largest, unit, room)}{_number(value, unit)}"[:columns]
        for label, value, largest, unit in found
    ]


def _label(reading: readings_lib.Shown, name: str, component: str, are_several: bool) -> str:
    """Returns the name of a value: its reading's if that has one value, or its thing's."""
    if len(reading.names) == 1:
        name = readings_lib.spoken(reading.name)
    elif are_several:
        name = f"{readings_lib.spoken(reading.name)}, {name}"
    return f"{name} {component}".rstrip()


def _bar(value: float, largest: float, unit: str, room: int) -> str:
    """Returns a bar of `#` for positive and `-` for negative values; nothing without a unit or bounds."""
    if not unit or not largest:
        return ""
    length = min(room, round(abs(value) / largest * room))
    return f"{('#' if value >= 0 else '-') * length:{room}} "


def _number(value: float, unit: str) -> str:
    if not unit:
        return f"{value:g}"
    return f"{100 * value:5.1f} cm" if unit == "m" else f"{value:6.3g} {unit}"


def _image(pixels: np.ndarray, columns: int, lines: int) -> str:
    """Returns an image as text: two rows of pixels in each line, by 24-bit colours."""
    size = min(len(pixels), columns, 2 * (lines - _OTHER_LINES)) // 2 * 2
    if size < _SMALLEST_IMAGE:
        needed, best = (f"{side} by {side // 2 + _OTHER_LINES}" for side in (_SMALLEST_IMAGE, len(pixels)))
        size_now = f"{columns} columns by {lines} lines"
        return f"(the terminal has {size_now}, too small for an image: it needs {needed}, and {best} is best)"
    small, text = _shrunk(pixels, size), []
    for upper, lower in zip(small[::2], small[1::2], strict=True):
        cells = ("\x1b[38;2;{};{};{};48;2;{};{};{}m▀".format(*a, *b) for a, b in zip(upper, lower, strict=True))
        text.append("".join(cells) + "\x1b[0m")
    return "\n".join(text)


def _shrunk(pixels: np.ndarray, size: int) -> np.ndarray:
    """Returns a square image with fewer pixels, each the mean of the area it covers, uint8 [size, size, 3]."""
    edges, old = np.linspace(0, len(pixels), size + 1), np.arange(len(pixels))
    shares = np.minimum(edges[1:, None], old + 1) - np.maximum(edges[:-1, None], old)
    shares = shares.clip(min=0) * size / len(pixels)
    return np.einsum("ij,jkc,lk->ilc", shares, pixels, shares).round().astype(np.uint8)
