"""A folder with one of everything, for all attacks."""

import attacks
import pytest
import reading


@pytest.fixture(scope="session")
def made(tmp_path_factory):
    """A folder with one of everything that is written, see `reading.make`."""
    folder = tmp_path_factory.mktemp("made")
    end = attacks.run(reading.make, folder)
    assert end.code == 0, end.said
    return folder
