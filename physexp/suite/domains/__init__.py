"""The domains, in the order in which they are listed; each asks one question."""

from physexp.suite.domains import balance, sealed_box, strike, strings, threshold, towers, which_is_heavier

DOMAINS = {
    module.__name__.rpartition(".")[2]: module
    for module in (which_is_heavier, towers, threshold, balance, strings, sealed_box, strike)
}
"""The modules of the domains by name; each has `SUITE`, the factories of its tasks, and `Options`."""
