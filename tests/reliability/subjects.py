"""Small runs, agents and records to attack, which are easily compared with whole ones."""

from pyarrow import parquet
import torch

from physexp.agents import networks, pretrained
from physexp.agents.ppo import config as ppo
from physexp.analysis.training import config as config_lib
from physexp.analysis.training import finding, recorder, trainer
from physexp.analysis.training import run as run_lib

SMALL = ppo.PPOConfig(num_threads=1, num_environments=4, num_minibatches=2, frames=60, checkpoint_seconds=1e-9)
"""One process, and a checkpoint after each of its few updates."""


def config(**agent) -> config_lib.TrainConfig:
    return config_lib.TrainConfig(
        domain="which_is_heavier", task="features", task_kwargs={"difficulty": 10.0}, agent=SMALL.replace(**agent)
    )


def words(run: run_lib.Run) -> list:
    """The command that continues a run."""
    return ["train", "which_is_heavier", "features", "--agent", "ppo", "--run-dir", run.path, "--resume"]


OPTIONS = [
    *["--agent", "ppo", "--difficulty", 10, "--replay-every", 0, "--num-threads", 1],
    *["--num-environments", 4, "--num-minibatches", 2, "--frames", SMALL.frames],
    *["--checkpoint-seconds", SMALL.checkpoint_seconds],
]
"""`config` as the command line has it, except for the task's preset."""


def train(path) -> None:
    """Trains a run to its end, from the start if it has no checkpoint, with a row of metrics for each update."""
    recorder.ROW_SECONDS = -1.0
    run = run_lib.Run(path)
    trainer.train(run, start=None if run.checkpointer.paths() else config())


def contents(run: run_lib.Run):
    """The rows, episodes and last tensors of a run, without times."""
    timed = {"seconds", "frames_per_second"}
    rows = [{name: value for name, value in row.items() if name not in timed} for row in run.metrics()]
    episodes = parquet.read_table(run.path / "episodes.parquet").to_pylist()
    tensors, facts = run.checkpointer.latest()
    return rows, episodes, {name: value.numpy().tobytes() for name, value in tensors.items()}, facts["episodes"]


def network(number: float) -> networks.RecurrentActorCritic:
    """A network of the small agent, of which every variable is a number."""
    made = trainer.make_network(config())
    with torch.no_grad():
        for value in made.state_dict().values():
            value.fill_(number)
    return made


def publish(folder, number: int) -> None:
    """Writes such a network as a published agent."""
    facts = {"seed": 0, "frames": number, "network": finding.network_facts(config())}
    pretrained.save(network(number), config().to_json() | facts, folder)
