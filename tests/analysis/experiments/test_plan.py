"""docs/plan.md says what every experiment trains, plays and wants, and the stored results are of nothing else."""

from pathlib import Path

import made_data
import numpy as np
import pytest

from physexp.analysis.experiments import EXPERIMENTS, conditions
from physexp.analysis.training import run as run_lib

ROOT = Path(__file__).parents[3]
PLAN = (ROOT / "docs" / "plan.md").read_text()
RUNS = ROOT / "results" / "runs"


def agents(experiment):
    """The rows of the plan that say whom an experiment trains."""
    return [
        f"| {config.name.removesuffix('-seed0')} | {config.agent.frames:,} | "
        f"0 to {conditions.SEEDS[conditions.observations(config)] - 1} |"
        for config in experiment.conditions
    ]


def claims(experiment):
    """The rows of the plan that say what an experiment wants; the claims are those of a made world."""
    found = experiment.claims(made_data.WORLDS[experiment.name]["paper"](2, np.random.default_rng(0)))
    tested = {}
    for one in found:
        wanted = f"{one.wanted}: “{one.words}”" if one.words else one.wanted
        row = (one.text, one.section, one.statistic, wanted + (", a sanity check" if one.is_sanity_check else ""))
        tested.setdefault(row, []).append(conditions.spelled_out(one.condition))
    return [
        f"| {text} | {section} | {'; '.join(tested_on)} | {statistic} | {wanted} |"
        for (text, section, statistic, wanted), tested_on in tested.items()
    ]


def section(name):
    """What the plan says of an experiment."""
    _, _, rest = PLAN.partition(f"\n## {name}\n")
    return rest.partition("\n## ")[0]


@pytest.mark.parametrize("name", EXPERIMENTS)
def test_the_plan_has_the_agents_and_the_claims_of_each_experiment_and_no_others(name):
    written = [line for line in section(name).splitlines() if line.startswith("| ")]
    headers = [line for line in written if line.startswith(("| agents |", "| claim |"))]
    assert [line for line in written if line not in headers] == [*agents(EXPERIMENTS[name]), *claims(EXPERIMENTS[name])]


def test_the_plan_has_every_experiment_once():
    assert [line.removeprefix("## ") for line in PLAN.splitlines() if line.startswith("## ")] == list(EXPERIMENTS)


def test_every_stored_run_is_of_the_plan():
    """Its configuration is that of a condition, and its seed is one of those that are reported."""
    planned = {one.name.removesuffix("0"): one for experiment in EXPERIMENTS.values() for one in experiment.conditions}
    stored = [run_lib.Run(path.parent).config for path in sorted(RUNS.glob("*/config.json"))]
    assert len(stored) > 400
    for config in stored:
        seed = config.agent.seed
        like = planned[config.name.removesuffix(str(seed))]
        assert like.agent.replace(seed=seed) == config.agent, config.name
        assert seed in range(conditions.SEEDS[conditions.observations(config)]), config.name
