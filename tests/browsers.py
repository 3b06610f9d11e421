"""Chromium without a window, steered over a pipe by its DevTools protocol."""

import base64
from collections.abc import Iterator
import contextlib
import http.server
import itertools
import json
import os
from pathlib import Path
import signal
import subprocess
import threading
from typing import Any

import waiting

# Software draws WebGL, the same on every machine.
_ARGUMENTS = [
    "--headless", "--no-sandbox", "--disable-dev-shm-usage", "--no-first-run", "--disable-extensions",
    "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--remote-debugging-pipe",
]  # fmt: skip


class Tab:
    """A tab of a browser.

    Attributes:
      requests: addresses that pages have asked for.
      errors: errors that pages have not caught.
    """

    def __init__(self, reader: int, writer: int, process: subprocess.Popen):
        self._reader, self._writer, self._process = reader, writer, process
        self._numbers, self._rest, self._session = itertools.count(1), b"", ""
        self.requests: list[str] = []
        self.errors: list[str] = []
        target = self._call("Target.createTarget", url="about:blank")["targetId"]
        self._session = self._call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ("Runtime", "Network", "Page"):
            self._call(f"{domain}.enable")

    def open(self, address: str, width: int = 1180, height: int = 720) -> None:
        """Begins to open an address in a window of a size."""
        self._call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False)
        self._call("Page.navigate", url=address)

    def evaluate(self, script: str) -> Any:
        """Returns the value of an expression in JavaScript, of a promise when it is kept."""
        found = self._call("Runtime.evaluate", expression=script, awaitPromise=True, returnByValue=True)
        assert "exceptionDetails" not in found, found["exceptionDetails"]["exception"].get("description", found)
        return found["result"].get("value")

    def wait(self, condition: str) -> Any:
        """Waits until an expression is true; returns its value."""
        return waiting.wait_until(lambda: self.evaluate(condition), condition, pid=self._process.pid)

    def click(self, selector: str) -> None:
        """Clicks on the middle of an element as a mouse does."""
        x, y = self.evaluate(
            f"(() => {{ const e = document.querySelector({json.dumps(selector)});"
            " e.scrollIntoView({block: 'nearest'});"
            " const b = e.getBoundingClientRect(); return [b.x + b.width / 2, b.y + b.height / 2]; })()"
        )
        self.click_at(x, y)

    def click_at(self, x: float, y: float) -> None:
        """Clicks on a place of the window, in pixels."""
        for kind in ("mousePressed", "mouseReleased"):
            self._call("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left", clickCount=1)

    def press(self, key: str) -> None:
        """Presses a key that writes a letter."""
        self._call("Input.dispatchKeyEvent", type="keyDown", key=key, text=key)
        self._call("Input.dispatchKeyEvent", type="keyUp", key=key)

    def photograph(self, path: Path) -> None:
        """Writes a picture of the window."""
        path.write_bytes(base64.b64decode(self._call("Page.captureScreenshot", format="png")["data"]))

    def _call(self, method: str, **parameters: Any) -> dict[str, Any]:
        number = next(self._numbers)
        asked = {"id": number, "method": method, "params": parameters}
        if self._session:
            asked["sessionId"] = self._session
        sent = json.dumps(asked).encode() + b"\0"
        while sent:
            sent = sent[os.write(self._writer, sent) :]
        for message in self._messages():
            if message.get("id") == number:
                assert "error" not in message, message
                return message["result"]
            if message.get("method") == "Network.requestWillBeSent":
                self.requests.append(message["params"]["request"]["url"])
            elif message.get("method") == "Runtime.exceptionThrown":
                self.errors.append(message["params"]["exceptionDetails"]["exception"].get("description", ""))
        raise AssertionError(f"chromium ended before it answered {method}")

    def _messages(self) -> Iterator[dict[str, Any]]:
        while True:
            message, is_whole, rest = self._rest.partition(b"\0")
            if is_whole:
                self._rest = rest
                yield json.loads(message)
            elif read := os.read(self._reader, 1 << 16):
                self._rest += read
            else:
                return


@contextlib.contextmanager
def serving(server: http.server.HTTPServer) -> Iterator[str]:
    """Serves in a thread; yields the address."""
    with server:
        thread = threading.Thread(target=server.serve_forever)
        thread.start()
        try:
            yield f"http://127.0.0.1:{server.server_port}"
        finally:
            server.shutdown()
            thread.join()


@contextlib.contextmanager
def tab(profile: Path) -> Iterator[Tab]:
    """Starts a browser with a folder for its profile; yields a tab."""
    (their_reader, writer), (reader, their_writer) = os.pipe(), os.pipe()

    def give() -> None:  # It reads from 3 and writes to 4.
        given = os.dup(their_reader), os.dup(their_writer)
        for number, each in enumerate(given, 3):
            os.dup2(each, number)

    process = subprocess.Popen(
        ["chromium", *_ARGUMENTS, f"--user-data-dir={profile}"],
        close_fds=False,
        preexec_fn=give,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,
    )
    for number in (their_reader, their_writer):
        os.close(number)
    try:
        yield Tab(reader, writer, process)
    finally:
        for number in (reader, writer):
            os.close(number)
        os.killpg(process.pid, signal.SIGKILL)
        process.wait()
