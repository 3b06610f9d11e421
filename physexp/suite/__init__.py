"""The environments: a dm_control domain package (see `load` and `load_batch`)."""

from collections.abc import Mapping
import inspect
from typing import Any
import warnings

from physexp.suite.engine import gl

gl.prepare()

with warnings.catch_warnings():  # dm_control shows all deprecations in its caller's program.
    from dm_control import composer as _  # noqa: F401

from physexp import checks
from physexp.suite import domains as _domains
from physexp.suite.engine import contract
from physexp.suite.engine.batch import BatchEnvironment
from physexp.suite.engine.environment import Environment
from physexp.suite.engine.options import Options
from physexp.suite.engine.seeding import environment_seed

__all__ = [
    "ALL_TASKS",
    "TASKS_BY_DOMAIN",
    "BatchEnvironment",
    "Environment",
    "Options",
    "environment_seed",
    "load",
    "load_batch",
    "load_task",
    "options",
    "tagged",
    "tags",
    "versions",
]

_domains.register()
_DOMAINS = _domains.DOMAINS

TASKS_BY_DOMAIN = {name: tuple(domain.SUITE) for name, domain in _DOMAINS.items()}
"""A mapping from each domain name to the names of its tasks."""

ALL_TASKS = tuple((domain, task) for domain, tasks in TASKS_BY_DOMAIN.items() for task in tasks)
"""All (domain name, task name) pairs."""


def tags(domain_name: str, task_name: str) -> frozenset[str]:
    """Returns the tags of a task: `features` or `pixels`, and those of its domain, such as `fist`."""
    suite = _find_suite(domain_name, task_name)
    return frozenset(tag for tag in suite.tags() if task_name in suite.tagged(tag))


def tagged(*wanted: str) -> tuple[tuple[str, str], ...]:
    """Returns the (domain name, task name) pairs of the tasks that have all of these tags."""
    tags_of = {pair: tags(*pair) for pair in ALL_TASKS}
    known = frozenset().union(*tags_of.values())
    for tag in wanted:
        if tag not in known:
            raise ValueError(f"tag is {checks.shown(tag)}; known tags: {', '.join(sorted(known))}")
    return tuple(pair for pair, its_tags in tags_of.items() if its_tags.issuperset(wanted))


def options(domain_name: str) -> type[Options]:
    """Returns the class of a domain's options: the fields and defaults of its `task_kwargs`."""
    kind: type[Options] = _find_domain(domain_name).Options
    return kind


def versions(domain_name: str) -> tuple[Mapping[str, Any], ...]:
    """Returns the options that make each version of a domain's tasks, from v0 to the one without options."""
    kwargs: tuple[Mapping[str, Any], ...] = getattr(_find_domain(domain_name), "VERSIONS", ({},))
    return kwargs


def load(
    domain_name: str,
    task_name: str,
    task_kwargs: Mapping[str, Any] | None = None,
    environment_kwargs: Mapping[str, Any] | None = None,
    visualize_reward: bool = False,
) -> Environment:
    """Returns an environment, as `dm_control.suite.load` does.

    Args:
      domain_name: one of `TASKS_BY_DOMAIN`.
      task_name: one of `TASKS_BY_DOMAIN[domain_name]`.
      task_kwargs: `random` (a seed or a RandomState), `control_timestep` (s), `time_limit` (s), and the domain's own:
        the fields of `options(domain_name)`.
      environment_kwargs: `raise_exception_on_physics_error`, if the simulation diverges, instead of ending the episode;
        and `flat_observation`: one vector, `observations`, of all arrays sorted by name, as in dm_control.
      visualize_reward: colour the floor by the outcome at the end of an episode.

    Raises:
      ValueError: for an unknown name or a bad keyword argument.
    """
    chosen = {"visualize_reward": visualize_reward, **_checked("task_kwargs", task_kwargs)}
    task = load_task(domain_name, task_name, chosen)
    environment: Environment = _call(Environment, "environment_kwargs", environment_kwargs, task)
    return environment


def load_batch(
    domain_name: str,
    task_name: str,
    num_environments: int,
    task_kwargs: Mapping[str, Any] | None = None,
    num_threads: int = 1,
) -> BatchEnvironment:
    """Returns many environments of one task that step together.

    Environment `i` is, bit for bit, the one that `load` returns for `random=environment_seed(seed, i)`.

    Args:
      domain_name, task_name, task_kwargs: as for `load`.
      num_environments: number of environments, from 1 to 65,536.
      num_threads: threads that simulate, from 1 to 1,024.

    Raises:
      ValueError: for an unknown name or a bad argument.
    """
    task = load_task(domain_name, task_name, task_kwargs)
    if task.options.visualize_reward:
        raise ValueError("visualize_reward is True; give False to a batch, or load one environment")
    return BatchEnvironment(task, num_environments, num_threads)


def load_task(domain_name: str, task_name: str, task_kwargs: Mapping[str, Any] | None = None) -> contract.Task:
    """Returns the task that an environment or a batch plays; arguments as for `load`."""
    factory = _find_suite(domain_name, task_name)[task_name]
    task: contract.Task = factory(_call(_find_domain(domain_name).Options, "task_kwargs", task_kwargs))
    return task


def _find_domain(domain_name: Any) -> Any:
    """Returns the module of a domain."""
    if not isinstance(domain_name, str) or domain_name not in _DOMAINS:
        raise ValueError(f"domain_name is {checks.shown(domain_name)}; known domains: {', '.join(_DOMAINS)}")
    return _DOMAINS[domain_name]


def _find_suite(domain_name: Any, task_name: Any) -> Any:
    """Returns the tasks of a domain that has one of this name."""
    suite = _find_domain(domain_name).SUITE
    if not isinstance(task_name, str) or task_name not in suite:
        raise ValueError(f"task_name is {checks.shown(task_name)}; tasks of {domain_name}: {', '.join(suite)}")
    return suite


def _call(function: Any, name: str, kwargs: Any, *args: Any) -> Any:
    """Calls `function` with keyword arguments whose names are checked first."""
    kwargs = _checked(name, kwargs)
    allowed = [parameter.name for parameter in list(inspect.signature(function).parameters.values())[len(args) :]]
    unknown = set(kwargs) - set(allowed)
    if unknown:
        raise ValueError(f"{name} has {', '.join(sorted(map(checks.shown, unknown)))}; allowed: {', '.join(allowed)}")
    return function(*args, **kwargs)


def _checked(name: str, kwargs: Any) -> dict[str, Any]:
    """Returns keyword arguments as a dictionary; raises ValueError for anything else."""
    if kwargs is not None and not isinstance(kwargs, Mapping):
        raise ValueError(f"{name} is {checks.shown(kwargs)}; give a dictionary")
    return dict(kwargs or {})
