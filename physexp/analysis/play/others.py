"""The players that a person is compared with, on the same instances: the ideal experimenter and a trained agent."""

import contextlib
from typing import Any

from physexp.agents import acting, core
from physexp.analysis import domains
from physexp.analysis.training import finding

TRAINED, IDEAL = "trained agent", "ideal experimenter"


def players(domain: str, task: str, kwargs: dict[str, Any]) -> dict[str, core.Actor]:
    """Returns those that there are for a task with some options, by name."""
    others: dict[str, core.Actor] = {}
    facts = domains.find(domain)
    ideal = facts.ideal_with(kwargs)
    with contextlib.suppress(ValueError):  # If none comes with the package.
        network, *_ = finding.shipped_agent(domain, task, kwargs)
        others[TRAINED] = acting.RecurrentActor(network)
    if ideal is not None:
        with contextlib.suppress(ValueError):  # If it cannot play.
            others[IDEAL] = ideal(task, kwargs, facts.discount).actor()
    return others
