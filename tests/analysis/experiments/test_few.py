"""The share of targets that are reached in few steps."""

import numpy as np
import pandas

from physexp.analysis.experiments import few


def test_tasks_count_alike_however_many_agents_they_have():
    rows = [
        ("one agent", 0, 0.5, 10.0),
        ("one agent", 0, 0.9, np.inf),
        ("two agents", 0, 0.5, 20.0),
        ("two agents", 0, 0.9, 40.0),
        ("two agents", 1, 0.5, 30.0),
        ("two agents", 1, 0.9, np.inf),
    ]
    steps, shares = few.shares(pandas.DataFrame(rows, columns=["condition", "training_seed", "target", "steps"]))
    # Four pairs of a task and a target: the first is reached by the only agent, the others by halves or not.
    np.testing.assert_allclose(steps, [10, 20, 30, 40])
    np.testing.assert_allclose(shares, [1 / 4, 1.5 / 4, 2 / 4, 2.5 / 4])
