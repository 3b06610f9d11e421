"""A3C's learner: gradients of whole episodes, applied to variables that all workers share."""

from collections.abc import Callable, Sequence
from multiprocessing import synchronize

import torch

from physexp.agents import acting, core, devices, learning, losses, networks, rounds, starting
from physexp.agents.a3c import config as config_lib


class A3CLearner(core.Learner):
    """One worker's learner: reads the shared parameters, plays a round, and applies its gradient to them.

    The lock is held while the shared variables are read or written, and while an update is sent: an update is in the
    variables and in the records, or in neither, whenever the worker is killed.
    """

    def __init__(
        self,
        worker: int,
        make_environment: core.EnvironmentFactory,
        config: config_lib.A3CConfig,
        variables: learning.Variables[networks.RecurrentActorCritic],
        lock: synchronize.Lock,
        send: Callable[[core.Update], None],
    ):
        """Makes the environments of the worker of an index, and its copy of the shared network."""
        self._worker, self._config, self.variables, self._lock, self._send = worker, config, variables, lock, send
        self._seed = starting.worker_seed(config.seed, worker)
        self._environment = make_environment(self._seed, config.envs_per_worker, 1)
        network = starting.make_network(networks.RecurrentActorCritic, self._environment, config)
        self._network = network.to(devices.choose(config.device, network.sees_images))

    def step(self) -> dict[str, float]:
        """Makes one update; returns its metrics."""
        config, variables = self._config, self.variables
        with self._lock:
            self._network.load_state_dict(variables.network.state_dict())
            frames, updates = int(variables.frames), int(variables.updates)
            episode = int(variables.rounds[self._worker])
        learning_rate, entropy_cost = config.at(frames)
        choose = acting.drawn(starting.round_generator(config.seed, self._worker, episode))
        episodes = acting.play_round(self._network, self._environment, episode, choose, keep_inputs=True)
        parts = round_losses(self._network, episodes, config.discount, config.gae_lambda, config.entropy_prior)
        gradients, metrics = learning.actor_critic_gradients(self._network, parts, entropy_cost, config, episodes)
        with self._lock:
            staleness = int(variables.updates) - updates
            variables.rounds[self._worker] += 1
            variables.apply(gradients, learning_rate)
            variables.count(episodes.num_frames)
            metrics |= {
                "learning_rate": learning_rate,
                "entropy_cost": entropy_cost,
                "updates": int(variables.updates),
                "frames": int(variables.frames),
                "staleness": staleness,
            }
            self._send(core.Update(self._seed, episode, metrics, episodes.record()))
        return metrics


def round_losses(
    network: networks.RecurrentActorCritic,
    episodes: rounds.Round,
    discount: float,
    trace: float = 1.0,
    prior: Sequence[float] = (),
) -> tuple[torch.Tensor, torch.Tensor, torch.Tensor]:
    """Computes the losses of a round (see `losses.actor_critic_losses`), the network unrolled over whole episodes."""
    episodes = episodes.select()
    assert isinstance(episodes.inputs, torch.Tensor)
    logits, values = network.unroll(episodes.inputs, episodes.batch_sizes)
    returns, advantages = learning.targets(episodes, values.detach().cpu(), discount, trace)
    actions, returns, advantages = (
        array.to(logits.device) for array in (episodes.packed(episodes.actions), returns, advantages)
    )
    return losses.actor_critic_losses(logits, values, actions, returns, advantages, prior)
