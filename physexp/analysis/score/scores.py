"""Computes scores from the log: of each task, where the rest was lost, and over all domains.

A task's score is 0 for the best policy that does not look, and 1 for the optimum. Over the domains of a track it is
the mean, with a stratified bootstrap in which the episodes of each task are resampled; of several agents of one
configuration, with Student's interval.
"""

import collections
from collections.abc import Mapping, Sequence
import contextlib
import dataclasses
import functools
from typing import Any

import numpy as np
import pyarrow
from scipy import special, stats

from physexp.analysis.data import episodes, estimates
from physexp.analysis.ideal import mistakes
from physexp.analysis.score import instances, log, protocol
from physexp.suite.engine import rules

_RESAMPLES = 2_000
_TRIMMED = 0.25  # Share of the domains on either side of the first version's interquartile mean.


@dataclasses.dataclass(frozen=True)
class Reference:
    """Means over the first episodes of a task.

    Attributes:
      interactions: in an episode.
      gains: bits of information about the answer from the first interaction, the second and so on, 0 after the end of
        an episode, float64 [K].
    """

    interactions: float
    gains: np.ndarray


@functools.cache
def reference(
    question: protocol.Question, num_episodes: int, which: instances.Instances = protocol.PUBLIC
) -> Reference | None:
    """Plays instances with the ideal experimenter; returns None if it cannot play from the observations of the task.

    The hidden property determines how it plays, so it plays one episode of each.
    """
    solution = protocol.ideal(question)
    try:
        actor = solution.actor()
    except ValueError:
        return None
    drawn = protocol.drawn(question, num_episodes, which)
    _, first, counts = np.unique(drawn, axis=0, return_index=True, return_counts=True)
    with contextlib.closing(protocol.load(question)) as environment:
        played = [
            episodes.play(environment, actor, index, which.seed_of(question.name, index)) for index in first.tolist()
        ]
    taken = [one.actions < question.num_interactions for one in played]
    bits = [
        np.where(interacts, mistakes.information(solution.beliefs(one.hidden, one.actions)), 0.0)[:-1]
        for one, interacts in zip(played, taken, strict=True)
    ]
    longest = max(map(len, bits))
    padded = np.array([np.pad(each, (0, longest - len(each))) for each in bits])
    interactions = np.array([interacts.sum() for interacts in taken])
    return Reference(float(counts @ interactions / num_episodes), counts @ padded / num_episodes)


@dataclasses.dataclass(frozen=True)
class TaskScore:
    """The score of an agent on one task, from N episodes.

    Attributes:
      question: the task.
      scores: the score of each episode, without luck, float64 [N].
      means: means of the scores, of each of several agents, or else those of the bootstrap, float64 [M].
      num_agents: the number of agents, which play in turns.
      metrics: by name; the score and the mistakes sum to 1, the score and the luck to the raw score.
    """

    question: protocol.Question
    scores: np.ndarray
    means: np.ndarray
    num_agents: int
    metrics: Mapping[str, Any]


def of_log(
    found: pyarrow.Table,
    ideals: Mapping[protocol.Question, Reference | None],
    version: str = protocol.VERSION,
    num_agents: int = 1,
) -> list[TaskScore]:
    """Returns the scores of the tasks in a log, by a version of the protocol.

    `ideals` has the ideal's play of as many episodes where it is known. Several agents have played in turns.
    """
    parts = [(question, known, log.of_task(found, question)) for question, known in ideals.items()]
    played = [part for part in parts if len(part[2]["step"])]
    return [_of_task(*part, version, num_agents, seed) for seed, part in enumerate(played)]


def _of_task(
    question: protocol.Question,
    known: Reference | None,
    columns: Mapping[str, np.ndarray],
    version: str,
    num_agents: int,
    seed: int,
) -> TaskScore:
    """Returns the score of a task; `seed` draws its bootstrap."""
    first = columns["step"] == 0
    last = np.append(first[1:], True)
    index, num_episodes = np.cumsum(first) - 1, int(first.sum())
    are_answers = columns["action"] >= question.num_interactions
    factors = question.discount ** columns["step"].astype(float)
    ideal, at_once = (_mean(columns[name][first]) for name in ("value", "answering"))
    if question.num_questions > 1:  # The value of an answer has that of the questions after it.
        at_once = protocol.ideal(question).compared()["at_once"]
    floor = protocol.floor(question, at_once, version)

    def discounted(values: np.ndarray) -> np.ndarray:
        """Returns the sum of each episode, float64 [N]."""
        return np.bincount(index, factors * values)

    each = mistakes.costs(mistakes.Actions(*(columns[name] for name in log.ACTIONS)), are_answers, last)
    costs = {kind: discounted(cost) / (ideal - floor) for kind, cost in each.items()}
    scores = 1 - np.sum(list(costs.values()), axis=0)
    raw = (discounted(columns["reward"]) - floor) / (ideal - floor)
    answered, interactions = np.bincount(index, are_answers), np.bincount(index, ~are_answers)
    # A question that is not answered costs as much as a wrong answer.
    right = (np.bincount(index, columns["reward"]) + question.num_questions) // 2
    gains = np.bincount(columns["step"][~are_answers], columns["bits"][~are_answers]) / num_episodes
    means, raw_means = (_means(values, num_agents, seed) for values in (scores, raw))
    metrics = {
        "episodes": num_episodes,
        "ideal": ideal,
        "floor": floor,
        "at_once": at_once,
        "random": random_return(question),
        "score": float(scores.mean()),
        "interval": _interval(means, num_agents),
        "raw_score": float(raw.mean()),
        "raw_interval": _interval(raw_means, num_agents),
        "luck": float((raw - scores).mean()),
        "mistakes": {kind: float(cost.mean()) for kind, cost in costs.items()},
        "success_rate": float(right.mean() / question.num_questions),
        "timeouts": int((answered < question.num_questions).sum()),
        "mean_interactions": float(interactions.mean()),
        "ideal_interactions": known and known.interactions,
        "bits_per_interaction": float(gains.sum() * num_episodes / max(1, interactions.sum())),
        "ideal_bits_per_interaction": known and float(known.gains.sum() / (known.interactions or 1.0)),
        "gains": gains.tolist(),
        "ideal_gains": known and known.gains.tolist(),
    }
    return TaskScore(question, scores, means, num_agents, metrics)


def random_return(question: protocol.Question) -> float:
    """Returns the expected return of uniformly random actions; one of the L answers to each question is right."""
    num_labels = question.num_actions - question.num_interactions
    goes_on = question.num_interactions / question.num_actions
    steps, number = np.arange(question.step_limit), np.arange(question.num_questions)[:, None]  # Of answers given.
    answer = rules.WRONG + (rules.RIGHT - rules.WRONG) / num_labels
    odds = ((1 - goes_on) / goes_on) ** number
    answered = np.sum(special.comb(steps, number) * odds * (question.discount * goes_on) ** steps)
    unanswered = np.sum(special.comb(question.step_limit, number) * odds * (question.num_questions - number))
    given = answered * (1 - goes_on) * answer
    return float(given + question.discount ** steps[-1] * goes_on**question.step_limit * unanswered * rules.WRONG)


def summary(found: Sequence[TaskScore], version: str = protocol.VERSION) -> dict[str, Any]:
    """Returns the metrics of all tasks, at least one, and over the tasks, by a version of the protocol.

    They are the `tracks` of which two tasks were played, or all; in the first version, `domains` and the `whole`.
    """
    tasks = {one.question.name: one.metrics for one in found}
    if version == protocol.FIRST_VERSION:
        return {"tasks": tasks, **_interquartile(found)}
    return {"tasks": tasks, "tracks": over_tracks(found, 2)}


def over_tracks(found: Sequence[TaskScore], least: int = 1) -> dict[str, dict[str, Any]]:
    """Returns the scores over the domains of all tracks of which a number of tasks was played, or all; see `over`."""
    tracks = {}
    for name in protocol.TRACKS:
        of_track = protocol.in_tracks([name])
        played = [one for one in found if one.question in of_track]
        if len(played) >= min(least, len(of_track)):
            tracks[name] = over(played, of_track)
    return tracks


def headlines(found: Mapping[str, Any]) -> Mapping[str, Mapping[str, Any]]:
    """Returns the figures that sum up a `score.json`, by name: those of its tracks; without any, those of its tasks."""
    return found["tracks"] or found["tasks"] if "tracks" in found else {"all domains": found["whole"]}


def over(found: Sequence[TaskScore], questions: Sequence[protocol.Question]) -> dict[str, Any]:
    """Returns the score over the domains of a track.

    It has the mean over the domains, `score`, with its `interval`; the domain with the smallest score and that score,
    `worst`; the numbers of domains that were `played` in all tasks, and `of` the track; and the `domains`, each with
    its score, its interval, and numbers of tasks.

    Args:
      found: the scores of the tasks that were played.
      questions: all tasks of the track, at least one; the score of a task that was not played is 0.
    """
    played, parts = {one.question for one in found}, _by_domain(found, questions)
    interval = functools.partial(_interval, num_agents=found[0].num_agents)
    domains = {}
    for name, (mean, means) in parts.items():
        own = [question for question in questions if question.domain == name]
        domains[name] = {"score": mean, "interval": interval(means), "played": len(played & {*own}), "of": len(own)}
    worst = min(parts, key=lambda name: parts[name][0])
    return {
        "score": float(np.mean([mean for mean, _ in parts.values()])),
        "interval": interval(np.mean([means for _, means in parts.values()], axis=0)),
        "worst": {worst: parts[worst][0]},
        "played": sum(one["played"] == one["of"] for one in domains.values()),
        "of": len(domains),
        "domains": domains,
    }


def _by_domain(
    found: Sequence[TaskScore], questions: Sequence[protocol.Question]
) -> dict[str, tuple[float, np.ndarray]]:
    """Returns the mean score of the tasks of each domain, 0 for each that is not found; and the same of the `means`."""
    played = {one.question: (one.scores.mean(), one.means) for one in found}
    of_tasks = collections.defaultdict(list)
    for question in questions:
        of_tasks[question.domain].append(played.get(question, (0.0, np.zeros_like(found[0].means))))
    return {
        name: (float(np.mean([mean for mean, _ in parts])), np.mean([means for _, means in parts], axis=0))
        for name, parts in of_tasks.items()
    }


def _interquartile(found: Sequence[TaskScore]) -> dict[str, Any]:
    """Returns the first version's scores of the domains and over them: the interquartile mean."""
    parts = _by_domain(found, [one.question for one in found])
    scores, means = zip(*parts.values(), strict=True)
    return {
        "domains": {name: {"score": mean, "interval": _interval(drawn)} for name, (mean, drawn) in parts.items()},
        "whole": {
            "score": float(stats.trim_mean(scores, _TRIMMED)),
            "interval": _interval(stats.trim_mean(means, _TRIMMED, axis=0)),
        },
    }


def _means(values: np.ndarray, num_agents: int, seed: int) -> np.ndarray:
    """Returns the means of values, [N], of agents in turns, float64 [num_agents]; of one, those of the bootstrap."""
    if num_agents > 1:
        return np.array([values[number::num_agents].mean() for number in range(num_agents)])
    generator = np.random.default_rng(seed)
    return np.array([values[generator.integers(len(values), size=len(values))].mean() for _ in range(_RESAMPLES)])


def _mean(values: np.ndarray) -> float:
    """Returns the mean of values, [N], to the last bit if all are equal."""
    return float(values[0] + (values - values[0]).mean())


def _interval(means: np.ndarray, num_agents: int = 1) -> list[float]:
    """Returns the ends of the 95 % interval: Student's of the means of several agents, or that of the bootstrap."""
    if num_agents > 1:
        found = estimates.mean(means)
        return [found.low, found.high]
    return [float(end) for end in np.quantile(means, [0.025, 0.975])]
