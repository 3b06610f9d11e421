"""The variables of the belief learner, and the choice of the agent among its networks."""

import copy
import math

import torch

from physexp.agents import learning
from physexp.agents.belief import networks, replay

_WEIGHT_DECAY = 0.02  # Each step of Adam shrinks the weights, but not the biases, by this times the learning rate.
_NUM_OUTCOMES = 1024  # Answers that calibration is measured on.
_WINDOW = 512  # Greedy episodes between two comparisons with the best.


class Variables(learning.Variables[networks.BeliefNetwork]):
    """All that training changes; `network` is the one that learns.

    Attributes:
      averaged: the network that acts during training, a moving average.
      best: the averaged network when it played best.
      agent: the result of training: the averaged network, or the best one if the averaged one has become worse.
      episodes: the last episodes played.
      moments: of the changes of inputs, the sum of squares and the count, float64 [2].
      outcomes: of the last greedy answers, the belief in them and whether they were right, float32 [N, 2]; -1 for none.
      scores: of greedy episodes, the mean return of the best window and its variance; the number of episodes in the
        current window, their sum of returns and of squares; and whether the last window was worse than the best,
        float64 [6].
    """

    def __init__(self, network: networks.BeliefNetwork, episodes: replay.Replay):
        """Gives a network an optimizer, its averages, and a memory of episodes."""
        super().__init__(network, weight_decay=_WEIGHT_DECAY)
        self.averaged, self.best, self.agent = (copy.deepcopy(network) for _ in range(3))
        self.episodes = episodes
        self.moments = torch.zeros(2, dtype=torch.float64)
        self.outcomes = torch.full((_NUM_OUTCOMES, 2), -1.0)
        self.scores = torch.tensor([-1.0, 0, 0, 0, 0, 0], dtype=torch.float64)

    def tensors(self) -> dict[str, torch.Tensor]:
        """Returns everything, by name; the agent's variables are under `network/`."""
        named = {name.replace("network/", "trained/", 1): value for name, value in super().tensors().items()}
        for prefix, network in (("averaged", self.averaged), ("best", self.best), ("network", self.agent)):
            named |= {f"{prefix}/{name}": value for name, value in network.state_dict().items()}
        own = {"moments": self.moments, "outcomes": self.outcomes, "scores": self.scores}
        return {**named, **own, "episodes/actions": self.episodes.actions}

    def add_outcomes(self, answered: torch.Tensor) -> None:
        """Keeps the newest greedy answers, [n, 2], in place of the oldest."""
        self.outcomes.copy_(torch.cat([self.outcomes, answered.float()])[-_NUM_OUTCOMES:])

    def compare(self, returns: torch.Tensor) -> None:
        """Adds the returns of greedy episodes; keeps the averaged network if they complete the best window so far."""
        best, variance, count, total, squares, _ = self.scores.tolist()
        count += len(returns)
        total += float(returns.sum())
        squares += float(returns.square().sum())
        if count < _WINDOW:
            self.scores[2:5] = torch.tensor([count, total, squares], dtype=torch.float64)
            return
        mean = total / count
        own_variance = max(0.0, squares / count - mean**2) / count  # Equal returns round to less than 0.
        # Two standard errors: a difference within them is luck.
        is_worse = mean < best - 2 * math.sqrt(variance + own_variance)
        if mean > best:
            best, variance = mean, own_variance
            self.best.load_state_dict(self.averaged.state_dict())
        self.scores.copy_(torch.tensor([best, variance, 0, 0, 0, is_worse], dtype=torch.float64))

    def update_agent(self) -> None:
        """Sets `agent` to the averaged network, or to the best one."""
        chosen = self.best if self.scores[-1] else self.averaged
        self.agent.load_state_dict(chosen.state_dict())
