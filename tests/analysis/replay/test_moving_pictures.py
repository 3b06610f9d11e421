"""The moving pictures of the README are those that docs/draw_episodes.py makes."""

import importlib.util
from pathlib import Path

import numpy as np
from PIL import Image, ImageSequence
import pytest
import recordings

from physexp import suite

DOCS = Path(__file__).parents[3] / "docs"


@pytest.fixture(scope="module")
def script():
    spec = importlib.util.spec_from_file_location("draw_episodes", DOCS / "draw_episodes.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_moving_pictures_are_small_and_each_lasts_seconds_and_repeats():
    paths = [DOCS / f"{name}.gif" for name in suite.TASKS_BY_DOMAIN]
    assert sum(path.stat().st_size for path in paths) < 1.1e6
    for path in paths:
        with Image.open(path) as picture:
            assert picture.info["loop"] == 0 and picture.n_frames > 8
            assert 5000 < sum(frame.info["duration"] for frame in ImageSequence.Iterator(picture)) < 11000


@pytest.mark.parametrize("name", suite.TASKS_BY_DOMAIN)
def test_a_moving_picture_has_the_actions_of_its_agent(script, name):
    episode = script.recorded(name)
    assert len(episode.beliefs) == len(episode.actions)  # The agent keeps a belief.
    shown = script.frames(episode, np.zeros((len(episode.actions), 2, episode.declared.num_labels)))
    starts = np.cumsum([0, *(frame.duration for frame in shown)])
    with Image.open(DOCS / f"{name}.gif") as picture:
        assert picture.info["comment"].decode() == script.record(name, episode)  # All actions.
        ends = np.cumsum([frame.info["duration"] for frame in ImageSequence.Iterator(picture)])
    assert ends[-1] == starts[-1] and np.isin(ends, starts).all()  # Equal frames are joined.


def test_scenes_depend_on_hidden_properties_after_the_answer_alone(script):
    # A push with 16 N moves neither block, and the answers are 20 N and 28 N.
    films = [recordings.play("threshold", "features", [3, 12], hidden=friction) for friction in (17.0, 26.0)]
    assert [film.rewards[-1] for film in films] == [1, -1]
    before, *_, pushed, end = script.frames(films[0], np.zeros((2, 2, 8)))
    drawn = [[np.asarray(scene) for scene in script.scenes(film, [before, pushed, end])] for film in films]
    assert [np.array_equal(*scenes) for scenes in zip(*drawn, strict=True)] == [True, True, False]
    assert not np.array_equal(drawn[0][0], drawn[0][1])  # The board of the strength has moved.
