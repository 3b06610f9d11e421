"""The ideal experimenter of every domain that has one, and what was hidden in stored episodes."""

import math
import types

import ideals
import numpy as np
import observers
import pytest
from seeds import fresh_seed

from physexp import suite
from physexp.agents import environment_loop
from physexp.analysis import domains
from physexp.analysis.data import episodes
from physexp.analysis.domains import base
from physexp.analysis.ideal import rollouts
from physexp.analysis.training import config as config_lib
from physexp.analysis.training import records

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
    rewards, lengths = rollouts.play([solution.actor() for _ in range(64)], domain, task, {}, 10, fresh_seed())
    returns = rewards * discount ** (lengths - 1)
    # A return is plus or minus the discount to the number of interactions. Wrong answers are so rare in some domains
    # that a sample may have none, and say nothing of their spread.
    histogram = solution.summary()["histogram"]
    square = sum(share * discount ** (2 * interactions) for interactions, share in histogram.items())
    variance = max(0.0, square - solution.value**2)
    # Bernstein's inequality for returns within 2 of their mean: t is exceeded with a probability of
    # 2 exp(-N t^2 / (2 variance + 4 t / 3)), which is 1e-6.
    chance = math.log(2e6)
    most = (2 * chance / 3 + math.sqrt((2 * chance / 3) ** 2 + 2 * returns.size * chance * variance)) / returns.size
    assert abs(returns.mean() - solution.value) < most + 1e-3
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
def test_its_summary_has_the_figures_of_all(domain):
    summary = ideals.of(domain, suite.TASKS_BY_DOMAIN[domain][0]).summary()
    assert {"value", "accuracy", "mean_interactions", "histogram"} <= set(summary)
    assert sum(summary["histogram"].values()) == pytest.approx(1)


def stored(path, domain, task, task_kwargs, answers=None):
    """Stores three answers at once; returns what was hidden."""
    whole, actions = np.arange(3), np.full((3, 1), 4)
    played = suite.load_task(domain, task, task_kwargs)
    hidden = played.draw(whole, whole)
    rows = episodes.Episodes(
        seed=whole,
        episode=whole,
        hidden=hidden,
        answer=played.answers(hidden) if answers is None else answers,
        label=np.zeros(3, int),
        reward=np.ones(3),
        length=np.ones(3, int),
        interactions=np.zeros(3, int),
        actions=actions,
    )
    agent = config_lib.preset(domain, task)
    config = config_lib.TrainConfig(domain=domain, task=task, task_kwargs=task_kwargs, agent=agent)
    records.write(path, records.table(rows, config, "learned", 0.1))
    return hidden


CHOICES = [(name, {}) for name in domains.DOMAINS]
CHOICES += [(name, {"difficulty": 2.0}) for name in domains.DOMAINS if hasattr(suite.options(name), "difficulty")]
CHOICES += [("which_is_heavier", {"difficulty": 2.3})]  # Which single precision does not have.


@pytest.mark.parametrize(("domain", "task_kwargs"), CHOICES)
def test_what_was_hidden_in_stored_episodes_is_drawn_again_in_the_columns_that_a_domain_names(
    tmp_path, domain, task_kwargs
):
    hidden = stored(tmp_path / "rows.parquet", domain, suite.TASKS_BY_DOMAIN[domain][0], task_kwargs)
    expected = domains.find(domain).hidden_columns(hidden)
    frame = records.read([tmp_path / "rows.parquet"], ["reward", *expected])
    assert list(frame.columns) == ["reward", *expected, "commit"]
    for name, values in expected.items():
        np.testing.assert_array_equal(np.stack(frame[name].to_numpy()), values)


def test_episodes_whose_answers_are_not_those_of_what_is_drawn_today_are_refused(tmp_path):
    path = tmp_path / "rows.parquet"
    hidden = stored(path, "which_is_heavier", "features", {}, answers=np.zeros(3, int))
    assert hidden.argmax(axis=1).any()
    with pytest.raises(ValueError, match=r"rows.parquet has episodes that are drawn otherwise today; remove it"):
        records.read([path], ["masses"])
    assert len(records.read([path], ["reward"])) == 3


def test_a_domain_without_columns_is_stored_and_read_as_all_others(tmp_path, monkeypatch):
    monkeypatch.setitem(domains.DOMAINS, "threshold", base.Domain(name="threshold"))
    stored(tmp_path / "rows.parquet", "threshold", "features", {})
    assert list(records.read([tmp_path / "rows.parquet"]).columns) == [
        *records.SCHEMA.names,
        *records.RECKONED.names,
        "commit",
    ]
