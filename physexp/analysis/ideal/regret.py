"""What an agent's actions cost against the ideal experimenter of things of which one is different, action by action.

Expected discounted return is the ideal's value minus the expected sum of what each action was worse than the best one,
given what was known then: discount^t (V - Q(action)). So the gap to the ideal splits into kinds of mistakes.
"""

from collections.abc import Sequence

import numpy as np

from physexp.analysis.ideal import odd_one_out

KINDS = ("again", "needless", "early", "against", "timeout")
"""Touched a thing that was known; touched another when answering was better; answered when another touch was better;
gave another answer than the likeliest; never answered."""


def regrets(
    solution: odd_one_out.Solution, values: np.ndarray, actions: Sequence[np.ndarray], out_of_time: np.ndarray
) -> dict[str, np.ndarray]:
    """Returns what each episode's mistakes cost.

    Args:
      solution: the ideal experimenter.
      values: of the things, float64 [N, K].
      actions: the actions of each episode, N arrays int64 [length].
      out_of_time: whether an episode ended unanswered, bool [N].

    Returns:
      For each of `KINDS` the discounted cost, float64 [N].
    """
    size, num_things = values.shape
    cost = {kind: np.zeros(size) for kind in KINDS}
    known = np.full(values.shape, np.nan)
    lengths = np.array([len(taken) for taken in actions])
    for t in range(lengths.max(initial=0)):
        rows = np.flatnonzero(lengths > t)
        taken = np.array([actions[int(row)][t] for row in rows])
        answer, touch = solution.values(known[rows])
        best, factor = np.maximum(answer, touch), solution.discount**t
        touching = taken < num_things
        last = touching & out_of_time[rows] & (lengths[rows] == t + 1)
        cost["timeout"][rows[last]] += factor * (best[last] + 1)  # Its reward is that of a wrong answer.
        again = np.zeros(len(rows), bool)
        again[touching] = ~np.isnan(known[rows[touching], taken[touching]])
        repeated, fresh = touching & again & ~last, touching & ~again & ~last
        cost["again"][rows[repeated]] += factor * (1 - solution.discount) * best[repeated]
        cost["needless"][rows[fresh]] += factor * (best - touch)[fresh]
        chances = odd_one_out.posterior(known[rows[~touching]], solution.prior)
        given = 2 * chances[np.arange(len(chances)), taken[~touching] - num_things] - 1
        cost["early"][rows[~touching]] += factor * (best - answer)[~touching]
        cost["against"][rows[~touching]] += factor * (answer[~touching] - given)
        known[rows[touching], taken[touching]] = values[rows[touching], taken[touching]]
    return cost
