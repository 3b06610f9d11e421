"""The demonstration: trains an agent that experiments in a minute or two."""

from pathlib import Path
import sys

from physexp.analysis.training import config as config_lib
from physexp.analysis.training import curves, playing, progress, trainer, verdict
from physexp.analysis.training import run as run_lib

FRAMES = 20_000
EPISODES = 2000


def config() -> config_lib.TrainConfig:
    """Returns the configuration of the demonstration."""
    agent = config_lib.preset("which_is_heavier", "features").replace(frames=FRAMES)
    return config_lib.TrainConfig(domain="which_is_heavier", task="features", agent=agent)


def run(folder: Path) -> None:
    """Trains Which is Heavier into a folder, prints how the agent does, and draws its learning curve.

    Raises:
      ValueError: if the folder holds a run of another configuration. An earlier demonstration is moved aside.
    """
    demo, wanted = run_lib.Run(folder), config()
    if (folder / "config.json").exists():
        if demo.config != wanted:
            raise ValueError(f"{folder} holds a run that is no demo's; choose another --run-dir")
        with demo.locked():
            demo.set_aside()
    print("Training an agent to find the heaviest of four blocks ...", flush=True)
    with progress.Progress(wanted) as display:
        trainer.train(demo, display, start=wanted)
    if problem := verdict.of_run(demo):
        print(f"{problem}\n{verdict.advice(wanted)}", file=sys.stderr)
    print(f"\nAfter training, over {EPISODES} new episodes each (chance is 25 % right):\n")
    print(f"{'interaction':14} {'right answers':>16} {'pokes':>8} {'return':>8}")
    for interaction in playing.INTERACTIONS:
        figures = playing.evaluate(demo, EPISODES, interaction).summary(wanted.agent.discount)
        half = (figures["success_interval"][1] - figures["success_interval"][0]) / 2
        print(
            f"{interaction:14} {figures['success_rate']:8.1%} +-{half:5.1%} {figures['mean_interactions']:8.2f} "
            f"{figures['mean_return']:8.3f}"
        )
    print(f"\nlearning curve: {curves.draw(demo, folder / 'learning_curve.png')}")
    print(f"the run:        {folder}   (physexp evaluate {folder} --greedy)")
