"""Callbacks of long work, which show its progress: `tell` takes a line of text, `report` a row of metrics."""

from collections.abc import Callable
import contextlib
from typing import Any

Tell = Callable[[str], None]
Report = Callable[[dict[str, Any]], None]


def ignore(_: Any) -> None:
    """Does nothing with a line or a row."""


def expendable(watch: Callable[..., Any], tell: Tell, name: str) -> Callable[..., None]:
    """Returns a watcher that work does not depend on: when it fails, a line tells so, and it is called no more.

    Args:
      watch: the watcher.
      tell: called with the line.
      name: the watcher's, for the line.
    """
    has_failed = False

    def call(*arguments: Any) -> None:
        nonlocal has_failed
        if has_failed:
            return
        try:
            watch(*arguments)
        except Exception as error:
            has_failed = True
            with contextlib.suppress(Exception):  # The line, too, may have nowhere to go.
                said = " ".join(str(error).split()) or type(error).__name__
                tell(f"{name} failed and is left out from now on: {said}")

    return call
