"""How many of the four blocks an episode of Which is Heavier has looked at."""

from physexp.suite.domains import which_is_heavier


def counted(frame):
    """Returns a DataFrame of episodes with `blocks`, the number that were poked, in place of `actions`."""
    poked = [len({action for action in actions if action < which_is_heavier.NUM_BLOCKS}) for actions in frame.actions]
    return frame.drop(columns="actions").assign(blocks=poked)
