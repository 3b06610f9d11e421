"""The style of figures, which are readable in grey and by colour-blind readers, and their files."""

import contextlib
import io
import math
from pathlib import Path
from typing import Any

from physexp.agents import files

# Okabe and Ito's colours (2008), darkest first, so that they differ in grey too; lines differ in dashes as well.
COLORS = ("#000000", "#0072B2", "#D55E00", "#009E73", "#56B4E9", "#E69F00")
DASHES = ("solid", (0, (5, 1.5)), (0, (1, 1.2)), (0, (5, 1.5, 1, 1.5)), (0, (3, 1, 1, 1, 1, 1)))
MARKERS = ("o", "s", "^", "D", "v", "P")
GREY = "0.45"
_DOTTED = (0, (1, 2))
_DPI = 220  # Of PNG; sharp on screens of two dots to a pixel.

_STYLE: Any = {
    "font.family": "DejaVu Sans",
    "font.size": 8,
    "axes.titlesize": 8.5,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.linewidth": 0.7,
    "xtick.major.width": 0.7,
    "ytick.major.width": 0.7,
    "legend.frameon": False,
    "legend.fontsize": 7.5,
    "lines.linewidth": 1.4,
    "svg.fonttype": "none",
    "svg.hashsalt": "physexp",
}


@contextlib.contextmanager
def style():
    """Returns a context with the style of figures, in which they are drawn and saved."""
    import matplotlib

    with matplotlib.rc_context():
        matplotlib.rcdefaults()
        matplotlib.rcParams.update(_STYLE)
        yield


def literal(words: str) -> str:
    """Returns a text for a figure in which a dollar sign begins no formula."""
    return words.replace("$", r"\$")


def new(columns: int = 1, rows: int = 1, width: float = 3.4, height: float = 2.6, **kwargs: Any):
    """Returns a figure and its axes, an array [rows, columns] if there are several.

    Width and height are those of one pair of axes, inches; `kwargs` are for `Figure.subplots`.
    """
    figure = empty(width * columns, height * rows)
    return figure, figure.subplots(rows, columns, **kwargs)


def grid(count: int, columns: int, **kwargs: Any):
    """Returns a figure and axes as `new` does, [rows, columns], without those in the last row beyond a count."""
    figure, panels = new(columns=columns, rows=math.ceil(count / columns), squeeze=False, **kwargs)
    for axes in panels.flat[count:]:
        axes.remove()
    return figure, panels


def empty(width: float, height: float):
    """Returns a figure without axes, of a size in inches; it need not be closed."""
    from matplotlib import figure

    return figure.Figure(figsize=(width, height), layout="constrained")


def svg(figure) -> bytes:
    """Returns a figure as SVG with selectable text; equal data give equal bytes."""
    drawn = io.BytesIO()
    with style():
        figure.savefig(drawn, format="svg", metadata={"Date": None})
    return drawn.getvalue()


def png(figure) -> bytes:
    """Returns a figure as PNG."""
    from PIL import Image

    drawn = io.BytesIO()
    with style():
        figure.savefig(drawn, dpi=_DPI, format="png")
    # A figure has few colours: a palette of 256 makes the file a third as large.
    palette = Image.open(drawn).convert("RGB").quantize(256, dither=Image.Dither.NONE)
    packed = io.BytesIO()
    palette.save(packed, format="png", optimize=True, dpi=(_DPI, _DPI))
    return packed.getvalue()


def save(figure: Any, folder: Path, name: str) -> Path:
    """Writes a figure as PNG; returns the path; raises OSError if it cannot."""
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / f"{name}.png"
    files.write_atomically(path, png(figure))
    return path


def reference(axes, level: float, text: str, vertical: bool = False, at: float = 1.0) -> None:
    """Draws a thin line at a level, with its name at a position along it, from 0 to 1."""
    line, words = (axes.axvline, axes.get_xaxis_transform()) if vertical else (axes.axhline, axes.get_yaxis_transform())
    line(level, color=GREY, linewidth=0.8, linestyle=_DOTTED, zorder=0)
    if not text:
        return
    place = dict(x=level, y=at) if vertical else dict(x=at, y=level)
    align = dict(ha="left", va="top", rotation=90) if vertical else dict(ha="right", va="bottom")
    background = dict(facecolor="white", edgecolor="none", alpha=0.8, pad=0.5)
    axes.text(**place, s=text, transform=words, color="0.3", fontsize=6.5, bbox=background, **align)


def seeds(frame) -> str:
    """Returns the number of agents of a figure in words: `10 agents each`."""
    counts = frame.groupby("condition").training_seed.nunique()
    low, high = int(counts.min()), int(counts.max())
    many = "agent" if high == 1 else "agents"
    return f"{low} {many} each" if low == high else f"{low} to {high} {many} each"
