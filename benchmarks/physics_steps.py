"""Measures how far readings are from those of a physics step that is ten times finer, in every task from features.

    python benchmarks/physics_steps.py

Solver parameters that depend on the step stay those of the task's own step. Readings that are 0 with both steps, such
as those of a thing that is hidden, are left out.
"""

from collections.abc import Mapping
from typing import Any

import numpy as np

from physexp import suite

EPISODES, FINER = 300, 10


def play(domain: str, task: str, task_kwargs: Mapping[str, Any], finer: int) -> dict[str, np.ndarray]:
    """Returns the readings after random interactions up to the last step, arrays [T, EPISODES, ...]."""
    batch = suite.load_batch(domain, task, EPISODES, {**task_kwargs, "random": 0}, num_threads=2)
    batch.task.root_entity.mjcf_model.option.timestep /= finer
    batch.reset()
    batch.ledger.substeps *= finer
    rng, shape = np.random.default_rng(0), (batch.task.rules.step_limit - 1, EPISODES)
    seen = [batch.step(actions).observation for actions in rng.integers(batch.num_interactions, size=shape)]
    return {name: np.array([each[name] for each in seen], float) for name in seen[0]}


def main() -> None:
    versions = ((*names, kwargs) for names in suite.tagged("features") for kwargs in suite.versions(names[0]))
    for domain, task, kwargs in versions:
        chosen = "".join(f",{name}={value}" for name, value in kwargs.items())
        usual, fine = (play(domain, task, kwargs, finer) for finer in (1, FINER))
        for name, readings in usual.items():
            away = np.abs(readings - fine[name])[(readings != 0) | (fine[name] != 0)]
            told = f"{np.mean(away > 0):.2%} differ, by {np.median(away):.2g} in the median, {away.max():.2g} at most"
            print(f"{domain}/{task}{chosen} {name}: {told}", flush=True)


if __name__ == "__main__":
    main()
