"""What long work calls to say how it goes: `tell` with a line of text, `report` with a row of metrics."""

from collections.abc import Callable
from typing import Any

Tell = Callable[[str], None]
Report = Callable[[dict[str, Any]], None]


def ignore(_: Any) -> None:
    """Does nothing with a line or a row."""
