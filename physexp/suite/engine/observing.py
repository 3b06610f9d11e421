"""The observer: writes what is observed of some simulations, with noise, and with the answer where it is revealed."""

from collections.abc import Mapping
import math
from typing import Any

from dm_env import specs
import numpy as np

from physexp.suite.engine import apparatus as apparatus_lib
from physexp.suite.engine import declarations, episodes, rendering, seeding

ANSWER = "answer"
"""Name of the observation that reveals the right label."""

_IMAGE = "an image from the task's camera: rows, columns, and red, green and blue"


class Observer:
    """Writes the observations of a task: its readings as float32 arrays, or one image, `pixels`.

    Attributes:
      readings: the features, by name, and the right answer where it is revealed.
      fields: the fields of `MjData` that are looked at.
    """

    def __init__(self, task: Any):
        """Keeps what a task, of `contract.Task`, declares. A GL context is made when the first image is drawn."""
        self._options, self._num_labels, self._pixels = task.options, task.num_labels, task.pixels
        self._renderers: dict[int, rendering.Renderer] = {}  # By size.
        self.fields = apparatus_lib.LOOKED_AT if task.pixels else ("sensordata",)
        self.readings = dict(task.readings)
        if self._options.reveal:
            if task.pixels:
                raise ValueError("reveal is True; give False where images are observed, or choose a task with features")
            meaning = "1 for the right answer, 0 for the others"
            self.readings[ANSWER] = declarations.Reading((), (task.num_labels,), meaning, bounds=(0, 1))
        noisy = {} if task.pixels else task.readings
        self._noisy = {name: reading.shape for name, reading in noisy.items() if reading.noisy}
        if self._options.noise and not self._noisy:
            raise ValueError(f"noise is {self._options.noise:g}; give 0 where no reading in metres is observed")

    def blank(self, size: int) -> dict[str, np.ndarray]:
        """Returns arrays for the observations of `size` environments."""
        if self._pixels:
            return {"pixels": np.zeros((size, rendering.SIZE, rendering.SIZE, 3), np.uint8)}
        return {name: np.zeros((size, *reading.shape), np.float32) for name, reading in self.readings.items()}

    def specs(self) -> dict[str, specs.Array]:
        """Returns the specs of the observations of one environment, by name."""
        described = {}
        for name, blank in self.blank(1).items():
            array = specs.Array(blank.shape[1:], blank.dtype, name)
            bounds = self.readings[name].bounds if name in self.readings else None
            if bounds is not None and not (self._options.noise and name in self._noisy):
                array = specs.BoundedArray(array.shape, array.dtype, *bounds, name)
            described[name] = array
        return described

    def meanings(self) -> dict[str, str]:
        """Returns the meaning of each observation, in words, with the unit of its values."""
        return {name: self.readings[name].title if name in self.readings else _IMAGE for name in self.blank(1)}

    def look(
        self,
        apparatus: apparatus_lib.Apparatus,
        state: Mapping[str, np.ndarray],
        touched: np.ndarray,
        starts: apparatus_lib.Starts,
        rows: np.ndarray,
        observations: Mapping[str, np.ndarray],
    ) -> None:
        """Writes the exact observations of some simulations into the rows, int [N], of the observations.

        They show the state, fields of float64 [N, ...], but what was not touched, bool [N, number of held entities], as
        at the starts, which `rows` index.
        """
        shown = {field: apparatus.shown(field, values, touched, starts, rows) for field, values in state.items()}
        if not self._pixels:
            for name in apparatus.readings:
                observations[name][rows] = apparatus.read(name, shown["sensordata"])
            return
        apparatus.indicate(shown["geom_xpos"], shown["sensordata"])
        poses, sizes = (shown["geom_xpos"], shown["geom_xmat"]), apparatus.sizes(shown["sensordata"])
        self.renderer(apparatus).render(*poses, rows, observations["pixels"], starts.camera[rows], sizes=sizes)

    def renderer(self, apparatus: apparatus_lib.Apparatus, size: int = rendering.SIZE) -> rendering.Renderer:
        """Returns the renderer of images of a size; all structures of a task have the same geoms, so it draws each."""
        if size not in self._renderers:
            self._renderers[size] = rendering.Renderer(apparatus.model, apparatus.moving_geoms, size=size)
        return self._renderers[size]

    def complete(self, ledger: episodes.Ledger, rows: np.ndarray, observations: Mapping[str, np.ndarray]) -> None:
        """Adds noise, and the right answers if they are observed, to the observations of some environments, int [N].

        The noise follows from seed, episode, step and reading alone: it is the same whatever is hidden.
        """
        if self._options.noise:
            sizes = [math.prod(shape) for shape in self._noisy.values()]
            draws = seeding.normals(ledger.seeds[rows], ledger.next_episodes[rows] - 1, ledger.steps[rows], sum(sizes))
            parts = np.split(self._options.noise * draws, np.cumsum(sizes)[:-1], axis=1)
            for (name, shape), part in zip(self._noisy.items(), parts, strict=True):
                observations[name][rows] += part.reshape(len(part), *shape).astype(np.float32)
        if self._options.reveal:
            observations[ANSWER][rows] = ledger.correct_answers[rows, None] == np.arange(self._num_labels)

    def close(self) -> None:
        """Frees the renderers; the next image makes another."""
        for renderer in self._renderers.values():
            renderer.close()
        self._renderers.clear()
