"""The moving pictures of the README equal the drawings of docs/draw_episodes.py."""

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
def test_a_moving_picture_shows_the_beliefs_and_actions_of_its_agent(script, name):
    episode = script.recorded(name)
    assert len(episode.beliefs) == len(episode.actions)
    shown = script.frames(episode)
    starts = np.cumsum([0, *(frame.duration for frame in shown)])
    pictures, durations = [], []
    with Image.open(DOCS / f"{name}.gif") as picture:
        for frame in ImageSequence.Iterator(picture):
            pictures.append(np.asarray(frame.convert("RGB")).astype(int))
            durations.append(frame.info["duration"])
    numbers = np.searchsorted(starts, np.cumsum([0, *durations[:-1]]))
    assert np.isin(np.cumsum(durations), starts).all()  # Equal frames are joined.
    left = 30 * script.SCALE + script.SCENE  # pixels: text and bars are at the right of the scene
    texts = {}
    for number, pixels in zip(numbers, pictures, strict=True):
        frame = shown[number]
        key = frame.action, frame.verdict
        if key not in texts:  # All frames of a decision share its text; the first one is drawn as a whole.
            (scene,) = script.scenes(episode, [frame])
            texts[key] = np.asarray(script.drawn(episode, frame, scene)).astype(int)
            assert np.abs(pixels - texts[key]).mean() < 2  # Of 255, for the few colours of a GIF.
        # Another digit would differ by nearly 255 somewhere.
        assert np.abs(pixels - texts[key])[:, left:].max() < 100
    assert len({action for action, _ in texts}) == len(episode.actions)
