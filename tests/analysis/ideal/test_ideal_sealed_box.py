"""The ideal experimenter of Sealed Box against a tree of all sequences, simulated with another model."""

import ideals
import mujoco
import numpy as np
import pytest
from seeds import fresh_seed
import trees

from physexp import suite
from physexp.agents import environment_loop
from physexp.suite.domains import sealed_box

FORCES = (*sealed_box.PUSHES.values(), 0.0)
KINDS = np.array([content.kind for content in sealed_box.ALL_CONTENTS])


def simulation(content):
    """Returns a function from a sequence of actions to the position of a box with some content, m."""
    weight = content.share * content.mass
    spec = mujoco.MjSpec()
    spec.option.timestep, spec.option.gravity = 0.004, [0, 0, 0]
    box = spec.worldbody.add_body(mass=content.mass - weight, inertia=[1, 1, 1], explicitinertial=True)
    slide = mujoco.mjtJoint.mjJNT_SLIDE
    box.add_joint(name="rail", type=slide, axis=[1, 0, 0], stiffness=[60, 0, 0], damping=[2, 0, 0])
    inner = box.add_body(mass=weight, inertia=[1, 1, 1], explicitinertial=True)
    inner.add_joint(
        type=slide,
        axis=[1, 0, 0],
        limited=True,
        range=[-content.gap, content.gap],
        solref_limit=[0.008, 1.0],
        solimp_limit=[0.9999, 0.9999, 0.001, 0.5, 2.0],
        stiffness=[content.stiffness, 0, 0],
        damping=[content.damping, 0, 0],
    )
    spec.add_actuator(target="rail", trntype=mujoco.mjtTrn.mjTRN_JOINT).set_to_motor()
    return trees.simulation(spec.compile(), FORCES, 25)


def test_its_value_lies_between_the_bounds_of_a_tree():
    solution = ideals.of("sealed_box")
    assert solution.bound == pytest.approx(solution.value)
    boxes = [simulation(content) for content in sealed_box.ALL_CONTENTS]
    low, high = trees.bounds(boxes, KINDS, sealed_box.PRIOR, wait=4, mark=0.005, discount=0.95, depth=4)
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
