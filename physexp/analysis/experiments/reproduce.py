"""Reproducing the paper: trains the agents of experiments, lets them play, draws the figures and tests the claims."""

from collections.abc import Sequence

from physexp.agents import processes
from physexp.analysis.data import plots
from physexp.analysis.experiments import EXPERIMENTS, base, claims, conditions, pools, sweep
from physexp.analysis.training import callbacks

ALL = "all"


def choose(name: str) -> list[base.Experiment]:
    """Returns the experiments that a name stands for.

    Raises:
      ValueError: for an unknown name.
    """
    if name == ALL:
        return list(EXPERIMENTS.values())
    if name not in EXPERIMENTS:
        raise ValueError(f"experiment is {name!r}; choose from {', '.join([ALL, *EXPERIMENTS])}")
    return [EXPERIMENTS[name]]


def run(
    experiments: Sequence[base.Experiment],
    results: base.Results,
    *,
    observations: Sequence[str],
    num_seeds: int | None = None,
    num_processes: int | None = None,
    frames: int | None = None,
    cluster: str | None = None,
    tell: callbacks.Tell,
) -> None:
    """Does everything for some experiments that is not done yet.

    Agents with some kinds of observations are trained: in each condition `num_seeds`, by default `conditions.SEEDS`,
    for as many environment steps as its budget, or `frames` in a rehearsal; so many at a time as the machine has cores,
    or `num_processes`, or on the Ray cluster of an address.

    Raises:
      ValueError: for numbers out of range, a cluster that cannot be joined, or a folder with other runs.
      RuntimeError: if some agents could not be trained.
    """
    for name, value, most in (("seeds", num_seeds, 1_000), ("jobs", num_processes, 1_000), ("frames", frames, 10**12)):
        if value is not None and not 1 <= value <= most:
            raise ValueError(f"{name} is {value}; give an integer >= 1 and <= {most}")
    jobs = sweep.jobs(experiments, observations, lambda kind: num_seeds or conditions.SEEDS[kind], frames)
    with pools.opened(num_processes, cluster) as pool:
        sweep.run(jobs, results, pool, num_processes or processes.num_cores(), tell)
    for experiment in experiments:
        if experiment.prepare is not None:
            experiment.prepare(results, tell)
        frame = experiment.load(results)
        tell(str(plots.save(experiment.figure(frame), results.path / "figures", experiment.name)))
        found = experiment.test(frame)
        for claim, verdict in zip(found, claims.corrected(found), strict=True):
            estimate = claim.estimate
            tell(
                f"{verdict:9}  {claim.text} ({claim.condition}): {estimate.value:.3g}, 95 % interval "
                f"{estimate.low:.3g} to {estimate.high:.3g}, wanted {claim.wanted}"
            )
