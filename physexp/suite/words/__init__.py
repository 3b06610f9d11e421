"""Episodes in words, for language models: the methods of an episode are tools of any framework as they are.

::

    episode = words.Episode(suite.load("strings", "features"))
    print(episode.rules())
    print(episode.experiment(0))
    print(episode.answer(3))
"""

from physexp.suite.words.episode import LEAST_BELIEF, TOOLS, Episode, Refusal, distribution
from physexp.suite.words.telling import LEVELS

__all__ = ["LEAST_BELIEF", "LEVELS", "TOOLS", "Episode", "Refusal", "distribution"]
