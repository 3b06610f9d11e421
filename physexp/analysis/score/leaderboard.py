"""The leaderboard: a row for each folder with a verified score of the whole protocol, in words and as a figure."""

import collections
from collections.abc import Callable, Mapping, Sequence
import dataclasses
import os
from pathlib import Path
from typing import Any
from urllib import parse

import numpy as np

from physexp.agents import files
from physexp.analysis.data import plots, provenance, text
from physexp.analysis.score import log, protocol, report, scores, scoring, verifying

FOLDER = "scores"
NAME = "leaderboard"
_MARKERS = ("o", "s", "^", "D", "v", "P", "X", "<", ">", "*")  # Of domains.
_COLORS = (*plots.COLORS[1:], "#CC79A7", "#7F4F24")


@dataclasses.dataclass(frozen=True)
class Row:
    """A folder's name, its scores over all domains and of each, the numbers of tasks it plays, and its `score.json`."""

    name: str
    whole: Mapping[str, Any]
    domains: Mapping[str, Mapping[str, Any]]
    played: Mapping[str, tuple[int, int]]  # Of each domain's tasks those that were played, and all.
    found: Mapping[str, Any]


def folders(results: Path) -> list[Path]:
    """Returns the folders of all rows; raises FileNotFoundError if there are none."""
    found = [folder for folder in sorted((results / FOLDER).glob("*")) if folder.is_dir()]
    if not found:
        raise FileNotFoundError(f"{results / FOLDER} has no scores; `physexp score` one into a folder there")
    return found


def read(
    results: Path,
    verify: Callable[[Path], None] = verifying.verify_once,
    show: Callable[[int], None] = lambda done: None,
) -> tuple[list[Row], list[str]]:
    """Returns the rows, best first, and a line for each folder that gives none: its name, and the reason.

    `verify` raises ValueError for a folder whose score does not follow from its actions; `show` is called with the
    number of folders that are done. Raises OSError if there are none.
    """
    questions, rows, refused = protocol.observing("features"), [], []
    for done, folder in enumerate(folders(results), 1):
        try:
            rows.append(_row(folder, questions, verify))
        except (OSError, ValueError) as error:
            refused.append(f"{folder} is no row: {error}")
        show(done)
    return sorted(rows, key=lambda row: (-row.whole["score"], row.name)), refused


def _row(folder: Path, questions: Sequence[protocol.Question], verify: Callable[[Path], None]) -> Row:
    """Returns the row of a folder; refuses less than the whole protocol, and tasks that no row has."""
    found, names = scoring.read(folder), [question.name for question in questions]
    extent = found["protocol"]
    if not found["complete"]:
        raise ValueError(f"{folder} is not complete: {found.get('problem')}; score again, elsewhere")
    if extent["episodes"] != protocol.EPISODES:
        raise ValueError(f"{folder} has {extent['episodes']} episodes of each task; a row has {protocol.EPISODES:,}")
    if others := [name for name in extent["tasks"] or ["no task"] if name not in names]:
        raise ValueError(f"{folder} is of {others[0]}; a row is of {', '.join(names)}")
    verify(folder)
    played = scores.of_log(log.read(folder), dict.fromkeys(questions))
    earned = scores.over(played, questions)
    of_all = collections.Counter(question.domain for question in questions)
    done = collections.Counter(one.question.domain for one in played)
    counts = {domain: (done[domain], of_all[domain]) for domain in earned["domains"]}
    return Row(folder.name, earned["whole"], earned["domains"], counts, found)


def write(results: Path, show: Callable[[int], None] = lambda done: None) -> tuple[list[Path], list[str]]:
    """Writes the leaderboard as Markdown, and its figure; returns the paths, and a line for each refused folder.

    Raises OSError if there are no folders or a file cannot be written, and ValueError if no folder gives a row.
    """
    rows, refused = read(results, show=show)
    if not rows:
        raise ValueError(refused[0])
    paths = [results / f"{NAME}.md", results / "figures" / f"{NAME}.png"]
    files.write_atomically(paths[0], markdown(rows).encode())
    paths[1].parent.mkdir(exist_ok=True)
    with plots.style():
        files.write_atomically(paths[1], plots.png(draw(rows)))
    return paths, refused


def markdown(rows: Sequence[Row]) -> str:
    """Returns the page of the leaderboard; the name of a row is a link to its folder."""
    return text.page(
        Path(__file__).with_name(f"{NAME}.md"),
        rows=rows,
        words=report.words,
        number=lambda score: f"{score:.3f}".replace("-0.000", "0.000"),
        quote=lambda name: parse.quote(os.fsencode(name)),
        commit=provenance.shortened,
    )


def draw(rows: Sequence[Row]):
    """Draws the score of each row, with its interval, and those of the domains that it plays."""
    figure, axes = plots.new(width=7.2, height=max(2.2, 0.75 + 0.3 * len(rows)))
    looks = {
        domain: dict(marker=_MARKERS[number % len(_MARKERS)], color=_COLORS[number % len(_COLORS)], markersize=3.5)
        for number, domain in enumerate(rows[0].domains)
    }
    heights = np.linspace(0.3, -0.3, len(looks))  # One below the other, so that equal scores are all seen.
    places = np.arange(len(rows))[::-1]
    for place, row in zip(places, rows, strict=True):
        axes.axhline(place, color="0.93", linewidth=0.7, zorder=0)
        ends = np.clip(row.whole["interval"], report.LOWEST, None)
        axes.plot(ends, [place] * 2, color="black", linewidth=9, alpha=0.3, solid_capstyle="butt")
        score = max(report.LOWEST, row.whole["score"])
        axes.plot(score, place, "|", color="black", markersize=15, markeredgewidth=2)
        for (domain, look), height in zip(looks.items(), heights, strict=True):
            if row.played[domain][0]:
                axes.plot(max(report.LOWEST, row.domains[domain]["score"]), place + height, zorder=3, **look)
    for domain, look in looks.items():
        axes.plot([], [], linestyle="none", label=report.words(domain), **look)
    label = "score: black, over all domains, with its 95 % interval; others, of each domain"
    axes.set(xlim=(report.LOWEST - 0.03, 1.04), xlabel=label)
    report.name_rows(axes, [plots.literal(text.plain(row.name)) for row in rows])
    axes.legend(loc="center left", bbox_to_anchor=(1.01, 0.5))
    return figure
