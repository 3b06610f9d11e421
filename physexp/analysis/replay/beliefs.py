"""What could be believed: by an agent, and by an ideal experimenter that has seen the same."""

import numpy as np

from physexp.analysis.ideal import which_is_heavier as ideal
from physexp.analysis.replay import recording
from physexp.suite.domains import which_is_heavier


def of_policy(policies: np.ndarray, num_interactions: int) -> np.ndarray:
    """Returns the policies [T, A] restricted to the labels and renormalized, float64 [T, L]."""
    answers = policies[:, num_interactions:]
    return answers / answers.sum(axis=1, keepdims=True)


def _heaviest(episode: recording.Episode) -> np.ndarray:
    """Returns how likely each block is the heaviest, to who has seen what the pokes reveal: [T + 1, num_blocks]."""
    known = np.full((len(episode.actions) + 1, len(episode.hidden)), np.nan)
    for step, action in enumerate(episode.actions):
        if action < len(episode.hidden):
            known[step + 1 :, action] = episode.hidden[action]
    difficulty = episode.task_kwargs.get("difficulty", which_is_heavier.Options.difficulty)
    return ideal.posterior(known, difficulty)


_IDEAL = {"which_is_heavier": _heaviest}


def of_ideal(episode: recording.Episode) -> np.ndarray | None:
    """Returns what an ideal experimenter would believe in an episode of T actions, [T + 1, L], where that is known."""
    return _IDEAL[episode.domain](episode) if episode.domain in _IDEAL else None
