"""The directive `command-line`: the help of every command, as it is when the pages are built."""

import contextlib
import io
import os
from unittest import mock

from docutils import nodes
from sphinx.util.docutils import SphinxDirective

from physexp import cli, suite
from physexp.analysis.training import config
from physexp.cli import commands

WIDTH = 88  # Columns; more would not fit on a page.
_VARIANTS = {
    "train": [["--agent", algorithm] for algorithm in config.ALGORITHMS],
    "play": [[], *([domain] for domain in suite.TASKS_BY_DOMAIN)],
}
"""Commands whose options depend on their arguments."""


def help_of(*arguments: str) -> str:
    """Returns the output of `physexp ARGUMENTS --help`."""
    printed = io.StringIO()
    with (
        mock.patch("sys.argv", ["physexp", *arguments, "--help"]),
        mock.patch.dict(os.environ, {"COLUMNS": str(WIDTH), "NO_COLOR": "1"}),
        contextlib.redirect_stdout(printed),
        contextlib.suppress(SystemExit),
    ):
        cli.main()
    return printed.getvalue()


class CommandLine(SphinxDirective):
    """A section for each command with its help."""

    def run(self) -> list[nodes.Node]:
        sections = []
        for command in commands.COMMANDS:
            section = nodes.section(ids=[f"physexp-{command}"])
            section += nodes.title(text=f"physexp {command}")
            for arguments in _VARIANTS.get(command, [[]]):
                text = help_of(command, *arguments)
                section += nodes.literal_block(text, text, language="text")
            sections.append(section)
        return sections


def setup(app) -> dict:
    """Adds the directive."""
    app.add_directive("command-line", CommandLine)
    return {"parallel_read_safe": True}
