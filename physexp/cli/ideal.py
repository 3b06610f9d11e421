"""The command that prints what an ideal experimenter achieves."""

from collections.abc import Sequence
import dataclasses
from typing import Annotated, Any, ClassVar, Generic, Literal

import tyro
from tyro.conf import OmitArgPrefixes, Positional

from physexp.analysis import domains
from physexp.cli import options as options_lib
from physexp.cli import printing
from physexp.cli.arguments import OptionalFloat, Switch

_IDEALS = {name: domain.ideal for name, domain in domains.DOMAINS.items() if domain.ideal is not None}


def _domains_of(words: Sequence[str]) -> list[str]:
    """Returns the domain that is named, or else all of which an ideal experimenter is known."""
    return [word for word in words[:1] if word in _IDEALS] or list(_IDEALS)


def _options_of(domain_name: str) -> type:
    return _IDEALS[domain_name].options


@dataclasses.dataclass
class Ideal(Generic[options_lib.Options]):
    """Print what the ideal experimenter achieves: no agent's expected return is larger.

    Attributes:
      options: what can be chosen of it.
      discount: the agent's gamma; by default the domain's.
      json: print JSON.
      keep: write down what can be told apart after every sequence of actions, where physics takes long: the package
        holds it, and it has to be written anew when the suite is changed.
    """

    domains_of: ClassVar = staticmethod(_domains_of)
    options_of: ClassVar = staticmethod(_options_of)

    domain: Annotated[
        Positional[Literal[tuple(_IDEALS)]],  # type: ignore[valid-type]
        tyro.conf.arg(metavar="DOMAIN", help=f"{' or '.join(_IDEALS)}; --help after it lists its options."),
    ]
    options: OmitArgPrefixes[options_lib.Options]
    discount: OptionalFloat = None
    json: Switch = False
    keep: Switch = False

    def run(self) -> None:
        from physexp import suite
        from physexp.analysis.ideal import kept

        ideal = _IDEALS[self.domain]
        defaults = {field.name: field.default for field in dataclasses.fields(ideal.options)}
        settings: dict[str, Any] = {**defaults, **options_lib.chosen(self.options)}
        settings = {name: value for name, value in settings.items() if value is not None}
        tasks = suite.TASKS_BY_DOMAIN[self.domain]
        task = settings.pop("task", tasks[0])
        if task not in tasks:
            raise ValueError(f"task is {task!r}; choose from {', '.join(tasks)}")
        of_task = {field.name for field in dataclasses.fields(suite.options(self.domain))} & set(settings)
        task_kwargs = {name: settings.pop(name) for name in sorted(of_task)}
        discount = domains.find(self.domain).discount if self.discount is None else self.discount
        solution = ideal(task, task_kwargs, discount, **settings)
        with printing.warned_if_slow(
            f"searching for the ideal experimenter of {self.domain}/{task}; that can take minutes"
        ):
            summary = solution.summary()
        printing.show(summary, self.json)
        if self.keep:
            kept.keep(solution)
