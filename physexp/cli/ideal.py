"""The command that prints what an ideal experimenter achieves."""

import dataclasses
from typing import Annotated, Any, Literal

import tyro
from tyro.conf import Positional

from physexp.cli import printing
from physexp.cli.arguments import OptionalFloat, OptionalInt, OptionalTask, Switch


@dataclasses.dataclass
class Ideal:
    """Print what the ideal experimenter achieves: no agent's expected return is larger.

    Attributes:
      domain: which_is_heavier (one poke reveals a mass exactly) or towers (physics is known).
      difficulty: of which_is_heavier: the paper's beta, a number >= 1, the larger the easier; by default 5.
      blocks: of which_is_heavier: how many blocks; by default 4.
      task: of towers: the task; by default fist_features.
      resolution: of towers: the smallest difference that can be observed: in metres for features, in differing pixels
        for images; by default 0, where every bit counts.
      discount: the agent's gamma; by default 0.95 for which_is_heavier, 0.98 for towers.
      json: print JSON.
    """

    domain: Annotated[Positional[Literal["which_is_heavier", "towers"]], tyro.conf.arg(metavar="DOMAIN")]
    difficulty: OptionalFloat = None
    blocks: OptionalInt = None
    task: OptionalTask = None
    resolution: OptionalFloat = None
    discount: OptionalFloat = None
    json: Switch = False

    def run(self) -> None:
        if self.domain == "which_is_heavier":
            from physexp.analysis.ideal import which_is_heavier

            _refuse(f"ideal {self.domain}", task=self.task, resolution=self.resolution)
            options = _given(difficulty=self.difficulty, num_blocks=self.blocks, discount=self.discount)
            summary = which_is_heavier.solve(**options).summary()
        else:
            from physexp.analysis.ideal import towers

            _refuse(f"ideal {self.domain}", difficulty=self.difficulty, blocks=self.blocks)
            options = _given(task=self.task, resolution=self.resolution, discount=self.discount)
            summary = towers.solve(**options).summary()
        printing.show(summary, self.json)


def _refuse(owner: str, **options: Any) -> None:
    """Refuses options that were given and that something does not have."""
    for name in _given(**options):
        raise ValueError(f"--{name.replace('_', '-')} is not an option of {owner}; leave it out")


def _given(**options: Any) -> dict[str, Any]:
    """The options that were given: the others are None."""
    return {name: value for name, value in options.items() if value is not None}
