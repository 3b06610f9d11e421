"""The ideal experimenter of Sealed Box against a tree of all sequences, simulated with another model."""

import functools

import ideals
import mujoco
import numpy as np
import pytest
from seeds import fresh_seed

from physexp import suite
from physexp.agents import environment_loop
from physexp.suite.domains import sealed_box

FORCES = (*sealed_box.PUSHES.values(), 0.0)
KINDS = np.array([content.kind for content in sealed_box.ALL_CONTENTS])


def simulation(content):
    """Returns a function from a sequence of actions to the position of a box with some content, m."""
    weight = content.share * content.mass
    spec = mujoco.MjSpec()
    spec.option.timestep, spec.option.gravity = 0.02, [0, 0, 0]
    box = spec.worldbody.add_body(mass=content.mass - weight, inertia=[1, 1, 1], explicitinertial=True)
    slide = mujoco.mjtJoint.mjJNT_SLIDE
    box.add_joint(name="rail", type=slide, axis=[1, 0, 0], stiffness=[60, 0, 0], damping=[2, 0, 0])
    inner = box.add_body(mass=weight, inertia=[1, 1, 1], explicitinertial=True)
    inner.add_joint(
        type=slide,
        axis=[1, 0, 0],
        limited=True,
        range=[-content.gap, content.gap],
        stiffness=[content.stiffness, 0, 0],
        damping=[content.damping, 0, 0],
    )
    spec.add_actuator(target="rail", trntype=mujoco.mjtTrn.mjTRN_JOINT).set_to_motor()
    model = spec.compile()
    data = mujoco.MjData(model)

    @functools.cache
    def state(sequence):
        if not sequence:
            return (0.0, 0.0), (0.0, 0.0)
        data.qpos[:], data.qvel[:] = state(sequence[:-1])
        data.ctrl[:] = FORCES[sequence[-1]]
        mujoco.mj_step(model, data, nstep=5)
        return tuple(data.qpos), tuple(data.qvel)

    return lambda sequence: state(sequence)[0][0]


def tree(mark, discount, depth):
    """Bounds on the best return by all sequences up to a length; for the upper one, one more action reveals all."""
    boxes = [simulation(content) for content in sealed_box.ALL_CONTENTS]

    def value(sequence, group):
        weights = np.bincount(KINDS[group], sealed_box.PRIOR[group], minlength=4)
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
                reading = round(boxes[k](longer) / mark) if action == 4 else 0
                parts.setdefault(reading, []).append(k)
            found = np.zeros(2)
            for part in parts.values():
                found += sealed_box.PRIOR[part].sum() / weights.sum() * np.array(value((*sequence, action), part))
            low, high = max(low, discount * found[0]), max(high, discount * found[1])
        return low, high

    return value((), list(range(len(KINDS))))


def test_its_value_lies_between_the_bounds_of_a_tree():
    solution = ideals.of("sealed_box")
    assert solution.bound == pytest.approx(solution.value)
    low, high = tree(mark=0.005, discount=0.95, depth=4)
    assert low - 1e-9 <= solution.value <= high + 1e-9
    assert high - low < 0.3


def test_it_pushes_first_and_waits_in_every_episode():
    solution = ideals.of("sealed_box")
    assert solution.policy.action != 4
    for hypothesis in range(len(KINDS)):
        node, actions = solution.policy, []
        while node.action is not None:
            actions.append(node.action)
            node = node.children[hypothesis]
        assert 4 in actions


@pytest.mark.parametrize("domain, time_limit", [("sealed_box", 0.5), ("strike", 0.4), ("lump", 0.6)])
def test_it_plays_as_well_from_images(domain, time_limit):
    solution = ideals.of(domain, "pixels", time_limit=time_limit)
    assert solution.value == pytest.approx(ideals.of(domain, time_limit=time_limit).value, abs=1e-12)
    environment = suite.load(domain, "pixels", task_kwargs={"random": fresh_seed(), "time_limit": time_limit})
    loop = environment_loop.EnvironmentLoop(environment, solution.actor())
    interactions, right, _ = solution.outcomes()
    for _ in range(4):
        episode, hidden = loop.run_episode(), environment.task.hidden
        assert episode["episode_return"] == (1 if right[hidden] else -1)
        assert episode["episode_length"] == interactions[hidden] + 1
