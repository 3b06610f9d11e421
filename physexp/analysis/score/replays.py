"""Replays of an agent's costliest mistakes, as links to the page to play on (docs/page.md)."""

from collections.abc import Sequence
import dataclasses
from urllib import parse

import numpy as np
import pyarrow

from physexp import suite
from physexp.analysis.score import log, protocol

_MOST = 3  # Of a row.
_DIGITS = 9  # Of a cost: of equal ones, the first is linked on any machine.


@dataclasses.dataclass(frozen=True)
class Replay:
    """An episode with a mistake.

    Attributes:
      question: the task.
      episode: the number of the episode among the public instances.
      actions: those of the episode.
      kind: the kind of the mistake (`mistakes.KINDS`).
      cost: of the mistake, in discounted return.
    """

    question: protocol.Question
    episode: int
    actions: Sequence[int]
    kind: str
    cost: float

    @property
    def query(self) -> str:
        """The part of a link after the address of the page."""
        asked = {"task": self.question.name, "episode": self.episode, "actions": ",".join(map(str, self.actions))}
        return parse.urlencode(asked, safe="/,=")


def costliest(found: pyarrow.Table, questions: Sequence[protocol.Question]) -> list[Replay]:
    """Returns the costliest mistakes in a log, the worst first: one of a domain, on public instances from features."""
    of_domains: dict[str, Replay] = {}
    for question in questions:
        if "pixels" in suite.tags(question.domain, question.task):
            continue
        for replay in _costliest(log.of_task(found, question), question):
            known = of_domains.get(question.domain)
            if known is None or replay.cost > known.cost:
                of_domains[question.domain] = replay
    return sorted(of_domains.values(), key=lambda replay: -replay.cost)[:_MOST]


def _costliest(columns: dict[str, np.ndarray], question: protocol.Question) -> list[Replay]:
    """Returns the costliest mistake in a task; none without a mistake on a public instance."""
    costs = np.round(columns["regret"] * question.discount ** columns["step"].astype(float), _DIGITS)
    costs[columns["seed"] != protocol.ENVIRONMENT_SEED] = 0
    if not costs.any():
        return []
    place = int(costs.argmax())
    episode = int(columns["episode"][place])
    actions = columns["action"][columns["episode"] == episode].tolist()
    return [Replay(question, episode, actions, columns["mistake"][place], float(costs[place]))]
