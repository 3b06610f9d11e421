"""RecurrentPPO of sb3-contrib with its own defaults: `python recurrent_ppo.py strings/features` trains it."""

import argparse
import json
from pathlib import Path
import time

import numpy as np
import sb3_contrib
from stable_baselines3.common import callbacks, vec_env
import torch

from physexp.analysis.score import protocol
from physexp.suite import stable_baselines

FOLDER = Path("runs/recurrent_ppo")
NUM_ENVIRONMENTS = 8  # More are no faster: nearly all of its time goes into learning.


def train(task: str, frames: int = 300_000, minutes: float = 15, seed: int = 0) -> None:
    """Trains on a task for a number of frames or minutes; an interrupted training keeps its network."""
    torch.set_num_threads(1)  # The networks are small.
    (asked,) = protocol.named([task])
    batch = stable_baselines.VecEnv(asked.domain, asked.task, NUM_ENVIRONMENTS, random=seed, **asked.options)
    environments = vec_env.VecMonitor(batch)  # Tells the learner what episodes earn.
    # The discount says what a step costs, and belongs to the question; everything else is the library's.
    learner = sb3_contrib.RecurrentPPO("MultiInputLstmPolicy", environments, gamma=asked.discount, seed=seed)
    command = f"python recurrent_ppo.py {task} --frames {frames} --minutes {minutes:g} --seed {seed}"
    learner.learn(frames, Watch(frames, 60 * minutes, path_of(asked), command))


class Watch(callbacks.BaseCallback):
    """Prints what episodes earn, keeps the network and how it came about, and ends training when its time is over."""

    def __init__(self, frames, seconds, path, command):
        super().__init__()
        self._frames, self._seconds, self._path, self._curve = frames, seconds, path, {}
        self._made_by = {"algorithm": f"RecurrentPPO of sb3-contrib {sb3_contrib.__version__}", "command": command}

    def _on_training_start(self):
        self._start = time.process_time()  # What else the machine does takes none of it.

    def _on_step(self):
        return time.process_time() - self._start < self._seconds

    def _on_rollout_end(self):
        self._look()

    def _on_training_end(self):
        if self.num_timesteps not in self._curve:  # Its time was over within a rollout.
            self._look()

    def _look(self):
        passed, frames = time.process_time() - self._start, self.num_timesteps
        ended = self.model.ep_info_buffer  # The last 100 episodes.
        mean = float(np.mean([one["r"] * self.model.gamma ** (one["l"] - 1) for one in ended])) if ended else 0.0
        self._curve[frames] = {"frames": frames, "seconds": round(passed, 1), "return": mean}
        self._keep()
        left = max(0, min(passed * (self._frames / frames - 1), self._seconds - passed))
        print(f"{frames:,} frames, mean return {mean:.3f}, {left / 60:.1f} minutes left", flush=True)

    def _keep(self):
        self._path.parent.mkdir(parents=True, exist_ok=True)
        self.model.save(self._path)
        curve = list(self._curve.values())
        facts = self._made_by | curve[-1] | {"curve": curve}
        self._path.with_suffix(".json").write_text(json.dumps(facts, indent=1) + "\n", encoding="utf-8")


def make(asked: protocol.Question):
    """Returns the policy that was trained on a task, for `physexp score recurrent_ppo:make`."""
    if not path_of(asked).exists():
        raise ValueError(f"{path_of(asked)} is missing; train it: python recurrent_ppo.py {asked.name}")
    learner = sb3_contrib.RecurrentPPO.load(path_of(asked), device="cpu")
    learner.set_random_seed(0)

    def policy(observation, state):
        action, state = learner.predict(observation, state, np.array([state is None]))
        return int(action), state

    return policy


def path_of(asked):
    """Returns the file of what was trained on a task."""
    return FOLDER / f"{asked.file_name}.zip"


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("task", help="a task with features, as DOMAIN/TASK")
    parser.add_argument("--frames", type=int, default=300_000, help="environment steps at most")
    parser.add_argument("--minutes", type=float, default=15.0, help="processor time at most")
    parser.add_argument("--seed", type=int, default=0)
    train(**vars(parser.parse_args()))
