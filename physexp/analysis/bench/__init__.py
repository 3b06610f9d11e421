"""Performance figures: each is a ratio of two rates measured in turns in the same run, with both rates beside it.

Machines are noisy: a figure is the median over repetitions in which both sides take their turn. A section is imported
when it is measured, so the command line can name all of them at no cost.
"""

from collections.abc import Iterator, Sequence
import dataclasses
import importlib
from pathlib import Path


@dataclasses.dataclass(frozen=True)
class Section:
    """A group of figures.

    Attributes:
      function: what measures it, as `MODULE.FUNCTION` of this package; it yields rows as `measuring.row` makes them.
      extras: modules of extras that it uses.
      by_default: whether it is measured when no section is named.
      reads_results: whether the function takes the folder with the results of the experiments.
    """

    function: str
    extras: tuple[str, ...] = ()
    by_default: bool = True
    reads_results: bool = False


SECTIONS = {
    "reset": Section("simulation.resets"),
    "batch": Section("simulation.batches"),
    "training": Section("training.figures"),
    "peers": Section("peers.figures", extras=("gymnasium", "stable_baselines3", "sb3_contrib")),
    "pixels": Section("pixels.figures"),
    "pretrained": Section("pretrained.figures"),
    "replay": Section("replay.figures"),
    "distributed": Section("distributed.figures", extras=("ray",)),
    "learning": Section("learning.figures", extras=("matplotlib", "pandas"), by_default=False, reads_results=True),
}
"""The sections by name, in the order in which they are measured by default; learning takes hours."""

BY_DEFAULT = tuple(name for name, section in SECTIONS.items() if section.by_default)


def extras(sections: Sequence[str]) -> list[str]:
    """Returns the modules of extras that some sections use, each once."""
    return list(dict.fromkeys(module for name in sections for module in SECTIONS[name].extras))


def run(sections: Sequence[str], results_dir: Path) -> Iterator[dict]:
    """Measures sections in the order given; yields their figures as rows.

    Args:
      sections: names of sections.
      results_dir: the folder with the results of the experiments, for those that read it.
    """
    for name in sections:
        module, _, function = SECTIONS[name].function.partition(".")
        measure = getattr(importlib.import_module(f"{__name__}.{module}"), function)
        yield from measure(results_dir) if SECTIONS[name].reads_results else measure()
