"""What a run is told survives the trip through its folder; every task has a preset."""

import json
import subprocess
import sys

import numpy as np
import pytest

from physexp import suite
from physexp.agents.a3c import config as a3c
from physexp.agents.belief import config as belief
from physexp.analysis import domains
from physexp.analysis.training import config as config_lib
from physexp.analysis.training import run as run_lib


def make_config(**changes):
    agent = a3c.A3CConfig(frames=5, seed=2**62, discount=0.1 + 0.2)
    fields = {"domain": "which_is_heavier", "task": "features", "task_kwargs": {"difficulty": 3.3}, "agent": agent}
    return config_lib.TrainConfig(**{**fields, **changes})


@pytest.mark.parametrize(
    "changes",
    [
        {},
        {"task_kwargs": {"control_timestep": 0.05, "blocks": 3, "colour": "red"}},
        {"task_kwargs": {"difficulty": np.float32(3.5), "blocks": np.int64(3)}, "replay_every": np.int64(5)},
    ],
)
def test_a_configuration_survives_json(changes):
    config = make_config(**changes)
    assert config_lib.TrainConfig.from_json(json.loads(json.dumps(config.to_json()))) == config


@pytest.mark.parametrize(
    ("stored", "task_kwargs"),
    [
        ({"difficulty": 3.3, "control_timestep": None}, {"difficulty": 3.3}),
        ({"difficulty": None, "control_timestep": 0.05}, {"control_timestep": 0.05}),
        ({"difficulty": None}, {}),
    ],
)
def test_a_configuration_of_an_earlier_version_is_read(stored, task_kwargs):
    fields = make_config(task_kwargs={}).to_json()
    del fields["task_kwargs"]
    assert config_lib.TrainConfig.from_json({**fields, **stored}) == make_config(task_kwargs=task_kwargs)


def test_equal_configurations_have_one_hash_and_one_name_whatever_the_order_of_their_options():
    one, other = (make_config(task_kwargs=dict(pairs)) for pairs in ([("b", 2), ("a", 0.5)], [("a", 0.5), ("b", 2.0)]))
    assert one == other and len({one, other}) == 1
    assert one.name == other.name == f"which_is_heavier-features-a0.5-b2-discount0.3-seed{2**62}"
    assert one != make_config(task_kwargs={"a": 0.5})


def test_options_that_differ_in_the_last_digit_make_other_names():
    one, other = (make_config(task_kwargs={"a": a}) for a in (3.0, 3.0000001))
    assert "-a3-" in one.name and "-a3.0000001-" in other.name


@pytest.mark.parametrize("wrong", [3, {"difficulty": None}, {"difficulty": [3]}, {3: 3}])
def test_options_that_json_or_a_name_could_not_keep_are_refused(wrong):
    with pytest.raises(ValueError, match="task_kwargs"):
        make_config(task_kwargs=wrong)


@pytest.mark.parametrize("algorithm", config_lib.ALGORITHMS)
@pytest.mark.parametrize("names", suite.ALL_TASKS, ids=["/".join(names) for names in suite.ALL_TASKS])
def test_a_preset_is_of_the_algorithm_and_has_its_domain_s_discount(names, algorithm):
    preset = config_lib.preset(*names, algorithm=algorithm)
    assert preset.algorithm == algorithm and preset.discount == suite.load_task(*names).discount


def test_a_task_with_a_preset_of_its_own_has_that_and_another_one_the_defaults():
    fist = config_lib.preset("towers", "fist_features", algorithm="ppo")
    preset = domains.find("towers").presets["fist_features"]["ppo"]
    assert fist == preset.replace(discount=0.98) and fist.initial_logits
    defaults = config_lib.preset("threshold", "features", algorithm="belief")
    assert "belief" not in domains.find("threshold").presets.get("features", {})
    assert defaults.replace(discount=0.9) == config_lib.ALGORITHMS["belief"](discount=0.9)


@pytest.mark.parametrize("kind", ["features", "pixels"])
def test_the_belief_learner_has_one_configuration_for_all_tasks_of_a_kind(kind):
    presets = [config_lib.preset(*names, algorithm="belief") for names in suite.tagged(kind)]
    assert len({preset.replace(discount=0.5) for preset in presets}) == 1


def test_no_preset_is_of_a_task_that_there_is_not():
    for name, domain in domains.DOMAINS.items():
        assert domain.name == name and set(domain.presets) <= set(suite.TASKS_BY_DOMAIN[name])
        assert set(domain.labels) in (set(), set(suite.TASKS_BY_DOMAIN[name]))


def test_without_a_preset_an_agent_has_its_defaults_at_the_domain_s_discount():
    assert config_lib.preset("towers", "feet", algorithm="a3c") == a3c.A3CConfig(discount=0.98)
    assert config_lib.preset() == belief.BeliefConfig()


def test_a_condition_has_the_paper_s_name_or_else_those_of_domain_and_task():
    assert make_config(task_kwargs={"difficulty": 10.0}).label == "10-F"
    assert make_config(domain="towers", task="fist_pixels", task_kwargs={}).label == "F-P"
    assert make_config(domain="threshold", task_kwargs={}).label == "threshold features"
    assert make_config(task_kwargs={}).label == "which_is_heavier features"  # The task's own difficulty is not said.


def test_domains_are_light_since_the_command_line_is_made_from_them():
    script = "import sys; from physexp.analysis import domains; print({'scipy', 'torch', 'mujoco'} & set(sys.modules))"
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert done.stdout == "set()\n"


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
