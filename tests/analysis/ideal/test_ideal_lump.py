"""The ideal experimenter of Lump against a tree of all sequences, in single simulations of another model."""

import functools

import ideals
import mujoco
import numpy as np
import pytest

from physexp.suite.domains import lump

FORCES = (*lump.PRESSES, 0.0)
WAIT = 2


def simulation(made):
    """Returns a function from a sequence of actions to the position of a lump's plate, m."""
    spec = mujoco.MjSpec()
    spec.option.timestep, spec.option.gravity = 0.01, [0, 0, 0]
    spec.option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    tendon = spec.add_tendon(stiffness=[made.spring, 0, 0], damping=[lump._SPRING_DAMPING, 0, 0])
    own = {"plate": dict(damping=[lump._PLATE_DAMPING, 0, 0])}
    own["core"] = dict(stiffness=[made.stiffness, 0, 0], damping=[made.damping, 0, 0], frictionloss=made.friction)
    nearly_rigid = dict(solref_friction=[0.02, 1], solimp_friction=[0.9999, 0.9999, 0.001, 0.5, 2])
    for name, sign in (("plate", 1), ("core", -1)):
        body = spec.worldbody.add_body(mass=0.05, inertia=[1, 1, 1], explicitinertial=True)
        body.add_joint(name=name, type=mujoco.mjtJoint.mjJNT_SLIDE, **own[name], **nearly_rigid)
        tendon.wrap_joint(name, sign)
    spec.add_actuator(target="plate", trntype=mujoco.mjtTrn.mjTRN_JOINT).set_to_motor()
    model = spec.compile()
    data = mujoco.MjData(model)

    @functools.cache
    def state(sequence):
        if not sequence:
            return (0.0, 0.0), (0.0, 0.0)
        data.qpos[:], data.qvel[:] = state(sequence[:-1])
        data.ctrl[:] = FORCES[sequence[-1]]
        mujoco.mj_step(model, data, nstep=10)
        return tuple(data.qpos), tuple(data.qvel)

    return lambda sequence: state(sequence)[0][0]


def tree(mark, discount, depth):
    """Bounds on the best return by all sequences up to a length; for the upper one, one more action reveals all."""
    lumps = [simulation(made) for made in lump.ALL_LUMPS]

    def value(sequence, group):
        weights = np.bincount(lump.KINDS[group], lump.PRIOR[group], minlength=4)
        answer = 2 * weights.max() / weights.sum() - 1
        if weights.max() == weights.sum():
            return answer, answer
        if len(sequence) == depth:
            return answer, max(answer, discount)
        low = high = answer
        for action in range(len(FORCES)):
            parts = {}
            for k in group:
                longer = (*sequence, action)
                reading = round(lumps[k](longer) / mark) if action == WAIT else 0
                parts.setdefault(reading, []).append(k)
            found = np.zeros(2)
            for part in parts.values():
                found += lump.PRIOR[part].sum() / weights.sum() * np.array(value((*sequence, action), part))
            low, high = max(low, discount * found[0]), max(high, discount * found[1])
        return low, high

    return value((), list(range(len(lump.KINDS))))


def test_a_tree_of_single_simulations_finds_its_value():
    solution = ideals.of("lump")
    assert solution.bound == pytest.approx(solution.value)
    assert tree(mark=0.008, discount=0.95, depth=6) == pytest.approx([solution.value] * 2, abs=1e-9)
