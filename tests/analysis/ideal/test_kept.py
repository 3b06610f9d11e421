"""What is kept of situations is what simulation finds, and is used for the question that it is of alone."""

import ideals
import numpy as np
import pytest
from seeds import fresh_seed

from physexp.analysis.ideal import hypotheses, kept, search, situations

SHIPPED = [path.stem.split("-") for path in sorted(kept.FOLDER.iterdir())]


@pytest.mark.parametrize("domain, task", SHIPPED)
def test_what_comes_with_the_package_is_of_its_code(domain, task):
    assert ideals.of(domain, task).hypotheses.looks, f"the suite has changed: physexp ideal {domain} --keep"


@pytest.mark.parametrize("domain, task", SHIPPED)
def test_what_comes_with_the_package_is_what_simulation_finds(domain, task):
    known = ideals.of(domain, task).hypotheses
    plain = hypotheses.Hypotheses(domain, task, known.hidden, known.prior)
    found, expected = (situations.Situations(each, 0.0) for each in (known, plain))
    generator, before = np.random.default_rng(fresh_seed()), known.steps
    for _ in range(40):
        one, other = found.start, expected.start
        for action in generator.integers(known.task.num_interactions, size=known.task.rules.step_limit - 1).tolist():
            if not one.groups:
                break
            found.expand(one), expected.expand(other)
            assert {each: parts for each, (parts, _) in one.after.items()} == {
                each: parts for each, (parts, _) in other.after.items()
            }
            one, other = one.after[action][1], other.after[action][1]
    assert known.steps == before and plain.steps > 0


def of_strike(folder, **task_kwargs):
    pucks = np.arange(140)
    known = kept.Hypotheses("strike", "features", pucks, np.full(140, 1 / 140), {"time_limit": 0.4, **task_kwargs})
    known.path = folder / "kept.npz"
    return search.solve(known, 0.0, 0.95)


def test_what_was_kept_is_not_simulated_again_but_for_what_its_policy_sees(tmp_path):
    first = of_strike(tmp_path)
    kept.keep(first)
    second = of_strike(tmp_path)
    assert second.value == first.value and second.bound == first.bound
    assert second.hypotheses.steps < 0.2 * first.hypotheses.steps
    np.testing.assert_array_equal(second.outcomes(), first.outcomes())


def test_of_another_question_or_other_code_nothing_is_kept(tmp_path, monkeypatch):
    kept.keep(of_strike(tmp_path))
    assert of_strike(tmp_path).hypotheses.looks
    assert not of_strike(tmp_path, difficulty=3).hypotheses.looks
    assert not of_strike(tmp_path, time_limit=0.3).hypotheses.looks
    monkeypatch.setattr(kept.mujoco, "__version__", "another")
    assert not of_strike(tmp_path).hypotheses.looks


def test_what_is_known_where_the_label_is_known_is_simulated(tmp_path):
    first = of_strike(tmp_path)
    kept.keep(first)
    second, generator = of_strike(tmp_path), np.random.default_rng(fresh_seed())
    for _ in range(10):
        puck, actions = int(generator.integers(140)), generator.integers(3, size=3)
        assert second.left(puck, actions) == first.left(puck, actions)


def test_of_what_is_found_within_seconds_nothing_is_kept():
    with pytest.raises(ValueError, match="nothing is kept of this ideal experimenter"):
        kept.keep(ideals.of("balance"))
