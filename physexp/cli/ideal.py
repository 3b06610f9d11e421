"""The command that prints what an ideal experimenter achieves."""

from collections.abc import Iterator, Mapping, Sequence
import dataclasses
from typing import Any

from physexp.analysis import domains
from physexp.cli import arguments, printing
from physexp.cli.arguments import Group, option, word

_IDEALS = {name: domain.ideal for name, domain in domains.DOMAINS.items() if domain.ideal is not None}


@dataclasses.dataclass
class Ideal:
    """Print what the ideal experimenter achieves: no agent's expected return is larger."""

    words: tuple[str, ...] = word(
        "DOMAIN [TASK]", f"{', '.join(_IDEALS)}; and the task, by default the domain's first", "+"
    )
    discount: float | None = option(None, "the agent's gamma; by default the domain's")
    json: bool = option(False, "print JSON")
    task_kwargs: dict[str, Any] = dataclasses.field(default_factory=dict)

    @classmethod
    def groups(cls, words: Sequence[str], agent: str | None) -> list[Group]:
        """Returns the options of the domain and of its ideal experimenter."""
        return [arguments.of_task(words, lambda domain: [_IDEALS[domain].options] if domain in _IDEALS else [])]

    def run(self) -> None:
        """Solves the task and prints the returns."""
        from physexp import suite

        domain, task = arguments.task_of(self.words)
        if domain not in _IDEALS:
            raise ValueError(f"no ideal experimenter is known of {domain!r}; choose from {', '.join(_IDEALS)}")
        task = task or suite.TASKS_BY_DOMAIN[domain][0]
        ideal, of_task = _IDEALS[domain], dict(self.task_kwargs)
        names = {field.name for field in dataclasses.fields(ideal.options)}
        own = {name: of_task.pop(name) for name in names & of_task.keys()}
        suite.load_task(domain, task, of_task)
        discount = domains.find(domain).discount if self.discount is None else self.discount
        solution = ideal(task, of_task, discount, **own)
        with printing.waiting(f"searching for the ideal experimenter of {domain}/{task}"):
            figures = solution.figures()
        if not self.json:
            printing.tell(*_earned(f"{domain}/{task}", discount, figures))
        with printing.waiting("playing at random, for comparison"):
            summary = solution.summary()
        if not self.json:
            printing.tell(*_compared(summary))
        with printing.waiting("playing with less planning, for comparison"):
            planning = solution.planning()
        if self.json:
            printing.show({**summary, **planning}, as_json=True)
        elif planning:
            printing.tell(*_planned(solution.value, planning))


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
        f"of the answers, after {figures['mean_interactions']:.2f} interactions on average: {', '.join(shares)}."
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
    if "forgetful_value" in summary:
        ours, theirs = (
            ", ".join(f"{number:.2f}" for number in summary[name]) for name in ("by_question", "forgetful_by_question")
        )
        share = summary["forgetful_value"] / summary["value"]
        yield f"Before its answers, one after the other, it makes {ours} interactions."
        yield f"An experimenter that forgets after each answer makes {theirs}, and earns {share:.3f} of the return."


def _planned(value: float, planning: Mapping[str, float]) -> Iterator[str]:
    """Yields sentences about experimenters that plan less, with their scores."""
    floor = planning["floor"]
    told = {
        name: f"{earned:.4f} (score {(earned - floor) / (value - floor):.3f})" if value > floor else f"{earned:.4f}"
        for name, earned in planning.items()
    }
    yield (
        f"The interactions that tell most about the label earn {told['greedy']} at the best moment to stop; with the "
        f"best of equally informative ones, {told['greedy_lucky']}."
    )
    ahead = {name.removeprefix("lookahead_"): text for name, text in told.items() if name.startswith("lookahead_")}
    yield f"Plans of at most {', '.join(ahead)} interactions, made anew after each, earn {', '.join(ahead.values())}."
    if planning["planning_error"] > 5e-5:
        yield f"These returns are too low by {planning['planning_error']:.4f} at most."
