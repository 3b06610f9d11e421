"""Fixtures of the tests of images."""

import pytest

from physexp import suite
from physexp.suite.engine import rendering


@pytest.fixture
def load():
    """Loads an environment, or a batch of `size`, and closes it when the test is over."""
    opened = []

    def load(domain_name, task_name, random, size=None, **task_kwargs):
        task = suite.load_task(domain_name, task_name, {"random": random, **task_kwargs})
        opened.append(suite.Environment(task) if size is None else suite.BatchEnvironment(task, size))
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
