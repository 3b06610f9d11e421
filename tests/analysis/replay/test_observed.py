"""Before the answer a replay shows nothing that observations and actions do not tell."""

import itertools

import numpy as np
import pytest
from rerun.chunk import RrdReader

from physexp import suite
from physexp.analysis import replay
from physexp.analysis.replay import live, writing


def task_with(domain, task, hidden, task_kwargs):
    """A task all of whose episodes have this hidden property."""
    made = suite.load_task(domain, task, {"random": 0, **task_kwargs})
    made.draw = lambda seeds, episodes: np.repeat(np.asarray(hidden)[None], len(episodes), axis=0)
    return made


def watch(domain, task, hidden, actions, path, task_kwargs=None):
    """Plays with this hidden property beside the viewer; returns the stream's rows by entity, and the episode."""
    task_kwargs = task_kwargs or {}

    def make_task(**chosen):
        return task_with(domain, task, hidden, task_kwargs)

    class File:
        def show(self, stream, layout):
            self.stream = stream
            stream.save(path, default_blueprint=layout)

        def flush(self, stream):
            stream.flush()

    environment, screen = suite.Environment(make_task()), File()
    recorder = replay.EpisodeRecorder(environment, domain, task, task_kwargs, agent="you", make_task=make_task)
    observers = [recorder, live.Live(recorder, screen)]
    timestep = environment.reset()
    for observer in observers:
        observer.observe_first(environment, timestep)
    for action in actions:
        timestep = environment.step(action)
        for observer in observers:
            observer.observe(environment, timestep, action)
    screen.stream.disconnect()
    episode = recorder.episode
    recorder.close()
    environment.close()
    return contents(path), episode


def contents(path):
    """The rows of a file by entity, without the time at which they were made."""
    rows = {}
    for chunk in RrdReader(str(path)).stream():
        entity, batch = str(chunk.entity_path), chunk.to_record_batch()
        if not entity.startswith("/__properties"):
            columns = batch.to_pydict()
            rows.setdefault(entity, []).append({name: columns[name] for name in columns if not _is_of_the_file(name)})
    return rows


def _is_of_the_file(column):
    return column.startswith(("log_", "rerun"))


def some_hidden(task):
    """Some hidden properties; of several numbers, the last two are swapped in every other one."""
    hidden = task.draw(np.full(24, 5), np.arange(24))
    if hidden.ndim > 1:
        hidden[1::2] = hidden[::2]
        hidden[1::2, -2:] = hidden[::2, :-3:-1]
    return np.unique(hidden, axis=0)


def alike(environment, actions):
    """Pairs of hidden properties with other answers and equal observations after these actions."""
    task, seen = environment.task, {}
    hidden = some_hidden(task)
    answers = task.answers(hidden)
    for number, each in enumerate(hidden):
        task.next_episode = 0
        timesteps = [environment.reset(hidden=each), *map(environment.step, actions)]
        observed = b"".join(value.tobytes() for step in timesteps for value in step.observation.values())
        seen.setdefault(observed, []).append(number)
    pairs = itertools.chain(*(itertools.combinations(group, 2) for group in seen.values()))
    return [(hidden[first], hidden[second]) for first, second in pairs if answers[first] != answers[second]]


TASKS = [names for names in suite.ALL_TASKS if names[1].endswith("features")]
TASKS += [("towers", "direct_pixels"), ("threshold", "pixels")]


@pytest.mark.parametrize(("domain", "task"), TASKS, ids=["/".join(names) for names in TASKS])
def test_equal_observations_look_alike_until_the_answer(domain, task, tmp_path):
    environment = suite.load(domain, task, task_kwargs={"random": 0})
    last, generator = environment.task.num_interactions - 1, np.random.default_rng(3)
    for actions in ([], [0], [last, 0, last], generator.integers(last + 1, size=3).tolist()):
        pairs = alike(environment, actions)
        assert pairs or actions  # At the start all look alike.
        for pair in pairs[-1:]:
            rows, episodes = zip(
                *(watch(domain, task, hidden, actions, tmp_path / "one.rrd") for hidden in pair), strict=True
            )
            assert rows[0] == rows[1]
            are_drawn = episodes[0].shapes.are_drawn  # In moving pictures, which are drawn in single precision too.
            for film in ("positions", "rotations"):
                first, second = (getattr(each, film)[:, are_drawn].astype(np.float32) for each in episodes)
                np.testing.assert_array_equal(first, second)
    environment.close()


def test_blocks_move_by_the_clock_from_one_noisy_reading_to_the_next(tmp_path):
    _, episode = watch("which_is_heavier", "features", [0.1, 0.5, 0.2, 0.3], [0, 0], tmp_path / "x", {"noise": 0.01})
    heights = episode.observations["heights"].astype(float)
    assert (heights[0] != 0).all()  # Noise.
    # A control step has four physics steps. A share s of the way has passed after 3 s^2 - 2 s^3 of the time.
    shares = np.array([0, 0.15625, 0.5, 0.84375])[:, None]
    expected = [before + shares * (after - before) for before, after in itertools.pairwise(heights)]
    shown = episode.positions[:, [episode.shapes.names.index(f"block_{k}") for k in range(4)], 2]
    np.testing.assert_allclose(shown, 0.05 + np.concatenate([*expected, heights[-1:]]), atol=1e-12)


def test_arrows_do_not_tell_the_varying_strength_of_an_action(tmp_path):
    lengths = []
    for number in range(2):
        path = tmp_path / f"{number}.rrd"
        environment = suite.load("which_is_heavier", "features", task_kwargs={"random": number, "variation": 1.0})
        recorder = replay.EpisodeRecorder(environment, "which_is_heavier", "features", {"variation": 1.0})
        recorder.observe_first(environment, environment.reset())
        recorder.observe(environment, environment.step(0), 0)
        writing.write(path, [lambda recorder=recorder: [recorder.episode]])
        (vector,) = contents(path)["/world/things/action"][0]["Arrows3D:vectors"][1]
        lengths.append(np.linalg.norm(vector))
        recorder.close()
        environment.close()
    assert lengths[0] == lengths[1] > 0


def test_no_time_tells_the_hidden_length_of_control_steps(tmp_path):
    lengths, shown = set(), set()
    for seed in (1, 2):
        options = {"random": seed, "control_timestep": 0.12, "step_variation": 0.3}
        environment = suite.load("threshold", "features", task_kwargs=options)
        environment.reset()
        lengths.add(environment.control_timestep())
        environment.close()
        hidden = environment.task.draw(np.array([0]), np.array([0]))[0]
        rows, episode = watch("threshold", "features", hidden, [2, 3], tmp_path / f"{seed}.rrd", options)
        seen = [row for name in sorted(rows) if name.startswith("/seen/") for row in rows[name]]
        readings = [row["time"] for row in seen if "time" in row]
        shown.add((str(readings), episode.times[episode.num_played].round(9)))
    assert len(lengths) == 2
    assert len(shown) == 1
    np.testing.assert_allclose([end for _, end in shown], 2 * 0.12)
