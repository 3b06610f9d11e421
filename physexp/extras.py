"""Libraries that only some commands and modules need, and the extra that brings each. Imports nothing heavy."""

from collections.abc import Iterable
import importlib.util

EXTRAS = {
    "gymnasium": "gymnasium",
    "matplotlib": "figures",
    "minari": "minari",
    "pandas": "analysis",
    "ray": "ray",
    "sb3_contrib": "sb3",
    "stable_baselines3": "sb3",
    "tensorboard": "tensorboard",
}
"""Extras by the module that they bring."""


class MissingExtraError(ModuleNotFoundError):
    """A library that an extra brings is not installed; the message says what to install."""


def require(*modules: str) -> None:
    """Checks that libraries are installed, without importing them.

    Args:
      modules: keys of `EXTRAS`.

    Raises:
      MissingExtraError: if some are not; the message is one line that names them and the command that installs them.
    """
    if missing := find_missing(modules):
        wanted = ",".join(dict.fromkeys(EXTRAS[module] for module in missing))
        are = "is" if len(missing) == 1 else "are"
        names = " and ".join(filter(None, [", ".join(missing[:-1]), missing[-1]]))
        raise MissingExtraError(f"{names} {are} not installed; pip install 'physexp[{wanted}]'", name=missing[0])


def find_missing(modules: Iterable[str]) -> list[str]:
    """Those of some modules that cannot be imported, for want of being installed."""
    return [module for module in modules if importlib.util.find_spec(module) is None]
