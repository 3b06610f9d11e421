"""The fenced blocks of a page of documentation, and the output of running them."""

import contextlib
import io
from pathlib import Path
import re
from typing import NamedTuple

ROOT = Path(__file__).parent.parent


class Block(NamedTuple):
    """A block of code, and the output that the page shows right below it, or an empty text."""

    language: str
    code: str
    shown: str


def of(page: Path) -> list[Block]:
    """Returns the blocks of a page in their order, without outputs."""
    found = re.findall(r"^```(\w+)\n(.*?)^```\n(?:\n```text\n(.*?)^```)?", page.read_text(), re.DOTALL | re.MULTILINE)
    return [Block(*block) for block in found if block[0] != "text"]


def run(block: Block) -> str:
    """Runs a block of Python as a program; returns its output."""
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        exec(compile(block.code, "a block of the documentation", "exec"), {"__name__": "__main__"})
    return printed.getvalue()
