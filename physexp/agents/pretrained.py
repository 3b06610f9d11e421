"""Trained agents that come with the package: weights in half precision, and a card that says where they come from."""

from collections.abc import Mapping
import dataclasses
import json
from pathlib import Path
from typing import Any

from dm_env import specs
import numpy as np
from safetensors import torch as safetensors
import torch

from physexp.agents import acting, checkpointing, networks

FOLDER = Path(__file__).with_name("pretrained_agents")
_DEFAULT_DIFFICULTY = 5


@dataclasses.dataclass(frozen=True)
class Pretrained:
    """A trained agent.

    Attributes:
      network: its network.
      card: where it comes from: domain, task, command, commit, seed, frames, time, evaluation, the network's
        hyperparameters and the specs it was made for.
    """

    network: networks.RecurrentActorCritic
    card: dict[str, Any]

    def actor(self, seed: int = 0, greedy: bool = False) -> acting.RecurrentActor:
        """An actor with this network; `seed` determines its actions, `greedy` takes the likeliest ones instead."""
        return acting.RecurrentActor(self.network, seed, greedy)


def name(domain: str, task: str, difficulty: float | None) -> str:
    """The name of an agent's files."""
    if difficulty is None:
        return f"{domain}-{task}"
    short = f"{difficulty:g}"
    return f"{domain}-{task}-difficulty{short if float(short) == difficulty else repr(difficulty)}"


def names(folder: Path = FOLDER) -> list[str]:
    """The names of the agents in a folder."""
    return sorted(card.stem for card in folder.glob("*.json"))


def load(domain: str, task: str, difficulty: float | None = None, folder: Path = FOLDER) -> Pretrained:
    """Loads a trained agent.

    Args:
      domain, task: what it plays.
      difficulty: what it was trained at, for a domain with difficulties; 5 by default.
      folder: where the agents are.

    Raises:
      ValueError: where there is no such agent; it lists those that there are.
    """
    base = name(domain, task, difficulty)
    there = names(folder)
    if difficulty is None and base not in there:
        base = name(domain, task, _DEFAULT_DIFFICULTY)
    if base not in there:
        raise ValueError(f"no trained agent is named {name(domain, task, difficulty)}; there are: {', '.join(there)}")
    card = json.loads((folder / f"{base}.json").read_text())
    observation_spec = {
        key: specs.Array(tuple(shape), np.dtype(dtype), key)
        for key, (shape, dtype) in card["network"]["observations"].items()
    }
    hyperparameters = card["network"]["hyperparameters"]
    network = networks.RecurrentActorCritic(observation_spec, card["network"]["num_actions"], **hyperparameters)
    network.load_state_dict(safetensors.load_file(folder / f"{base}.safetensors"))
    return Pretrained(network.eval(), card)


def save(network: networks.RecurrentActorCritic, card: Mapping[str, Any], folder: Path = FOLDER) -> Path:
    """Writes a trained agent; returns the path of its card.

    Args:
      network: its network; floating-point weights are kept in half precision.
      card: all that is known of it, with `domain`, `task`, `difficulty` and `network` as `load` reads them.
      folder: where the agents are; made when needed.
    """
    folder.mkdir(parents=True, exist_ok=True)
    base = name(card["domain"], card["task"], card["difficulty"])
    checkpointing.write_agent(folder / f"{base}.safetensors", network.state_dict())
    path = folder / f"{base}.json"
    checkpointing.write_atomically(path, (json.dumps(dict(card), indent=1) + "\n").encode())
    return path


def halved(network: networks.RecurrentActorCritic) -> networks.RecurrentActorCritic:
    """Rounds a network's weights, in place, to what half precision keeps of them."""
    with torch.no_grad():
        for parameter in network.parameters():
            parameter.copy_(parameter.half().float())
    return network
