"""Callbacks that show the progress of long work: `tell` takes a line of text, `report` a row of metrics."""

from collections.abc import Callable
import contextlib
from typing import Any

Tell = Callable[[str], None]
Report = Callable[[dict[str, Any]], None]


def ignore(*_: Any) -> None:
    """Does nothing."""


def expendable(watch: Callable[..., Any], tell: Tell, name: str) -> Callable[..., None]:
    """Returns a watcher that is left out after its first failure, with a line that names it."""
    has_failed = False

    def call(*arguments: Any) -> None:
        nonlocal has_failed
        if has_failed:
            return
        try:
            watch(*arguments)
        except Exception as error:
            has_failed = True
            with contextlib.suppress(Exception):  # Printing may fail, too.
                reason = " ".join(str(error).split()) or type(error).__name__
                tell(f"{name} failed and is left out from now on: {reason}")

    return call
