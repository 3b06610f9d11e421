"""Control steps that differ among episodes: drawn from a range, and the same in all steps of an episode."""

from chance import P_VALUE
import numpy as np
import pytest
from scipy import stats

from physexp import suite
from physexp.analysis import replay

TOWER = ("towers", "fist_features")


def test_control_steps_are_drawn_from_their_range(seed):
    options = suite.load_task(*TOWER, {"random": seed, "step_variation": 0.5}).options
    episodes, seeds = np.arange(20_000), np.full(20_000, seed)
    found = options.draw_substeps(seeds, episodes)
    lengths, counts = np.unique(found, return_counts=True)
    assert lengths.tolist() == list(range(10, 31))  # 0.05 to 0.15 s in steps of 5 ms.
    assert stats.chisquare(counts).pvalue > P_VALUE


def test_all_control_steps_of_an_episode_are_equally_long(seed):
    environment = suite.load(*TOWER, {"random": seed, "step_variation": 0.5})
    lengths = set()
    for _ in range(6):
        environment.reset()
        lengths.add(environment.control_timestep())
        for step in range(1, 5):
            environment.step(1)
            assert environment.physics.time() == pytest.approx(step * environment.control_timestep())
    assert len(lengths) > 1 and all(0.05 <= length <= 0.15 + 1e-9 for length in lengths)


def test_a_replay_shows_control_steps_of_the_task_s_length(seed):
    """An agent does not observe the length of an episode's control steps, so no clock may show it."""
    options = {"step_variation": 0.5}
    environment = suite.load(*TOWER, {"random": seed, **options})
    recorder = replay.EpisodeRecorder(*TOWER, options)
    recorder.observe_first(environment, environment.reset())
    lasts = environment.task.options.control_timestep
    for action in (0, 1, 4):
        recorder.observe(environment, environment.step(action), action)
    assert recorder.episode.control_timestep == lasts
    assert recorder.episode.times[-1] == pytest.approx(2 * lasts)  # An answer takes no time.


@pytest.mark.parametrize(("domain", "value", "least"), [("which_is_heavier", 0.2, 0.25), ("towers", 0.04, 0.05)])
def test_a_share_that_is_less_than_a_physics_step_is_refused(domain, value, least):
    task = suite.TASKS_BY_DOMAIN[domain][0]
    with pytest.raises(
        ValueError, match=f"^step_variation is {value} of .* than a physics step, .*; give 0, or at least {least}$"
    ):
        suite.load(domain, task, {"step_variation": value})
    assert suite.load_task(domain, task, {"step_variation": least}).options.step_variation == least
    with pytest.raises(ValueError, match="give 0, or at least 0.334$"):  # A third of three steps, rounded up.
        suite.load("towers", "direct_features", {"control_timestep": 0.015, "step_variation": 0.3})
    with pytest.raises(ValueError, match="less than a physics step, 0.005 s; give 0$"):
        suite.load("towers", "direct_features", {"control_timestep": 0.005, "step_variation": 0.9})


def test_a_range_with_steps_too_short_for_the_question_is_refused():
    suite.load("strings", "features", {"control_timestep": 0.2, "step_variation": 0.5}).close()
    with pytest.raises(ValueError, match=r"^step_variation is 0.6, with which control steps are as short as 0.08 s; "):
        suite.load("strings", "features", {"control_timestep": 0.2, "step_variation": 0.6})
