"""Acting: one episode in any environment, or a round of whole episodes side by side in a batch."""

from collections.abc import Callable
import dataclasses

import dm_env
import numpy as np
import torch

from physexp.agents import core, networks

# Replaces actions on their way to the environment: actions int [N] and a generator to replaced actions int [N].
Interference = Callable[[np.ndarray, np.random.Generator], np.ndarray]


@dataclasses.dataclass(frozen=True)
class Round:
    """Whole episodes, one in each environment of a batch, padded to the longest.

    Attributes:
      inputs: the network's encoding of what was seen before each action, all first steps, then all second steps, and
        so on, [N, F]; with the graph that made it where the round is to be learned from; None in records.
      actions: actions taken, int64 [T, B].
      rewards: rewards that followed, float32 [T, B].
      lengths: actions in each episode, int64 [B].
      answers: the right labels, int64 [B]: for records, not for learning.
    """

    inputs: torch.Tensor | np.ndarray | None
    actions: np.ndarray
    rewards: np.ndarray
    lengths: np.ndarray
    answers: np.ndarray

    @property
    def num_frames(self) -> int:
        return int(self.lengths.sum())

    def detached(self) -> "Round":
        """The same round, to be looked at but not to be learned from.

        Its inputs are a plain array: a tensor sent to another process can be received only while its sender lives.
        """
        assert isinstance(self.inputs, torch.Tensor)
        return dataclasses.replace(self, inputs=self.inputs.detach().cpu().numpy())

    def packed_inputs(self, order: np.ndarray) -> torch.Tensor:
        """The inputs, episodes in the given order: [N, F]."""
        assert isinstance(self.inputs, torch.Tensor)
        played = np.arange(len(self.actions))[:, None] < self.lengths
        places = played.ravel().cumsum().reshape(played.shape) - 1
        return self.inputs[self.packed(places, order).to(self.inputs.device)]

    def packed(self, array: np.ndarray, order: np.ndarray) -> torch.Tensor:
        """The steps of an array [T, B, ...] that were played, episodes in the given order: [N, ...]."""
        played = np.arange(len(array))[:, None] < self.lengths[order]
        return torch.from_numpy(array[:, order][played])


def as_tensors(observation) -> dict[str, torch.Tensor]:
    """The arrays of a batched observation as tensors."""
    return {name: torch.from_numpy(value) for name, value in observation.items()}


def sample(logits: torch.Tensor, generator: np.random.Generator) -> np.ndarray:
    """Draws actions, int64 [N], from logits [N, A]."""
    cumulative = torch.softmax(logits, dim=-1).cpu().numpy().cumsum(axis=1)
    thresholds = generator.random((len(cumulative), 1)) * cumulative[:, -1:]
    return (cumulative <= thresholds).sum(axis=1).clip(max=cumulative.shape[1] - 1)


@torch.no_grad()
def play_round(network: networks.RecurrentActorCritic, environment, episode: int, generator: np.random.Generator,
               greedy: bool = False, interference: Interference | None = None,
               differentiable: bool = False) -> Round:  # fmt: skip
    """Plays one whole episode in each environment of a batch.

    Args:
      network: the policy.
      environment: a `BatchEnvironment`.
      episode: index of the episode that every environment starts.
      generator: source of the actions.
      greedy: take the likeliest action instead of drawing one.
      interference: changes the chosen actions on their way to the environment.
      differentiable: keep what it takes to differentiate the inputs. A round is learned from with the parameters that
        it is played with, so what is seen passes the torso only once.
    """
    timestep = environment.reset(episode=episode)
    active = np.arange(environment.num_environments)
    state = network.initial_state(len(active))
    steps, lengths = [], np.zeros(len(active), np.int64)
    while len(active):
        observation = timestep.observation
        with torch.set_grad_enabled(differentiable):
            inputs = network.encode(as_tensors(observation))
        logits, _, state = network.step(inputs, state)
        actions = logits.cpu().numpy().argmax(axis=1) if greedy else sample(logits, generator)
        if interference is not None:
            actions = interference(actions, generator)
        timestep = environment.step(actions, active)
        steps.append((active, inputs, actions, timestep.reward))
        lengths[active] += 1
        going = timestep.step_type != dm_env.StepType.LAST
        if not going.all():
            kept = torch.from_numpy(np.flatnonzero(going)).to(logits.device)
            active, state = active[going], (state[0][:, kept], state[1][:, kept])
            timestep = timestep._replace(observation={k: v[going] for k, v in timestep.observation.items()})
    with torch.set_grad_enabled(differentiable):
        return _collect(steps, lengths, environment.correct_answers)


def _collect(steps, lengths, answers) -> Round:
    """Joins the steps of a round into padded arrays."""
    shape = (len(steps), len(lengths))
    actions, rewards = np.zeros(shape, np.int64), np.zeros(shape, np.float32)
    for t, (active, _, taken, reward) in enumerate(steps):
        actions[t, active] = taken
        rewards[t, active] = reward
    inputs = torch.cat([inputs for _, inputs, _, _ in steps])
    return Round(inputs, actions, rewards, lengths, answers)


class A3CActor(core.Actor):
    """Plays one environment with a fixed network, carrying the LSTM's state through each episode.

    Attributes:
      policy: probabilities of the actions when the last one was selected, float64 [A].
      value: what the network expected of the rest of the episode then.
    """

    policy: np.ndarray
    value: float

    def __init__(self, network: networks.RecurrentActorCritic, seed: int = 0, greedy: bool = False):
        """Wraps a network; `seed` determines the actions drawn, `greedy` takes the likeliest ones instead."""
        self._network, self._greedy = network, greedy
        self._generator = np.random.default_rng(seed)
        self._state = network.initial_state(1)

    @torch.inference_mode()
    def select_action(self, observation) -> int:
        tensors = {name: torch.as_tensor(value)[None] for name, value in observation.items()}
        logits, values, self._state = self._network.step(self._network.encode(tensors), self._state)
        self.policy, self.value = torch.softmax(logits[0].double(), dim=-1).cpu().numpy(), float(values[0])
        if self._greedy:
            return int(logits.argmax())
        return int(sample(logits, self._generator)[0])

    def observe_first(self, timestep):
        self._state = self._network.initial_state(1)

    def observe(self, action, next_timestep):
        """Needs nothing: the state has moved on in `select_action`."""

    def update(self):
        """Needs nothing: the network is fixed."""
