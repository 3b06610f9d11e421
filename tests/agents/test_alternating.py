"""Training that takes turns in several settings of a task."""

import numpy as np
from pyarrow import parquet
import pytest
import trainers

from physexp import suite
from physexp.analysis.training import config as config_lib
from physexp.analysis.training import finding, playing, publishing, trainer
from physexp.analysis.training import run as run_lib

SETTINGS = ({"difficulty": 3.0}, {"difficulty": 5.0}, {"difficulty": 10.0})


def make_config(*settings, **agent):
    first, *also = settings
    learner = trainers.SMALL["belief"].replace(**agent)
    task = {"domain": "which_is_heavier", "task": "features"}
    return config_lib.TrainConfig(**task, task_kwargs=first, also=tuple(also), agent=learner)


def test_each_round_is_the_same_as_in_its_own_setting():
    alternating = trainer.make_environment(make_config(*SETTINGS), seed=5, num_environments=4, num_threads=1)
    for number in (0, 1, 2, 4, 3):
        options = {**SETTINGS[number % 3], "random": 5}
        own = suite.load_batch("which_is_heavier", "features", 4, options, 1)
        own.reset(episode=number), alternating.reset(episode=number)
        assert (alternating.correct_answers == own.correct_answers).all(), number
        ours, theirs = (batch.step(np.arange(4), np.arange(4)).observation for batch in (alternating, own))
        assert all(np.array_equal(ours[name], theirs[name]) for name in theirs), number


def test_settings_that_one_network_cannot_play_are_refused():
    with pytest.raises(ValueError, match=r"^a setting has 6 interactions, 12 actions, .*the first one 4 inter"):
        trainer.make_environment(make_config({}, {"num_blocks": 6}), seed=0, num_environments=2, num_threads=1)


def test_an_agent_is_found_and_plays_in_each_setting_of_its_training(tmp_path):
    run = run_lib.Run(tmp_path / "run")
    trainer.train(run, start=make_config(*SETTINGS, frames=300))
    path = publishing.publish(run, tmp_path, num_episodes=10)
    for setting in SETTINGS:
        network, config, _ = finding.find_agent(str(path), setting)
        played = playing.play(network, config, 10)
        task = suite.load_task("which_is_heavier", "features", setting)
        assert config.task_kwargs == setting
        assert (played.hidden == task.draw(played.seed, played.episode)).all()
    with pytest.raises(ValueError, match="was trained at difficulty 3, and difficulty is 4; leave that out"):
        finding.find_agent(str(path), {"difficulty": 4})


def test_a_run_stores_episodes_of_its_first_setting(tmp_path):
    config = make_config(*SETTINGS, frames=3_000)
    run = run_lib.Run(tmp_path / "run")
    trainer.train(run, start=config)
    assert run.config == config and "difficulty3-also-difficulty5-also-difficulty10" in config.name
    task = suite.load_task("which_is_heavier", "features", SETTINGS[0])
    stored = parquet.read_table(run.path / "episodes.parquet").to_pydict()
    seeds, numbers, answers = (np.array(stored[name]) for name in ("seed", "episode", "answer"))
    assert len(answers) and (task.answers(task.draw(seeds, numbers)) == answers).all()
