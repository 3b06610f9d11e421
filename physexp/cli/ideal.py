"""The command that prints what an ideal experimenter achieves."""

from collections.abc import Iterator, Mapping
import contextlib
import dataclasses
import sys
from typing import Any, ClassVar, Generic

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
      options: options of the task and of the ideal experimenter.
      task: the task; by default the domain's first.
      discount: the agent's gamma; by default the domain's.
      json: print JSON.
    """

    domains_of: ClassVar = staticmethod(options_lib.of_domain)
    options_of: ClassVar = staticmethod(_options_of)

    domain: Domain
    options: OmitArgPrefixes[options_lib.Options]
    task: OptionalTask = None
    discount: OptionalFloat = None
    json: Switch = False

    def run(self) -> None:
        from physexp import suite

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
        with _waiting(f"searching for the ideal experimenter of {self.domain}/{task}"):
            figures = solution.figures()
        if not self.json:
            printing.tell(*_earned(f"{self.domain}/{task}", discount, figures))
        with _waiting("playing at random, for comparison"):
            summary = solution.summary()
        if self.json:
            printing.show(summary, as_json=True)
        else:
            printing.tell(*_compared(summary))


@contextlib.contextmanager
def _waiting(line: str) -> Iterator[None]:
    """Returns a context that tells what is going on: with a clock on a terminal, elsewhere once if it takes long."""
    if not sys.stderr.isatty():
        with printing.warned_if_slow(f"{line}; that can take minutes"):
            yield
        return
    from rich import console, progress

    columns = progress.SpinnerColumn(), progress.TextColumn("{task.description}"), progress.TimeElapsedColumn()
    with progress.Progress(*columns, console=console.Console(stderr=True), transient=True) as shown:
        shown.add_task(line, total=None)
        yield


def _earned(name: str, discount: float, figures: Mapping[str, Any]) -> Iterator[str]:
    """Yields sentences about the policy of a task."""
    value, bound = (round(figures[name], 4) for name in ("value", "bound"))
    unit = f"(discounted return, gamma {discount:g})"
    if value == bound:
        yield f"The ideal experimenter of {name} earns {value:.4f} {unit}."
    else:
        yield f"The ideal experimenter of {name} earns between {value:.4f} and {bound:.4f} {unit}."
    shares = [f"{number} in {share:.1%}" for number, share in figures["histogram"].items() if share >= 5e-4]
    yield (
        f"{'It' if value == bound else 'The policy that earns the lower figure'} is right in {figures['accuracy']:.2%} "
        f"of the episodes, after {figures['mean_interactions']:.2f} interactions on average: {', '.join(shares)}."
    )


def _compared(summary: Mapping[str, Any]) -> Iterator[str]:
    """Yields sentences about the accuracy of bounds, and about policies for comparison."""
    if "value_error" in summary:
        errors = (f"{summary[name]:.4f}" for name in ("value_error", "bound_error"))
        yield f"This is known from below and from above with standard errors of {' and '.join(errors)}."
    if "at_once" in summary:
        random = [f"{summary[name]:.4f}" for name in ("random_value", "random_bound") if name in summary]
        yield f"An answer without any interaction earns {summary['at_once']:.4f}."
        yield f"Random interactions with the best answers at the best moment earn {' to '.join(random)}."
