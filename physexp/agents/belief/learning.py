"""The belief learner's learner: steps of Adam on whole episodes from the replay, after each round of new ones."""

from collections.abc import Callable, Mapping
import copy
import dataclasses
import math

import numpy as np
import torch

from physexp.agents import acting as acting_lib
from physexp.agents import learning, rounds, synchronous
from physexp.agents.belief import acting, losses, networks, replay
from physexp.agents.belief import config as config_lib

# One value for all tasks.
_LEARNING_RATE = 4e-3  # Adam's at the start; it decays linearly to zero over training.
_WEIGHT_DECAY = 0.02  # Each step of Adam shrinks the weights, but not the biases, by this times the learning rate.
_BATCH_SIZE = 32  # Episodes in a step of Adam.
_DROPOUT = 0.1  # Share of a memory's outputs that is dropped, so that beliefs are less sure of rare experience.
_EMA_DECAY = 0.99  # Of the network that acts, a moving average of the one that learns.
_LAMBDA = 0.9  # Weight of the return of greedy actions against the network's own values.
_NUM_OUTCOMES = 1024  # Answers that calibration is measured on.
_WINDOW = 512  # Greedy episodes between two comparisons with the best.
_NO_METRICS = dict.fromkeys(("belief_loss", "value_loss", "gradient_norm"), math.nan)  # Of a round without a step.

Play = Callable[[int, acting_lib.Choose], rounds.Round]
"""Plays the round of a number with the averaged network, and keeps the encoded observations."""


@dataclasses.dataclass
class BestSoFar:
    """Compares windows of greedy episodes with the best one.

    Attributes:
      mean, variance: of the best window, mean return and its variance.
      is_worse: whether the last window was worse than the best.
      count, total, squares: of the current window, episodes, sum of returns and of their squares.
    """

    mean: float = -1.0
    variance: float = 0.0
    count: float = 0.0
    total: float = 0.0
    squares: float = 0.0
    is_worse: bool = False

    def add(self, returns: torch.Tensor) -> bool:
        """Adds the returns of greedy episodes; returns whether they complete a window that is the best."""
        self.count += len(returns)
        self.total += float(returns.sum())
        self.squares += float(returns.square().sum())
        if self.count < _WINDOW:
            return False
        mean = self.total / self.count
        variance = (self.squares / self.count - mean**2) / self.count
        # Two standard errors: a difference within them is luck.
        self.is_worse = mean < self.mean - 2 * math.sqrt(self.variance + variance)
        is_best = mean > self.mean
        if is_best:
            self.mean, self.variance = mean, variance
        self.count = self.total = self.squares = 0.0
        return is_best

    def tensor(self) -> torch.Tensor:
        """Returns the fields as float64 [6], for a checkpoint."""
        return torch.tensor(dataclasses.astuple(self), dtype=torch.float64)

    @classmethod
    def of(cls, tensor: torch.Tensor) -> "BestSoFar":
        """Returns the fields that `tensor` returned."""
        mean, variance, count, total, squares, is_worse = tensor.tolist()
        return cls(mean, variance, count, total, squares, bool(is_worse))


class Variables(learning.Variables[networks.BeliefNetwork]):
    """All that training changes; `network` is the one that learns.

    Attributes:
      averaged: the network that acts during training, a moving average.
      best: the averaged network when it played best.
      agent: the result of training: the averaged network, or the best one if the averaged one has become worse.
      episodes: the last episodes played.
      moments: of the changes of inputs, the sum of squares and the count, float64 [2].
      outcomes: of the last greedy answers, the belief in them and whether they were right, float32 [N, 2]; -1 for none.
      best_so_far: the comparison that decides about `best` and `agent`.
    """

    def __init__(self, network: networks.BeliefNetwork, episodes: replay.Replay):
        """Gives a network an optimizer, its averages, and a memory of episodes."""
        super().__init__(network, weight_decay=_WEIGHT_DECAY)
        self.averaged, self.best, self.agent = (copy.deepcopy(network) for _ in range(3))
        self.episodes = episodes
        self.moments = torch.zeros(2, dtype=torch.float64)
        self.outcomes = torch.full((_NUM_OUTCOMES, 2), -1.0)
        self.best_so_far = BestSoFar()

    def tensors(self) -> dict[str, torch.Tensor]:
        """Returns everything, by name; the agent's variables are under `network/`."""
        named = {name.replace("network/", "trained/", 1): value for name, value in super().tensors().items()}
        for prefix, network in (("averaged", self.averaged), ("best", self.best), ("network", self.agent)):
            named |= {f"{prefix}/{name}": value for name, value in network.state_dict().items()}
        own = {"moments": self.moments, "outcomes": self.outcomes, "scores": self.best_so_far.tensor()}
        return {**named, **own, "episodes/actions": self.episodes.actions}

    def restore(self, tensors: Mapping[str, torch.Tensor]) -> None:
        """Restores everything from the result of `save`."""
        super().restore(tensors)
        self.best_so_far = BestSoFar.of(tensors["scores"])

    def update_agent(self) -> None:
        """Sets `agent` to the averaged network, or to the best one."""
        chosen = self.best if self.best_so_far.is_worse else self.averaged
        self.agent.load_state_dict(chosen.state_dict())


class BeliefLearner(synchronous.SynchronousLearner):
    """Plays rounds of episodes, keeps them, and learns from all that it keeps."""

    variables: Variables

    def __init__(self, variables: Variables, play: Play, config: config_lib.BeliefConfig):
        """Takes the networks, the optimizer and the episodes, and a function that plays a round."""
        self.variables, self._play, self._config = variables, play, config

    def step(self) -> dict[str, float]:
        """Plays a round, and makes as many steps of Adam as its frames ask for."""
        config, variables, number = self._config, self.variables, self.next_episode
        policy = acting.BehaviourPolicy(variables.network.num_interactions, config, number)
        self.last_round = played = self._play(number, policy.choose)
        variables.episodes.add(played, number)
        self._measure_changes(played)
        self._measure_answers(policy, played)
        returns = played.rewards.sum(axis=0) * config.discount ** (played.lengths - 1.0)
        greedy_returns = torch.from_numpy(returns[policy.are_greedy])
        if variables.best_so_far.add(greedy_returns):
            variables.best.load_state_dict(variables.averaged.state_dict())
        steps_before = int(variables.frames) // config.frames_per_update
        variables.rounds += 1
        variables.count(played.num_frames)
        learning_rate = _LEARNING_RATE * (1 - config.progress(int(variables.frames)))
        generator = np.random.default_rng([config.seed, number])
        metrics = []
        with torch.random.fork_rng(devices=[]):  # Dropout draws from torch's global generator.
            torch.default_generator.manual_seed(int(generator.integers(2**63)))
            for _ in range(int(variables.frames) // config.frames_per_update - steps_before):
                episodes, held_out = variables.episodes.sample(
                    generator, _BATCH_SIZE, networks.ENSEMBLE_SIZE, number + 1
                )
                metrics.append(self._learn(episodes, held_out, learning_rate))
        variables.update_agent()
        return {
            **{name: float(np.mean([each[name] for each in metrics or [_NO_METRICS]])) for name in _NO_METRICS},
            "greedy_success_rate": float((greedy_returns > 0).double().mean()),
            "greedy_return": float(greedy_returns.mean()),
            **self._calibration(),
            "learning_rate": learning_rate,
            "updates": int(variables.updates),
            "frames": int(variables.frames),
        }

    def _learn(self, episodes: rounds.Round, held_out: torch.Tensor, learning_rate: float) -> dict[str, float]:
        """Makes one step of Adam on B episodes with held-out members, int64 [B], ascending; returns its metrics."""
        config, network, averaged = self._config, self.variables.network, self.variables.averaged
        assert episodes.inputs is not None
        actions, played = torch.from_numpy(episodes.actions), torch.from_numpy(episodes.played)
        inputs = _padded(episodes.inputs.to(network.device).float(), played)
        logits, shares = (part.cpu() for part in network.unroll(inputs, actions.to(network.device), _DROPOUT))
        with torch.no_grad():
            outputs_of_held_out = averaged.held_out(inputs, actions.to(network.device))
        held_out_logits, held_out_shares = (part.cpu() for part in outputs_of_held_out)
        learns = torch.arange(networks.ENSEMBLE_SIZE)[:, None, None] != held_out
        labels, are_counted = label_targets(episodes, held_out_logits, network.num_interactions, config)
        belief_loss = losses.belief_loss(logits, labels, are_counted & learns)
        beliefs = held_out_logits.softmax(-1)
        best = (shares.detach() * learns[..., None]).sum(0).argmax(-1)  # By the members that learn from the episode.
        interacting = network.values(beliefs, held_out_shares).gather(-1, best[..., None])[..., 0]
        targets = value_targets(episodes, losses.answer_values(beliefs.amax(-1)), interacting, best, config.discount)
        taken = actions.clamp(max=network.num_interactions - 1).expand(len(logits), *actions.shape)
        values = network.values(beliefs, shares).gather(-1, taken[..., None])[..., 0]
        value_loss = losses.value_loss(values, targets, played & (actions < network.num_interactions) & learns)
        gradients, norm = learning.clipped_gradients(network, (belief_loss + value_loss).sum(), episodes)
        self.variables.apply(gradients, learning_rate)
        with torch.no_grad():
            torch._foreach_lerp_(list(averaged.parameters()), list(network.parameters()), 1 - _EMA_DECAY)
        return {
            "belief_loss": belief_loss.mean().item(),
            "value_loss": value_loss.mean().item(),
            "gradient_norm": norm,
        }

    def _measure_changes(self, played: rounds.Round) -> None:
        """Updates the unit of inputs: their root mean square change since the start of the episode."""
        variables = self.variables
        assert played.inputs is not None
        were_played = torch.from_numpy(played.played)
        seen = _padded(played.inputs.cpu(), were_played)
        changes = (seen - seen[:1])[were_played].double()
        variables.moments += torch.stack([changes.square().sum(), (changes != 0).sum()])
        squares, count = variables.moments.tolist()
        if count:
            for network in (variables.network, variables.averaged):
                network.log_scale.fill_(0.5 * math.log(squares / count))

    def _measure_answers(self, policy: acting.BehaviourPolicy, played: rounds.Round) -> None:
        """Keeps the beliefs in the greedy answers of a round, and which were right."""
        are_counted = policy.are_greedy & ~np.isnan(policy.beliefs)
        answered = np.stack([policy.beliefs, played.rewards.sum(axis=0) > 0], axis=1)[are_counted]
        kept = torch.cat([self.variables.outcomes, torch.from_numpy(answered).float()])
        self.variables.outcomes.copy_(kept[-_NUM_OUTCOMES:])

    def _calibration(self) -> dict[str, float]:
        beliefs, outcomes = self.variables.outcomes[self.variables.outcomes[:, 0] >= 0].T
        if not len(beliefs):
            return {"brier_score": math.nan, "calibration_error": math.nan}
        return {
            "brier_score": float((beliefs - outcomes).square().mean()),
            "calibration_error": losses.calibration_error(beliefs, outcomes),
        }

    def restore(self, tensors: Mapping[str, torch.Tensor]) -> None:
        """Takes up what `save` returned, and plays the kept episodes again to have their observations."""
        super().restore(tensors)
        self.variables.episodes.restore(self._play, self.next_episode)


def label_targets(
    episodes: rounds.Round, held_out_logits: torch.Tensor, num_interactions: int, config: config_lib.BeliefConfig
) -> tuple[torch.Tensor, torch.Tensor]:
    """Returns the targets of beliefs, probabilities [B, L], and the steps that are learned from, bool [T, B].

    The logits are those of the held-out members' beliefs, [T, B, L].
    """
    lengths, each = torch.from_numpy(episodes.lengths), torch.arange(len(episodes.lengths))
    last_actions = torch.from_numpy(episodes.actions)[lengths - 1, each]
    are_counted = torch.from_numpy(episodes.played)
    if config.answers_revealed:
        answers = torch.from_numpy(episodes.answers)
        labels = torch.nn.functional.one_hot(answers, held_out_logits.shape[-1]).float()
    else:
        answered = (last_actions - num_interactions).clamp(min=0)
        are_right = torch.from_numpy(episodes.rewards.sum(axis=0)) > 0
        labels = losses.label_posterior(held_out_logits[lengths - 1, each], answered, are_right)
        are_counted = are_counted & (last_actions >= num_interactions)
    return labels, are_counted if config.every_step else are_counted & _are_last(episodes)


def value_targets(
    episodes: rounds.Round, answering: torch.Tensor, interacting: torch.Tensor, best: torch.Tensor, discount: float
) -> torch.Tensor:
    """Returns the targets of the interactions taken, [T, B]; see `losses.interaction_targets`.

    They follow from the values of the best answers and of the best interactions, [T, B], by held-out members.
    """
    are_greedy = best == torch.from_numpy(episodes.actions)
    rewards = torch.from_numpy(episodes.rewards.sum(axis=0))
    are_last = _are_last(episodes)
    return losses.interaction_targets(answering, interacting, are_greedy, are_last, rewards, discount, _LAMBDA)


def _are_last(episodes: rounds.Round) -> torch.Tensor:
    """Returns the last step of each episode, bool [T, B]."""
    return torch.arange(len(episodes.actions))[:, None] == torch.from_numpy(episodes.lengths) - 1


def _padded(packed: torch.Tensor, played: torch.Tensor) -> torch.Tensor:
    """Returns packed steps, [N, ...], as [T, B, ...], 0 after an episode's end."""
    padded = packed.new_zeros((*played.shape, *packed.shape[1:]))
    padded[played.to(packed.device)] = packed
    return padded
