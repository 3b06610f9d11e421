"""Materials of solid things: contacts of geoms, and stops and dry friction of joints."""

from typing import Any

FRICTION = 0.3  # low enough to slide one block out between two others
WALL_FRICTION = 0.1
# m. Blocks that just touch are in contact, whatever the last bit of their distance: without a margin, rounding decides
# which contacts of a resting tower bear load, and it falls freely for a simulation step.
MARGIN = 1e-6
_NEARLY_RIGID = (0.9999, 0.9999, 0.001, 0.5, 2.0)  # Impedance of a joint's constraints.


def solid(friction: float = FRICTION) -> dict[str, Any]:
    """Returns MJCF attributes of a solid geom; the larger coefficient of friction of two geoms holds between them.

    Contacts are as stiff as a physics step of 5 ms allows (a time constant of two steps), with an impedance close to
    one: at rest, the blocks of a tower settle by less than ten micrometres.
    """
    return dict(
        solref=[0.01, 1.0], solimp=[0.999, 0.999, 0.001, 0.5, 2.0], friction=[friction, 0.005, 0.0001], margin=MARGIN
    )


def dry_friction(physics_timestep: float) -> dict[str, Any]:
    """Returns MJCF attributes of a joint that does not move while the force on it is less than its `frictionloss`.

    MuJoCo's friction is soft: with its defaults a block of Threshold creeps by 18 mm under nine tenths of the force
    that moves it; with these by 0.1 mm in a push of 0.1 s, and by 1 mm in an episode of 1.5 s.
    """
    return dict(solimpfriction=_NEARLY_RIGID, solreffriction=[2 * physics_timestep, 1.0])


def stop(physics_timestep: float, damping_ratio: float = 1.0) -> dict[str, Any]:
    """Returns MJCF attributes of a joint whose limits are hard.

    At a damping ratio of 0.6, a body is pushed out of a limit within a few physics steps, and does not bounce.
    """
    return dict(solimplimit=_NEARLY_RIGID, solreflimit=[2 * physics_timestep, damping_ratio])
