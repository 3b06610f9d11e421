"""Waiting for states, in tests; imports nothing that takes time."""

import time


def wait_until(condition, seconds, what):
    """Waits for something to come true, or fails."""
    deadline = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < deadline, f"not within {seconds} s: {what}"
        time.sleep(0.02)
