"""Questions that are told: which they are, how several follow one another, and that nothing else changes."""

import itertools

import chance
import episodes
import numpy as np
import pytest

from physexp import suite
from physexp.suite.domains import strings
from physexp.suite.engine import snapshots

PAIRS = ((0, 1), (0, 2), (1, 2))
SEVERAL = {"questions": "all", "num_questions": 3, "time_limit": 1.0}  # s, 10 steps.


def _graphs() -> list[frozenset]:
    """The bands of each graph, by its number."""
    return [frozenset(pair for bit, pair in enumerate(PAIRS) if graph >> bit & 1) for graph in range(8)]


def _as_sets(tables) -> set[frozenset]:
    """Questions as sets of graphs that mean yes."""
    graphs = _graphs()
    return {frozenset(graphs[k] for k in np.flatnonzero(table)) for table in tables}


def _alike(question) -> frozenset:
    """All questions to which renaming of pucks and negation lead."""
    found = set()
    for names in itertools.permutations(range(3)):
        renamed = {frozenset(tuple(sorted((names[i], names[j]))) for i, j in graph) for graph in question}
        found |= {frozenset(renamed), frozenset(_graphs()) - renamed}
    return frozenset(found)


def test_half_of_the_graphs_mean_yes_and_no_pull_alone_answers():
    halves = {frozenset(chosen) for chosen in itertools.combinations(_graphs(), 4)}
    together = frozenset(graph for graph in _graphs() if len(graph) >= 2)  # A pull moves all pucks.
    assert _as_sets(strings.question_sets()["all"]) == halves - _alike(together)


def test_two_classes_and_a_third_of_the_larger_others_are_held_out():
    every, train, held_out = (_as_sets(strings.question_sets()[name]) for name in ("all", "train", "held_out"))
    assert train | held_out == every and not train & held_out
    shares = {kind: len(kind & held_out) / len(kind) for kind in map(_alike, every)}
    assert len(shares) == 9 and sorted(len(kind) for kind in shares) == [2, 6, 6, 6, 6, 6, 12, 12, 12]
    assert sorted(shares.values()) == [1 / 3] * 7 + [1, 1]
    for question in every:  # A question and its negation are on the same side.
        assert (question in train) == (frozenset(_graphs()) - question in train)


@pytest.mark.parametrize("name", ["tied_0_2", "one_at_1", "odd"])
def test_a_question_may_be_chosen_by_its_name(name, seed):
    task = suite.load_task("strings", "features", {"questions": name})
    slacks, answers = episodes.drawn_with_answers("strings", seed, questions=name)
    joined = dict(zip(PAIRS, (slacks[:, :3] > 0).T, strict=True))
    meant = {
        "tied_0_2": joined[0, 2],
        "one_at_1": joined[0, 1] != joined[1, 2],
        "odd": np.sum(list(joined.values()), axis=0) % 2 == 1,
    }
    assert task.label_names == ("no", "yes")
    np.testing.assert_array_equal(answers, meant[name])


def test_questions_are_uniform_and_independent_of_bands_and_each_other(seed):
    hidden, answers = episodes.drawn_with_answers("strings", seed, questions="all", num_questions=2)
    without = episodes.drawn("strings", np.full(len(hidden), seed), np.arange(len(hidden)))
    np.testing.assert_array_equal(hidden[:, :3], without)
    graphs, tables = (hidden[:, :3] > 0) @ [1, 2, 4], strings.question_sets()["all"]
    first, second = hidden[:, 3:].astype(int).T
    chance.assert_drawn(np.bincount(first, minlength=68), np.full(68, 1 / 68))
    chance.assert_drawn(np.bincount(2 * (first < 34) + (second < 34)), np.full(4, 1 / 4))
    chance.assert_drawn(np.bincount(2 * graphs + (first < 34)), np.full(16, 1 / 16))
    np.testing.assert_array_equal(answers, np.stack([tables[first, graphs], tables[second, graphs]], axis=1))


class _Referee:
    """The rules of several questions, for one environment."""

    def __init__(self, answers, limit):
        self.answers, self.limit, self.steps, self.asked = answers, limit, 0, 0

    def judge(self, action):
        """Returns the reward of an action, and whether the episode ends."""
        self.steps += 1
        reward = 0
        if action >= 6:
            reward = 1 if action - 6 == self.answers[self.asked] else -1
            self.asked += 1
        ends = self.asked == len(self.answers) or self.steps == self.limit
        return reward - (len(self.answers) - self.asked if ends else 0), ends


@pytest.mark.parametrize("kwargs", [{"reveal": True}, {"step_variation": 0.5, "control_timestep": 0.2}])
def test_an_answer_brings_the_next_question_at_once_in_a_batch_too(seed, kwargs):
    rng, size = np.random.default_rng(seed), 8
    batch = suite.load_batch("strings", "features", size, {**SEVERAL, **kwargs, "random": seed})
    singles = [
        suite.load("strings", "features", {**SEVERAL, **kwargs, "random": suite.environment_seed(seed, i)})
        for i in range(size)
    ]
    tables, limit = strings.question_sets()["all"], batch.task.rules.step_limit
    for _ in range(2):
        seen, each = batch.reset(), [single.reset() for single in singles]
        referees = [_Referee(answers, limit) for answers in batch.task.answers(batch.hidden)]
        playing = np.arange(size)
        while len(playing):
            episodes.assert_same(seen, each)
            for row, environment in enumerate(playing):
                asked = int(batch.hidden[environment, 3 + referees[environment].asked])
                np.testing.assert_array_equal(seen.observation["question"][row], tables[asked])
                assert batch.correct_answers[environment] == referees[environment].answers[referees[environment].asked]
                if "reveal" in kwargs:
                    assert seen.observation["answer"][row].argmax() == batch.correct_answers[environment]
            actions = np.where(
                rng.random(len(playing)) < 0.3, rng.integers(6, 8, len(playing)), rng.integers(6, size=len(playing))
            )
            times = [singles[k].physics.time() for k in playing]
            before, seen = seen, batch.step(actions, playing)
            each = [singles[k].step(int(action)) for k, action in zip(playing, actions, strict=True)]
            episodes.assert_same(seen, each)
            expected = [referees[k].judge(action) for k, action in zip(playing, actions, strict=True)]
            assert list(zip(seen.reward, seen.last(), strict=True)) == expected
            for row in np.flatnonzero(actions >= 6):
                assert singles[playing[row]].physics.time() == times[row]
                for name in ("pulled", "clamped", "away"):
                    np.testing.assert_array_equal(seen.observation[name][row], before.observation[name][row])
            goes_on = ~seen.last()
            playing, each = playing[goes_on], [one for one, goes in zip(each, goes_on, strict=True) if goes]
            seen = seen._replace(
                step_type=seen.step_type[goes_on],
                reward=seen.reward[goes_on],
                discount=seen.discount[goes_on],
                observation={name: values[goes_on] for name, values in seen.observation.items()},
            )


def test_lamps_show_the_question_and_images_tell_nothing_else_of_it(seed):
    """All 68 questions, with each clamp or none: 272 images, all different, that follow from these two alone."""
    slacks = episodes.drawn("strings", np.full(136, seed), np.arange(136))
    hidden = np.hstack([slacks, np.tile(np.arange(68), 2)[:, None], np.zeros((136, 1))])
    batch = suite.load_batch("strings", "pixels", 136, {"questions": "all", "num_questions": 2, "random": seed})
    followed, seen, clamp = episodes.Followed(), batch.reset(hidden=hidden).observation, -1
    for action in (3, 4, 5, None):
        followed.add([(question, clamp) for question in hidden[:, 3]], seen)
        if action is not None:
            seen, clamp = batch.step(np.full(136, action)).observation, action - 3
    after = batch.step(np.full(136, 6)).observation  # All have the question of number 0 next.
    followed.add([(0.0, clamp)] * 136, after)
    assert followed.num_different() == 4 * 68


def test_a_snapshot_goes_back_to_the_question_that_was_asked_then(seed):
    batch = suite.load_batch("strings", "features", 8, {**SEVERAL, "random": seed})
    batch.reset()
    batch.step(np.full(8, 6))
    snapshot, actions = snapshots.take(batch), np.random.default_rng(seed).integers(8, size=8)
    steps, counted = [], []
    for _ in range(2):
        steps.append(batch.step(actions))
        counted.append((batch.ledger.num_right.tolist(), batch.ledger.returns.tolist()))
        snapshots.restore(batch, snapshot)
    one, other = steps
    assert one.reward.tolist() == other.reward.tolist()
    assert counted[0] == counted[1]
    for name, values in one.observation.items():
        assert values.tobytes() == other.observation[name].tobytes()


def test_gymnasium_tells_the_sum_of_all_rewards_and_ends_in_time():
    from physexp.suite import gymnasium

    environment = gymnasium.Environment("strings", "features", **SEVERAL, random=0)
    environment.reset()
    answers = environment.dm_env.task.ledger.answers[0]
    plan = [0, 6 + answers[0], 6 + 1 - answers[1], 1, 6 + answers[2]]
    *_, (_, reward, terminated, truncated, info) = map(environment.step, plan)
    assert (reward, terminated, truncated) == (1, True, False)
    assert info["discounted_return"] == pytest.approx(0.95 - 0.95**2 + 0.95**4)
    assert info["correct_answer"] == answers[2] and not info["is_success"]
    many = gymnasium.VectorEnvironment("strings", "features", 2, **SEVERAL, random=0)
    many.reset()
    answers = many.batch.ledger.answers
    for _ in range(8):
        many.step(np.zeros(2, int))
    many.step(6 + answers[:, 0])
    # A right answer in the last step, with one question left, is no divergence: 1 - 1 = 0.
    _, rewards, terminated, truncated, infos = many.step(6 + answers[:, 1])
    assert rewards.tolist() == [0, 0] and terminated.all() and not truncated.any()
    np.testing.assert_allclose(infos["discounted_return"], 0.95**8)


@pytest.mark.parametrize(
    "kwargs, message",
    [
        ({"questions": "even"}, "questions is 'even'; choose from graph, all, train, held_out, tied_0_1"),
        ({"num_questions": 2}, "num_questions is 2 of questions graph; give 1, or other questions"),
        ({"questions": "all", "num_pucks": 4}, "questions is all of 4 pucks; give graph, or 3"),
    ],
)
def test_an_option_that_no_task_has_is_refused(kwargs, message):
    with pytest.raises(ValueError, match=message):
        suite.load_task("strings", "features", kwargs)


def test_the_number_of_a_question_that_is_not_asked_is_refused():
    environment = suite.load("strings", "features", {"questions": "train"})
    with pytest.raises(ValueError, match="give values from 0 to 39"):
        environment.reset(hidden=[0, 0, 0.005, 40])
