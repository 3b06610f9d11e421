"""Sealed Box: what is in it moves it as physics says, and only who waits sees where it is, to a mark."""

import chance
import episodes
import mujoco
import numpy as np
import pytest

from physexp import suite
from physexp.suite.domains import sealed_box

ALL = np.arange(len(sealed_box.ALL_CONTENTS))
FORCES = np.array([*sealed_box.PUSHES.values(), 0.0])
WAIT = 4


STIFF = 'solreflimit="0.008 1" solimplimit="0.9999 0.9999 0.001 0.5 2"'


def _compiled(content: sealed_box.Content, physics_timestep: float, walls: str) -> mujoco.MjModel:
    """A model with all that is in the box compiled into it, and attributes of the walls in MJCF."""
    weight = content.share * content.mass
    return mujoco.MjModel.from_xml_string(f"""
        <mujoco>
          <option timestep="{physics_timestep}" gravity="0 0 0"/>
          <worldbody>
            <body>
              <joint name="rail" type="slide" axis="1 0 0" stiffness="60" damping="2"/>
              <geom type="box" size="0.13 0.13 0.13" mass="{content.mass - weight}" contype="0" conaffinity="0"/>
              <body>
                <joint type="slide" axis="1 0 0" limited="true" range="{-content.gap} {content.gap}" {walls}
                  stiffness="{content.stiffness}" damping="{content.damping}"/>
                <geom size="0.03" mass="{weight}" contype="0" conaffinity="0"/>
              </body>
            </body>
          </worldbody>
          <actuator><motor joint="rail"/></actuator>
        </mujoco>""")


@pytest.mark.parametrize("physics_timestep, walls", [(0.004, STIFF), (0.002, STIFF), (0.02, "")])
def test_boxes_move_as_if_their_content_were_compiled_into_them(seed, physics_timestep, walls):
    kwargs = {"random": seed, "physics_timestep": physics_timestep}
    batch = suite.load_batch("sealed_box", "features", len(ALL), kwargs)
    models = [_compiled(content, physics_timestep, walls) for content in sealed_box.ALL_CONTENTS]
    episodes.assert_moves_as(models, FORCES, np.random.default_rng(seed), batch, ALL, atol=1e-9)


def test_the_walls_stop_a_loose_weight_within_half_of_its_gap(seed):
    loose = np.tile(ALL[sealed_box.KINDS == 1], 4)
    gaps = np.array([sealed_box.ALL_CONTENTS[content].gap for content in loose])
    kwargs = {"random": seed, "control_timestep": 0.004, "time_limit": 2.0}
    batch, rng = suite.load_batch("sealed_box", "features", len(loose), kwargs), np.random.default_rng(seed)
    pushes = iter(np.repeat(rng.integers(len(FORCES), size=(20, len(loose))), 25, axis=0))  # Each lasts 0.1 s.
    for _ in episodes.play(rng, batch, loose, lambda: next(pushes)):
        assert (np.abs(episodes.coordinates(batch)[:, 1]) < 1.5 * gaps).all()


def test_a_finer_step_changes_few_readings(seed):
    """A twelfth of them at 5 mm, and two fifths with the first version's coarse step."""
    contents, seen = np.tile(ALL, 8), {}
    for physics_timestep in (0.0005, 0.004, 0.02):
        kwargs = {"random": seed, "physics_timestep": physics_timestep, "time_limit": 0.7}
        batch = suite.load_batch("sealed_box", "features", len(contents), kwargs)
        played = episodes.play(np.random.default_rng(seed), batch, contents)
        seen[physics_timestep] = np.array([np.round(episodes.coordinates(batch)[:, 0] / 0.005) for _ in played])
    assert np.mean(seen[0.004] != seen[0.0005]) < 0.15 < 0.3 < np.mean(seen[0.02] != seen[0.0005])


@pytest.mark.parametrize("control_timestep", [0.02, 0.06])
def test_no_box_leaves_the_bounds_however_it_is_pushed(control_timestep):
    """Pushed along its velocity all the time, it goes farther than in any other way."""
    kwargs = {"control_timestep": control_timestep, "time_limit": 12.0, "difficulty": 3}
    batch = suite.load_batch("sealed_box", "features", len(ALL), {"random": 0, **kwargs})
    batch.reset(hidden=ALL)
    before, bound = episodes.coordinates(batch)[:, 0], batch.observation_spec()["place"].maximum.item()
    for _ in range(batch.task.rules.step_limit - 1):
        now = episodes.coordinates(batch)[:, 0]
        assert (np.abs(now) <= bound * 0.003).all()
        batch.step(np.where(now >= before, FORCES.argmax(), FORCES.argmin()))
        before = now


@pytest.mark.parametrize("difficulty, mark", [(1, 0.010), (2, 0.005), (3, 0.003)])
def test_only_who_waits_sees_the_box_and_to_a_mark(seed, difficulty, mark):
    contents = np.tile(ALL, 4)
    kwargs = {"random": seed, "difficulty": difficulty}
    batch = suite.load_batch("sealed_box", "features", len(contents), kwargs)
    for actions, observation in episodes.play(np.random.default_rng(seed), batch, contents):
        seen = {name: value[:, 0] for name, value in observation.items()}
        np.testing.assert_array_equal(seen["push"], FORCES[actions] / 4)
        np.testing.assert_array_equal(seen["covered"], actions != WAIT)
        marks = np.round(episodes.coordinates(batch)[:, 0] / mark)
        np.testing.assert_array_equal(seen["place"], np.where(actions == WAIT, marks, 0))
        assert not np.signbit(seen["place"][seen["place"] == 0]).any()  # -0 would tell the side.


@episodes.features_and_pixels
def test_observations_tell_nothing_but_the_push_and_the_place(seed, task):
    """Observations follow from these two, for all contents and all histories."""
    contents = np.tile(ALL, 4)
    batch = suite.load_batch("sealed_box", task, len(contents), {"random": seed, "difficulty": 1})
    followed = episodes.Followed()
    for actions, observation in episodes.play(np.random.default_rng(seed), batch, contents):
        marks = np.where(actions == WAIT, np.round(episodes.coordinates(batch)[:, 0] / 0.010), 0)
        followed.add(zip(actions, marks, strict=True), observation)
    # Four pushes, and a place for each mark that was reached.
    assert len([key for key in followed.shown if key[0] != WAIT]) == 4 and followed.num_different() > 20


def test_kinds_are_equally_likely_and_so_are_the_contents_of_one_kind(seed):
    drawn, answers = episodes.drawn_with_answers("sealed_box", seed)
    kinds = np.array([content.kind for content in sealed_box.ALL_CONTENTS])
    assert np.bincount(kinds).tolist() == [6, 12, 12, 12]
    chance.assert_drawn(np.bincount(drawn, minlength=len(ALL)), 1 / 4 / np.bincount(kinds)[kinds])
    np.testing.assert_array_equal(answers, kinds[drawn])
