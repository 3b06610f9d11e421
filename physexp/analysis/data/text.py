"""Text from others, made harmless for a terminal and for a page; pages from templates."""

from pathlib import Path
import re
from typing import Any

_MARKUP = re.compile(r"""[&<>"'`*\[\]|\\~$#@:]|(?<!\w)_|_(?!\w)|(?<=www)\.""", re.IGNORECASE)  # A page may link www.


def plain(text: str) -> str:
    r"""Returns one line of printable text; any other letter is written as its escape, as in `\x1b`."""
    return "".join(letter if letter.isprintable() else letter.encode("unicode_escape").decode() for letter in text)


def escaped(text: str) -> str:
    """Returns text for a page in Markdown or HTML, with entities for all letters of markup and of tables."""
    return _MARKUP.sub(lambda found: f"&#{ord(found[0])};", plain(text))


def page(template: Path, **values: Any) -> str:
    """Returns a page from a template of Jinja2, HTML or Markdown; all text among the values is shown as text."""
    import jinja2

    is_html = template.suffix == ".html"
    harmless = plain if is_html else escaped
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(template.parent),
        autoescape=is_html,
        finalize=lambda value: harmless(value) if type(value) is str else value,  # Macros return escaped text.
        trim_blocks=True,
        keep_trailing_newline=True,
    )
    return environment.get_template(template.name).render(values)
