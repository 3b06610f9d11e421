"""Writes the report of a score: a figure, and a page with the figure, a table and the facts, in one file.

The figure has the tasks and the tracks, the mistakes in each task, and the information from each interaction.
"""

import base64
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from physexp.agents import files
from physexp.analysis.data import plots, provenance, text
from physexp.analysis.ideal import mistakes
from physexp.analysis.score import log, protocol, records, scores, scoring

NAME = "report"

LOWEST = -1.0
"""Lower scores are drawn there."""

_COLORS = dict(zip(mistakes.KINDS, ("#E69F00", "#56B4E9", "#009E73", "#D55E00", "#000000", "#BBBBBB"), strict=True))
_HATCHES = dict(zip(mistakes.KINDS, ("", "///", "...", "xx", "", "\\\\"), strict=True))
_AGENT = plots.COLORS[1]
_WIDTH = 11.2  # Of the figure, inches.
_BACKGROUND = dict(facecolor="white", edgecolor="none", alpha=0.8, pad=0.5)  # Of numbers over lines.
_PANELS = 8  # In a row.
_MAX_INTERACTIONS = 12  # In a panel.
_INFORMATION = (
    "Bits of information about the answer from the first interaction, the second, and so on, mean over all episodes; "
    "outline: the ideal"
)


def write(folder: Path) -> list[Path]:
    """Writes the report of a score beside it; returns the paths of the page and the figure.

    Raises OSError if the folder cannot be read or written, and ValueError if its `score.json` is faulty.
    """
    found = scoring.read(folder)
    if found["version"] == protocol.FIRST_VERSION:  # It is shown in numbers of this version.
        ideals = {one: scores.reference(one, found["protocol"]["episodes"]) for one in protocol.named(found["tasks"])}
        found |= scores.summary(scores.of_log(log.read(folder), ideals))
    with plots.style():
        figure = plots.png(draw(found))
    page = text.page(
        Path(__file__).with_name(f"{NAME}.html"),
        name=folder.resolve().name,
        found=found,
        headlines=scores.headlines(found),
        image=base64.b64encode(figure).decode(),
        commit=provenance.shortened,
        player=player,
    )
    paths = [folder / f"{NAME}.html", folder / f"{NAME}.png"]
    for path, content in zip(paths, (page.encode(), figure), strict=True):
        files.write_atomically(path, content)
    return paths


def draw(found: Mapping[str, Any]):
    """Returns the figure of a score, from the content of `score.json`."""
    num_tasks = len(found["tasks"])
    of_rows = 0.95 + 0.24 * (num_tasks + len(found["tracks"]))
    heights = [of_rows, 0.1 + 0.14 * -(-len(_costly_kinds(found)) // 2), 0.35 + 1.7 * -(-num_tasks // _PANELS)]
    figure = plots.empty(_WIDTH, sum(heights))
    above, legend, below = figure.subfigures(3, 1, height_ratios=heights)
    left, right = above.subplots(1, 2)
    draw_scores(left, found)
    draw_mistakes(right, found)
    _add_legend(legend, found)
    columns = min(_PANELS, max(4, num_tasks))
    panels = below.subplots(-(-num_tasks // columns), columns, squeeze=False).flat
    for axes in panels[num_tasks:]:
        axes.set_axis_off()
    draw_information(panels[:num_tasks], found)
    below.suptitle(_INFORMATION, fontsize=8.5, x=0.01, ha="left")
    return figure


def words(name: str) -> str:
    """Returns the name of a domain or a task in words: `towers, fist` for `towers/fist_features`."""
    domain, _, setting = name.partition("/")
    task, *options = setting.split(",")
    parts = (domain, task.removesuffix("features").strip("_"), *options)
    return ", ".join(part.replace("_", " ").replace("=", " ") for part in parts if part)


def player(agent: Mapping[str, Any]) -> str:
    """Returns the facts about the player of records, in words; empty for other agents."""
    facts = [f"{name} {agent[name]}" for name in records.FACTS if agent.get(name) is not None]
    return "; ".join(facts + [f"{name} {amount:,.10g}" for name, amount in (agent.get("told") or {}).items()])


def draw_scores(axes, found: Mapping[str, Any]) -> None:
    """Draws the score of each task and of each track, with its interval, beside that of random actions in the task."""
    rows = [*found["tasks"].items(), *found["tracks"].items()]
    places = np.arange(len(rows))[::-1]
    for place, (name, row) in zip(places, rows, strict=True):
        low, high = np.clip(row["interval"], LOWEST, 1.0)
        center = max(LOWEST, row["score"])
        is_track = name in found["tracks"]
        color = "black" if is_track else _AGENT
        axes.plot([low, high], [place] * 2, color=color, linewidth=2.2, solid_capstyle="butt")
        axes.plot(center, place, "D" if is_track else "o", color=color, markersize=5, zorder=3)
        at_left = center > 0.5 or -0.5 < center < 0  # Not over a mark of `name_rows`.
        look = dict(ha="right" if at_left else "left", va="center", fontsize=7.5, bbox=_BACKGROUND)
        start = dict(xytext=(-5 if at_left else 5, 0), textcoords="offset points")
        axes.annotate(f"{row['score']:.3f}", (low if at_left else high, place), **start, **look)
        if not is_track:
            at_random = (row["random"] - row["floor"]) / (row["ideal"] - row["floor"])
            axes.plot(max(LOWEST, at_random), place, "|", color=plots.GREY, markersize=8, markeredgewidth=1.4)
    axes.set(xlim=(LOWEST - 0.04, 1.06), xlabel="score (grey: random actions)")
    name_rows(axes, [f"all of {name}" if name in found["tracks"] else words(name) for name, _ in rows])


def draw_mistakes(axes, found: Mapping[str, Any]) -> None:
    """Draws a bar for each task: the score, followed by the cost of each kind of mistake, up to 1."""
    places = np.arange(len(found["tasks"]))[::-1]
    for place, task in zip(places, found["tasks"].values(), strict=True):
        end = task["score"]
        axes.barh(place, max(0.0, end), color=_AGENT, alpha=0.3, height=0.62)
        axes.plot([end] * 2, [place - 0.36, place + 0.36], color=_AGENT, linewidth=1.6, zorder=3)
        for kind, cost in task["mistakes"].items():
            axes.barh(place, cost, left=end, height=0.62, **_look(kind))
            end += cost
    lowest = min(-0.1, *(task["score"] for task in found["tasks"].values()))
    axes.set(xlim=(lowest - 0.04, 1.06), xlabel="score, and then the cost of mistakes")
    name_rows(axes, list(map(words, found["tasks"])))


def draw_information(panels: Sequence[Any], found: Mapping[str, Any]) -> None:
    """Draws for each task, in axes of its own, the bits from each interaction beside those of the ideal."""
    for axes, (name, task) in zip(panels, found["tasks"].items(), strict=True):
        ours, ideal = np.array(task["gains"]), np.array(task["ideal_gains"] or [])
        count = min(_MAX_INTERACTIONS, max(_reach(ours), _reach(ideal), 1))
        axes.bar(np.arange(1, count + 1), _first(ours, count), color=_AGENT, alpha=0.75, width=0.8)
        if len(ideal):
            axes.stairs(_first(ideal, count), np.arange(count + 1) + 0.5, color="black", linewidth=1.2)
        highest = max(0.1, *_first(ours, count), *_first(ideal, count))
        axes.set(title=words(name), xlim=(0.3, count + 0.7), ylim=(0, 1.12 * highest))
        axes.set_xticks(range(1, count + 1) if count <= 6 else range(2, count + 1, 2))
        axes.set_xlabel("interaction", fontsize=7)
        axes.tick_params(labelsize=7)
    panels[0].set_ylabel("bits")


def name_rows(axes, names: Sequence[str]) -> None:
    """Names the rows of scores, from top to bottom, and marks the scores 0, without an experiment, and 1, the ideal."""
    axes.set_yticks(np.arange(len(names))[::-1], names)
    axes.set_ylim(-0.7, len(names) - 0.3)
    axes.tick_params(axis="y", length=0)
    for level, name in ((0.0, "no experiment"), (1.0, "ideal")):
        plots.reference(axes, level, "", vertical=True)
        axes.text(level, len(names) - 0.35, name, ha="center", va="bottom", fontsize=6.5, color="0.3")


def _costly_kinds(found: Mapping[str, Any]) -> list[str]:
    """Returns the kinds of mistakes whose bars are wide enough to be seen."""
    return [kind for kind in mistakes.KINDS if any(task["mistakes"][kind] > 5e-4 for task in found["tasks"].values())]


def _look(kind: str) -> dict[str, Any]:
    return dict(facecolor=_COLORS[kind], hatch=_HATCHES[kind], edgecolor="white", linewidth=0)


def _add_legend(figure, found: Mapping[str, Any]) -> None:
    from matplotlib import patches

    handles = [patches.Patch(**_look(kind), label=f"{kind}: {mistakes.KINDS[kind]}") for kind in _costly_kinds(found)]
    if handles:
        figure.legend(handles=handles, fontsize=6.5, handlelength=1.4, loc="upper center", ncols=2)


def _reach(gains: np.ndarray) -> int:
    """Returns the number of interactions after which 99 % of the bits are known."""
    return int(np.searchsorted(np.cumsum(gains), 0.99 * gains.sum()) + 1) if gains.sum() > 1e-9 else 0


def _first(gains: np.ndarray, count: int) -> np.ndarray:
    return np.pad(gains[:count], (0, max(0, count - len(gains))))
