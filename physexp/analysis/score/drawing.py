"""Draws the figures of a score: its domains, its mistakes, its skills, and what was found out."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from physexp.analysis import domains
from physexp.analysis.data import plots
from physexp.analysis.ideal import mistakes

_COLORS = dict(zip(mistakes.KINDS, ("#E69F00", "#56B4E9", "#009E73", "#D55E00", "#000000", "#BBBBBB"), strict=True))
_HATCHES = dict(zip(mistakes.KINDS, ("", "///", "...", "xx", "", "\\\\"), strict=True))
OURS = plots.COLORS[1]
LEAST = -1.0  # What is less is drawn there.
_LEAST_RADAR = 3  # Fewer axes enclose nothing.
_MOST_SHOWN = 12  # Interactions.


def words(name: str) -> str:
    """Returns a name of a domain or a task as it is read: `towers, fist` for `towers/fist_features`."""
    domain, _, task = name.partition("/")
    task = task.removesuffix("features").strip("_")
    return ", ".join(part.replace("_", " ") for part in (domain, task) if part)


def share(figures_of_task: Mapping[str, Any], name: str) -> float:
    """Returns a return among a task's figures, such as `random`, as a score."""
    ideal, floor = figures_of_task["ideal"], figures_of_task["floor"]
    return (figures_of_task[name] - floor) / (ideal - floor)


def has_skills(found: Mapping[str, Any]) -> bool:
    """Returns whether there are domains enough for a figure of skills."""
    return len(found["domains"]) >= _LEAST_RADAR


def draw_scores(axes, found: Mapping[str, Any]) -> None:
    """Draws the score of each domain, and of the whole, with its interval, beside random actions."""
    of_random = random_scores(found)
    rows = list(found["domains"].items())
    if len(rows) > 1:
        rows.append(("all domains", found["whole"]))
    places = np.arange(len(rows))[::-1]
    for place, (name, row) in zip(places, rows, strict=True):
        low, high = np.clip(row["interval"], LEAST, 1.0)
        center = max(LEAST, row["score"])
        is_whole = name not in found["domains"]
        color = "black" if is_whole else OURS
        axes.plot([low, high], [place] * 2, color=color, linewidth=2.2, solid_capstyle="butt")
        axes.plot(center, place, "D" if is_whole else "o", color=color, markersize=5, zorder=3)
        at_left = center > 0.5 or -0.5 < center < 0  # Not over a mark of `mark_ends`.
        axes.annotate(
            f"{row['score']:.3f}",
            (low if at_left else high, place),
            xytext=(-5 if at_left else 5, 0),
            textcoords="offset points",
            ha="right" if at_left else "left",
            va="center",
            fontsize=7.5,
            bbox=dict(facecolor="white", edgecolor="none", alpha=0.8, pad=0.5),
        )
        if not is_whole:
            axes.plot(max(LEAST, of_random[name]), place, "|", color=plots.GREY, markersize=8, markeredgewidth=1.4)
    axes.set_yticks(places, [words(name) for name, _ in rows])
    axes.set(xlim=(LEAST - 0.04, 1.06), ylim=(-0.7, len(rows) - 0.3), xlabel="score (grey: random actions)")
    axes.tick_params(axis="y", length=0)
    mark_ends(axes, len(rows))


def random_scores(found: Mapping[str, Any]) -> dict[str, float]:
    """Returns what random actions are expected to score, by domain."""
    return {domain: float(np.mean([share(task, "random") for task in tasks])) for domain, tasks in _grouped(found)}


def _grouped(found: Mapping[str, Any]) -> list[tuple[str, list[Mapping[str, Any]]]]:
    """Returns the figures of the tasks of each domain."""
    return [
        (domain, [task for name, task in found["tasks"].items() if name.startswith(f"{domain}/")])
        for domain in found["domains"]
    ]


def draw_mistakes(axes, found: Mapping[str, Any]) -> None:
    """Draws for each task the score, and from its end what was lost by which mistakes, up to 1."""
    places = np.arange(len(found["tasks"]))[::-1]
    for place, task in zip(places, found["tasks"].values(), strict=True):
        end = task["score"]
        axes.barh(place, max(0.0, end), color=OURS, alpha=0.3, height=0.62)
        axes.plot([end] * 2, [place - 0.36, place + 0.36], color=OURS, linewidth=1.6, zorder=3)
        for kind, cost in task["mistakes"].items():
            axes.barh(
                place,
                cost,
                left=end,
                color=_COLORS[kind],
                hatch=_HATCHES[kind],
                edgecolor="white",
                linewidth=0,
                height=0.62,
            )
            end += cost
    lowest = min(-0.1, *(task["score"] for task in found["tasks"].values()))
    axes.set_yticks(places, [words(name) for name in found["tasks"]])
    axes.set(xlim=(lowest - 0.04, 1.06), ylim=(-0.7, len(places) - 0.3), xlabel="score, and then what mistakes cost")
    axes.tick_params(axis="y", length=0)
    mark_ends(axes, len(places))


def mark_ends(axes, num_rows: int) -> None:
    """Marks where nobody experiments and where the ideal is."""
    for level, text in ((0.0, "no experiment"), (1.0, "ideal")):
        plots.reference(axes, level, "", vertical=True)
        axes.text(level, num_rows - 0.35, text, ha="center", va="bottom", fontsize=6.5, color="0.3")


def kinds_shown(found: Mapping[str, Any]) -> list[str]:
    """Returns the kinds of mistakes that cost something that can be seen."""
    return [kind for kind in mistakes.KINDS if any(task["mistakes"][kind] > 5e-4 for task in found["tasks"].values())]


def legend_of_mistakes(figure, found: Mapping[str, Any], **kwargs: Any) -> None:
    """Puts the kinds of mistakes into a figure, in words."""
    from matplotlib import patches

    handles = [
        patches.Patch(
            facecolor=_COLORS[kind],
            hatch=_HATCHES[kind],
            edgecolor="white",
            linewidth=0,
            label=f"{kind}: {mistakes.KINDS[kind]}",
        )
        for kind in kinds_shown(found)
    ]
    if handles:
        figure.legend(handles=handles, fontsize=6.5, handlelength=1.4, **kwargs)


def draw_skills(axes, found: Mapping[str, Any]) -> None:
    """Draws the scores of domains as a radar, beside random actions and the ideal; the axes are polar."""
    names = list(found["domains"])
    angles = np.linspace(0, 2 * np.pi, len(names), endpoint=False)
    around = np.append(angles, angles[0])

    def outline(values: Sequence[float], **kwargs: Any):
        clipped = np.clip(values, LEAST, 1.0)
        return axes.plot(around, np.append(clipped, clipped[0]), **kwargs)[0]

    axes.set_theta_offset(np.pi / 2)
    axes.set_theta_direction(-1)
    axes.set_ylim(LEAST, 1.0)
    axes.spines["polar"].set_visible(False)
    axes.grid(color="0.88", linewidth=0.7)
    outline([1.0] * len(names), color="black", linewidth=1.0, label="ideal")
    outline([0.0] * len(names), color=plots.GREY, linewidth=0.8, linestyle=(0, (1, 2)), label="no experiment")
    chance = list(random_scores(found).values())
    outline(chance, color=plots.COLORS[2], linewidth=1.1, zorder=4, linestyle=(0, (3, 1.5)), label="random actions")
    ours = [row["score"] for row in found["domains"].values()]
    line = outline(ours, color=OURS, linewidth=1.8, marker="o", markersize=3.5, label="this agent")
    axes.fill(around, line.get_ydata(), color=OURS, alpha=0.15)
    axes.legend(loc="upper left", bbox_to_anchor=(-0.62, -0.06), fontsize=6.5, handlelength=2.2)
    axes.set_yticks([-0.5, 0.0, 0.5, 1.0], ["", "0", "0.5", "1"], fontsize=6, color="0.4")
    axes.set_rlabel_position(np.degrees(np.pi / len(names)))
    axes.set_xticks(angles, [""] * len(names))
    for angle, name in zip(angles, names, strict=True):
        side = np.sin(angle)
        align = "center" if abs(side) < 0.1 else ("left" if side > 0 else "right")
        above = np.cos(angle)
        axes.text(
            angle,
            1.16,
            f"{domains.find(name).skill}\n({words(name)})",
            ha=align,
            va="bottom" if above > 0.7 else ("top" if above < -0.7 else "center"),
            fontsize=7,
            linespacing=1.25,
        )


def draw_information(panels: Sequence[Any], found: Mapping[str, Any]) -> None:
    """Draws for each task, in axes of its own, the bits that interactions brought, beside the ideal's."""
    for axes, (name, task) in zip(panels, found["tasks"].items(), strict=True):
        ours, ideal = np.array(task["gains"]), np.array(task["ideal_gains"] or [])
        count = min(_MOST_SHOWN, max(_reach(ours), _reach(ideal), 1))
        axes.bar(np.arange(1, count + 1), _first(ours, count), color=OURS, alpha=0.75, width=0.8)
        if len(ideal):
            axes.stairs(_first(ideal, count), np.arange(count + 1) + 0.5, color="black", linewidth=1.2)
        most = max(0.1, *_first(ours, count), *_first(ideal, count))
        axes.set(title=words(name), xlim=(0.3, count + 0.7), ylim=(0, 1.12 * most))
        axes.set_xticks(_ticks(count))
        axes.set_xlabel("interaction", fontsize=7)
        axes.tick_params(labelsize=7)


def _ticks(count: int) -> list[int]:
    return list(range(1, count + 1)) if count <= 6 else list(range(2, count + 1, 2))


def _reach(gains: np.ndarray) -> int:
    """Returns after how many interactions 99 % of the bits are known."""
    return int(np.searchsorted(np.cumsum(gains), 0.99 * gains.sum()) + 1) if gains.sum() > 1e-9 else 0


def _first(gains: np.ndarray, count: int) -> np.ndarray:
    return np.pad(gains[:count], (0, max(0, count - len(gains))))
