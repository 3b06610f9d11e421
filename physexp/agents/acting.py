"""Acting with a network: one episode in any environment, or a round of whole episodes side by side in a batch."""

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import dm_env
import numpy as np
import torch

from physexp.agents import core, networks, rounds

Choose = Callable[[networks.Output, np.ndarray, int], np.ndarray]
"""Maps a network's output, the indices of the environments, int [N], and the number of the step to actions, [N]."""


def as_tensors(observation: Mapping[str, np.ndarray]) -> dict[str, torch.Tensor]:
    """Returns the arrays of a batched observation as tensors."""
    return {name: torch.from_numpy(value) for name, value in observation.items()}


def sample(logits: torch.Tensor, generator: np.random.Generator) -> np.ndarray:
    """Draws actions, int64 [N], from logits [N, A]."""
    return draw(torch.softmax(logits, dim=-1).cpu().numpy(), generator)


def draw(probabilities: np.ndarray, generator: np.random.Generator) -> np.ndarray:
    """Draws indices, int64 [N], from their probabilities, [N, A]."""
    cumulative = probabilities.cumsum(axis=1)
    thresholds = generator.random((len(cumulative), 1)) * cumulative[:, -1:]
    indices: np.ndarray = (cumulative <= thresholds).sum(axis=1).clip(max=cumulative.shape[1] - 1)
    return indices


def drawn(generator: np.random.Generator) -> Choose:
    """Returns a choice that draws actions from the policy."""
    return lambda output, environments, step: sample(output.logits, generator)


def likeliest(output: networks.Output, environments: np.ndarray, step: int) -> np.ndarray:
    """Chooses the likeliest actions."""
    chosen: np.ndarray = output.logits.cpu().numpy().argmax(axis=1)
    return chosen


def play_round(
    network: networks.RecurrentNetwork,
    environment: core.Batch,
    episode: int,
    choose: Choose,
    *,
    keep_inputs: bool = False,
    keep_behaviour: bool = False,
) -> rounds.Round:
    """Plays one whole episode, that of an index, in each environment of a batch.

    `keep_inputs` keeps the encoded observations with the graph that made them, to learn with the same parameters, and
    `keep_behaviour` observations, log probabilities and values, to learn with other parameters.
    """
    timestep = environment.reset(episode=episode)
    active = np.arange(environment.num_environments)
    state = network.initial_state(len(active))
    steps: list[tuple[np.ndarray, np.ndarray, np.ndarray]] = []
    encoded, seen, log_probabilities, values = [], [], [], []
    lengths = np.zeros(len(active), np.int64)
    while len(active):
        observation = as_tensors(timestep.observation)
        with torch.set_grad_enabled(keep_inputs):
            inputs = network.encode(observation)
        with torch.no_grad():
            output, state = network.step(inputs, state)
            actions = choose(output, active, len(steps))
            taken = torch.from_numpy(actions)
            state = network.observe_action(taken, state)
        timestep = environment.step(actions, active)
        steps.append((active, actions, timestep.reward))
        if keep_inputs:
            encoded.append(inputs)
        if keep_behaviour:
            chosen = torch.log_softmax(output.logits.cpu(), dim=-1).gather(1, taken[:, None])[:, 0]
            seen.append(observation)
            log_probabilities.append(chosen)
            values.append(output.values.cpu())
        lengths[active] += 1
        going = timestep.step_type != dm_env.StepType.LAST
        if not going.all():
            kept = torch.from_numpy(np.flatnonzero(going)).to(network.device)
            active, state = active[going], tuple(part[:, kept] for part in state)
            timestep = timestep._replace(observation={k: v[going] for k, v in timestep.observation.items()})
    return rounds.Round(
        *_padded(steps, len(lengths)),
        lengths,
        environment.correct_answers,
        torch.cat(encoded) if keep_inputs else None,
        {name: torch.cat([each[name] for each in seen]) for name in seen[0]} if keep_behaviour else {},
        torch.cat(log_probabilities) if keep_behaviour else None,
        torch.cat(values) if keep_behaviour else None,
    )


def _padded(
    steps: Sequence[tuple[np.ndarray, np.ndarray, np.ndarray]], num_environments: int
) -> tuple[np.ndarray, np.ndarray]:
    """Returns actions and rewards, [T, B], from those of the active environments at each step."""
    actions, rewards = (np.zeros((len(steps), num_environments), dtype) for dtype in (np.int64, np.float32))
    for t, (active, taken, reward) in enumerate(steps):
        actions[t, active], rewards[t, active] = taken, reward
    return actions, rewards


class RecurrentActor(core.EpisodicActor):
    """Plays one environment with a fixed network, carrying the LSTM's state through each episode.

    Attributes:
      policy: probabilities of the actions when the last one was selected, float64 [A].
      value: the network's estimate of the return then.
      belief: probabilities of the labels then, float64 [L]; None if the network has only a policy.
    """

    policy: np.ndarray
    value: float
    belief: np.ndarray | None

    def __init__(self, network: networks.RecurrentNetwork, seed: int = 0, greedy: bool = False):
        """Wraps a network; `seed` determines the actions drawn, `greedy` takes the likeliest ones instead."""
        self._network, self._greedy = network, greedy
        self._generator = np.random.default_rng(seed)
        self._state = network.initial_state(1)

    @torch.inference_mode()
    def _choose(self, observation: Mapping[str, Any]) -> int:
        tensors = {name: torch.as_tensor(value)[None] for name, value in observation.items()}
        output, self._state = self._network.step(self._network.encode(tensors), self._state)
        self.policy = torch.softmax(output.logits[0].double(), dim=-1).cpu().numpy()
        self.value = float(output.values[0])
        self.belief = None if output.beliefs is None else output.beliefs[0].double().cpu().numpy()
        return int(output.logits.argmax() if self._greedy else sample(output.logits, self._generator)[0])

    def _begin(self, timestep: dm_env.TimeStep) -> None:
        self._network.check(timestep.observation)
        self._state = self._network.initial_state(1)

    @torch.inference_mode()
    def _note(self, action: int, next_timestep: dm_env.TimeStep) -> None:
        self._state = self._network.observe_action(torch.tensor([action]), self._state)
