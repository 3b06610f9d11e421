"""The command that prints what an ideal experimenter achieves."""

import dataclasses
from typing import ClassVar, Generic

from tyro.conf import OmitArgPrefixes

from physexp.analysis import domains
from physexp.cli import options as options_lib
from physexp.cli import printing
from physexp.cli.arguments import Domain, OptionalFloat, OptionalTask, Switch

_IDEALS = {name: domain.ideal for name, domain in domains.DOMAINS.items() if domain.ideal is not None}


def _options_of(domain_name: str) -> type:
    """Returns the class of the options of a domain and of its ideal experimenter."""
    of_task = options_lib.of_task(domain_name)
    if domain_name not in _IDEALS:
        return of_task
    bases = (_IDEALS[domain_name].options, of_task)
    return dataclasses.make_dataclass("IdealOptions", [], bases=bases, frozen=True, kw_only=True)


@dataclasses.dataclass
class Ideal(Generic[options_lib.Options]):
    """Print what the ideal experimenter achieves: no agent's expected return is larger.

    Attributes:
      options: what can be chosen of the task, and of what the ideal experimenter can tell apart.
      task: the task; by default the domain's first.
      discount: the agent's gamma; by default the domain's.
      json: print JSON.
      keep: write down what can be told apart after every sequence of actions, where physics takes long: the package
        holds it, and it has to be written anew when the suite is changed.
    """

    domains_of: ClassVar = staticmethod(options_lib.of_domain)
    options_of: ClassVar = staticmethod(_options_of)

    domain: Domain
    options: OmitArgPrefixes[options_lib.Options]
    task: OptionalTask = None
    discount: OptionalFloat = None
    json: Switch = False
    keep: Switch = False

    def run(self) -> None:
        from physexp import suite
        from physexp.analysis.ideal import kept

        if self.domain not in _IDEALS:
            raise ValueError(f"no ideal experimenter is known of {self.domain}; choose from {', '.join(_IDEALS)}")
        tasks = suite.TASKS_BY_DOMAIN[self.domain]
        task = tasks[0] if self.task is None else self.task
        if task not in tasks:
            raise ValueError(f"task is {task!r}; choose from {', '.join(tasks)}")
        ideal, chosen = _IDEALS[self.domain], options_lib.chosen(self.options)
        names = {field.name for field in dataclasses.fields(ideal.options)} & set(chosen)
        own = {name: chosen.pop(name) for name in names}
        discount = domains.find(self.domain).discount if self.discount is None else self.discount
        solution = ideal(task, chosen, discount, **own)
        if self.keep:
            kept.check(solution)  # Before what takes minutes.
        with printing.warned_if_slow(
            f"searching for the ideal experimenter of {self.domain}/{task}; that can take minutes"
        ):
            summary = solution.summary()
        printing.show(summary, self.json)
        if self.keep:
            kept.keep(solution)
