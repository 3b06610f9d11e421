"""A score's report: one page about it, as HTML that needs no other file, and as an image."""

import base64
from collections.abc import Callable, Mapping
from pathlib import Path
import textwrap
from typing import Any

from physexp.agents import files
from physexp.analysis.data import plots, provenance, text
from physexp.analysis.score import drawing, scoring

NAME = "report"
_WIDTH = 11.2  # Of the page, inches.
_PANELS = 8  # In a row.


def write(folder: Path) -> list[Path]:
    """Writes the report of a score beside it; returns the paths of the page and the image.

    Args:
      folder: what `scoring.score` has written.

    Raises:
      OSError: if it cannot be read or written.
      ValueError: if it is not what was written.
    """
    found = {**scoring.read(folder), "name": text.plain(folder.resolve().name)}
    paths = [folder / f"{NAME}.html", folder / f"{NAME}.png"]
    files.write_atomically(paths[0], _html(found).encode())
    files.write_atomically(paths[1], plots.png(_page(found)))
    return paths


def _page(found: Mapping[str, Any]):
    """Draws the whole page."""
    told = "\n".join(textwrap.fill(text.plain(f"{name}: {value}"), 190) for name, value in facts(found).items())
    heights = [
        0.85,
        _height_of_overview(found),
        0.35 + _height_of_information(found),
        0.35 + 0.15 * (1 + told.count("\n")),
    ]
    with plots.style():
        figure = plots.empty(_WIDTH, sum(heights))
        head, overview, information, foot = figure.subfigures(4, 1, squeeze=False, height_ratios=heights).flat
        _draw_head(head, found)
        _draw_overview(overview, found)
        _draw_information(information, found)
        information.suptitle(_INFORMATION, fontsize=8.5, x=0.01, ha="left")
        foot.text(0.01, 0.95, plots.literal(told), fontsize=7, color="0.35", va="top", linespacing=1.4)
        return figure


def _draw_head(figure, found: Mapping[str, Any]) -> None:
    whole, subtitle = found["whole"], plots.literal("\n".join(_subtitle(found)))
    figure.text(0.01, 0.92, plots.literal(found["name"]), fontsize=17, weight="bold", va="top")
    figure.text(0.01, 0.42, subtitle, fontsize=8.5, color="0.3", va="top", linespacing=1.5)
    figure.text(
        0.99, 0.95, f"{whole['score']:.3f}", fontsize=27, weight="bold", ha="right", va="top", color=drawing.OURS
    )
    figure.text(0.99, 0.24, f"score, 95 % interval {_interval(whole)}", fontsize=8, ha="right", va="top", color="0.3")


def _height_of_axes(found: Mapping[str, Any]) -> float:
    num_rows = max(len(found["domains"]) + 1, len(found["tasks"]))
    return max(3.5 if drawing.has_skills(found) else 0.0, 0.95 + 0.24 * num_rows)


def _height_of_legend(found: Mapping[str, Any]) -> float:
    return 0.1 + 0.14 * -(-len(drawing.kinds_shown(found)) // 2)


def _height_of_overview(found: Mapping[str, Any]) -> float:
    return _height_of_axes(found) + _height_of_legend(found)


def _draw_overview(figure, found: Mapping[str, Any]) -> None:
    """Draws scores, mistakes and skills, side by side, and below them which mistakes there are."""
    heights = [_height_of_axes(found), _height_of_legend(found)]
    above, below = figure.subfigures(2, 1, height_ratios=heights)
    drawing.legend_of_mistakes(below, found, loc="upper left", ncols=2)
    widths = [1, 1, 1.1] if drawing.has_skills(found) else [1, 1]
    parts = above.subfigures(1, len(widths), squeeze=False, width_ratios=widths)[0]
    drawing.draw_scores(parts[0].subplots(), found)
    drawing.draw_mistakes(parts[1].subplots(), found)
    if drawing.has_skills(found):
        drawing.draw_skills(parts[2].subplots(subplot_kw={"projection": "polar"}), found)


def _height_of_information(found: Mapping[str, Any]) -> float:
    return 1.7 * -(-len(found["tasks"]) // _PANELS)


def _draw_information(figure, found: Mapping[str, Any]) -> None:
    count = len(found["tasks"])
    columns = min(_PANELS, max(4, count))
    panels = figure.subplots(-(-count // columns), columns, squeeze=False).flat
    for axes in panels[count:]:
        axes.set_axis_off()
    drawing.draw_information(panels[:count], found)
    panels[0].set_ylabel("bits")


_INFORMATION = (
    "Bits about the answer that the first interaction brought, the second, and so on, mean over all episodes; "
    "outline: the ideal"
)


def _subtitle(found: Mapping[str, Any]) -> list[str]:
    """Returns two lines: the meaning of the score, and the extent of the play."""
    asked, tasks = found["protocol"], len(found["tasks"])
    played = f"{asked['episodes']:,} episodes of {tasks} task{'s' if tasks > 1 else ''}, protocol {found['version']}"
    what = "Share of what the ideal experimenter earns beyond the best answer without an experiment"
    return [what, text.plain(played + ("" if found["complete"] else f"; not complete: {found['problem']}"))]


def _interval(row: Mapping[str, Any]) -> str:
    return " to ".join(f"{end:.3f}" for end in row["interval"])


def facts(found: Mapping[str, Any]) -> dict[str, str]:
    """Returns how an agent was made and how it was scored, in words, from the content of `score.json`."""
    agent, versions = found["agent"], found["versions"]
    is_trained = "seed" in agent or "agents" in agent  # The facts of any other are its owner's words.
    how = ["takes its likeliest actions" if found["greedy"] else "draws its actions"] if is_trained else []
    used = ", ".join(f"{name} {version}" for name, version in versions.items())
    return {
        "Target": found["target"].replace(",", ", "),
        "Agent": "; ".join([_made(agent), *how] if agent else ["it was trained by nobody, or nothing is said of it"]),
        **({"Trained by": agent["command"]} if agent.get("command") else {}),
        **{f"In {task}": _made(one) for task, one in agent.get("agents", {}).items() if task in found["tasks"]},
        "Scored": f"in {found['seconds']:,.0f} s, by commit {provenance.shortened(found['commit'])}, with {used}",
    }


def _made(agent: Mapping[str, Any]) -> str:
    """Returns how an agent was trained, as far as that is known."""
    words = {"seed": "seed {}", "frames": "{:,} frames", "seconds": "{:,.0f} s"}
    known = [text.format(agent[name]) for name, text in words.items() if agent.get(name) is not None]
    if agent.get("commit") is not None:
        known.append(f"commit {provenance.shortened(agent['commit'])}")
    return ", ".join(([agent["algorithm"]] if agent.get("algorithm") else []) + known)


def _html(found: Mapping[str, Any]) -> str:
    whole = found["whole"]
    head = (
        f"<header><div>{_tagged('h1', found['name'])}"
        f"<p>{'<br>'.join(map(text.escaped, _subtitle(found)))}</p></div>"
        f"<div class=score><b>{whole['score']:.3f}</b><br>score, 95 % interval {_interval(whole)}</div></header>"
    )
    parts = [
        head,
        _figure(found, _height_of_overview(found), _draw_overview, "Scores, mistakes and skills"),
        _table(found),
        f"<h2>What is found out</h2><p>{_INFORMATION}</p>",
        _figure(found, _height_of_information(found), _draw_information, "Bits from each interaction"),
        "<h2>How it was made</h2>",
        _rows([[_tagged("th", name), _tagged("td", value)] for name, value in facts(found).items()]),
    ]
    title = _tagged("title", f"physexp: score of {found['name']}")
    return f"<!doctype html><meta charset=utf-8>{title}<style>{_STYLE}</style>" + "\n".join(parts) + "\n"


def _figure(found: Mapping[str, Any], height: float, draw: Callable[[Any, Mapping[str, Any]], None], words: str) -> str:
    """Draws a part of the page."""
    with plots.style():
        figure = plots.empty(_WIDTH, height)
        draw(figure, found)
    content = base64.b64encode(plots.svg(figure)).decode()
    return f'<img alt="{words}" src="data:image/svg+xml;base64,{content}">'


def _table(found: Mapping[str, Any]) -> str:
    names = ("task", "score", "95 % interval", "right", "interactions", "the ideal's", "bits each", "the ideal's")
    rows = [[_tagged("th", name) for name in (*names, "lost most by")]]
    for name, task in found["tasks"].items():
        kind = max(task["mistakes"], key=task["mistakes"].__getitem__)
        cost = task["mistakes"][kind]
        cells = (
            name,
            f"{task['score']:.3f}",
            _interval(task),
            f"{task['success_rate']:.1%}",
            _number(task["mean_interactions"]),
            _number(task["ideal_interactions"]),
            _number(task["bits_per_interaction"]),
            _number(task["ideal_bits_per_interaction"]),
            f"{kind} {cost:.3f}" if cost > 0 else "nothing",
        )
        rows.append([_tagged("td", cell) for cell in cells])
    return _rows(rows)


def _number(value: float | None) -> str:
    return "" if value is None else f"{value:.2f}"


def _tagged(tag: str, words: str) -> str:
    return f"<{tag}>{text.escaped(words)}</{tag}>"


def _rows(rows: list[list[str]]) -> str:
    return "<table>" + "".join(f"<tr>{''.join(row)}</tr>" for row in rows) + "</table>"


_STYLE = """
body {font: 15px/1.5 system-ui, "DejaVu Sans", sans-serif; max-width: 70rem; margin: 2rem auto; padding: 0 1rem;
color: #222}
header {display: flex; justify-content: space-between; align-items: flex-start; gap: 2rem}
h1 {margin: 0; overflow-wrap: anywhere} header p {margin: .25rem 0; color: #555}
.score {text-align: right; color: #555; white-space: nowrap}
.score b {font-size: 2.8rem; line-height: 1; color: #0072b2}
img {width: 100%; height: auto; display: block; margin: 1rem 0}
table {border-collapse: collapse; font-size: 13px; margin: 1rem 0}
td, th {border-bottom: 1px solid #ccc; padding: .25rem .6rem; text-align: left; vertical-align: top}
"""
