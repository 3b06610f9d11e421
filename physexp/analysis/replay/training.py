"""Replays written during training, always of the same instance."""

from collections.abc import Mapping

import torch

from physexp.analysis.replay import recording, writing
from physexp.analysis.training import config as config_lib
from physexp.analysis.training import run as run_lib
from physexp.analysis.training import trainer

SEED = 4_000_003  # Of the environment, apart from those of training, of evaluation, of the score and of exports.


class Writer:
    """Writes a replay after a checkpoint, if `replay_every` frames have passed since the last replay.

    It is a `recorder.OnCheckpoint`.
    """

    def __init__(self, run: run_lib.Run, config: config_lib.TrainConfig):
        """Prepares to write replays into the folder of a run."""
        self._folder, self._config = run.path / "replays", config

    def __call__(self, frames: int, variables: Mapping[str, torch.Tensor]) -> None:
        """Plays one episode with the network's variables and writes it, if it is time; raises as `writing.write`."""
        earlier = [int(path.stem) for path in self._folder.glob("*.rrd") if path.stem.isdecimal()]
        if frames - max((each for each in earlier if each <= frames), default=0) < self._config.replay_every:
            return
        network = trainer.make_network(self._config)
        network.load_state_dict(variables)
        title = f"{self._config.name} after {frames:,} steps"
        self._folder.mkdir(exist_ok=True)
        episode = recording.reenact(network, self._config, SEED, 0, None, title)
        writing.write(self._folder / f"{frames:015d}.rrd", [lambda: [episode]])
