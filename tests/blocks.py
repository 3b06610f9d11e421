"""The fenced blocks of a page of documentation, and what running them prints."""

import contextlib
import io
from pathlib import Path
import re
from typing import NamedTuple

ROOT = Path(__file__).parent.parent


class Block(NamedTuple):
    """A block of code, and the output that the page shows right below it; empty where it shows none."""

    language: str
    code: str
    shown: str


def of(page: Path) -> list[Block]:
    """Returns the blocks of a page in their order, without those that are outputs."""
    found = re.findall(r"^```(\w+)\n(.*?)^```\n(?:\n```text\n(.*?)^```)?", page.read_text(), re.DOTALL | re.MULTILINE)
    return [Block(*block) for block in found if block[0] != "text"]


def run(block: Block) -> str:
    """Runs a block of Python as a program of its own would; returns what it printed."""
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        exec(compile(block.code, "a block of the documentation", "exec"), {"__name__": "__main__"})
    return printed.getvalue()
