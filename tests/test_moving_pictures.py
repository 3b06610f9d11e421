"""The moving pictures of the README are those that docs/draw_episodes.py makes."""

import importlib.util
from pathlib import Path

import numpy as np
from PIL import Image, ImageSequence
import pytest

from physexp import suite

DOCS = Path(__file__).parent.parent / "docs"


@pytest.fixture(scope="module")
def script():
    spec = importlib.util.spec_from_file_location("draw_episodes", DOCS / "draw_episodes.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.mark.parametrize("name", suite.TASKS_BY_DOMAIN)
def test_a_moving_picture_is_small_repeats_and_lasts_seconds(name):
    path = DOCS / f"{name}.gif"
    assert path.stat().st_size < 1e6
    with Image.open(path) as picture:
        assert picture.info["loop"] == 0 and picture.n_frames > 8
        assert 5000 < sum(frame.info["duration"] for frame in ImageSequence.Iterator(picture)) < 11000


@pytest.mark.parametrize("name", ["which_is_heavier", "strike"])
def test_a_moving_picture_takes_as_long_as_the_play_of_its_agent(script, name):
    episode = script.recorded(name)
    assert len(episode.beliefs) == len(episode.actions)
    starts = np.cumsum([0, *(frame.duration for frame in script.frames(episode))])
    with Image.open(DOCS / f"{name}.gif") as picture:
        ends = np.cumsum([frame.info["duration"] for frame in ImageSequence.Iterator(picture)])
    assert ends[-1] == starts[-1] and np.isin(ends, starts).all()  # Equal frames are joined.
