"""The page: writes it as files that any host serves or as one file, and serves it on this machine."""

import base64
from collections.abc import Callable, Sequence
import contextlib
import functools
import html
import http.server
import json
from pathlib import Path
import shutil
import sys
import threading
from typing import IO, Any
import webbrowser

from physexp import suite
from physexp.analysis.data import episodes
from physexp.analysis.ideal import mistakes
from physexp.analysis.play import exporting, others
from physexp.analysis.score import protocol
from physexp.analysis.score import records as records_lib
from physexp.analysis.training import callbacks

SITE = Path(__file__).parent / "site"
"""The built page; its sources are in `page/` of a checkout."""

PROGRAM = "mujoco.wasm.gz"
INSTANCES, MOST_INSTANCES = 20, 1000  # Of each task.
_NAMES = {others.IDEAL: "the ideal", others.TRAINED: "our agent"}
_LOOPBACK = "127.0.0.1"
_RECORDS, _MISTAKES = "records", "mistakes"
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
    """Serves the page, appends the records that it sends to a file, and judges them."""

    def __init__(
        self,
        *args: Any,
        tasks: dict[str, str],
        takers: dict[str, Callable[[bytes], str]],
        tell: callbacks.Tell,
        **kw: Any,
    ):
        self._tasks, self._takers, self._tell = tasks, takers, tell
        super().__init__(*args, directory=str(SITE), **kw)

    def do_GET(self) -> None:
        name = self.path.partition("?")[0].lstrip("/")
        if name in ("", "index.html"):
            metas = "".join(f'<meta name="{taker}" content="{taker}">' for taker in self._takers)
            self._send((SITE / "index.html").read_text().replace("<title>", f"{metas}<title>"), "text/html")
        elif name.removesuffix(".json") in self._tasks:
            self._send(self._tasks[name.removesuffix(".json")], "application/json")
        else:
            super().do_GET()

    def do_POST(self) -> None:
        size, taker = int(self.headers.get("Content-Length", 0)), self._takers.get(self.path.lstrip("/"))
        # Another page that is open in the browser may not write here.
        is_own = self.headers.get("Origin") == f"http://{self.headers.get('Host', '')}"
        if taker is None or size > _LARGEST_RECORD or not is_own:
            self.send_error(http.HTTPStatus.FORBIDDEN)
            return
        try:
            self._send(taker(self.rfile.read(size)), "application/json")
        except ValueError as error:
            self._tell(f"refused: {error}")
            self._send(str(error), "text/plain", http.HTTPStatus.BAD_REQUEST)

    def _send(self, text: str, kind: str, status: http.HTTPStatus = http.HTTPStatus.OK) -> None:
        content = text.encode()
        self.send_response(status)
        self.send_header("Content-Type", f"{kind}; charset=utf-8")
        self.send_header("Content-Length", str(len(content)))
        self.end_headers()
        self.wfile.write(content)

    def log_message(self, *args: Any) -> None:
        """Writes nothing."""


class _Server(http.server.ThreadingHTTPServer):
    """Prints an error of a request, unless the page was closed or no longer waits for the answer."""

    def handle_error(self, request: Any, client_address: Any) -> None:
        if not isinstance(sys.exception(), ConnectionError):
            super().handle_error(request, client_address)


def _parse(content: bytes) -> records_lib.Record:
    return records_lib.parse("a record of the page", content)


def _keep(file: IO[str], content: bytes) -> str:
    """Appends a record to a file; raises ValueError if it is none."""
    _parse(content)
    file.write(f"{json.dumps(json.loads(content))}\n")
    file.flush()
    return ""


def _judge(lock: threading.Lock, content: bytes) -> str:
    """Returns the mistakes in a record, as JSON; raises ValueError if it is none, or cannot be played again."""
    record = _parse(content)
    with lock:  # Judgements share tables.
        columns = records_lib.judged(record)
    costs = columns["regret"] * record.question.discount ** columns["step"]
    found = [
        {"step": step, "kind": kind, "meaning": mistakes.KINDS[kind], "cost": cost}
        for step, (kind, cost) in enumerate(zip(columns["mistake"], costs.tolist(), strict=True))
        if kind
    ]
    return json.dumps(found)


def server(
    tasks: dict[str, exporting.Data], records: IO[str] | None, tell: callbacks.Tell = callbacks.ignore
) -> http.server.ThreadingHTTPServer:
    """Returns a server of the page for this machine alone, which writes records into an open file if there is one.

    It judges records, too, if it can judge all tasks. `tell` is called with a line for each record that is refused.
    """
    takers: dict[str, Callable[[bytes], str]] = {}
    if records is not None:
        takers[_RECORDS] = functools.partial(_keep, records)
    if all(map(protocol.is_judged, protocol.named([task["name"] for task in tasks.values()]))):
        takers[_MISTAKES] = functools.partial(_judge, threading.Lock())
    handler = functools.partial(_Handler, tasks=_contents(tasks), takers=takers, tell=tell)
    return _Server((_LOOPBACK, 0), handler)


def serve(tasks: dict[str, exporting.Data], records: Path | None, tell: callbacks.Tell) -> None:
    """Serves the page, opens it in the browser, and appends records to a file if there is one, until interrupted."""
    opened = contextlib.nullcontext() if records is None else records.open("a", encoding="utf-8")
    with opened as file, server(tasks, file, tell) as service:
        address = f"http://{_LOOPBACK}:{service.server_port}/"
        tell(f"serving {address} to this machine alone; Ctrl-C ends it")
        webbrowser.open(address)
        service.serve_forever()
