"""The protocol of the score: the tasks, their instances and episodes, and the ideal experimenters to compare with.

All targets play the same instances: episode e of a task is the one with index e in the environment of one seed.
"""

from collections.abc import Mapping, Sequence
import dataclasses
import functools

from dm_env import specs
import numpy as np

from physexp import suite
from physexp.analysis import domains
from physexp.analysis.ideal import base as ideal_base

VERSION = "v1"
SEED = 2_000_003  # Of the environments, apart from those of training and of evaluation.
ENVIRONMENT_SEED = suite.environment_seed(SEED, 0)  # With it and an episode's index `suite.load` makes the instance.
EPISODES, QUICK_EPISODES = 1_000, 100  # Of each task.
MAX_EPISODES = 10_000


@dataclasses.dataclass(frozen=True, eq=False)
class Question:
    """The description of a task that an agent gets before it plays.

    Attributes:
      domain, task: as for `suite.load`.
      question: the question in words.
      observation_spec: specs of the observations, by name.
      observation_meanings: descriptions of the observations, by name.
      action_spec: the spec of an action.
      num_interactions: the number of interactions; they are the first actions, and answers follow.
      label_names: descriptions of the answers.
      action_names: descriptions of all actions.
      step_limit: the maximum number of actions in an episode; the last one in time should be an answer.
      discount: gamma; an episode counts gamma to the power of (number of actions - 1), times its reward.
    """

    domain: str
    task: str
    question: str
    observation_spec: Mapping[str, specs.Array]
    observation_meanings: Mapping[str, str]
    action_spec: specs.DiscreteArray
    num_interactions: int
    label_names: tuple[str, ...]
    action_names: tuple[str, ...]
    step_limit: int
    discount: float

    @property
    def name(self) -> str:
        """Domain and task, as in `towers/fist_features`."""
        return f"{self.domain}/{self.task}"

    @property
    def num_actions(self) -> int:
        """The number of actions."""
        return self.action_spec.num_values


@functools.cache
def question(domain: str, task: str) -> Question:
    """Returns the question of a task; raises ValueError for an unknown name and lists the known ones."""
    played = suite.load_task(domain, task)
    return Question(
        domain=domain,
        task=task,
        question=played.question,
        observation_spec=played.observation_spec(),
        observation_meanings=played.observation_meanings,
        action_spec=played.action_spec(),
        num_interactions=played.num_interactions,
        label_names=tuple(played.label_names),
        action_names=tuple(played.action_names),
        step_limit=played.rules.step_limit,
        discount=played.discount,
    )


def ideal(question: Question) -> ideal_base.Solution:
    """Returns the ideal experimenter of a task; raises ValueError if none is known."""
    known = domains.find(question.domain)
    if known.ideal is None:
        raise ValueError(
            f"{question.name} has no score: no ideal experimenter is known; "
            f"choose from {', '.join(one.name for one in observing('all'))}"
        )
    return known.ideal(question.task, {}, question.discount)


def load(question: Question, seed: int = SEED) -> suite.Environment:
    """Returns the environment of a task, the first one of a batch with this seed."""
    return suite.load(question.domain, question.task, {"random": suite.environment_seed(seed, 0)})


def drawn(question: Question, num_episodes: int) -> np.ndarray:
    """Returns the hidden properties of the first episodes, [N, ...]."""
    seeds = np.full(num_episodes, ENVIRONMENT_SEED)
    return suite.load_task(question.domain, question.task).draw(seeds, np.arange(num_episodes))


def named(names: Sequence[str]) -> tuple[Question, ...]:
    """Returns the questions of tasks, `domain/task`, each once; raises ValueError for an unknown name."""
    known = {f"{domain}/{task}": (domain, task) for domain, task in suite.ALL_TASKS}
    unknown = [name for name in names if name not in known]
    if unknown:
        raise ValueError(f"task is {unknown[0]!r}; choose from {', '.join(known)}")
    return tuple(question(*known[name]) for name in dict.fromkeys(names))


def observing(kind: str) -> tuple[Question, ...]:
    """Returns the questions of the protocol's tasks that observe `features`, `pixels`, or, for `all`, either."""
    names = suite.ALL_TASKS if kind == "all" else suite.tagged(kind)
    return tuple(
        question(domain, task) for domain, task in names if is_judged(domain) and domains.find(domain).is_in_protocol
    )


def is_judged(domain: str) -> bool:
    """Returns whether an ideal experimenter evaluates actions in the tasks of a domain."""
    return domains.find(domain).ideal is not None
