"""Acme-style agents, and the trained ones that come with the package (see `load_pretrained`)."""


def load_pretrained(domain_name, task_name, *values, agent=None, seed=0, greedy=False, **options):
    """Returns the trained agent of a task: an `Actor` that plays its environment.

    Args:
      domain_name, task_name: as for `suite.load`.
      values, options: the options that the task had in training, by position or by name, as in
        `load_pretrained("which_is_heavier", "features", difficulty=3)`; by default the task's own.
      agent: the learner that trained it, as `a3c`; by default the best agent.
      seed: of the actions that are drawn.
      greedy: take the likeliest action instead of drawing one.

    Raises:
      ValueError: where there is no such agent; it lists those that there are.
    """
    from physexp.agents import pretrained  # torch is imported by those who use it.

    return pretrained.load(domain_name, task_name, *values, agent=agent, **options).actor(seed, greedy)
