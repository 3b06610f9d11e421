"""What the default agents learn: trains the runs that are missing, evaluates them all."""

from collections.abc import Iterator
from pathlib import Path
import sys
from typing import Any

from physexp.analysis import bench, evaluation, progress, training
from physexp.analysis import config as config_lib
from physexp.analysis import run as run_lib

EPISODES = 10_000
SEEDS = (0, 1)  # All must reach the target; the towers, which take longer, are trained once.
# Mean discounted return to be reached at each difficulty; an ideal experimenter has 0.8385, 0.8692 and 0.8908.
HEAVIER = {3.0: 0.79, 5.0: 0.83, 10.0: 0.86}
TOWERS = {"fist_features": 0.98, "direct_features": 0.95}


def run(runs_dir: Path) -> Iterator[dict]:
    """Yields a figure for each condition: what all of its seeds reach."""
    for difficulty, target in HEAVIER.items():
        results = [_result(runs_dir, "which_is_heavier", "features", difficulty, seed) for seed in SEEDS]
        yield _figure(f"return: heavier, difficulty {difficulty:g}", "mean_return", results, target)
    for task, target in TOWERS.items():
        results = [_result(runs_dir, "towers", task, None, seed) for seed in SEEDS[:1]]
        yield _figure(f"right answers: towers/{task}", "success_rate", results, target)


def _figure(name: str, key: str, results: list[dict], target: float) -> dict:
    values = [result[key] for result in results]
    absolute: dict[str, Any] = {}
    for seed, result in zip(SEEDS, results, strict=False):  # Towers have fewer seeds.
        absolute |= {f"seed_{seed}": result[key], f"greedy_{seed}": result["greedy"][key]}
    absolute |= {"million_frames": results[0]["frames"] / 1e6, "minutes": results[0]["minutes"]}
    return bench.row(name, min(values), "", target, **absolute)


def _result(runs_dir: Path, domain: str, task: str, difficulty: float | None, seed: int) -> dict:
    """The figures of one run's evaluation; trains the run, or what is left of it, first."""
    agent = config_lib.preset(domain, task).replace(seed=seed)
    config = config_lib.TrainConfig(domain=domain, task=task, difficulty=difficulty, agent=agent)
    run = run_lib.Run(runs_dir / config.name)
    if not (run.path / "config.json").exists():
        run.create(config)
    if run.config != config:
        raise ValueError(f"{run.path} was made with another configuration; move it away")
    found = run.checkpointer.latest()
    if found is None or int(found[0]["frames"]) < agent.frames:
        print(f"training {config.name}", file=sys.stderr, flush=True)
        with progress.Progress(config) as display:
            training.train(run, display)
    last = run.metrics()[-1]
    figures = evaluation.evaluate(run, EPISODES).summary(agent.discount)
    greedy = evaluation.evaluate(run, EPISODES, greedy=True).summary(agent.discount)
    return {**figures, "greedy": greedy, "frames": last["frames"], "minutes": last["seconds"] / 60}
