"""Acting: one episode in any environment, or a round of whole episodes side by side in a batch."""

from collections.abc import Callable
import dataclasses
from typing import Any

import dm_env
import numpy as np
import torch

from physexp.agents import core, networks

# Replaces actions on their way to the environment: actions int [N] and a generator to replaced actions int [N].
ActionOverride = Callable[[np.ndarray, np.random.Generator], np.ndarray]


@dataclasses.dataclass(frozen=True)
class Round:
    """Whole episodes, one in each environment of a batch, padded to the longest.

    Steps that were played can be packed: all first steps, then all second steps, and so on, [N, ...].

    Attributes:
      actions: actions taken, int64 [T, B].
      rewards: rewards that followed, float32 [T, B].
      lengths: actions in each episode, int64 [B].
      answers: the right labels, int64 [B]: for records, not for learning.
      inputs: the network's encoding of what was seen before each action, packed, [N, F], with the graph that made it;
        None where the round is not to be learned from with the parameters that it was played with.
      transcript: what else it takes to learn from the round; None where that is not wanted.
    """

    actions: np.ndarray
    rewards: np.ndarray
    lengths: np.ndarray
    answers: np.ndarray
    inputs: torch.Tensor | None = None
    transcript: "Transcript | None" = None

    @property
    def num_frames(self) -> int:
        return int(self.lengths.sum())

    @property
    def played(self) -> np.ndarray:
        """Which steps were played, bool [T, B]."""
        return np.arange(len(self.actions))[:, None] < self.lengths

    @property
    def batch_sizes(self) -> torch.Tensor:
        """How many episodes have a t-th step, int64 [T]."""
        return torch.from_numpy(self.played.sum(axis=1))

    def packed(self, array: np.ndarray) -> torch.Tensor:
        """The steps of an array [T, B, ...] that were played, packed."""
        return torch.from_numpy(array[self.played])

    def select(self, episodes: np.ndarray | None = None) -> "Round":
        """Some episodes, or all, from the longest to the shortest, as the network unrolls them."""
        episodes = np.arange(len(self.lengths)) if episodes is None else episodes
        episodes = episodes[np.argsort(-self.lengths[episodes], kind="stable")]
        longest = self.lengths[episodes].max()
        places = self.played.ravel().cumsum().reshape(self.played.shape) - 1
        steps = torch.from_numpy(places[:longest, episodes][self.played[:longest, episodes]])
        return Round(
            self.actions[:longest, episodes],
            self.rewards[:longest, episodes],
            self.lengths[episodes],
            self.answers[episodes],
            None if self.inputs is None else self.inputs[steps.to(self.inputs.device)],
            self.transcript and self.transcript.select(steps),
        )

    def record(self) -> "Round":
        """The same round, to be looked at but not to be learned from."""
        return dataclasses.replace(self, inputs=None, transcript=None)

    def arrays(self) -> dict[str, np.ndarray]:
        """All there is, as plain arrays by name: to be written, or sent by a process that ends."""
        named: dict[str, Any] = {**vars(self), **(vars(self.transcript) if self.transcript else {})}
        named |= named.pop("observation", {})
        del named["transcript"]
        return {
            name: value.detach().cpu().numpy() if isinstance(value, torch.Tensor) else value
            for name, value in named.items()
            if value is not None
        }


@dataclasses.dataclass(frozen=True)
class Transcript:
    """What it takes to learn from episodes with other parameters than those they were played with; all packed.

    Attributes:
      observation: what was seen before each action, arrays [N, ...] by name.
      log_probabilities: of the actions, by the policy that took them, float32 [N].
      values: what that network expected of the rest of the episode, float32 [N].
    """

    observation: dict[str, torch.Tensor]
    log_probabilities: torch.Tensor
    values: torch.Tensor

    def select(self, steps: torch.Tensor) -> "Transcript":
        """Some steps, int64 [n]."""
        observation = {name: array[steps] for name, array in self.observation.items()}
        return Transcript(observation, self.log_probabilities[steps], self.values[steps])


def as_tensors(observation) -> dict[str, torch.Tensor]:
    """The arrays of a batched observation as tensors."""
    return {name: torch.from_numpy(value) for name, value in observation.items()}


def sample(logits: torch.Tensor, generator: np.random.Generator) -> np.ndarray:
    """Draws actions, int64 [N], from logits [N, A]."""
    cumulative = torch.softmax(logits, dim=-1).cpu().numpy().cumsum(axis=1)
    thresholds = generator.random((len(cumulative), 1)) * cumulative[:, -1:]
    return (cumulative <= thresholds).sum(axis=1).clip(max=cumulative.shape[1] - 1)


@torch.no_grad()
def play_round(
    network: networks.RecurrentActorCritic,
    environment,
    episode: int,
    generator: np.random.Generator,
    greedy: bool = False,
    action_override: ActionOverride | None = None,
    differentiable: bool = False,
    transcribe: bool = False,
) -> Round:
    """Plays one whole episode in each environment of a batch.

    Args:
      network: the policy.
      environment: a `BatchEnvironment`.
      episode: index of the episode that every environment starts.
      generator: source of the actions.
      greedy: take the likeliest action instead of drawing one.
      action_override: changes the chosen actions on their way to the environment.
      differentiable: keep what it takes to differentiate the inputs. A round is learned from with the parameters that
        it is played with, so what is seen passes the torso only once.
      transcribe: keep what it takes to learn from the round with other parameters, too.
    """
    timestep = environment.reset(episode=episode)
    active = np.arange(environment.num_environments)
    state = network.initial_state(len(active))
    steps, encoded, transcripts = [], [], []
    lengths = np.zeros(len(active), np.int64)
    while len(active):
        observation = timestep.observation
        with torch.set_grad_enabled(differentiable):
            inputs = network.encode(as_tensors(observation))
        logits, values, state = network.step(inputs, state)
        actions = logits.cpu().numpy().argmax(axis=1) if greedy else sample(logits, generator)
        if action_override is not None:
            actions = action_override(actions, generator)
        timestep = environment.step(actions, active)
        steps.append((active, actions, timestep.reward))
        if differentiable:
            encoded.append(inputs)
        if transcribe:
            chosen = torch.log_softmax(logits.cpu(), dim=-1).gather(1, torch.from_numpy(actions)[:, None])[:, 0]
            transcripts.append((as_tensors(observation), chosen, values.cpu()))
        lengths[active] += 1
        going = timestep.step_type != dm_env.StepType.LAST
        if not going.all():
            kept = torch.from_numpy(np.flatnonzero(going)).to(logits.device)
            active, state = active[going], (state[0][:, kept], state[1][:, kept])
            timestep = timestep._replace(observation={k: v[going] for k, v in timestep.observation.items()})
    actions, rewards = (np.zeros((len(steps), len(lengths)), dtype) for dtype in (np.int64, np.float32))
    for t, (active, taken, reward) in enumerate(steps):
        actions[t, active], rewards[t, active] = taken, reward
    with torch.set_grad_enabled(differentiable):
        graph = torch.cat(encoded) if differentiable else None
    transcript = _joined(transcripts) if transcribe else None
    return Round(actions, rewards, lengths, environment.correct_answers, graph, transcript)


def _joined(transcripts) -> Transcript:
    """The transcript of all steps, from one for each point in time."""
    observations, log_probabilities, values = zip(*transcripts, strict=True)
    observation = {name: torch.cat([each[name] for each in observations]) for name in observations[0]}
    return Transcript(observation, torch.cat(log_probabilities), torch.cat(values))


class RecurrentActor(core.Actor):
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
