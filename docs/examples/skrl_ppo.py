"""PPO of skrl with a GRU: `python skrl_ppo.py strings/features` trains it with its own defaults.

With `--as-in-one-file` it has the settings of recurrent_ppo_in_one_file.py.
"""

import argparse
import json
from pathlib import Path
import time

from gymnasium import spaces
import numpy as np
import recurrent_ppo_in_one_file as one_file
import skrl
from skrl.agents.torch import ppo
from skrl.memories.torch import RandomMemory
from skrl.models.torch import CategoricalMixin, DeterministicMixin, Model
from skrl.resources.preprocessors.torch import RunningStandardScaler
import torch

from physexp import suite
from physexp.analysis.score import protocol

FOLDER = Path("runs/skrl_ppo")
UNITS = 64  # Of the GRU and of a hidden layer, as in skrl's examples: only networks have no default.
NUM_ENVIRONMENTS = 64
SCALING = {"clip_threshold": 10.0, "device": "cpu"}  # Of observations, with the settings of one file.


def train(task: str, frames: int = 300_000, minutes: float = 15, seed: int = 0, as_in_one_file: bool = False) -> None:
    """Trains on a task for a number of frames or minutes, and keeps the network and how it was made."""
    torch.set_num_threads(1)  # The networks are small.
    torch.manual_seed(seed)
    (asked,) = protocol.named([task])
    count = one_file.NUM_ENVIRONMENTS if as_in_one_file else NUM_ENVIRONMENTS
    batch = suite.load_batch(asked.domain, asked.task, count, {**asked.options, "random": seed})
    learner = make_learner(asked, count, settings_of_one_file(asked) if as_in_one_file else {})
    command = f"python skrl_ppo.py {task} --frames {frames} --minutes {minutes:g} --seed {seed}"
    curve, start = [], time.process_time()  # What else the machine does takes none of it.
    for seen, mean in learn(learner, batch, frames, asked.discount):
        passed = time.process_time() - start
        curve.append({"frames": seen, "seconds": round(passed, 1), "return": mean})
        left = max(0, min(passed * (frames / seen - 1), 60 * minutes - passed))
        print(f"{seen:,} frames, mean return {mean:.3f}, {left / 60:.1f} minutes left", flush=True)
        if passed > 60 * minutes:
            break
    path = path_of(asked, as_in_one_file)
    path.parent.mkdir(parents=True, exist_ok=True)
    learner.save(str(path))
    facts = {
        "algorithm": f"PPO_RNN of skrl {skrl.__version__}",
        "command": command + " --as-in-one-file" * as_in_one_file,
        **curve[-1],
        "curve": curve,
    }
    path.with_suffix(".json").write_text(json.dumps(facts, indent=1) + "\n", encoding="utf-8")


def settings_of_one_file(asked):
    """Returns the settings of the learner in one file; `learn` changes the rate and the entropy cost as that does."""
    return {
        "rollouts": one_file.ROLLOUT,
        "learning_epochs": one_file.EPOCHS,
        "mini_batches": one_file.MINIBATCHES,
        "learning_rate": one_file.LEARNING_RATE,
        "gae_lambda": one_file.GAE_LAMBDA,
        "ratio_clip": one_file.CLIP,
        "entropy_loss_scale": one_file.ENTROPY_COST,
        "value_loss_scale": one_file.VALUE_COST,
        "grad_norm_clip": one_file.LARGEST_GRADIENT,
        "observation_preprocessor": RunningStandardScaler,
        "observation_preprocessor_kwargs": {"size": one_file.num_features(asked), **SCALING},
    }


def learn(learner, batch, frames, discount):
    """Trains; yields, some steps after another, how many frames it has seen and what the last 100 episodes earned."""
    num_steps = -(-frames // batch.num_environments)
    observations, earned, ages = flat(batch.reset()), [], np.zeros(batch.num_environments)
    for step in range(num_steps):
        when = {"timestep": step, "timesteps": num_steps}
        if learner.cfg.entropy_loss_scale:  # As in one file.
            progress = step / num_steps
            learner.optimizer.param_groups[0]["lr"] = one_file.LEARNING_RATE * (1 - progress)
            cost = one_file.ENTROPY_COST ** (1 - progress) * one_file.FINAL_ENTROPY_COST**progress
            learner.cfg.entropy_loss_scale = cost
        with torch.no_grad():
            actions, _ = learner.act(observations, None, **when)
            timestep = batch.step(actions[:, 0].numpy())
            ended, following = timestep.last(), flat(timestep)
            earned = [*earned, *(timestep.reward * discount**ages)[ended]][-100:]
            ages = np.where(ended, 0, ages + 1)
            if ended.any():  # The next episode begins in the same step, as skrl wants it.
                following[ended] = flat(batch.reset(np.flatnonzero(ended)))
            learner.record_transition(
                observations=observations,
                states=None,
                actions=actions,
                rewards=torch.tensor(timestep.reward[:, None], dtype=torch.float32),
                next_observations=following,
                next_states=None,
                terminated=torch.tensor(ended[:, None]),
                truncated=torch.zeros(len(ended), 1, dtype=torch.bool),
                infos={},
                **when,
            )
        learner.post_interaction(**when)
        observations = following
        if step % 64 == 63 or step == num_steps - 1:
            yield (step + 1) * batch.num_environments, float(np.mean(earned or [0]))


def flat(timestep):
    """Returns what a batch observes as one tensor, [environments, numbers]."""
    parts = timestep.observation
    return torch.cat([torch.tensor(parts[name]).flatten(1) for name in sorted(parts)], dim=1)


class Recurrent(Model):
    """A GRU and a hidden layer: it acts step by step, and learns from sequences that begin with a stored state."""

    def __init__(self, asked, num_environments, num_outputs):
        size = sum(int(np.prod(spec.shape)) for spec in asked.observation_spec.values())
        observed, actions = spaces.Box(-np.inf, np.inf, (size,)), spaces.Discrete(asked.num_actions)
        super().__init__(observation_space=observed, action_space=actions, device="cpu")
        self._num_environments = num_environments
        self.gru = torch.nn.GRU(size, UNITS, batch_first=True)
        self.head = torch.nn.Sequential(
            torch.nn.Linear(UNITS, UNITS), torch.nn.ReLU(), torch.nn.Linear(UNITS, num_outputs)
        )

    def get_specification(self):
        length = ppo.PPO_CFG.rollouts
        return {"rnn": {"sequence_length": length, "sizes": [(1, self._num_environments, UNITS)]}}

    def compute(self, inputs, role):
        length = self.get_specification()["rnn"]["sequence_length"] if self.training else 1
        observed = inputs["observations"].unflatten(0, (-1, length))
        state = inputs["rnn"][0][:, ::length].contiguous()
        outputs = []
        for step in range(length):
            output, state = self.gru(observed[:, step : step + 1], state)
            outputs.append(output)
            if self.training:  # A new episode begins with nothing remembered.
                state = state * ~inputs["terminated"].view(-1, length)[:, step, None]
        return self.head(torch.cat(outputs, dim=1).flatten(0, 1)), {"rnn": [state]}


class Policy(CategoricalMixin, Recurrent):
    """Gives logits of the actions."""

    def __init__(self, asked, num_environments):
        Recurrent.__init__(self, asked, num_environments, asked.num_actions)
        CategoricalMixin.__init__(self)


class Value(DeterministicMixin, Recurrent):
    """Gives the value."""

    def __init__(self, asked, num_environments):
        Recurrent.__init__(self, asked, num_environments, 1)
        DeterministicMixin.__init__(self)


def make_learner(asked, count, settings):
    """Returns skrl's learner with some settings; the discount says what a step costs, and belongs to the question."""
    policy, value = Policy(asked, count), Value(asked, count)
    unwritten = {"write_interval": 0, "checkpoint_interval": 0}
    config = ppo.PPO_CFG(discount_factor=asked.discount, experiment=unwritten, **settings)
    learner = ppo.PPO_RNN(
        models={"policy": policy, "value": value},
        memory=RandomMemory(memory_size=config.rollouts, num_envs=count, device="cpu"),
        observation_space=policy.observation_space,
        action_space=policy.action_space,
        device="cpu",
        cfg=config,
    )
    learner.init()
    learner.enable_training_mode()
    return learner


def make(asked: protocol.Question, as_in_one_file: bool = False):
    """Returns the policy that was trained on a task, for `physexp score skrl_ppo:make`."""
    path = path_of(asked, as_in_one_file)
    if not path.exists():
        option = " --as-in-one-file" * as_in_one_file
        raise ValueError(f"{path} is missing; train it: python skrl_ppo.py {asked.name}{option}")
    torch.manual_seed(0)
    saved, network, scaled = torch.load(path), Policy(asked, num_environments=1), torch.nn.Identity()
    network.load_state_dict(saved["policy"])
    network.eval()
    if as_in_one_file:
        scaled = RunningStandardScaler(one_file.num_features(asked), **SCALING)
        scaled.load_state_dict(saved["observation_preprocessor"])

    @torch.no_grad()
    def policy(observation, state):
        observed = torch.cat([torch.tensor(observation[name]).flatten() for name in sorted(observation)])
        state = torch.zeros(1, 1, UNITS) if state is None else state
        action, outputs = network.act({"observations": scaled(observed[None]), "rnn": [state]})
        return int(action), outputs["rnn"][0]

    return policy


def make_as_in_one_file(asked: protocol.Question):
    """Returns the policy that was trained with `--as-in-one-file`."""
    return make(asked, as_in_one_file=True)


def path_of(asked, as_in_one_file=False):
    """Returns the file of what was trained on a task."""
    return FOLDER / ("as_in_one_file" * as_in_one_file) / f"{asked.file_name}.pt"


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("task", help="a task with features, as DOMAIN/TASK")
    parser.add_argument("--frames", type=int, default=300_000, help="environment steps at most")
    parser.add_argument("--minutes", type=float, default=15.0, help="processor time at most")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--as-in-one-file", action="store_true", help="the settings of recurrent_ppo_in_one_file.py")
    train(**vars(parser.parse_args()))
