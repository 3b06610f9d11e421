"""The page to play on, beside the pages: the first instances of each task, and those that the leaderboard replays."""

import html
from pathlib import Path
import re
from urllib import parse

from physexp import suite
from physexp.analysis.play import exporting, page
from physexp.analysis.score import log, protocol

RESULTS = Path(__file__).parent.parent / "results"
NAME = "play.html"
_FIRST = 3  # Instances of each task.
_PLAYERS = {"ideal": "the ideal", "shipped": "our agent"}  # Whose moves are in logs, so nothing is solved here.


def replays() -> list[dict[str, str]]:
    """Returns what the links of the leaderboard ask for: task, episode and actions."""
    links = re.findall(rf"{re.escape(NAME)}\?([^)]*)\)", (RESULTS / "leaderboard.md").read_text())
    return [dict(parse.parse_qsl(html.unescape(link))) for link in links]


def tasks() -> dict[str, exporting.Data]:
    """Returns the tasks as data, by the names of their files, with the moves of the ideal and of our agent."""
    usual = protocol.named(["/".join(names) for names in suite.tagged("features")])
    wanted = {question: set(range(_FIRST)) for question in usual}
    for replay in replays():
        (question,) = protocol.named([replay["task"]])
        wanted.setdefault(question, set()).add(int(replay["episode"]))
    logs = {name: log.read(RESULTS / "scores" / folder) for folder, name in _PLAYERS.items()}
    found = {}
    for question, numbers in wanted.items():
        found[question.file_name] = data = exporting.export(question, sorted(numbers))
        played = {name: log.of_task(logged, question) for name, logged in logs.items()}
        for instance in data["instances"]:
            moves = {name: its["action"][its["episode"] == instance["episode"]] for name, its in played.items()}
            instance["others"] = {name: taken.tolist() for name, taken in moves.items() if len(taken)}
    return found


def write(app, exception: Exception | None) -> None:
    """Writes the page, one file that needs no server, into the folder of a finished build."""
    if exception is None and app.builder.format == "html":
        page.write_single(Path(app.outdir) / NAME, tasks())


def setup(app) -> dict:
    """Connects to the end of a build."""
    app.connect("build-finished", write)
    return {"parallel_read_safe": True}
