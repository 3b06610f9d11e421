"""Baselines of Towers, which are rules rather than trained agents."""

import numpy as np
import pytest
from seeds import fresh_seed

from physexp import suite
from physexp.agents import core
from physexp.analysis import domains
from physexp.analysis.ideal import rollouts

TASKS = ["direct_features", "fist_features"]
NUM_ACTORS = 32


def _right(task, player, num_rounds=1, **task_kwargs):
    """The share of right answers of a baseline, and its mean number of actions, in rounds of 32 episodes."""
    make = domains.find("towers").baselines[task][player]
    actors = [make() for _ in range(NUM_ACTORS)]
    rewards, lengths = rollouts.play(actors, "towers", task, task_kwargs, num_rounds, fresh_seed())
    return (rewards > 0).mean(), lengths.mean()


@pytest.mark.parametrize("task", TASKS)
@pytest.mark.parametrize(
    "task_kwargs", [{"variation": 1.0}, {"variation": 1.0, "cube_size": 0.095, "sliding_friction": 0.45}]
)
def test_the_rule_is_right_whatever_varies(task, task_kwargs):
    right, length = _right(task, "rule", **task_kwargs)
    assert right > 0.8  # It is in 0.988 and more; seven wrong of 32 are less likely than one in a million.
    assert length < 6


@pytest.mark.parametrize("task", TASKS)
def test_the_lookup_is_right_but_for_towers_that_vary(task):
    right, length = _right(task, "lookup")
    ideal = domains.find("towers").ideal(task, {}, 0.98, resolution=0.001)
    interactions, _, _ = ideal.outcomes()
    assert right == 1
    assert interactions.min() + 1 <= length <= interactions.max() + 1
    # It is in 0.62 with pushes and 0.31 with the fist; 116 of 128, where 0.65 are right, are less likely than 1e-9.
    assert _right(task, "lookup", 4, variation=1.0)[0] < 0.9


class _Counter(core.Actor):
    """Interacts so many times, and answers with a label; notes what it is told."""

    def __init__(self, number, label):
        self.number, self.label = number, label
        self.told = []

    def select_action(self, observation):
        self.told.append("asked")
        return 4 + self.label if self.told.count("asked") > self.number else 0

    def observe_first(self, timestep):
        assert timestep.first()
        self.told = ["first"]

    def observe(self, action, next_timestep):
        self.told.append("last" if next_timestep.last() else "mid")

    def update(self):
        self.told.append("updated")


def test_actors_side_by_side_play_as_each_alone():
    seed = fresh_seed()
    actors = [_Counter(number, label) for number, label in [(0, 0), (2, 4), (5, 1), (99, 2)]]
    rewards, lengths = rollouts.play(actors, "towers", "fist_features", {}, 2, seed)
    assert lengths.tolist() == [[1, 3, 6, 26]] * 2  # The last runs out of time.
    batch = suite.load_batch("towers", "fist_features", 4, {"random": seed})
    for episode in range(2):
        batch.reset(episode=episode)
        right = batch.correct_answers == [0, 4, 1, -1]
        np.testing.assert_array_equal(rewards[episode], np.where(right, 1.0, -1.0))
    batch.close()
    for actor, length in zip(actors, lengths[-1], strict=True):
        assert actor.told == ["first", *["asked", "mid", "updated"] * (length - 1), "asked", "last", "updated"]
