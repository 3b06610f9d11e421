"""Which is Heavier: the physics of a poke, and the distribution of the masses."""

import copy

import chance
import mujoco
import numpy as np
import pytest
from scipy import stats

from physexp import suite
from physexp.suite.domains import which_is_heavier as heavier

# The physics step and the numbers of the scene, as the module documents them.
TIMESTEP, SUBSTEPS, FORCE, STIFFNESS, DAMPING = 0.025, 4, 20.0, 6.25, 5.0
LIGHTEST, HEAVIEST, CEILING = 0.2, 1.0, 0.4


def _height_after_one_poke(mass: float) -> float:
    """The height that the spring and the damper allow, m.

    m z'' = F - k z - d z'. MuJoCo's Euler step h takes the damping implicitly: (m + h d) (v' - v) / h = F - k z - d v,
    hence v' = (m v + h (F - k z)) / (m + h d), and z' = z + h v'. One control step is four of them.
    """
    z = v = 0.0
    for _ in range(SUBSTEPS):
        v = (mass * v + TIMESTEP * (FORCE - STIFFNESS * z)) / (mass + TIMESTEP * DAMPING)
        z += TIMESTEP * v
    return z


def _draw(seed, difficulty, count):
    return heavier.draw_masses(np.full(count, seed), np.arange(count), difficulty)


@pytest.mark.parametrize("num_blocks", [4, 12])
def test_a_poke_lifts_a_block_as_the_spring_damper_law_predicts(seed, num_blocks):
    kwargs = {"random": seed, "difficulty": 1, "num_blocks": num_blocks}
    env = suite.load("which_is_heavier", "features", task_kwargs=kwargs)
    for episode in range(80 // num_blocks):
        for block in range(num_blocks):
            env.task.next_episode = episode
            env.reset()
            kilograms = LIGHTEST + (HEAVIEST - LIGHTEST) * env.task.hidden[block]
            heights = env.step(block).observation["heights"]
            assert heights[block] == pytest.approx(_height_after_one_poke(kilograms), abs=1e-6)
            assert not np.delete(heights, block).any()


@pytest.mark.parametrize("pokes_first", [0, 20], ids=["random pokes", "pushed to the ceiling first"])
def test_the_masses_act_as_if_they_were_compiled_into_the_model(seed, pokes_first):
    """`slide_masses` writes three fields where `mj_setConst` would write them all; nothing else may matter."""
    rng = np.random.default_rng(seed)
    env = suite.load("which_is_heavier", "features", task_kwargs={"random": seed, "difficulty": 1})
    for _ in range(3):
        env.reset()
        model = copy.copy(env.task.apparatus.model)
        blocks = [model.body(f"block_{k}/").id for k in range(4)]
        model.body_mass[blocks] = LIGHTEST + (HEAVIEST - LIGHTEST) * env.task.hidden
        mujoco.mj_setConst(model, mujoco.MjData(model))
        data = mujoco.MjData(model)
        highest = 0.0
        for t in range(99):
            poke = 2 if t < pokes_first else int(rng.integers(4))
            env.step(poke)
            data.ctrl[:] = FORCE * np.eye(4)[poke]
            mujoco.mj_step(model, data, SUBSTEPS)
            np.testing.assert_allclose(env.physics.data.qpos, data.qpos, rtol=0, atol=1e-12)
            highest = max(highest, data.qpos.max())
        assert not pokes_first or highest > CEILING, "the ceiling was not reached"


@pytest.mark.parametrize("difficulty", [1, 5])
def test_the_masses_of_an_episode_are_independent(seed, difficulty):
    # The largest of four independent masses has the product of their distribution functions, F and G three times.
    largest = _draw(seed, difficulty, 5000).max(axis=1)
    heavy, light = stats.beta(difficulty, 1), stats.beta(1, difficulty)
    assert stats.kstest(largest, lambda x: heavy.cdf(x) * light.cdf(x) ** 3).pvalue > chance.P_VALUE


@pytest.mark.parametrize("difficulty, num_blocks", [(1, 4), (1e300, 4), (3, 12)])
def test_exactly_one_block_is_heaviest_and_it_is_the_answer(seed, difficulty, num_blocks):
    kwargs = {"random": seed, "difficulty": difficulty, "num_blocks": num_blocks}
    env = suite.load("which_is_heavier", "features", task_kwargs=kwargs)
    masses = env.task.draw(np.full(20_000, seed), np.arange(20_000))
    assert masses.shape == (20_000, num_blocks)
    assert ((masses >= 0) & (masses <= 1)).all()
    assert ((masses == masses.max(axis=1, keepdims=True)).sum(axis=1) == 1).all()
    chance.assert_drawn(np.bincount(masses.argmax(axis=1), minlength=num_blocks), [1 / num_blocks] * num_blocks)
    for expected in masses[:50]:
        env.reset()
        np.testing.assert_array_equal(env.task.hidden, expected)
        assert env.task.correct_answer == np.argmax(expected)
