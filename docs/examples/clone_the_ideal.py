"""Clones the ideal experimenter of a task: a recurrent network learns to do what it did in exported episodes.

physexp export ideal --tasks strings/features --episodes 20000
python clone_the_ideal.py exports/ideal strings/features
physexp score clone_the_ideal:make --tasks strings/features
"""

import argparse
import json
import math
from pathlib import Path

import numpy as np
from pyarrow import parquet
import torch
from torch import nn
from torch.nn import functional
from torch.nn.utils.rnn import pad_sequence

CLONES = Path("clones")
OCTAVES = torch.tensor([1.0, 2.0, 4.0, 8.0])  # Of waves that make small differences of readings large.
IGNORED = -100  # What `cross_entropy` leaves out: the action after an episode's end.


class Clone(nn.Module):
    """Maps what is observed, and the action before, to scores of the actions."""

    def __init__(self, num_features, num_actions, width=128):
        super().__init__()
        self.num_actions = num_actions
        self.register_buffer("mean", torch.zeros(num_features))
        self.register_buffer("spread", torch.ones(num_features))
        num_inputs = num_features * (1 + 2 * len(OCTAVES)) + num_actions + 1
        self.memory = nn.GRU(num_inputs, width, batch_first=True)
        self.scores = nn.Linear(width, num_actions)

    def forward(self, seen, before, state=None):
        """Returns scores [B, T, A] and a state, of features [B, T, F] and the actions before, [B, T]; A is none."""
        done = functional.one_hot(before, self.num_actions + 1)
        scaled = (seen - self.mean) / self.spread
        waves = (scaled[..., None] * OCTAVES).flatten(start_dim=-2)
        remembered, state = self.memory(torch.cat([scaled, waves.sin(), waves.cos(), done], dim=-1), state)
        return self.scores(remembered), state


def read(folder):
    """Returns N episodes, padded to the longest: features [N, T, F] and actions [N, T]."""
    table = parquet.read_table(folder)
    names = [name for name in table.column_names if name.startswith("observation_")]
    seen = np.concatenate([np.stack(table[name].to_numpy()) for name in names], axis=1)
    starts = np.flatnonzero(table["step"].to_numpy() == 0)
    lengths = np.diff([*starts, len(table)]).tolist()
    actions = torch.from_numpy(table["action"].to_numpy().astype(np.int64))
    return (
        pad_sequence(torch.from_numpy(seen).split(lengths), batch_first=True),
        pad_sequence(actions.split(lengths), batch_first=True, padding_value=IGNORED),
    )


def file_of(task):
    """Returns where the clone of a task, DOMAIN/TASK, is kept."""
    return CLONES / f"{task.replace('/', '-')}.pt"


def train(folder, task, updates=1_000, batch_size=256, learning_rate=3e-3):
    """Trains a clone of the player of a task, DOMAIN/TASK, in an exported folder, and keeps it."""
    torch.manual_seed(0)
    torch.set_num_threads(1)
    facts = json.loads((Path(folder) / "export.json").read_text(encoding="utf-8"))["tasks"][task]
    num_actions = len(facts["action_names"])
    seen, actions = read(Path(folder) / task.replace("/", "-") / "steps.parquet")
    before = functional.pad(actions.clamp(min=0), (1, -1), value=num_actions)
    clone = Clone(seen.shape[-1], num_actions)
    played = seen[actions != IGNORED]
    clone.mean[:], clone.spread[:] = played.mean(dim=0), played.std(dim=0).clamp(min=1e-6)
    optimizer = torch.optim.Adam(clone.parameters())
    schedule = torch.optim.lr_scheduler.OneCycleLR(optimizer, learning_rate, total_steps=updates, pct_start=0.1)
    for update in range(updates):
        rows = torch.randint(len(seen), (batch_size,))
        scores, _ = clone(seen[rows], before[rows])
        loss = functional.cross_entropy(scores.flatten(0, 1), actions[rows].flatten(), ignore_index=IGNORED)
        optimizer.zero_grad()
        loss.backward()
        nn.utils.clip_grad_norm_(clone.parameters(), 1.0)
        optimizer.step()
        schedule.step()
        if (update + 1) % 100 == 0:
            print(f"{update + 1:5d} updates: loss {loss.item():.4f}", flush=True)
    CLONES.mkdir(exist_ok=True)
    torch.save(clone.state_dict(), file_of(task))


def make(question):
    """Returns the clone of a task as a policy, for `physexp score`."""
    clone = Clone(sum(math.prod(spec.shape) for spec in question.observation_spec.values()), question.num_actions)
    clone.load_state_dict(torch.load(file_of(question.name)))

    @torch.inference_mode()
    def policy(observation, state):
        before, remembered = state or (question.num_actions, None)
        seen = torch.from_numpy(np.concatenate([observation[name].ravel() for name in question.observation_spec]))
        scores, remembered = clone(seen[None, None], torch.tensor([[before]]), remembered)
        action = int(scores.argmax())
        return action, (action, remembered)

    return policy


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", help="the exported episodes")
    parser.add_argument("task", help="DOMAIN/TASK")
    arguments = parser.parse_args()
    train(arguments.folder, arguments.task)
