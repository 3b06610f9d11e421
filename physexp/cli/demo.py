"""The demonstration: trains an agent that experiments in a minute or two."""

import dataclasses
from pathlib import Path

from physexp import extras
from physexp.analysis.training import config as config_lib
from physexp.cli import printing
from physexp.cli.arguments import option

FRAMES = 20_000
EPISODES = 2000


def config() -> config_lib.TrainConfig:
    """Returns the configuration of the demonstration."""
    agent = config_lib.preset("which_is_heavier", "features").replace(frames=FRAMES)
    return config_lib.TrainConfig(domain="which_is_heavier", task="features", agent=agent)


@dataclasses.dataclass
class Demo:
    """Train an agent for a minute or two, and compare it with randomized interaction."""

    run_dir: Path = option(Path("runs/demo"), "the folder of the run; another demonstration in it is moved aside")

    def run(self) -> None:
        """Trains Which is Heavier, prints how the agent does, and draws its learning curve."""
        extras.require("matplotlib")
        from physexp.analysis.training import playing, progress, trainer, verdict
        from physexp.analysis.training import run as run_lib

        folder = self.run_dir
        demo, wanted = run_lib.Run(folder), config()
        if (folder / "config.json").exists():
            if demo.config != wanted:
                raise ValueError(f"{folder} holds a run that is no demo's; choose another --run-dir")
            with demo.locked():
                demo.set_aside()
        printing.tell("Training an agent to find the heaviest of four blocks ...")
        with progress.Progress(wanted) as display:
            trainer.train(demo, display, start=wanted)
        if problem := verdict.of_run(demo):
            printing.warn(problem, verdict.advice(wanted))
        printing.tell("", f"After training, over {EPISODES} new episodes each (chance is 25 % right):", "")
        rows = []
        for interaction in playing.INTERACTIONS:
            figures = playing.evaluate(demo, EPISODES, interaction).summary(wanted.agent.discount)
            right, pokes, earned = (figures[name] for name in ("success_rate", "mean_interactions", "mean_return"))
            rows.append({"interaction": interaction, "right answers": right, "pokes": pokes, "return": earned})
        printing.show(rows)
        self._draw(demo.metrics(), folder / "learning_curve.png")
        printing.tell(f"the run: {folder} (physexp evaluate {folder} --greedy)")

    def _draw(self, rows: list[dict[str, float]], path: Path) -> None:
        """Draws the success rate and the interactions of training against environment steps, as a PNG."""
        from physexp.agents import files
        from physexp.analysis.data import plots

        frames = [row["frames"] / 1e6 for row in rows]
        with plots.style():
            drawn, (top, bottom) = plots.new(rows=2, width=4.5, height=1.8, sharex=True)
            top.plot(frames, [row["success_rate"] for row in rows], color=plots.COLORS[1])
            plots.reference(top, 1 / config().load_task().num_labels, "chance")
            top.set(ylabel="share of right answers", ylim=(0, 1.02), title=config().name)
            bottom.plot(frames, [row["interactions"] for row in rows], color=plots.COLORS[2])
            bottom.set(xlabel="environment steps, millions", ylabel="interactions in an episode", ylim=(0, None))
        files.write_atomically(path, plots.png(drawn))
        printing.tell("", f"learning curve: {path}")
