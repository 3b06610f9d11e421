"""The experiments: every one of the paper, and those that it could not make."""

from physexp.analysis.experiments import (
    ideal_gap,
    individual,
    learners,
    learning_heavier,
    learning_towers,
    mass_gap,
    population,
    random_heavier,
    random_towers,
    waiting,
)
from physexp.analysis.experiments.base import Experiment

__all__ = ["EXPERIMENTS", "Experiment"]

_MODULES = (
    mass_gap,
    learning_heavier,
    population,
    individual,
    random_heavier,
    learning_towers,
    waiting,
    random_towers,
    ideal_gap,
    learners,
)

EXPERIMENTS = {module.EXPERIMENT.name: module.EXPERIMENT for module in _MODULES}
"""All experiments by name, in the paper's order."""
