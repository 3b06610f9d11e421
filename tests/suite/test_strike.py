"""Strike: one strike alone takes the puck into the goal, and pokes show the last gate and nothing else."""

import chance
import episodes
import mujoco
import numpy as np
import pytest

from physexp import suite
from physexp.suite.domains import strike

ALL = np.arange(len(strike.PUCKS))


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


def test_the_marks_that_people_see_are_as_far_from_the_puck_as_they_say():
    environment = suite.load("strike", "features")
    environment.reset()
    geoms = environment.physics.named.data.geom_xpos
    marks = environment.task.scene.staged
    for mark in marks:
        distance = geoms[mark.geom.full_identifier, "x"] - geoms["puck/geom", "x"]
        assert float(mark.text.removesuffix(" m")) == pytest.approx(distance)
    near, far = 0.7 / 1.5, 0.7 * 1.5  # Of the goal.
    assert any(near < float(mark.text.removesuffix(" m")) < far for mark in marks)


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
    batch = suite.load_batch("strike", "features", len(ALL), {"random": seed})
    models = [_compiled(*values) for values in zip(*strike.properties(ALL, 0.7), strict=True)]
    episodes.assert_moves_as(models, strike.POKES, np.random.default_rng(seed), batch, ALL, atol=1e-7)


@pytest.mark.parametrize("difficulty, gates", [(1, 5), (2, 10), (3, 15)])
def test_what_is_read_is_the_poke_and_the_last_gate_that_was_passed(seed, difficulty, gates):
    batch = suite.load_batch("strike", "features", len(ALL), {"random": seed, "difficulty": difficulty})
    read = []
    for actions, seen in episodes.play(np.random.default_rng(seed), batch, ALL):
        np.testing.assert_allclose(seen["strength"][:, 0], np.array(strike.POKES)[actions] / 9)
        passed = (episodes.coordinates(batch) >= np.arange(1, gates + 1) * 0.3 / gates).sum(axis=1)
        np.testing.assert_array_equal(seen["gate"][:, 0], passed)
        read.append(passed)
    assert np.min(read) < gates / 2 and np.max(read) == gates  # Near and far gates are read, whatever the pokes were.


@episodes.features_and_pixels
def test_observations_tell_nothing_but_the_poke_and_the_gate(seed, task):
    """Observations follow from these two, for all pucks and all histories, though the puck moves."""
    pucks = np.tile(ALL, 2)
    batch = suite.load_batch("strike", task, len(pucks), {"random": seed})
    followed = episodes.Followed()
    for actions, observation in episodes.play(np.random.default_rng(seed), batch, pucks):
        gates = np.clip(np.floor(episodes.coordinates(batch)[:, 0] / 0.03), 0, 10)
        followed.add(zip(actions, gates, strict=True), observation)
    assert followed.num_different() > 25  # Of three pokes and eleven gates.


def test_strikes_are_equally_likely_and_so_are_the_pucks(seed):
    drawn, answers = episodes.drawn_with_answers("strike", seed)
    chance.assert_drawn(np.bincount(drawn, minlength=len(ALL)), np.full(len(ALL), 1 / len(ALL)))
    chance.assert_drawn(np.bincount(answers, minlength=7), [1 / 7] * 7)
