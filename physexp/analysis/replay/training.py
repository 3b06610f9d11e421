"""Replays written during training, always of the same instance."""

from collections.abc import Mapping

import torch

from physexp.analysis.replay import recording, writing
from physexp.analysis.training import config as config_lib
from physexp.analysis.training import run as run_lib
from physexp.analysis.training import trainer

SEED = 4_000_003  # Of the environment, apart from those of training, of evaluation, of the score and of exports.


def write(run: run_lib.Run, config: config_lib.TrainConfig, frames: int, variables: Mapping[str, torch.Tensor]) -> None:
    """Plays an episode with a network's variables and writes it into a run's folder; raises as `writing.write`.

    It does nothing until `replay_every` frames have passed since the last replay.
    """
    folder = run.path / "replays"
    earlier = [int(path.stem) for path in folder.glob("*.rrd") if path.stem.isdecimal()]
    if frames - max((each for each in earlier if each <= frames), default=0) < config.replay_every:
        return
    network = trainer.make_network(config)
    network.load_state_dict(variables)
    folder.mkdir(exist_ok=True)
    episode = recording.reenact(network, config, SEED, 0, None, f"{config.name} after {frames:,} steps")
    writing.write(folder / f"{frames:015d}.rrd", [lambda: [episode]])
