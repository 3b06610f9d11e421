"""Publishing: writes a run's agent into one file with a card of its provenance."""

from pathlib import Path
from typing import Any

from physexp import suite
from physexp.agents import pretrained
from physexp.analysis.training import config as config_lib
from physexp.analysis.training import finding, playing
from physexp.analysis.training import run as run_lib


def publish(run: run_lib.Run, folder: Path, num_episodes: int, replaces: bool = False) -> Path:
    """Evaluates a run's agent as it will be kept, in half precision, and writes it with its card; returns the path.

    Raises FileExistsError if the folder has such an agent that this one does not replace, and ValueError if the run's
    files are damaged or say too little. Nothing is written then.
    """
    config, created = run.config, {"versions": "not recorded", "renderer": "not recorded", **run.facts}
    name = pretrained.name(config.domain, config.task, config.task_kwargs)
    if name in pretrained.names(folder) and not replaces:
        raise FileExistsError(
            f"{folder / name}.safetensors is an agent already; give --replace to put this one in its place, or "
            "another --output-dir"
        )
    trained = finding.provenance(run)
    network = pretrained.halve(finding.load_network(run))  # Refuses weights that cannot be kept.
    figures = {
        way: playing.play(network, config, num_episodes, greedy=way == "greedy").summary(config.agent.discount)
        for way in ("drawn", "greedy")
    }
    card = {
        "domain": config.domain,
        "task": config.task,
        "task_kwargs": dict(config.task_kwargs),
        **({"also": config.also} if config.also else {}),
        "default": is_default(config),
        **trained,
        "versions": created["versions"],
        "renderer": created["renderer"],
        "seed": config.agent.seed,
        "evaluation": {"seed": playing.SEED, **figures},
        "agent": config.to_json()["agent"],
        "network": finding.network_facts(config),
    }
    return pretrained.save(network.cpu(), card, folder)


def is_default(config: config_lib.TrainConfig) -> bool:
    """Returns whether an agent plays the task as it is where no option is chosen."""
    options: Any = suite.options(config.domain)
    return options(**{**config.task_kwargs, "random": 0}) == options(random=0)
