"""The command line."""

from collections.abc import Sequence
import os
import sys

from physexp import __version__, extras
from physexp.analysis.training import stopping
from physexp.cli import parsing, printing

__all__ = ["main"]


def main() -> None:
    """Runs the command that was typed; this is the entry point.

    An error of the user's is one line and exit status 2; Ctrl-C, SIGTERM and SIGHUP are 128 and the signal's number.
    """
    printing.prepare()
    try:
        try:
            run(sys.argv[1:])
        finally:
            sys.stdout.flush()
    except KeyboardInterrupt as error:
        printing.warn("physexp: interrupted")
        sys.exit(stopping.exit_status(error))
    except BrokenPipeError:  # The reader of the output, `head` for example, has seen enough.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        sys.exit(1)


def run(arguments: Sequence[str]) -> None:
    """Runs the command that some arguments describe, and exits with status 2 or 1 if it fails."""
    if arguments == ["--version"]:
        printing.tell(f"physexp {__version__}")
        return
    try:
        with stopping.raised():
            parsing.parse(arguments).run()
    except BrokenPipeError:
        raise
    except (ValueError, OSError, extras.MissingExtraError) as error:
        printing.warn(f"physexp: {error}")
        sys.exit(2)
    except RuntimeError as error:
        printing.warn(f"physexp: {error}")
        sys.exit(1)
