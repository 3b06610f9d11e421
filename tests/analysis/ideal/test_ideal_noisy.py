"""The policy for noisy readings: its beliefs are exact, and it touches again what it cannot distinguish."""

import numpy as np
import pytest
from seeds import fresh_seed

from physexp import suite
from physexp.analysis import domains
from physexp.analysis.ideal import rollouts
from physexp.suite.domains import which_is_heavier

_DISCOUNT, _NUM_ACTORS, _NUM_ROUNDS = 0.95, 64, 8
NOISE = 0.03  # m; a poke shows the lightest and the heaviest block 0.16 m apart.


def ideal(**task_kwargs):
    return domains.find("which_is_heavier").ideal("features", task_kwargs, _DISCOUNT)


@pytest.fixture(scope="module")
def played():
    """Episodes: masses, actions, the reward, and the beliefs at the answer."""
    seed = fresh_seed()
    solution = ideal(noise=NOISE)
    actors = [solution.actor() for _ in range(_NUM_ACTORS)]
    batch = suite.load_batch("which_is_heavier", "features", _NUM_ACTORS, {"noise": NOISE, "random": seed})
    found = []
    for episode in range(_NUM_ROUNDS):
        actions = [[] for _ in actors]
        for rows, acted, after in rollouts.play_round(actors, batch, episode):
            for row, action, reward in zip(rows, acted, after.reward, strict=True):
                actions[row].append(int(action))
                if action >= which_is_heavier.NUM_BLOCKS:
                    found.append((batch.hidden[row].copy(), actions[row], reward, actors[row].beliefs()))
    assert len(found) == _NUM_ACTORS * _NUM_ROUNDS
    return found


def test_it_is_right_as_often_as_it_believes(played):
    surprises = np.array([reward - (2 * beliefs.max() - 1) for _, _, reward, beliefs in played])
    assert abs(surprises.mean()) < 5 * surprises.std() / len(surprises) ** 0.5


def test_its_beliefs_agree_with_importance_sampling():
    """Masses are drawn, and each draw is weighted by the likelihood of the readings."""
    seed = fresh_seed()
    actions = np.random.default_rng(seed).integers(4, size=4)
    environment = suite.load("which_is_heavier", "features", {"noise": NOISE, "random": seed})
    actor = ideal(noise=NOISE).actor()
    actor.observe_first(environment.reset())
    count = 60_000
    masses = which_is_heavier.draw_masses(np.full(count, seed + 1), np.arange(count), difficulty=5.0)
    draws = suite.load_batch("which_is_heavier", "features", count)
    draws.reset(hidden=masses)
    logs = np.zeros(count)
    for action in actions:
        timestep = environment.step(action)
        actor.observe(action, timestep)
        exact = draws.step(np.full(count, action)).observation["heights"]
        logs -= 0.5 * (((timestep.observation["heights"] - exact) / NOISE) ** 2).sum(1)
    weights = np.exp(logs - logs.max())
    weights /= weights.sum()
    expected = np.bincount(masses.argmax(1), weights=weights, minlength=4)
    error = np.sqrt((weights**2).sum())  # That of a share among so many effective draws, at most.
    np.testing.assert_allclose(actor.beliefs(), expected, atol=5 * error)


def test_it_touches_again_where_a_gap_is_small(played):
    gaps = which_is_heavier.mass_gaps(np.array([masses for masses, *_ in played]))
    is_again = np.array([len(set(actions)) < len(actions) for _, actions, *_ in played])
    again, once = gaps[is_again], gaps[~is_again]
    error = np.hypot(again.std() / len(again) ** 0.5, once.std() / len(once) ** 0.5)
    assert once.mean() - again.mean() > 3 * error  # In 512 episodes, about 7.


def test_it_delays_the_answer_if_readings_are_useless():
    """A guess costs 0.5, discounted: the least in the last of the 100 steps, where silence costs 1."""
    actors = [ideal(noise=100.0).actor() for _ in range(2)]
    batch = suite.load_batch("which_is_heavier", "features", len(actors), {"noise": 100.0, "random": fresh_seed()})
    *others, last = (acted for _, acted, _ in rollouts.play_round(actors, batch, 0))
    assert len(others) == 99 and (np.array(others) < 4).all() and (last >= 4).all()
