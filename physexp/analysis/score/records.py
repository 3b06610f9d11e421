"""Records of play by people, language models and others: reads them, plays them again in Python, and judges them.

A record is a line of JSON: `player`, `task`, `seed` (of the environment; the `key_hash` of private instances instead),
`episode`, `actions`, `times` (ms, one for each action), and further fields: `beliefs`, for instance, one before each
action, the probabilities of all answers or null. Records come in any order, of any seeds and
episodes, and of several players.
"""

from collections import Counter, defaultdict
from collections.abc import Callable, Mapping, Sequence
import contextlib
import dataclasses
import json
from pathlib import Path
from typing import Any

import numpy as np

from physexp import checks, suite
from physexp.agents import environment_loop
from physexp.analysis.data import episodes
from physexp.analysis.ideal import mistakes
from physexp.analysis.score import beliefs, instances, judging, log, protocol, scores, targets
from physexp.suite import words
from physexp.suite.engine import seeding

FACTS = ("player", "harness", "tools", "budget", "level", "digits")
"""Fields that tell how a player played, if a record has them."""

_LARGEST = 2**28  # Bytes of a file.


@dataclasses.dataclass(frozen=True)
class Record:
    """An episode that was played.

    Attributes:
      player: its player.
      question: its task.
      seed, episode: of its environment, and its index there.
      actions: its actions.
      facts: those of its `FACTS` that it has.
      stated: its beliefs.
      told: amounts that it has spent, by name.
      place: file and line, for messages.
    """

    player: str
    question: protocol.Question
    seed: int
    episode: int
    actions: tuple[int, ...]
    facts: Mapping[str, Any]
    stated: beliefs.Stated
    told: Mapping[str, float]
    place: str


def read(path: Path, private: instances.Private | None = None) -> tuple[list[Record], int]:
    """Returns the first record of each player, task and instance, and the number of the others.

    All are of the private instances, if some are given. Raises ValueError for a file without records, and for the first
    line that is none.
    """
    if path.stat().st_size > _LARGEST:
        raise ValueError(f"{path} has more than {_LARGEST:,} bytes; give parts of it")
    found: dict[Any, Record] = {}
    lines = [(number, line) for number, line in enumerate(path.read_bytes().splitlines(), 1) if line.strip()]
    for number, line in lines:
        record = parse(f"{path}, line {number}", line, private)
        found.setdefault((record.player, record.question, record.seed, record.episode), record)
    if not found:
        raise ValueError(f"{path} has no records; give a file with a line of JSON for each episode")
    return list(found.values()), len(lines) - len(found)


def parse(place: str, line: bytes, private: instances.Private | None = None) -> Record:
    """Returns the record of a line from a place, for messages; raises ValueError for a line that is none."""
    try:
        fields = json.loads(line)
    except (ValueError, RecursionError):
        fields = None
    if not isinstance(fields, dict):
        raise ValueError(f"{place} is no object of JSON; was the file cut off?")
    fields = {"told": {}, **fields}
    for name, kind in {"player": str, "task": str, "actions": list, "told": dict}.items():
        if not isinstance(fields.get(name), kind):
            raise ValueError(f"{place}: {name} is {checks.shown(fields.get(name))}; give a {kind.__name__}")
    count = len(fields["actions"])
    fields.setdefault("beliefs", [None] * count)
    for name in ("times", "beliefs"):
        if not isinstance(given := fields.get(name), list) or len(given) != count:
            raise ValueError(f"{place}: {name} is {checks.shown(given)}; give a list of {count}, one for each action")
    if (given := fields.get("key_hash")) != (private and private.key_hash):
        wanted = "give their --instances FILE" if private is None else f"that of the instances is {private.key_hash}"
        raise ValueError(f"{place}: key_hash, which names private instances, is {checks.shown(given)}; {wanted}")
    try:
        (question,) = protocol.named([fields["task"]])
        episode = checks.integer("episode", fields.get("episode"), 0, seeding.LAST_EPISODE)
        allowed = question.num_actions - 1
        actions = tuple(checks.integer("an action", action, 0, allowed) for action in fields["actions"])
        given = fields.get("seed") if private is None else private.seed_of(question.name, episode)
        seed = checks.integer("seed", given, 0, seeding.LARGEST_SEED)
        stated = {
            step: words.distribution(given, len(question.label_names))
            for step, given in enumerate(fields["beliefs"])
            if given is not None
        }
        told = {name: checks.at_least(0)(f"told {name}", amount) for name, amount in fields["told"].items()}
    except ValueError as error:
        raise ValueError(f"{place}: {error}") from None
    facts = {name: fields[name] for name in FACTS if name in fields}
    return Record(fields["player"], question, seed, episode, actions, facts, stated, told, place)


def target(path: Path, which: instances.Instances, count: int) -> targets.Target:
    """Returns the one player of a file as a target, which plays its first episodes of some instances again.

    Raises ValueError as `read` and `score` do, for records of several players, and for a record that is missing.
    """
    found, _ = read(path, which if isinstance(which, instances.Private) else None)
    for record in found:
        if record.facts != found[0].facts:
            raise ValueError(f"{record.place} is of another player, or of other facts about it; give a file of one")
    asked = tuple(dict.fromkeys(record.question for record in found))
    known = {(record.question, record.seed, record.episode): record for record in found}
    chosen: dict[tuple[protocol.Question, int], Record] = {}
    for question in asked:
        with contextlib.closing(protocol.load(question)) as environment:
            for index in range(count):
                key = question, which.seed_of(question.name, index), index
                if key not in known:
                    raise ValueError(
                        f"{path} has no record of episode {index} of {question.name} in these instances; play it, or "
                        "give fewer --episodes"
                    )
                _played(environment, known[key])
                chosen[question, index] = known[key]
    told: Counter[str] = Counter()
    for record in chosen.values():
        told.update(record.told)  # A sum of counters leaves out amounts of 0.
    facts = {**found[0].facts, "told": dict(told)}

    def make(question: protocol.Question, index: int) -> environment_loop.Repeat:
        return environment_loop.Repeat(chosen[question, index].actions)

    stated = {question: [chosen[question, index].stated for index in range(count)] for question in asked}
    has_stated = any(map(any, stated.values()))
    return targets.Target(found[0].player, False, asked, make, facts=facts, stated=stated if has_stated else {})


def score(
    records: Sequence[Record], show: Callable[[int], None] = lambda done: None
) -> dict[str, list[scores.TaskScore]]:
    """Returns the scores of each player in each task; `show` is called with the number of records that are judged.

    A player that has stated a belief in any record has the metrics of its `beliefs` in each task.

    Raises ValueError for a record that cannot be played again, and for a task whose ideal experimenter is not known.
    """
    found: dict[str, list[scores.TaskScore]] = defaultdict(list)
    of_task: dict[protocol.Question, list[Record]] = defaultdict(list)
    for record in records:
        of_task[record.question].append(record)
    stating, done = {record.player for record in records if record.stated}, 0
    for question, its in of_task.items():
        judge, rows, answers = judging.Judge(question), defaultdict(list), defaultdict(list)
        with contextlib.closing(suite.load(question.domain, question.task, question.options)) as environment:
            for record in its:
                episode = _played(environment, record)
                rows[record.player].append(_judged(judge, record, episode))
                if record.player in stating:
                    answers[record.player].append(beliefs.judged(question, episode, record.stated))
                show(done := done + 1)
        for player, columns in rows.items():
            scored = scores.of_log(log.table(log.SCHEMA, columns), {question: None})
            found[player] += beliefs.added(scored, {question: answers[player]}) if player in stating else scored
    return dict(found)


def judged(record: Record) -> dict[str, np.ndarray]:
    """Returns the columns of the log of a record, T rows; raises ValueError as `score`."""
    question = record.question
    with contextlib.closing(suite.load(question.domain, question.task, question.options)) as environment:
        return _judged(judging.Judge(question), record, _played(environment, record))


def _judged(judge: judging.Judge, record: Record, episode: episodes.Episode) -> dict[str, np.ndarray]:
    judgement = mistakes.actions(judge(episode.hidden, episode.actions), episode.actions)
    return {**log.played(record.question, episode), **log.judged(record.question, episode.actions, judgement)}


def _played(environment: suite.Environment, record: Record) -> episodes.Episode:
    """Returns the episode of a record, played again."""
    environment.task.reseed(record.seed)
    try:
        return episodes.play(environment, environment_loop.Repeat(record.actions), record.episode)
    except ValueError as error:
        raise ValueError(f"{record.place}: {error}") from None
