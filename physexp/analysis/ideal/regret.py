"""What an agent's actions cost against the ideal experimenter of Which is Heavier, action by action.

Expected discounted return is the ideal's value minus the expected sum of what each action was worse than the best one,
given what was known then: discount^t (V - Q(action)). So the gap to the ideal splits into kinds of mistakes.
"""

from collections.abc import Sequence

import numpy as np

from physexp.analysis.ideal import which_is_heavier

KINDS = {
    "again": "poked a block that was known",
    "needless": "poked another block when answering was better",
    "early": "answered when another poke was better",
    "against": "gave another answer than the likeliest",
    "timeout": "never answered",
}


def regrets(
    solution: which_is_heavier.Solution, masses: np.ndarray, actions: Sequence[np.ndarray], out_of_time: np.ndarray
) -> dict[str, np.ndarray]:
    """What each episode's mistakes cost.

    Args:
      solution: the ideal experimenter.
      masses: of the blocks, on the paper's scale, float64 [N, num_blocks].
      actions: the actions of each episode, N arrays int64 [length].
      out_of_time: whether an episode ended unanswered, bool [N].

    Returns:
      For each of `KINDS` the discounted cost, float64 [N].
    """
    size, blocks = masses.shape
    cost = {kind: np.zeros(size) for kind in KINDS}
    known = np.full(masses.shape, np.nan)
    lengths = np.array([len(taken) for taken in actions])
    for t in range(lengths.max(initial=0)):
        rows = np.flatnonzero(lengths > t)
        taken = np.array([actions[int(row)][t] for row in rows])
        answer, poke = solution.values(known[rows])
        best, factor = np.maximum(answer, poke), solution.discount**t
        poking = taken < blocks
        last = poking & out_of_time[rows] & (lengths[rows] == t + 1)
        cost["timeout"][rows[last]] += factor * (best[last] + 1)  # Its reward is that of a wrong answer.
        again = np.zeros(len(rows), bool)
        again[poking] = ~np.isnan(known[rows[poking], taken[poking]])
        repeated, fresh = poking & again & ~last, poking & ~again & ~last
        cost["again"][rows[repeated]] += factor * (1 - solution.discount) * best[repeated]
        cost["needless"][rows[fresh]] += factor * (best - poke)[fresh]
        chances = which_is_heavier.posterior(known[rows[~poking]], solution.difficulty)
        given = 2 * chances[np.arange(len(chances)), taken[~poking] - blocks] - 1
        cost["early"][rows[~poking]] += factor * (best - answer)[~poking]
        cost["against"][rows[~poking]] += factor * (answer[~poking] - given)
        known[rows[poking], taken[poking]] = masses[rows[poking], taken[poking]]
    return cost
