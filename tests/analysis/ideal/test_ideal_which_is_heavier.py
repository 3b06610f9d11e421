"""The ideal experimenter of Which is Heavier, by hand, by brute force, and in the real environment."""

import math

from chance import P_VALUE
import numpy as np
import pytest
from scipy import integrate, stats
from seeds import fresh_seed

from physexp import suite
from physexp.analysis import domains
from physexp.analysis.ideal import calibration, mistakes, odd_one_out
from physexp.suite.engine import priors


def posterior(masses, difficulty):
    beliefs, _ = solve(difficulty, 0.95, masses.shape[1]).evaluate(masses, left=1)
    return beliefs


def solve(difficulty, discount, blocks=4, step_limit=math.inf):
    return odd_one_out.Solution(priors.OddOneOut(blocks, difficulty), discount, step_limit)


def draw(generator, count, difficulty, blocks=4):
    """Returns masses drawn by numpy's Beta distribution, and the heavy block."""
    masses = generator.beta(1, difficulty, (count, blocks))
    heavy = generator.integers(blocks, size=count)
    masses[np.arange(count), heavy] = generator.beta(difficulty, 1, count)
    return masses, heavy


def test_all_blocks_are_equally_likely_until_masses_are_known():
    np.testing.assert_allclose(posterior(np.full((1, 4), np.nan), 3.0), np.full((1, 4), 0.25))
    np.testing.assert_array_equal(posterior(np.array([[0.2, 0.9, 0.91, 0.1]]), 3.0), [[0, 0, 1, 0]])


def test_an_untouched_block_can_be_the_best_answer():
    # Two blocks, difficulty 2, mass 0.3 seen: ratio r = 0.3 / 0.7 = 3/7, so it is the heavy one with probability
    # (3/7) / (3/7 + 1) = 0.3, and heaviest with 0.3 * (1 - 0.7^2) + 0.7 * 0.3^2 = 0.153 + 0.063 = 0.216.
    solution, known = solve(2.0, 0.5, 2), np.array([[0.3, np.nan]])
    beliefs, poke = solution.evaluate(known, left=9)
    np.testing.assert_allclose(beliefs, [[0.216, 0.784]])
    assert poke[0] == pytest.approx(0.5)  # Nothing is left to find out after it.
    assert solution.actions(known, left=9) == [2 + 1]


@pytest.mark.parametrize("difficulty", [1.0, 5.0])
def test_the_posterior_is_calibrated_on_drawn_masses(difficulty):
    generator = np.random.default_rng(fresh_seed())
    masses, _ = draw(generator, 100_000, difficulty)
    known = masses.copy()
    known[:, 2:] = np.nan
    likely = posterior(known, difficulty)
    np.testing.assert_allclose(likely.sum(axis=1), 1)
    truth = np.eye(4)[masses.argmax(axis=1)]
    for block in range(4):  # With a probability of about p, it is the heaviest in a share p.
        for low, high in ((0.02, 0.2), (0.2, 0.5), (0.5, 0.8), (0.8, 0.98)):
            rows = (likely[:, block] > low) & (likely[:, block] <= high)
            if rows.sum() > 200:
                found = stats.binomtest(int(truth[rows, block].sum()), rows.sum(), likely[rows, block].mean())
                assert found.pvalue > P_VALUE


def test_without_discount_it_finds_out_everything():
    solution = solve(3.0, 1.0, 3)
    assert solution.value == pytest.approx(1.0, abs=1e-6)
    assert solution.figures()["accuracy"] > 0.9999


def test_at_a_very_large_difficulty_it_looks_for_one_heavy_block(monkeypatch):
    monkeypatch.setattr(odd_one_out, "_EPISODES", 2**14)
    # It is poked first, second, third, or never; the last two take three pokes: 1/4, 1/4, 1/2.
    histogram = solve(200.0, 0.95).figures()["histogram"]
    assert list(histogram.values()) == pytest.approx([0, 0.25, 0.25, 0.5], abs=2e-3)
    # 0.95 / 4 + 0.95^2 / 4 + 0.95^3 / 2
    assert solve(200.0, 0.95).value == pytest.approx(0.8918125, abs=1e-3)


def test_simulated_episodes_earn_the_value():
    masses, _ = draw(np.random.default_rng(fresh_seed()), 50_000, difficulty=3.0, blocks=5)
    solution = solve(3.0, 0.95, blocks=5)
    pokes, right = solution.play(masses)
    returns = 0.95**pokes * np.where(right, 1, -1)
    assert abs(returns.mean() - solution.value) < 4.5 * returns.std() / math.sqrt(len(returns)) + 1e-4


def test_a_finer_grid_changes_little(monkeypatch):
    coarse = solve(3.0, 0.95, 3).value
    odd_one_out._touch.cache_clear()
    monkeypatch.setattr(odd_one_out, "_LARGEST_NODES", 800)
    monkeypatch.setattr(odd_one_out, "_RATIO_NODES", 65)
    monkeypatch.setattr(odd_one_out, "_QUADRATURE_NODES", 96)
    assert abs(solve(3.0, 0.95, 3).value - coarse) < 1e-4
    odd_one_out._touch.cache_clear()


def value_by_tree(difficulty, discount, blocks, step_limit, at_random=False, horizon=math.inf, bins=32):
    """Returns the value for masses in `bins` equal parts of [0, 1], from all sequences of pokes.

    It is that of the best pokes, of random ones, or of one that looks some pokes ahead.
    """
    edges = np.linspace(0, 1, bins + 1)
    heavy, light = np.diff(edges**difficulty), np.diff(1 - (1 - edges) ** difficulty)
    heavy_below, light_below = heavy.cumsum() - heavy / 2, light.cumsum() - light / 2

    def worth(seen, left, horizon=math.inf):
        """Returns the value of known masses times their probability; `seen` has an array for each poked block."""
        seen = np.broadcast_arrays(*seen)
        unknown = blocks - len(seen)
        all_light = np.prod([light[part] for part in seen], axis=0)
        one_heavy = sum(all_light / light[part] * heavy[part] for part in seen)
        chance = (one_heavy + unknown * all_light) / blocks
        if not seen:
            largest_known = 0.0
        elif not unknown:
            largest_known = chance
        else:
            top = np.max(seen, axis=0)
            smaller = light_below[top] ** (unknown - 1)
            unknown_heavy = unknown * all_light * heavy_below[top] * smaller
            largest_known = (one_heavy * light_below[top] * smaller + unknown_heavy) / blocks
        likeliest = np.maximum(largest_known, (chance - largest_known) / max(unknown, 1))
        answer = 2 * likeliest - chance
        if left == 1:
            return answer
        pokes = (
            worth([*(part[..., None] for part in seen), np.arange(bins)], left - 1, horizon).sum(-1)
            if unknown
            else answer
        )
        if at_random:
            again = worth(seen, left - 1) if seen else 0.0
            pokes = unknown / blocks * pokes * (unknown > 0) + len(seen) / blocks * again
        planned = discount * pokes if horizon == math.inf else worth(seen, min(left, horizon + 1))
        return np.where(planned > answer + 1e-12, discount * pokes, answer)

    return float(worth([], step_limit, horizon))


@pytest.mark.parametrize(("difficulty", "blocks"), [(3.0, 4), (2.0, 2)])
@pytest.mark.parametrize("step_limit", [1, 3, 5])
def test_a_tree_of_all_pokes_finds_the_same_values(difficulty, blocks, step_limit):
    solution = solve(difficulty, 0.95, blocks, step_limit)
    tree = [
        value_by_tree(difficulty, 0.95, blocks, step_limit, **kind)
        for kind in ({}, {"at_random": True}, {"horizon": 1})
    ]
    found = [solution.value, solution.compared()["random_value"], solution.planning()["lookahead_1"]]
    assert found == pytest.approx(tree, abs=5e-4)  # The parts' width, squared.


def test_it_reads_masses_from_heights_after_any_control_step():
    kwargs = {"control_timestep": 0.05}
    mass_of = calibration.calibrate("which_is_heavier", "features", "heights", kwargs)
    environment = suite.load("which_is_heavier", "features", task_kwargs={**kwargs, "random": fresh_seed()})
    for episode in range(20):
        environment.reset()
        block = episode % 4
        observation = environment.step(block).observation
        assert mass_of(observation, block) == pytest.approx(environment.task.hidden[block], abs=1e-4)


def test_a_control_step_in_which_blocks_reach_the_ceiling_is_refused():
    with pytest.raises(ValueError, match="control_timestep is 0.5 s, after which things .* look the same; give a sh"):
        calibration.calibrate("which_is_heavier", "features", "heights", {"control_timestep": 0.5})


def test_each_mistake_is_counted_as_its_kind():
    solution = solve(3.0, 0.95)
    masses = np.array([[0.5, 0.9, 0.1, 0.2]] * 5)
    actions = [
        np.array([0, 1, 2, 3, 5]),  # Poked all; may have poked too much, but answered right.
        np.array([0, 0, 1, 2, 3, 5]),  # The same with a second look at block 0.
        np.array([0, 1, 2, 3, 4]),  # Answered 0 when 1 is known to be heavier.
        np.array([4]),  # A guess at once.
        np.zeros(100, int),  # Never answered.
    ]
    costs = mistakes.of_episodes(solution.judge_all(masses, actions), actions, 0.95)
    assert costs["wrong"][2] == pytest.approx(0.95**4 * 2)  # Worth -1 instead of 1, after four pokes.
    assert costs["uninformative"][0] == 0 and costs["uninformative"][1] > 0
    assert costs["early"][3] == pytest.approx(solution.value + 0.5)  # A guess is worth 2/4 - 1.
    assert costs["silence"][4] > 0 and not costs["silence"][:4].any()
    assert not costs["inferior"].any()  # All untouched blocks are equally good.
    np.testing.assert_array_equal(costs["early"][:3], 0)


def test_from_images_it_has_a_value_but_no_actor():
    solution = domains.find("which_is_heavier").ideal("pixels", {}, 0.95)
    assert 0.8 < solution.value == solution.bound
    with pytest.raises(ValueError, match="reads features, not images; choose a task with features"):
        solution.actor()


def test_the_beliefs_in_an_episode_are_the_posterior_of_poked_blocks():
    hidden = np.array([0.3, 0.8, 0.1, 0.2])
    found = solve(3.0, 0.95).beliefs(hidden, np.array([0, 0, 1, 4 + 1]))
    start, first, second = np.full((3, 4), np.nan)
    first[0], second[:2] = 0.3, [0.3, 0.8]
    np.testing.assert_array_equal(found, posterior(np.array([start, first, first, second, second]), 3.0))


@pytest.mark.parametrize("difficulty, discount", [(3.0, 0.95), (2.0, 0.6)])
def test_touches_of_two_things_earn_an_integral(difficulty, discount):
    """After the first touch one of two things is known; a further touch is of the other one, or useless."""
    solution = solve(difficulty, discount, 2)
    going_on = discount / 2 / (1 - discount / 2)  # g / 2 + (g / 2)^2 + ...

    def worth(mass, next_touch):
        density = 0.5 * difficulty * (mass ** (difficulty - 1) + (1 - mass) ** (difficulty - 1))
        weight = (mass / (1 - mass)) ** (difficulty - 1)
        right = (weight * (1 - (1 - mass) ** difficulty) + mass**difficulty) / (weight + 1)
        return density * max(2 * max(right, 1 - right) - 1, next_touch)

    best, at_random = (integrate.quad(worth, 0, 1, (touch,), limit=400)[0] for touch in (discount, going_on))
    assert solution.value == pytest.approx(max(0, discount * best), abs=1e-4)
    assert solution.compared() == {"at_once": 0, "random_value": pytest.approx(max(0, discount * at_random), abs=1e-4)}
