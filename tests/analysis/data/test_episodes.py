"""The table of episodes."""

import numpy as np
import pyarrow
import pytest

from physexp.agents import rounds
from physexp.analysis.data import episodes
from physexp.analysis.training import run as run_lib
from physexp.suite.engine import rules

HIDDEN = np.array([[0.1, 0.9, 0.2, 0.3], [0.5, 0.1, 0.1, 0.4], [0.2, 0.3, 0.8, 0.1]])


def played(episode=7, num_steps=4):
    """Returns three episodes with four blocks: right after two pokes, wrong at once, and a timeout."""
    actions = np.zeros((num_steps, 3), np.int64)  # Zeros, which are pokes, follow the end of an episode.
    actions[:3, 0], actions[0, 1], actions[:, 2] = [0, 3, 5], 7, 2
    rewards = np.zeros((num_steps, 3), np.float32)
    rewards[[2, 0, num_steps - 1], [0, 1, 2]] = [1, -1, -1]
    of_round = rounds.Round(actions, rewards, np.array([3, 1, num_steps]), np.array([1, 0, 2]))
    return episodes.Episodes.of_round(of_round, rules.Rules(4, 4, 100), np.array([11, 12, 13]), episode, HIDDEN)


def test_a_round_becomes_a_row_for_each_of_its_episodes():
    table = played()
    assert len(table) == 3
    assert table.seed.tolist() == [11, 12, 13] and table.episode.tolist() == [7, 7, 7]
    assert table.answer.tolist() == [1, 0, 2]
    assert table.label.tolist() == [1, 3, -1]  # Actions 5 and 7 are labels 1 and 3.
    assert table.reward.tolist() == [1, -1, -1]
    assert table.length.tolist() == [3, 1, 4]
    assert table.interactions.tolist() == [2, 0, 4] and table.is_timeout.tolist() == [False, False, True]
    assert [table.actions_of(index).tolist() for index in range(3)] == [[0, 3, 5], [7], [2, 2, 2, 2]]
    assert table.returns(0.5).tolist() == [0.25, -1, -0.125]  # 0.5^2, 0.5^0, 0.5^3.


def test_several_questions_earn_all_rewards_and_count_all_answers():
    """Two questions, 4 interactions, 2 labels: right and wrong; right, then out of time; right in the last step."""
    actions = np.array([[4, 0, 5, 0], [0, 4, 0, 0], [1, 2, 3, 4]]).T
    rewards = np.array([[1, 0, -1, 0], [0, 1, 0, -1], [0, 0, 0, 1 - 1]], np.float32).T
    of_round = rounds.Round(actions, rewards, np.array([3, 4, 4]), np.zeros(3, int))
    table = episodes.Episodes.of_round(of_round, rules.Rules(4, 2, 4, 2), np.arange(3), 0)
    assert table.returns(0.5).tolist() == [1 - 0.25, 0.5 - 0.125, 0]
    assert table.right.tolist() == [0.5, 0.5, 0.5] and table.summary(0.5)["success_rate"] == 0.5
    assert table.is_timeout.tolist() == [False, True, True] and table.interactions.tolist() == [1, 3, 3]


def test_rounds_of_different_lengths_are_joined_and_cut():
    joined = episodes.Episodes.joined([played(0), played(1, num_steps=6)])
    assert joined.episode.tolist() == [0, 0, 0, 1, 1, 1]
    assert [len(joined.actions_of(index)) for index in range(6)] == [3, 1, 4, 3, 1, 6]
    np.testing.assert_array_equal(joined.hidden, [*HIDDEN, *HIDDEN])
    assert joined.first(4).label.tolist() == [1, 3, -1, 1]


def test_a_stored_table_is_a_selection_of_columns():
    rows = played().table(run_lib.EPISODES, frames=8)
    assert rows.schema.equals(run_lib.EPISODES)
    assert rows.to_pylist()[0] == {
        "frames": 8,
        "seed": 11,
        "episode": 7,
        "answer": 1,
        "label": 1,
        "reward": 1.0,
        "length": 3,
        "actions": [0, 3, 5],
    }
    with pytest.raises(KeyError, match="frames"):
        played().table(run_lib.EPISODES)
    schema = pyarrow.schema([("place", pyarrow.string()), ("weights", pyarrow.float32())])
    rows = played().table(schema, place="here", weights=np.arange(3.0)).to_pylist()
    assert rows == [{"place": "here", "weights": float(weight)} for weight in range(3)]
