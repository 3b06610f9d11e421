"""Prints the output of commands: figures, tables and lines, for people or as JSON.

All text of a command passes through here, since it may come from the files of strangers: their control characters and
escape sequences reach no terminal.
"""

from collections.abc import Iterator
import contextlib
import io
import json
import os
import sys
import threading

from physexp.analysis.data import text

_PATIENCE = 2.0  # Seconds after which people wonder whether anything happens.


def prepare() -> None:
    """Prepares the standard streams.

    A closed stream is replaced by /dev/null, so that the work is done and no file that is opened later takes its
    number. Letters that standard output cannot encode, as in a Latin-1 terminal, are replaced.
    """
    for name, mode in (("stdin", "r"), ("stdout", "w"), ("stderr", "w")):
        if getattr(sys, name) is None:
            null = os.open(os.devnull, os.O_RDWR)
            os.set_inheritable(null, True)
            setattr(sys, name, os.fdopen(null, mode, encoding="utf-8"))
    if isinstance(sys.stdout, io.TextIOWrapper):  # Other streams, of a caller from Python, take any letter.
        sys.stdout.reconfigure(errors="replace")


def warn(*lines: str) -> None:
    """Prints lines to standard error."""
    print(*map(text.plain, lines), sep="\n", file=sys.stderr, flush=True)


@contextlib.contextmanager
def waiting(line: str) -> Iterator[None]:
    """Returns a context that shows a line on standard error: with a spinner on a terminal, elsewhere if it is slow."""
    if sys.stderr.isatty():
        from rich import console

        with console.Console(stderr=True, markup=False).status(text.plain(line)):
            yield
        return
    timer = threading.Timer(_PATIENCE, warn, [f"{line}; that can take minutes"])
    timer.start()
    try:
        yield
    finally:
        timer.cancel()


def tell(*lines: str) -> None:
    """Prints lines to standard output at once."""
    print(*map(text.plain, lines), sep="\n", flush=True)


def show(found: dict | list[dict], as_json: bool = False) -> None:
    """Prints figures by name, or rows with the same columns, a line each."""
    if as_json:
        print(json.dumps(found, indent=1))
    elif isinstance(found, dict):
        _print_table([{"": name, " ": value} for name, value in found.items()], show_header=False)
    else:
        _print_table(found, show_header=True)


def _print_table(rows: list[dict], show_header: bool) -> None:
    """Prints rows as a table; elsewhere than on a terminal, a row is a line however long it is."""
    from rich import console, table

    grid = table.Table(box=None, show_header=show_header, header_style="bold", pad_edge=False, padding=(0, 2, 0, 0))
    for name in rows[0]:
        grid.add_column(text.plain(name), overflow="fold")
    for row in rows:
        grid.add_row(*map(_text, row.values()))
    terminal = console.Console(markup=False, highlight=False)
    if terminal.is_terminal:
        terminal.print(grid)
        return
    endless = console.Console(markup=False, highlight=False, width=1_000_000)
    with endless.capture() as captured:
        endless.print(grid)
    print("\n".join(line.rstrip() for line in captured.get().splitlines()))


def _text(value) -> str:
    if isinstance(value, float):
        return f"{value:.4f}"
    if isinstance(value, dict):
        return "  ".join(f"{text.plain(str(key))}: {_text(item)}" for key, item in value.items())
    if isinstance(value, (list, tuple)):
        return " to ".join(_text(item) for item in value)
    return text.plain(str(value))
