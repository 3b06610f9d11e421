"""Replays: what is recorded is what happened, and what is written is what was recorded."""

import functools
from pathlib import Path
import re
import sys

import numpy as np
import observers
import pytest
import recordings
from rerun.blueprint import components
from rerun.chunk import RrdReader
from scipy.spatial import transform
from seeds import fresh_seed

from physexp import suite
from physexp.agents import core, environment_loop
from physexp.agents.belief import config as belief_config
from physexp.agents.ppo import config as ppo
from physexp.analysis import replay
from physexp.analysis.data import readings
from physexp.analysis.replay import beliefs, recording, selection, words, writing
from physexp.analysis.training import config as config_lib
from physexp.analysis.training import finding, playing, trainer
from physexp.analysis.training import run as run_lib
from physexp.suite.parts import things as things_lib
from physexp.suite.parts import tower

sys.path.insert(0, str(Path(__file__).parents[3] / "docs" / "examples"))

import bolted  # noqa: E402

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


def record(domain, task, interactions=5, make_task=None):
    """A recorded episode, and what another observer has seen of it."""
    options = {"random": fresh_seed()}
    played = suite.load_task(domain, task, options) if make_task is None else make_task(**options)
    environment = suite.Environment(played)
    actor, watcher = Careless(environment, interactions, options["random"]), observers.Watcher()
    recorder = replay.EpisodeRecorder(domain, task, options, actor, "a careless agent", make_task)
    environment_loop.EnvironmentLoop(environment, actor, [watcher, recorder]).run_episode()
    return recorder.episode, watcher, environment


def place(environment, thing):
    """The position of a thing in the simulation."""
    model = environment.physics.model
    (geom,) = [g for g in range(model.ngeom) if f"{thing}/geom" in model.geom(g).name]
    return environment.physics.data.geom_xpos[geom].copy()


@pytest.fixture(scope="module", params=TASKS, ids=["/".join(names) for names in TASKS])
def written(request, tmp_path_factory):
    """A recorded episode, its observations, its environment, its file and the contents of the file."""
    episode, watcher, environment = record(*request.param)
    path = writing.write(tmp_path_factory.mktemp("replay") / "one.rrd", [lambda: [episode]])
    return episode, watcher, environment, path, recordings.contents(path)


def test_a_recorder_keeps_what_happened(written):
    episode, watcher, environment, *_ = written
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
    episode, _, environment, *_ = written
    substeps = environment.task.options.substeps
    assert len(episode.times) == 5 * substeps + 1  # Five interactions; the answer takes no time.
    np.testing.assert_allclose(np.diff(episode.times), environment.task.options.physics_timestep)
    for k, name in enumerate(episode.shapes.names):
        np.testing.assert_array_equal(episode.true_positions[-1, k], place(environment, name))
    assert not np.array_equal(episode.true_positions[0], episode.true_positions[-1])


def test_a_recorder_with_another_difficulty_is_refused():
    environment = suite.load("which_is_heavier", "features", task_kwargs={"random": fresh_seed(), "difficulty": 3})
    recorder = replay.EpisodeRecorder("which_is_heavier", "features", {"difficulty": 10})
    recorder.observe_first(environment, environment.reset())
    recorder.observe(environment, environment.step(0), 0)
    with pytest.raises(RuntimeError, match="is not what was seen: heights differs; record the environment with"):
        _ = recorder.episode
    recorder.close()


def test_poses_and_observations_read_back_are_those_of_the_episode(written):
    episode, _, _, path, rows = written
    recordings.verify(path)
    assert path.stat().st_size < 1e6
    films = [("hidden", episode.true_positions, episode.true_rotations)]
    if "pixels" not in episode.observations:
        films.append(("things", episode.positions, episode.rotations))
    for root, positions, rotations in films:
        for k, name in enumerate(episode.shapes.names):
            columns = rows[f"/world/{root}/{name}"]
            assert [time.total_seconds() for time in columns["time"]] == pytest.approx(list(episode.times), abs=2e-6)
            moved = np.array(columns["Transform3D:translation"])[:, 0]
            np.testing.assert_array_equal(moved, positions[:, k].astype(np.float32))
            turned = transform.Rotation.from_quat(np.array(columns["Transform3D:quaternion"])[:, 0]).as_matrix()
            np.testing.assert_allclose(turned, rotations[:, k], atol=1e-5)
    for name, values in episode.observations.items():
        if values.dtype == np.uint8:
            images = np.array(rows[f"/seen/{name}"]["Image:buffer"], np.uint8).reshape(values.shape)
            np.testing.assert_array_equal(images, values)
        elif name == "heights":
            np.testing.assert_array_equal(rows["/seen/heights"]["Scalars:scalars"][::2], values)
        else:  # Positions, of five blocks or of one fist.
            read = [rows[f"/seen/{name}/{letter}"]["Scalars:scalars"][::2] for letter in "xyz"]
            np.testing.assert_array_equal(np.stack(read, axis=-1), values.reshape(len(values), -1, 3))
    if "fist_position" in episode.observations:
        values = episode.observations["fist_position"]
        far = np.linalg.norm(values - values[0], axis=1)
        np.testing.assert_allclose(np.array(rows["/seen/moved"]["Scalars:scalars"])[::2, 5], far, rtol=1e-5)


def test_a_replay_opens_playing_at_a_tenth_of_real_time(written):
    reader, panel = RrdReader(str(written[3])), {}
    (blueprint,) = reader.blueprints()
    for chunk in reader.stream(store=blueprint):
        if str(chunk.entity_path) == "/time_panel":
            panel.update(chunk.to_record_batch().to_pydict())
    assert panel["TimePanelBlueprint:timeline"] == [["time"]]
    assert panel["TimePanelBlueprint:playback_speed"] == [[0.1]]
    assert panel["TimePanelBlueprint:play_state"] == [[components.PlayState.Playing.value]]


def test_no_curve_runs_ahead_of_the_moment_shown(written):
    changing = set()
    for entity, columns in written[-1].items():
        if "Scalars:scalars" in columns:
            times = np.array([time.total_seconds() for time in columns["time"]])
            are_changes = np.diff(columns["Scalars:scalars"], axis=0).any(axis=1)
            # The viewer draws a curve up to its next point.
            assert np.diff(times)[are_changes].max(initial=0) < 2e-6, entity
            changing |= {entity} if are_changes.any() else set()
    assert {"/belief/labels", "/belief/value"} <= changing


def test_beliefs_and_actions_are_written(written):
    episode, _, environment, _, rows = written
    answers = episode.policies[:, environment.task.num_interactions :]
    belief = answers / answers.sum(axis=1, keepdims=True)
    np.testing.assert_allclose(rows["/belief/labels"]["Scalars:scalars"][::2], belief)
    np.testing.assert_allclose(rows["/belief/policy"]["Scalars:scalars"][::2], episode.policies)
    np.testing.assert_allclose(np.ravel(rows["/belief/answers"]["Scalars:scalars"][::2]), answers.sum(axis=1))
    np.testing.assert_allclose(np.ravel(rows["/belief/value"]["Scalars:scalars"][::2]), episode.values)
    lines = [f"- step {step}: {environment.task.action_names[action]}" for step, action in enumerate(episode.actions)]
    said = [text[0].splitlines() for text in rows["/did/actions"]["TextDocument:text"]]
    assert said == [lines[: step + 1] for step in range(len(lines))]  # No later action is told.
    tables = [text[0].splitlines() for text in rows["/belief/now"]["TextDocument:text"]]
    assert len(tables) == len(episode.actions)
    for table, policy, shares in zip(tables, answers, belief, strict=True):
        for k, (row, name) in enumerate(zip(table[2:], environment.task.label_names, strict=True)):
            label, number, bar, answers_now, *_ = [cell.strip() for cell in row.strip("|").split("|")]
            assert label == name.removesuffix(" is heaviest")
            assert float(number) == pytest.approx(shares[k], abs=0.0051) and len(bar) == 20
            assert bar.count("█") == round(20 * shares[k])
            assert float(answers_now) == pytest.approx(policy[k], abs=0.0051)


def test_the_text_holds_question_episode_legend_and_at_last_the_verdict(written):
    episode, _, environment, _, rows = written
    start, end = [text[0] for text in rows["/did/outcome"]["TextDocument:text"]]
    names = [environment.task.question, f"seed {episode.seed}, episode 0", "a careless agent"]
    for word in [*names, "**policy**", "**belief**: the policy restricted to the labels", words.HIDDEN_TAB]:
        assert word in start and word in end
    assert "Not answered yet" in start and "Not answered yet" not in end
    verdict = "right" if episode.rewards[-1] > 0 else f"wrong; it is: {environment.task.label_names[episode.answer]}"
    assert f"That is {verdict}." in end


def test_a_blocks_colour_means_that_block_and_nothing_else(written):
    episode, *_, rows = written
    blocks = {f"block {k}": tuple(int(255 * c) for c in things_lib.COLORS[k][:3]) for k in range(5)}
    seen = set()
    for entity in rows.keys() & {"/belief/labels", "/belief/answers", "/belief/value", "/seen/heights", "/seen/moved"}:
        names, colors = (rows[entity][f"SeriesLines:{name}"][0] for name in ("names", "colors"))
        for name, number in zip(names, colors, strict=True):
            color = tuple(number.to_bytes(4, "big")[:3])
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
    "lump": {"plate", "core"},
}
"""The things of each domain that no observation tells of; Strike's puck appears after the answer."""

OUTSIDE = [("which_is_bolted", "features")]
SHOWN = [names for names in suite.ALL_TASKS if names[1].endswith("features")] + [("towers", "fist_pixels"), *OUTSIDE]
NAMES = "SeriesLines:names"


@pytest.mark.parametrize(("domain", "task"), SHOWN, ids=["/".join(names) for names in SHOWN])
def test_a_replay_shows_the_right_names(domain, task, tmp_path):
    make_task = None if (domain, task) in suite.ALL_TASKS else getattr(bolted, task)
    episode, _, environment = record(domain, task, interactions=3, make_task=make_task)
    rows, played = recordings.written(tmp_path / "one.rrd", episode), environment.task
    labels, colors = (rows["/belief/labels"][name][0] for name in (NAMES, "SeriesLines:colors"))
    assert len(set(labels)) == len(set(colors)) == played.num_labels
    assert all(shown in label for shown, label in zip(labels, played.label_names, strict=True))
    assert rows["/belief/policy"][NAMES][0] == played.action_names
    about = rows["/did/outcome"]["TextDocument:text"][0][0]
    assert played.question in about and f"{domain}/{task}, seed" in about
    moving, still = things(played, is_still=False), things(played, is_still=True)
    assert recordings.below(rows, "/world/room/") == {"floor", *still}
    if task == "features":
        assert recordings.below(rows, "/world/things/") - {"action"} == moving - COVERED.get(domain, set())
    revealed = played.reveal(episode.hidden)
    shown = (revealed.marks, revealed.joined, revealed.tied)
    assert any(shown) or played.answers(played.hidden[None]) == played.num_labels - 1
    pairs = [f"{first}_to_{second}" for first, second in (*revealed.joined, *revealed.tied)]
    marks = [f"mark_{thing}" for thing in revealed.marks]
    assert recordings.below(rows, "/world/hidden/") == {*moving, "action", *marks, *pairs}
    if task.endswith("pixels"):
        assert recordings.below(rows, "/seen/") == {"pixels"}
        return
    seen = [(name, each, reading) for name, reading in played.readings.items() for each in reading.components or [""]]
    expected = {f"{name}/{component}".rstrip("/") for name, component, _ in seen}
    assert recordings.below(rows, "/seen/") - {"moved"} == expected
    printed, spoken = recordings.text_of(tmp_path / "one.rrd"), {thing.replace("_", " ") for thing in moving | still}
    for name, component, reading in seen:
        curves = rows[f"/seen/{name}/{component}".rstrip("/")][NAMES][0]
        if reading.shape == (1,):
            assert curves == [name.replace("_", " ")]
        elif set(curves) <= spoken:
            assert len(curves) == len(reading.sensors)
        else:  # Each value is made of several sensors.
            assert curves == [str(number) for number in range(reading.shape[0])]
            assert len(curves) != len(reading.sensors)
        title = component or f"seen: {name.replace('_', ' ')}"
        assert (f"{title}, {reading.unit}" if reading.unit else title) in printed


def test_covers_are_transparent_only_in_the_view_of_hidden_things(tmp_path):
    # The largest force takes the block to the other side, and back again.
    film = recordings.play("threshold", "features", [7, 7, 8], random=fresh_seed())
    steps = np.array([0, 1, 2]) * film.declared.options.substeps
    flag = film.positions[steps, film.shapes.names.index("flag"), 2]
    assert flag[0] + 0.05 < flag[1] == flag[2]  # It is up as long as pushes slide the block.
    rows = recordings.written(tmp_path / "one.rrd", film)
    assert recordings.below(rows, "/world/hidden/") == {"action", "block", "flag", "pointer", "mark_block"}
    assert "ViewContents/overrides/world/room/cover" in recordings.text_of(tmp_path / "one.rrd")
    origins, vectors = (
        np.array(rows["/world/things/action"][f"Arrows3D:{name}"])[:, 0] for name in ("origins", "vectors")
    )
    shown = np.linalg.norm(vectors, axis=1) > 0
    assert np.ptp(origins[shown], axis=0).max() == 0  # The arrow does not follow the block.
    assert vectors[steps[0] + 1, 0] > 0 > vectors[steps[1] + 1, 0]  # A push goes away from the stop.


def test_bands_are_hidden_lines_that_follow_their_pucks(tmp_path):
    task = suite.load_task("strings", "features")
    drawn = task.draw(np.full(100, fresh_seed()), np.arange(100))
    hidden = drawn[task.answers(drawn) == 1][0]  # A band between the first two alone.
    film = recordings.play("strings", "features", [0, 2, 7], hidden=hidden)
    rows = recordings.written(tmp_path / "one.rrd", film)
    assert {"puck_0", "puck_1", "puck_2", "puck_0_to_puck_1"} <= recordings.below(rows, "/world/hidden/")
    strips = np.array(rows["/world/hidden/puck_0_to_puck_1"]["LineStrips3D:strips"])[:, 0]
    ends = [film.shapes.names.index(f"puck_{k}") for k in range(2)]
    np.testing.assert_allclose(strips, film.true_positions[:, ends], atol=1e-6)
    assert np.ptp(strips[:, :, 1], axis=0).min() > 0.02  # A pull at one of them moves both.


def test_a_strike_is_played_out_after_the_answer(tmp_path):
    task = suite.load_task("strike", "features")
    hidden = task.draw(np.array([fresh_seed()]), np.array([0]))
    near, far = (task.options.goal_distance * 1.5**power for power in (-1, 1))
    for mistake in (0, 1):
        label = (task.answers(hidden)[0] + mistake) % 7
        film = recordings.play("strike", "features", [1, 3 + label], hidden=hidden[0])
        places = film.positions[:, film.shapes.names.index("puck"), 0]
        assert len(places) == len(film.times) and film.times[-1] > 0.2  # A poke takes 0.1 s.
        assert (near < places[-1] - places[0] < far) == (mistake == 0)
    rows = recordings.written(tmp_path / "one.rrd", film)
    assert {"mark_puck", "puck"} <= recordings.below(rows, "/world/hidden/")
    appears = rows["/world/things/puck"]["time"][0].total_seconds()
    assert appears == pytest.approx(film.control_timestep + task.options.physics_timestep)


def test_shapes_of_any_kind_are_drawn_under_names_of_their_own(tmp_path):
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
    rows = recordings.written(tmp_path / "one.rrd", episode)
    assert recordings.below(rows, "/world/things/") == {"action", *blocks}  # No reading tells of the rod.
    assert recordings.below(rows, "/world/hidden/") >= set(kinds)
    assert rows["/world/hidden/rod"]["Capsules3D:lengths"][0] == pytest.approx([0.2])
    assert rows["/world/hidden/weight"]["Cylinders3D:lengths"][0] == pytest.approx([0.06])
    for name, half in {"tip": [0.01, 0.02, 0.03], "block_1_lid": [0.02] * 3}.items():
        assert rows[f"/world/hidden/{name}"]["Ellipsoids3D:half_sizes"][0][0] == pytest.approx(half)


def test_hidden_properties_are_entities_that_the_first_view_switches_off(written):
    episode, _, _, path, rows = written
    told = recordings.below(rows, "/world/hidden/") - {"action", *episode.shapes.names}
    if episode.domain == "which_is_heavier":
        assert told == {f"mark_block_{k}" for k in range(4)}
    else:
        glued = np.flatnonzero(tower.PATTERNS[int(episode.hidden)])
        assert told == {f"block_{k}_to_block_{k + 1}" for k in glued}
    if "pixels" in episode.observations:  # The view that comes first shows the image alone.
        return
    printed = recordings.text_of(path)
    override = printed.partition("ViewContents/overrides/world/hidden")[2]
    table = override.partition("EntityBehavior:visible")[2].partition("METADATA")[0]
    assert "[false]" in table and "[true]" not in table
    assert words.HIDDEN_TAB in printed  # The view that shows it.


def test_an_arrow_shows_where_the_action_acts_and_which_way(written):
    episode, _, environment, _, rows = written
    columns = rows["/world/hidden/action"]
    origins, vectors = (np.array(columns[f"Arrows3D:{name}"])[:, 0] for name in ("origins", "vectors"))
    for step in range(5):
        interaction = environment.task.interactions[episode.actions[step]]
        effect, frame = np.array(interaction.vector), step * environment.task.options.substeps + 1
        k = episode.shapes.names.index(interaction.thing)
        np.testing.assert_allclose(origins[frame], episode.true_positions[frame, k], atol=1e-6)
        direction = vectors[frame] / np.linalg.norm(vectors[frame])
        np.testing.assert_allclose(direction, effect / np.linalg.norm(effect), atol=1e-6)


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


def untrained_belief(**task_kwargs):
    """A belief learner's network as it is drawn, and its configuration."""
    agent = belief_config.BeliefConfig(seed=fresh_seed())
    config = config_lib.TrainConfig(domain="which_is_heavier", task="features", task_kwargs=task_kwargs, agent=agent)
    return trainer.make_network(config), config


def test_a_noisy_episode_is_enacted_as_it_was_without_an_ideal(tmp_path):
    network, config = untrained_belief(noise=0.01)
    environment = suite.load(config.domain, config.task, {"random": 3, **config.task_kwargs})
    seen = [environment.reset(), *map(environment.step, (2, 0))]
    environment.close()
    episode = recording.reenact(network, config, 3, 0, [2, 0, 4])
    heights = [timestep.observation["heights"] for timestep in seen]
    np.testing.assert_array_equal(episode.observations["heights"][:3], heights)
    assert beliefs.of_ideal(episode) is None
    rows = recordings.written(tmp_path / "noisy.rrd", episode)
    assert "/belief/labels" in rows and "/belief/ideal" not in rows


@pytest.mark.parametrize(("domain", "task"), TASKS)
def test_an_episode_known_by_its_seed_and_index_is_enacted_as_it_was(domain, task):
    network, config, _ = finding.find_agent(f"{domain}/{task}")
    played = playing.play(network, config, 2, seed=fresh_seed())
    for k in range(2):
        actions = played.actions_of(k)
        episode = recording.reenact(network, config, int(played.seed[k]), int(played.episode[k]), actions)
        np.testing.assert_array_equal(episode.actions, actions)
        np.testing.assert_array_equal(episode.hidden, played.hidden[k])
        assert episode.rewards.sum() == played.reward[k]
        chosen = episode.policies[np.arange(len(episode.actions)), episode.actions]
        assert (chosen > 1e-6).all()  # The beliefs are those that led to the actions.


def test_an_agent_with_a_belief_shows_it_instead_of_its_policy(tmp_path):
    network, config = untrained_belief()
    episode = recording.reenact(network, config, 7, 0, [0, 1, 2, 4])
    # To answer earns +1 or -1, so the best label is worth 2 max(b) - 1; at first no interaction is worth less.
    own = episode.beliefs
    assert own.shape == (4, 4)
    np.testing.assert_allclose(own.sum(axis=1), 1, atol=1e-5)
    assert (episode.values >= 2 * own.max(axis=1) - 1 - 1e-5).all()
    # The policy takes the best action, and there an interaction: it does not tell what is believed.
    assert episode.policies[:, 4:].sum() < 0.05
    rows = recordings.written(tmp_path / "belief.rrd", episode)
    np.testing.assert_allclose(rows["/belief/labels"]["Scalars:scalars"][::2], own)
    about = rows["/did/outcome"]["TextDocument:text"][-1][0]
    assert "how likely it holds each label" in about and "renormalized" not in about


def test_agents_are_shown_side_by_side_on_the_same_instances(tmp_path):
    lines = []
    path = replay.replay(["towers/fist_features"] * 2, 1, tmp_path / "both.rrd", tell=lines.append)
    assert len(lines) == 1
    names = set(recordings.contents(path))
    assert {"/A/world/things/fist", "/B/world/things/fist", "/A/belief/value", "/B/belief/value"} <= names
    printed = recordings.text_of(path)
    for title in ("A: towers/fist_features", "B: towers/fist_features", "A: belief", "B: belief"):
        assert title in printed
    with pytest.raises(ValueError, match="plays towers/fist_features, and which_is_heavier/features plays "):
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
    select = functools.partial(selection.select, network, config, seed=5)
    everything = playing.play(network, config, 256, seed=5)
    chosen = {kind: select(5, kind) for kind in ("any", "right", "wrong", "longest", "hardest")}
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
    wrong = select(2, "wrong", interaction="random")
    assert len(wrong) == 2
    for seed, index, actions in wrong:
        assert recording.reenact(network, config, seed, index, actions).rewards.sum() == -1


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


def test_a_replay_of_no_episode_is_refused(tmp_path):
    with pytest.raises(ValueError, match="episodes is 0; give a number >= 1"):
        replay.replay(["towers/fist_features"], 0, tmp_path / "x.rrd")
    assert not list(tmp_path.iterdir())
