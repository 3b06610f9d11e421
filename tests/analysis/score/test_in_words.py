"""Players in words: the ideal experimenter through text alone, scripted ones, and their runs."""

import json
from pathlib import Path
import re
import sys

import dm_env
import ideals
import numpy as np
import pytest
from seeds import fresh_seed

from physexp import suite
from physexp.analysis.data import episodes
from physexp.analysis.ideal import mistakes
from physexp.analysis.score import instances, judging, protocol, transcripts
from physexp.suite import words

sys.path.insert(0, str(Path(__file__).parents[3] / "docs" / "examples"))

import in_words  # noqa: E402

PLAYER = {"model": "a script", "harness": "none", "tools": "none", "budget": "none"}


def read(text, spec):
    """Returns the observation that a text tells, float32 arrays by name."""
    values = {name: re.findall(r"[-+.e\d]+", found) for name, found in re.findall(r"^(\w+) = (\[.*\])", text, re.M)}
    return {name: np.array(values[name], np.float32).reshape(array.shape) for name, array in spec.items()}


def play_from_text(episode, actor, spec, num_interactions):
    """Plays an episode with an actor that is given numbers read from texts, and rewards from verdicts."""
    text = episode.observe()
    actor.observe_first(dm_env.restart(read(text, spec)))
    while not episode.is_over:
        action = int(actor.select_action(read(text, spec)))
        is_answer = action >= num_interactions
        text = episode.answer(action - num_interactions) if is_answer else episode.experiment(action)
        if not episode.is_over:
            reward = (text.startswith("Right.") - text.startswith("Wrong.")) * 1.0
            actor.observe(action, dm_env.transition(reward, read(text, spec), 1.0))


def played_alike(domain, task, count, digits=None, **options):
    """Returns for how many of the first instances the ideal plays the same from text and from arrays."""
    known = ideals.of(domain, task, **options)
    seed = fresh_seed()
    alike, environments = 0, [suite.load(domain, task, {**options, "random": seed}) for _ in range(2)]
    spec, num_interactions = environments[0].observation_spec(), environments[0].task.num_interactions
    for index in range(count):
        episode = words.Episode(environments[0], index, digits=digits)
        try:
            play_from_text(episode, known.actor(), spec, num_interactions)
        except (KeyError, ValueError):  # It has read something that no instance shows.
            continue
        alike += episode.actions == episodes.play(environments[1], known.actor(), index).actions.tolist()
    return alike


QUICK = ("towers/fist_features", "crush/features", "threshold/features", "strings/features")
TASKS = [
    pytest.param(domain, task, marks=[] if f"{domain}/{task}" in QUICK else [pytest.mark.long])
    for domain, task in suite.tagged("features")
]


@pytest.mark.parametrize("domain, task", TASKS)
def test_the_ideal_plays_the_same_from_text_alone(domain, task):
    assert played_alike(domain, task, 5) == 5


def test_the_ideal_plays_several_questions_the_same_from_text_alone():
    assert played_alike("strings", "features", 5, questions="all", num_questions=4) == 5


def test_two_decimals_are_too_few_for_towers():
    assert played_alike("towers", "fist_features", 10, digits=2) < 10


def run_with(folder, player, name="threshold/features", count=10, **kwargs):
    """Returns the records of a run of a player."""
    with transcripts.run(folder, **PLAYER) as run:
        for episode in run.episodes(name, count, **kwargs):
            in_words.play(episode, player)
    return [json.loads(line) for line in (folder / transcripts.RECORDS).read_text().splitlines()]


@pytest.mark.parametrize(
    "player, kinds",
    [
        (in_words.at_once, {"early"}),
        # It begins with 4 N, where 16 N would tell most; the first push that moves the block tells the answer, and it
        # answers 4 N, which is mostly wrong.
        (in_words.pokes_everything, {"inferior", "late", "wrong"}),
        # It is taken off after many replies, which is to push with 4 N until the time is over.
        (lambda messages: "Hm.", {"inferior", "late", "uninformative", "silence"}),
        # A block that slides with 4 N is known then; to another the same push tells nothing new, and it
        # answers 4 N, which is wrong, too early.
        (in_words.repeats_itself, {"inferior", "late", "uninformative", "early", "wrong"}),
    ],
)
def test_scripted_players_make_the_mistakes_that_their_scripts_say(player, kinds, tmp_path):
    (question,) = protocol.named(["threshold/features"])
    found, judge = run_with(tmp_path / "run", player), judging.Judge(question)
    environment = protocol.load(question)
    played = [
        episodes.play(environment, episodes.environment_loop.Repeat(record["actions"]), record["episode"])
        for record in found
    ]
    assert [one.seed for one in played] == [record["seed"] for record in found]
    np.testing.assert_allclose(
        [question.discount ** np.arange(len(one.rewards)) @ one.rewards for one in played],
        [record["return"] for record in found],
    )
    judged = [judge(one.hidden, one.actions) for one in played]
    costs = mistakes.of_episodes(judged, [one.actions for one in played], question.discount)
    assert {kind for kind, cost in costs.items() if cost.max() > 1e-9} == kinds


def test_a_player_that_is_greedy_for_information_halves_the_forces(tmp_path):
    found = run_with(tmp_path / "run", in_words.greedy("threshold", "features", num_instances=60), count=2)
    assert [record["return"] for record in found] == [pytest.approx(0.95**3)] * 2  # log2(8) pushes, and the answer.
    assert [max(record["beliefs"][-1]) for record in found] == [1] * 2


def test_a_run_that_broke_off_goes_on_where_it_was(tmp_path):
    class Broken(Exception):
        pass

    replies = 0

    def breaks(messages):
        nonlocal replies
        replies += 1
        if replies == 8:
            raise Broken
        return in_words.pokes_everything(messages)

    whole, broken = tmp_path / "whole", tmp_path / "broken"
    with pytest.raises(Broken):
        run_with(broken, breaks, "balance/features", 2)
    path = broken / transcripts.TRANSCRIPT
    path.write_bytes(path.read_bytes() + b'{"task": "bal')  # As a kill may leave it.
    again = run_with(broken, in_words.pokes_everything, "balance/features", 2)
    expected = run_with(whole, in_words.pokes_everything, "balance/features", 2)
    for record in (*again, *expected):
        assert (times := record.pop("times")) == sorted(times)
    assert again == expected
    for changed, told in (
        ({"model": "another"}, "has the model 'a script' instead of 'another'"),
        ({"instances": instances.Public(7)}, f"has the seed {protocol.SEED} instead of 7"),
    ):
        with pytest.raises(ValueError, match=told), transcripts.run(broken, **{**PLAYER, **changed}):
            pass
    with pytest.raises(ValueError, match="not the episode"):
        run_with(broken, in_words.at_once, "balance/features", 2, digits=1)


def test_a_program_plays_and_its_client_tells_the_price(tmp_path):
    program = "import json, sys; print('Hm.' if len(json.load(sys.stdin)) == 2 else 'note(\"sure\")\\nanswer(1)')"
    with transcripts.run(tmp_path, **PLAYER) as run:
        with pytest.raises(ValueError, match="no episode of .* was played; tell its amounts after one"):
            run.tell(tokens=512)
        for episode in run.episodes("strike/features", 1):
            in_words.play(episode, in_words.program([sys.executable, "-c", program]))
            run.tell(tokens=500)
    with transcripts.run(tmp_path, **PLAYER) as run:  # As for a client of a server, which cannot tell it.
        run.tell(tokens=12, cost=0.25)
    lines = [json.loads(line) for line in (tmp_path / transcripts.TRANSCRIPT).read_text().splitlines()]
    assert lines[0]["player"] == PLAYER and lines[-1]["told"] == {"tokens": 12, "cost": 0.25}
    assert [line.get("said") for line in lines[2:4]] == ["Hm.\n", 'note("sure")\nanswer(1)\n']
    (record,) = transcripts.records(tmp_path / transcripts.TRANSCRIPT)
    assert record["actions"] == [4] and record["refused"] == 1 and record["task"] == "strike/features"
    assert record["told"] == {"tokens": 512, "cost": 0.25}
