"""The ideal experimenter's values explain the returns of all policies: the rest is luck, whose mean is 0.

The episodes are too short for the ideal to find out all that it would, so its values must know the time limit.
"""

import math

import ideals
import numpy as np
import pytest
from seeds import fresh_seed

from physexp import suite
from physexp.agents import acting, core, environment_loop, pretrained
from physexp.analysis import domains
from physexp.analysis.ideal import finite, mistakes, planning, rollouts

TASKS = [names for names in suite.tagged("features") if domains.find(names[0]).ideal is not None]
STEPS = 4
COUNTS = 64, 640  # Episodes; the second number if the mean of the first ones is out of bounds, as rare ones may miss.
MOST_TRIED = 8  # Interactions, to find one that is worth repeating.
ROUNDING = 2e-3  # Values are interpolated in one family, and shared by near states in another.


class Table:
    """Short episodes of a task, side by side, which all policies play."""

    def __init__(self, domain, task, count):
        options = {"time_limit": STEPS * suite.load_task(domain, task).options.control_timestep}
        self.names, self.count = (domain, task), count
        self.solution = ideals.of(domain, task, **options)
        self.generator = np.random.default_rng(fresh_seed())
        self.batch = suite.load_batch(domain, task, count, {**options, "random": fresh_seed()})
        self.batch.reset(episode=0)
        self.num_interactions, self.num_labels = self.batch.task.num_interactions, self.batch.task.num_labels
        self._judged = {}

    def play(self, make):
        """Returns the returns of the actors that `make` returns for each row, and the luck in them, [count] each."""
        taken, returns = [[] for _ in range(self.count)], np.zeros(self.count)
        actors = [make(self, row) for row in range(self.count)]
        for step, (rows, actions, after) in enumerate(rollouts.play_round(actors, self.batch, 0)):
            for row, action in zip(rows, actions, strict=True):
                taken[row].append(action)
            returns[rows] += self.solution.discount**step * after.reward
        played = [np.array(actions) for actions in taken]
        judged = [self._judge(*one) for one in zip(self.batch.hidden, played, strict=True)]
        costs = mistakes.of_episodes(judged, played, self.solution.discount)
        assert min(cost.min() for cost in costs.values()) > -1e-9
        return returns, returns + sum(costs.values()) - self.solution.value

    def _judge(self, hidden, actions):
        key = hidden.tobytes(), actions.tobytes()
        if key not in self._judged:
            self._judged[key] = self.solution.judge(hidden, actions)
        return self._judged[key]


def at_random(table, row):
    """Draws all actions, until it answers."""
    actions = table.generator.integers(table.num_interactions + table.num_labels, size=STEPS)
    answers = np.flatnonzero(actions >= table.num_interactions)
    return environment_loop.Repeat(actions[: answers[0] + 1] if len(answers) else actions)


def scripted(table, interactions, label):
    return environment_loop.Repeat([*interactions[: STEPS - 1], table.num_interactions + label])


def in_turn(table, row):
    """Interacts in a fixed order, and gives the first answer."""
    return scripted(table, np.arange(STEPS) % table.num_interactions, 0)


def again_and_again(table, row):
    """Repeats one interaction, and guesses."""
    interaction = table.generator.integers(table.num_interactions)
    return scripted(table, [interaction] * STEPS, table.generator.integers(table.num_labels))


def at_once(table, row):
    belief = table.solution.beliefs(table.batch.hidden[row], np.zeros(0, np.int64))[0]
    return environment_loop.Repeat([table.num_interactions + belief.argmax()])


def trained(table, row):
    if not row:
        table.network = pretrained.load(*table.names).network
    return acting.RecurrentActor(table.network, row)


class Greedy(core.EpisodicActor):
    """Takes an interaction that tells most about the label, until it knows it or the time is over."""

    def __init__(self, states, planner, hypothesis, generator):
        self._states, self._planner, self._hypothesis, self._generator = states, planner, hypothesis, generator

    def _begin(self, timestep):
        self._state, self._left = self._states.start, STEPS

    def _choose(self, observation):
        belief = self._states.posterior(self._state)
        if self._left == 1 or belief.max() == 1:
            return self._states.num_interactions + int(belief.argmax())
        return int(self._generator.choice(self._planner.informative(self._states.represented(self._state), self._left)))

    def _note(self, action, next_timestep):
        self._left -= 1
        if action < self._states.num_interactions:
            self._state = finite.after(self._states, self._state, action, self._hypothesis)


def greedy(table, row):
    solution, hidden = table.solution, table.batch.hidden[row]
    if hasattr(solution, "apparatus"):
        states, hypothesis = solution.apparatus, int(table.batch.correct_answers[row])
    elif hasattr(solution, "hypotheses"):
        states, hypothesis = solution._complete_histories, solution._hypothesis(hidden)
    else:
        return solution.actor()  # Things are alike until they are touched: no interaction tells more than the ideal's.
    if not row:
        table.planner = planning._Planner(states, solution.discount, STEPS, 0.0)
    return Greedy(states, table.planner, hypothesis, table.generator)


class Memory:
    """Other episodes with one interaction, repeated as often as was best: all that was observed, and the answers."""

    def __init__(self, table):
        self.value = -math.inf
        size, batch = table.count, table.batch
        for interaction in range(min(table.num_interactions, MOST_TRIED)):
            seen = [flat(batch.reset(episode=1 + interaction).observation, size)]
            for count in range(1, STEPS):
                seen.append(flat(batch.step(np.full(size, interaction)).observation, size))
                history, answers = np.concatenate(seen, axis=1), batch.correct_answers.copy()
                distances = np.abs(history[:, None] - history).sum(axis=-1)
                np.fill_diagonal(distances, np.inf)
                share = np.mean(answers[distances.argmin(axis=1)] == answers)
                value = table.solution.discount**count * (2 * share - 1)
                if value > self.value:
                    self.value, self.interactions = value, [interaction] * count
                    self._history, self._answers = history, answers

    def answer(self, seen):
        """Returns the answer that was right in the episode with the nearest observations; equal ones are nearest."""
        return int(self._answers[np.abs(self._history - np.concatenate(seen)).sum(axis=1).argmin()])


def flat(observation, size):
    """Returns the values of observations as an array [size, number of values]."""
    return np.concatenate([values.reshape(size, -1) for values in observation.values()], axis=1).astype(float)


class Reader(core.EpisodicActor):
    """Interacts and answers as a memory says."""

    def __init__(self, memory, num_interactions):
        self._memory, self._num_interactions = memory, num_interactions

    def _begin(self, timestep):
        self._seen = [flat(timestep.observation, 1)[0]]

    def _choose(self, observation):
        step, script = len(self._seen) - 1, self._memory.interactions
        return script[step] if step < len(script) else self._num_interactions + self._memory.answer(self._seen)

    def _note(self, action, next_timestep):
        if not next_timestep.last():
            self._seen.append(flat(next_timestep.observation, 1)[0])


def by_heart(table, row):
    if not row:
        table.memory = Memory(table)
    return Reader(table.memory, table.num_interactions)


POLICIES = {
    "random": at_random,
    "silent": lambda table, row: environment_loop.Repeat([0] * STEPS),
    "at once": at_once,
    "in turn": in_turn,
    "again and again": again_and_again,
    "ideal": lambda table, row: table.solution.actor(),
    "greedy": greedy,
    "trained": trained,
    "by heart": by_heart,
}


@pytest.fixture(scope="module", params=TASKS, ids="/".join)
def table(request):
    return Table(*request.param, COUNTS[0])


@pytest.mark.parametrize("policy", POLICIES)
def test_luck_is_0_on_average_and_no_policy_earns_more_than_the_ideal(table, policy):
    for count in COUNTS:
        of_count = table if count == table.count else Table(*table.names, count)
        returns, luck = of_count.play(POLICIES[policy])
        surplus = returns - table.solution.value
        most, of_luck = (4 * values.std() / math.sqrt(count) + ROUNDING for values in (surplus, luck))
        if surplus.mean() < most and abs(luck.mean()) < of_luck:
            return
    pytest.fail(
        f"luck is {luck.mean():.4f} +- {of_luck:.4f}, the surplus over the ideal {surplus.mean():.4f} +- {most:.4f}"
    )
