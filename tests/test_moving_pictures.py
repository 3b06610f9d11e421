"""The moving pictures of the README: what docs/draw_episodes.py draws."""

import importlib.util
from pathlib import Path

import every_task
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


TRAINED = {domain for domain, _ in suite.ALL_TASKS if (domain, "features") not in every_task.UNTRAINED}


@pytest.mark.parametrize("name", [name for name in suite.TASKS_BY_DOMAIN if name in TRAINED])
def test_a_moving_picture_is_small_loops_and_ends_as_the_script_draws_it(script, name):
    path = DOCS / f"{name}.gif"
    assert path.stat().st_size < 1e6
    episode = script.recorded(name)
    shown = script.frames(episode)
    with Image.open(path) as picture:
        assert picture.info["loop"] == 0 and picture.n_frames > 8  # It repeats for ever.
        pictures, durations = [], []
        for frame in ImageSequence.Iterator(picture):
            pictures.append(np.asarray(frame.convert("RGB")).astype(int))
            durations.append(frame.info["duration"])
    assert np.isin(np.cumsum(durations), np.cumsum([frame.duration for frame in shown])).all()  # Equal ones are joined.
    assert 5000 < sum(durations) == sum(frame.duration for frame in shown) < 11000
    assert all((later != earlier).any() for earlier, later in zip(pictures, pictures[1:], strict=False))
    (scene,) = script.scenes(episode, [shown[-1].substep])
    drawn = np.asarray(script.drawn(episode, shown[-1], scene)).astype(int)
    assert np.abs(pictures[-1] - drawn).mean() < 2 < np.abs(pictures[0] - drawn).mean()  # Of 255; its colours are few.
