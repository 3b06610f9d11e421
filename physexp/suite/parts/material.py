"""What solid things are made of: contacts of geoms that can touch another, and stops and dry friction of joints."""

from typing import Any

FRICTION = 0.3  # low enough to slide one block out between two others
WALL_FRICTION = 0.1
# m. Blocks that just touch are in contact, whatever the last bit of their distance: without a margin, rounding decides
# which contacts of a resting tower bear load, and it falls freely for a simulation step.
MARGIN = 1e-6
_NEARLY_RIGID = (0.9999, 0.9999, 0.001, 0.5, 2.0)  # Impedance of a joint's constraints.


def solid(friction: float = FRICTION) -> dict[str, Any]:
    """MJCF attributes of a solid geom.

    Contacts are as stiff as a physics step of 5 ms allows (a time constant of two steps), with an impedance close to
    one: at rest, the blocks of a tower settle by less than ten micrometres.

    Args:
      friction: sliding friction coefficient; the larger one of two geoms holds between them.
    """
    return dict(
        solref=[0.01, 1.0],
        solimp=[0.999, 0.999, 0.001, 0.5, 2.0],
        friction=[friction, 0.005, 0.0001],
        margin=MARGIN,
    )


def dry_friction(physics_timestep: float) -> dict[str, Any]:
    """MJCF attributes of a joint that does not move while the force on it is less than its `frictionloss`.

    MuJoCo's friction is soft: with its defaults a block of Threshold creeps by 18 mm under nine tenths of the force
    that moves it; with these by 0.1 mm in a push of 0.1 s, and by 1 mm in an episode of 1.5 s.

    Args:
      physics_timestep: s.
    """
    return dict(solimpfriction=_NEARLY_RIGID, solreffriction=[2 * physics_timestep, 1.0])


def stop(physics_timestep: float, damping_ratio: float = 1.0) -> dict[str, Any]:
    """MJCF attributes of a joint whose limits are hard.

    Args:
      physics_timestep: s.
      damping_ratio: of what runs into a limit; at 0.6, it is pushed out within a few physics steps, and none bounces.
    """
    return dict(solimplimit=_NEARLY_RIGID, solreflimit=[2 * physics_timestep, damping_ratio])
