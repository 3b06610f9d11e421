"""Questions with the answers no and yes: drawn in each episode, told, and answered one after the other.

A question is a table of the kinds that a hidden property may have: 1 for each kind that means yes.
"""

from collections.abc import Mapping, Sequence
import itertools

from dm_control import composer
import numpy as np

from physexp.suite.engine import declarations
from physexp.suite.parts import things

LABELS = ("no", "yes")
SETS = (
    "all, train or held_out, sets of questions with the answers no and yes, of which one is drawn in each episode and "
    "told; or the name of a single one"
)
"""The sets of questions that an option chooses from, in words."""

_LAMP_SIZE, _LAMP_RGBA = 0.024, (1.0, 1.0, 0.85, 1.0)  # m


class Questions:
    """The questions of a task.

    Attributes:
      tables: whether each of H kinds means yes, in each of Q questions that may be drawn, bool [Q, H].
      count: number of questions in an episode, K.
      shown: the columns of the tables that are told, where the others follow from them.
      reading: name of the observation that tells the question.
    """

    reading = "question"

    def __init__(self, tables: np.ndarray, count: int, shown: slice = slice(None)):
        """Takes the attributes."""
        self.tables, self.count, self.shown = tables, count, shown

    def draw(self, uniforms: np.ndarray) -> np.ndarray:
        """Returns the numbers of questions, float64 [N, K], from numbers in (0, 1), [N, K]."""
        return np.floor(uniforms * len(self.tables))

    def drawn(self, hidden: np.ndarray) -> np.ndarray:
        """Returns the numbers of questions, int64 [..., K], from hidden properties, [..., M], whose last they are."""
        return hidden[..., -self.count :].astype(np.int64)

    def answers(self, kinds: np.ndarray, drawn: np.ndarray) -> np.ndarray:
        """Returns the right labels, int64 [N, K], or [N] if K is 1, for kinds, int [N], and questions, int [N, K]."""
        found = self.tables[drawn, kinds[:, None]].astype(np.int64)
        return found if self.count > 1 else found[:, 0]

    def tell(self, drawn: np.ndarray, asked: np.ndarray) -> np.ndarray:
        """Returns the values that tell questions, float64 [N, S], of these indices, int [N], among those drawn."""
        return self.tables[drawn[np.arange(len(drawn)), asked], self.shown].astype(float)

    def asked(self, observation: Mapping[str, np.ndarray]) -> int:
        """Returns the number of the question that an observation tells."""
        return int((self.tables[:, self.shown] == observation[self.reading]).all(axis=1).argmax())

    def add_reading(self, room: composer.Arena, kinds: Sequence[str]) -> dict[str, declarations.Reading]:
        """Adds the sensors that tell the question to a room; returns its reading by name, for S kinds in words."""
        sensors = [room.mjcf_model.sensor.add("user", name=kind, dim=1, needstage="pos") for kind in kinds]
        meaning = f"1 for each of these that means yes: {'; '.join(kinds)}"
        return {self.reading: declarations.Reading(sensors, (len(kinds),), meaning, bounds=(0, 1))}

    def add_lamps(
        self, room: composer.Arena, places: Sequence[Sequence[float]], travel: float
    ) -> list[declarations.Indicator]:
        """Adds a lamp for each value that is told at places, m [S][3], that rises by `travel`, m, if that is 1."""
        lamps = []
        for kind, place in enumerate(places):
            lamp = things.Thing(
                f"lamp_{kind}", type="sphere", size=[_LAMP_SIZE], rgba=_LAMP_RGBA, contype=0, conaffinity=0
            )
            room.attach(lamp).pos = place
            lamps.append(declarations.Indicator(lamp.geom, self.reading, kind, (0, 0, travel)))
        return lamps


def balanced(size: int) -> np.ndarray:
    """Returns all tables of kinds of which half mean yes, bool [C, size], in the order of their first yes."""
    chosen = np.array(list(itertools.combinations(range(size), size // 2)))
    return (chosen[:, :, None] == np.arange(size)).any(axis=1)


def classes(tables: np.ndarray, renamings: Sequence[np.ndarray]) -> np.ndarray:
    """Returns the class of each table, int64 [C]; tables are alike if renaming and negation lead to one another.

    Renamings are new numbers of all kinds, int [R, H].
    """
    numbers = 2 ** np.arange(tables.shape[1])
    alike = [table[:, renaming] @ numbers for renaming in renamings for table in (tables, ~tables)]
    return np.min(alike, axis=0)


def are_held_out(tables: np.ndarray, kinds: np.ndarray, whole: Sequence[int]) -> np.ndarray:
    """Returns which tables are held out from training, bool [C], given their classes, int [C].

    They are all of some whole classes, and of each other class every third question with its negation, in the order of
    the tables.
    """
    held_out = np.isin(kinds, whole)
    for kind in np.unique(kinds[~held_out]):
        of_kind = np.flatnonzero(kinds == kind)
        questions = [place for place in of_kind if tables[place, 0]]  # A question, and its negation.
        for place in questions[2::3]:
            held_out |= (tables == tables[place]).all(axis=1) | (tables != tables[place]).all(axis=1)
    return held_out
