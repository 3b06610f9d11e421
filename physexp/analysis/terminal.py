"""Observations as text, as large as the terminal has room for."""

from collections.abc import Collection, Mapping

import numpy as np

_WIDTH, _HEIGHT = 48, 14  # Characters of a drawing at most.
_ROOM = 0.6  # m, from the middle to the side of a drawing of the towers
_SMALLEST_IMAGE = 16  # Pixels: where less is drawn nothing can be told apart.
_OTHER_LINES = 3  # Of the terminal, which are not the image's.


def legend(observation: Collection[str]) -> str:
    """What a drawing of an observation with these names shows, in words."""
    if "pixels" in observation:
        return "You see what the agent sees, an image."
    if "heights" in observation:
        return "You see how high each block is above its rest."
    fist = " O is the fist." if "fist_position" in observation else ""
    return f"You see the room from the side: +x is to the right, +y away from you, the digits are the blocks.{fist}"


def drawing(observation: Mapping[str, np.ndarray], columns: int = 80, lines: int = 24) -> str:
    """An observation as text: bars of heights, the towers from the side, or an image in coloured half blocks.

    Args:
      observation: what is seen.
      columns, lines: the terminal's size.
    """
    if "pixels" in observation:
        return _image(observation["pixels"], columns, lines)
    if "heights" in observation:
        room = max(1, min(40, columns - 18))
        return "\n".join(
            f"block {k} {'#' * round(100 * height * room / 40):{room}} {100 * height:5.1f} cm"
            for k, height in enumerate(observation["heights"])
        )
    return _side(observation, max(12, min(_WIDTH, columns)), max(6, min(_HEIGHT, lines - _OTHER_LINES)))


def _side(observation: Mapping[str, np.ndarray], width: int, height: int) -> str:
    canvas = np.full((height, width), " ")
    things = {str(k): position for k, position in enumerate(observation["positions"])}
    if "fist_position" in observation:
        things["O"] = observation["fist_position"]
    for name, (x, _, z) in things.items():
        column = round((x + _ROOM) / (2 * _ROOM) * (width - 1))
        row = height - 1 - round(z / 0.55 * (height - 1))
        if 0 <= column < width and 0 <= row < height:
            canvas[row, column] = name
    aside = "  ".join(f"{name}: y {100 * y:+.1f} cm" for name, (_, y, _) in things.items())
    return "\n".join(["".join(row).rstrip() for row in canvas] + ["-" * width, aside])


def _image(pixels: np.ndarray, columns: int, lines: int) -> str:
    """Two rows of pixels in each line of text, by 24-bit colours."""
    size = min(len(pixels), columns, 2 * (lines - _OTHER_LINES)) // 2 * 2
    if size < _SMALLEST_IMAGE:
        needed, best = (f"{side} by {side // 2 + _OTHER_LINES}" for side in (_SMALLEST_IMAGE, len(pixels)))
        size_now = f"{columns} columns by {lines} lines"
        return f"(the terminal has {size_now}, too small for an image: it needs {needed}, and {best} is best)"
    text = []
    small = _shrunk(pixels, size)
    for upper, lower in zip(small[::2], small[1::2], strict=True):
        cells = (
            f"\x1b[38;2;{a[0]};{a[1]};{a[2]};48;2;{b[0]};{b[1]};{b[2]}m▀" for a, b in zip(upper, lower, strict=True)
        )
        text.append("".join(cells) + "\x1b[0m")
    return "\n".join(text)


def _shrunk(pixels: np.ndarray, size: int) -> np.ndarray:
    """A square image with fewer pixels, each the mean of the area it covers, uint8 [size, size, 3]."""
    edges, old = np.linspace(0, len(pixels), size + 1), np.arange(len(pixels))
    shares = np.minimum(edges[1:, None], old + 1) - np.maximum(edges[:-1, None], old)
    shares = shares.clip(min=0) * size / len(pixels)
    return np.einsum("ij,jkc,lk->ilc", shares, pixels, shares).round().astype(np.uint8)
