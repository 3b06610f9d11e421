"""What the analysis knows of each domain; one that is not listed here has the defaults of `base.Domain`."""

from physexp.analysis.domains import balance, base, sealed_box, strike, strings, threshold, towers, which_is_heavier

__all__ = ["DOMAINS", "find"]

_MODULES = (which_is_heavier, towers, threshold, balance, strings, sealed_box, strike)

DOMAINS = {module.DOMAIN.name: module.DOMAIN for module in _MODULES}
"""All domains that have more than defaults, by name."""


def find(domain_name: str) -> base.Domain:
    """Returns what the analysis knows of a domain: the defaults, for one that is not listed."""
    return DOMAINS.get(domain_name) or base.Domain(name=domain_name)
