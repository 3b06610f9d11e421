"""The domains, in the order in which they are listed; each asks one question.

Other packages register domains of their own in the entry-point group `physexp.domains`: a name, and a module that has
`SUITE`, the factories of its tasks, and `Options`.
"""

from importlib import metadata
from types import ModuleType
import warnings

from physexp.suite.domains import balance, crush, lump, sealed_box, strike, strings, threshold, towers, which_is_heavier

GROUP = "physexp.domains"

DOMAINS: dict[str, ModuleType] = {
    module.__name__.rpartition(".")[2]: module
    for module in (which_is_heavier, towers, threshold, balance, strings, sealed_box, strike, crush, lump)
}
"""The modules of the domains by name; each has `SUITE`, the factories of its tasks, and `Options`."""


def register() -> None:
    """Adds the domains of other packages; a domain that cannot be loaded is left out with a warning."""
    for entry in sorted(metadata.entry_points(group=GROUP), key=lambda entry: entry.name):
        try:
            if entry.name in DOMAINS:
                raise ValueError("there is a domain of this name; choose another")
            module = entry.load()
            if not (hasattr(module, "SUITE") and hasattr(module, "Options")):
                raise ValueError(f"{entry.value} is not a module with SUITE and Options")
        except Exception as error:  # It is another package's code.
            package = entry.dist.name if entry.dist else entry.value
            warnings.warn(
                f"the domain {entry.name} of {package} is left out: {type(error).__name__}: {error}",
                RuntimeWarning,
                stacklevel=2,
            )
        else:
            DOMAINS[entry.name] = module
