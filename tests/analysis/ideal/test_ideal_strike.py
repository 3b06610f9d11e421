"""The ideal experimenter of Strike against a tree of all sequences, simulated with another model."""

import functools

import ideals
import mujoco
import numpy as np
import pytest
from seeds import fresh_seed

from physexp.suite.domains import strike

ANSWERS = np.array([answer for answer, *_ in strike.PUCKS])


def simulation(mass, friction):
    """Returns a function from a sequence of pokes to the position of a puck, m."""
    spec = mujoco.MjSpec()
    spec.option.timestep, spec.option.gravity = 0.01, [0, 0, 0]
    body = spec.worldbody.add_body(mass=mass, inertia=[1, 1, 1], explicitinertial=True)
    body.add_joint(
        name="rail",
        type=mujoco.mjtJoint.mjJNT_SLIDE,
        axis=[1, 0, 0],
        frictionloss=friction,
        limited=True,
        range=[0, 0.3],
        solimp_friction=[0.9999, 0.9999, 0.001, 0.5, 2],
        solref_friction=[0.02, 1],
        solimp_limit=[0.9999, 0.9999, 0.001, 0.5, 2],
        solref_limit=[0.02, 1],
    )
    spec.add_actuator(target="rail", trntype=mujoco.mjtTrn.mjTRN_JOINT).set_to_motor()
    model = spec.compile()
    data = mujoco.MjData(model)

    @functools.cache
    def state(sequence):
        if not sequence:
            return 0.0, 0.0
        data.qpos[0], data.qvel[0] = state(sequence[:-1])
        data.qacc_warmstart[:] = 0
        data.ctrl[0] = strike.POKES[sequence[-1]]
        mujoco.mj_step(model, data, nstep=10)
        return float(data.qpos[0]), float(data.qvel[0])

    return lambda sequence: state(sequence)[0]


def tree(gates, discount, step_limit):
    """Returns two functions: the best return after a sequence of pokes, and the partition of pucks by gates."""
    pucks = [simulation(*values) for values in zip(*strike.properties(np.arange(len(ANSWERS)), 0.7), strict=True)]

    def value(sequence, group):
        shares = np.bincount(ANSWERS[group], minlength=7) / len(group)
        answer = 2 * shares.max() - 1
        if shares.max() == 1 or len(sequence) == step_limit - 1:
            return answer
        values = [answer]
        for poke in range(len(strike.POKES)):
            parts = split((*sequence, poke), group)
            following = sum(len(part) * value((*sequence, poke), part) for part in parts.values())
            values.append(discount * following / len(group))
        return max(values)

    def split(sequence, group):
        parts = {}
        for k in group:
            gate = min(gates, max(0, int(np.floor(pucks[k](sequence) / (0.3 / gates)))))
            parts.setdefault(gate, []).append(k)
        return parts

    return value, split


def test_a_tree_finds_the_same_values():
    solution = ideals.of("strike", time_limit=0.5)
    assert solution.bound == pytest.approx(solution.value)
    value, split = tree(gates=10, discount=0.95, step_limit=5)
    everything = list(range(len(ANSWERS)))
    assert solution.value == pytest.approx(value((), everything), abs=1e-9)
    rng = np.random.default_rng(fresh_seed())
    for puck in rng.integers(len(ANSWERS), size=10):
        pokes, group = tuple(rng.integers(len(strike.POKES), size=3).tolist()), everything
        judged = solution.judge(puck, np.array(pokes))
        for step, poke in enumerate(pokes):
            assert judged.values[step].max() == pytest.approx(value(pokes[:step], group), abs=1e-9)
            parts = split(pokes[: step + 1], group).values()
            worth = 0.95 * sum(len(part) * value(pokes[: step + 1], part) for part in parts) / len(group)
            assert judged.values[step, poke] == pytest.approx(worth, abs=1e-9)
            group = next(part for part in parts if puck in part)
            shares = np.bincount(ANSWERS[group], minlength=7) / len(group)
            np.testing.assert_allclose(judged.beliefs[step + 1], shares, atol=1e-12)
