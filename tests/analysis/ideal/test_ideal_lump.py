"""The ideal experimenter of Lump against a tree of all sequences, in single simulations of another model."""

import ideals
import mujoco
import pytest
import trees

from physexp.suite.domains import lump

FORCES = (*lump.PRESSES, 0.0)


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
    return trees.simulation(spec.compile(), FORCES, 10)


def test_a_tree_of_single_simulations_finds_its_value():
    solution = ideals.of("lump")
    assert solution.bound == pytest.approx(solution.value)
    lumps = [simulation(made) for made in lump.ALL_LUMPS]
    found = trees.bounds(lumps, lump.KINDS, lump.PRIOR, wait=2, mark=0.008, discount=0.95, depth=6)
    assert found == pytest.approx([solution.value] * 2, abs=1e-9)
