"""Before the answer a replay shows nothing that observations and actions do not tell."""

import itertools

import numpy as np
import pytest
import recordings

from physexp import suite


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
            paths = tmp_path / "first.rrd", tmp_path / "second.rrd"
            films = [recordings.play(domain, task, actions, *each) for each in zip(paths, pair, strict=True)]
            assert recordings.contents(paths[0]) == recordings.contents(paths[1])
            are_drawn = films[0].shapes.are_drawn  # In moving pictures, which are drawn in single precision too.
            for poses in ("positions", "rotations"):
                first, second = (getattr(each, poses)[:, are_drawn].astype(np.float32) for each in films)
                np.testing.assert_array_equal(first, second)
    environment.close()


def test_blocks_move_by_the_clock_from_one_noisy_reading_to_the_next():
    film = recordings.play("which_is_heavier", "features", [0, 0], hidden=[0.1, 0.5, 0.2, 0.3], noise=0.01)
    heights = film.observations["heights"].astype(float)
    assert (heights[0] != 0).all()  # Noise.
    # A control step has four physics steps. A share s of the way has passed after 3 s^2 - 2 s^3 of the time.
    shares = np.array([0, 0.15625, 0.5, 0.84375])[:, None]
    expected = [before + shares * (after - before) for before, after in itertools.pairwise(heights)]
    shown = film.positions[:, [film.shapes.names.index(f"block_{k}") for k in range(4)], 2]
    np.testing.assert_allclose(shown, 0.05 + np.concatenate([*expected, heights[-1:]]), atol=1e-12)


def test_arrows_do_not_tell_the_varying_strength_of_an_action(tmp_path):
    lengths = []
    for seed in range(2):
        film = recordings.play("which_is_heavier", "features", [0], random=seed, variation=1.0)
        (vector,) = recordings.written(tmp_path / "one.rrd", film)["/world/things/action"]["Arrows3D:vectors"][1]
        lengths.append(np.linalg.norm(vector))
    assert lengths[0] == lengths[1] > 0


def test_no_time_tells_the_hidden_length_of_control_steps(tmp_path):
    lengths, shown = set(), set()
    for seed in (1, 2):
        options = {"random": seed, "control_timestep": 0.12, "step_variation": 0.3}
        film = recordings.play("threshold", "features", [2, 3], tmp_path / "one.rrd", **options)
        lengths.add(film.declared.control_timestep)
        rows = recordings.contents(tmp_path / "one.rrd")
        readings = [rows[name]["time"] for name in sorted(rows) if name.startswith("/seen/")]
        shown.add((str(readings), film.times[film.num_played].round(9)))
    assert len(lengths) == 2
    assert len(shown) == 1
    np.testing.assert_allclose([end for _, end in shown], 2 * 0.12)
