"""The belief network: what the answer may be, and what each interaction is worth."""

from collections.abc import Mapping
import contextlib
import math
from typing import Any

from dm_env import specs
import torch
from torch import nn
from torch.nn import functional

from physexp.agents import core, devices, networks
from physexp.agents.belief import config as config_lib

_PIXEL_SCALE = 10.0  # What changes in an image is of the order of a tenth of its range.
_FINEST = 0.01  # What is smaller than this share of the usual movement of features is resolved less and less.
_TEMPERATURE = 0.01  # Of the policy: actions are as good as equal when their values differ by less.


class BeliefNetwork(networks.RecurrentNetwork):
    """A recurrent trunk over what was seen and done, with two kinds of heads.

    One is the belief `b` over the labels: to answer is worth `S = 2 max(b) - 1`, the expected reward. The others are
    values `Q` of the interactions. What an interaction shows can be left out of account, and cannot tell more than the
    label (the value of perfect information: Howard, 1966), so `gamma S <= Q <= gamma`, and the heads say where in
    between: `Q = gamma (S + (1 - S) x)` with `x` in [0, 1]. There are two of each, of which the lesser counts (Fujimoto
    et al., 2018), since the best of many noisy values is too good. The best action is the greatest of `S` and `Q`.

    Features are taken relative to those at the start of the episode, in units of how far they move, which the learner
    measures, and once more on a scale that shows small movements beside large ones (the inverse hyperbolic sine). An
    image is taken relative to the one that training began with.
    """

    log_scale: torch.Tensor

    def __init__(
        self,
        observation_spec: Mapping[str, specs.Array],
        num_actions: int,
        *,
        num_interactions: int,
        units: int,
        most_interactions: int,
        discount: float,
    ):
        """Builds the network; its weights follow torch's global seed.

        Args:
          observation_spec: what is observed: features, or one image.
          num_actions: how many actions there are.
          num_interactions: how many of them are interactions; they come first, labels after them.
          units: of the recurrent layer and of the layers above it.
          most_interactions: after so many it prefers to answer.
          discount: gamma.

        Raises:
          ValueError: if what is observed is neither features nor one image.
        """
        super().__init__(observation_spec, num_actions)
        self.sees_images = networks.sees_images(observation_spec)
        self.num_interactions, self.most_interactions, self.discount = num_interactions, most_interactions, discount
        self.torso: networks.PixelTorso | networks.FeatureTorso
        if self.sees_images:
            self.torso = networks.PixelTorso(observation_spec, _PIXEL_SCALE)
        else:
            self.torso = networks.FeatureTorso(observation_spec, 1.0)
        scales = 1 if self.sees_images else 2
        self.embedding = nn.Linear(scales * self.torso.num_outputs + num_interactions + 1, units)
        self.recurrent = nn.GRU(units, units)
        self.belief = _head(units, num_actions - num_interactions)
        self.values = nn.ModuleList(_head(units, num_interactions) for _ in range(2))
        self.register_buffer("log_scale", torch.zeros(()))

    @staticmethod
    def hyperparameters(environment: core.Batch, config: config_lib.BeliefConfig) -> dict[str, Any]:
        return {
            "num_interactions": environment.num_interactions,
            "units": config.units,
            "most_interactions": config.most_interactions,
            "discount": config.discount,
        }

    def initial_state(self, batch_size):
        """Returns the state at the start of episodes: memory, first inputs, what was done last, how often."""
        sizes = (self.recurrent.hidden_size, self.torso.num_outputs, self.num_interactions, 1)
        return tuple(torch.zeros(1, batch_size, size, device=self.device) for size in sizes)

    def calibrate(self, first: networks.Observation) -> None:
        """Tells the torso what an episode's first observation looks like, arrays [N, ...]."""
        self.torso.calibrate(first)

    def encode(self, observation):
        with devices.autocast(self.device) if self.sees_images else contextlib.nullcontext():
            inputs, places = self.torso.distinct(observation)
        inputs = inputs.to(self.device).float()
        return inputs if places is None else inputs[places]

    def step(self, inputs, state):
        memory, first, done, time = state
        first = torch.where(time == 0, inputs, first)
        embedded = self._embed(inputs - first[0], done[0], time[0])
        outputs, memory = self.recurrent(embedded[None], memory)
        belief, values = self._heads(outputs[0])
        values = values.min(0).values.masked_fill(time[0] >= self.most_interactions, -1.0)
        worths = torch.cat([values, 2 * belief.softmax(-1) - 1], dim=1)
        return worths / _TEMPERATURE, worths.max(1).values, (memory, first, done, time + 1)

    def note(self, actions, state):
        memory, first, _, time = state
        return memory, first, self._one_hot(actions.to(self.device))[None], time

    def worths(self, logits: torch.Tensor) -> torch.Tensor:
        """Returns what each action is worth, [N, A], of the logits of `step`."""
        return logits * _TEMPERATURE

    def unroll(
        self, inputs: torch.Tensor, actions: torch.Tensor, dropout: float = 0.0
    ) -> tuple[torch.Tensor, torch.Tensor]:
        """Computes whole episodes from their first steps, padded to the longest.

        Args:
          inputs: what `encode` returned, [T, B, F].
          actions: what was done then, int64 [T, B].
          dropout: share of the trunk's outputs that the heads do without, drawn anew for each step.

        Returns:
          Logits of the belief, [T, B, L], and both values of each interaction, [2, T, B, I].
        """
        done = functional.pad(self._one_hot(actions[:-1]), (0, 0, 0, 0, 1, 0))
        times = torch.arange(len(inputs), device=self.device).float()[:, None, None].expand(-1, inputs.shape[1], 1)
        outputs, _ = self.recurrent(self._embed(inputs - inputs[:1], done, times))
        return self._heads(functional.dropout(outputs, dropout))

    def _embed(self, change, done, time):
        seen = [change]
        if not self.sees_images:
            scaled = change * torch.exp(-self.log_scale)
            seen = [scaled, torch.asinh(scaled / _FINEST) / math.asinh(1 / _FINEST)]
        return functional.relu(self.embedding(torch.cat([*seen, done, time / self.most_interactions], dim=-1)))

    def _heads(self, outputs):
        belief = self.belief(outputs)
        answering = 2 * belief.detach().softmax(-1).amax(-1, keepdim=True) - 1
        shares = torch.stack([head(outputs).sigmoid() for head in self.values])
        return belief, self.discount * torch.lerp(answering, torch.ones_like(answering), shares)

    def _one_hot(self, actions):
        """Maps actions to one number for each interaction, all 0 for a label."""
        num_interactions = self.num_interactions
        return functional.one_hot(actions.clamp(max=num_interactions), num_interactions + 1)[..., :-1].float()


def _head(units: int, num_outputs: int) -> nn.Module:
    return nn.Sequential(nn.Linear(units, units), nn.ReLU(), nn.Linear(units, num_outputs))
