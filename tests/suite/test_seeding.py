"""A seed reaches everything, and an episode depends on nothing but its seed and its index."""

import itertools

from chance import P_VALUE
import numpy as np
import pytest
from scipy import special, stats

from physexp import suite
from physexp.suite.engine import seeding

FEATURE_TASKS = suite.tagged("features")
every_feature_task = pytest.mark.parametrize("domain_name, task_name", FEATURE_TASKS)


def _episode(env) -> list:
    """The hidden property, the answer and everything observed under fixed actions, from a reset on."""
    trace = [env.reset()]
    hidden = np.copy(env.task.hidden).tobytes()
    trace += [env.step(t % env.task.num_interactions) for t in range(5)]
    observed = [value.tobytes() for step in trace for value in step.observation.values()]
    return [hidden, env.task.correct_answer, *observed]


def _hidden(env, episodes: int) -> list[bytes]:
    hidden = []
    for _ in range(episodes):
        env.reset()
        hidden.append(np.copy(env.task.hidden).tobytes())
    return hidden


def test_environment_seeds_collide_no_more_than_random_numbers_do(seed):
    # 10 000 ** 2 / 2 pairs in 2 ** 32 seeds: 0.0116 collisions are expected, so four of them have a probability of
    # 0.0116 ** 4 / 24 = 8e-10. The same for the seeds of one environment in 10 000 batches.
    assert len({suite.environment_seed(seed, i) for i in range(10_000)}) >= 10_000 - 3
    assert len({suite.environment_seed(seed + i, 7) for i in range(10_000)}) >= 10_000 - 3


@every_feature_task
def test_an_episode_follows_from_its_seed_and_its_index(seed, domain_name, task_name):
    env, alone, other = (suite.load(domain_name, task_name, {"random": value}) for value in (seed, seed, seed + 1))
    episodes = [_episode(env) for _ in range(6)]
    assert env.task.episode == 5
    for k in (4, 0, 5, 5):
        alone.task.next_episode = k
        assert _episode(alone) == episodes[k]
        assert alone.task.episode == k
    # Two seeds give the same pattern of glue in at most 1/5 of the episodes: in all of 15 with a probability of 3e-11.
    alone.task.next_episode = 0
    assert _hidden(alone, 15) != _hidden(other, 15)


def test_a_random_state_stands_for_one_seed_drawn_from_it(seed):
    def load(random):
        return suite.load("which_is_heavier", "features", task_kwargs={"random": random})

    state = np.random.RandomState(seed)
    first, second = load(state), load(state)
    again = load(np.random.RandomState(seed))
    assert _hidden(first, 3) == _hidden(again, 3)
    assert _hidden(first, 3) != _hidden(second, 3)


def test_the_global_random_state_of_numpy_is_neither_used_nor_moved(seed):
    np.random.seed(0)
    before = np.random.get_state()[1].copy()
    env = suite.load("which_is_heavier", "features", task_kwargs={"random": seed})
    first = _hidden(env, 3)
    np.testing.assert_array_equal(np.random.get_state()[1], before)
    np.random.seed(1)
    assert _hidden(suite.load("which_is_heavier", "features", task_kwargs={"random": seed}), 3) == first


# Streams that must look like independent uniform numbers, [10 000, 3] each: the episodes of one environment, the
# environments of a batch in their first episode, neighbouring seeds, another attempt at the same episodes, and the
# numbers for other purposes.
def _streams(seed):
    many = np.arange(10_000)
    in_batch = np.array([suite.environment_seed(seed, i) for i in many])
    return {
        "episodes": seeding.uniforms(np.full(10_000, seed), many, 3),
        "environments": seeding.uniforms(in_batch, np.zeros(10_000, np.int64), 3),
        "seeds": seeding.uniforms(seed + many, np.zeros(10_000, np.int64), 3),
        "attempts": seeding.uniforms(np.full(10_000, seed), many, 3, attempt=1),
        "noise": special.ndtr(seeding.normals(np.full(10_000, seed), many, np.zeros(10_000, np.int64), 3)),
        "variation": (seeding.variations(np.full(10_000, seed), many, 3) + 1) / 2,
        "timing": seeding.timings(np.full(10_000, seed), many)[:, None],
    }


def test_the_draws_are_uniform(seed):
    for name, draws in _streams(seed).items():
        assert ((draws > 0) & (draws < 1)).all()
        for column in draws.T:
            assert stats.kstest(column, "uniform").pvalue > P_VALUE, name


def test_the_draws_are_independent(seed):
    # The rank correlation of 10 000 independent pairs has a standard deviation of 0.01: none of these pairs may lie six
    # of them from zero. Each column also goes against itself, one episode (environment, seed) later.
    columns = [column for draws in _streams(seed).values() for column in draws.T]
    pairs = list(itertools.combinations(columns, 2)) + [(column[:-1], column[1:]) for column in columns]
    for one, other in pairs:
        assert abs(stats.spearmanr(one, other).statistic) < 0.06
