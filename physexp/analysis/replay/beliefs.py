"""What could be believed: by an agent, and by an ideal experimenter that has seen the same."""

import numpy as np

from physexp.analysis.ideal import which_is_heavier as ideal
from physexp.analysis.replay import recording
from physexp.suite.domains import which_is_heavier


def of_policy(policies: np.ndarray, num_interactions: int) -> np.ndarray:
    """The policies [T, A] restricted to the labels and renormalized, float64 [T, L]."""
    answers = policies[:, num_interactions:]
    return answers / answers.sum(axis=1, keepdims=True)


def _heaviest(episode: recording.Episode) -> np.ndarray:
    """How likely each block is to be the heaviest, to who has seen what the pokes reveal: [T + 1, num_blocks]."""
    known = np.full((len(episode.actions) + 1, len(episode.hidden)), np.nan)
    for step, action in enumerate(episode.actions):
        if action < len(episode.hidden):
            known[step + 1 :, action] = episode.hidden[action]
    difficulty = episode.task_kwargs.get("difficulty", which_is_heavier.Options.difficulty)
    return ideal.posterior(known, difficulty)


IDEAL = {"which_is_heavier": _heaviest}
"""For each domain where it is known, the ideal experimenter's belief, [T + 1, L], in an episode of T actions."""
