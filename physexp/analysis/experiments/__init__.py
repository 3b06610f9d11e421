"""The experiments: all of the paper's, and ours."""

import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from physexp.analysis.experiments.base import Experiment

    EXPERIMENTS: dict[str, Experiment]

__all__ = ["EXPERIMENTS", "NAMES", "Experiment"]

_MODULES = {
    "mass_gap": "mass_gaps",
    "learning_heavier": "learning",
    "population": "interactions",
    "individual": "mass_gaps",
    "patience": "interactions",
    "random_heavier": "interactions",
    "learning_towers": "learning",
    "waiting": "control_steps",
    "random_towers": "interactions",
    "ideal_gap": "ideal_gap",
    "learners": "learning",
    "workers": "learning",
    "data_efficiency": "efficiency",
    "reaching": "efficiency",
    "ablations": "efficiency",
    "generalization": "generalization",
    "timing": "control_steps",
    "noise": "mass_gaps",
    "weighing": "strategies",
    "clamping": "strategies",
    "shaking": "strategies",
    "aiming": "strategies",
    "crushing": "strategies",
    "pressing": "strategies",
    "laboratory": "laboratory",
    "few": "few",
}
"""The module whose `EXPERIMENTS` contain an experiment, in the paper's order."""

NAMES = tuple(_MODULES)


def __getattr__(name: str) -> Any:
    """Imports the experiments at their first use: that takes seconds, and the command line's help needs only names."""
    if name != "EXPERIMENTS":
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    modules = {module: importlib.import_module(f"{__name__}.{module}") for module in dict.fromkeys(_MODULES.values())}
    found = {name: modules[module].EXPERIMENTS[name] for name, module in _MODULES.items()}
    globals()["EXPERIMENTS"] = found
    return found
