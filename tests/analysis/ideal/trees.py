"""Trees of all sequences of actions, over single simulations of a thing that is seen only after a wait."""

import functools

import mujoco
import numpy as np


def simulation(model, forces, num_substeps):
    """Returns a function from a sequence of actions to the first coordinate of a model with two, m."""
    data = mujoco.MjData(model)

    @functools.cache
    def state(sequence):
        if not sequence:
            return (0.0, 0.0), (0.0, 0.0)
        data.qpos[:], data.qvel[:] = state(sequence[:-1])
        data.ctrl[:] = forces[sequence[-1]]
        mujoco.mj_step(model, data, nstep=num_substeps)
        return tuple(data.qpos), tuple(data.qvel)

    return lambda sequence: state(sequence)[0][0]


def bounds(simulations, kinds, prior, *, wait, mark, discount, depth):
    """Bounds on the best return by all sequences up to a length; for the upper one, one more action reveals all.

    The last action is to `wait`, and the coordinate is read after it alone, to a mark.
    """

    def value(sequence, group):
        weights = np.bincount(kinds[group], prior[group], minlength=4)
        answer = 2 * weights.max() / weights.sum() - 1
        if weights.max() == weights.sum():
            return answer, answer
        if len(sequence) == depth:
            return answer, max(answer, discount)
        low = high = answer
        for action in range(wait + 1):
            parts = {}
            for k in group:
                longer = (*sequence, action)
                reading = round(simulations[k](longer) / mark) if action == wait else 0
                parts.setdefault(reading, []).append(k)
            found = np.zeros(2)
            for part in parts.values():
                found += prior[part].sum() / weights.sum() * np.array(value((*sequence, action), part))
            low, high = max(low, discount * found[0]), max(high, discount * found[1])
        return low, high

    return value((), list(range(len(kinds))))
