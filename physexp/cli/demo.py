"""The demonstration: trains an agent in about a minute, and compares it with the ideal experimenter."""

import dataclasses
from pathlib import Path

from physexp import extras
from physexp.analysis.training import config as config_lib
from physexp.cli import printing
from physexp.cli.arguments import option

FRAMES = 20_000
EPISODES = 1_000


def config() -> config_lib.TrainConfig:
    """Returns the configuration of the demonstration."""
    agent = config_lib.preset("threshold", "features").replace(frames=FRAMES, answers_revealed=True)
    return config_lib.TrainConfig(domain="threshold", task="features", agent=agent)


@dataclasses.dataclass
class Demo:
    """Train an agent for about a minute, and compare it with the ideal experimenter."""

    run_dir: Path = option(Path("runs/demo"), "the folder of the run; another demonstration in it is moved aside")

    def run(self) -> None:
        """Trains, scores the agent, draws its learning curve, and writes a replay."""
        extras.require("matplotlib")
        from physexp.analysis import replay
        from physexp.analysis.score import protocol
        from physexp.analysis.training import progress, trainer, verdict
        from physexp.analysis.training import run as run_lib

        folder, wanted = self.run_dir, config()
        demo = run_lib.Run(folder)
        if (folder / "config.json").exists():
            if demo.config != wanted:
                raise ValueError(f"{folder} holds a run that is no demo's; choose another --run-dir")
            with demo.locked():
                demo.set_aside()
        question = protocol.question(wanted.domain, wanted.task)
        worth = ", ".join(f"{question.discount**count:.2f}" for count in range(1, 5))
        printing.tell(
            f"{question.question} Looking does not tell: {question.num_interactions} experiments do.",
            f"An answer at once is worth 1 if it is right and -1 if not; after 1, 2, 3, 4 experiments {worth}.",
            "",
            "Training an agent ...",
        )
        with progress.Progress(wanted) as display:
            trainer.train(demo, display, start=wanted)
        if problem := verdict.of_run(demo):
            printing.warn(problem, verdict.advice(wanted))
        ideal = self._compare(question)
        self._draw(demo.metrics(), ideal, folder / "learning_curve.png")
        printing.tell(f"replay: {replay.replay([str(folder)], 4, folder / 'replay.rrd')} (open it with rerun)")
        commands = ("score {} --quick", "replay {} --view")
        printing.tell(*(f"next: physexp {command.format(folder)}" for command in commands))
        printing.tell(f"next: physexp play {wanted.domain} {wanted.task}")

    def _compare(self, question) -> float:
        """Plays the instances of the score with the agent and prints its figures; returns the ideal's mean return."""
        from physexp.analysis.score import scoring, targets
        from physexp.analysis.training import progress

        printing.tell("", f"Playing {EPISODES:,} new episodes, and judging each action ...")
        target = targets.find(str(self.run_dir))
        with progress.bar("episodes", EPISODES) as show:
            found = scoring.score(target, [question], EPISODES, self.run_dir / "score", show=show)
        (figures,) = found["tasks"].values()
        ideal, floor = figures["ideal"], figures["floor"]
        earned = floor + figures["raw_score"] * (ideal - floor)
        rows = [
            {"": "the ideal experimenter", "return": ideal, "experiments": figures["ideal_interactions"]},
            {"": "this agent", "return": earned, "experiments": figures["mean_interactions"]},
            {"": "an answer at once", "return": figures["at_once"], "experiments": 0.0},
            {"": "random actions", "return": figures["random"], "experiments": ""},
        ]
        printing.tell("")
        printing.show(rows)
        costs = [f"{kind} {cost:.4f}" for kind, cost in figures["mistakes"].items() if cost > 0]
        lost = f", and it lost the rest by mistakes: {', '.join(costs)}" if costs else ""
        printing.tell("", f"right answers: {figures['success_rate']:.1%}; score: {figures['score']:.4f} of 1{lost}")
        return ideal

    def _draw(self, rows: list[dict[str, float]], ideal: float, path: Path) -> None:
        """Draws the return and the interactions of training against environment steps, as a PNG."""
        from physexp.agents import files
        from physexp.analysis.data import plots

        frames = [row["frames"] for row in rows]
        with plots.style():
            drawn, (top, bottom) = plots.new(rows=2, width=4.5, height=1.8, sharex=True)
            top.plot(frames, [row["greedy_return"] for row in rows], color=plots.COLORS[1])
            plots.reference(top, ideal, "ideal experimenter")
            top.set(ylabel="return", ylim=(None, 1.02), title="the agent's training")
            bottom.plot(frames, [row["interactions"] for row in rows], color=plots.COLORS[2])
            bottom.set(xlabel="environment steps", ylabel="experiments in an episode", ylim=(0, None))
        files.write_atomically(path, plots.png(drawn))
        printing.tell("", f"learning curve: {path}")
