"""How the belief learner acts while it learns."""

import numpy as np
import torch

from physexp.agents import acting, starting
from physexp.agents.belief import config as config_lib
from physexp.agents.belief import networks

_RANDOM_ANSWERS = 0.1  # Share of the answers that are drawn from all labels alike.
_LEAST = 1 / 30  # How much is explored where least is, of what is explored where most is.


class Explorer:
    """Acts in one round of episodes: greedily in the first of them, and so as to learn in the others.

    There some interactions are drawn at random, in some environments more than in others (Horgan et al., 2018); some
    episodes are answered after a number of interactions that was drawn; and answers are drawn from the belief, some of
    them from all labels alike: a label that is never answered is never found to be right.

    Attributes:
      are_greedy: which episodes it plays greedily, bool [B].
      beliefs: the belief in the answer that each episode ended with, float64 [B]; NaN where it has none.
    """

    def __init__(
        self,
        network: networks.BeliefNetwork,
        config: config_lib.BeliefConfig,
        number: int,
    ):
        """Draws, for the round `number`, the most interactions of each of its episodes."""
        num_environments, generator = config.num_environments, starting.round_generator(config.seed, 0, number)
        self.beliefs = np.full(num_environments, np.nan)
        self._network, self._generator = network, generator
        self.are_greedy = np.arange(num_environments) < round(config.greedy * num_environments)
        self._exploration = np.zeros(num_environments)
        self._exploration[~self.are_greedy] = config.exploration * np.geomspace(
            1, _LEAST, int((~self.are_greedy).sum())
        )
        is_cut = (generator.random(num_environments) < config.cut) & ~self.are_greedy
        drawn = generator.integers(config.most_interactions + 1, size=num_environments)
        self._most = np.where(is_cut, drawn, config.most_interactions)

    def choose(self, logits: torch.Tensor, active: np.ndarray, step: int) -> np.ndarray:
        """Returns actions; see `acting.Choose`."""
        generator, num_interactions = self._generator, self._network.num_interactions
        worths = self._network.worths(logits).cpu().numpy().astype(np.float64)
        interacting, answering = worths[:, :num_interactions], worths[:, num_interactions:]
        is_greedy = self.are_greedy[active]
        is_random = generator.random(len(worths)) < self._exploration[active]
        drawn = generator.integers(num_interactions, size=len(worths))
        interactions = np.where(is_random, drawn, interacting.argmax(1))
        beliefs = (answering + 1) / 2
        shares = (1 - _RANDOM_ANSWERS) * beliefs + _RANDOM_ANSWERS / beliefs.shape[1]
        labels = np.where(is_greedy, beliefs.argmax(1), acting.draw(shares, generator))
        is_over = step >= self._most[active]
        is_enough = (answering.max(1) >= interacting.max(1)) & ~is_random
        is_answer = is_over | is_enough
        self.beliefs[active] = np.where(is_answer, beliefs[np.arange(len(beliefs)), labels], np.nan)
        return np.where(is_answer, num_interactions + labels, interactions)
