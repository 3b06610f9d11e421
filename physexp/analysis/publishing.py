"""Publishing: turns a run's agent into one that comes with the package, with a card that says where it comes from."""

import dataclasses
import json
from pathlib import Path

import numpy as np

from physexp.agents import agent as agent_lib
from physexp.agents import pretrained
from physexp.analysis import config as config_lib
from physexp.analysis import evaluation, training
from physexp.analysis import run as run_lib


def publish(run: run_lib.Run, folder: Path, num_episodes: int) -> Path:
    """Evaluates a run's agent as it will be kept, in half precision, and writes it and its card; returns the card.

    Args:
      run: a run with a checkpoint.
      folder: where the agent goes.
      num_episodes: how many episodes the evaluation plays.
    """
    config = run.config
    network = pretrained.halved(evaluation.load_network(run))
    created = json.loads((run.path / "config.json").read_text())
    last = run.metrics()[-1]
    figures = {
        way: evaluation.play(network, config, num_episodes, greedy=way == "greedy").summary(config.agent.discount)
        for way in ("drawn", "greedy")
    }
    environment = training.make_environment(config, 0, 1, 1)
    specs = environment.observation_spec().items()
    card = {
        "domain": config.domain,
        "task": config.task,
        "difficulty": config.difficulty,
        "command": command(config),
        "commit": created.get("commit", "not recorded"),
        "versions": created["versions"],
        "renderer": created.get("renderer", "not recorded"),
        "seed": config.agent.seed,
        "frames": int(last["frames"]),
        "seconds": round(last["seconds"]),
        "evaluation": {"seed": evaluation.SEED, **figures},
        "agent": config.to_json()["agent"],
        "network": {
            "observations": {name: (spec.shape, np.dtype(spec.dtype).name) for name, spec in specs},
            "num_actions": environment.action_spec().num_values,
            "hyperparameters": agent_lib.hyperparameters(config.agent),
        },
    }
    environment.close()
    return pretrained.save(network.cpu(), card, folder)


def command(config: config_lib.TrainConfig) -> str:
    """The command that trains such a run: what differs from the task's preset is spelled out."""
    words = ["physexp", "train", config.domain, config.task]
    for name, value in config.task_kwargs.items():
        words += [f"--{name.replace('_', '-')}", f"{value:g}"]
    preset = dataclasses.asdict(config_lib.preset(config.domain, config.task, algorithm=config.agent.algorithm))
    if config.agent.algorithm != config_lib.preset().algorithm:
        words += ["--agent", config.agent.algorithm]
    for name, value in dataclasses.asdict(config.agent).items():
        if value != preset[name]:
            words += _flag(name, value)
    return " ".join(words)


def _flag(name: str, value) -> list[str]:
    flag = name.replace("_", "-")
    if isinstance(value, bool):
        return [f"--{flag}" if value else f"--no-{flag}"]
    return [f"--{flag}", *(str(item) for item in (value if isinstance(value, (list, tuple)) else [value]))]
