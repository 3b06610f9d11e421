"""The leaderboard: a row for each folder with a verified score of tracks, in words and as a figure."""

from collections.abc import Callable, Mapping, Sequence
import dataclasses
import os
from pathlib import Path
from typing import Any
from urllib import parse

import numpy as np

from physexp.agents import files
from physexp.analysis.data import plots, provenance, text
from physexp.analysis.score import log, protocol, replays, report, scores, scoring, transcripts, verifying

FOLDER = "scores"
NAME = "leaderboard"
_MARKERS = ("o", "s", "^", "D", "v", "P", "X", "<", ">", "*")  # Of domains.
_COLORS = (*plots.COLORS[1:], "#CC79A7", "#7F4F24")


@dataclasses.dataclass(frozen=True)
class Row:
    """A folder's name, its scores in the tracks that it plays, its `score.json`, and its costliest mistakes."""

    name: str
    tracks: Mapping[str, Mapping[str, Any]]
    found: Mapping[str, Any]
    mistakes: Sequence[replays.Replay]

    def told(self, fact: str) -> str:
        """Returns the values of a fact of its agents, in words; empty if they do not tell."""
        agent = self.found["agent"]
        agents = (agent.get("agents") or {"": agent}).values()
        values = dict.fromkeys(one[fact] for one in agents if one.get(fact) is not None)
        return ", ".join({True: "yes", False: "no"}.get(value, f"{value:g}") for value in values)

    @property
    def bits_lost(self) -> float | None:
        """The mean over its tasks of the bits that its stated beliefs lose; None if it has stated none."""
        stated = [task["beliefs"] for task in self.found["tasks"].values() if task.get("beliefs")]
        return float(np.mean([one["bits_lost"] for one in stated])) if stated else None

    def earned(self, track: str) -> float:
        """Returns the score of a track; 0 if it is not played."""
        return self.tracks[track]["score"] if track in self.tracks else 0.0


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
    rows, refused = [], []
    for done, folder in enumerate(folders(results), 1):
        try:
            rows.append(_row(folder, verify))
        except (OSError, ValueError) as error:
            refused.append(f"{folder} is no row: {error}")
        show(done)
    return sorted(rows, key=lambda row: ([-row.earned(track) for track in protocol.TRACKS], row.name)), refused


def _row(folder: Path, verify: Callable[[Path], None]) -> Row:
    """Returns the row of a folder, in numbers of this version; refuses fewer episodes, and tasks of no track."""
    found, questions = scoring.read(folder), protocol.in_tracks(["all"])
    extent, names = found["protocol"], [question.name for question in questions]
    if not found["complete"]:
        raise ValueError(f"{folder} is not complete: {found.get('problem')}; score again, elsewhere")
    fewest = transcripts.EPISODES if found["agent"].get("player") else protocol.EPISODES
    if extent["episodes"] not in (fewest, protocol.EPISODES):
        raise ValueError(f"{folder} has {extent['episodes']} episodes of each task; a row has {fewest:,}")
    if others := [name for name in extent["tasks"] or ["no task"] if name not in names]:
        raise ValueError(f"{folder} is of {others[0]}; a row is of tasks of the tracks {', '.join(protocol.TRACKS)}")
    verify(folder)
    logged = log.read(folder)
    played = scores.of_log(logged, dict.fromkeys(questions), num_agents=extent["agents"])
    return Row(folder.name, scores.over_tracks(played), found, replays.costliest(logged, questions))


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
        tracks={name: _in_track(rows, name) for name in _played(rows)},
        meanings=protocol.TRACKS,
        words=report.words,
        player=report.player,
        number=lambda score: f"{score:.3f}".replace("-0.000", "0.000"),
        quote=lambda name: parse.quote(os.fsencode(name)),
        commit=provenance.shortened,
    )


def _played(rows: Sequence[Row]) -> list[str]:
    """Returns the tracks that a row has."""
    return [name for name in protocol.TRACKS if any(name in row.tracks for row in rows)]


def _in_track(rows: Sequence[Row], track: str) -> list[Row]:
    """Returns the rows that play a track, best first."""
    return sorted((row for row in rows if track in row.tracks), key=lambda row: -row.earned(track))


def draw(rows: Sequence[Row]):
    """Draws the score of each row in each track, with its interval, and those of the domains that it plays."""
    tracks = _played(rows)
    domains = list(dict.fromkeys(domain for row in rows for one in row.tracks.values() for domain in one["domains"]))
    looks = {
        domain: dict(marker=_MARKERS[number % len(_MARKERS)], color=_COLORS[number % len(_COLORS)], markersize=3.5)
        for number, domain in enumerate(domains)
    }
    figure, panels = plots.new(
        columns=len(tracks), width=6.2 / len(tracks) + 1.0, height=max(2.2, 0.95 + 0.3 * len(rows)), squeeze=False
    )
    for axes, track in zip(panels[0], tracks, strict=True):
        _draw_track(axes, [row.tracks.get(track) for row in rows], looks)
        axes.set(title=track, xlim=(report.LOWEST - 0.03, 1.04), xlabel="score")
        names = [plots.literal(text.plain(row.name)) for row in rows]
        report.name_rows(axes, names if axes is panels[0, 0] else [""] * len(rows))
    for domain, look in looks.items():
        panels[0, -1].plot([], [], linestyle="none", label=report.words(domain), **look)
    panels[0, -1].plot([], [], "|", color="black", markersize=10, markeredgewidth=2, label="mean, 95 % interval")
    panels[0, -1].legend(loc="center left", bbox_to_anchor=(1.01, 0.5))
    return figure


def _draw_track(axes, found: Sequence[Mapping[str, Any] | None], looks: Mapping[str, Mapping[str, Any]]) -> None:
    """Draws the scores of the rows in a track, from top to bottom; None for a row that does not play it."""
    heights = dict(zip(looks, np.linspace(0.3, -0.3, len(looks)), strict=True))  # So that equal scores are all seen.
    for place, one in zip(np.arange(len(found))[::-1], found, strict=True):
        axes.axhline(place, color="0.93", linewidth=0.7, zorder=0)
        if one is None:
            continue
        ends = np.clip(one["interval"], report.LOWEST, None)
        axes.plot(ends, [place] * 2, color="black", linewidth=9, alpha=0.3, solid_capstyle="butt")
        score = max(report.LOWEST, one["score"])
        axes.plot(score, place, "|", color="black", markersize=15, markeredgewidth=2)
        for domain, its in one["domains"].items():
            if its["played"]:
                axes.plot(max(report.LOWEST, its["score"]), place + heights[domain], zorder=3, **looks[domain])
