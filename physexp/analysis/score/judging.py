"""What an ideal experimenter says of the actions of episodes, each that comes again asked once."""

import functools

import numpy as np

from physexp.analysis.ideal import base as ideal_base
from physexp.analysis.ideal import mistakes
from physexp.analysis.score import episodes

_KEPT = 8192  # Judgements; of a finite question, the same episode comes often.


class Judge:
    """Judges episodes by what is hidden and what was done, from which a judgement follows."""

    def __init__(self, solution: ideal_base.Solution):
        """Takes the ideal experimenter."""
        self._solution = solution
        self._judged = functools.lru_cache(_KEPT)(self._judge)

    def __call__(self, episode: episodes.Episode) -> mistakes.Actions:
        """Returns what is said of the actions of an episode.

        Raises:
          ValueError: if it cannot be known.
        """
        hidden = np.asarray(episode.hidden)
        return self._judged(hidden.dtype.str, hidden.shape, hidden.tobytes(), tuple(episode.actions.tolist()))

    def _judge(self, dtype: str, shape: tuple[int, ...], hidden: bytes, actions: tuple[int, ...]) -> mistakes.Actions:
        taken = np.array(actions, np.int64)
        episode = episodes.Episode(np.frombuffer(hidden, dtype).reshape(shape), taken, np.zeros(len(taken)), [])
        return mistakes.actions(self._solution.judge(episode), taken)
