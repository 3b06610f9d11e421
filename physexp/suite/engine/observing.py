"""The observer: writes what is observed of some simulations, with noise, and with the answer where it is revealed."""

from collections.abc import Mapping
import math

from dm_env import specs
import numpy as np

from physexp.suite.engine import apparatus as apparatus_lib
from physexp.suite.engine import declarations, episodes, seeding
from physexp.suite.engine import options as options_lib
from physexp.suite.engine import senses as senses_lib

ANSWER = "answer"
"""Name of the observation that reveals the right label."""

_IMAGE = "an image from the task's camera: rows, columns, and red, green and blue"


class Observer:
    """Writes the observations of a task.

    Attributes:
      readings: the features, by name, and the right answer where it is revealed.
    """

    def __init__(
        self,
        readings: Mapping[str, declarations.Reading],
        num_labels: int,
        options: options_lib.Options,
        sense: senses_lib.Sense,
    ):
        self._sense, self._options, self._num_labels = sense, options, num_labels
        self.readings = dict(readings)
        if options.reveal:
            if sense.needs_gl:
                raise ValueError("reveal is True; give False where images are observed, or choose a task with features")
            meaning = "1 for the right answer, 0 for the others"
            self.readings[ANSWER] = declarations.Reading((), (num_labels,), meaning, bounds=(0, 1))
        noisy = {} if sense.needs_gl else readings
        self._noisy = {name: reading.shape for name, reading in noisy.items() if reading.noisy}
        if options.noise and not self._noisy:
            raise ValueError(f"noise is {options.noise:g}; give 0 where no reading in metres is observed")

    def blank(self, size: int) -> dict[str, np.ndarray]:
        """Returns arrays for the observations of `size` environments."""
        return self._sense.blank({name: reading.shape for name, reading in self.readings.items()}, size)

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

    @property
    def meanings(self) -> dict[str, str]:
        """The meaning of each observation, in words, with the unit of its values."""
        return {name: self.readings[name].title if name in self.readings else _IMAGE for name in self.specs()}

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
        self._sense.look(apparatus, shown, starts.camera[rows], rows, observations)

    def add_noise(self, ledger: episodes.Ledger, rows: np.ndarray, observations: Mapping[str, np.ndarray]) -> None:
        """Adds the noise of the current control step to the observations of some environments, int [N].

        It follows from seed, episode, step and reading alone: it is the same whatever is hidden.
        """
        if not self._options.noise:
            return
        sizes = [math.prod(shape) for shape in self._noisy.values()]
        draws = seeding.normals(ledger.seeds[rows], ledger.next_episodes[rows] - 1, ledger.steps[rows], sum(sizes))
        parts = np.split(self._options.noise * draws, np.cumsum(sizes)[:-1], axis=1)
        for (name, shape), part in zip(self._noisy.items(), parts, strict=True):
            observations[name][rows] += part.reshape(len(part), *shape).astype(np.float32)

    def reveal(self, ledger: episodes.Ledger, rows: np.ndarray, observations: Mapping[str, np.ndarray]) -> None:
        """Writes the right answers of some environments, int [N], if they are observed."""
        if self._options.reveal:
            observations[ANSWER][rows] = ledger.answers[rows, None] == np.arange(self._num_labels)
