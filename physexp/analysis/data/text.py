"""Text from files and folders of others, made harmless for a terminal and for a page."""

import re

_MARKUP = re.compile(r"""[&<>"'`*\[\]|\\~$#@:]|(?<!\w)_|_(?!\w)|(?<=www)\.""", re.IGNORECASE)  # A page may link www.


def plain(text: str) -> str:
    """Returns one line of text that a terminal only shows: any other letter is written as its escape, as in `\\x1b`."""
    return "".join(letter if letter.isprintable() else letter.encode("unicode_escape").decode() for letter in text)


def escaped(text: str) -> str:
    """Returns the text for a page in Markdown or HTML, where no letter of it is markup or ends a cell of a table."""
    return _MARKUP.sub(lambda found: f"&#{ord(found[0])};", plain(text))
