"""The returns of the agents of the paper's learning curves from features, and the time that they, a report and an ideal
experimenter take.
"""

from collections.abc import Iterator
from pathlib import Path
import sys

from physexp.analysis.bench import measuring
from physexp.analysis.experiments import base, conditions, ideal_gap, sweep
from physexp.analysis.training import records

RETURN = {3.0: 0.79, 5.0: 0.83, 10.0: 0.86}  # Mean discounted return in the median of the better half of the agents.
SUCCESS = {"fist_features": 0.98, "direct_features": 0.95}  # Share of right answers, in the same.
HOURS = 12.0  # For all of these agents, as many at a time.
_NUM_PROCESSES = 2


def figures(results_dir: Path) -> Iterator[dict]:
    """Trains the agents that are missing, reads what all of them reached, and takes the time of the rest."""
    results = base.Results(results_dir)
    features = sweep.jobs([ideal_gap.EXPERIMENT], ["features"], conditions.SEEDS.__getitem__)
    sweep.run(features, results, _NUM_PROCESSES, lambda line: print(line, file=sys.stderr, flush=True))
    for condition in ideal_gap.CONDITIONS:
        if conditions.observations(condition) == "features":
            yield from _reached(results, condition)
    seconds = [results.run(job.config).metrics()[-1]["seconds"] for job in features]
    yield measuring.row(
        "training the agents of the learning curves from features, two at a time",
        sum(seconds) / _NUM_PROCESSES / 3600,
        "h",
        HOURS,
        at_most=True,
        agents=len(seconds),
    )
    yield measuring.timed("physexp report from stored data", ["report", "--results-dir", str(results_dir)], 60)
    domain, _ = measuring.REFERENCE
    yield measuring.timed(f"physexp ideal {domain}", ["ideal", domain], 20)


def _reached(results: base.Results, condition) -> Iterator[dict]:
    frame = results.episodes([base.EVALUATION], [condition], ["reward", "length"])
    agents = frame.assign(agent_return=records.discounted_return(frame), right=frame.reward > 0).groupby(
        "training_seed"
    )
    returns, success = agents.agent_return.mean().to_numpy(), agents.right.mean().to_numpy()
    absolute = {
        "agents": len(returns),
        "worst_return": returns.min(),
        "best_return": returns.max(),
        "right": success.mean(),
        "million_frames": condition.agent.frames / 1e6,
    }
    reached = ideal_gap.median_of_top_half
    name = frame.condition.iloc[0]
    if condition.task in SUCCESS:
        yield measuring.row(f"right answers: {name}", reached(success), "", SUCCESS[condition.task], **absolute)
        return
    difficulty = condition.task_kwargs["difficulty"]
    best = conditions.ideal(condition).value
    yield measuring.row(f"return: {name}", reached(returns), "", RETURN[difficulty], **absolute)
    yield measuring.row(
        f"return / ideal experimenter's: {name}",
        reached(returns) / best,
        "x",
        ideal_gap.LEAST[difficulty],
        ideal=best,
    )
