"""Writes the report of a score: a figure, and a page with the figure, a table and the facts, in one file."""

import base64
from pathlib import Path

from physexp.agents import files
from physexp.analysis.data import plots, provenance, text
from physexp.analysis.score import drawing, scoring

NAME = "report"


def write(folder: Path) -> list[Path]:
    """Writes the report of a score beside it; returns the paths of the page and the figure.

    Args:
      folder: a folder that `scoring.score` has written.

    Raises:
      OSError: if it cannot be read or written.
      ValueError: if its `score.json` is faulty.
    """
    found = scoring.read(folder)
    with plots.style():
        figure = plots.png(drawing.draw(found))
    page = text.page(
        Path(__file__).with_name(f"{NAME}.html"),
        name=folder.resolve().name,
        found=found,
        image=base64.b64encode(figure).decode(),
        commit=provenance.shortened,
    )
    paths = [folder / f"{NAME}.html", folder / f"{NAME}.png"]
    for path, content in zip(paths, (page.encode(), figure), strict=True):
        files.write_atomically(path, content)
    return paths
