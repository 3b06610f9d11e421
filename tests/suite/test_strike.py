"""Strike: one strike alone takes the puck into the goal, and pokes show the last gate and nothing else."""

import chance
import episodes
import mujoco
import numpy as np
import pytest

from physexp import suite
from physexp.suite.domains import strike
from physexp.suite.engine import snapshots

TASKS = [("strike", "features"), ("strike", "pixels")]
ALL = np.arange(len(strike.PUCKS))


def _positions(batch) -> np.ndarray:
    """Positions of the pucks, m [N]."""
    return np.array([snapshots.view(batch, "qpos", row)[0] for row in range(len(batch.correct_answers))])


def _played_out(environment, label: int) -> float:
    """How far a strike takes the puck, m; the end of the lane, or farther, where it is caught there."""
    for _ in environment.task.play_out(environment.physics, label):
        pass
    return float(environment.physics.data.qpos[0])


@pytest.mark.parametrize("distance", [0.6, 0.7, 0.75])
def test_the_right_strike_takes_the_puck_into_the_goal_and_no_other_does(seed, distance):
    rng = np.random.default_rng(seed)
    environment = suite.load("strike", "features", {"random": seed, "goal_distance": distance})
    for hidden in rng.choice(ALL, size=25, replace=False):
        environment.reset(hidden=hidden)
        right, _, place = strike.PUCKS[hidden]
        ends = np.array([_played_out(environment, label) for label in range(7)])
        assert ends[right] == pytest.approx(place * distance, rel=1e-3)  # As the formula says.
        are_in = (distance / 1.5 < ends) & (ends < distance * 1.5)
        assert np.flatnonzero(are_in).tolist() == [right] == [environment.task.correct_answer]
        assert (np.diff(ends) > 0).all() or ends[-1] >= 1.2  # Harder strikes go farther, until the lane ends.


def test_a_strike_that_is_played_out_leaves_the_barrier_where_it_was(seed):
    environment = suite.load("strike", "features", {"random": seed})
    environment.reset(hidden=np.array(3))
    barrier = environment.physics.model.jnt_range.copy()
    _played_out(environment, 6)
    np.testing.assert_array_equal(environment.physics.model.jnt_range, barrier)
    environment.reset(hidden=np.array(3))
    for _ in range(5):
        environment.step(2)
    assert environment.physics.data.qpos[0] < strike.BAY + 0.02


def _compiled(mass: float, friction: float) -> mujoco.MjModel:
    """A model with a puck's mass and friction compiled into it."""
    settings = 'solimpfriction="0.9999 0.9999 0.001 0.5 2" solreffriction="0.02 1"'
    limits = 'limited="true" range="0 0.3" solimplimit="0.9999 0.9999 0.001 0.5 2" solreflimit="0.02 1"'
    return mujoco.MjModel.from_xml_string(f"""
        <mujoco>
          <option timestep="0.01" gravity="0 0 0"/>
          <worldbody>
            <body>
              <joint name="rail" type="slide" axis="1 0 0" frictionloss="{friction}" {settings} {limits}/>
              <geom type="cylinder" size="0.03 0.01" mass="{mass}" contype="0" conaffinity="0"/>
            </body>
          </worldbody>
          <actuator><motor joint="rail"/></actuator>
        </mujoco>""")


def test_pucks_move_as_if_mass_and_friction_were_compiled_into_them(seed):
    rng = np.random.default_rng(seed)
    batch = suite.load_batch("strike", "features", len(ALL), {"random": seed})
    batch.reset(hidden=ALL)
    models = [_compiled(*values) for values in zip(*strike.properties(ALL, 0.7), strict=True)]
    data = [mujoco.MjData(model) for model in models]
    for _ in range(batch.task.rules.step_limit - 1):
        actions = rng.integers(3, size=len(ALL))
        batch.step(actions)
        for model, state, action in zip(models, data, actions, strict=True):
            state.ctrl[:] = strike.POKES[action]
            mujoco.mj_step(model, state, nstep=10)
        np.testing.assert_allclose(_positions(batch), [state.qpos[0] for state in data], atol=1e-7)


@pytest.mark.parametrize("difficulty, gates", [(1, 5), (2, 10), (3, 15)])
def test_what_is_read_is_the_poke_and_the_last_gate_that_was_passed(seed, difficulty, gates):
    rng = np.random.default_rng(seed)
    batch = suite.load_batch("strike", "features", len(ALL), {"random": seed, "difficulty": difficulty})
    batch.reset(hidden=ALL)
    read = []
    for _ in range(batch.task.rules.step_limit - 1):
        actions = rng.integers(3, size=len(ALL))
        seen = {name: value[:, 0] for name, value in batch.step(actions).observation.items()}
        np.testing.assert_allclose(seen["strength"], np.array(strike.POKES)[actions] / 9)
        passed = [(position >= np.arange(1, gates + 1) * 0.3 / gates).sum() for position in _positions(batch)]
        np.testing.assert_array_equal(seen["gate"], passed)
        read.append(passed)
    assert np.min(read) < gates / 2 and np.max(read) == gates  # Near and far gates are read, whatever the pokes were.


@pytest.mark.parametrize("domain_name, task_name", TASKS)
def test_observations_tell_nothing_but_the_poke_and_the_gate(seed, domain_name, task_name):
    """Observations follow from these two, for all pucks and all histories, though the puck moves."""
    rng = np.random.default_rng(seed)
    pucks = np.tile(ALL, 2)
    batch = suite.load_batch(domain_name, task_name, len(pucks), {"random": seed})
    batch.reset(hidden=pucks)
    followed = episodes.Followed()
    for _ in range(batch.task.rules.step_limit - 1):
        actions = rng.integers(3, size=len(pucks))
        observation = batch.step(actions).observation
        gates = np.clip(np.floor(_positions(batch) / 0.03), 0, 10)
        followed.add(zip(actions, gates, strict=True), observation)
    assert followed.num_different() > 25  # Of three pokes and eleven gates.


def test_strikes_are_equally_likely_and_so_are_the_pucks(seed):
    """Each puck's share of 100 000 episodes is what its probability makes likely."""
    count = 100_000
    drawn = episodes.drawn("strike", np.full(count, seed), np.arange(count))
    expected = np.full(len(ALL), 1 / len(ALL))
    chance.assert_drawn(np.bincount(drawn, minlength=len(ALL)), expected)
    answers = suite.load_task("strike", "features").answers(ALL)
    assert np.bincount(answers).tolist() == [len(ALL) // 7] * 7
