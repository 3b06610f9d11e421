"""A screen on which nobody looks, for programs that open windows."""

from collections.abc import Iterator
import contextlib
import os
import shutil
import subprocess

import pytest

needs_screen = pytest.mark.skipif(
    shutil.which("Xvfb") is None, reason="needs Xvfb: apt-get install xvfb mesa-vulkan-drivers"
)


@contextlib.contextmanager
def screen(size: str = "1280x1024x24") -> Iterator[str]:
    """Starts an X server, which takes a number that no other has; yields its DISPLAY."""
    reader, writer = os.pipe()
    command = ["Xvfb", "-displayfd", str(writer), "-screen", "0", size, "-nolisten", "tcp"]
    with (
        os.fdopen(reader) as numbers,
        subprocess.Popen(command, pass_fds=[writer], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as server,
    ):
        os.close(writer)
        try:
            number = numbers.readline().strip()
            assert number, f"Xvfb ended with status {server.wait()}"
            yield f":{number}"
        finally:
            server.kill()
