"""A3C's learner: gradients of whole episodes, applied to variables that all workers share."""

from collections.abc import Callable, Mapping, Sequence
import contextlib
import dataclasses
from typing import Protocol

import torch

from physexp.agents import core, learning, losses, networks, rounds
from physexp.agents.a3c import config as config_lib


@dataclasses.dataclass(frozen=True)
class Pulled:
    """Where training stood when a worker took the parameters.

    Attributes:
      frames: environment steps trained on.
      updates: updates made.
      episode: index of the episodes that the worker plays next.
    """

    frames: int
    updates: int
    episode: int


@dataclasses.dataclass(frozen=True)
class Contribution:
    """A gradient that a worker has made from a round.

    Attributes:
      worker: index of the worker.
      pulled: where training stood when it took the parameters.
      gradients: of each parameter.
      learning_rate: the step size they ask for.
      metrics: figures of the learner.
      episodes: the round, for records.
    """

    worker: int
    pulled: Pulled
    gradients: list[torch.Tensor]
    learning_rate: float
    metrics: dict[str, float]
    episodes: rounds.Round

    def update(self, seed: int, counters: Mapping[str, float]) -> core.Update:
        """Returns the update that was made of it, with the seed of the worker's environments and the counters then."""
        return core.Update(seed, self.pulled.episode, {**self.metrics, **counters}, self.episodes)


class Shared(Protocol):
    """Variables that many workers share, wherever they are kept."""

    def pull(self, network: networks.RecurrentActorCritic, worker: int) -> Pulled:
        """Copies the parameters into a worker's network."""

    def push(self, contribution: Contribution) -> dict[str, float] | None:
        """Applies gradients; returns counters, with `frames` and `updates` among them.

        If too many other updates have been made since the parameters were taken, only the round is counted. Variables
        of this machine return None then; those of another one return the counters of their last answer in any case.
        """

    def save(self) -> dict[str, torch.Tensor]:
        """Returns copies of all variables, by name."""

    def restore(self, tensors: Mapping[str, torch.Tensor]) -> None:
        """Takes up what `save` returned."""


def pull(variables: learning.Variables, worker: int) -> Pulled:
    """Returns where training stands, for a worker."""
    return Pulled(int(variables.frames), int(variables.updates), int(variables.rounds[worker]))


def push(variables: learning.Variables, contribution: Contribution, max_staleness: int) -> dict[str, float] | None:
    """Does what `Shared.push` does, on variables that nobody else reads or writes meanwhile.

    Returns:
      The counters `updates`, `frames` and `staleness`; or None.
    """
    staleness = int(variables.updates) - contribution.pulled.updates
    variables.rounds[contribution.worker] += 1
    if staleness > max_staleness:
        return None
    variables.apply(contribution.gradients, contribution.learning_rate)
    variables.count(contribution.episodes.num_frames)
    return {
        "updates": int(variables.updates),
        "frames": int(variables.frames),
        "staleness": staleness,
    }


class SharedMemory(Shared):
    """Variables in memory that the workers of one machine share.

    Attributes:
      variables: the variables.
      lock: held while they are read or written.
      holder: the worker that holds the lock, int64 []; -1 when none does.
      record: called by `push`, while the lock is held, with what was applied and the counters. So an update is in the
        variables and in the records, or in neither, wherever a worker is stopped.
    """

    def __init__(self, variables: learning.Variables, lock, max_staleness: int):
        self.variables, self.lock, self._max_staleness = variables.share_memory(), lock, max_staleness
        self.holder = torch.tensor(-1).share_memory_()
        self.record: Callable[[Contribution, dict[str, float]], None] | None = None

    def pull(self, network, worker):
        with self._held_by(worker):
            network.load_state_dict(self.variables.network.state_dict())
            return pull(self.variables, worker)

    def push(self, contribution):
        with self._held_by(contribution.worker):
            counters = push(self.variables, contribution, self._max_staleness)
            if counters is not None and self.record is not None:
                self.record(contribution, counters)
            return counters

    def save(self):
        with self.lock:
            return self.variables.save()

    def restore(self, tensors):
        with self.lock:
            self.variables.restore(tensors)

    @contextlib.contextmanager
    def _held_by(self, worker: int):
        with self.lock:
            self.holder.fill_(worker)
            try:
                yield
            finally:
                self.holder.fill_(-1)


class A3CLearner(core.Learner):
    """One worker's learner: takes rounds of episodes, moves the shared variables.

    Attributes:
      last_round: what the last update learned from.
    """

    last_round: rounds.Round

    def __init__(
        self,
        network: networks.RecurrentActorCritic,
        shared: Shared,
        play: Callable[[int], rounds.Round],
        worker: int,
        config: config_lib.A3CConfig,
    ):
        """Joins a worker's own network to the shared variables.

        Args:
          network: the worker's own copy of the network.
          shared: what all workers share.
          play: plays a round, from the index of its episodes, with the network as it is.
          worker: index of the worker.
          config: the agent's configuration.
        """
        self._network, self._shared, self._play = network, shared, play
        self._worker, self._config = worker, config

    def step(self) -> dict[str, float]:
        """Takes the shared parameters, plays a round, and applies its gradient to the shared variables.

        Where the others have left it too far behind, it plays another round.
        """
        while True:
            contribution = self._learn(self._shared.pull(self._network, self._worker))
            counters = self._shared.push(contribution)
            if counters is not None:
                return contribution.metrics | counters

    def _learn(self, pulled: Pulled) -> Contribution:
        config = self._config
        learning_rate, entropy_cost = config.at(pulled.frames)
        self.last_round = episodes = self._play(pulled.episode)
        parts = round_losses(self._network, episodes, config.discount, config.trace, config.entropy_prior)
        gradients, metrics = learning.actor_critic_gradients(
            self._network, parts, entropy_cost, config, episodes.arrays
        )
        metrics |= {"learning_rate": learning_rate, "entropy_cost": entropy_cost}
        return Contribution(self._worker, pulled, gradients, learning_rate, metrics, episodes.record())

    def get_variables(self):
        return learning.network_variables(self.save())

    def save(self):
        return self._shared.save()

    def restore(self, state):
        self._shared.restore(state)


def round_losses(
    network: networks.RecurrentActorCritic,
    episodes: rounds.Round,
    discount: float,
    trace: float = 1.0,
    prior: Sequence[float] = (),
):
    """Computes the losses of a round (see `losses.actor_critic_losses`), the network unrolled over whole episodes."""
    episodes = episodes.select()
    assert isinstance(episodes.inputs, torch.Tensor)
    logits, values = network.unroll(episodes.inputs, episodes.batch_sizes)
    returns, advantages = learning.targets(episodes, values.detach().cpu(), discount, trace)
    actions, returns, advantages = (
        array.to(logits.device) for array in (episodes.packed(episodes.actions), returns, advantages)
    )
    return losses.actor_critic_losses(logits, values, actions, returns, advantages, prior)
