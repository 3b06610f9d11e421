"""Virtual screens for programs that open windows, and photographs of pages in a browser."""

from collections.abc import Iterator
import contextlib
import os
from pathlib import Path
import shutil
import subprocess

import numpy as np
from PIL import Image
import pytest
import waiting

needs_screen = pytest.mark.skipif(
    shutil.which("Xvfb") is None, reason="needs Xvfb: apt-get install xvfb mesa-vulkan-drivers"
)
needs_browser = pytest.mark.skipif(shutil.which("chromium") is None, reason="needs chromium: apt-get install chromium")


@contextlib.contextmanager
def screen(size: str = "1280x1024x24") -> Iterator[str]:
    """Starts an X server with a free number; yields its DISPLAY."""
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


def photographed(page: Path, scratch: Path, width: int = 1200, height: int = 2400) -> np.ndarray:
    """Returns a photograph of a page in a browser, uint8 [height, width, 3]."""
    photograph = scratch / "photograph.png"
    confined = ["--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--no-first-run"]
    files = [f"--user-data-dir={scratch / 'profile'}", f"--screenshot={photograph}"]
    waiting.run(["chromium", *confined, *files, f"--window-size={width},{height}", page.as_uri()])
    with Image.open(photograph) as image:
        return np.asarray(image.convert("RGB"))
