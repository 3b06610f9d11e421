"""A policy in Gymnasium's manner: `physexp score halving:policy --tasks threshold/features`."""


def policy(observation, state):
    """Halves the levels of force that are left: actions 0 to 7 push with them, 8 to 15 answer."""
    low, high, pushed = state or (0, 7, None)
    if pushed is not None:
        low, high = (low, pushed) if observation["slid"] == 1 else (pushed + 1, high)
    if low == high:
        return 8 + low, None
    pushed = (low + high) // 2
    return pushed, (low, high, pushed)
