"""The ideal experimenter of Which is Heavier, against hand calculation, brute force and the real environment."""

import math
import types

from chance import P_VALUE
import numpy as np
import pytest
from scipy import integrate, stats
from seeds import fresh_seed

from physexp import suite
from physexp.agents import environment_loop
from physexp.analysis import domains
from physexp.analysis.ideal import calibration, mistakes, odd_one_out, rollouts
from physexp.suite.domains import which_is_heavier
from physexp.suite.engine import priors


def posterior(masses, difficulty):
    return odd_one_out.posterior(masses, priors.OddOneOut(masses.shape[1], difficulty))


def solve(difficulty, discount, blocks=4, step_limit=math.inf):
    return odd_one_out.Solution(priors.OddOneOut(blocks, difficulty), discount, step_limit)


def draw(generator, count, difficulty, blocks=4):
    """Masses drawn the long way round: by numpy's Beta, the heavy block by index."""
    masses = generator.beta(1, difficulty, (count, blocks))
    heavy = generator.integers(blocks, size=count)
    masses[np.arange(count), heavy] = generator.beta(difficulty, 1, count)
    return masses, heavy


def test_before_any_poke_all_blocks_are_equally_likely():
    np.testing.assert_allclose(posterior(np.full((1, 4), np.nan), 3.0), np.full((1, 4), 0.25))


def test_with_all_blocks_known_the_heaviest_is_it():
    masses = np.array([[0.2, 0.9, 0.91, 0.1]])
    np.testing.assert_array_equal(posterior(masses, 3.0), [[0, 0, 1, 0]])


def test_two_uniform_blocks_are_judged_by_the_known_one_alone():
    # Difficulty 1 makes every mass uniform: the other block is lighter than 0.7 with probability 0.7.
    np.testing.assert_allclose(posterior(np.array([[0.7, np.nan]]), 1.0), [[0.7, 0.3]])


def test_a_block_never_poked_can_be_the_best_answer():
    # Two blocks, difficulty 2, mass 0.3 seen: ratio r = 0.3 / 0.7 = 3/7, so it is the heavy one with probability
    # (3/7) / (3/7 + 1) = 0.3, and heaviest with 0.3 * (1 - 0.7^2) + 0.7 * 0.3^2 = 0.153 + 0.063 = 0.216.
    found = posterior(np.array([[0.3, np.nan]]), 2.0)
    np.testing.assert_allclose(found, [[0.216, 0.784]])
    answer, poke = solve(2.0, 0.5, 2).values(np.array([[0.3, np.nan]]), left=9)
    assert answer[0] == pytest.approx(2 * 0.784 - 1)
    assert poke[0] == pytest.approx(0.5)  # Nothing is left to find out after it.
    assert solve(2.0, 0.5, 2).actions(np.array([[0.3, np.nan]]), left=9) == [2 + 1]


def test_the_posterior_depends_on_every_mass_seen():
    lone, pair = (posterior(np.array([[0.5, other, np.nan, np.nan]]), 3.0)[0, 0] for other in (0.1, 0.45))
    assert abs(lone - pair) > 0.01


@pytest.mark.parametrize("difficulty", [1.0, 3.0, 10.0])
def test_the_posterior_is_what_is_found_among_many_drawn_masses(difficulty):
    generator = np.random.default_rng(fresh_seed())
    masses, _ = draw(generator, 400_000, difficulty)
    known = masses.copy()
    known[:, 2:] = np.nan
    likely = posterior(known, difficulty)
    np.testing.assert_allclose(likely.sum(axis=1), 1)
    truth = np.eye(4)[masses.argmax(axis=1)]
    for block in range(4):  # Where it is said to be likely with about p, it is the heaviest in a share p.
        for low, high in ((0.02, 0.2), (0.2, 0.5), (0.5, 0.8), (0.8, 0.98)):
            rows = (likely[:, block] > low) & (likely[:, block] <= high)
            if rows.sum() > 200:
                found = stats.binomtest(int(truth[rows, block].sum()), rows.sum(), likely[rows, block].mean())
                assert found.pvalue > P_VALUE


def test_the_value_for_two_uniform_blocks_is_the_integral_done_by_hand():
    # After one poke of mass m the best answer is right with probability max(m, 1 - m); poking on is worth g = 0.8.
    # So the value is 0.8 * integral of max(2 max(m, 1 - m) - 1, 0.8) = 0.8 * 2 * (0.4 * 0.8 + integral of 2m - 1 from
    # 0.9 to 1) = 1.6 * (0.32 + 0.09) = 0.656.
    assert solve(1.0, 0.8, 2).value == pytest.approx(0.656, abs=1e-4)


def test_the_value_for_two_blocks_is_the_integral_done_numerically():
    difficulty, discount = 3.0, 0.9

    def gain(mass):
        density = 0.5 * difficulty * (mass ** (difficulty - 1) + (1 - mass) ** (difficulty - 1))
        weight = (mass / (1 - mass)) ** (difficulty - 1)
        lighter = 1 - (1 - mass) ** difficulty
        right = (weight * lighter + mass**difficulty) / (weight + 1)
        return density * max(2 * max(right, 1 - right) - 1, discount)

    expected = discount * integrate.quad(gain, 0, 1, limit=400)[0]
    assert solve(difficulty, discount, 2).value == pytest.approx(expected, abs=1e-4)


def test_without_a_cost_of_information_all_is_found_out():
    solution = solve(3.0, 1.0)
    assert solution.value == pytest.approx(1.0, abs=1e-6)
    assert solution.summary()["accuracy"] > 0.9999


def test_when_information_costs_nearly_everything_nothing_is_worth_much():
    # A guess is worth 2/4 - 1 = -0.5, poking once at most 0.1.
    solution = solve(5.0, 0.1)
    assert 0 < solution.value < 0.1


def test_with_ever_easier_questions_one_heavy_block_is_looked_for():
    # It is found first, second, or else (known without poking the fourth) after three pokes: 1/4, 1/4, 1/2.
    histogram = solve(200.0, 0.95).figures()["histogram"]
    assert list(histogram.values()) == pytest.approx([0, 0.25, 0.25, 0.5], abs=2e-3)
    # 0.95 / 4 + 0.95^2 / 4 + 0.95^3 / 2
    assert solve(200.0, 0.95).value == pytest.approx(0.8918125, abs=1e-3)


@pytest.mark.parametrize(("difficulty", "discount", "blocks"), [(3.0, 0.95, 4), (5.0, 0.99, 4), (10.0, 0.9, 6)])
def test_what_simulated_episodes_earn_is_the_value(difficulty, discount, blocks):
    generator = np.random.default_rng(fresh_seed())
    masses, _ = draw(generator, 200_000, difficulty, blocks)
    solution = solve(difficulty, discount, blocks)
    pokes, right = solution.play(masses)
    returns = discount**pokes * np.where(right, 1, -1)
    assert abs(returns.mean() - solution.value) < 4.5 * returns.std() / math.sqrt(len(returns)) + 1e-4


def test_a_finer_grid_changes_little(monkeypatch):
    coarse = solve(3.0, 0.95).value
    odd_one_out._touch.cache_clear()
    monkeypatch.setattr(odd_one_out, "_LARGEST_NODES", 800)
    monkeypatch.setattr(odd_one_out, "_RATIO_NODES", 65)
    monkeypatch.setattr(odd_one_out, "_QUADRATURE_NODES", 96)
    assert abs(solve(3.0, 0.95).value - coarse) < 1e-4
    odd_one_out._touch.cache_clear()


def test_no_rule_of_thumb_earns_more():
    generator = np.random.default_rng(fresh_seed())
    masses, _ = draw(generator, 200_000, 3.0)
    value = solve(3.0, 0.95).value
    for threshold in np.linspace(0.5, 1.0, 11):  # Stop at the first block heavier than a threshold.
        heavy = masses > threshold
        pokes = np.where(heavy.any(axis=1), heavy.argmax(axis=1) + 1, 4)
        seen = np.where(np.arange(4) < pokes[:, None], masses, -1)
        returns = 0.95**pokes * np.where(seen.argmax(axis=1) == masses.argmax(axis=1), 1, -1)
        assert returns.mean() < value + 4.5 * returns.std() / math.sqrt(len(returns))


def value_by_tree(difficulty, discount, blocks, step_limit, at_random, bins=32):
    """The value where each mass is one of so many equal parts of [0, 1], by going through all sequences of pokes."""
    edges = np.linspace(0, 1, bins + 1)
    heavy, light = np.diff(edges**difficulty), np.diff(1 - (1 - edges) ** difficulty)
    heavy_below, light_below = heavy.cumsum() - heavy / 2, light.cumsum() - light / 2

    def worth(seen, left):
        """The worth of known masses times their probability; `seen` has an array of parts for each poked block."""
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
        pokes = worth([*(part[..., None] for part in seen), np.arange(bins)], left - 1).sum(-1) if unknown else answer
        if at_random:
            again = worth(seen, left - 1) if seen else 0.0
            pokes = unknown / blocks * pokes * (unknown > 0) + len(seen) / blocks * again
        return np.maximum(answer, discount * pokes)

    return float(worth([], step_limit))


@pytest.mark.parametrize(("difficulty", "blocks"), [(5.0, 4), (3.0, 4), (2.0, 2)])
@pytest.mark.parametrize("step_limit", [1, 2, 3, 4, 5])
def test_the_value_within_a_time_limit_is_that_of_a_tree(difficulty, blocks, step_limit):
    solution = solve(difficulty, 0.95, blocks, step_limit)
    tree = [value_by_tree(difficulty, 0.95, blocks, step_limit, at_random) for at_random in (False, True)]
    assert [solution.value, solution.random_value] == pytest.approx(tree, abs=5e-4)  # The parts' width, squared.


def test_a_long_time_limit_does_not_change_the_value():
    for at_random in ("value", "random_value"):
        unlimited, limited = (getattr(solve(5.0, 0.95, 3, limit), at_random) for limit in (math.inf, 60))
        assert limited == pytest.approx(unlimited, abs=1e-7)


@pytest.mark.parametrize("time_limit", [0.2, 0.3, 0.4])
def test_within_a_time_limit_it_earns_its_value_in_the_real_environment(time_limit):
    task_kwargs = {"time_limit": time_limit}
    solution = domains.find("which_is_heavier").ideal("features", task_kwargs, 0.95)
    actors = [solution.actor() for _ in range(100)]
    rewards, lengths = rollouts.play(actors, "which_is_heavier", "features", task_kwargs, 20, fresh_seed())
    returns = rewards * 0.95 ** (lengths - 1)
    assert abs(returns.mean() - solution.value) < 4.5 * returns.std() / math.sqrt(returns.size) + 1e-3


@pytest.mark.parametrize("control_timestep", [0.1, 0.05])
def test_it_reads_masses_from_heights_in_the_real_environment(control_timestep):
    seed = fresh_seed()
    mass_of = calibration.calibrate("which_is_heavier", "features", "heights", {"control_timestep": control_timestep})
    environment = suite.load(
        "which_is_heavier", "features", task_kwargs={"random": seed, "control_timestep": control_timestep}
    )
    for episode in range(20):
        environment.reset()
        block = episode % 4
        observation = environment.step(block).observation
        assert mass_of(observation, block) == pytest.approx(environment.task.hidden[block], abs=1e-4)


def test_a_poke_so_long_that_blocks_reach_the_ceiling_is_refused():
    with pytest.raises(ValueError, match="control_timestep is 0.5 s, after which things .* look the same; give a sh"):
        calibration.calibrate("which_is_heavier", "features", "heights", {"control_timestep": 0.5})


def test_in_the_real_environment_it_does_what_it_does_without_physics():
    seed = fresh_seed()
    solution = domains.find("which_is_heavier").ideal("features", {"difficulty": 3.0}, 0.95)
    environment = suite.load("which_is_heavier", "features", task_kwargs={"random": seed, "difficulty": 3.0})
    loop = environment_loop.EnvironmentLoop(environment, solution.actor())
    episodes = loop.run(300)
    masses = which_is_heavier.draw_masses(np.full(300, seed), np.arange(300), 3.0)
    pokes, right = solution.play(masses)
    played = np.array([episode["episode_length"] - 1 for episode in episodes])
    won = np.array([episode["episode_return"] == 1 for episode in episodes])
    # Masses read from heights differ by some 1e-6: a decision on the edge may fall otherwise, in one episode of many.
    assert (played == pokes).mean() > 0.98 and (won == right).mean() > 0.98
    assert won.mean() > 0.97


def random_episodes(generator, count, difficulty):
    """Masses and careless actions: pokes at random, answers at random or by what was seen, some never answered."""
    masses, _ = draw(generator, count, difficulty)
    actions = []
    for row in masses:
        pokes = generator.integers(4, size=generator.integers(0, 6))
        label = generator.integers(4) if generator.random() < 0.5 or not len(pokes) else pokes[row[pokes].argmax()]
        actions.append(np.append(pokes, 4 + label))
    return masses, actions


def test_the_costs_of_mistakes_add_up_to_the_gap():
    generator = np.random.default_rng(fresh_seed())
    solution = solve(3.0, 0.9)
    masses, actions = random_episodes(generator, 60_000, 3.0)
    right = np.array([taken[-1] - 4 == row.argmax() for taken, row in zip(actions, masses, strict=True)])
    returns = 0.9 ** np.array([len(taken) - 1 for taken in actions]) * np.where(right, 1, -1)
    costs = mistakes.of_episodes(solution.judge_all(masses, actions), actions, 0.9)
    total = sum(costs.values())
    assert all((cost >= -1e-9).all() for cost in costs.values())
    both = returns + total  # Its mean is the value, and its spread what luck adds to both sides.
    assert abs(both.mean() - solution.value) < 4.5 * both.std() / math.sqrt(len(both)) + 1e-3


@pytest.mark.parametrize("step_limit", [3, 6])
def test_luck_is_zero_on_average_up_to_the_last_step_in_time(step_limit):
    generator = np.random.default_rng(fresh_seed())
    masses, _ = draw(generator, 40_000, 3.0)
    actions = [generator.integers(4, size=step_limit) for _ in masses]  # Never answered.
    solution = solve(3.0, 0.9, step_limit=step_limit)
    costs = mistakes.of_episodes(solution.judge_all(masses, actions), actions, 0.9)
    luck = -(0.9 ** (step_limit - 1)) + sum(costs.values()) - solution.value
    assert abs(luck.mean()) < 4.5 * luck.std() / math.sqrt(len(luck)) + 1e-4


def test_each_mistake_is_counted_under_its_name():
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
    assert not costs["inferior"].any()  # Any block that is not known is as good as another.
    np.testing.assert_array_equal(costs["early"][:3], 0)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ((0.5, 0.95), "difficulty is 0.5; give a number in .1, 1e.06."),
        ((math.nan, 0.95), "difficulty is nan; give a number in .1, 1e.06."),
        ((3.0, 0.0), "discount is 0.0; give a number from 0 to 1 but not 0"),
        ((3.0, 1.5), "discount is 1.5; give a number from 0 to 1 but not 0"),
        ((3.0, 0.95, 1), "num_things is 1; give an integer >= 2 and <= 20"),
    ],
)
def test_what_makes_no_sense_is_refused(arguments, message):
    with pytest.raises(ValueError, match=message):
        solve(*arguments)


def test_from_images_and_of_more_blocks_there_is_a_value_but_nobody_who_plays():
    find = domains.find("which_is_heavier").ideal
    for solution in (find("pixels", {}, 0.95), find("features", {}, 0.95, blocks=6)):
        assert 0.8 < solution.value == solution.bound
        with pytest.raises(ValueError, match="reads values from features, not from images"):
            solution.actor()


def test_what_can_be_believed_of_a_recorded_episode_is_the_posterior_of_what_was_poked():
    hidden = np.array([0.3, 0.8, 0.1, 0.2])
    episode = types.SimpleNamespace(hidden=hidden, actions=np.array([0, 0, 1, 4 + 1]))
    found = solve(3.0, 0.95).beliefs(episode)
    nobody, first, second = np.full((3, 4), np.nan)
    first[0], second[:2] = 0.3, [0.3, 0.8]
    np.testing.assert_array_equal(found, posterior(np.array([nobody, first, first, second, second]), 3.0))


@pytest.mark.parametrize("difficulty, discount", [(3.0, 0.95), (2.0, 0.6)])
def test_random_touches_of_two_things_earn_what_an_integral_says(difficulty, discount):
    """One of two things is known after the first touch; each other touch is of the other one, or in vain."""
    solution = solve(difficulty, discount, 2)
    going_on = discount / 2 / (1 - discount / 2)  # g / 2 + (g / 2)^2 + ...

    def worth(value):
        chances = posterior(np.array([[value, np.nan]]), difficulty)[0]
        density = (
            difficulty * value ** (difficulty - 1) + difficulty * (1 - value) ** (difficulty - 1)
        ) / 2  # Odd and common are equally likely.
        return density * max(2 * chances.max() - 1, going_on)

    expected = integrate.quad(worth, 0, 1, limit=200)[0]
    assert solution.random_value == pytest.approx(max(0, discount * expected), abs=1e-4)
    assert solution.at_once == 0


def test_there_is_something_to_find_out_in_which_is_heavier_and_choosing_pays_in_four_things():
    for difficulty in (3, 5, 10):
        summary = domains.find("which_is_heavier").ideal("features", {"difficulty": float(difficulty)}, 0.95).summary()
        assert summary["mean_interactions"] >= 2
        assert summary["at_once"] <= 0.3 * summary["value"]
        assert summary["at_once"] < summary["random_value"] < summary["value"]
