"""The ideal experimenter of the counterfeit-coin problem, where it is not weighing that costs, but laying things on.

Of N things one is odd, heavier or lighter than the others, which are alike. Each interaction puts one thing on the left
pan of a balance, on the right one or aside, and the balance then tells which pan is heavier. The odd thing's difference
is less than a thing weighs, so that pans with unequal numbers tell nothing.

What is known of a thing is one of four kinds: it may be heavier or lighter (`UNKNOWN`), only the one or the other, or
it is genuine. All that matters is how many things of each kind lie where, so that states are counts, [4, 3]. The best
policy is found exactly by going back from the last step, over all states that can be reached.
"""

from collections.abc import Callable, Iterator, Mapping
import dataclasses
import functools
from typing import Any

import numpy as np

from physexp.agents import core
from physexp.analysis.ideal import base
from physexp.suite.engine import checks, rules

ASIDE, LEFT, RIGHT = range(3)
"""Where things lie. Interaction 3 k + p puts thing k in place p; label 2 k says that it is heavier, 2 k + 1 lighter."""
UNKNOWN, HEAVIER, LIGHTER, GENUINE = range(4)
"""What may be known of a thing."""

MOST_THINGS = 12
_NUM_PLACES, _NUM_KINDS = 3, 4
_WEIGHTS = np.array([2, 1, 1, 0])  # How many labels are possible of a thing, by kind.
_TIE = 1e-12  # Returns that differ by less are equal: the shorter way is taken.

# What is known after a weighing, by tilt (-1, 0, 1), kind and place. If the balance tilts, the odd thing is on a pan,
# and heavier if that went down.
_KINDS_AFTER = {
    0: [[kind, GENUINE, GENUINE] for kind in range(_NUM_KINDS)],
    -1: [
        [GENUINE, HEAVIER, LIGHTER],
        [GENUINE, HEAVIER, GENUINE],
        [GENUINE, GENUINE, LIGHTER],
        [GENUINE, GENUINE, GENUINE],
    ],
    1: [
        [GENUINE, LIGHTER, HEAVIER],
        [GENUINE, GENUINE, HEAVIER],
        [GENUINE, LIGHTER, GENUINE],
        [GENUINE, GENUINE, GENUINE],
    ],
}

State = tuple[int, ...]
"""How many things of each kind lie in each place, [4 * 3], kind by kind."""


def weighed(kinds: np.ndarray, places: np.ndarray, tilt: int) -> np.ndarray:
    """Returns what is known of things, int [N], after the balance has been read.

    Args:
      kinds: what was known before, int [N].
      places: where they lie, int [N].
      tilt: to which side the balance tilts, -1 to the left, 0 or 1.
    """
    if not _tells((places == LEFT).sum(), (places == RIGHT).sum()):
        return kinds
    return np.array(_KINDS_AFTER[tilt])[kinds, places]


def _tells(left: int, right: int) -> bool:
    return left == right > 0


def _outcomes(state: State) -> Iterator[tuple[float, State]]:
    """Probabilities and states after the balance has been read, where things lie as in a state."""
    _, left, right = (sum(state[place::_NUM_PLACES]) for place in range(_NUM_PLACES))
    if not _tells(left, right):
        yield 1.0, state
        return
    total = _num_labels(state)
    for after in _KINDS_AFTER.values():
        counts = [0] * len(state)
        for index, count in enumerate(state):
            kind, place = divmod(index, _NUM_PLACES)
            counts[_NUM_PLACES * after[kind][place] + place] += count
        if labels := _num_labels(tuple(counts)):
            yield labels / total, tuple(counts)


def _num_labels(state: State) -> int:
    """How many labels are possible; all of them are equally likely."""
    return sum(
        int(weight) * sum(state[_NUM_PLACES * kind : _NUM_PLACES * (kind + 1)]) for kind, weight in enumerate(_WEIGHTS)
    )


def _moved(state: State, kind: int, start: int, end: int) -> State:
    counts = list(state)
    counts[_NUM_PLACES * kind + start] -= 1
    counts[_NUM_PLACES * kind + end] += 1
    return tuple(counts)


class _Graph:
    """All states that can be reached, and what moves lead to.

    Attributes:
      states: the states; the first one is where episodes start.
      index: of each of them.
      moves: (kind, start, end) of each move, int [M, 3], state by state.
      first: the first move of each state, int [S].
      shares: of all interactions in the state, how many are this move, float64 [M].
      outcome_move, outcome_chance, outcome_state: of each outcome of each move, [K].
    """

    def __init__(self, start: State):
        self.states, self.index = [start], {start: 0}
        moves: list[tuple[int, int, int]] = []
        outcomes: list[tuple[int, float, int]] = []
        first, shares = [], []
        things = sum(start)
        for state in self.states:  # It grows while it is gone through.
            first.append(len(moves))
            for index, count in enumerate(state):
                kind, place = divmod(index, _NUM_PLACES)
                for end in range(_NUM_PLACES if count else 0):
                    for chance, after in _outcomes(_moved(state, kind, place, end)):
                        if after not in self.index:
                            self.index[after] = len(self.states)
                            self.states.append(after)
                        outcomes.append((len(moves), chance, self.index[after]))
                    moves.append((kind, place, end))
                    shares.append(count / (_NUM_PLACES * things))
        self.moves, self.first, self.shares = np.array(moves), np.array(first), np.array(shares)
        columns = zip(*outcomes, strict=True)
        self.outcome_move, self.outcome_chance, self.outcome_state = (np.array(column) for column in columns)
        self._states_of_moves = np.repeat(np.arange(len(self.states)), np.diff([*first, len(moves)]))

    def after(self, values: np.ndarray) -> np.ndarray:
        """Returns what is expected after each move, [M], of values of states, [S]."""
        return np.bincount(self.outcome_move, self.outcome_chance * values[self.outcome_state], len(self.moves))

    def best(self, values: np.ndarray) -> np.ndarray:
        """Returns the largest of the values of moves, [M], for each state, [S]."""
        return np.maximum.reduceat(values, self.first)

    def mean(self, values: np.ndarray) -> np.ndarray:
        """Returns the mean value of a random interaction, [S], of values of moves, [M]."""
        return np.bincount(self._states_of_moves, self.shares * values, len(self.states))

    def spread(self, values: np.ndarray) -> np.ndarray:
        """Returns values of states, [S], for each of their moves, [M]."""
        return values[self._states_of_moves]


@functools.lru_cache(maxsize=8)
def _graph(start: State) -> _Graph:
    return _Graph(start)


@dataclasses.dataclass(frozen=True, eq=False)
class Solution:
    """The best policy there is, and what it is worth.

    Attributes:
      num_things: N.
      num_suspects: how many of them may be odd: the first ones.
      discount: for each interaction.
      step_limit: steps in an unanswered episode.
      value: expected discounted return from an episode's start.
      random_value: the same of interactions drawn uniformly, with the best answers at the best moment.
      policy: the best move in each state at each step, an index of the graph's moves, or -1 to answer [step_limit, S].
      read: tells from an observation to which side the balance tilts; None where that cannot be read.
      label: returns the right label of a hidden property; None where it is not known.
    """

    num_things: int
    num_suspects: int
    discount: float
    step_limit: int
    value: float
    random_value: float
    policy: np.ndarray
    read: Callable[[Mapping[str, np.ndarray]], int] | None = None
    label: Callable[[np.ndarray], int] | None = None

    @property
    def bound(self) -> float:
        """Returns the upper bound, which is the value, since that is exact."""
        return self.value

    @property
    def at_once(self) -> float:
        """Expected return of an answer without any interaction."""
        return 2 / (2 * self.num_suspects) - 1

    def start(self) -> tuple[np.ndarray, np.ndarray]:
        """Returns what is known of the things and where they lie at an episode's start, int [N] both."""
        kinds = np.where(np.arange(self.num_things) < self.num_suspects, UNKNOWN, GENUINE)
        return kinds, np.full(self.num_things, ASIDE)

    def action(self, kinds: np.ndarray, places: np.ndarray, step: int) -> int:
        """Returns the best action.

        Args:
          kinds, places: of the things, int [N].
          step: interactions so far in the episode, below `step_limit`.
        """
        graph = _graph(_state(*self.start()))
        move = int(self.policy[step, graph.index[_state(kinds, places)]])
        if move < 0:
            return _NUM_PLACES * self.num_things + int(self.posterior(kinds).argmax())
        kind, start, end = graph.moves[move]
        thing = int(np.flatnonzero((kinds == kind) & (places == start))[0])
        return int(_NUM_PLACES * thing + end)

    def posterior(self, kinds: np.ndarray) -> np.ndarray:
        """Returns the probabilities of the labels, float64 [2 N], of what is known of the things, int [N]."""
        possible = np.stack([(kinds == UNKNOWN) | (kinds == kind) for kind in (HEAVIER, LIGHTER)], axis=1).ravel()
        return possible / possible.sum()

    def actor(self) -> core.Actor:
        """Returns an actor that reads the balance from observations.

        Raises:
          ValueError: if it cannot be read from what the task observes.
        """
        if self.read is None:
            raise ValueError("the ideal experimenter reads the tilt from features, not from images; choose such a task")
        return _Player(self, self.read)

    def beliefs(self, episode: base.Episode) -> np.ndarray:
        """Returns the posterior at the start and after each action of an episode, float64 [T + 1, 2 N].

        Raises:
          ValueError: if it was not told how the right label follows from what is hidden.
        """
        if self.label is None:
            raise ValueError("this ideal experimenter was not told how the label follows from what is hidden")
        label = self.label(episode.hidden)
        kinds, places = self.start()
        found = [self.posterior(kinds)]
        for action in episode.actions:
            kinds, places = self._follow(kinds, places, int(action), label)
            found.append(self.posterior(kinds))
        return np.array(found)

    def _follow(self, kinds, places, action, label) -> tuple[np.ndarray, np.ndarray]:
        """What is known, and where things lie, after an action where a label is right; an answer changes nothing."""
        if action >= _NUM_PLACES * self.num_things:
            return kinds, places
        places = places.copy()
        places[action // _NUM_PLACES] = action % _NUM_PLACES
        side = (0, -1, 1)[places[label // 2]]
        return weighed(kinds, places, -side if label % 2 else side), places

    def play(self, labels: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Plays episodes without physics.

        Args:
          labels: the right ones, int64 [N].

        Returns:
          Interactions, int64 [N], and whether the answer was right, bool [N].
        """
        found = np.zeros((2 * self.num_things, 2), np.int64)
        for label in np.unique(labels):
            kinds, places = self.start()
            for step in range(self.step_limit):
                action = self.action(kinds, places, step)
                if action >= _NUM_PLACES * self.num_things:
                    found[label] = step, action - _NUM_PLACES * self.num_things == label
                    break
                kinds, places = self._follow(kinds, places, action, label)
        return found[labels, 0], found[labels, 1].astype(bool)

    def summary(self) -> dict[str, Any]:
        """`value`, `bound`, `at_once`, `random_value`, `accuracy`, `mean_interactions` and `histogram`."""
        interactions, right = self.play(np.arange(2 * self.num_suspects))
        return {
            "value": self.value,
            "bound": self.bound,
            "at_once": self.at_once,
            "random_value": self.random_value,
            "accuracy": float(right.mean()),
            "mean_interactions": float(interactions.mean()),
            "histogram": {number: float(share) for number, share in enumerate(np.bincount(interactions) / len(right))},
        }


def _state(kinds: np.ndarray, places: np.ndarray) -> State:
    counts = np.bincount(_NUM_PLACES * kinds + places, minlength=_NUM_PLACES * _NUM_KINDS)
    return tuple(counts.tolist())


class _Player(core.Actor):
    """Plays a solution."""

    def __init__(self, solution: Solution, read: Callable[[Mapping[str, np.ndarray]], int]):
        self._solution, self._read = solution, read

    def observe_first(self, timestep):
        self._kinds, self._places = self._solution.start()
        self._step = 0

    def select_action(self, observation) -> int:
        return self._solution.action(self._kinds, self._places, self._step)

    def observe(self, action, next_timestep):
        if next_timestep.last():
            return
        self._places[action // _NUM_PLACES] = action % _NUM_PLACES
        self._kinds = weighed(self._kinds, self._places, self._read(next_timestep.observation))
        self._step += 1

    def update(self):
        """Does nothing: it knows all that can be known."""


def solve(num_things: int, num_suspects: int, discount: float, step_limit: int) -> Solution:
    """Finds the best policy, exactly. At first all things lie aside, and all possible labels are equally likely.

    An answer after n interactions earns discount^n, times -1 where it is wrong, and so does silence at the last step.

    Args:
      num_things: N, from 2 to `MOST_THINGS`.
      num_suspects: how many of them may be odd, from 1 to N.
      discount: the agent's gamma, in (0, 1].
      step_limit: steps in an unanswered episode, from 1 to 10 000.

    Raises:
      ValueError: for a value that makes no sense.
    """
    things = checks.integer("num_things", num_things, 2, MOST_THINGS)
    suspects = checks.integer("num_suspects", num_suspects, 1, things)
    discount = base.check_discount(discount)
    steps = checks.integer("step_limit", step_limit, 1, 10_000)
    start = [0] * (_NUM_KINDS * _NUM_PLACES)
    start[_NUM_PLACES * UNKNOWN + ASIDE], start[_NUM_PLACES * GENUINE + ASIDE] = suspects, things - suspects
    graph = _graph(tuple(start))
    labels = np.array([_num_labels(state) for state in graph.states])
    answer = rules.WRONG + (rules.RIGHT - rules.WRONG) / labels
    policy = np.full((steps, len(labels)), -1, np.int32)  # At the last step nothing is worth more than an answer.
    best, at_random, length = answer, answer, np.zeros_like(answer)
    for step in reversed(range(steps - 1)):
        values = discount * graph.after(best)
        most = graph.best(values)
        lengths = np.where(values >= graph.spread(most) - _TIE, 1 + graph.after(length), np.inf)
        shortest = -graph.best(-lengths)
        is_shortest = lengths == graph.spread(shortest)
        moving = most > answer + _TIE
        policy[step] = np.where(
            moving, np.maximum.reduceat(np.where(is_shortest, np.arange(len(lengths)), -1), graph.first), -1
        )
        length = np.where(moving, shortest, 0.0)
        best = np.maximum(answer, most)
        at_random = np.maximum(answer, graph.mean(discount * graph.after(at_random)))
    return Solution(things, suspects, discount, steps, float(best[0]), float(at_random[0]), policy)
