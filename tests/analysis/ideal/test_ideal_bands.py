"""The ideal experimenter of bands and a clamp, against a search over sets of graphs and by hand."""

import functools
import itertools

import ideals
import numpy as np
import pytest

from physexp.analysis.ideal import bands, resting

PAIRS = {2: [(0, 1)], 3: [(0, 1), (0, 2), (1, 2)]}


def search(num_things, weights, discount, step_limit, choose):
    """Returns the expected return by a search over sets of graphs and positions of the clamp.

    Args:
      num_things, weights, discount, step_limit: as for `bands.Clamped` and `resting.Solution`.
      choose: combines the values of all interactions: `max`, or `mean` for random ones.
    """
    graphs = [
        frozenset(pair for pair, joined in zip(PAIRS[num_things], reversed(bits), strict=True) if joined)
        for bits in itertools.product((False, True), repeat=len(PAIRS[num_things]))
    ]

    def moved(graph, clamped, pulled):
        if pulled == clamped:
            return frozenset()
        found, frontier = {pulled}, [pulled]
        while frontier:
            thing = frontier.pop()
            for other in set(range(num_things)) - found - {clamped}:
                if (min(thing, other), max(thing, other)) in graph:
                    found.add(other)
                    frontier.append(other)
        return frozenset(found)

    def chance(possible):
        return sum(weights[graphs.index(graph)] for graph in possible)

    @functools.cache
    def value(possible, clamped, steps):
        answer = 2 * max(chance([graph]) for graph in possible) / chance(possible) - 1
        if steps == 1:
            return answer
        expected = [value(possible, None if clamped == thing else thing, steps - 1) for thing in range(num_things)]
        for pulled in range(num_things):
            parts = {}
            for graph in possible:
                parts.setdefault(moved(graph, clamped, pulled), []).append(graph)
            expected.append(
                sum(
                    chance(part) / chance(possible) * value(frozenset(part), clamped, steps - 1)
                    for part in parts.values()
                )
            )
        return max(answer, discount * choose(expected))

    return value(frozenset(graph for graph in graphs if chance([graph]) > 0), None, step_limit)


def mean(values):
    return sum(values) / len(values)


def solve(num_things, weights, discount, step_limit):
    return resting.Solution(bands.Clamped(num_things, weights), discount, step_limit)


def test_it_clamps_only_if_pulls_leave_several_graphs():
    """By hand: pull 0. If it moves alone, pull 1. If one other moves, the graph is known. If both move, four are left.

    In these, one pair may be missing. Each of three clamps reveals one pair: clamp 0 and pull 1, then clamp 1 and pull
    0, then clamp 2 and pull 0 reveal whether 1-2, 0-2, 0-1 is missing; the first missing pair ends the search.
    """
    solution = ideals.of("strings")
    interactions, right = solution.play(np.arange(8))
    assert right.all()
    # None and 1-2: two pulls. 0-1 and 0-2: one. Rows of three: 3, 5 or 7; the ring, 7.
    assert sorted(interactions) == [1, 1, 2, 2, 3, 5, 7, 7]
    assert solution.value == pytest.approx(sum(0.95**count for count in (1, 1, 2, 2, 3, 5, 7, 7)) / 8)
    for graph in range(8):
        state, clamps = solution.apparatus.start, 0
        for step in range(interactions[graph]):
            action = solution.action(state, step)
            clamps += action >= 3
            reading = solution.apparatus.readings(state[1])[action, graph]
            state = solution.apparatus.after(state, action, reading)
        assert (clamps > 0) == (graph in (3, 5, 6, 7))  # Two bands, or three.
