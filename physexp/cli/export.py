"""The command that writes trajectories to learn from."""

import dataclasses
from pathlib import Path
from typing import Annotated, Literal

import tyro
from tyro.conf import Positional

from physexp.cli import printing
from physexp.cli.arguments import OptionalInt, OptionalPath, Switch
from physexp.cli.score import playing_in


@dataclasses.dataclass
class Export:
    """Play episodes and write all of them, with hidden properties and the ideal's beliefs and values, to learn from.

    Attributes:
      episodes: of each task.
      tasks: what is played, as DOMAIN/TASK; by default all that the target can play of --observations.
      observations: the kind of tasks that are played where none are named.
      minari: write a data set of Minari for each task, too.
      seed: of the environments; by default one whose episodes nobody is scored on.
      greedy: a trained agent takes its likeliest actions instead of drawing them.
      timeout: for each call of an agent of your own, s.
      output: the folder for all files; by default a new one named after the target, under exports/. An interrupted
        export goes on in its folder.
      json: print JSON.
    """

    target: Annotated[
        Positional[str],
        tyro.conf.arg(metavar="TARGET", help="the player: as for `physexp score`."),
    ]
    episodes: int
    tasks: Annotated[tuple[str, ...], tyro.conf.arg(metavar="DOMAIN/TASK ...", help_behavior_hint="")] = ()
    observations: Literal["features", "pixels", "all"] = "features"
    minari: Switch = False
    seed: OptionalInt = None
    greedy: Switch = False
    timeout: float = 60.0
    output: OptionalPath = None
    json: Switch = False

    def run(self) -> None:
        from physexp import extras
        from physexp.analysis.score import exporting, playing, targets
        from physexp.analysis.training import progress

        if self.minari:
            extras.require("minari")
        target = targets.find(self.target, self.greedy)
        chosen = target.choose(self.tasks, self.observations)
        folder = self.output or playing.unfinished(Path("exports") / targets.file_name(self.target))
        with playing_in(folder), progress.bar("episodes", self.episodes * len(chosen)) as show:
            found = exporting.export(
                target,
                chosen,
                self.episodes,
                folder,
                seed=exporting.SEED if self.seed is None else self.seed,
                timeout=self.timeout,
                as_minari=self.minari,
                show=show,
            )
        for name, facts in found["tasks"].items():
            if not facts["judged"]:
                printing.warn(
                    f"{name} has no columns belief and values: no ideal experimenter is known that says what every "
                    "action there is worth"
                )
        if self.json:
            printing.show(found, as_json=True)
            return
        names = {"episodes": "episodes", "steps": "steps", "success_rate": "right", "mean_return": "return"}
        printing.show_rows(
            [
                {"task": task, **{name: facts[key] for key, name in names.items()}}
                for task, facts in found["tasks"].items()
            ],
            as_json=False,
        )
        printing.tell(str(folder))
