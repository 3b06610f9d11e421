"""The behaviour policy of the belief learner."""

import numpy as np

from physexp.agents import acting, networks, starting
from physexp.agents.belief import config as config_lib

_EVAL_FRACTION = 0.25  # Share of the episodes that are played greedily; they measure how well the agent plays.
_EARLY_STOP_FRACTION = 0.5  # Share of the others that are answered after a random number of interactions.
_RANDOM_START_FRACTION = 0.25  # Share of the others that begin with a random interaction, with random starts.
_EPSILON_MAX = 0.6  # Share of random interactions in the environment that explores most.
_EPSILON_RATIO = 1 / 30  # Of the smallest to the largest epsilon.
_RANDOM_ANSWERS = 0.1  # Share of the answers that are drawn uniformly.


class BehaviourPolicy:
    """Chooses the actions of one round: greedily in the first episodes, and exploring in the others.

    There some interactions are drawn at random, in some environments more than in others (Horgan et al., 2018); some
    episodes are answered after a random number of interactions; and answers are drawn from the belief, some of them
    uniformly: a label that is never answered is never found to be right. With `random_starts`, some episodes begin with
    a random interaction, and so show how to go on after each (exploring starts: Sutton & Barto, 2018, Section 5.3).

    Attributes:
      are_greedy: which episodes it plays greedily, bool [B].
      beliefs: the belief in the answer that each episode ended with, float64 [B]; NaN if it had no answer.
    """

    def __init__(self, num_interactions: int, longest: int, seed: int, number: int, *, random_starts: bool = False):
        """Draws, for the round `number`, the maximum of interactions of each of its episodes, `longest` or fewer."""
        size, generator = config_lib.NUM_ENVIRONMENTS, starting.round_generator(seed, 0, number)
        self.beliefs = np.full(size, np.nan)
        self._num_interactions, self._generator = num_interactions, generator
        self.are_greedy = np.arange(size) < round(_EVAL_FRACTION * size)
        num_exploring = int((~self.are_greedy).sum())
        self._epsilons = np.zeros(size)
        self._epsilons[~self.are_greedy] = _EPSILON_MAX * np.geomspace(1, _EPSILON_RATIO, num_exploring)
        stops_early = (generator.random(size) < _EARLY_STOP_FRACTION) & ~self.are_greedy
        drawn = generator.integers(longest + 1, size=size)
        self._max_interactions = np.where(stops_early, drawn, longest)
        self._starts_at_random = np.zeros(size, bool)
        if random_starts:
            self._starts_at_random = (generator.random(size) < _RANDOM_START_FRACTION) & ~self.are_greedy

    def choose(self, output: networks.Output, active: np.ndarray, step: int) -> np.ndarray:
        """Returns actions; see `acting.Choose`."""
        assert output.action_values is not None
        generator, num_interactions = self._generator, self._num_interactions
        values = output.action_values.cpu().numpy().astype(np.float64)
        interacting, answering = values[:, :num_interactions], values[:, num_interactions:]
        is_random = generator.random(len(values)) < self._epsilons[active]
        if step == 0:
            is_random |= self._starts_at_random
        drawn = generator.integers(num_interactions, size=len(values))
        interactions = np.where(is_random, drawn, interacting.argmax(1))
        beliefs = (answering + 1) / 2
        probabilities = (1 - _RANDOM_ANSWERS) * beliefs + _RANDOM_ANSWERS / beliefs.shape[1]
        labels = np.where(self.are_greedy[active], beliefs.argmax(1), acting.draw(probabilities, generator))
        is_sure = (answering.max(1) >= interacting.max(1)) & ~is_random
        is_answer = (step >= self._max_interactions[active]) | is_sure
        self.beliefs[active] = np.where(is_answer, beliefs[np.arange(len(beliefs)), labels], np.nan)
        return np.where(is_answer, num_interactions + labels, interactions)
