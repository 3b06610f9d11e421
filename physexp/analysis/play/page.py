"""The page: writes it as files that any host serves or as one file, and serves it on this machine."""

import base64
from collections.abc import Sequence
import contextlib
import functools
import html
import http.server
import json
from pathlib import Path
import shutil
from typing import IO, Any
import webbrowser

from physexp import suite
from physexp.analysis.data import episodes
from physexp.analysis.play import exporting, others
from physexp.analysis.score import protocol
from physexp.analysis.training import callbacks

SITE = Path(__file__).parent / "site"
"""The built page; its sources are in `page/` of a checkout."""

PROGRAM = "mujoco.wasm.gz"
INSTANCES, MOST_INSTANCES = 20, 1000  # Of each task.
_NAMES = {others.IDEAL: "the ideal", others.TRAINED: "our agent"}
_LOOPBACK = "127.0.0.1"
_RECORDS = "records"
_LARGEST_RECORD = 1_000_000  # Bytes.


def prepare(
    questions: Sequence[protocol.Question],
    numbers: Sequence[int] = range(INSTANCES),
    seed: int = protocol.ENVIRONMENT_SEED,
    tell: callbacks.Tell = callbacks.ignore,
) -> dict[str, exporting.Data]:
    """Returns tasks as data by the names of their files, with the moves of the other players on each instance.

    Their instances are those of the episodes with these numbers. Raises ValueError as `exporting.export`. `tell` is
    called with a line for each task.
    """
    found = {}
    for question in questions:
        data = exporting.export(question, numbers, seed)
        played = _played(question, numbers, seed)
        for index, instance in enumerate(data["instances"]):
            instance["others"] = {name: moves[index] for name, moves in played.items()}
        found[question.file_name] = data
        tell(question.name)
    return found


def _played(question: protocol.Question, numbers: Sequence[int], seed: int) -> dict[str, list[list[int]]]:
    """Returns the actions of the other players in some episodes."""
    found = {}
    players = others.players(question.domain, question.task, dict(question.options))
    with contextlib.closing(
        suite.load(question.domain, question.task, {**question.options, "random": seed})
    ) as environment:
        for name in sorted(players, key=list(_NAMES).index):
            loop = [episodes.play(environment, players[name], number) for number in numbers]
            found[_NAMES[name]] = [episode.actions.tolist() for episode in loop]
    return found


def write(folder: Path, tasks: dict[str, exporting.Data]) -> Path:
    """Writes the page into a folder, which it makes; returns the path to open. It needs a server."""
    folder.mkdir(parents=True, exist_ok=True)
    for path in SITE.glob("*.*"):
        shutil.copyfile(path, folder / path.name)
    for name, content in _contents(tasks).items():
        (folder / f"{name}.json").write_text(content, encoding="utf-8")
    return folder / "index.html"


def write_single(path: Path, tasks: dict[str, exporting.Data]) -> Path:
    """Writes the page as one file that a browser opens without a server; returns its path."""
    page = (SITE / "index.html").read_text()
    style, script = (SITE / "style.css").read_text(), (SITE / "main.js").read_text()
    program = base64.b64encode((SITE / PROGRAM).read_bytes()).decode()
    texts = {"program": program, **_contents(tasks)}
    data = "".join(
        f'<script type="application/json" id="{html.escape(name)}">{_inline(text)}</script>\n'
        for name, text in texts.items()
    )
    page = page.replace('<link rel="stylesheet" href="style.css">', f"<style>{style}</style>")
    page = page.replace(
        '<script type="module" src="main.js"></script>', f'{data}<script type="module">{_inline(script)}</script>'
    )
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(page, encoding="utf-8")
    return path


def _contents(tasks: dict[str, exporting.Data]) -> dict[str, str]:
    listed = [{"file": name, "name": task["name"], "question": task["question"]} for name, task in tasks.items()]
    return {
        "tasks": json.dumps(listed),
        **{name: json.dumps(task, separators=(",", ":")) for name, task in tasks.items()},
    }


def _inline(text: str) -> str:
    """Returns JSON or JavaScript that does not end the element that it is in."""
    return text.replace("</", "<\\/").replace("<!--", "<\\!--")


class _Handler(http.server.SimpleHTTPRequestHandler):
    """Serves the page, and appends the records that it sends to a file."""

    def __init__(self, *args: Any, tasks: dict[str, str], records: IO[str] | None, **kwargs: Any):
        self._tasks, self._records = tasks, records
        super().__init__(*args, directory=str(SITE), **kwargs)

    def do_GET(self) -> None:
        name = self.path.partition("?")[0].lstrip("/")
        if name in ("", "index.html"):
            page, meta = (SITE / "index.html").read_text(), f'<meta name="records" content="{_RECORDS}">'
            self._send(page.replace("<title>", f"{meta}<title>") if self._records else page, "text/html")
        elif name.removesuffix(".json") in self._tasks:
            self._send(self._tasks[name.removesuffix(".json")], "application/json")
        else:
            super().do_GET()

    def do_POST(self) -> None:
        size = int(self.headers.get("Content-Length", 0))
        # Another page that is open in the browser may not write here.
        host = self.headers.get("Host", "")
        if (
            self._records is None
            or self.path != f"/{_RECORDS}"
            or size > _LARGEST_RECORD
            or self.headers.get("Origin") != f"http://{host}"
        ):
            self.send_error(http.HTTPStatus.FORBIDDEN)
            return
        line = json.dumps(json.loads(self.rfile.read(size)))
        self._records.write(f"{line}\n")
        self._records.flush()
        self._send("", "text/plain")

    def _send(self, text: str, kind: str) -> None:
        content = text.encode()
        self.send_response(http.HTTPStatus.OK)
        self.send_header("Content-Type", f"{kind}; charset=utf-8")
        self.send_header("Content-Length", str(len(content)))
        self.end_headers()
        self.wfile.write(content)

    def log_message(self, *args: Any) -> None:
        """Writes nothing."""


def server(tasks: dict[str, exporting.Data], records: IO[str] | None) -> http.server.ThreadingHTTPServer:
    """Returns a server of the page for this machine alone, which writes records into an open file if there is one."""
    handler = functools.partial(_Handler, tasks=_contents(tasks), records=records)
    return http.server.ThreadingHTTPServer((_LOOPBACK, 0), handler)


def serve(tasks: dict[str, exporting.Data], records: Path | None, tell: callbacks.Tell) -> None:
    """Serves the page, opens it in the browser, and appends records to a file if there is one, until interrupted."""
    opened = contextlib.nullcontext() if records is None else records.open("a", encoding="utf-8")
    with opened as file, server(tasks, file) as service:
        address = f"http://{_LOOPBACK}:{service.server_port}/"
        tell(f"serving {address} to this machine alone; Ctrl-C ends it")
        webbrowser.open(address)
        service.serve_forever()
