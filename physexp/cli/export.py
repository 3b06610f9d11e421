"""The command that writes trajectories to learn from."""

import dataclasses
from pathlib import Path

from physexp.cli import printing
from physexp.cli.arguments import option
from physexp.cli.score import Playing, playing_in


@dataclasses.dataclass
class Export(Playing):
    """Play episodes and write all of them, with hidden properties and the ideal's beliefs and values, to learn from.

    An interrupted export goes on in its folder.
    """

    episodes: int = option(help="number of episodes of each task")
    minari: bool = option(False, "write a Minari data set for each task, too")
    words: bool = option(False, "write a file of conversations in words for each task, too, to tune language models")
    seed: int | None = option(None, "seed of the environments; by default one that no score uses")
    output: Path | None = option(None, "the folder for all files; by default a new one under exports/")

    def run(self) -> None:
        """Plays and writes the files."""
        from physexp import extras
        from physexp.analysis.score import exporting, playing, targets
        from physexp.analysis.training import progress

        if self.minari:
            extras.require("minari")
        target = targets.find(self.target, self.greedy)
        chosen = target.choose(self.tasks, self.track)
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
                in_words=self.words,
                show=show,
            )
        for name, facts in found["tasks"].items():
            if not facts["judged"]:
                printing.warn(
                    f"{name} has no columns belief and values: no ideal experimenter is known that says what every "
                    "action there is worth"
                )
        names = {"episodes": "episodes", "steps": "steps", "success_rate": "right", "mean_return": "return"}
        rows = [
            {"task": task, **{name: facts[key] for key, name in names.items()}}
            for task, facts in found["tasks"].items()
        ]
        printing.show(found if self.json else rows, self.json)
        if not self.json:
            printing.tell(str(folder))
