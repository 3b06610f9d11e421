"""Fixtures of the suite's tests."""

import episodes
import pytest


@pytest.fixture
def seed():
    """The seed that a module shares (see `episodes.SEED`); printed, so that a failure can be replayed."""
    print(f"PHYSEXP_TEST_SEED={episodes.SEED}")
    return episodes.SEED
