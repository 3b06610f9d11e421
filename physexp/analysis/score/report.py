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
    import jinja2

    found = scoring.read(folder)
    with plots.style():
        figure = plots.png(drawing.draw(found))
    templates = jinja2.Environment(
        loader=jinja2.PackageLoader("physexp.analysis.score", ""),
        autoescape=True,
        finalize=lambda value: text.plain(value) if type(value) is str else value,  # Macros return escaped text.
        trim_blocks=True,
    )
    page = templates.get_template(f"{NAME}.html").render(
        name=folder.resolve().name, found=found, image=base64.b64encode(figure).decode(), commit=provenance.shortened
    )
    paths = [folder / f"{NAME}.html", folder / f"{NAME}.png"]
    for path, content in zip(paths, (page.encode(), figure), strict=True):
        files.write_atomically(path, content)
    return paths
