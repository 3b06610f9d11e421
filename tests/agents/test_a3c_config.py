"""A configuration that makes no sense is refused, with the value and what is allowed."""

import math
import re

import pytest

from physexp.agents.a3c import config as config_lib

BAD = [
    ("discount", 0.0),
    ("discount", 1.5),
    ("discount", math.nan),
    ("frames", 0),
    ("frames", 1.5),
    ("frames", True),
    ("seed", -1),
    ("num_workers", 0),
    ("envs_per_worker", 0),
    ("lstm_units", 0),
    ("learning_rate", 0.0),
    ("learning_rate", math.inf),
    ("entropy_cost", -0.1),
    ("entropy_cost", math.nan),
    ("final_entropy_cost", -1.0),
    ("baseline_cost", math.nan),
    ("max_gradient_norm", 0.0),
    ("observation_scale", -1.0),
    ("trace", -0.1),
    ("trace", 1.1),
    ("trace", math.nan),
    ("checkpoint_seconds", 0.0),
]


@pytest.mark.parametrize(("name", "value"), BAD)
def test_a_bad_value_is_refused_by_name_with_what_is_allowed(name, value):
    with pytest.raises(ValueError, match=rf"^{name} is {re.escape(repr(value))}; give a(n| finite)? ?(integer|number)"):
        config_lib.A3CConfig(**{name: value})


def test_values_at_the_edge_of_what_is_allowed_are_taken():
    config = config_lib.A3CConfig(discount=1.0, frames=1, num_workers=1, envs_per_worker=1, entropy_cost=0.0, seed=0)
    assert config.replace(discount=0.5).discount == 0.5
    assert config.discount == 1.0, "replace makes a copy"


def test_replace_checks_too():
    with pytest.raises(ValueError, match="num_workers is -2"):
        config_lib.A3CConfig().replace(num_workers=-2)
