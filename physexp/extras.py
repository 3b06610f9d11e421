"""The libraries that only some commands need, and their extras. Imports nothing heavy."""

from collections.abc import Iterable
import importlib.util

EXTRAS = {
    "gymnasium": "gymnasium",
    "matplotlib": "figures",
    "mcp": "mcp",
    "minari": "minari",
    "pandas": "analysis",
    "ray": "ray",
    "sb3_contrib": "sb3",
    "stable_baselines3": "sb3",
    "tensorboard": "tensorboard",
}
"""Extras by the module that they install."""


class MissingExtraError(ModuleNotFoundError):
    """A library of an extra is not installed; the message has the command that installs it."""


def require(*modules: str) -> None:
    """Checks that libraries are installed, without importing them.

    Args:
      modules: keys of `EXTRAS`.

    Raises:
      MissingExtraError: if some are missing; one line names them and the command that installs them.
    """
    if missing := find_missing(modules):
        wanted = ",".join(dict.fromkeys(EXTRAS[module] for module in missing))
        are = "is" if len(missing) == 1 else "are"
        names = " and ".join(filter(None, [", ".join(missing[:-1]), missing[-1]]))
        raise MissingExtraError(f"{names} {are} not installed; pip install 'physexp[{wanted}]'", name=missing[0])


def find_missing(modules: Iterable[str]) -> list[str]:
    """Returns the modules that are not installed."""
    return [module for module in modules if importlib.util.find_spec(module) is None]
