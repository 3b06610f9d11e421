"""Replays: what is recorded is what happened, and what is written is what was recorded."""

import contextlib
import functools
import importlib.util
import os
from pathlib import Path
import re
import resource
import signal
import subprocess
import urllib.request

import commands
import numpy as np
import observers
from PIL import Image
import pytest
from rerun.chunk import RrdReader
from scipy.spatial import transform
import screens
from seeds import fresh_seed
from trainers import PHYSEXP
import waiting
from waiting import wait_until

from physexp import suite
from physexp.agents import core, environment_loop, starting
from physexp.agents.belief import config as belief_config
from physexp.agents.belief import networks as belief_networks
from physexp.agents.ppo import config as ppo
from physexp.analysis import replay
from physexp.analysis.data import readings
from physexp.analysis.replay import beliefs, live, recording, selection, words, writing
from physexp.analysis.training import config as config_lib
from physexp.analysis.training import finding, playing, trainer
from physexp.analysis.training import run as run_lib
from physexp.suite.parts import things as things_lib
from physexp.suite.parts import tower

DOCS = Path(__file__).parents[3] / "docs"
TASKS = [("which_is_heavier", "features"), ("towers", "fist_features"), ("towers", "direct_pixels")]


class Careless(core.Actor):
    """Acts at random for a while, then answers; its beliefs are made up but known."""

    def __init__(self, environment, interactions, seed):
        self._task, self._interactions = environment.task, interactions
        self._generator = np.random.default_rng(seed)

    def observe_first(self, timestep):
        self._left = self._interactions

    def select_action(self, observation):
        self.policy = self._generator.dirichlet(np.ones(self._task.rules.num_actions))
        self.value = float(self._generator.uniform(-1, 1))
        self._left -= 1
        first = self._task.num_interactions
        return int(self._generator.integers(first) if self._left >= 0 else first + self._generator.integers(2))

    def observe(self, action, next_timestep):
        pass

    def update(self):
        pass


def record(domain, task, interactions=5, seed=None, make_task=None):
    """A recorded episode, and what another observer has seen of it."""
    seed = fresh_seed() if seed is None else seed
    options = {"random": seed}
    played = suite.load_task(domain, task, options) if make_task is None else make_task(**options)
    environment = suite.Environment(played)
    actor, watcher = Careless(environment, interactions, seed), observers.Watcher()
    recorder = replay.EpisodeRecorder(environment, domain, task, options, actor, "a careless agent", make_task)
    environment_loop.EnvironmentLoop(environment, actor, [watcher, recorder]).run_episode()
    return recorder.episode, watcher, environment


def place(environment, thing):
    """The position of a thing in the simulation."""
    model = environment.physics.model
    (geom,) = [g for g in range(model.ngeom) if f"{thing}/geom" in model.geom(g).name]
    return environment.physics.data.geom_xpos[geom].copy()


def chunks(path, entity):
    """The columns of an entity in a file, as a dictionary; those of static data are left out."""
    found = {}
    for chunk in RrdReader(str(path)).stream():
        if str(chunk.entity_path) == entity and not chunk.is_static:
            batch = chunk.to_record_batch()
            for name, column in zip(batch.schema.names, batch.columns, strict=True):
                found.setdefault(name, []).extend(column.to_pylist())
    return found


def text_of(path):
    """All of a file as text, its layout too."""
    command = [writing.PROGRAM, "rrd", "print", "-vvv", path]
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout


@pytest.fixture(scope="module", params=TASKS, ids=["/".join(names) for names in TASKS])
def written(request, tmp_path_factory):
    """A recorded episode and the file it was written to."""
    episode, watcher, environment = record(*request.param)
    path = writing.write(tmp_path_factory.mktemp("replay") / "one.rrd", [lambda: [episode]])
    return episode, watcher, environment, path


def test_a_recorder_keeps_what_happened(written):
    episode, watcher, environment, _ = written
    assert (episode.seed, episode.index) == (environment.task.options.random, 0)
    np.testing.assert_array_equal(episode.hidden, environment.task.hidden)
    assert episode.answer == environment.task.correct_answer
    np.testing.assert_array_equal(episode.actions, watcher.actions)
    for name, values in episode.observations.items():
        np.testing.assert_array_equal(values, [seen[name] for seen in watcher.seen])
    np.testing.assert_allclose(episode.policies.sum(axis=1), 1)
    assert len(episode.policies) == len(episode.values) == len(episode.actions) == 6
    assert abs(episode.rewards.sum()) == 1


def test_poses_are_kept_at_every_physics_step_and_end_where_the_physics_is(written):
    episode, _, environment, _ = written
    substeps = environment.task.options.substeps
    assert len(episode.times) == 5 * substeps + 1  # Five interactions; the answer takes no time.
    np.testing.assert_allclose(np.diff(episode.times), environment.task.options.physics_timestep)
    for k, name in enumerate(episode.shapes.names):
        np.testing.assert_array_equal(episode.true_positions[-1, k], place(environment, name))
    assert not np.array_equal(episode.true_positions[0], episode.true_positions[-1])


def test_a_recorder_with_another_difficulty_is_refused():
    environment = suite.load("which_is_heavier", "features", task_kwargs={"random": fresh_seed(), "difficulty": 3})
    recorder = replay.EpisodeRecorder(environment, "which_is_heavier", "features", {"difficulty": 10})
    recorder.observe_first(environment, environment.reset())
    recorder.observe(environment, environment.step(0), 0)
    with pytest.raises(RuntimeError, match="is not what was seen: heights differs; record the environment with"):
        _ = recorder.episode
    recorder.close()


def test_a_written_file_passes_reruns_own_check_and_is_small(written):
    *_, path = written
    done = subprocess.run([writing.PROGRAM, "rrd", "verify", path], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert path.stat().st_size < 1e6


def test_poses_and_observations_read_back_are_those_of_the_episode(written):
    episode, _, environment, path = written
    films = [("hidden", episode.true_positions, episode.true_rotations)]
    if "pixels" not in episode.observations:
        films.append(("things", episode.positions, episode.rotations))
    for root, positions, rotations in films:
        for k, name in enumerate(episode.shapes.names):
            columns = chunks(path, f"/world/{root}/{name}")
            assert [round(time.total_seconds(), 6) for time in columns["time"]] == pytest.approx(
                list(episode.times), abs=1e-6
            )
            moved = np.array(columns["Transform3D:translation"])[:, 0]
            np.testing.assert_array_equal(moved, positions[:, k].astype(np.float32))
            turned = transform.Rotation.from_quat(np.array(columns["Transform3D:quaternion"])[:, 0]).as_matrix()
            np.testing.assert_allclose(turned, rotations[:, k], atol=1e-5)
    for name, values in episode.observations.items():
        if values.dtype == np.uint8:
            images = np.array(chunks(path, f"/seen/{name}")["Image:buffer"], np.uint8).reshape(values.shape)
            np.testing.assert_array_equal(images, values)
        elif values.ndim == 3:
            read = [np.array(chunks(path, f"/seen/{name}/{letter}")["Scalars:scalars"]) for letter in "xyz"]
            np.testing.assert_array_equal(np.stack(read, axis=-1), values)
        elif name == "fist_position":
            read = [np.array(chunks(path, f"/seen/{name}/{letter}")["Scalars:scalars"]) for letter in "xyz"]
            np.testing.assert_array_equal(np.concatenate(read, axis=1), values)
            far = np.linalg.norm(values - values[0], axis=1)
            np.testing.assert_allclose(np.array(chunks(path, "/seen/moved")["Scalars:scalars"])[:, 5], far, rtol=1e-5)
        else:
            np.testing.assert_array_equal(chunks(path, f"/seen/{name}")["Scalars:scalars"], values)


def test_beliefs_actions_and_outcome_are_written(written):
    episode, _, environment, path = written
    first = environment.task.num_interactions
    answers = episode.policies[:, first:]
    belief = answers / answers.sum(axis=1, keepdims=True)
    np.testing.assert_allclose(chunks(path, "/belief/labels")["Scalars:scalars"], belief)
    np.testing.assert_allclose(chunks(path, "/belief/policy")["Scalars:scalars"], episode.policies)
    np.testing.assert_allclose(np.ravel(chunks(path, "/belief/answers")["Scalars:scalars"]), answers.sum(axis=1))
    np.testing.assert_allclose(np.ravel(chunks(path, "/belief/value")["Scalars:scalars"]), episode.values)
    lines = [f"- step {step}: {environment.task.action_names[action]}" for step, action in enumerate(episode.actions)]
    said = [text[0].splitlines() for text in chunks(path, "/did/actions")["TextDocument:text"]]
    assert said == [lines[: step + 1] for step in range(len(lines))]  # No later action is told.


def test_the_bars_of_a_belief_carry_the_names_of_their_labels(written):
    episode, _, environment, path = written
    tables = [text[0].splitlines() for text in chunks(path, "/belief/now")["TextDocument:text"]]
    assert len(tables) == len(episode.actions)
    answers = episode.policies[:, environment.task.num_interactions :]
    for table, policy in zip(tables, answers, strict=True):
        for k, (row, name) in enumerate(zip(table[2:], environment.task.label_names, strict=True)):
            label, number, bar, answers_now, *_ = [cell.strip() for cell in row.strip("|").split("|")]
            assert label == name.removesuffix(" is heaviest")
            share = policy[k] / policy.sum()
            assert float(number) == pytest.approx(share, abs=0.0051) and len(bar) == 20
            assert bar.count("█") == round(20 * share)
            assert float(answers_now) == pytest.approx(policy[k], abs=0.0051)


def test_the_text_holds_question_episode_legend_and_at_last_the_verdict(written):
    episode, _, environment, path = written
    start, end = [text[0] for text in chunks(path, "/did/outcome")["TextDocument:text"]]
    for text in (start, end):
        for word in (
            environment.task.question,
            f"seed {episode.seed}, episode 0",
            "a careless agent",
            "**policy**",
            "**belief**: the policy restricted to the labels",
            words.HIDDEN_TAB,
        ):
            assert word in text
    assert environment.task.question.endswith("?")
    assert "Not answered yet" in start and "Not answered yet" not in end
    verdict = "right" if episode.rewards[-1] > 0 else f"wrong; it is: {environment.task.label_names[episode.answer]}"
    assert f"That is {verdict}." in end


def series(path, entity):
    """Names and colours of the curves of an entity in a file."""
    for chunk in RrdReader(str(path)).stream():
        if str(chunk.entity_path) == entity and chunk.is_static:
            batch = chunk.to_record_batch().to_pydict()
            return batch["SeriesLines:names"][0], [
                tuple(c.to_bytes(4, "big")[:3]) for c in batch["SeriesLines:colors"][0]
            ]
    raise LookupError(entity)


def test_a_blocks_colour_means_that_block_and_nothing_else(written):
    episode, _, environment, path = written
    blocks = {f"block {k}": tuple(int(255 * c) for c in things_lib.COLORS[k][:3]) for k in range(5)}
    seen = set()
    for entity in ("/belief/labels", "/belief/answers", "/belief/value", "/seen/heights", "/seen/moved"):
        with contextlib.suppress(LookupError):
            for name, color in zip(*series(path, entity), strict=True):
                assert (color in blocks.values()) == (name in blocks), (entity, name)
                assert color == blocks.get(name, color)
                seen.add(name)
    assert {"value", "answers now"} <= seen
    if episode.domain == "towers":
        assert {"1 body", "2 bodies", "5 bodies"} <= seen
    if "fist_position" in episode.observations:
        assert {"fist", *blocks} <= seen


def test_every_component_of_a_feature_is_named_after_the_thing_it_tells_of():
    blocks = [f"block_{k}" for k in range(5)]
    heavier, towers_ = (suite.load_task(*task) for task in TASKS[:2])
    things = [{each.name: list(each.things) for each in readings.shown(task.readings)} for task in (heavier, towers_)]
    assert things == [{"heights": blocks[:4]}, {"positions": blocks, "fist_position": ["fist"]}]


def example(name):
    """A module of docs/examples."""
    spec = importlib.util.spec_from_file_location(name, DOCS / "examples" / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def entities(path, below):
    """The names of the entities of a file that are directly below another one."""
    paths = {str(chunk.entity_path) for chunk in RrdReader(str(path)).stream()}
    return {path.removeprefix(below) for path in paths if path.startswith(below)}


def things(task, is_still):
    """The things of a task that stand still in images, or all others, but for the floor and walls."""
    found, model = set(), task.apparatus.model
    for number in range(model.ngeom):
        is_moving, *models = number in task.apparatus.moving_geoms, *model.geom(number).name.split("/")
        name, is_drawn = models[max(0, len(models) - 2)], model.geom_group[number] != 4
        if is_moving != is_still and (is_moving or is_drawn) and name not in ("floor", "mat"):
            found.add(name)
    return found


COVERED = {
    "threshold": {"block"},
    "balance": {"beam"},
    "strings": {"puck_0", "puck_1", "puck_2"},
    "sealed_box": {"weight"},
}
"""The things of each domain that no observation tells of; Strike's puck appears after the answer."""

OUTSIDE = [("which_is_bolted", "features")]
SHOWN = [names for names in suite.ALL_TASKS if names[1].endswith("features")] + [("towers", "fist_pixels"), *OUTSIDE]


@pytest.mark.parametrize(("domain", "task"), SHOWN, ids=["/".join(names) for names in SHOWN])
def test_a_replay_shows_the_right_names(domain, task, tmp_path):
    make_task = None if (domain, task) in suite.ALL_TASKS else getattr(example("bolted"), task)
    episode, _, environment = record(domain, task, interactions=3, make_task=make_task)
    path, played = writing.write(tmp_path / "one.rrd", [lambda: [episode]]), environment.task
    labels, colors = series(path, "/belief/labels")
    assert len(set(labels)) == len(set(colors)) == played.num_labels
    assert all(shown in label for shown, label in zip(labels, played.label_names, strict=True))
    assert names_of(path, "/belief/policy") == played.action_names
    lines = [f"- step {step}: {played.action_names[action]}" for step, action in enumerate(episode.actions)]
    assert chunks(path, "/did/actions")["TextDocument:text"][-1][0].splitlines() == lines
    assert played.question in chunks(path, "/did/outcome")["TextDocument:text"][0][0]
    assert f"{domain}/{task}, seed" in chunks(path, "/did/outcome")["TextDocument:text"][0][0]
    moving, still = things(played, is_still=False), things(played, is_still=True)
    assert entities(path, "/world/room/") == {"floor", *still}
    seen = entities(path, "/world/things/") - {"action"}
    if task == "features":
        assert seen == moving - COVERED.get(domain, set())
    revealed = played.reveal(episode.hidden)
    shown = (revealed.marks, revealed.joined, revealed.tied)
    assert any(shown) or played.answers(played.hidden[None]) == played.num_labels - 1
    assert entities(path, "/world/hidden/") == moving | {
        "action",
        *(f"mark_{thing}" for thing in revealed.marks),
        *(f"{first}_to_{second}" for first, second in (*revealed.joined, *revealed.tied)),
    }
    if task.endswith("pixels"):
        assert entities(path, "/seen/") == {"pixels"}
        return
    expected = {
        f"{name}/{component}" if component else name
        for name, reading in played.readings.items()
        for component in reading.components or [""]
    }
    assert entities(path, "/seen/") - {"moved"} == expected
    printed = text_of(path)
    for name, reading in played.readings.items():
        for component in reading.components or [""]:
            curves = names_of(path, f"/seen/{name}/{component}".rstrip("/"))
            spoken = {thing.replace("_", " ") for thing in moving | still}
            if reading.shape == (1,):
                assert curves == [name.replace("_", " ")]
            elif set(curves) <= spoken:
                assert len(curves) == len(reading.sensors)
            else:  # Each value is made of several sensors.
                assert curves == [str(number) for number in range(reading.shape[0])]
                assert len(curves) != len(reading.sensors)
            title = component or f"seen: {name.replace('_', ' ')}"
            assert (f"{title}, {reading.unit}" if reading.unit else title) in printed


def names_of(path, entity):
    """Names of the curves of an entity in a file, whatever their colours."""
    for chunk in RrdReader(str(path)).stream():
        if str(chunk.entity_path) == entity and chunk.is_static:
            return chunk.to_record_batch().to_pydict()["SeriesLines:names"][0]
    raise LookupError(entity)


def test_covers_are_transparent_only_in_the_view_of_hidden_things(tmp_path):
    environment = suite.load("threshold", "features", task_kwargs={"random": fresh_seed()})
    recorder = replay.EpisodeRecorder(environment, "threshold", "features")
    recorder.observe_first(environment, environment.reset())
    for action in (7, 7, 8):  # The largest force takes the block to the other side, and back again.
        recorder.observe(environment, environment.step(action), action)
    episode, names = recorder.episode, recorder.episode.shapes.names
    steps = np.array([0, 1, 2]) * environment.task.options.substeps
    flag = episode.positions[steps, names.index("flag"), 2]
    assert flag[0] + 0.05 < flag[1] == flag[2]  # It is up as long as pushes slide the block.
    path = writing.write(tmp_path / "one.rrd", [lambda: [episode]])
    assert entities(path, "/world/hidden/") == {"action", "block", "flag", "pointer", "mark_block"}
    assert "ViewContents/overrides/world/room/cover" in text_of(path)
    columns = chunks(path, "/world/things/action")
    origins, vectors = (np.array(columns[f"Arrows3D:{name}"])[:, 0] for name in ("origins", "vectors"))
    shown = np.linalg.norm(vectors, axis=1) > 0
    assert np.ptp(origins[shown], axis=0).max() == 0  # The arrow does not follow the block.
    assert vectors[steps[0] + 1, 0] > 0 > vectors[steps[1] + 1, 0]  # A push goes away from the stop.


def test_bands_are_hidden_lines_that_follow_their_pucks(tmp_path):
    environment = suite.load("strings", "features", task_kwargs={"random": fresh_seed()})
    recorder = replay.EpisodeRecorder(environment, "strings", "features")
    timestep = environment.reset()
    while environment.task.correct_answer != 1:  # A band between the first two alone.
        timestep = environment.reset()
    recorder.observe_first(environment, timestep)
    for action in (0, 2, 7):
        recorder.observe(environment, environment.step(action), action)
    episode = recorder.episode
    path = writing.write(tmp_path / "one.rrd", [lambda: [episode]])
    assert {"puck_0", "puck_1", "puck_2", "puck_0_to_puck_1"} <= entities(path, "/world/hidden/")
    strips = np.array(chunks(path, "/world/hidden/puck_0_to_puck_1")["LineStrips3D:strips"])[:, 0]
    ends = [episode.shapes.names.index(f"puck_{k}") for k in range(2)]
    np.testing.assert_allclose(strips, episode.true_positions[:, ends], atol=1e-6)
    assert np.ptp(strips[:, :, 1], axis=0).min() > 0.02  # A pull at one of them moves both.


def test_a_strike_is_played_out_after_the_answer(tmp_path):
    environment = suite.load("strike", "features", task_kwargs={"random": fresh_seed()})
    recorder = replay.EpisodeRecorder(environment, "strike", "features")
    near, far = (environment.task.options.goal_distance * 1.5**power for power in (-1, 1))
    for mistake in (0, 1):
        recorder.observe_first(environment, environment.reset())
        right = environment.task.correct_answer
        for action in (1, 3 + (right + mistake) % 7):
            recorder.observe(environment, environment.step(action), action)
        episode = recorder.episode
        places = episode.positions[:, episode.shapes.names.index("puck"), 0]
        assert len(places) == len(episode.times) and episode.times[-1] > 0.2  # A poke takes 0.1 s.
        assert (near < places[-1] - places[0] < far) == (mistake == 0)
    path = writing.write(tmp_path / "one.rrd", [lambda: [episode]])
    assert {"mark_puck", "puck"} <= entities(path, "/world/hidden/")
    appears = chunks(path, "/world/things/puck")["time"][0].total_seconds()
    assert appears == pytest.approx(episode.control_timestep + environment.task.options.physics_timestep)


def test_shapes_of_any_kind_are_drawn_under_names_of_their_own(tmp_path):
    bolted = example("bolted")

    def make_task(**options):
        made = bolted.features(**options)
        rod = made.root_entity.mjcf_model.worldbody.add("body", name="rod", pos=[0.3, 0, 0.2])
        rod.add("joint", name="hinge", type="hinge", axis=[0, 1, 0])
        rod.add("geom", name="rod", type="capsule", size=[0.02, 0.1])
        rod.add("geom", name="weight", type="cylinder", size=[0.04, 0.03], pos=[0, 0, 0.1])
        rod.add("geom", name="tip", type="ellipsoid", size=[0.01, 0.02, 0.03], pos=[0, 0, -0.1])
        block_1 = made.root_entity.mjcf_model.find("geom", "block_1/geom").parent
        block_1.add("geom", name="lid", type="sphere", size=[0.02], pos=[0, 0, 0.06])
        return made

    episode, *_ = record("which_is_bolted", "features", make_task=make_task)
    kinds = dict(zip(episode.shapes.names, episode.shapes.kinds, strict=True))
    blocks = {f"block_{k}": "box" for k in range(3)} | {"block_1_lid": "sphere"}
    assert kinds == blocks | {"rod": "capsule", "weight": "cylinder", "tip": "ellipsoid"}
    path = writing.write(tmp_path / "one.rrd", [lambda: [episode]])
    assert entities(path, "/world/things/") == {"action", *blocks}  # No reading tells of the rod.
    assert entities(path, "/world/hidden/") >= set(kinds)
    columns = {}
    for chunk in RrdReader(str(path)).stream():
        if str(chunk.entity_path).startswith("/world/hidden/") and chunk.is_static:
            columns.setdefault(str(chunk.entity_path).rpartition("/")[2], {}).update(
                chunk.to_record_batch().to_pydict()
            )
    assert columns["rod"]["Capsules3D:lengths"][0] == pytest.approx([0.2])
    assert columns["weight"]["Cylinders3D:lengths"][0] == pytest.approx([0.06])
    assert columns["tip"]["Ellipsoids3D:half_sizes"][0][0] == pytest.approx([0.01, 0.02, 0.03])
    assert columns["block_1_lid"]["Ellipsoids3D:half_sizes"][0][0] == pytest.approx([0.02] * 3)


def test_hidden_properties_are_entities_that_the_first_view_switches_off(written):
    episode, _, _, path = written
    names = {str(chunk.entity_path) for chunk in RrdReader(str(path)).stream()}
    hidden = {name.removeprefix("/world/hidden/") for name in names if name.startswith("/world/hidden/")}
    told = hidden - {"action", *episode.shapes.names}
    if episode.domain == "which_is_heavier":
        assert told == {f"mark_block_{k}" for k in range(4)}
    else:
        glued = np.flatnonzero(tower.PATTERNS[int(episode.hidden)])
        assert told == {f"block_{k}_to_block_{k + 1}" for k in glued}
    if "pixels" in episode.observations:  # The view that comes first shows the image alone.
        return
    printed = text_of(path)
    override = printed.partition("ViewContents/overrides/world/hidden")[2]
    table = override.partition("EntityBehavior:visible")[2].partition("METADATA")[0]
    assert "[false]" in table and "[true]" not in table
    assert words.HIDDEN_TAB in printed  # The view that shows it.


def test_an_arrow_shows_where_the_action_acts_and_which_way(written):
    episode, _, environment, path = written
    columns = chunks(path, "/world/hidden/action")
    origins, vectors = (np.array(columns[f"Arrows3D:{name}"])[:, 0] for name in ("origins", "vectors"))
    substeps = environment.task.options.substeps
    for step in range(5):
        interaction = environment.task.interactions[episode.actions[step]]
        thing, effect = interaction.thing, np.array(interaction.vector)
        frame = step * substeps + 1
        k = episode.shapes.names.index(thing)
        np.testing.assert_allclose(origins[frame], episode.true_positions[frame, k], atol=1e-6)
        np.testing.assert_allclose(
            vectors[frame] / np.linalg.norm(vectors[frame]), effect / np.linalg.norm(effect), atol=1e-6
        )


@pytest.mark.parametrize(("domain", "task"), TASKS[:2] + [("towers", "direct_features")])
def test_the_vectors_that_are_shown_are_those_of_the_physics(domain, task):
    environment = suite.load(domain, task, task_kwargs={"random": fresh_seed()})
    for action, interaction in enumerate(environment.task.interactions):
        effect = np.array(interaction.vector)
        environment.reset()
        before = place(environment, interaction.thing)
        environment.step(action)
        moved = place(environment, interaction.thing) - before
        assert moved @ effect > 0.9 * np.linalg.norm(moved) * np.linalg.norm(effect) > 0


def test_the_ideal_posterior_beside_an_agent_follows_its_pokes():
    episode, _, _ = record("which_is_heavier", "features")
    posteriors = beliefs.of_ideal(episode)
    assert posteriors.shape == (7, 4)
    np.testing.assert_allclose(posteriors[0], 0.25)  # Nothing is known yet.
    np.testing.assert_allclose(posteriors.sum(axis=1), 1)
    poked = set()
    for step, action in enumerate(episode.actions[:-1]):
        again = action in poked
        poked.add(int(action))
        is_sure = posteriors[step].max() == 1  # Of a mass of nearly 1 all doubt is rounded away.
        assert np.array_equal(posteriors[step], posteriors[step + 1]) == (again or is_sure)


def test_a_noisy_episode_is_enacted_as_it_was_without_an_ideal(tmp_path):
    noise, seed = 0.01, fresh_seed()
    config = config_lib.TrainConfig(
        domain="which_is_heavier",
        task="features",
        task_kwargs={"noise": noise},
        agent=belief_config.BeliefConfig(),
    )
    batch = suite.load_batch(config.domain, config.task, 2, config.task_kwargs)
    network = starting.make_network(belief_networks.BeliefNetwork, batch, config.agent)
    batch.close()
    environment = suite.load(config.domain, config.task, {"random": seed, **config.task_kwargs})
    heights = [
        environment.reset().observation["heights"],
        *(environment.step(k).observation["heights"] for k in (2, 0)),
    ]
    environment.close()

    episode = recording.reenact(network, config, seed, 0, [2, 0, 4])
    np.testing.assert_array_equal(episode.observations["heights"][:3], heights)
    assert beliefs.of_ideal(episode) is None
    path = writing.write(tmp_path / "noisy.rrd", [lambda: [episode]])
    assert "labels" in entities(path, "/belief/") and "ideal" not in entities(path, "/belief/")


@pytest.mark.parametrize(("domain", "task"), TASKS)
def test_an_episode_known_by_its_seed_and_index_is_enacted_as_it_was(domain, task):
    network, config, _ = finding.find_agent(f"{domain}/{task}")
    played = playing.play(network, config, 3, seed=fresh_seed())
    for index in range(3):
        episode = recording.reenact(
            network, config, played.seed[index], played.episode[index], played.actions_of(index)
        )
        np.testing.assert_array_equal(episode.actions, played.actions_of(index))
        np.testing.assert_array_equal(episode.hidden, played.hidden[index])
        assert episode.rewards.sum() == played.reward[index]
        chosen = episode.policies[np.arange(len(episode.actions)), episode.actions]
        assert (chosen > 1e-6).all()  # The beliefs are those that led to the actions.


def test_an_agent_with_a_belief_shows_it_instead_of_its_policy(tmp_path):
    config = config_lib.TrainConfig(
        domain="which_is_heavier",
        task="features",
        agent=belief_config.BeliefConfig(seed=fresh_seed()),
    )
    environment = suite.load_batch(config.domain, config.task, 2)
    network = starting.make_network(belief_networks.BeliefNetwork, environment, config.agent)
    environment.close()
    first_label = 4
    episode = recording.reenact(network, config, 7, 0, [0, 1, 2, first_label])

    # To answer earns +1 or -1, so the best label is worth 2 max(b) - 1; at first no interaction is worth less.
    own = episode.beliefs
    assert own.shape == (4, 4)
    np.testing.assert_allclose(own.sum(axis=1), 1, atol=1e-5)
    assert (episode.values >= 2 * own.max(axis=1) - 1 - 1e-5).all()
    # The policy takes the best action, and there an interaction: it does not tell what is believed.
    assert episode.policies[:, first_label:].sum() < 0.05

    path = writing.write(tmp_path / "belief.rrd", [lambda: [episode]])
    np.testing.assert_allclose(chunks(path, "/belief/labels")["Scalars:scalars"], own)
    assert "how likely it holds each label" in words.about(episode, "ended")
    assert "renormalized" not in words.about(episode, "ended")


def write_two_of_four(path):
    """Writes two episodes, and never comes to an end with the third."""

    def group(number):
        if number == 2:
            signal.pause()
        return [record("towers", "fist_features", seed=number)[0]]

    groups = [functools.partial(group, number) for number in range(4)]
    writing.write(path, groups, lambda line: print(line, flush=True))


def test_a_killed_writer_leaves_the_earlier_episodes_readable(tmp_path):
    path = tmp_path / "replay.rrd"
    with commands.Process(write_two_of_four, path) as process:
        wait_until(lambda: "2 of 4" in process.stdout.so_far(), "two episodes written")
        process.kill()
        process.wait()
    subprocess.run([writing.PROGRAM, "rrd", "verify", path], check=True, capture_output=True)
    assert [entry.kind for entry in RrdReader(str(path)).recordings()] == ["recording"] * 2
    assert [entry.name for entry in tmp_path.iterdir()] == ["replay.rrd"]


def test_a_full_disk_leaves_the_earlier_episodes_and_is_one_line(tmp_path):
    def write(name, count, **kwargs):
        options = ["--episodes", count, "--output", tmp_path / name]
        return commands.run("replay", "which_is_heavier/features", *options, **kwargs)

    write("one.rrd", 1)
    # Each episode of a few pokes is about as large as the next; the kernel refuses files of two and a half.
    limit = int(2.5 * (tmp_path / "one.rrd").stat().st_size)
    done = write("four.rrd", 4, first=functools.partial(resource.setrlimit, resource.RLIMIT_FSIZE, (limit, limit)))
    assert done.returncode == 2
    (line,) = done.stderr.splitlines()
    assert "File too large" in line
    subprocess.run([writing.PROGRAM, "rrd", "verify", tmp_path / "four.rrd"], check=True, capture_output=True)
    assert 1 <= len(RrdReader(str(tmp_path / "four.rrd")).recordings()) < 4
    assert sorted(path.name for path in tmp_path.iterdir()) == ["four.rrd", "one.rrd"]


def test_two_agents_are_shown_side_by_side_on_the_same_instances(tmp_path):
    lines = []
    path = replay.replay(["towers/fist_features"] * 2, 1, tmp_path / "both.rrd", tell=lines.append)
    assert len(lines) == 1
    names = {str(chunk.entity_path) for chunk in RrdReader(str(path)).stream()}
    assert {"/A/world/things/fist", "/B/world/things/fist", "/A/belief/value", "/B/belief/value"} <= names
    printed = text_of(path)
    for title in ("A: towers/fist_features", "B: towers/fist_features", "A: belief", "B: belief"):
        assert title in printed


def test_agents_of_different_tasks_are_not_compared(tmp_path):
    with pytest.raises(
        ValueError, match="fist_features plays towers/fist_features, and which_is_heavier/features plays "
    ):
        replay.replay(["towers/fist_features", "which_is_heavier/features"], 1, tmp_path / "x.rrd")


def test_agents_with_equal_options_given_or_default_are_compared(tmp_path):
    agent = ppo.PPOConfig(frames=500, num_environments=8, num_minibatches=1)
    config = config_lib.TrainConfig(domain="which_is_heavier", task="features", agent=agent)
    run = run_lib.Run(tmp_path / "run")
    trainer.train(run, start=config)
    assert not config.task_kwargs and finding.find_agent("which_is_heavier/features")[1].task_kwargs
    path = replay.replay([str(run.path), "which_is_heavier/features"], 1, tmp_path / "both.rrd")
    assert path.exists()


def test_a_selection_holds_the_episodes_of_its_name():
    network, config, _ = finding.find_agent("which_is_heavier/features")
    play = functools.partial(playing.play, network, config)
    everything = play(256, seed=5)
    kinds = ("any", "right", "wrong", "longest", "hardest")
    chosen = {kind: list(selection.select(network, config, 5, kind, seed=5)) for kind in kinds}
    instances = np.stack([everything.seed, everything.episode], axis=1)
    wanted = {"any": np.full(256, True), "right": everything.reward > 0, "wrong": everything.reward < 0}
    for kind, which in wanted.items():  # The first of them, in their order; for five wrong ones, more are played.
        first = instances[which][:5].tolist()
        found = [[seed, episode] for seed, episode, _ in chosen[kind]]
        assert first and len(found) == 5 and found[: len(first)] == first, kind
    lengths = sorted(everything.length, reverse=True)
    assert [len(actions) for _, _, actions in chosen["longest"]] == lengths[:5]
    gaps = np.sort(everything.hidden)[:, -1] - np.sort(everything.hidden)[:, -2]
    hardest = np.argsort(gaps)[:5]
    assert [seed for seed, _, _ in chosen["hardest"]] == list(everything.seed[hardest])
    wrong = list(selection.select(network, config, 2, "wrong", interaction="random", seed=5))
    assert len(wrong) == 2
    for seed, episode, actions in wrong:
        environment = suite.load("which_is_heavier", "features", task_kwargs={**config.task_kwargs, "random": seed})
        environment.task.next_episode = episode
        environment.reset()
        for action in actions:
            timestep = environment.step(int(action))
        assert timestep.last() and timestep.reward == -1


@screens.needs_screen
def test_the_viewer_opens_a_file_and_shows_it(tmp_path):
    episode, _, _ = record("towers", "fist_features")
    path = writing.write(tmp_path / "one.rrd", [lambda: [episode]])
    picture = tmp_path / "viewer.png"
    environment = {"HOME": str(tmp_path), "PATH": "/usr/bin:/bin"}
    waiting.run([writing.PROGRAM, "analytics", "disable"], env=environment)
    # The pointer is in the middle of the screen; beside the window, it covers nothing with what it points to.
    with screens.screen("3000x2000x24") as display:
        # Without `--new`, a viewer that finds rerun's port taken hands over its data and ends.
        command = [writing.PROGRAM, path, "--new", "--screenshot-to", picture, "--window-size", "1280x800"]
        waiting.run(command, env={**environment, "DISPLAY": display})
    pixels = np.asarray(Image.open(picture).convert("RGB"))
    colors, counts = np.unique(pixels.reshape(-1, 3), axis=0, return_counts=True)
    assert len(colors) > 200  # Text, curves, shaded cubes: much more than a background.
    assert counts.max() < 0.95 * counts.sum()
    red = np.array(things_lib.COLORS[0][:3])  # The face of block 0, in whatever light.
    seen = colors[np.linalg.norm(colors, axis=1) > 0].astype(float)
    hue = seen / np.linalg.norm(seen, axis=1, keepdims=True) - red / np.linalg.norm(red)
    assert counts[np.linalg.norm(colors, axis=1) > 0][np.linalg.norm(hue, axis=1) < 0.08].sum() > 300


def test_a_live_episode_shows_nothing_hidden_before_it_is_over(tmp_path):
    environment = suite.load("which_is_heavier", "features", task_kwargs={"random": fresh_seed()})
    recorder = replay.EpisodeRecorder(environment, "which_is_heavier", "features", agent="you")
    paths = [tmp_path / "so_far.rrd", tmp_path / "all.rrd"]
    entities = []
    for path, actions in zip(paths, ([0, 1], [0, 1, 4]), strict=True):
        streams = []

        class File:
            def show(self, stream, layout, path=path, streams=streams):
                streams.append(stream)
                stream.save(path, default_blueprint=layout)

            def flush(self, stream):
                stream.flush()

        environment.task.next_episode = 0
        observers = [recorder, live.Live(recorder, File())]
        timestep = environment.reset()
        for observer in observers:
            observer.observe_first(environment, timestep)
        for action in actions:
            timestep = environment.step(action)
            for observer in observers:
                observer.observe(environment, timestep, action)
        streams[0].disconnect()
        entities.append({str(chunk.entity_path) for chunk in RrdReader(str(path)).stream()})
    so_far, everything = entities
    assert "/world/things/block_0" in so_far and "/did/actions" in so_far and "/seen/heights" in so_far
    assert not [entity for entity in so_far if "hidden" in entity or "ideal" in entity]
    assert {"/world/hidden/mark_block_0", "/belief/ideal"} <= everything
    said = [{text[0] for text in chunks(path, "/did/outcome")["TextDocument:text"]} for path in paths]
    assert all("Not answered yet" in text for text in said[0])
    assert any("Answer after 2 interactions" in text for text in said[1])
    log = chunks(paths[1], "/did/actions")["TextDocument:text"][-1][0].splitlines()
    assert log == ["- step 0: poke block 0", "- step 1: poke block 1", "- step 2: answer: block 0 is heaviest"]


def viewers(home):
    """The processes of rerun's program whose HOME is this."""
    found = []
    for entry in Path("/proc").iterdir():
        with contextlib.suppress(OSError):
            is_ours = entry.name.isdigit() and f"HOME={home}\0".encode() in (entry / "environ").read_bytes()
            if is_ours and os.readlink(entry / "exe") == str(writing.PROGRAM.resolve()):
                found.append(int(entry.name))
    return found


URL = r"http://127\.0\.0\.1:\d+/\S+"


def test_the_browser_viewer_is_served_on_the_loopback_alone(tmp_path):
    environment = {**os.environ, "HOME": str(tmp_path), "BROWSER": "true"}
    options = ["--episodes", 1, "--web", "--output", tmp_path / "one.rrd"]

    def sockets():
        return {socket for viewer in viewers(tmp_path) for socket in commands.listening(viewer)}

    with commands.start(
        "replay", "which_is_heavier/features", *options, env=environment, stderr=subprocess.STDOUT
    ) as process:
        wait_until(lambda: len(sockets()) >= 2, "two listening sockets")
        assert {address for address, _ in sockets()} == {"127.0.0.1"}
        wait_until(lambda: re.search(URL, process.stdout.so_far()), "its address")
        (url,) = re.findall(URL, process.stdout.so_far())
        with urllib.request.urlopen(url, timeout=600) as page:
            assert page.status == 200
        process.send_signal(signal.SIGINT)
        assert process.wait() == 0
        wait_until(lambda: not viewers(tmp_path), "the viewer to be gone")
        assert "Traceback" not in process.stdout.read()


@screens.needs_screen
def test_a_person_plays_beside_a_local_viewer_that_may_be_closed(tmp_path):
    with screens.screen() as display:
        environment = {
            "HOME": str(tmp_path),
            "PATH": f"{PHYSEXP.parent}:/usr/bin:/bin",
            "PYTHONPATH": os.environ.get("PYTHONPATH", ""),
            "DISPLAY": display,
        }
        waiting.run([writing.PROGRAM, "analytics", "disable"], env=environment)
        _play_beside_the_viewer(environment, tmp_path)


def _play_beside_the_viewer(environment, home):
    command = [PHYSEXP, "play", "which_is_heavier", "features", "--seed", "3", "--view"]
    output = home / "output"
    with open(output, "w") as file:
        process = subprocess.Popen(
            command, env=environment, stdin=subprocess.PIPE, stdout=file, stderr=file, text=True, start_new_session=True
        )

    def type_in(text):
        asked = output.read_text().count("action: ")
        process.stdin.write(text + "\n")
        process.stdin.flush()
        wait_until(lambda: output.read_text().count("action: ") > asked, f"the question after {text}")

    try:
        wait_until(lambda: "action: " in output.read_text(), "the first question")
        wait_until(lambda: any(map(commands.listening, viewers(home))), "a viewer that listens")
        (first,) = viewers(home)
        assert {address for address, _ in commands.listening(first)} == {"127.0.0.1"}
        type_in("0")
        os.kill(first, signal.SIGKILL)  # The player closes the window.
        type_in("0")
        type_in("4")  # The next episode opens another one.
        wait_until(lambda: set(viewers(home)) - {first}, "another viewer")
        process.stdin.write("q\n")
        process.stdin.close()
        wait_until(lambda: process.poll() is not None, "the end of the game")
        assert process.returncode == 0
        assert output.read_text().count("The answer: block") == 1 and "Traceback" not in output.read_text()
    finally:
        for pid in viewers(home):
            with contextlib.suppress(ProcessLookupError):
                os.kill(pid, signal.SIGKILL)
        with contextlib.suppress(ProcessLookupError):
            os.killpg(process.pid, signal.SIGKILL)
        process.wait()
        process.stdin.close()


def test_without_a_display_the_viewer_is_refused_in_one_line(tmp_path):
    environment = {"HOME": str(tmp_path), "PYTHONPATH": os.environ.get("PYTHONPATH", "")}
    done = commands.run("replay", "which_is_heavier/features", "--view", cwd=tmp_path, env=environment)
    assert not list(tmp_path.glob("*.rrd"))
    assert done.returncode == 2 and done.stderr.count("\n") == 1 and "no display" in done.stderr


def test_the_command_writes_a_file_and_names_it(tmp_path):
    path = tmp_path / "file.rrd"
    done = commands.run("replay", "which_is_heavier/features", "--episodes", 2, "--output", path, check=True)
    assert done.stdout.splitlines()[-1] == str(path)
    assert len(RrdReader(str(path)).recordings()) == 2


def test_a_failing_or_hanging_rerun_program_is_one_line(tmp_path, monkeypatch):
    episode, _, _ = record("which_is_heavier", "features")
    failing, sleeping = tmp_path / "failing", tmp_path / "sleeping"
    failing.write_text("#!/bin/sh\ncat > /dev/null\necho something went wrong >&2\nexit 3\n")
    sleeping.write_text("#!/bin/sh\nexec sleep 1000\n")
    for program, message in ((failing, "cannot merge the recordings: something went wrong$"), (sleeping, "not merged")):
        program.chmod(0o755)
        if program is sleeping:
            monkeypatch.setattr(writing, "_MERGE_SECONDS", 0.2)
        monkeypatch.setattr(writing, "PROGRAM", program)
        path = tmp_path / f"{program.name}.rrd"
        with pytest.raises(RuntimeError, match=message):
            writing.write(path, [lambda: [episode]] * 2)
        assert len(RrdReader(str(path)).recordings()) == 1  # The first one is there.


@pytest.mark.parametrize(
    ("name", "message"),
    [
        (".", ". is a folder; name a file"),
        ("x.txt", "x.txt is no name of a replay; name a file that ends in .rrd"),
        ("a/x.rrd", "a is no folder; make it, or name a file in another"),
    ],
)
def test_a_path_that_cannot_be_written_is_refused_before_play(name, message, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(ValueError, match=re.escape(message)):
        replay.replay(["no agent at all"], 1, Path(name))
    assert not list(tmp_path.iterdir())


def test_a_replay_of_no_episode_is_one_line(tmp_path):
    done = commands.run("replay", "towers/fist_features", "--episodes", "0", cwd=tmp_path)
    assert (done.returncode, done.stderr) == (2, "physexp: episodes is 0; give a number >= 1\n")
    assert not list(tmp_path.iterdir())
