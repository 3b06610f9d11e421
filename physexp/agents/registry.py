"""All agents, by the name of their algorithm."""

from collections.abc import Callable, Mapping

from physexp.agents import config as config_lib
from physexp.agents import core, guests, networks, starting
from physexp.agents.a3c import agent as a3c
from physexp.agents.belief import agent as belief
from physexp.agents.belief import networks as belief_networks
from physexp.agents.ppo import agent as ppo

AGENTS: Mapping[str, Callable[..., core.Agent]] = {"a3c": a3c.A3C, "belief": belief.Belief, "ppo": ppo.PPO}
"""The agents, each made from the arguments of `make`."""

NETWORKS: Mapping[str, type[networks.RecurrentNetwork]] = {
    "a3c": networks.RecurrentActorCritic,
    "belief": belief_networks.BeliefNetwork,
    "ppo": networks.RecurrentActorCritic,
}
"""The kinds of networks that agents have."""


def make_network(environment: core.Batch, config: config_lib.AgentConfig) -> networks.RecurrentNetwork:
    """Returns a network of the configuration's agent for an environment's specs, its weights drawn from the seed."""
    return starting.make_network(NETWORKS[config.algorithm], environment, config)


@guests.own_torch()
def make(make_environment: core.EnvironmentFactory, config: config_lib.AgentConfig) -> core.Agent:
    """Returns the agent of a configuration, as it is before training.

    Args:
      make_environment: makes a batch; it is called in other processes, too, so it must be picklable.
      config: the agent's configuration.
    """
    return AGENTS[config.algorithm](make_environment, config)
