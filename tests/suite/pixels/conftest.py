"""Fixtures of the tests of images."""

import images
import pytest

from physexp import suite
from physexp.suite.engine import rendering


@pytest.fixture(scope="session", autouse=True)
def close_what_is_shared():
    yield
    for environment in images.opened:
        environment.close()


@pytest.fixture
def load():
    """Loads an environment, or a batch of `size`, and closes it when the test is over."""
    opened = []

    def load(domain_name, task_name, random, size=None, num_threads=1, **task_kwargs):
        task_kwargs["random"] = random
        if size is None:
            opened.append(suite.load(domain_name, task_name, task_kwargs))
        else:
            opened.append(suite.load_batch(domain_name, task_name, size, task_kwargs, num_threads))
        return opened[-1]

    yield load
    for environment in opened:
        environment.close()


@pytest.fixture
def drawn(monkeypatch):
    """The number of images of each call of a renderer; it draws as ever."""
    counts = []
    render = rendering.Renderer.render

    def counting(self, geom_xpos, *args, **kwargs):
        counts.append(len(geom_xpos))
        return render(self, geom_xpos, *args, **kwargs)

    monkeypatch.setattr(rendering.Renderer, "render", counting)
    return counts
