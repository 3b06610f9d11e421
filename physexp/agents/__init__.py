"""Acme-style agents, and the trained ones that come with the package (see `load_pretrained`)."""


def load_pretrained(domain_name, task_name, difficulty=None, *, seed=0, greedy=False):
    """Returns the trained agent of a task: an `Actor` that plays its environment.

    Args:
      domain_name, task_name: as for `suite.load`.
      difficulty: for `which_is_heavier`, the difficulty it was trained at: 3, 5 (the default) or 10.
      seed: of the actions that are drawn.
      greedy: take the likeliest action instead of drawing one.

    Raises:
      ValueError: where there is no such agent; it lists those that there are.
    """
    from physexp.agents import pretrained  # torch is imported by those who use it.

    return pretrained.load(domain_name, task_name, difficulty).actor(seed, greedy)
