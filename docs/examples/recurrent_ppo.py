"""RecurrentPPO of sb3-contrib: `python recurrent_ppo.py strings/features` trains it with its own defaults.

With `--as-in-one-file` it has the settings of recurrent_ppo_in_one_file.py.
"""

import argparse
import json
from pathlib import Path
import time

import numpy as np
import recurrent_ppo_in_one_file as one_file
import sb3_contrib
from stable_baselines3.common import callbacks, vec_env
import torch

from physexp.analysis.score import protocol
from physexp.suite import stable_baselines

FOLDER = Path("runs/recurrent_ppo")
NUM_ENVIRONMENTS = 8  # More are no faster: nearly all of its time goes into learning.


def train(task: str, frames: int = 300_000, minutes: float = 15, seed: int = 0, as_in_one_file: bool = False) -> None:
    """Trains on a task for a number of frames or minutes; an interrupted training keeps its network."""
    torch.set_num_threads(1)  # The networks are small.
    (asked,) = protocol.named([task])
    count = one_file.NUM_ENVIRONMENTS if as_in_one_file else NUM_ENVIRONMENTS
    batch = stable_baselines.VecEnv(asked.domain, asked.task, count, random=seed, **asked.options)
    environments, settings = vec_env.VecMonitor(batch), {}  # The monitor tells the learner what episodes earn.
    if as_in_one_file:
        environments, settings = vec_env.VecNormalize(environments, norm_reward=False), settings_of_one_file()
    # The discount says what a step costs, and belongs to the question.
    learner = sb3_contrib.RecurrentPPO(
        "MultiInputLstmPolicy", environments, gamma=asked.discount, seed=seed, **settings
    )
    command = f"python recurrent_ppo.py {task} --frames {frames} --minutes {minutes:g} --seed {seed}"
    command += " --as-in-one-file" * as_in_one_file
    learner.learn(frames, Watch(frames, 60 * minutes, path_of(asked, as_in_one_file), command))


def settings_of_one_file():
    """Returns the settings of the learner in one file; `Watch` changes the entropy cost as that does."""
    return {
        "learning_rate": lambda left: one_file.LEARNING_RATE * left,
        "n_steps": one_file.ROLLOUT,
        "batch_size": one_file.NUM_ENVIRONMENTS * one_file.ROLLOUT // one_file.MINIBATCHES,
        "n_epochs": one_file.EPOCHS,
        "gae_lambda": one_file.GAE_LAMBDA,
        "clip_range": one_file.CLIP,
        "ent_coef": one_file.ENTROPY_COST,
        "vf_coef": one_file.VALUE_COST,
        "max_grad_norm": one_file.LARGEST_GRADIENT,
        "policy_kwargs": {"lstm_hidden_size": one_file.UNITS},
    }


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
        if self.model.get_vec_normalize_env():  # As in one file.
            progress = self.num_timesteps / self._frames
            self.model.ent_coef = one_file.ENTROPY_COST ** (1 - progress) * one_file.FINAL_ENTROPY_COST**progress
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
        if scales := self.model.get_vec_normalize_env():
            scales.save(self._path.with_suffix(".pkl"))
        curve = list(self._curve.values())
        facts = self._made_by | curve[-1] | {"curve": curve}
        self._path.with_suffix(".json").write_text(json.dumps(facts, indent=1) + "\n", encoding="utf-8")


def make(asked: protocol.Question, as_in_one_file: bool = False):
    """Returns the policy that was trained on a task, for `physexp score recurrent_ppo:make`."""
    path = path_of(asked, as_in_one_file)
    if not path.exists():
        option = " --as-in-one-file" * as_in_one_file
        raise ValueError(f"{path} is missing; train it: python recurrent_ppo.py {asked.name}{option}")
    learner = sb3_contrib.RecurrentPPO.load(path, device="cpu")
    learner.set_random_seed(0)
    scaled = dict
    if as_in_one_file:
        batch = stable_baselines.VecEnv(asked.domain, asked.task, 1, **asked.options)
        scaled = vec_env.VecNormalize.load(path.with_suffix(".pkl"), batch).normalize_obs

    def policy(observation, state):
        action, state = learner.predict(scaled(observation), state, np.array([state is None]))
        return int(action), state

    return policy


def make_as_in_one_file(asked: protocol.Question):
    """Returns the policy that was trained with `--as-in-one-file`."""
    return make(asked, as_in_one_file=True)


def path_of(asked, as_in_one_file=False):
    """Returns the file of what was trained on a task."""
    return FOLDER / ("as_in_one_file" * as_in_one_file) / f"{asked.file_name}.zip"


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("task", help="a task with features, as DOMAIN/TASK")
    parser.add_argument("--frames", type=int, default=300_000, help="environment steps at most")
    parser.add_argument("--minutes", type=float, default=15.0, help="processor time at most")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--as-in-one-file", action="store_true", help="the settings of recurrent_ppo_in_one_file.py")
    train(**vars(parser.parse_args()))
