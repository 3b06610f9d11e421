"""The protocol of the score: the tasks, their instances and episodes, and the ideal experimenters to compare with.

All targets play the same instances: episode e of a task is the one with index e in an environment of a known seed. With
a secret key, see `instances`, each episode has a seed of its own.
"""

from collections.abc import Collection, Mapping, Sequence
import dataclasses
import functools
import re
from typing import Any

from dm_env import specs
import numpy as np

from physexp import suite
from physexp.agents import config as agent_config
from physexp.analysis import domains
from physexp.analysis.domains import base as domains_base
from physexp.analysis.domains.base import TRACKS
from physexp.analysis.ideal import base as ideal_base
from physexp.analysis.score import instances
from physexp.suite.engine import options as options_lib
from physexp.suite.engine import rules

VERSION = "v2"
FIRST_VERSION = "v1"
"""Its scores are read and verified, too: they count from another floor, and leave out domains."""
SEED = 2_000_003  # Of the environments, apart from those of training and of evaluation.
PUBLIC = instances.Public(SEED)
ENVIRONMENT_SEED = suite.environment_seed(SEED, 0)  # With it and an episode's index `suite.load` makes the instance.
EPISODES, QUICK_EPISODES = 1_000, 100  # Of each task.
MAX_EPISODES = 10_000


@dataclasses.dataclass(frozen=True, eq=False)
class Question:
    """The description of a task that an agent gets before it plays.

    Attributes:
      name: domain, task and the options that differ from the protocol's, as in `strings/features,difficulty=2`.
      domain, task: as for `suite.load`.
      options: its `task_kwargs` without the seed: those that differ from the domain's defaults.
      question: the question in words.
      description: the apparatus in words.
      observation_spec: specs of the observations, by name.
      observation_meanings: descriptions of the observations, by name.
      action_spec: the spec of an action.
      num_interactions: the number of interactions; they are the first actions, and answers follow.
      label_names: descriptions of the answers.
      action_names: descriptions of all actions.
      num_questions: the number of answers in an episode; only the last one ends it.
      step_limit: the maximum number of actions in an episode; the last one in time should be an answer.
      discount: gamma; a reward counts gamma to the power of the number of actions before it.
    """

    name: str
    domain: str
    task: str
    options: Mapping[str, Any]
    question: str
    description: str
    observation_spec: Mapping[str, specs.Array]
    observation_meanings: Mapping[str, str]
    action_spec: specs.DiscreteArray
    num_interactions: int
    label_names: tuple[str, ...]
    action_names: tuple[str, ...]
    num_questions: int
    step_limit: int
    discount: float

    @property
    def file_name(self) -> str:
        """The name in letters that files and data sets may have, as in `strings-features-difficulty-2`."""
        return re.sub(r"\W", "-", self.name)

    @property
    def num_actions(self) -> int:
        """The number of actions."""
        return self.action_spec.num_values


def question(domain: str, task: str, options: Mapping[str, Any] | None = None) -> Question:
    """Returns the question of a task with some options, its `task_kwargs`; the same object for the same question.

    Raises ValueError for an unknown name or value, and lists those that are allowed.
    """
    return _question(domain, task, tuple((options or {}).items()))


@functools.cache
def _question(domain: str, task: str, given: tuple[tuple[str, Any], ...]) -> Question:
    for name, value in given:
        if name == "random":
            raise ValueError(f"{name} is {value}; leave it out: all targets play the same instances")
    played, kind = suite.load_task(domain, task, {**dict(given), "random": 0}), suite.options(domain)
    options = _differences(played.options, kind(random=0))
    if (canonical := tuple(options.items())) != given:
        return _question(domain, task, canonical)
    shown = _differences(played.options, kind(random=0, **_of_protocol(domain)))
    return Question(
        name=f"{domain}/{task}" + "".join(f",{name}={agent_config.shown(value)}" for name, value in shown.items()),
        domain=domain,
        task=task,
        options=options,
        question=played.question,
        description=played.description,
        observation_spec=played.observation_spec(),
        observation_meanings=played.observation_meanings,
        action_spec=played.action_spec(),
        num_interactions=played.num_interactions,
        label_names=tuple(played.label_names),
        action_names=tuple(played.action_names),
        num_questions=played.rules.num_questions,
        step_limit=played.rules.step_limit,
        discount=played.discount,
    )


def _differences(chosen: suite.Options, usual: suite.Options) -> dict[str, Any]:
    """Returns the options that differ, in the order of their declaration."""
    names = [field.name for field in dataclasses.fields(chosen)]
    return {name: value for name in names if (value := getattr(chosen, name)) != getattr(usual, name)}


def _of_protocol(domain: str) -> Mapping[str, Any]:
    """Returns the options that names of tasks leave out."""
    return domains.find(domain).usual_options


def ideal(question: Question) -> ideal_base.Solution:
    """Returns the ideal experimenter of a task; raises ValueError if none is known."""
    known = _ideal(question)
    if known is None:
        raise ValueError(
            f"{question.name} has no score: no ideal experimenter is known that is exact there; choose from "
            f"{', '.join(one.name for one in in_tracks(TRACKS))}, without noise, variation and step_variation"
        )
    return known(question.task, question.options, question.discount)


def floor(question: Question, at_once: float, version: str = VERSION) -> float:
    """Returns the return that scores 0: the best one without looking, given that of the likeliest answers at once.

    In the first version it was the better of these answers and silence.
    """
    if version == FIRST_VERSION:
        return max(at_once, rules.WRONG * question.num_questions * question.discount ** (question.step_limit - 1))
    return ideal_base.floor(at_once, question.discount, question.step_limit - question.num_questions + 1)


def load(question: Question, seed: int = SEED) -> suite.Environment:
    """Returns the environment of a task, the first one of a batch with this seed; by default the public instances."""
    seeded = {**question.options, "random": suite.environment_seed(seed, 0)}
    return suite.load(question.domain, question.task, seeded)


def drawn(question: Question, num_episodes: int, which: instances.Instances = PUBLIC) -> np.ndarray:
    """Returns the hidden properties of the first episodes, [N, ...]."""
    seeds = np.array([which.seed_of(question.name, index) for index in range(num_episodes)])
    return suite.load_task(question.domain, question.task, question.options).draw(seeds, np.arange(num_episodes))


def named(names: Sequence[str]) -> tuple[Question, ...]:
    """Returns the questions of some names, `domain/task` or `domain/task,option=value,...`, each once.

    Raises ValueError for an unknown name or value.
    """
    known, found = {"/".join(names): names for names in suite.ALL_TASKS}, []
    for name in names:
        given, _, options = name.partition(",")
        if given not in known:
            raise ValueError(f"task is {given!r}; choose from {', '.join(known)}")
        domain, task = known[given]
        found.append(question(domain, task, {**_of_protocol(domain), **options_lib.parsed(options)}))
    return tuple(dict.fromkeys(found))


def in_tracks(names: Collection[str]) -> tuple[Question, ...]:
    """Returns the questions of some tracks, or of `all`, each once; raises ValueError for an unknown name."""
    found: list[Question] = []
    for name in TRACKS if "all" in names else names:
        if name not in TRACKS:
            raise ValueError(f"track is {name!r}; choose from {', '.join(TRACKS)}, all")
        for domain, task in suite.tagged("pixels" if name == "pixels" else "features"):
            found += [question(domain, task, options) for options in domains.find(domain).tracks.get(name, ())]
    return tuple(dict.fromkeys(found))


def is_judged(question: Question) -> bool:
    """Returns whether an ideal experimenter evaluates actions in a task."""
    return _ideal(question) is not None


def _ideal(question: Question) -> domains_base.Ideal | None:
    return domains.find(question.domain).ideal_with(question.options)
