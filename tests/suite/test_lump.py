"""Lump: what it is made of moves it as physics says, and only who waits sees its height, to a mark."""

import chance
import episodes
import mujoco
import numpy as np
import pytest

from physexp import suite
from physexp.suite.domains import lump

ALL = np.arange(len(lump.ALL_LUMPS))
FORCES = np.array([*lump.PRESSES, 0.0])
HARD, WAIT = 1, 2


def _compiled(made: lump.Lump) -> mujoco.MjModel:
    """A model with a lump compiled into it."""
    rigid = 'solreflimit="0.02 1" solimplimit="0.9999 0.9999 0.001 0.5 2"'
    dry = f'frictionloss="{made.friction}" solreffriction="0.02 1" solimpfriction="0.9999 0.9999 0.001 0.5 2"'
    return mujoco.MjModel.from_xml_string(f"""
        <mujoco>
          <option timestep="0.01" gravity="0 0 0" integrator="implicitfast"/>
          <worldbody>
            <body>
              <joint name="plate" type="slide" damping="{lump._PLATE_DAMPING}"/>
              <geom size="0.1" mass="0.05" contype="0" conaffinity="0"/>
            </body>
            <body>
              <joint name="core" type="slide" limited="true" range="-1 0.12" {rigid}
                stiffness="{made.stiffness}" damping="{made.damping}" {dry}/>
              <geom size="0.1" mass="0.05" contype="0" conaffinity="0"/>
            </body>
          </worldbody>
          <tendon>
            <fixed stiffness="{made.spring}" damping="{lump._SPRING_DAMPING}">
              <joint joint="plate" coef="1"/><joint joint="core" coef="-1"/>
            </fixed>
          </tendon>
          <actuator><motor joint="plate"/></actuator>
        </mujoco>""")


def test_lumps_move_as_if_their_material_were_compiled_into_them(seed):
    batch = suite.load_batch("lump", "features", len(ALL), {"random": seed})
    models = [_compiled(made) for made in lump.ALL_LUMPS]
    episodes.assert_moves_as(models, FORCES, np.random.default_rng(seed), batch, ALL, atol=1e-9)


@pytest.mark.parametrize("difficulty, mark", [(1, 0.010), (2, 0.008), (3, 0.005)])
def test_only_who_waits_sees_the_height_and_to_a_mark(seed, difficulty, mark):
    lumps = np.tile(ALL, 4)
    batch = suite.load_batch("lump", "features", len(lumps), {"random": seed, "difficulty": difficulty})
    for actions, observation in episodes.play(np.random.default_rng(seed), batch, lumps):
        seen = {name: value[:, 0] for name, value in observation.items()}
        np.testing.assert_array_equal(seen["press"], (FORCES[actions] / 6).astype(np.float32))
        np.testing.assert_array_equal(seen["covered"], actions != WAIT)
        marks = np.clip(np.round(episodes.coordinates(batch)[:, 0] / mark), 0, round(0.12 / mark))
        np.testing.assert_array_equal(seen["dent"], np.where(actions == WAIT, marks, 0))
        assert not np.signbit(seen["dent"]).any()  # -0 would tell the side.


def test_a_lump_that_is_not_pressed_stays_as_it_is_to_the_bit():
    batch = suite.load_batch("lump", "features", len(ALL), {"random": 0, "time_limit": 2.0})
    for _, observation in episodes.play(None, batch, ALL, draw=lambda: np.full(len(ALL), WAIT)):
        assert not episodes.coordinates(batch).any() and not any(values.any() for values in observation.values())


def test_no_lump_is_pressed_deeper_than_the_stop():
    """A second of hard presses, and a wait: the putty that yields most is as flat as it gets, all clay keeps a dent."""
    batch = suite.load_batch("lump", "features", len(ALL), {"random": 0, "difficulty": 3})
    actions = iter([HARD] * 10 + [WAIT])
    *_, (_, observation) = episodes.play(None, batch, ALL, draw=lambda: np.full(len(ALL), next(actions)))
    dents = observation["dent"][:, 0]
    assert dents.max() == batch.observation_spec()["dent"].maximum.item() == 24
    assert (episodes.coordinates(batch)[:, 1] < lump.DEEPEST + 0.01).all()  # The stop is soft.
    assert (dents[lump.KINDS == 1] > 0).all() and (dents[lump.KINDS == 0] == 0).all()


@episodes.features_and_pixels
def test_observations_tell_nothing_but_the_press_and_the_height(seed, task):
    """Observations follow from these two, for all lumps and all histories."""
    lumps = np.tile(ALL, 4)
    batch = suite.load_batch("lump", task, len(lumps), {"random": seed})
    followed = episodes.Followed()
    for actions, observation in episodes.play(np.random.default_rng(seed), batch, lumps):
        marks = np.where(actions == WAIT, np.clip(np.round(episodes.coordinates(batch)[:, 0] / 0.008), 0, 15), 0)
        followed.add(zip(actions, marks, strict=True), observation)
    # Two presses, and a height for each mark that was reached.
    assert len([key for key in followed.shown if key[0] != WAIT]) == 2 and followed.num_different() > 7


def test_images_show_a_lump_that_stands_on_the_floor_and_keeps_its_volume():
    environment = suite.load("lump", "features", task_kwargs={"random": 0})
    environment.task.give_hidden(np.argmax(lump.KINDS == 2))  # Putty.
    dent, images = environment.reset().observation["dent"].item(), []
    geom, start = environment.physics.model.geom("lump/geom"), environment.physics.model.geom("lump/geom").size.copy()
    for action in (HARD, HARD, WAIT):
        dent = environment.step(action).observation["dent"].item()
        images.append(environment.physics.render(84, 84, camera_id="observer"))
    assert dent > 4 and (images[-1] != images[0]).any()
    np.testing.assert_allclose(2 * geom.size[2], 0.24 - 0.008 * dent)
    np.testing.assert_allclose(geom.size.prod(), start.prod())
    np.testing.assert_allclose(environment.physics.data.geom("lump/geom").xpos[2], geom.size[2])
    environment.reset()
    np.testing.assert_array_equal(geom.size, start)


def test_kinds_are_equally_likely_and_so_are_the_lumps_of_one_kind(seed):
    drawn, answers = episodes.drawn_with_answers("lump", seed)
    kinds = np.array([made.kind for made in lump.ALL_LUMPS])
    assert np.bincount(kinds).tolist() == [3, 12, 9, 12]
    chance.assert_drawn(np.bincount(drawn, minlength=len(ALL)), 1 / 4 / np.bincount(kinds)[kinds])
    np.testing.assert_array_equal(answers, kinds[drawn])
