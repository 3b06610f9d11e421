"""PPO with a memory in one file: `python recurrent_ppo_in_one_file.py strings/features` trains it.

Read it from top to bottom: the settings, the network, how it plays, how it learns, and how it is scored. PPO is that of
Schulman et al. (2017), advantages are those of Schulman et al. (2016). All tasks have the same settings.
"""

import argparse
import dataclasses
import json
from pathlib import Path
import time

import numpy as np
import torch
from torch import nn

from physexp.analysis.score import protocol
from physexp.suite import gymnasium

FOLDER = Path("runs/recurrent_ppo_in_one_file")

NUM_ENVIRONMENTS = 256
ROLLOUT = 16  # Steps in each environment, between updates.
EPOCHS, MINIBATCHES = 4, 4  # Passes over a rollout, and parts of its environments in each.
LEARNING_RATE = 6e-3  # Decays linearly to 0.
ENTROPY_COST, FINAL_ENTROPY_COST = 0.4, 0.001  # Decays exponentially. With too little at first, agents fall silent.
GAE_LAMBDA = 0.95
CLIP = 0.2  # Of the ratio of new to old probabilities.
VALUE_COST = 0.5
LARGEST_GRADIENT = 0.5
UNITS = 128  # Of each layer.
LOOK_EVERY = 8  # Updates between two lines of progress.


class Network(nn.Module):
    """A layer, a GRU, and linear scores of the actions and value; it standardizes its observations."""

    def __init__(self, num_features: int, num_actions: int):
        super().__init__()
        self.num_actions = num_actions
        self.register_buffer("count", torch.zeros(()))
        self.register_buffer("mean", torch.zeros(num_features))
        self.register_buffer("variance", torch.ones(num_features))
        self.encoder = nn.Linear(num_features + num_actions + 1, UNITS)
        self.memory = nn.GRUCell(UNITS, UNITS)
        self.scores = nn.Linear(UNITS, num_actions)
        self.value = nn.Linear(UNITS, 1)
        nn.init.orthogonal_(self.scores.weight, 0.01)  # At first all actions are about equally likely.
        nn.init.zeros_(self.scores.bias)

    def forward(self, seen, before, state):
        """Returns policies and values of T steps in N environments, and the last state.

        Args:
          seen: observations, [T, N, F].
          before: the action before each of them, [T, N]; `num_actions` at the start of an episode.
          state: the memory before the first step, [N, UNITS].
        """
        scaled = ((seen - self.mean) / self.variance.sqrt().clamp(min=1e-6)).clamp(-10, 10)
        done = nn.functional.one_hot(before, self.num_actions + 1)
        encoded = torch.relu(self.encoder(torch.cat([scaled, done], dim=-1)))
        remembered = []
        for inputs, is_old in zip(encoded, before < self.num_actions, strict=True):
            state = self.memory(inputs, state * is_old[:, None])  # A new episode begins with nothing remembered.
            remembered.append(state)
        together = torch.stack(remembered)
        return torch.distributions.Categorical(logits=self.scores(together)), self.value(together)[..., 0], state

    def standardize(self, seen):
        """Adds observations, [N, F], to the mean and the variance of all that were seen."""
        self.count += len(seen)
        share, away = len(seen) / self.count, seen.mean(dim=0) - self.mean
        self.mean += share * away
        self.variance += share * (seen.var(dim=0, correction=0) - self.variance + (1 - share) * away**2)


@dataclasses.dataclass
class Steps:
    """T steps in N environments: arrays [T, N, ...], and the memory before the first one, [N, UNITS]."""

    seen: torch.Tensor
    before: torch.Tensor
    actions: torch.Tensor
    log_probabilities: torch.Tensor
    values: torch.Tensor
    rewards: torch.Tensor
    ended: torch.Tensor
    state: torch.Tensor

    def of(self, environments):
        """Returns the steps in some of the environments."""
        parts = {field.name: getattr(self, field.name) for field in dataclasses.fields(self)}
        return Steps(state=parts.pop("state")[environments], **{k: part[:, environments] for k, part in parts.items()})


class Players:
    """Plays in many environments at once; an episode may begin in one rollout and end in the next."""

    def __init__(self, question: protocol.Question, seed: int):
        self._environments = gymnasium.VectorEnvironment(
            question.domain,
            question.task,
            NUM_ENVIRONMENTS,
            flat_observation=True,
            autoreset_mode="disabled",
            **question.options,
        )
        self._seen = torch.from_numpy(self._environments.reset(seed=seed)[0])
        self._before = torch.full((NUM_ENVIRONMENTS,), question.num_actions)
        self._state = torch.zeros(NUM_ENVIRONMENTS, UNITS)
        self._discount, self._no_action = question.discount, question.num_actions
        self._ages = np.zeros(NUM_ENVIRONMENTS)
        self.earned: list[float] = []  # The discounted returns of the episodes that have ended.

    @torch.no_grad()
    def play(self, network):
        """Returns the steps of a rollout, and the values after the last of them, [N]."""
        start, steps = self._state, []
        for _ in range(ROLLOUT):
            seen, before = self._seen, self._before
            policy, value, self._state = network(seen[None], before[None], self._state)
            action = policy.sample()
            rewards, ended = self._step(action[0])
            steps.append((seen, before, action[0], policy.log_prob(action)[0], value[0], rewards, ended))
        _, after, _ = network(self._seen[None], self._before[None], self._state)
        return Steps(*map(torch.stack, zip(*steps, strict=True)), state=start), after[0]

    def _step(self, actions):
        """Takes an action everywhere, and begins anew where an episode ends; returns rewards and ends."""
        seen, rewards, terminated, truncated, _ = self._environments.step(actions.numpy())
        ended = terminated | truncated
        self.earned += (rewards * self._discount**self._ages)[ended].tolist()
        self._ages = np.where(ended, 0, self._ages + 1)
        if ended.any():
            seen, _ = self._environments.reset(options={"reset_mask": ended})
        self._seen, self._before = torch.from_numpy(seen), actions.masked_fill(torch.from_numpy(ended), self._no_action)
        return torch.from_numpy(rewards).float(), torch.from_numpy(ended)


def advantages(steps, after, discount):
    """Returns generalized advantages, [T, N]: how much better each step turned out than its value."""
    found, advantage = torch.zeros_like(steps.values), torch.zeros_like(after)
    for step in reversed(range(len(found))):
        following = ~steps.ended[step] * (after + GAE_LAMBDA * advantage)
        after = steps.values[step]
        advantage = steps.rewards[step] + discount * following - after
        found[step] = advantage
    return found


def learn(network, optimizer, steps, gains, entropy_cost):
    """Improves the network on a rollout whose advantages are given, [T, N]."""
    returns, gains = gains + steps.values, (gains - gains.mean()) / (gains.std() + 1e-8)
    for _ in range(EPOCHS):
        for some in torch.randperm(NUM_ENVIRONMENTS).chunk(MINIBATCHES):
            part = steps.of(some)
            policy, values, _ = network(part.seen, part.before, part.state)
            ratio = (policy.log_prob(part.actions) - part.log_probabilities).exp()
            gain = torch.min(ratio * gains[:, some], ratio.clamp(1 - CLIP, 1 + CLIP) * gains[:, some]).mean()
            error = (values - returns[:, some]).square().mean()
            optimizer.zero_grad()
            (VALUE_COST * error - gain - entropy_cost * policy.entropy().mean()).backward()
            nn.utils.clip_grad_norm_(network.parameters(), LARGEST_GRADIENT)
            optimizer.step()


def train(task: str, frames: int = 1_200_000, seed: int = 0) -> None:
    """Trains on a task, and keeps the network and a record; the same seed gives the same network."""
    torch.set_num_threads(1)  # The network is small.
    torch.manual_seed(seed)
    (question,) = protocol.named([task])
    players = Players(question, seed)
    network = Network(num_features(question), question.num_actions)
    optimizer = torch.optim.Adam(network.parameters(), eps=1e-5)
    num_updates = -(-frames // (NUM_ENVIRONMENTS * ROLLOUT))
    command = f"python {Path(__file__).name} {task} --frames {frames} --seed {seed}"
    curve, start = [], time.process_time()  # What else the machine does takes none of it.
    for update in range(num_updates):
        progress = update / num_updates
        optimizer.param_groups[0]["lr"] = LEARNING_RATE * (1 - progress)
        steps, after = players.play(network)
        entropy_cost = ENTROPY_COST ** (1 - progress) * FINAL_ENTROPY_COST**progress
        learn(network, optimizer, steps, advantages(steps, after, question.discount), entropy_cost)
        network.standardize(steps.seen.flatten(0, 1))  # From the next rollout on, so that ratios begin at 1.
        done = update + 1
        if done % LOOK_EVERY == 0 or done == num_updates:
            seconds = time.process_time() - start
            mean, players.earned = float(np.mean(players.earned or [0])), []
            curve.append({"frames": done * steps.rewards.numel(), "seconds": round(seconds, 1), "return": mean})
            keep(network, question, {"algorithm": "recurrent PPO in one file", "command": command}, curve)
            left = seconds * (num_updates / done - 1) / 60
            print(f"{curve[-1]['frames']:,} frames, mean return {mean:.3f}, {left:.1f} minutes left", flush=True)


def keep(network, question, made_by, curve):
    """Writes the network, and the record of its training."""
    FOLDER.mkdir(parents=True, exist_ok=True)
    torch.save(network.state_dict(), path_of(question))
    facts = made_by | curve[-1] | {"curve": curve}
    path_of(question).with_suffix(".json").write_text(json.dumps(facts, indent=1) + "\n", encoding="utf-8")


def make(question: protocol.Question):
    """Returns the policy that was trained on a task, for `physexp score recurrent_ppo_in_one_file:make`."""
    if not path_of(question).exists():
        raise ValueError(f"{path_of(question)} is missing; train it: python {Path(__file__).name} {question.name}")
    torch.manual_seed(0)
    network = Network(num_features(question), question.num_actions)
    network.load_state_dict(torch.load(path_of(question)))

    @torch.no_grad()
    def policy(observation, state):
        before, remembered = (question.num_actions, torch.zeros(1, UNITS)) if state is None else state
        seen = torch.from_numpy(np.concatenate([observation[name].ravel() for name in sorted(observation)]))
        distribution, _, remembered = network(seen[None, None], torch.tensor([[before]]), remembered)
        action = int(distribution.sample())
        return action, (action, remembered)

    return policy


def num_features(question):
    """Returns the size of an observation."""
    return sum(int(np.prod(spec.shape)) for spec in question.observation_spec.values())


def path_of(question):
    """Returns the file of the network of a task."""
    return FOLDER / f"{question.file_name}.pt"


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("task", help="a task with features, as DOMAIN/TASK")
    parser.add_argument("--frames", type=int, default=1_200_000, help="environment steps")
    parser.add_argument("--seed", type=int, default=0)
    train(**vars(parser.parse_args()))
