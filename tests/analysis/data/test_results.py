"""The tables of stored results: writing, reading, and the size of those in the repository."""

import json

import blocks
import numpy as np
import pandas
import pyarrow
import pytest

from physexp.agents import rounds
from physexp.agents.a3c import config as a3c
from physexp.analysis.data import episodes, results
from physexp.analysis.training import config as config_lib
from physexp.analysis.training import records
from physexp.suite.engine import rules

STORED = blocks.ROOT / "results"


def config(seed=0, discount=0.95):
    """Returns the configuration of a run of Which is Heavier."""
    agent = a3c.A3CConfig(discount=discount, seed=seed)
    return config_lib.TrainConfig(
        domain="which_is_heavier", task="features", task_kwargs={"difficulty": 5.0}, agent=agent
    )


def played(run, trial="learned", num_environments=3):
    """Returns the rows of a right answer after two pokes, answers at once, and a timeout."""
    task = run.load_task()
    seeds = np.arange(11, 11 + num_environments)
    answers = task.answers(task.draw(seeds, np.full(num_environments, 7)))
    actions = np.zeros((100, num_environments), np.int64)
    lengths = np.ones(num_environments, int)
    actions[0] = 4 + answers
    lengths[0], actions[:3, 0] = 3, [0, 3, 4 + answers[0]]
    lengths[-1], actions[:, -1] = 100, 2
    rewards = np.zeros(actions.shape, np.float32)
    rewards[lengths - 1, np.arange(num_environments)] = 1
    rewards[-1, -1] = -1
    of_round = rounds.Round(actions, rewards, lengths, answers)
    table = episodes.Episodes.of_round(of_round, rules.Rules(4, 4, 100), seeds, 7)
    return records.of_episodes(table, run, trial, np.full(num_environments, 0.1))


def test_columns_that_follow_from_stored_ones_are_added():
    columns = ["difficulty", "label", "reward", "length", "interactions", "time", "masses", "mass_gap", "answer"]
    frame = records.completed(played(config()), config(), columns)
    assert list(frame.columns) == columns
    assert frame.length.tolist() == [3, 1, 100] and frame.interactions.tolist() == [2, 0, 100]
    assert frame.reward.tolist() == [1, 1, -1] and frame.label.tolist() == [*frame.answer[:2], -1]
    np.testing.assert_allclose(frame.time, [0.2, 0, 10])
    masses = np.sort(np.stack(frame.masses.to_numpy()))
    np.testing.assert_allclose(masses[:, -1] - masses[:, -2], frame.mass_gap)
    np.testing.assert_array_equal(np.stack(frame.masses.to_numpy()).argmax(axis=1), frame.answer)


def test_an_evaluation_sums_up_its_episodes():
    (row,) = records.of_evaluation(played(config()), config(), "learned", {}).to_pylist()
    assert (row["episodes"], row["timeouts"], row["training_seed"]) == (3, 1, 0)
    assert row["success_rate"] == pytest.approx(2 / 3) and row["mean_interactions"] == pytest.approx(34)
    assert row["mean_return"] == pytest.approx((0.95**2 + 1 - 0.95**99) / 3)


def test_answers_that_are_drawn_otherwise_today_are_refused():
    rows = played(config())
    wrong = pyarrow.array((rows["answer"].to_numpy() + 1) % 4, pyarrow.uint16())
    rows = rows.set_column(rows.schema.get_field_index("answer"), "answer", wrong)
    with pytest.raises(ValueError, match="are drawn otherwise today"):
        records.completed(rows, config(), ["masses"])
    assert len(records.completed(rows, config(), ["reward"])) == 3


def test_a_run_changes_only_the_file_of_its_condition(tmp_path):
    for run in (config(1), config(0), config(0, discount=0.99)):
        results.append(tmp_path, "episodes", played(run))
    folder = tmp_path / "tables" / "episodes"
    assert {path.stem for path in folder.iterdir()} == {
        records.condition_id(config()),
        records.condition_id(config(0, discount=0.99)),
    }
    mine = [("condition", "==", records.condition_id(config()))]
    assert results.load(tmp_path, "episodes", filters=mine).training_seed.tolist() == [0] * 3 + [1] * 3
    assert len(pandas.read_parquet(folder)) == 9


def test_the_same_rows_give_the_same_file_in_any_order(tmp_path):
    parts = [played(config(seed), trial) for seed in range(2) for trial in ("learned", "random")]
    for name, order in (("a", parts), ("b", parts[::-1]), ("c", [*parts, parts[1]])):  # One is stored twice.
        for part in order:
            results.append(tmp_path / name, "episodes", part)
    contents = {path.read_bytes() for path in tmp_path.rglob("*.parquet")}
    assert len(contents) == 1


def test_large_tables_have_a_group_of_rows_for_each_trial(monkeypatch, tmp_path):
    monkeypatch.setattr(results, "_SMALL", 2)
    for trial in ("learned", "random"):
        results.append(tmp_path, "episodes", played(config(), trial))
    (path,) = (tmp_path / "tables" / "episodes").iterdir()
    assert pyarrow.parquet.ParquetFile(path).num_row_groups == 2
    frame = results.load(tmp_path, "episodes", ["seed", "trial"], [("trial", "==", "random")])
    assert frame.seed.tolist() == [11, 12, 13] and set(frame.trial) == {"random"}


def test_curves_have_the_numbers_that_were_recorded():
    generator = np.random.default_rng(0)
    values = [float(f"{value:.6g}") for value in generator.normal(size=1000) * 10 ** generator.uniform(-15, 6, 1000)]
    rows = [
        {"condition": "a", "training_seed": 0, "frames": frames, "updates": 1, "episodes": 1, "success_rate": value}
        for frames, value in enumerate([*values, 0.95, 0.0])
    ]
    frame = records.curves(pyarrow.Table.from_pylist(rows, records.CURVES))
    assert frame.success_rate.tolist() == [*values, 0.95, 0.0]
    assert frame.entropy.isna().all()


def test_records_hold_long_episodes_and_many_actions():
    actions = np.full((40_000, 1), 199)
    actions[-1] = 399
    long = rounds.Round(actions, np.ones((40_000, 1), np.float32), np.array([40_000]), np.array([199]))
    table = episodes.Episodes.of_round(long, rules.Rules(200, 4, 1000), np.array([1]), 0)
    (found,) = records.of_episodes(table, config(), "learned", np.array([65e-6])).to_pylist()
    assert found["answer"] == 199 and found["actions"] == actions[:, 0].tolist()


def test_a_damaged_file_is_refused_in_one_line(tmp_path):
    results.append(tmp_path, "episodes", played(config()))
    (path,) = (tmp_path / "tables" / "episodes").iterdir()
    content = bytearray(path.read_bytes())
    content[len(content) // 4] ^= 255
    path.write_bytes(content)
    with pytest.raises(
        ValueError, match="episodes has a damaged file or lacks a column .*; put back the files"
    ) as error:
        results.load(tmp_path, "episodes")
    assert "\n" not in str(error.value)


def test_the_results_of_the_repository_stay_small():
    sizes = {path.relative_to(STORED): path.stat().st_size for path in STORED.rglob("*") if path.is_file()}
    own = [size for path, size in sizes.items() if path.parts[0] not in ("runs", "scores")]
    assert len(own) <= 50 and sum(own) <= 20e6
    rows = [size for path, size in sizes.items() if path.parts[0] == "scores"]  # Anybody may send one.
    assert rows and max(rows) <= 1.5e6


def test_stored_evaluations_are_those_of_the_stored_episodes():
    run = config_lib.TrainConfig.from_json(json.loads(results.load(STORED, "runs", ["config"]).config.iloc[0]))
    mine = [("condition", "==", records.condition_id(run)), ("training_seed", "==", run.agent.seed)]
    evaluations = results.load(STORED, "evaluations", filters=mine)
    assert len(evaluations)
    for stored in evaluations.drop(columns="commit").to_dict("records"):
        rows = results.read(STORED, "episodes", filters=[*mine, ("trial", "==", stored["trial"])])
        (again,) = records.of_evaluation(rows, run, stored["trial"], {}).to_pylist()
        assert stored == pytest.approx({name: again[name] for name in stored})
