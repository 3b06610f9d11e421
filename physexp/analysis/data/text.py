"""Text from others, made harmless for a terminal and for a page."""

import re

_MARKUP = re.compile(r"""[&<>"'`*\[\]|\\~$#@:]|(?<!\w)_|_(?!\w)|(?<=www)\.""", re.IGNORECASE)  # A page may link www.


def plain(text: str) -> str:
    r"""Returns one line of printable text; any other letter is written as its escape, as in `\x1b`."""
    return "".join(letter if letter.isprintable() else letter.encode("unicode_escape").decode() for letter in text)


def escaped(text: str) -> str:
    """Returns text for a page in Markdown or HTML, with entities for all letters of markup and of tables."""
    return _MARKUP.sub(lambda found: f"&#{ord(found[0])};", plain(text))
