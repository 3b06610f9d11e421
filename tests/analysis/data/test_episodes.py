"""The table of episodes says what was played, and stored files are selections of it."""

import subprocess
import sys

import numpy as np
import pyarrow
import pytest

from physexp.agents import rounds
from physexp.agents.a3c import config as a3c
from physexp.analysis.data import episodes
from physexp.analysis.score import log
from physexp.analysis.training import config as config_lib
from physexp.analysis.training import records
from physexp.analysis.training import run as run_lib

HIDDEN = np.array([[0.1, 0.9, 0.2, 0.3], [0.5, 0.1, 0.1, 0.4], [0.2, 0.3, 0.8, 0.1]])


def played(episode=7, num_steps=4):
    """A round with four blocks: right after two pokes, wrong at once, out of time after all steps."""
    actions = np.zeros((num_steps, 3), np.int64)  # What comes after the end of an episode are zeros, which are pokes.
    actions[:3, 0], actions[0, 1], actions[:, 2] = [0, 3, 5], 7, 2
    rewards = np.zeros((num_steps, 3), np.float32)
    rewards[[2, 0, num_steps - 1], [0, 1, 2]] = [1, -1, -1]
    round_ = rounds.Round(actions, rewards, np.array([3, 1, num_steps]), np.array([1, 0, 2]))
    return episodes.Episodes.of_round(round_, 4, np.array([11, 12, 13]), episode, HIDDEN)


def test_a_round_becomes_a_row_for_each_of_its_episodes():
    table = played()
    assert len(table) == 3
    assert table.seed.tolist() == [11, 12, 13] and table.episode.tolist() == [7, 7, 7]
    assert table.answer.tolist() == [1, 0, 2]
    assert table.label.tolist() == [1, 3, -1]  # Actions 5 and 7 are labels 1 and 3; the last one gave none.
    assert table.reward.tolist() == [1, -1, -1]
    assert table.length.tolist() == [3, 1, 4]
    assert table.interactions.tolist() == [2, 0, 4] and table.is_timeout.tolist() == [False, False, True]
    assert [table.actions_of(index).tolist() for index in range(3)] == [[0, 3, 5], [7], [2, 2, 2, 2]]
    assert table.returns(0.5).tolist() == [0.25, -1, -0.125]  # 0.5^2, 0.5^0, 0.5^3.


def test_rounds_of_different_lengths_are_joined_and_cut():
    joined = episodes.Episodes.joined([played(0), played(1, num_steps=6)])
    assert joined.episode.tolist() == [0, 0, 0, 1, 1, 1]
    assert [len(joined.actions_of(index)) for index in range(6)] == [3, 1, 4, 3, 1, 6]
    np.testing.assert_array_equal(joined.hidden, [*HIDDEN, *HIDDEN])
    first = joined.first(4)
    assert len(first) == 4 and first.label.tolist() == [1, 3, -1, 1]


def test_the_rows_of_a_run_are_a_selection():
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


def test_stored_rows_are_a_selection_with_the_condition():
    config = config_lib.TrainConfig(
        domain="which_is_heavier",
        task="features",
        task_kwargs={"difficulty": 5.0},
        agent=a3c.A3CConfig(discount=0.5, seed=2),
    )
    rows = records.table(played(), config, "learned", 0.25)
    assert rows.schema.equals(records.SCHEMA)
    first = rows.to_pylist()[0]
    assert (first["difficulty"], first["discount"], first["training_seed"]) == (5.0, 0.5, 2)
    assert first["control_timestep"] == 0.25 and first["actions"] == [0, 3, 5]


def test_records_hold_long_episodes_and_many_actions():
    """Control steps of 65 us give 40,000 actions in 2.6 s; a domain of one's own may have 200 interactions."""
    actions = np.full((40_000, 1), 199)
    actions[-1] = 399
    long = rounds.Round(actions, np.ones((40_000, 1), np.float32), np.array([40_000]), np.array([199]))
    table = episodes.Episodes.of_round(long, 200, np.array([1]), 0)
    config = config_lib.TrainConfig(domain="towers", task="fist_features", agent=a3c.A3CConfig())
    for rows in (table.table(run_lib.EPISODES, frames=1), records.table(table, config, "learned", 65e-6)):
        (found,) = rows.to_pylist()
        assert (found["answer"], found["label"], found["length"]) == (199, 199, 40_000)
        assert found["actions"] == actions[:, 0].tolist()
    assert {log.PLAYED.field(name).type for name in ("step", "action")} == {pyarrow.int32()}


def test_a_column_that_the_table_lacks_has_to_be_given():
    with pytest.raises(KeyError, match="frames"):
        played().table(run_lib.EPISODES)
    schema = pyarrow.schema([("place", pyarrow.string()), ("weights", pyarrow.float32())])
    rows = played().table(schema, place="here", weights=np.arange(3.0)).to_pylist()
    assert rows == [{"place": "here", "weights": 0.0}, {"place": "here", "weights": 1.0}] + [
        {"place": "here", "weights": 2.0}
    ]


@pytest.mark.parametrize("module", ["evaluation.records", "data.tables", "training.run", "experiments.base"])
def test_reading_tables_and_runs_does_not_import_torch(module):
    code = f"import sys; from physexp.analysis import {module.split('.')[0]}; import physexp.analysis.{module}"
    subprocess.run([sys.executable, "-c", f"{code}; assert 'torch' not in sys.modules"], check=True, timeout=120)
