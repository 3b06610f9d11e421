"""Every registered task, and the worked example of one that is not registered: what the contracts hold for."""

from pathlib import Path
import sys

import pytest

from physexp import suite

sys.path.insert(0, str(Path(__file__).parent.parent / "docs" / "examples"))

import bolted  # noqa: E402

_UNREGISTERED = {"bolted/features": bolted.features, "bolted/pixels": bolted.pixels}
NAMES = [*("/".join(names) for names in suite.ALL_TASKS), *_UNREGISTERED]
FEATURES = [name for name in NAMES if name.endswith("features")]

UNTRAINED = {("crush", "pixels")}
"""Tasks of which no agent has been trained yet."""

NOISY = ["which_is_heavier/features", "towers/direct_features", "towers/fist_features"]
VARYING = ["/".join(names) for names in suite.ALL_TASKS if suite.load_task(*names).num_nuisances]

every_task = pytest.mark.parametrize("name", NAMES)
every_feature_task = pytest.mark.parametrize("name", FEATURES)


def load_task(name, **task_kwargs):
    """Loads a task by `domain/task`."""
    if name in _UNREGISTERED:
        return _UNREGISTERED[name](**task_kwargs)
    return suite.load_task(*name.split("/"), task_kwargs)


def load(name, environment_kwargs=None, **task_kwargs) -> suite.Environment:
    """Loads one environment."""
    return suite.Environment(load_task(name, **task_kwargs), **(environment_kwargs or {}))


def load_batch(name, size, num_threads=1, **task_kwargs) -> suite.BatchEnvironment:
    """Loads a batch."""
    return suite.BatchEnvironment(load_task(name, **task_kwargs), size, num_threads)
