"""What solid things are made of: the contact parameters of every geom that can touch another."""

FRICTION = 0.3  # low enough to slide one block out between two others
WALL_FRICTION = 0.1
# m. Blocks that just touch are in contact, whatever the last bit of their distance: without a margin, rounding decides
# which contacts of a resting tower bear load, and it falls freely for a simulation step.
MARGIN = 1e-6


def solid(friction: float = FRICTION) -> dict:
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
