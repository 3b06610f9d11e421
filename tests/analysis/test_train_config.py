"""What a run is told survives the trip through its folder; every task has a preset."""

import json

import pytest

from physexp import suite
from physexp.agents.a3c import config as a3c
from physexp.analysis.training import config as config_lib
from physexp.analysis.training import run as run_lib


def make_config(**changes):
    agent = a3c.A3CConfig(frames=5, seed=2**62, discount=0.1 + 0.2)
    fields = {"domain": "which_is_heavier", "task": "features", "difficulty": 3.3, "agent": agent}
    return config_lib.TrainConfig(**{**fields, **changes})


@pytest.mark.parametrize("changes", [{}, {"difficulty": None, "control_timestep": 0.05}])
def test_a_configuration_survives_json(changes):
    config = make_config(**changes)
    assert config_lib.TrainConfig.from_json(json.loads(json.dumps(config.to_json()))) == config


@pytest.mark.parametrize("names", suite.ALL_TASKS)
def test_every_task_has_a_preset_and_no_other_does(names):
    assert config_lib.preset(*names) is config_lib.A3C[names]
    assert config_lib.preset(*names, algorithm="ppo") is config_lib.PPO[names]
    assert set(config_lib.A3C) == set(config_lib.PPO) == set(suite.ALL_TASKS)


def test_only_what_was_chosen_reaches_the_task():
    assert make_config().task_kwargs == {"difficulty": 3.3}
    assert make_config(difficulty=None, control_timestep=0.05).task_kwargs == {"control_timestep": 0.05}


def test_a_run_keeps_its_configuration_and_the_versions(tmp_path):
    run = run_lib.Run(tmp_path / "deep" / "run")
    with pytest.raises(ValueError, match="holds no run"):
        _ = run.config
    run.create(make_config())
    assert run_lib.Run(run.path).config == make_config()
    content = json.loads((run.path / "config.json").read_text())
    assert {"python", "physexp", "mujoco", "dm-control", "torch", "numpy"} <= set(content["versions"])
    assert content["train"]["agent"]["seed"] == 2**62


def test_a_run_of_another_format_is_refused_by_number(tmp_path):
    run = run_lib.Run(tmp_path)
    run.create(make_config())
    path = tmp_path / "config.json"
    path.write_text(json.dumps({**json.loads(path.read_text()), "format": 99}))
    with pytest.raises(ValueError, match="has format 99; this version reads format 1"):
        _ = run.config
