"""A configuration survives the trip through a run's folder; every task has a preset."""

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


def make_config(**changes):
    agent = a3c.A3CConfig(frames=5, seed=2**62, discount=0.1 + 0.2)
    fields = {"domain": "which_is_heavier", "task": "features", "task_kwargs": {"difficulty": 3.3}, "agent": agent}
    return config_lib.TrainConfig(**{**fields, **changes})


@pytest.mark.parametrize(
    "changes",
    [
        {"task_kwargs": {"control_timestep": 0.05, "blocks": 3, "colour": "red"}},
        {"task_kwargs": {"difficulty": np.float32(3.5), "blocks": np.int64(3)}, "replay_every": np.int64(5)},
        {"also": ({"difficulty": np.float64(5)}, {"difficulty": 10.0, "noise": 0.01})},
    ],
)
def test_a_configuration_survives_json(changes):
    config = make_config(**changes)
    assert config_lib.TrainConfig.from_json(json.loads(json.dumps(config.to_json()))) == config


def test_equal_configurations_have_one_hash_and_one_name():
    one, other = (make_config(task_kwargs=dict(pairs)) for pairs in ([("b", 2), ("a", 0.5)], [("a", 0.5), ("b", 2.0)]))
    assert one == other and len({one, other}) == 1
    assert one.name == other.name == f"which_is_heavier-features-a0.5-b2-discount0.3-seed{2**62}"
    one, other = (make_config(task_kwargs={"a": a}) for a in (3.0, 3.0000001))
    assert one != other and "-a3-" in one.name and "-a3.0000001-" in other.name


@pytest.mark.parametrize("wrong", [3, {"difficulty": None}, {"difficulty": [3]}, {3: 3}])
def test_options_that_json_cannot_hold_are_refused(wrong):
    with pytest.raises(ValueError, match="task_kwargs"):
        make_config(task_kwargs=wrong)


def test_every_preset_is_of_its_algorithm_and_has_the_domains_discount():
    for domain, task in suite.ALL_TASKS:
        for algorithm in config_lib.ALGORITHMS:
            preset = config_lib.preset(domain, task, algorithm=algorithm)
            assert preset.algorithm == algorithm, (domain, task)
            assert preset.discount == suite.load_task(domain, task).discount, (domain, task)


def test_a_task_has_its_own_preset_or_the_algorithms_defaults():
    fist = config_lib.preset("towers", "fist_features", algorithm="ppo")
    assert fist == domains.find("towers").presets["fist_features"]["ppo"].replace(discount=0.98)
    assert fist != config_lib.ALGORITHMS["ppo"](discount=0.98)
    assert config_lib.preset("towers", "feet", algorithm="a3c") == a3c.A3CConfig(discount=0.98)
    assert config_lib.preset() == belief.BeliefConfig()


@pytest.mark.parametrize("kind", ["features", "pixels"])
def test_the_belief_learner_has_one_configuration_for_all_tasks_of_a_kind(kind):
    presets = [config_lib.preset(*names, algorithm="belief") for names in suite.tagged(kind)]
    assert len({preset.replace(discount=0.5) for preset in presets}) == 1


def test_a_condition_has_the_papers_label_or_the_names_of_domain_and_task():
    assert make_config(task_kwargs={"difficulty": 10.0}).label == "10-F"
    assert make_config(domain="towers", task="fist_pixels", task_kwargs={}).label == "F-P"
    assert make_config(domain="threshold", task_kwargs={}).label == "threshold features"


def test_domains_import_nothing_heavy():
    script = "import sys; from physexp.analysis import domains; print({'scipy', 'torch', 'mujoco'} & set(sys.modules))"
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert done.stdout == "set()\n"
