"""Time that recorders, replays and the command line take."""

from collections.abc import Iterator
from pathlib import Path
import tempfile
import time

import numpy as np

from physexp import suite
from physexp.agents import environment_loop, pretrained
from physexp.analysis import replay
from physexp.analysis.bench import measuring
from physexp.analysis.replay import recording, writing
from physexp.analysis.training import config as config_lib
from physexp.analysis.training import finding

_PAIRS, _EPISODES = 100, 8  # Measurements of each side, and episodes in a measurement.


def figures() -> Iterator[dict]:
    """Measures the recorder, a replay in training, `physexp replay` and `physexp --help`."""
    for name, task in measuring.FEATURES.items():
        yield _recording(name, task)
    for name, task in measuring.FEATURES.items():
        yield _replay_in_training(name, task)
    with tempfile.TemporaryDirectory() as folder:
        target = "/".join(measuring.REFERENCE)
        arguments = ["replay", target, "--episodes", "4", "--output", f"{folder}/replay.rrd"]
        yield measuring.timed(f"physexp replay {target} --episodes 4", arguments, 15)
    yield measuring.timed("physexp --help", ["--help"], 0.5)


def _recording(name: str, task: measuring.Task) -> dict:
    """Returns the share of time that recording adds to the same episodes of a trained agent."""
    environment, actor = suite.load(*task, task_kwargs={"random": 0}), pretrained.load(*task).actor(greedy=True)
    recorder = replay.EpisodeRecorder(*task, {}, actor)
    loops = [environment_loop.EnvironmentLoop(environment, actor, observers) for observers in ([], [recorder])]
    seconds = np.zeros((_PAIRS, 2))
    for pair in range(_PAIRS):
        for side in (0, 1) if pair % 2 else (1, 0):
            environment.task.next_episode = pair * _EPISODES
            start = time.process_time()
            loops[side].run(_EPISODES)
            seconds[pair, side] = time.process_time() - start
    plain, recorded = seconds.sum(axis=0).tolist()
    added = float(np.median(seconds[:, 1] / seconds[:, 0])) - 1
    figure, sides = f"what recording adds to evaluation: {name}", {"recorded_seconds": recorded, "plain_seconds": plain}
    return measuring.row(figure, added, "", 0.03, at_most=True, **sides)


def _replay_in_training(name: str, task: measuring.Task) -> dict:
    """Returns the processor time of a replay, as a share of that of training between two replays."""
    agent = pretrained.load(*task)
    config = finding.config_of(agent.card)
    seconds = []
    with tempfile.TemporaryDirectory() as folder:
        for number in range(3):  # The first one imports.
            start = time.process_time()
            episode = recording.reenact(agent.network, config, 0, number, None)
            writing.write(Path(folder) / "replay.rrd", [lambda episode=episode: [episode]])  # type: ignore[misc]
            seconds.append(time.process_time() - start)
    steps = config_lib.REPLAY_EVERY
    training = measuring.THREADS * steps / measuring.training_rate(task, 10.0)
    figure, taken = f"a replay / training for {steps:,} steps: {name}", seconds[-1]
    return measuring.ratio(figure, 0.02, at_most=True, replay_seconds=taken, training_seconds=training)
