"""The ideal experimenter of every domain, and the facts that domains declare."""

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
from physexp.analysis.domains import base
from physexp.analysis.ideal import hypotheses, random_play, rollouts, search
from physexp.suite.domains import crush

NAMES = [name for name, domain in domains.DOMAINS.items() if domain.ideal is not None]
TASKS = [(domain, task) for domain, task in suite.tagged("features") if domain in NAMES]


@pytest.mark.parametrize(("domain", "task"), TASKS)
def test_its_mean_return_in_the_real_environment_is_its_value(domain, task):
    discount = domains.find(domain).discount
    options = ideals.QUICK.get(domain, {})
    solution = ideals.of(domain, task, **options)
    rewards, lengths = rollouts.play([solution.actor() for _ in range(48)], domain, task, options, 8, fresh_seed())
    returns = rewards * discount ** (lengths - 1)
    # A return is plus or minus the discount to the number of interactions. In some domains wrong answers are so rare
    # that a sample may have none, so its own spread cannot be used.
    histogram = solution.figures()["histogram"]
    square = sum(share * discount ** (2 * interactions) for interactions, share in histogram.items())
    variance = max(0.0, square - solution.value**2)
    # Bernstein's inequality for returns within 2 of their mean: t is exceeded with a probability of
    # 2 exp(-N t^2 / (2 variance + 4 t / 3)), which is 1e-6.
    chance = math.log(2e6)
    most = (2 * chance / 3 + math.sqrt((2 * chance / 3) ** 2 + 2 * returns.size * chance * variance)) / returns.size
    assert abs(returns.mean() - solution.value) < most + 1e-3
    assert solution.bound == pytest.approx(solution.value)


@pytest.mark.parametrize(("domain", "task"), TASKS)
def test_its_belief_starts_at_the_prior_and_ends_at_its_answer(domain, task):
    options = ideals.QUICK.get(domain, {})
    solution = ideals.of(domain, task, **options)
    environment = suite.load(domain, task, task_kwargs={**options, "random": fresh_seed()})
    recorder = observers.Watcher()
    loop = environment_loop.EnvironmentLoop(environment, solution.actor(), [recorder])
    for _ in range(5):
        loop.run_episode()
        beliefs = solution.beliefs(np.array(environment.task.hidden), np.array(recorder.actions))
        assert beliefs.shape == (len(recorder.actions) + 1, environment.task.num_labels)
        np.testing.assert_allclose(beliefs.sum(axis=1), 1)
        assert beliefs[-1].argmax() == recorder.actions[-1] - environment.task.num_interactions
        np.testing.assert_array_equal(beliefs[-1], beliefs[-2])  # An answer reveals nothing.
        assert beliefs[-1].max() > beliefs[0].max()


@pytest.mark.parametrize(
    "domain",
    [pytest.param(name, marks=[pytest.mark.long] * (name in ideals.QUICK)) for name in NAMES if name != "towers"],
)
def test_there_is_something_to_find_out(domain, monkeypatch):
    monkeypatch.setattr(random_play, "_NUM_SEQUENCES", 64)  # The standard error stays below 0.03.
    found = ideals.of(domain).summary()
    assert {"value", "bound", "accuracy"} <= set(found) and sum(found["histogram"].values()) == pytest.approx(1)
    assert found["mean_interactions"] >= 2
    assert found["at_once"] <= 0.3 * found["value"]
    best_at_random = found.get("random_bound", found["random_value"])
    # Which is Heavier has four blocks and reads a mass exactly, so random pokes are nearly as good as chosen ones.
    assert best_at_random <= (1 if domain == "which_is_heavier" else 0.8) * found["value"]


@pytest.mark.parametrize(
    ("domain", "difficulties", "task_kwargs"),
    [
        ("which_is_heavier", (3.0, 10.0), {}),
        ("threshold", (1, 2, 3), {}),
        ("balance", (1, 3), {}),
        ("strings", (1, 1.5, 3, 5), {}),
        ("sealed_box", (1, 2, 3), {"time_limit": 0.5}),
        ("strike", (1, 2, 3), {"time_limit": 0.5}),
        ("lump", (1, 2, 3), {"time_limit": 0.6}),
    ],
)
def test_a_larger_difficulty_is_easier(domain, difficulties, task_kwargs):
    solutions = [ideals.of(domain, difficulty=difficulty, **task_kwargs) for difficulty in difficulties]
    assert (np.diff([solution.value for solution in solutions]) > 0).all()
    if not task_kwargs:
        assert (np.diff([solution.figures()["mean_interactions"] for solution in solutions]) < 0).all()


def test_more_blocks_are_harder():
    values = [ideals.of("which_is_heavier", num_blocks=number, difficulty=3.0).value for number in (2, 4, 6)]
    assert (np.diff(values) < -0.05).all()


def test_more_cans_are_easier_to_crush():
    solutions = [ideals.of("crush", num_cans=number) for number in (1, 2, 3)]
    assert (np.diff([solution.value for solution in solutions]) > 0.01).all()
    assert (np.diff([solution.figures()["mean_interactions"] for solution in solutions]) < 0).all()


def test_a_search_in_the_simulation_finds_the_value_of_presses():
    """In short episodes, with a strength for each label, by the family that knows nothing of cans."""
    strengths = crush.FORCE_SPACING * (np.arange(crush.NUM_FORCES) + 0.5)
    options = {"time_limit": 0.3}
    known = hypotheses.Hypotheses("crush", "features", strengths, crush.PRIOR, options)
    found = search.Solution(known, 0.0, 0.95)
    assert found.bound == pytest.approx(found.value) == pytest.approx(ideals.of("crush", **options).value)


def test_a_question_is_solved_once_whatever_its_seed():
    find = domains.find("threshold").ideal
    assert find("features", {"random": 1}, 0.95) is find("features", {"random": 2}, 0.95)
    assert find("features", {"difficulty": 3}, 0.95) is not find("features", {}, 0.95)


@pytest.mark.parametrize(
    ("domain", "task", "task_kwargs", "options", "message"),
    [
        ("threshold", "features", {}, {"discount": 0}, "discount is 0; give a number from 0 to 1 but not 0"),
        ("towers", "direct_features", {}, {"discount": math.nan}, "discount is nan"),
        ("towers", "features", {}, {}, "task_name is 'features'; tasks of towers: direct_features"),
        ("towers", "direct_features", {}, {"resolution": -1.0}, "resolution is -1.0; give a finite number >= 0"),
        ("towers", "fist_pixels", {"variation": 1.0}, {}, "task is 'fist_pixels'; .* choose from direct_features"),
        ("threshold", "features", {"flag_noise": 0.1, "time_limit": 3}, {}, "an episode has 30 steps; .* at most 15"),
        ("strings", "features", {"step_variation": 0.5}, {}, "step_variation is 0.5; give 0"),
        ("which_is_heavier", "features", {"difficulty": 1e7}, {}, "difficulty is 1.*; give a number from 1 to 1e.06"),
        ("which_is_heavier", "features", {"num_blocks": 1}, {}, "num_blocks is 1; give an integer >= 2 and <= 12"),
        (
            "towers",
            "direct_features",
            {"reveal": True},
            {"resolution": 0.1},
            "resolution is 0.1; leave it out with rev",
        ),
    ],
)
def test_a_question_without_an_answer_is_refused_in_one_line(domain, task, task_kwargs, options, message):
    with pytest.raises(ValueError, match=message):
        domains.find(domain).ideal(task, task_kwargs, **{"discount": 0.95, **options})


@pytest.mark.parametrize("domain", domains.DOMAINS)
def test_hidden_columns_have_a_row_for_each_episode(domain):
    episodes = np.arange(3)
    played = suite.load_task(domain, suite.TASKS_BY_DOMAIN[domain][0])
    columns = domains.find(domain).hidden_columns(played.draw(episodes, episodes))
    assert columns and all(len(values) == 3 for values in columns.values())


def test_other_packages_register_facts_about_their_domains(monkeypatch):
    marbles = base.Domain(name="marbles", labels={"features": "M-F"})
    entry = types.SimpleNamespace(name="marbles", load=lambda: marbles)
    monkeypatch.setattr(domains.metadata, "entry_points", lambda group: [entry] if group == "physexp.facts" else [])
    assert domains._registered() == {"marbles": marbles}
    assert domains.find("glasses") == base.Domain(name="glasses")
