"""Opens rerun's viewer on the loopback alone, since it has no password."""

from collections.abc import Callable
import contextlib
import os
from pathlib import Path
import socket
import subprocess
import sys
import urllib.parse

import rerun as rr
import rerun.blueprint as rrb
import rerun_cli

PROGRAM = Path(rerun_cli.__file__).with_name("rerun")
"""Rerun's program: its viewer and its tools for files."""

_LOOPBACK = "127.0.0.1"
_DATA_PORT, _WEB_PORT = 9876, 9090  # Rerun's defaults, so that tunnels from other machines can name them.


def check_display() -> None:
    """Raises ValueError where there is no display to open a window on."""
    if sys.platform == "linux" and not (os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")):
        raise ValueError("there is no display to open the viewer on (DISPLAY is not set); leave out --view")


def view(path: Path, web: bool, tell: Callable[[str], None] = lambda line: None) -> None:
    """Opens a file in a window, or on the web for a browser, until the viewer is closed or Ctrl-C ends it.

    Raises RuntimeError if the viewer fails, ValueError if there is no display for a window.
    """
    data_port = _free_port(_DATA_PORT if web else 0)
    command = [*_command(data_port), str(path)]
    if web:
        web_port = _free_port(_WEB_PORT)
        command += ["--web-viewer", "--web-viewer-port", str(web_port)]
        query = urllib.parse.urlencode({"url": f"rerun+http://{_LOOPBACK}:{data_port}/proxy"})
        tell(f"serving http://{_LOOPBACK}:{web_port}/?{query} to this machine alone; Ctrl-C ends it")
    else:
        check_display()
    with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE) as process:
        try:
            _, messages = process.communicate()
        except KeyboardInterrupt:
            process.terminate()
            return
    if process.returncode:
        raise RuntimeError(f"rerun's viewer failed: {last_line(messages)}")


class Viewer:
    """A window that shows streams and stays open when this process ends.

    The viewer reads streams from a pipe, since a stream over the network can wait for a closed viewer for ever.
    """

    def __init__(self):
        """Prepares a window, which opens with the first stream; raises ValueError without a display."""
        check_display()
        self._process: subprocess.Popen | None = None

    def show(self, stream: rr.RecordingStream, layout: rrb.Blueprint) -> None:
        """Connects a stream to the window."""
        if self._process is None or self._process.poll() is not None:
            self._process = subprocess.Popen(
                [*_command(_free_port()), "-", "--hide-welcome-screen", "--expect-data-soon"],
                bufsize=0,  # A closed window leaves nothing to be written.
                stdin=subprocess.PIPE,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.DEVNULL,
                start_new_session=True,
            )
        self._written = rr.binary_stream(stream)
        stream.send_blueprint(layout)

    def flush(self, stream: rr.RecordingStream) -> None:
        """Sends the data of a stream, unless the window has been closed."""
        assert self._process is not None and self._process.stdin is not None
        content = memoryview(self._written.read() or b"")
        with contextlib.suppress(BrokenPipeError):
            while content:
                content = content[self._process.stdin.write(content) :]


def last_line(messages: bytes) -> str:
    """Returns the last line of a program's messages."""
    lines = [line for line in messages.decode(errors="replace").splitlines() if line.strip()]
    return lines[-1] if lines else "it gives no reason"


def _command(data_port: int) -> list[str]:
    return [str(PROGRAM), "--bind", _LOOPBACK, "--port", str(data_port)]


def _free_port(preferred: int = 0) -> int:
    """Returns a free port of the loopback, since a viewer hands its data to another viewer on its port, and ends."""
    with socket.socket() as candidate:
        candidate.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            candidate.bind((_LOOPBACK, preferred))
        except OSError:
            candidate.bind((_LOOPBACK, 0))
        return candidate.getsockname()[1]
