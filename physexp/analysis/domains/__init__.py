"""Facts about each domain; a domain without facts has the defaults of `base.Domain`.

Other packages register facts about their domains in the entry-point group `physexp.facts`: the domain's name, and the
path of a `base.Domain`.
"""

from importlib import metadata

from physexp.analysis.domains import (
    balance,
    base,
    crush,
    lump,
    sealed_box,
    strike,
    strings,
    threshold,
    towers,
    which_is_heavier,
)

__all__ = ["DOMAINS", "find"]

_MODULES = (which_is_heavier, towers, threshold, balance, strings, sealed_box, strike, crush, lump)


def _registered() -> dict[str, base.Domain]:
    """Returns the facts that other packages register."""
    return {entry.name: entry.load() for entry in metadata.entry_points(group="physexp.facts")}


DOMAINS = {**_registered(), **{module.DOMAIN.name: module.DOMAIN for module in _MODULES}}
"""The facts about all domains that have some, by name."""


def find(domain_name: str) -> base.Domain:
    """Returns the facts about a domain."""
    return DOMAINS.get(domain_name) or base.Domain(name=domain_name)
