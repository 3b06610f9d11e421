"""Performance figures: ratios of two rates that are measured in turns in the same run.

Machines are noisy, so a figure is the median over repetitions in which both sides take turns. A section is imported
when it is measured: the command line lists all sections without the time that their imports take.
"""

from collections.abc import Iterator, Sequence
import importlib

SECTIONS = {
    "reset": "simulation.resets",
    "batch": "simulation.batches",
    "training": "agents.training",
    "peers": "peers.training",
    "pixels": "pixels.figures",
    "pretrained": "agents.pretrained_agents",
    "replay": "replay.figures",
}
"""Names of sections, in the order in which they are measured, and the function of this package that yields the rows."""

EXTRAS = {"peers": ("gymnasium", "stable_baselines3", "sb3_contrib")}
"""Modules of extras that a section uses."""


def extras(sections: Sequence[str]) -> list[str]:
    """Returns the modules of extras that some sections use."""
    return [module for name in sections for module in EXTRAS.get(name, ())]


def run(sections: Sequence[str]) -> Iterator[dict]:
    """Yields the figures of some sections, as `measuring.row` returns them."""
    for name in sections:
        module, _, function = SECTIONS[name].partition(".")
        yield from getattr(importlib.import_module(f"{__name__}.{module}"), function)()
