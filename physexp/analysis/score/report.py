"""Writes the report of a score: a figure, and a page with the figure, a table and the facts, in one file."""

import base64
from collections.abc import Mapping
from pathlib import Path
from typing import Any

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
    paths = [folder / f"{NAME}.html", folder / f"{NAME}.png"]
    files.write_atomically(paths[0], _page(folder.resolve().name, found, figure).encode())
    files.write_atomically(paths[1], figure)
    return paths


def _page(name: str, found: Mapping[str, Any], figure: bytes) -> str:
    import jinja2

    environment = jinja2.Environment(
        loader=jinja2.PackageLoader("physexp.analysis.score", ""),
        autoescape=True,
        finalize=lambda value: text.plain(value) if isinstance(value, str) else value,
        undefined=jinja2.StrictUndefined,
    )
    return environment.get_template("report.html").render(
        name=name,
        found=found,
        facts=facts(found),
        costliest=_costliest,
        image=base64.b64encode(figure).decode(),
    )


def _costliest(costs: Mapping[str, float]) -> str:
    kind = max(costs, key=lambda one: costs[one])
    return f"{kind} {costs[kind]:.3f}" if costs[kind] > 0 else "nothing"


def facts(found: Mapping[str, Any]) -> dict[str, str]:
    """Returns how an agent was made and how it was scored, in words, from the content of `score.json`."""
    agent, versions = found["agent"], found["versions"]
    is_trained = "seed" in agent or "agents" in agent  # The facts of any other are its owner's words.
    how = ["takes its likeliest actions" if found["greedy"] else "draws its actions"] if is_trained else []
    used = ", ".join(f"{name} {version}" for name, version in versions.items())
    return {
        "Target": found["target"].replace(",", ", "),
        "Agent": "; ".join([_made(agent), *how]) if agent else "not trained, or nothing is known of its training",
        **({"Trained by": agent["command"]} if agent.get("command") else {}),
        **{f"In {task}": _made(one) for task, one in agent.get("agents", {}).items() if task in found["tasks"]},
        "Scored": f"in {found['seconds']:,.0f} s, by commit {provenance.shortened(found['commit'])}, with {used}",
    }


def _made(agent: Mapping[str, Any]) -> str:
    """Returns how an agent was trained, as far as that is known."""
    formats = {"seed": "seed {}", "frames": "{:,} frames", "seconds": "{:,.0f} s"}
    known = [form.format(agent[name]) for name, form in formats.items() if agent.get(name) is not None]
    if agent.get("commit") is not None:
        known.append(f"commit {provenance.shortened(agent['commit'])}")
    return ", ".join(([agent["algorithm"]] if agent.get("algorithm") else []) + known)
