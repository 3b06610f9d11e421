"""Episodes in words: what they tell, what they refuse, and what they keep."""

import functools
import inspect
import io
import json
import math
import random
import re
import typing

import every_task
import numpy as np
from PIL import Image
import pytest
from seeds import fresh_seed

from physexp import suite
from physexp.suite import words

load = functools.cache(lambda name, **task_kwargs: every_task.load(name, random=0, **task_kwargs))


def begin(name="strings/features", index=0, level="named", digits=None, **task_kwargs):
    return words.Episode(load(name, **task_kwargs), index, level, digits)


def read(text, spec):
    """Returns the observation that a text tells, float32 arrays by name."""
    values = {name: re.findall(r"[-+.e\d]+", found) for name, found in re.findall(r"^(\w+) = (\[.*\])", text, re.M)}
    return {name: np.array(values[name], np.float32).reshape(array.shape) for name, array in spec.items()}


@every_task.every_feature_task
def test_texts_have_every_bit_of_the_readings_and_the_price(name):
    generator = np.random.default_rng(fresh_seed())
    episode, other = begin(name), every_task.load(name, random=0)
    assert other.task.description or name.startswith("bolted")
    spec, task, timestep = other.observation_spec(), other.task, other.reset()
    rules = episode.rules()
    assert task.question in rules and task.description in rules and f"by {task.discount:g}" in rules
    assert all(re.search(rf"^  \d+: {re.escape(label)}$", rules, re.M) for label in task.label_names)
    text = episode.observe()
    for step in range(task.rules.step_limit - 1):
        for reading, values in read(text, spec).items():
            assert values.tobytes() == timestep.observation[reading].tobytes(), text
        assert f"worth {task.discount**step:.4f} now" in text and ("answer now" in text) == (
            step == task.rules.step_limit - 1
        )
        action = int(generator.integers(task.num_interactions))
        text, timestep = episode.experiment(action), other.step(action)
    label = int(generator.integers(task.num_labels))
    verdict, reward = episode.answer(label), other.step(task.num_interactions + label).reward
    assert verdict.startswith("Right." if reward == 1 else "Wrong.")
    assert f"earned {reward * task.discount ** (task.rules.step_limit - 1):.4f}" in verdict
    assert episode.is_over and f"is {task.correct_answer}, {task.label_names[task.correct_answer]}." in verdict


def test_instances_that_read_alike_are_told_alike():
    task, told = load("threshold/features").task, {}
    for index in range(20):  # Two of eight answers differ, but for a chance of 8^-19.
        episode = begin("threshold/features", index)
        calls = ["believe([0.5, 0.5, 0, 0, 0, 0, 0, 0])", "experiment(7)", "experiment(8)", "observe()", "hm"]
        told[task.correct_answer] = [episode.rules(), *map(episode.say, calls)]  # 32 N makes each block slide.
    assert len(told) > 1 and len(set(map(tuple, told.values()))) == 1


def test_digits_shorten_numbers():
    texts = [begin("which_is_heavier/features", digits=digits).experiment(0) for digits in (None, 3, 0)]
    exact, short, none = (re.search(r"heights = \[([-.e\d]+),", text)[1] for text in texts)
    assert short == f"{float(exact):.3f}".rstrip("0") and len(exact) > 5 and none in "01"


def test_neutral_names_are_used_alike_and_mean_nothing():
    texts = {}
    for level in words.LEVELS:
        episode = begin(level=level)
        told = [episode.rules(), episode.observe(), episode.experiment(1), episode.experiment(3), episode.answer(0)]
        assert all(set(re.findall(r"[a-z]{4,}", text)) & {"puck", "pull", "away"} for text in told[:3]) == (
            level == "named"
        )
        texts[level] = told
    verb, noun, number = re.search(r"1: (\w+) (\w+) (\d)", texts["neutral"][0]).groups()
    assert number == "1" and texts["neutral"][0].count(f": {verb} {noun} ") == 3  # Of three pulls of three pucks.
    values = [re.findall(r"\[(.*)\]", texts[level][2]) for level in words.LEVELS]
    assert values[0] == values[1] and values[2] == [", ".join(values[0])]
    assert begin(level="neutral").rules() == texts["neutral"][0]


def test_questions_follow_one_another_and_each_belief_is_scored():
    episode = begin(questions="all", num_questions=3)
    answers = episode.environment.task.ledger.answers[0]
    assert "There are 3 questions" in episode.rules() and "question 1 of 3" in episode.observe()
    episode.believe([0.25, 0.75])
    assert episode.answer(int(answers[0])).startswith("Right.")
    episode.believe([1, 0])
    episode.believe([0, 1])  # The last one counts.
    episode.answer(0)
    last = episode.answer(0)
    right = [-2 * one + 1 for one in (answers[1], answers[2])]
    earned = 1 + 0.95 * right[0] + 0.95**2 * right[1]
    assert f"earned {earned:.4f}" in last
    assert episode.log_scores == [
        math.log2([0.25, 0.75][answers[0]]),
        math.log2([words.LEAST_BELIEF, 1][answers[1]]),
        None,
    ]
    assert episode.record()["beliefs"] == [[0.25, 0.75], [0, 1], None]


def test_an_image_is_what_is_observed():
    environment = suite.load("strike", "pixels", {"random": 0})
    episode = words.Episode(environment)
    assert "image" in episode.observe()
    episode.experiment(2)
    (seen,) = environment.task.last_observation().values()
    np.testing.assert_array_equal(np.asarray(Image.open(io.BytesIO(episode.image))), seen)
    assert begin().image is None


def test_tools_describe_themselves():
    for tool in begin().tools:
        parameters = inspect.signature(tool).parameters
        hints = typing.get_type_hints(tool)
        assert inspect.getdoc(tool) and hints.pop("return") is str and set(hints) == set(parameters)
        assert all(f"{name}: " in inspect.getdoc(tool) for name in parameters)


def test_a_reply_makes_the_calls_in_its_lines_until_one_is_refused():
    episode = begin()
    said = episode.say("I pull first, since experiment(5) costs.\n- `experiment(number=1)`\nexperiment(9)\nanswer(0)")
    assert episode.actions == [1] and "Refused: number is 9; give an integer from 0 to 5." in said
    assert "there is no call" in episode.say("Let me think.")
    assert episode.say('note("0-1, or 1-2?")\nanswer(2)').startswith("Kept.\n") and episode.actions == [1, 8]
    assert episode.num_refused == 2
    assert [event["said"] for event in episode.events if "said" in event][1] == "Let me think."


def test_an_episode_goes_on_after_its_events():
    episode = begin()
    episode.say("believe([1, 0, 0, 0, 0, 0, 0, 0])\nexperiment(1)\nexperiment(77)")
    stored = json.loads(json.dumps(episode.events))
    kept = []
    again = words.Episode(load("strings/features"), 0, events=stored, keep=kept.append)
    for name in ("events", "actions", "times", "beliefs", "num_refused"):
        assert getattr(again, name) == getattr(episode, name)
    again.answer(0)
    assert [event["call"] for event in kept] == ["answer"] and again.log_scores[0] is not None
    with pytest.raises(ValueError, match="not the episode"):
        words.Episode(load("strings/features"), 1, events=stored)


def test_a_player_that_is_taken_off_is_silent_until_the_end():
    episode = begin("threshold/features")
    episode.experiment(3)
    episode.stop("the budget is spent")
    assert episode.actions == [3] + [0] * 14 and episode.is_over
    assert episode.environment.task.ledger.returns[0] == pytest.approx(-(0.95**14))


def test_an_episode_is_over_when_its_environment_plays_another():
    environment = load("strings/features")
    first, second = words.Episode(environment), words.Episode(environment)
    with pytest.raises(words.Refusal, match="is over; begin another"):
        first.experiment(0)
    second.experiment(0)
    assert not first.actions and second.actions == [0]


def _nested(depth):
    value = []
    for _ in range(depth):
        value = [value]
    return value


NESTED = [_nested(20), _nested(3000)]  # Python does not spell the second one.


def _junk(generator):
    """Returns a value that a confused or a hostile client may send."""
    return generator.choice(
        [
            lambda: generator.randint(-3, 40),
            lambda: generator.choice([True, None, 1.0, 0.5, math.nan, math.inf, -1, 10**5000, "0", "", "x" * 20_000]),
            lambda: generator.choice([[], {}, [0], {"number": 0}, {"number": {"number": 1}}, [0.125] * 8, [1, -1]]),
            lambda: NESTED[generator.random() < 0.1],
            lambda: [generator.random() for _ in range(generator.choice([0, 7, 8, 8, 8, 999]))],
            lambda: "\ud800 \x00 \x1b[8m __class__",
        ]
    )()


def test_ten_thousand_senseless_calls_are_refused_in_a_sentence():
    seed = fresh_seed()
    generator, environment = random.Random(seed), suite.load("strings", "features", {"random": seed})
    names = [
        "rules",
        "observe",
        "experiment",
        "answer",
        "believe",
        "note",
        "stop",
        "call",
        "events",
        "_act",
        "__init__",
    ]
    keys = ["number", "probabilities", "text", "self", "name", ""]
    episode, refused, told = words.Episode(environment), 0, []
    for _ in range(10_000):
        if episode.is_over and generator.random() < 0.5:
            episode = words.Episode(environment)
        name = generator.choice(names) if generator.random() < 0.9 else _junk(generator)
        arguments = {generator.choice(keys): _junk(generator) for _ in range(generator.choice([0, 1, 1, 1, 2]))}
        before = len(episode.actions), episode.num_refused
        try:
            if generator.random() < 0.2:
                told.append(episode.say(f"{generator.choice(names)}({generator.choice(['0', '[', 'x', '[0' * 9999])})"))
            else:
                told.append(episode.call(name, arguments if generator.random() < 0.9 else _junk(generator)))
        except words.Refusal as refusal:
            refused += 1
            told.append(str(refusal))
            assert (len(episode.actions), episode.num_refused) == (before[0], before[1] + 1)
            assert "\n" not in str(refusal) and len(str(refusal)) < 400
            assert re.search("give|call|begin|arguments are", str(refusal)), refusal
        json.dumps(episode.events[-1])
        if not episode.is_over:  # Nothing tells the bands before the end.
            assert "right answer is " not in told[-1].replace("The right answer is worth", "")
    assert 4_000 < refused < 9_900
