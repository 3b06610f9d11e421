"""All agents, by the name of their algorithm."""

from collections.abc import Callable, Mapping

from physexp.agents import core, networks
from physexp.agents.a3c import agent as a3c
from physexp.agents.belief import agent as belief
from physexp.agents.belief import networks as belief_networks
from physexp.agents.ppo import agent as ppo

AGENTS: Mapping[str, Callable[..., core.Agent]] = {"a3c": a3c.A3C, "belief": belief.Belief, "ppo": ppo.PPO}
"""The agents; each is made from a function that makes environments, and is picklable, and its configuration."""

NETWORKS: Mapping[str, type[networks.RecurrentNetwork]] = {
    "a3c": networks.RecurrentActorCritic,
    "belief": belief_networks.BeliefNetwork,
    "ppo": networks.RecurrentActorCritic,
}
"""The kinds of networks that agents have."""
