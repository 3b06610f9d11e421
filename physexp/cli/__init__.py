"""The command line."""

from physexp.cli.parsing import main

__all__ = ["main"]
