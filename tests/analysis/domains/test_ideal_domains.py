"""The ideal experimenter of every domain that has one, and the columns that a domain has in stored episodes."""

import math
import types

import ideals
import numpy as np
import observers
import pyarrow
import pytest
from trainers import fresh_seed

from physexp import suite
from physexp.agents import environment_loop
from physexp.analysis import domains
from physexp.analysis.data import episodes
from physexp.analysis.domains import base
from physexp.analysis.evaluation import records
from physexp.analysis.training import config as config_lib

IDEALS = [(domain, task) for domain, task in suite.tagged("features") if domains.find(domain).ideal is not None]


class Recorder(observers.Watcher):
    """Keeps what an ideal experimenter is told of an episode."""

    def episode(self, environment):
        return types.SimpleNamespace(
            hidden=np.array(environment.task.hidden),
            actions=np.array(self.actions),
            observations={name: np.stack([each[name] for each in self.seen]) for name in self.seen[0]},
        )


@pytest.mark.parametrize(("domain", "task"), IDEALS)
def test_what_it_earns_in_the_real_environment_is_its_value(domain, task):
    discount = domains.find(domain).discount
    solution = ideals.of(domain, task)
    environment = suite.load(domain, task, task_kwargs={"random": fresh_seed()})
    played = environment_loop.EnvironmentLoop(environment, solution.actor()).run(150)
    returns = np.array([discount ** (each["episode_length"] - 1) * each["episode_return"] for each in played])
    assert abs(returns.mean() - solution.value) < 5 * returns.std() / math.sqrt(len(returns)) + 1e-3
    assert solution.bound == pytest.approx(solution.value)


@pytest.mark.parametrize(("domain", "task"), IDEALS)
def test_it_believes_what_its_answer_says_and_at_first_no_more_than_the_prior(domain, task):
    solution = ideals.of(domain, task)
    environment = suite.load(domain, task, task_kwargs={"random": fresh_seed()})
    recorder = Recorder()
    loop = environment_loop.EnvironmentLoop(environment, solution.actor(), [recorder])
    for _ in range(5):
        loop.run_episode()
        believed = solution.beliefs(recorder.episode(environment))
        assert believed.shape == (len(recorder.actions) + 1, environment.task.num_labels)
        np.testing.assert_allclose(believed.sum(axis=1), 1)
        assert believed[-1].argmax() == recorder.actions[-1] - environment.task.num_interactions
        np.testing.assert_array_equal(believed[-1], believed[-2])  # An answer tells nothing.
        assert believed[-1].max() > believed[0].max()


@pytest.mark.parametrize("domain", [name for name, domain in domains.DOMAINS.items() if domain.ideal is not None])
def test_its_options_are_the_task_s_or_its_own_and_its_summary_has_the_figures_of_all(domain):
    ideal = domains.find(domain).ideal
    summary = ideals.of(domain, suite.TASKS_BY_DOMAIN[domain][0]).summary()
    assert {"value", "accuracy", "mean_interactions", "histogram"} <= set(summary)
    assert sum(summary["histogram"].values()) == pytest.approx(1)
    assert ideal.options()


def some_episodes(hidden):
    """Three answers at once, whatever was hidden."""
    whole, actions = np.arange(3), np.full((3, 1), 4)
    return episodes.Episodes(
        seed=whole,
        episode=whole,
        hidden=hidden,
        answer=np.zeros(3, int),
        label=np.zeros(3, int),
        reward=np.ones(3),
        length=np.ones(3, int),
        interactions=np.zeros(3, int),
        actions=actions,
    )


def stored(tmp_path, domain, task, hidden):
    """What is in the file, and what is read of it."""
    config = config_lib.TrainConfig(domain=domain, task=task, agent=config_lib.preset(domain, task))
    rows = records.table(some_episodes(hidden), config, "learned", 0.1)
    records.write(tmp_path / "rows.parquet", rows)
    return rows, records.read([tmp_path / "rows.parquet"])


@pytest.mark.parametrize("domain", domains.DOMAINS)
def test_every_domain_s_hidden_properties_are_stored_in_the_columns_that_it_names(tmp_path, domain):
    task = suite.TASKS_BY_DOMAIN[domain][0]
    drawn = suite.load_task(domain, task).draw(np.arange(3), np.zeros(3, int))
    rows, frame = stored(tmp_path, domain, task, drawn)
    own = {column.name for column in domains.find(domain).columns}
    others = {column.name for name in domains.DOMAINS for column in domains.find(name).columns} - own
    assert own <= set(frame.columns)
    assert not frame[sorted(others & set(frame.columns))].notna().any().any()
    for name, values in domains.find(domain).fill(drawn).items():
        np.testing.assert_allclose(np.stack(frame[name].to_numpy()), values, rtol=1e-6)


def test_files_of_the_first_two_domains_have_the_columns_that_they_always_had(tmp_path):
    names = [
        "domain",
        "task",
        "difficulty",
        "discount",
        "training_seed",
        "interaction",
        "control_timestep",
        "seed",
        "episode",
        "masses",
        "mass_gap",
        "pattern",
        "actions",
        "answer",
        "label",
        "reward",
        "length",
        "interactions",
        "time",
    ]
    assert records.SCHEMA.names == names
    assert records.schema("which_is_heavier").equals(records.schema("towers"))
    assert records.SCHEMA.field("masses").type == pyarrow.list_(pyarrow.float32())
    assert records.SCHEMA.field("pattern").type == pyarrow.int8()


@pytest.mark.parametrize("shape", [(3,), (3, 4), (3, 2, 5)])
def test_a_domain_without_columns_is_stored_without_whatever_is_hidden(tmp_path, monkeypatch, shape):
    monkeypatch.setitem(domains.DOMAINS, "threshold", base.Domain(name="threshold"))
    rows, frame = stored(tmp_path, "threshold", "features", np.ones(shape))
    assert rows.schema.equals(records.SCHEMA)
    assert frame.masses.isna().all() and frame.pattern.isna().all()
