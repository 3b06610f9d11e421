"""The experiments: all of the paper's, and ours."""

import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from physexp.analysis.experiments.base import Experiment

    EXPERIMENTS: dict[str, Experiment]

__all__ = ["EXPERIMENTS", "NAMES", "Experiment"]

NAMES = (
    "mass_gap",
    "learning_heavier",
    "population",
    "individual",
    "patience",
    "random_heavier",
    "learning_towers",
    "waiting",
    "random_towers",
    "ideal_gap",
    "learners",
    "data_efficiency",
    "reaching",
    "ablations",
    "generalization",
    "timing",
    "noise",
    "weighing",
    "clamping",
    "shaking",
    "aiming",
    "laboratory",
)
"""The experiments in the paper's order; each is the `EXPERIMENT` of the module of its name."""


def __getattr__(name: str) -> Any:
    """Imports an experiment when it is used: the command line's help needs only names, and imports take seconds."""
    if name != "EXPERIMENTS":
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    found = {name: importlib.import_module(f"{__name__}.{name}").EXPERIMENT for name in NAMES}
    globals()["EXPERIMENTS"] = found
    return found
